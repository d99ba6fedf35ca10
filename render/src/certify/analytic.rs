//! Closed forms as an estimator around another one.

use super::certifiable::Certifiable;
use super::certificates::{Certificates, Closed, Known};
use super::closed_forms::ClosedForms;
use super::residual::{Left, Residual};
use crate::bvh::GROUP;
use crate::camera::Camera;
use crate::estimate::{Estimator, Group, Place, Plain, Points, Reflected, TileEstimator, Tracer};
use crate::packet::{M8, V8, X8, each_bit};
use crate::prepared::PreparedScene;
use crate::settings::Settings;
use etendue::{Mask, Real, Vec3};
use etendue_visible::{ALLOWED, Solid};
use std::f64::consts::FRAC_1_PI;

/// Adds the light that certificates make known, and leaves the rest to another estimator.
pub(crate) struct Analytic<'a, E> {
    pub(super) certificates: Certificates<'a>,
    pub(super) forms: ClosedForms,
    pub(super) left: Left,
    /// Whether no certificates are asked for in this tile: all lights are sampled.
    pub(super) is_hopeless: bool,
    /// Whether all lights are known at all places of the tile that were looked at first.
    pub(super) knows_all: bool,
    inner: E,
}

impl<E> Estimator<Plain> for Analytic<'_, E>
where
    E: Estimator<Plain> + for<'r> Estimator<Residual<'r>>,
{
    fn add<const GENERAL: bool>(
        &mut self,
        group: &Group<'_>,
        plain: &Plain,
        tracer: &mut Tracer,
        reflected: &mut Reflected,
    ) {
        if self.is_hopeless {
            return self.inner.add::<GENERAL>(group, plain, tracer, reflected);
        }
        let remains = self.gather::<GENERAL>(group, &mut reflected.known);
        let residual = Residual { left: &self.left, points: group.points, is_empty: !remains };
        self.inner.add::<GENERAL>(group, &residual, tracer, reflected);
    }
}

impl<'a, E> Analytic<'a, E> {
    /// For a scene as a camera sees it, around this estimator. [`begin`](Self::begin) prepares for a tile.
    pub(crate) fn new(
        scene: &'a PreparedScene,
        certifiable: &'a Certifiable,
        camera: &Camera,
        settings: &Settings,
        inner: E,
    ) -> Self {
        Self {
            certificates: Certificates::new(scene, certifiable, camera, settings),
            forms: ClosedForms::default(),
            left: Left::new(certifiable.has_irradiances()),
            is_hopeless: false,
            knows_all: false,
            inner,
        }
    }
}

impl<E> TileEstimator for Analytic<'_, E>
where
    E: TileEstimator + Estimator<Plain> + for<'r> Estimator<Residual<'r>>,
{
    fn is_combined(&self) -> bool {
        self.inner.is_combined()
    }
    fn reflected(&mut self, group: &Group<'_>, tracer: &mut Tracer) -> Reflected {
        self.estimate(group, &Plain, tracer)
    }
    fn begin(&mut self, origin: [u32; 2]) -> bool {
        self.certificates.begin(origin);
        (self.is_hopeless, self.knows_all) = (false, false);
        true
    }
    fn look_ahead(&mut self, points: &Points, pixels: &[[[u32; 2]; 8]; GROUP]) {
        self.try_out(points, pixels);
    }
    fn asks(&self) -> bool {
        !self.is_hopeless
    }
    fn knows_all(&self) -> bool {
        self.knows_all
    }
    fn remaining(&mut self, points: &Points, packet: usize, pixels: &[[u32; 2]; 8], remaining: &mut [M8]) {
        let (surface, place) = (&points.surfaces[packet], &points.places[packet]);
        remaining.fill(surface.reflects & place.unfitted);
        each_bit((surface.reflects & !place.unfitted).bits(), |lane| {
            let alone = Place { pixel: Some(pixels[lane]), ..*place };
            let (first, _) = self.certificates.find(surface, &alone, M8::from_bits(1 << lane));
            for (remaining, known) in remaining.iter_mut().zip(&self.certificates.known[first..]) {
                // beyond its fit, a rough surface is sampled
                if known.is_open() || place.fitted.lane(lane) && !matches!(known, Known::Dark) {
                    *remaining = *remaining | M8::from_bits(1 << lane);
                }
            }
        });
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
                let all = self.forms.part(surface.point, normal, None, &light.form, &[]);
                sum += V8::from(light.radiance) * all.unwrap_or_default();
            }
        }
        let V8 { x, y, z } = surface.albedo * X8::lit(FRAC_1_PI * ALLOWED);
        V8::new(x * sum.x, y * sum.y, z * sum.z)
    }
}
