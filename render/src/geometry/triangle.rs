//! Triangles. As lights, they are a corner and the edges from there.

use super::bounds::bounds_of;
use super::flat::{Edged, coordinates, sample_picture};
use super::form::{Chart, Extent, Form, projected, wide};
use super::points::{Points, on_plane};
use super::spread::Spread;
use crate::packet::{V8, X8};
use crate::technique::Measure;
use etendue::light::{self, Picture};
use etendue::{LightSample, LightSampler, Vec2, Vec3};
use etendue_visible::{Occluder, Solid};

/// The corners of a triangle; the normal is (v1 − v0) × (v2 − v0).
pub(super) type Triangle = [[f32; 3]; 3];

/// The edges from the first corner, in double precision.
fn edges([a, b, c]: &Triangle) -> [Vec3<f64>; 2] {
    [wide(*b) - wide(*a), wide(*c) - wide(*a)]
}

/// The light with these vectors.
#[inline(always)]
fn light([v0, e1, e2]: [V8; 3]) -> light::Triangle<X8> {
    light::Triangle { v0, e1, e2 }
}

impl Form for Triangle {
    type Hittable = Edged<true>;
    const CHART: Option<Chart> = Some(Chart::Triangle);
    const SHARE: f64 = 2.0;

    fn bounds(&self) -> [[f32; 3]; 2] {
        bounds_of(self)
    }
    fn area(&self) -> f64 {
        let [u, v] = edges(self);
        0.5 * u.cross(v).length()
    }
    fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        let [u, v] = edges(self);
        Some([wide(self[0]), u.cross(v).normalize()])
    }
    fn middle(&self) -> Vec3<f64> {
        let [a, b, c] = self.map(wide);
        (a + b + c) * (1.0 / 3.0)
    }
    fn halves(&self, _direction: Vec3<f64>) -> [Vec3<f64>; 2] {
        edges(self).map(|edge| edge * 0.5)
    }
    fn hittable(&self) -> Self::Hittable {
        let [u, v] = edges(self);
        Edged::new(self[0], u, v)
    }
    fn points(&self, rays: [V8; 2], _distance: X8, reach: f32) -> Points {
        on_plane(self.plane().unwrap_or_default(), rays, reach)
    }
    fn vectors(&self) -> [[f32; 3]; 3] {
        let [a, b, c] = *self;
        let edge = |to: [f32; 3]| std::array::from_fn(|k| to[k] - a[k]);
        [a, edge(b), edge(c)]
    }
    fn extent([p, u, v]: [Vec3<f64>; 3]) -> Extent {
        let center = p + (u + v) * (1.0 / 3.0);
        let corners = [p, p + u, p + v];
        let radius = corners.into_iter().map(|c| (c - center).length()).fold(0.0, f64::max);
        Extent { center, radius, normal: u.cross(v) }
    }
    #[inline]
    fn sample<D: From<LightSample<X8>>>(vectors: [V8; 3], measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
        let light = light(vectors);
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn pdf(&self, _spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
        light(self.vectors().map(V8::from)).by_solid_angle(p).pdf_of_hit(w)
    }
    #[inline]
    fn coordinates(&self, point: V8) -> Vec2<X8> {
        let [u, v] = edges(self);
        coordinates(self[0], u, v, point)
    }
    fn sample_picture(
        &self,
        picture: &Picture<'_>,
        _axes: &[[f32; 3]; 3],
        measure: Measure,
        place: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        sample_picture(picture, light(self.vectors().map(V8::from)), measure, place, u)
    }
    fn pdf_of_picture(&self, picture: &Picture<'_>, _axes: &[[f32; 3]; 3], p: V8, w: V8) -> X8 {
        picture.on(light(self.vectors().map(V8::from))).by_solid_angle(p).pdf(w)
    }
    fn outline(&self) -> Occluder<'static> {
        Occluder::Whole(Solid::triangle(self.map(wide)))
    }
}
