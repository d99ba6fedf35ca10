//! How much of a light reaches a point, in double precision: every primitive is subtracted, and no certificate is asked.

use super::views::World;
use crate::occlusion::truth::{ENDS, from_point};
use etendue_oracle::visible::{Shape as Form, spared, visible};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::bvh::PrimitiveId;
use etendue_render::scene::{Geometry, Shape};

/// How far rounding in single precision moves the end of what is spared next to a light, as a fraction of it: some 2⁻²¹ of the way.
const MOVED: f64 = 1.0;

/// Rounding of the truth as a fraction of the angle around a light: some eight terms of 2⁻⁵³ each; and the greatest fraction of the light
/// that it may be, a hundredth of the error that is looked for.
const BLURRED: f64 = 1e-15;
const KNOWN: f64 = 1e-7;

/// Projected solid angles of a light at a point.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Truth {
    /// If nothing occluded the light.
    pub(crate) all: f64,
    /// The angle around the light.
    pub(crate) around: f64,
    /// `None` where no closed form is known (spheres overlap), where double precision does not know so little of a light, and where rounding
    /// decides: which primitives are before the spared end, or on which side of a primitive next to it the point is.
    pub(crate) left: Option<f64>,
}

/// Directions within an angle of an axis, as seen from a point.
#[derive(Clone, Copy)]
struct Cone {
    axis: V3,
    angle: f64,
}

impl Cone {
    fn around(form: &Form) -> Self {
        let (center, radius) = match form {
            Form::Sphere(center, radius) => (*center, *radius),
            Form::Polygon(corners) => {
                let center = corners.iter().fold([0.0; 3], |sum, &v| along(sum, v, 1.0 / corners.len() as f64));
                (center, corners.iter().map(|&v| length(sub(v, center))).fold(0.0, f64::max) * (1.0 + 1e-9))
            }
        };
        let sine = radius / length(center);
        Self { axis: unit(center), angle: if sine < 1.0 { sine.asin() } else { 4.0 } }
    }
    fn is_apart_from(&self, other: &Self) -> bool {
        // the angle from the chord, which keeps its digits
        let between = 2.0 * (0.5 * length(sub(self.axis, other.axis))).min(1.0).asin();
        between > (self.angle + other.angle) * (1.0 + 1e-9) + 1e-14
    }
}

/// A shape relative to a point.
fn relative(geometry: &Geometry, p: V3) -> Form {
    from_point(&geometry.outline().solid(), p).swap_remove(0)
}

/// Does a light emit towards the origin?
fn emits(light: &Shape, form: &Form) -> bool {
    let two_sided = light.emission.as_ref().is_some_and(|emission| emission.two_sided);
    match form {
        Form::Sphere(center, radius) => length(*center) > *radius,
        Form::Polygon(corners) => {
            let normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
            let height = dot(normal, corners[0]);
            height < 0.0 || two_sided && height > 0.0
        }
    }
}

/// Is the origin on a triangle, up to the rounding of points?
fn touches(corners: &[V3], rounding: f64) -> bool {
    let normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
    let is_beside = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        dot(unit(cross(normal, sub(b, a))), a) > rounding
    };
    dot(normal, corners[0]).abs() <= rounding && !(0..3).any(is_beside)
}

impl World {
    /// What reaches a point with a normal on the primitive `receiver`, from a light.
    pub(crate) fn truth(&self, p: V3, normal: V3, receiver: PrimitiveId, light: u32) -> Truth {
        let shape = &self.scene.shapes[light as usize];
        let form = relative(&shape.geometry, p);
        if !emits(shape, &form) {
            return Truth { left: Some(0.0), ..Truth::default() };
        }
        let ends = spared(&form, p, ENDS);
        let Some(lit) = visible(&form, &[], normal, ends) else { return Truth::default() };
        // below the horizon, rounding is left
        if lit.all <= 1e-14 * lit.around {
            return Truth { left: Some(0.0), ..Truth::default() };
        }
        let unknown = Truth { all: lit.all, around: lit.around, left: None };
        // sums cancel in small and far lights, and where the horizon leaves a sliver
        if BLURRED * lit.around > KNOWN * lit.all {
            return unknown;
        }
        let cone = Cone::around(&form);
        let mut occluders = Vec::new();
        let rounding = 3e-7 * p.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let own = receiver.triangle().map(|place| self.surfaces.bvh.order()[place as usize]);
        for (_, triangle) in (0..).zip(&self.scene.triangles).filter(|(id, _)| Some(*id) != own) {
            if touches(&triangle.map(|v| sub(wide(v), p)), rounding) {
                return unknown;
            }
            let triangle = relative(&Geometry::Triangle(*triangle), p);
            if !Cone::around(&triangle).is_apart_from(&cone) {
                occluders.push(triangle);
            }
        }
        let shapes = (0_u32..).zip(self.scene.shapes.iter());
        for (_, shape) in shapes.filter(|(id, _)| PrimitiveId::of_shape(*id) != receiver && *id != light) {
            let other = relative(&shape.geometry, p);
            if let Form::Sphere(center, radius) = other {
                let distance = length(center);
                if (distance - radius).abs() < 1e-6 * radius {
                    return unknown;
                }
                if distance < radius {
                    let [nearest, farthest] = match &form {
                        Form::Sphere(to, size_of) => {
                            let between = length(sub(*to, center));
                            [between - size_of, between + size_of]
                        }
                        Form::Polygon(corners) => {
                            let far = corners.iter().map(|&v| length(sub(v, center))).fold(0.0, f64::max);
                            let middle =
                                corners.iter().fold([0.0; 3], |sum, &v| along(sum, v, 1.0 / corners.len() as f64));
                            let extent = corners.iter().map(|&v| length(sub(v, middle))).fold(0.0, f64::max);
                            [length(sub(middle, center)) - extent, far]
                        }
                    };
                    match () {
                        () if farthest < radius => continue,
                        () if nearest > radius * (1.0 + 4.0 * ends) => {
                            return Truth { left: Some(0.0), ..unknown };
                        }
                        () => return unknown,
                    }
                }
            }
            if !Cone::around(&other).is_apart_from(&cone) {
                occluders.push(other);
            }
        }
        let at = |spared: f64| Some(visible(&form, &occluders, normal, spared)?.left.clamp(0.0, lit.all));
        let [short, long] = [1.0 - MOVED, 1.0 + MOVED].map(|share| at(share * ends));
        let left = short.zip(long).filter(|(short, long)| (short - long).abs() <= 1e-6 * lit.all);
        Truth { left: left.map(|(short, long)| 0.5 * (short + long)), ..unknown }
    }
}
