//! Decides at the start of a tile whether certificates are worth their time.

use super::analytic::{Analytic, Places};
use super::known::Known;
use crate::bvh::GROUP;
use crate::packet::{M8, each_bit};
use crate::surfaces::Surface;
use etendue::Mask;
use std::cmp::Reverse;

/// At most so many primitives of a tile are looked at first, those that most of its rays see. If nothing is known of any light at any of
/// them, the tile asks for no certificates.
const TRIALS: usize = 4;
/// At most so many squares of a tile are looked at first for each of these primitives. Lights that they do not decide are sampled.
const TRIED_SQUARES: usize = 3;

/// A primitive that some rays of a tile see.
struct Seen {
    place: u32,
    /// Whether the camera sees it directly.
    direct: bool,
    /// The packets and lanes of the rays.
    lanes: Vec<(usize, usize)>,
}

impl Analytic<'_> {
    /// Looks at what the rays of some packets see in the tile, each of them in a pixel of its own, and decides whether certificates are worth
    /// asking for. (The rays are the same for all samples, so that what is known does not depend on which of them a process takes.)
    pub(super) fn try_out(&mut self, surfaces: &[Surface], places: &[Places; GROUP], pixels: &[[[u32; 2]; 8]; GROUP]) {
        let mut seen: Vec<Seen> = Vec::new();
        let mut all = true;
        for (p, (surface, places)) in surfaces.iter().zip(places).enumerate() {
            all = all && !(surface.reflects & (places.glossy | places.fitted)).any();
            each_bit((surface.reflects & !places.glossy).bits(), |lane| {
                let (place, direct) = (places.primitives.as_array()[lane], places.direct.lane(lane));
                match seen.iter_mut().find(|seen| seen.place == place && seen.direct == direct) {
                    Some(seen) => seen.lanes.push((p, lane)),
                    None => seen.push(Seen { place, direct, lanes: vec![(p, lane)] }),
                }
            });
        }
        let distinct = seen.len();
        seen.retain(|seen| self.is_worth(seen.place));
        all = all && seen.len() == distinct;
        seen.sort_by_key(|seen| (Reverse(seen.lanes.len()), seen.place));
        let count = self.lights.len();
        let mut some = false;
        for seen in seen.iter().take(TRIALS) {
            let (p, lane) = seen.lanes[0];
            let whole = Places { pixel: None, ..places[p] };
            let (first, _) = self.find(&surfaces[p], &whole, M8::from_bits(1 << lane));
            let mut open: Vec<bool> = self.known[first..first + count].iter().map(Known::is_open).collect();
            some = some || open.contains(&false);
            if let Some(pinhole) = self.pinhole.filter(|_| seen.direct && open.contains(&true)) {
                let mut squares: Vec<u32> = Vec::new();
                for &(p, lane) in &seen.lanes {
                    let pixel = pixels[p][lane];
                    let square = self.square(pixel, 1);
                    if squares.len() < TRIED_SQUARES && !squares.contains(&square) {
                        squares.push(square);
                        let found = self.seen(&pinhole, seen.place, pixel, 1);
                        open.iter_mut().zip(&self.known[found..]).for_each(|(open, known)| *open &= known.is_open());
                    }
                }
                some = some || open.contains(&false);
                for (known, _) in self.known[first..].iter_mut().zip(&open).filter(|(_, open)| **open) {
                    *known = Known::Never;
                }
            }
            all = all && !open.contains(&true);
        }
        // what is seen in mirrors was not looked at in squares
        let is_tried = seen.len() >= TRIALS || seen.iter().all(|seen| seen.direct);
        self.hopeless = seen.is_empty() || !some && is_tried;
        self.all_known = all && seen.len() <= TRIALS;
    }
}
