//! What proofs and closed forms know of the lights of a tile.

use super::certifiable::Certifiable;
use super::certificates::{Certificates, Closed, Known};
use super::closed_forms::ClosedForms;
use super::ledger::{Know, Ledger, Outlook};
use crate::bvh::GROUP;
use crate::camera::{Camera, Group, PointIdentity, Points, PreparedScene};
use crate::packet::{M8, V8, X8, each_bit};
use crate::settings::Settings;
use etendue::{Mask, Real, Vec3};
use etendue_visible::{ALLOWED, Precision, Solid};
use std::f64::consts::FRAC_1_PI;

/// Writes what is proved into the ledger, and adds the light that follows from it.
pub(crate) struct Knowledge<'a> {
    pub(super) certificates: Certificates<'a>,
    pub(super) forms: ClosedForms,
    /// Whether pictures of lights have closed forms, of which fractions can be counted.
    pub(super) has_fractions: bool,
}

impl<'a> Knowledge<'a> {
    /// For a scene as a camera sees it.
    pub(crate) fn new(
        scene: &'a PreparedScene,
        certifiable: &'a Certifiable,
        camera: &Camera,
        settings: &Settings,
    ) -> Self {
        let certificates = Certificates::new(scene, certifiable, camera, settings);
        Self { certificates, forms: ClosedForms::default(), has_fractions: certifiable.has_irradiances() }
    }
}

impl Know for Knowledge<'_> {
    fn begin(&mut self, origin: [u32; 2]) {
        self.certificates.begin(origin);
    }
    fn look_ahead(&mut self, points: &Points, pixels: &[[[u32; 2]; 8]; GROUP]) -> Outlook {
        self.try_out(points, pixels)
    }
    fn know(&mut self, group: &Group<'_>, ledger: &mut Ledger, reflected: &mut [V8; GROUP]) {
        self.gather(group, ledger, reflected);
    }
    fn open_at(&mut self, points: &Points, packet: usize, pixels: &[[u32; 2]; 8], open: &mut [M8]) {
        let (surface, place) = (&points.surfaces[packet], &points.places[packet]);
        open.fill(surface.reflects & place.unfitted);
        each_bit((surface.reflects & !place.unfitted).bits(), |lane| {
            let alone = PointIdentity { pixel: Some(pixels[lane]), ..*place };
            let (first, _) = self.certificates.find(surface, &alone, M8::from_bits(1 << lane));
            for (open, known) in open.iter_mut().zip(&self.certificates.known[first..]) {
                // beyond its fit, a rough surface is sampled
                if known.is_open() || place.fitted.lane(lane) && !matches!(known, Known::Dark) {
                    *open = *open | M8::from_bits(1 << lane);
                }
            }
        });
    }
    fn take_counts(&mut self) -> [u64; 3] {
        let [proofs, met] = std::mem::take(&mut self.certificates.certifier.count);
        [proofs, met, std::mem::take(&mut self.forms.count)]
    }
    /// A fraction of what the lights that are computed would contribute if nothing hid them.
    fn error_bound(&mut self, points: &Points) -> V8 {
        let (surface, place) = (&points.surfaces[0], &points.places[0]);
        if let Some(lobe) = points.lobes[0].as_ref().filter(|_| (surface.reflects & place.fitted).lane(0)) {
            return self.error_bound_of_fit(surface, place, lobe);
        }
        if !(surface.reflects & !place.unfitted & !place.fitted).lane(0) {
            return V8::default();
        }
        let (first, _) = self.certificates.find(surface, place, M8::from_bits(1));
        let mut sum = V8::default();
        for (light, known) in self.certificates.lights.iter().zip(&self.certificates.known[first..]) {
            if matches!(known, Known::Lit(_) | Known::Behind(..)) {
                // the irradiance from a picture is as accurate as where a surface faces it
                let normal = match (&light.closed, &light.form) {
                    (Closed::Picture(_), Solid::Parallelogram { corner, edges }) => {
                        let [corner, u, v] =
                            [*corner, edges[0], edges[1]].map(|v| -> Vec3<f32> { v.map(|x| x as f32) });
                        (V8::splat(corner + (u + v) * 0.5) - surface.point).normalize()
                    }
                    _ => surface.normal,
                };
                let all = self.forms.part([surface.point, normal], None, &light.form, (&[], Precision::Single));
                sum += V8::from(light.radiance) * all.unwrap_or_default();
            }
        }
        let V8 { x, y, z } = surface.albedo * X8::lit(FRAC_1_PI * ALLOWED);
        V8::new(x * sum.x, y * sum.y, z * sum.z)
    }
}
