//! Direct light of a group of packets without rays: the closed forms of the lights that certificates know.

use super::certificates::{Closed, Known};
use super::closed_forms::Ask;
use super::knowledge::Knowledge;
use super::ledger::{Ledger, Proven};
use super::picture_irradiance::PictureIrradiance;
use crate::bvh::GROUP;
use crate::camera::Group;
use crate::packet::{M8, V8, X8, first_lane, product};
use crate::surfaces::Surface;
use etendue::{Mask, Real};
use etendue_visible::Precision;
use std::f64::consts::FRAC_1_PI;

/// The certificates for a group of packets.
struct GroupCertificates {
    /// The lanes of each packet that share certificates, and the index of the first of these.
    parts: [[(usize, M8); 8]; GROUP],
    counts: [usize; GROUP],
    /// Lanes in which all lights are sampled.
    sampled: [M8; GROUP],
}

/// What a group of packets sees of a light.
struct GroupSees {
    /// Lanes in which the light must be sampled.
    remaining: [M8; GROUP],
    /// Lanes that see all of it, by a closed form in single and in double precision.
    lit: [[M8; 2]; GROUP],
    /// Lanes that see the light past occluders, and what they see of it.
    behind: [M8; GROUP],
    part: [X8; GROUP],
    /// What they would see without occluders, where that is of use.
    all: [X8; GROUP],
}

impl GroupSees {
    /// Takes the part of the light that some lanes of a packet see, if it is known.
    fn take(&mut self, &Ask { packet, lanes, .. }: &Ask, part: Option<X8>) {
        match part {
            Some(part) => {
                self.part[packet] += part.keep(lanes);
                self.behind[packet] = self.behind[packet] | lanes;
            }
            None => self.remaining[packet] = self.remaining[packet] | lanes,
        }
    }
}

