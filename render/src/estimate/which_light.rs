//! Which light each lane of a packet samples.

use crate::bvh::GROUP;
use crate::camera::Group;
use crate::choose::{Chooser, LightPmf};
use crate::know::Ledger;
use crate::lights::sky::SunBeside;
use crate::packet::{M8, X8, each_group, pick};
use crate::surfaces::Surface;
use crate::surfaces::lobe::Lobe;
use etendue::select::{Choice, Gloss, LightChoice};
use etendue::{Mask, Real, Vec2, u32x8};

/// Which light is sampled.
pub(super) enum Which<'a> {
    /// This one.
    One(u32),
    /// The sun besides the sky, which is the last of the lights.
    Sun(SunBeside<'a>),
    /// The one to which the sample is allocated, or one that is chosen at random, of those that are open.
    Chosen,
}

impl Which<'_> {
    /// Chooses a light for each lane of a packet. Returns the lanes that sample it, and the numbers that are left for a point on it.
    #[inline(always)]
    pub(super) fn choose<const GENERAL: bool>(
        &self,
        group: &Group<'_>,
        ledger: &Ledger,
        packet: usize,
    ) -> (Choice<X8>, M8, Vec2<X8>) {
        let mut u = group.numbers.light[packet];
        let numbers = group.numbers.choice.map_or([u.x, X8::lit(0.0)], |choice| [choice[packet].x, choice[packet].y]);
        let given = |index: u32| Choice { index: u32x8::splat(index), pmf: X8::lit(1.0), u: numbers[0] };
        let all = group.points.surfaces[packet].reflects;
        let (choice, lanes) = match self {
            Self::One(light) => (given(*light), all),
            Self::Sun(_) => (given(group.lights.of_sky()), all),
            Self::Chosen => chosen::<GENERAL>(group, ledger, packet, numbers),
        };
        if group.numbers.choice.is_none() {
            u.x = choice.u;
        }
        (choice, lanes, u)
    }
}

/// What the choice depends on where surfaces are glossy. Where lights are known, it is by what they give to diffuse ones.
fn gloss<const GENERAL: bool>(group: &Group<'_>, ledger: &Ledger, packet: usize) -> Option<Gloss<X8>> {
    let is_asked = GENERAL && ledger.open().is_none();
    group.points.lobes[packet].as_ref().filter(|_| is_asked).map(Lobe::gloss)
}

/// The light to which a sample is allocated, or one chosen at random, among those that are open; and the lanes that sample it. `numbers` are
/// random, the second for many lights.
#[inline(always)]
fn chosen<const GENERAL: bool>(
    group: &Group<'_>,
    ledger: &Ledger,
    packet: usize,
    numbers: [X8; 2],
) -> (Choice<X8>, M8) {
    let surface = &group.points.surfaces[packet];
    let all = surface.reflects;
    let allocated = group.allocated.get(packet);
    match (allocated, ledger.open()) {
        (_, Some(open)) => among_open(group, packet, numbers[0], open, group.rough::<GENERAL>(packet)),
        (Some(allocated), None) => (allocated.choose(numbers[0]), all),
        (None, None) => {
            let gloss = gloss::<GENERAL>(group, ledger, packet);
            (group.chooser.choose(surface.point, surface.normal, gloss.as_ref(), numbers), all)
        }
    }
}

/// The same where some lights are not open. Not inlined, so that it does not burden images of which nothing is known.
#[inline(never)]
fn among_open(group: &Group<'_>, packet: usize, number: X8, open: &[[M8; GROUP]], rough: M8) -> (Choice<X8>, M8) {
    let surface = &group.points.surfaces[packet];
    let all = surface.reflects;
    let Some(allocated) = group.allocated.get(packet) else {
        return among(group.chooser, surface, all, packet, number, open);
    };
    // where another light than those that were expected in the packet is open, too, all lanes choose at random; on rough surfaces, all
    // lights are expected
    let none = M8::splat(false);
    let unexpected = (0..group.lights.len()).filter(|light| group.expected[packet] >> light & 1 == 0);
    let stray = !rough & unexpected.fold(none, |stray, light| stray | open[light][packet]);
    let choice = allocated.choose(number);
    let mut lanes = none;
    each_group(choice.index, all & !stray, |light, same| lanes = lanes | same & open[light as usize][packet]);
    if !stray.any() {
        return (choice, lanes);
    }
    let (other, others) = among(group.chooser, surface, all & stray, packet, number, open);
    let choice = Choice {
        index: pick(stray, other.index, choice.index),
        pmf: Real::blend(stray, other.pmf, choice.pmf),
        u: Real::blend(stray, other.u, choice.u),
    };
    (choice, lanes | others)
}

/// Chooses one of the lights that are open in a packet, for each of these lanes.
#[inline]
fn among(
    chooser: &Chooser,
    surface: &Surface,
    lanes: M8,
    packet: usize,
    number: X8,
    open: &[[M8; GROUP]],
) -> (Choice<X8>, M8) {
    match chooser.contributions(surface.point, surface.normal) {
        Some(near) => (near.only(|light| open[light][packet]).choose(number), lanes),
        None => (Choice { index: u32x8::splat(0), pmf: X8::lit(1.0), u: number }, lanes & open[0][packet]),
    }
}

/// Takes the probabilities with which a packet of surfaces that are sampled themselves chooses lights.
#[inline(always)]
pub(super) fn pmf<const GENERAL: bool>(
    group: &Group<'_>,
    ledger: &Ledger,
    packet: usize,
    take: impl FnOnce(LightPmf<'_>),
) {
    let Surface { point, normal, .. } = group.points.surfaces[packet];
    match group.allocated.get(packet) {
        Some(allocated) => take(&|light| allocated.pmf(light)),
        None => {
            let gloss = gloss::<GENERAL>(group, ledger, packet);
            group.chooser.pmf(point, normal, gloss.as_ref(), take);
        }
    }
}
