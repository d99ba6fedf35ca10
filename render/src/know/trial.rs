//! Decides at the start of a tile whether certificates are worth their time.

use super::certificates::Known;
use super::knowledge::Knowledge;
use super::ledger::Outlook;
use crate::bvh::{GROUP, PrimitiveId};
use crate::camera::{PointIdentity, Points};
use crate::packet::{M8, each_bit};
use etendue::Mask;
use std::cmp::Reverse;

/// At most so many primitives of a tile are looked at first, those that most of its rays see. If nothing is known of any light at any of
/// them, the tile asks for no certificates.
const TRIALS: usize = 4;
/// At most so many squares of a tile are looked at first for each of these primitives. Lights that they do not decide are sampled.
const TRIED_SQUARES: usize = 3;

/// A primitive that some rays of a tile see.
struct SeenPrimitive {
    primitive: PrimitiveId,
    /// Whether the camera sees it directly.
    direct: bool,
    /// The packets and lanes of the rays.
    lanes: Vec<(usize, usize)>,
}

impl Knowledge<'_> {
    /// Looks at what the rays of some packets see in the tile, each of them in a pixel of its own, and decides whether certificates are worth
    /// asking for. (The rays are the same for all samples, so that what is known does not depend on which of them a process takes.)
    pub(super) fn try_out(&mut self, points: &Points, pixels: &[[[u32; 2]; 8]; GROUP]) -> Outlook {
        let Points { surfaces, places, .. } = points;
        let certificates = &mut self.certificates;
        let mut seen: Vec<SeenPrimitive> = Vec::new();
        let mut all = true;
        for (p, (surface, places)) in surfaces.iter().zip(places).enumerate() {
            all = all && !(surface.reflects & (places.unfitted | places.fitted)).any();
            each_bit((surface.reflects & !places.unfitted).bits(), |lane| {
                let (primitive, direct) = (places.primitives.lane(lane), places.direct.lane(lane));
                match seen.iter_mut().find(|seen| seen.primitive == primitive && seen.direct == direct) {
                    Some(seen) => seen.lanes.push((p, lane)),
                    None => seen.push(SeenPrimitive { primitive, direct, lanes: vec![(p, lane)] }),
                }
            });
        }
        let distinct = seen.len();
        seen.retain(|seen| certificates.is_worth(seen.primitive));
        all = all && seen.len() == distinct;
        seen.sort_by_key(|seen| (Reverse(seen.lanes.len()), seen.primitive));
        let count = certificates.lights.len();
        let mut some = false;
        for seen in seen.iter().take(TRIALS) {
            let (p, lane) = seen.lanes[0];
            let whole = PointIdentity { pixel: None, ..places[p] };
            let (first, _) = certificates.find(&surfaces[p], &whole, M8::from_bits(1 << lane));
            let mut open: Vec<bool> = certificates.known[first..first + count].iter().map(Known::is_open).collect();
            some = some || open.contains(&false);
            if let Some(pinhole) = certificates.pinhole.filter(|_| seen.direct && open.contains(&true)) {
                let mut squares: Vec<u32> = Vec::new();
                for &(p, lane) in &seen.lanes {
                    let pixel = pixels[p][lane];
                    let square = certificates.square(pixel, 1);
                    if squares.len() < TRIED_SQUARES && !squares.contains(&square) {
                        squares.push(square);
                        let found = certificates.seen(&pinhole, seen.primitive, pixel, 1);
                        open.iter_mut()
                            .zip(&certificates.known[found..])
                            .for_each(|(open, known)| *open &= known.is_open());
                    }
                }
                some = some || open.contains(&false);
                for (known, _) in certificates.known[first..].iter_mut().zip(&open).filter(|(_, open)| **open) {
                    *known = Known::Never;
                }
            }
            all = all && !open.contains(&true);
        }
        // what is seen in mirrors was not looked at in squares
        let is_tried = seen.len() >= TRIALS || seen.iter().all(|seen| seen.direct);
        let is_hopeless = seen.is_empty() || !some && is_tried;
        Outlook { some: !is_hopeless, all: all && seen.len() <= TRIALS }
    }
}
