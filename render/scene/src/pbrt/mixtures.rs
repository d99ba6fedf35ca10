//! Mixtures of materials, and glass, which is one of a mirror and of nothing.

use etendue_render::scene::Material;
use etendue_render::scene::texture::Texture;

/// What a surface is made of, as the state of a scene file holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finish {
    /// A material.
    Of(Material),
    /// None: rays pass as if there were no surface.
    Invisible,
    /// A named material that is not defined yet, by its index among those names.
    Awaited(usize),
    /// Two of them, by the index of the mixture.
    Mix(usize),
}

/// A mixture of two materials.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    pub(super) of: [Finish; 2],
    /// The share of the second one.
    pub(super) amount: Texture,
}

/// The materials of a mixture with their shares, and the chance that a ray that meets them meets each, if it has passed those before.
pub(super) fn parts(finish: Finish, mixtures: &[Mixture]) -> Vec<(Finish, Texture)> {
    let mut leaves = Vec::new();
    let mut rest = vec![(finish, Texture::number(1.0))];
    // mixtures precede those that contain them, so that this ends; a bound for those that double each time
    while let Some((finish, share)) = rest.pop() {
        match finish {
            Finish::Mix(index) if leaves.len() + rest.len() < MOST_PARTS => {
                let Mixture { of: [first, second], amount } = &mixtures[index];
                rest.push((*second, share.clone().times(amount.clone())));
                rest.push((*first, share.times(amount.clone().inverse())));
            }
            finish => leaves.push((finish, share)),
        }
    }
    // what rays pass takes its share from those that they meet
    let is_whole = leaves.iter().all(|(finish, _)| *finish != Finish::Invisible);
    // of two, shares may vary
    if let [(first, _), (_, last)] = &mut leaves[..] {
        if *first != Finish::Invisible {
            *last = Texture::number(1.0);
        }
        return leaves;
    }
    let mut left = 1.0_f32;
    for (finish, share) in &mut leaves {
        let own = share.mean()[0];
        *share = Texture::number(if left > 1e-6 { (own / left).clamp(0.0, 1.0) } else { 1.0 });
        left -= if *finish == Finish::Invisible { 0.0 } else { own };
    }
    // what rounding leaves over is the last one's
    leaves.last_mut().into_iter().filter(|_| is_whole).for_each(|(_, share)| *share = Texture::number(1.0));
    leaves
}

/// The material of a mixture that has the greatest share, unless rays pass it: that of lights.
pub(super) fn greatest(finish: Finish, mixtures: &[Mixture]) -> Finish {
    let mut finish = finish;
    while let Finish::Mix(index) = finish {
        let Mixture { of: [first, second], amount } = &mixtures[index];
        // a lamp of glass is one
        finish = if amount.mean()[0] > 0.5 && *second != Finish::Invisible { *second } else { *first };
    }
    finish
}

/// Most materials of a mixture of mixtures.
const MOST_PARTS: usize = 16;

/// A smooth surface that rays pass straight, but for those that it reflects: both sides of a thin pane, or one of a solid. One
/// side reflects `once`.
pub(super) fn pane(once: f64, is_thin: bool, mixtures: &mut Vec<Mixture>) -> Finish {
    // what goes back and forth in a thin pane is a geometric series
    let reflected = if is_thin { 2.0 * once / (1.0 + once) } else { once };
    let amount = Texture::number((1.0 - reflected) as f32);
    mixtures.push(Mixture { of: [Finish::Of(Material::Mirror([1.0; 3])), Finish::Invisible], amount });
    Finish::Mix(mixtures.len() - 1)
}
