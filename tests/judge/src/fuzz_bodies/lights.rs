//! Lights by every technique.

use super::{Input, scalable};
use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::fixture::{Fixture, Subject, Truth};
use crate::packets::vectors_of;
use crate::properties;
use crate::tolerances::ULP;
use crate::truths::Round;
use etendue::{ConstantEnvironment, LightSampler, Real};
use etendue_oracle::{V3, cross, dot, length, sub, wide};

/// A shape by any of its techniques: packets of eight that mix two lights.
pub(super) fn area_light(shape: LightShape, input: &mut Input<'_>) {
    let techniques: Vec<_> = AreaLight::kinds().iter().filter(|kind| kind.0 == shape).collect();
    let by = techniques[input.below(techniques.len() as u8) as usize].1;
    let (light, u) = mixed(input, |input| {
        let p = input.vector(&[]);
        let a = input.vector(&[p]);
        // normals are unit vectors
        let b = if shape.has_normal() { input.direction() } else { input.vector(&[a, p]) };
        let c = input.vector(&[a, b]);
        let n = if shape == LightShape::Patch { input.vector(&[b, c]) } else { input.direction() };
        AreaLight { shape, by, p, a, b, c, n, radius: input.number() }
    });
    properties::measure(&light, &*AreaLight::prepare(&[light]), u);
    let AreaLight { p, a, b, c, n, radius, .. } = light;
    // the area of a shape is a square of lengths, and even smaller if the shape is slim
    let [e, f, g] = [b, c, n].map(wide);
    let roomy = |e: V3, f: V3| length(cross(e, f)) > 1e-18 + 1e-4 * length(e) * length(f);
    let spread = if shape == LightShape::Patch {
        // for a patch, at each of its four corners
        let [x, y] = [sub(g, e), sub(g, f)];
        roomy(e, f) && roomy(e, x) && roomy(f, y) && roomy(x, y)
    } else {
        length(cross(e, f)) == 0.0 || roomy(e, f)
    };
    if scalable(&[p, a, b, c, n].concat(), 1e6) && scalable(&[radius], 1e6) && spread {
        properties::scale_sample(&Subject::new(&light), u);
    }
    // at the scale of rooms, more properties hold
    let [p, a] = [[0.0; 3], input.vector(&[]).map(|x| x.clamp(-2.0, 2.0))];
    let [b, c, n] = [(); 3].map(|()| input.direction());
    let near = AreaLight { p, a, b, c, n, radius: input.unit(), ..light };
    // These edges are not perpendicular, as those of a rectangle have to be. A flat shape must be clearly out of the plane of the point;
    // most of all a polygon, whose corners are rounded, or a shape over a horizon.
    let [v, e, f] = [a, b, c].map(wide);
    let normal = if shape.has_normal() { e } else { cross(e, f) };
    let elevation = dot(v, normal).abs() / (length(v) * length(normal));
    let strict = by == Measure::ProjectedSolidAngle || shape == LightShape::Polygon;
    let flat =
        matches!(shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Polygon) || shape.has_normal();
    let lifted = elevation > 1e-3 && length(v) > 1e-3 && length(normal) > 1e-3;
    let fair = !flat || lifted && (!strict || elevation > 0.05 && length(v) > 0.05 && length(normal) > 0.05);
    if shape != LightShape::Rectangle && fair {
        properties::one_pdf(&near, &*AreaLight::prepare(&[near]), u);
    }
}
/// Packets of eight that mix two lights; returns the first.
fn mixed<S: Fixture>(input: &mut Input<'_>, any: impl Fn(&mut Input<'_>) -> S) -> (S, [f32; 2]) {
    let [first, second] = [(); 2].map(|()| (any(input), input.square()));
    let pick = |i: usize| if i % 3 == 1 { second } else { first };
    properties::any_bits_of(&core::array::from_fn(|i| pick(i).0), &core::array::from_fn(|i| pick(i).1));
    first
}

/// A delta light or a sun of any numbers.
pub(super) fn distant_light(shape: LightShape, by: Measure, input: &mut Input<'_>) {
    let (light, u) = mixed(input, |input| {
        let (p, b) = (input.vector(&[]), input.direction());
        let (a, c) = (input.vector(&[p]), [input.number(), 0.0, 0.0]);
        AreaLight { p, radius: input.number(), ..AreaLight::seen(shape, by, [a, b, c], b) }
    });
    properties::one_pdf(&light, &*AreaLight::prepare(&[light]), u);
}

/// The sky of one radiance, by solid angle, or by projected solid angle where there is a normal: the inside of a sphere.
#[derive(Clone, Copy, Debug)]
struct Everywhere(Option<[f32; 3]>);
impl Fixture for Everywhere {
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
        if lanes[0].0.is_none() {
            return Box::new(ConstantEnvironment.by_solid_angle());
        }
        let normals = vectors_of(|i| lanes[i % lanes.len()].0.unwrap_or_default());
        Box::new(ConstantEnvironment.by_projected_solid_angle(normals))
    }
    fn splat<R: Real>(&self) -> Box<dyn LightSampler<R>> {
        Self::prepare(&[*self])
    }
    fn truth(&self) -> Box<dyn Truth> {
        let center = [0.0; 3];
        Box::new(self.0.map_or_else(|| Round::sphere(center, 1.0), |n| Round::above(center, 1.0, n)))
    }
    fn lengths(&self) -> [f64; 2] {
        [1.0 - 12.0 * ULP, 1.0 + 12.0 * ULP]
    }
}
pub(super) fn constant_light(input: &mut Input<'_>) {
    let is_projected = input.below(2) == 1;
    let (sky, u) = mixed(input, |input| Everywhere(is_projected.then(|| input.direction())));
    // as exact as that of a sphere
    let sphere = AreaLight::seen(LightShape::Sphere, Measure::SolidAngle, [[0.0; 3]; 3], [0.0; 3]);
    properties::one_pdf(&sphere, &*Everywhere::prepare(&[sky]), u);
}
