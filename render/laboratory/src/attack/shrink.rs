//! Finds the fewest parts and triangles of a scene that still fail.

use super::draft::{Draft, Form, Glow, Part, Source};
use super::skin::Skin;

/// Greatest number of scenes that are tried.
const MOST: usize = 400;

/// Leaves out what the failure does not need: the lens, parts, what varies over them, copies, halves of meshes, and triangles; and shortens
/// numbers.
#[must_use]
pub fn shrink(draft: &Draft, fails: impl Fn(&Draft) -> bool) -> Draft {
    let mut best = draft.clone();
    let mut tried = 0;
    let mut accept = |best: &mut Draft, candidate: Draft| {
        tried += 1;
        let better = tried <= MOST && candidate != *best && fails(&candidate);
        if better {
            *best = candidate;
        }
        better
    };
    if best.look.lens.is_some() {
        let mut candidate = best.clone();
        candidate.look.lens = None;
        accept(&mut best, candidate);
    }
    if best.look.frame.is_some() {
        let mut candidate = best.clone();
        candidate.look.frame = None;
        accept(&mut best, candidate);
    }
    if best.is_shared {
        let candidate = Draft { is_shared: false, ..best.clone() };
        accept(&mut best, candidate);
    }
    loop {
        let before = best.size();
        for index in (0..best.parts.len()).rev() {
            let mut candidate = best.clone();
            candidate.parts.remove(index);
            accept(&mut best, candidate);
        }
        for index in (0..best.sources.len()).rev() {
            let mut candidate = best.clone();
            candidate.sources.remove(index);
            accept(&mut best, candidate);
        }
        for index in 0..best.sources.len() {
            let bare: [fn(&mut Source); 5] = [
                |source| source.map = None,
                |source| source.measure.scale = None,
                |source| source.measure.wanted = None,
                |source| source.picture = None,
                |source| source.strength = 1.0,
            ];
            for bare in bare {
                let mut candidate = best.clone();
                bare(&mut candidate.sources[index]);
                accept(&mut best, candidate);
            }
        }
        for index in 0..best.parts.len() {
            let bare: [fn(&mut Part, &mut Glow); 5] = [
                |part, _| part.place = None,
                |part, _| part.place.iter_mut().for_each(|place| place.is_reversed = false),
                |_, glow| glow.measure.scale = None,
                |_, glow| glow.measure.wanted = None,
                |_, glow| glow.two_sided = false,
            ];
            for bare in bare {
                let mut candidate = best.clone();
                let part = &mut candidate.parts[index];
                if let Some(mut glow) = part.glow {
                    bare(part, &mut glow);
                    part.glow = Some(glow);
                    accept(&mut best, candidate);
                }
            }
            let bare: [fn(&mut Skin); 5] = [
                |skin| skin.glow = None,
                |skin| skin.albedo = None,
                |skin| skin.opacity = None,
                |skin| skin.bend = None,
                |skin| *skin = Skin::default(),
            ];
            for bare in bare {
                let mut candidate = best.clone();
                bare(&mut candidate.parts[index].skin);
                accept(&mut best, candidate);
            }
            // the last copy stays, since the triangles are elsewhere without it
            for copy in (0..best.parts[index].copies.len()).rev() {
                if best.parts[index].copies.len() > 1 {
                    let mut candidate = best.clone();
                    candidate.parts[index].copies.remove(copy);
                    accept(&mut best, candidate);
                }
            }
        }
        for index in 0..best.parts.len() {
            let Form::Mesh(all) = &best.parts[index].form else { continue };
            let mut step = all.len().div_ceil(2);
            while step > 0 {
                let mut start = 0;
                while let Form::Mesh(triangles) = &best.parts[index].form
                    && start < triangles.len()
                    && triangles.len() > step
                {
                    let mut left = triangles.clone();
                    left.drain(start..(start + step).min(left.len()));
                    let mut candidate = best.clone();
                    candidate.parts[index].form = Form::Mesh(left);
                    if !accept(&mut best, candidate) {
                        start += step;
                    }
                }
                step /= 2;
            }
        }
        if best.size() == before {
            break;
        }
    }
    for digits in [2, 3, 4] {
        for index in 0..best.parts.len() {
            let mut candidate = best.clone();
            let short = |v: [f64; 3]| v.map(|x| rounded(x, digits));
            candidate.parts[index].form.moved(short, short);
            accept(&mut best, candidate);
        }
    }
    best
}

/// A number of so many significant digits.
fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}
