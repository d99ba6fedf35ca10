//! Finds the fewest parts and triangles of a scene that still fail.

use super::draft::{Draft, Form, SourceDraft};
use super::skin::Skin;

/// Greatest number of scenes that are tried.
const MOST: usize = 400;

/// The smallest scene that failed so far.
struct Search<F> {
    best: Draft,
    tried: usize,
    fails: F,
}

impl<F: Fn(&Draft) -> bool> Search<F> {
    /// Keeps a change if the scene still fails; returns whether it did.
    fn try_to(&mut self, change: impl FnOnce(&mut Draft)) -> bool {
        let mut candidate = self.best.clone();
        change(&mut candidate);
        if candidate == self.best || self.tried == MOST {
            return false;
        }
        self.tried += 1;
        let better = (self.fails)(&candidate);
        if better {
            self.best = candidate;
        }
        better
    }

    /// Leaves out parts and lights.
    fn remove(&mut self) {
        for index in (0..self.best.parts.len()).rev() {
            self.try_to(|draft| _ = draft.parts.remove(index));
        }
        for index in (0..self.best.sources.len()).rev() {
            self.try_to(|draft| _ = draft.sources.remove(index));
        }
    }

    /// Leaves out what varies over lights.
    fn simplify_sources(&mut self) {
        let bare: [fn(&mut SourceDraft); 3] =
            [|source| source.map = None, |source| source.picture = None, |source| source.strength = 1.0];
        for index in 0..self.best.sources.len() {
            for bare in bare {
                self.try_to(|draft| bare(&mut draft.sources[index]));
            }
        }
    }

    /// Leaves out what varies over parts, and copies.
    fn simplify_parts(&mut self) {
        let of_skin: [fn(&mut Skin); 4] = [
            |skin| skin.albedo = None,
            |skin| skin.opacity = None,
            |skin| skin.bend = None,
            |skin| *skin = Skin::default(),
        ];
        for index in 0..self.best.parts.len() {
            self.try_to(|draft| {
                if let Some(glow) = &mut draft.parts[index].glow {
                    glow.two_sided = false;
                }
            });
            for bare in of_skin {
                self.try_to(|draft| bare(&mut draft.parts[index].skin));
            }
            // the last copy stays, since the triangles are elsewhere without it
            for copy in (0..self.best.parts[index].copies.len()).rev() {
                if self.best.parts[index].copies.len() > 1 {
                    self.try_to(|draft| _ = draft.parts[index].copies.remove(copy));
                }
            }
        }
    }

    /// Leaves out halves of a mesh, then smaller pieces, down to triangles.
    fn thin_out(&mut self, index: usize) {
        let count = |draft: &Draft| draft.parts[index].form.triangles().len();
        let mut step = count(&self.best).div_ceil(2);
        while step > 0 {
            let mut start = 0;
            while start < count(&self.best) && count(&self.best) > step {
                let is_smaller = self.try_to(|draft| {
                    if let Form::Mesh(triangles) = &mut draft.parts[index].form {
                        triangles.drain(start..(start + step).min(triangles.len()));
                    }
                });
                start += if is_smaller { 0 } else { step };
            }
            step /= 2;
        }
    }
}

/// Leaves out what the failure does not need: the lens, parts, what varies over them, copies, halves of meshes, and triangles; and shortens
/// numbers.
pub(crate) fn shrink(draft: &Draft, fails: impl Fn(&Draft) -> bool) -> Draft {
    let mut search = Search { best: draft.clone(), tried: 0, fails };
    let whole: [fn(&mut Draft); 3] =
        [|draft| draft.look.lens = None, |draft| draft.look.frame = None, |draft| draft.is_shared = false];
    for simplify in whole {
        search.try_to(simplify);
    }
    loop {
        let before = search.best.size();
        search.remove();
        search.simplify_sources();
        search.simplify_parts();
        (0..search.best.parts.len()).for_each(|index| search.thin_out(index));
        if search.best.size() == before {
            break;
        }
    }
    for digits in [2, 3, 4] {
        let short = |v: [f64; 3]| v.map(|x| rounded(x, digits));
        for index in 0..search.best.parts.len() {
            search.try_to(|draft| draft.parts[index].form.moved(short, short));
        }
    }
    search.best
}

/// A number of so many significant digits.
fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}
