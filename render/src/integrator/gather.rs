//! Direct light of a group of packets without rays: the closed forms of the lights that certificates know.

use super::analytic::{Analytic, Places};
use super::known::{Closed, Fitted, Known};
use super::visible::{Ask, Scenery};
use crate::bvh::GROUP;
use crate::certificates::Precision;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8, select};
use crate::surfaces::Surface;
use etendue::{Mask, Real};
use std::f64::consts::FRAC_1_PI;

/// What a group of packets sees of a light past blockers.
struct Seen {
    /// Lanes in which the light must be sampled.
    open: [M8; GROUP],
    /// Lanes whose part of the light is known.
    behind: [M8; GROUP],
    part: [X8; GROUP],
}

impl Seen {
    /// Takes the part of the light that some lanes of a packet see, if it is known.
    fn take(&mut self, &Ask { packet, lanes, .. }: &Ask, part: Option<X8>) {
        match part {
            Some(part) => {
                self.part[packet] += part.keep(lanes);
                self.behind[packet] = self.behind[packet] | lanes;
            }
            None => self.open[packet] = self.open[packet] | lanes,
        }
    }
}

impl Analytic<'_> {
    /// Adds the reflected light that is known. Sets the lanes in which a light must be sampled, for each light and packet, and returns
    /// whether there are any. Of a light with a picture behind blockers, a part is counted, the same for all of its points; samples then add what
    /// is visible, less that part. On rough surfaces all lights are sampled, and `fitted` is what is known of them.
    #[expect(clippy::too_many_arguments, reason = "places, and all that is found there")]
    pub(super) fn gather(
        &mut self,
        surfaces: &[Surface],
        places: &[Places; GROUP],
        lobes: &[Option<Lobe>; GROUP],
        reflected: &mut [V8; GROUP],
        unknown: &mut [[M8; GROUP]],
        counted: &mut [[X8; GROUP]],
        fitted: &mut [[Fitted; GROUP]],
    ) -> bool {
        let none = M8::splat(false);
        let mut any = false;
        // the lanes that share certificates, and the index of the first of these
        let mut parts = [[(0, none); 8]; GROUP];
        let (mut counts, mut sampled) = ([0; GROUP], [none; GROUP]);
        let reflecting = || surfaces.iter().enumerate().filter(|(_, surface)| surface.reflects.any());
        for (p, surface) in reflecting() {
            let rough = surface.reflects & places[p].fitted;
            sampled[p] = surface.reflects & places[p].glossy | rough;
            let mut left = surface.reflects & !places[p].glossy & !rough;
            if let Some(lobe) = lobes[p].as_ref().filter(|_| rough.any()) {
                self.gather_fitted(surface, &places[p], lobe, p, &mut reflected[p], fitted);
            }
            while left.any() {
                let (first, lanes) = self.find(surface, &places[p], left);
                left = left & !lanes;
                if first == 0 {
                    sampled[p] = sampled[p] | lanes;
                    continue;
                }
                parts[p][counts[p]] = (first, lanes);
                counts[p] += 1;
            }
        }
        if counts == [0; GROUP] {
            for (k, unknown) in unknown[..self.lights.len()].iter_mut().enumerate() {
                for (p, _) in reflecting() {
                    unknown[p] = sampled[p];
                    any = any || sampled[p].any();
                    if let Some(counted) = counted.get_mut(k) {
                        counted[p] = X8::lit(0.0);
                    }
                }
            }
            return any;
        }
        let mut sums = [V8::default(); GROUP];
        let Self { lights, visible, exact, known, forms, polyhedra, .. } = self;
        let scenery = Scenery { forms, bodies: polyhedra };
        for (k, light) in lights.iter().enumerate() {
            let form = &light.form;
            let (mut lit, mut lit_exactly) = ([none; GROUP], [none; GROUP]);
            let mut seen = Seen { open: sampled, behind: [none; GROUP], part: [X8::lit(0.0); GROUP] };
            for (p, surface) in reflecting() {
                for (first, lanes) in &parts[p][..counts[p]] {
                    match &known[first + k] {
                        Known::Lit(Precision::Double) => lit_exactly[p] = lit_exactly[p] | *lanes,
                        Known::Lit(_) => lit[p] = lit[p] | *lanes,
                        Known::Dark => {}
                        Known::Crowded | Known::Nothing | Known::Never => seen.open[p] = seen.open[p] | *lanes,
                        Known::Behind(forms, bodies, precision) => {
                            // the other lanes repeat one of these: what is not seen from here does not matter
                            let lane = lanes.bits().trailing_zeros() as usize & 7;
                            let of = |v: V8| V8::blend(*lanes, v, V8::splat(v.lane(lane)));
                            let (point, normal) = (of(surface.point), of(surface.normal));
                            let (forms, bodies, lanes) = (forms.clone(), bodies.clone(), *lanes);
                            let ask = Ask { packet: p, lanes, point, normal, forms, bodies };
                            if *precision == Precision::Double {
                                let (forms, bodies) = (ask.forms.clone(), ask.bodies.clone());
                                seen.take(&ask, exact.visible_past(point, normal, None, form, forms, bodies));
                            } else {
                                visible.add(ask, form, scenery, |ask, part| seen.take(ask, part));
                            }
                        }
                    }
                }
            }
            visible.finish(form, scenery, |ask, part| seen.take(ask, part));
            let Seen { open, behind, part } = seen;
            // all of the light, where that is of use
            let mut all = [X8::lit(0.0); GROUP];
            let is_picture = matches!(light.closed, Closed::Picture(_));
            for (p, surface) in reflecting() {
                let lanes = if is_picture { behind[p] } else { lit[p] };
                if lanes.any() {
                    let (forms, bodies) = (0..0, 0..0);
                    let ask = Ask { packet: p, lanes, point: surface.point, normal: surface.normal, forms, bodies };
                    visible.add(ask, form, scenery, |ask, found| all[ask.packet] = found.unwrap_or_default());
                }
            }
            visible.finish(form, scenery, |ask, found| all[ask.packet] = found.unwrap_or_default());
            for (p, surface) in reflecting() {
                if let Closed::Picture(irradiance) = light.closed {
                    let (zero, behind) = (X8::lit(0.0), behind[p]);
                    // single precision always suffices, since nothing cancels
                    let lit = lit[p] | lit_exactly[p];
                    // behind blockers, what is visible of a light of constant radiance is the best guess
                    let (mut share, mut is_part) = (select(lit, X8::lit(1.0), zero), none);
                    if behind.any() {
                        let (part, all) = (part[p], all[p]);
                        is_part = behind & part.gt(zero) & part.lt(all);
                        share = select(behind, (part / all).clamped(zero, X8::lit(1.0)).keep(part.gt(zero)), share);
                    }
                    let (all, known) = irradiance.at(surface.point, surface.normal, lit | behind);
                    let share = share.keep(known);
                    sums[p] += all * share;
                    let open = open[p] | is_part | (lit | behind) & !known;
                    (unknown[k][p], counted[k][p]) = (open, share.keep(is_part));
                    any = any || open.any();
                    continue;
                }
                let mut part = part[p] + all[p].keep(lit[p]);
                if lit_exactly[p].any() {
                    let all = exact.visible_past(surface.point, surface.normal, None, form, 0..0, 0..0);
                    part += all.unwrap_or_default().keep(lit_exactly[p]);
                }
                sums[p] += V8::from(light.radiance) * part;
                unknown[k][p] = open[p];
                any = any || open[p].any();
            }
        }
        for (p, surface) in reflecting() {
            let V8 { x, y, z } = surface.albedo * X8::lit(FRAC_1_PI);
            reflected[p] += V8::new(x * sums[p].x, y * sums[p].y, z * sums[p].z);
        }
        any
    }
}
