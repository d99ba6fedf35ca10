//! Triangles that emit: a record has a corner and the edges from there.

use super::chosen::{Chosen, projected};
use super::record::{Extent, LightRecord, wide};
use crate::geometry::Geometry;
use crate::packet::{V8, X8};
use crate::technique::Measure;
use etendue::light::Spread;
use etendue::{LightSample, LightSampler, Triangle, Vec2};

pub(super) const KIND: u32 = 1;

/// The vectors of a record.
pub(super) fn vectors(geometry: &Geometry) -> [[f32; 3]; 3] {
    let Geometry::Triangle([a, b, c]) = *geometry else { unreachable!("a triangle") };
    let edge = |to: [f32; 3]| std::array::from_fn(|k| to[k] - a[k]);
    [a, edge(b), edge(c)]
}

pub(super) fn extent(record: &LightRecord) -> Extent {
    let (p, u, v) = (wide(record.place), wide(record.first), wide(record.second));
    let center = p + (u + v) * (1.0 / 3.0);
    let corners = [p, p + u, p + v];
    let radius = corners.into_iter().map(|c| (c - center).length()).fold(0.0, f64::max);
    Extent { center, radius, normal: u.cross(v), cos_cone: 0.0 }
}

/// Samples triangles in all lanes.
#[inline]
pub(super) fn sample<D: From<LightSample<X8>>>(chosen: &Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
    let light = Triangle { v0: chosen.place, e1: chosen.first, e2: chosen.second };
    match measure {
        Measure::Area => light.by_area(p).sample(u).into(),
        Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
        Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
    }
}

/// A triangle as its record has it, in all lanes.
#[inline]
pub(super) fn splat(geometry: &Geometry) -> Triangle<X8> {
    let [corner, first, second] = vectors(geometry);
    Triangle { v0: corner.into(), e1: first.into(), e2: second.into() }
}

/// Pdf per steradian with which a triangle is sampled by solid angle in the direction `w`, in which it is hit.
#[inline]
pub(super) fn pdf(geometry: &Geometry, _spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
    splat(geometry).by_solid_angle(p).pdf_of_hit(w)
}
