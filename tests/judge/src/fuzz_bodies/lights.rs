//! Lights.

use super::{Input, scalable};
use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::packets;
use crate::techniques::{self, LightFixture};
use etendue::{
    ConstantEnvironment, DirectionalLight, LightSample, LightSampler, PointLight, Real, SpotLight, Sun, Vec3,
};
use etendue_oracle::{V3, cross, dot, length, sub, wide};

macro_rules! area_lights {
    ($($target:ident: $shape:ident;)+) => {$(
        pub(super) fn $target(input: &mut Input<'_>) {
            area_light(LightShape::$shape, input);
        }
    )+};
}
area_lights! {
    sphere_light: Sphere;
    triangle_light: Triangle;
    parallelogram_light: Parallelogram;
    rectangle_light: Rectangle;
    disk_light: Disk;
    polygon_light: Polygon;
    patch_light: Patch;
    line_light: Line;
}

/// A shape by any of its techniques: packets of eight that mix two lights.
fn area_light(shape: LightShape, input: &mut Input<'_>) {
    let techniques: Vec<_> = AreaLight::KINDS.iter().filter(|kind| kind.0 == shape).collect();
    let by = techniques[input.below(techniques.len() as u8) as usize].1;
    let mut one = || {
        let p = input.vector(&[]);
        let a = input.vector(&[p]);
        // normals are unit vectors
        let b = if shape.has_normal() { input.direction() } else { input.vector(&[a, p]) };
        let c = input.vector(&[a, b]);
        let n = if shape == LightShape::Patch { input.vector(&[b, c]) } else { input.direction() };
        (AreaLight { shape, by, p, a, b, c, n, radius: input.number() }, input.square())
    };
    let (first, second) = (one(), one());
    let pick = |i: usize| if i % 3 == 1 { second } else { first };
    techniques::any_bits(&core::array::from_fn(|i| pick(i).0), &core::array::from_fn(|i| pick(i).1));
    let (light, u) = first;
    techniques::measure(&light, u);
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
        techniques::scale(&light, u);
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
        techniques::one_pdf(&near, u);
    }
}

/// A light without a surface.
#[derive(Clone, Copy, Debug)]
struct Distant {
    kind: u8,
    p: [f32; 3],
    a: [f32; 3],
    n: [f32; 3],
    x: f32,
    y: f32,
}
impl LightFixture for Distant {
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
        let of = |i: usize| lanes[i % lanes.len()];
        let vector = |pick: fn(&Self) -> [f32; 3]| -> Vec3<R> { packets::vectors_of(|i| pick(&of(i))) };
        let number = |pick: fn(&Self) -> f32| -> R { packets::lanes_of(|i| f64::from(pick(&of(i)))) };
        let (p, position, n) = (vector(|d| d.p), vector(|d| d.a), vector(|d| d.n));
        match lanes[0].kind {
            0 => Box::new(PointLight { position }.by_delta(p)),
            1 => {
                let (one_minus_cos_inner, one_minus_cos_outer) = (number(|d| d.x), number(|d| d.y));
                Box::new(SpotLight { position, axis: n, one_minus_cos_inner, one_minus_cos_outer }.by_delta(p))
            }
            2 => Box::new(DirectionalLight::new(n).by_delta()),
            3 => Box::new(Sun::new(n, number(|d| d.x)).by_solid_angle()),
            4 => Box::new(ConstantEnvironment.by_solid_angle()),
            _ => Box::new(ConstantEnvironment.by_projected_solid_angle(n)),
        }
    }
    /// Delta lights have no density.
    fn evaluated_to(&self, s: &LightSample<f32>) -> Option<f64> {
        (!s.delta).then_some(0.0)
    }
}

macro_rules! distant_lights {
    ($($target:ident: |$input:ident| $kind:expr;)+) => {$(
        pub(super) fn $target($input: &mut Input<'_>) {
            let kind = $kind;
            distant_light(kind, $input);
        }
    )+};
}
distant_lights! {
    point_light: |input| 0;
    spot_light: |input| 1;
    directional_light: |input| 2;
    sun_light: |input| 3;
    constant_light: |input| 4 + input.below(2);
}

/// Packets of eight that mix two lights of one kind.
fn distant_light(kind: u8, input: &mut Input<'_>) {
    let mut one = || {
        let (p, n) = (input.vector(&[]), input.direction());
        (Distant { kind, p, a: input.vector(&[p]), n, x: input.number(), y: input.number() }, input.square())
    };
    let (first, second) = (one(), one());
    let pick = |i: usize| if i % 3 == 1 { second } else { first };
    techniques::any_bits(&core::array::from_fn(|i| pick(i).0), &core::array::from_fn(|i| pick(i).1));
    techniques::one_pdf(&first.0, first.1);
}
