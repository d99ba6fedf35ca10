//! What a choice of lights needs to know of a light.

use crate::real::Real;
use crate::vector::Vec3;
use core::f64::consts::PI;

/// A bound of what a light of finite extent can contribute.
///
/// The method `bound` of each light returns it for a radiance, or an intensity, in any unit. Radii are rounded up, so that the sphere holds
/// the light in spite of the rounding of its centre. Powers are kept within the positive numbers of single precision; a scene whose extent is
/// beyond 1e±15 needs a unit for its radiance in which they do not reach the ends.
///
/// ```
/// use etendue::{SpotLight, Triangle, Vec3, select::LightBound};
/// let triangle = Triangle::new([0.0; 3].into(), [3.0, 0.0, 0.0].into(), [0.0, 3.0, 0.0_f32].into());
/// let bound = LightBound { two_sided: true, ..triangle.bound(2.0) };
/// assert_eq!((bound.center, bound.normal), ([1.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
/// assert!(bound.radius >= 5_f32.sqrt() && bound.radius < 2.2361);
/// assert!((bound.power / (4.5 * 2.0 * std::f32::consts::PI) - 1.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct LightBound {
    /// Centre of a sphere around the light, in the coordinates of the scene. A flat light is centred on it.
    pub center: [f32; 3],
    /// Radius of that sphere, not negative; 0 for a point or spot light.
    pub radius: f32,
    /// Unit normal of a flat light, or axis of a spot light; 0 for a light that emits in all directions, such as a sphere or a point.
    pub normal: [f32; 3],
    /// Cosine of the angle to `normal` from which on a spot light, or a flat light that emits within a cone, is dark, less a rounding; 0 for other
    /// lights. A light that emits beyond a hemisphere has the normal 0.
    pub cos_cone: f32,
    /// Whether a flat light emits from both sides.
    pub two_sided: bool,
    /// Power of one side of a flat light, or of all of another light, in any unit.
    pub power: f32,
}

pub(super) fn wide<R: Real>(v: Vec3<R>) -> Vec3<f64> {
    v.map(|x| x.lane_f64(0))
}

pub(super) fn narrow(v: Vec3<f64>) -> [f32; 3] {
    v.map(|x| x as f32).to_array()
}

/// Rounds a flux to a positive number of single precision. The power of a dark light is 0.
pub(super) fn power(flux: f64) -> f32 {
    if flux > 0.0 { flux.clamped(f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX)) as f32 } else { 0.0 }
}

/// The least number of single precision that is not less.
fn outwards(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}

impl LightBound {
    /// Bounds a light that emits in all directions from a sphere, which may be a point.
    pub(crate) fn about(middle: Vec3<f64>, radius: f64, flux: f64) -> Self {
        let center = narrow(middle);
        // single precision may not have the place
        let moved = (middle - wide(Vec3::<f32>::from(center))).length().greater(0.0);
        Self { center, radius: outwards(radius + moved), power: power(flux), ..Self::default() }
    }
    /// Bounds a light by the sphere around these points of it, centred at `middle`. All are relative to the point `first`.
    pub(super) fn around(first: Vec3<f64>, points: &[Vec3<f64>], middle: Vec3<f64>) -> Self {
        let center = narrow(first + middle);
        // as it is rounded, which for a small and far light is not at its middle
        let moved = wide(Vec3::<f32>::from(center)) - first;
        let radius = points.iter().fold(0.0, |most: f64, point| most.greater((*point - moved).length()));
        // more than its own rounding
        Self { center, radius: outwards(radius * (1.0 + 1e-14)), ..Self::default() }
    }
    /// Bounds a flat convex light by its corners, which are relative to the first one, so that this is 0.
    pub(super) fn flat(first: Vec3<f64>, corners: &[Vec3<f64>], radiance: f64) -> Self {
        let (mut sum, mut area, mut middle) = (Vec3::default(), 0.0, Vec3::default());
        for pair in corners.windows(2) {
            let cross = pair[0].cross(pair[1]);
            let size = cross.unit_and_length().1;
            sum += cross;
            area += size;
            middle += (pair[0] + pair[1]) * (size / 3.0);
        }
        let middle = if area > 0.0 { middle / area } else { Vec3::default() };
        let normal = narrow(sum.unit_and_length().0);
        Self { normal, power: power(0.5 * area * PI * radiance), ..Self::around(first, corners, middle) }
    }
}