impl Knowledge<'_> {
    /// Adds the reflected light that is known, and notes what is left of each light.
    ///
    /// If occluders hide some of a picture, it is counted as if all of its points were hidden by the same fraction, and samples add the
    /// difference. On rough surfaces, the integral of their fit is counted, and samples of all lights add what the BSDF reflects beyond it.
    pub(super) fn gather(&mut self, group: &Group<'_>, ledger: &mut Ledger, reflected: &mut [V8; GROUP]) {
        let lights = self.certificates.lights.len();
        (ledger.is_known, ledger.has_fractions) = (true, self.has_fractions);
        if !group.scene.surfaces.is_plain {
            ledger.proven[..lights].fill([Proven::nothing(); GROUP]);
            let has_fit = |p: usize| group.points.lobes[p].is_some() && group.points.places[p].fitted.any();
            ledger.has_fits = std::array::from_fn(|p| p < group.count && has_fit(p));
        }
        let found = self.find(group, ledger, reflected);
        let mut remains = false;
        let mut sums = [V8::default(); GROUP];
        for light in 0..lights {
            remains |= if found.counts == [0; GROUP] {
                leave(light, group, &found, ledger)
            } else {
                self.add_light(light, group, &found, ledger, &mut sums)
            };
        }
        for (p, surface) in group.reflecting() {
            reflected[p] += product(surface.albedo * X8::lit(FRAC_1_PI), sums[p]);
        }
        ledger.is_closed = !remains;
    }

    /// Finds the certificates of the diffuse surfaces of a group, and adds what the fits of rough ones reflect.
    fn find(&mut self, group: &Group<'_>, ledger: &mut Ledger, reflected: &mut [V8; GROUP]) -> GroupCertificates {
        let none = M8::splat(false);
        let mut found =
            GroupCertificates { parts: [[(0, none); 8]; GROUP], counts: [0; GROUP], sampled: [none; GROUP] };
        for (p, surface) in group.reflecting() {
            let place = &group.points.places[p];
            let rough = surface.reflects & place.fitted;
            found.sampled[p] = surface.reflects & place.unfitted | rough;
            if let Some(lobe) = group.points.lobes[p].as_ref().filter(|_| rough.any()) {
                self.add_fits(group, p, lobe, ledger, &mut reflected[p]);
            }
            let mut left = surface.reflects & !place.unfitted & !rough;
            while left.any() {
                let (first, lanes) = self.certificates.find(surface, place, left);
                left = left & !lanes;
                if first == 0 {
                    found.sampled[p] = found.sampled[p] | lanes;
                } else {
                    found.parts[p][found.counts[p]] = (first, lanes);
                    found.counts[p] += 1;
                }
            }
        }
        found
    }

    /// Adds the irradiance from a light to the sums.
    fn add_light(
        &mut self,
        light: usize,
        group: &Group<'_>,
        found: &GroupCertificates,
        ledger: &mut Ledger,
        sums: &mut [V8; GROUP],
    ) -> bool {
        let seen = self.see(light, group, found);
        let of = &self.certificates.lights[light];
        let mut remains = false;
        for (p, surface) in group.reflecting() {
            let mut remaining = seen.remaining[p];
            if let Closed::Picture(irradiance) = of.closed {
                let (irradiance, more, counted) = seen.picture(p, surface, irradiance);
                sums[p] += irradiance;
                remaining = remaining | more;
                ledger.fractions[light][p] = counted;
            } else {
                sums[p] += V8::from(of.radiance) * (seen.part[p] + seen.all[p]);
            }
            ledger.open[light][p] = remaining;
            remains |= remaining.any();
        }
        remains
    }

    /// What a group sees of a light.
    fn see(&mut self, light: usize, group: &Group<'_>, found: &GroupCertificates) -> GroupSees {
        let (none, zero) = (M8::splat(false), [X8::lit(0.0); GROUP]);
        let (lit, behind) = ([[none; 2]; GROUP], [none; GROUP]);
        let mut seen = GroupSees { remaining: found.sampled, lit, behind, part: zero, all: zero };
        let (certificates, forms) = (&self.certificates, &mut self.forms);
        let (solids, of) = (&certificates.solids[..], &certificates.lights[light]);
        for (p, surface) in group.reflecting() {
            for &(first, lanes) in &found.parts[p][..found.counts[p]] {
                match &certificates.known[first + light] {
                    Known::Lit(precision) => {
                        let lit = &mut seen.lit[p][usize::from(*precision == Precision::Double)];
                        *lit = *lit | lanes;
                    }
                    Known::Dark => {}
                    Known::Open | Known::Never => seen.remaining[p] = seen.remaining[p] | lanes,
                    Known::Behind(behind, precision) => {
                        // the other lanes repeat one of these: what is not seen from here does not matter
                        let lane = first_lane(lanes);
                        let at =
                            [surface.point, surface.normal].map(|v: V8| V8::blend(lanes, v, V8::splat(v.lane(lane))));
                        let ask = Ask { packet: p, lanes, at, behind: behind.clone(), precision: *precision };
                        forms.add(ask, &of.form, solids, |ask, part| seen.take(ask, part));
                    }
                }
            }
        }
        forms.finish(&of.form, solids, |ask, part| seen.take(ask, part));
        let mut whole = seen.all;
        let mut take = |ask: &Ask, all: Option<X8>| whole[ask.packet] += all.unwrap_or_default().keep(ask.lanes);
        for (p, surface) in group.reflecting() {
            // a constant light in place of the picture tells how much of it is hidden
            let asked = if matches!(of.closed, Closed::Picture(_)) { [seen.behind[p], none] } else { seen.lit[p] };
            for (lanes, precision) in asked.into_iter().zip([Precision::Single, Precision::Double]) {
                if lanes.any() {
                    let ask = Ask { packet: p, lanes, at: [surface.point, surface.normal], behind: 0..0, precision };
                    forms.add(ask, &of.form, solids, &mut take);
                }
            }
        }
        forms.finish(&of.form, solids, take);
        seen.all = whole;
        seen
    }
}

/// Leaves a light to be sampled by a group without certificates.
fn leave(light: usize, group: &Group<'_>, found: &GroupCertificates, ledger: &mut Ledger) -> bool {
    let mut remains = false;
    for (p, _) in group.reflecting() {
        ledger.open[light][p] = found.sampled[p];
        if ledger.has_fractions {
            ledger.fractions[light][p] = X8::lit(0.0);
        }
        remains |= found.sampled[p].any();
    }
    remains
}

impl GroupSees {
    /// The irradiance of a packet from a picture, the lanes in which it must be sampled, and the part of it that was counted there.
    fn picture(&self, p: usize, surface: &Surface, irradiance: &PictureIrradiance) -> (V8, M8, X8) {
        let zero = X8::lit(0.0);
        let behind = self.behind[p];
        // single precision always suffices, since nothing cancels
        let lit = self.lit[p][0] | self.lit[p][1];
        // behind occluders, what is visible of a light of constant radiance is the best guess
        let (mut share, mut is_part) = (Real::blend(lit, X8::lit(1.0), zero), M8::splat(false));
        if behind.any() {
            let (part, all) = (self.part[p], self.all[p]);
            is_part = behind & part.gt(zero) & part.lt(all);
            share = Real::blend(behind, (part / all).clamped(zero, X8::lit(1.0)).keep(part.gt(zero)), share);
        }
        let (all, known) = irradiance.at(surface.point, surface.normal, lit | behind);
        let share = share.keep(known);
        (all * share, is_part | (lit | behind) & !known, share.keep(is_part))
    }
}
