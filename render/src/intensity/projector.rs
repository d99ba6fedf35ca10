//! Images that a light projects through a pinhole.

use crate::packet::{M8, V8, X8, select};
use etendue::{Real, Vec2};

/// A light that projects a rectangular image through a pinhole, as a slide projector does.
///
/// Directions are those in which light travels, in the space of the projector: +z is the axis, +x the right and +y the upper edge of the
/// image. Positions in the image run from the upper left corner.
///
/// - Formula: u = (1 + x/(z tₓ))/2 and v = (1 − y/(z tᵧ))/2, with tₓ and tᵧ the tangents of half the angles of view.
/// - Domain: tangents > 0.
/// - Degenerate: a direction that misses the image, one with z ≤ 0, and a tangent that is not greater than 0 give a mask that is false.
/// - Greatest error: 2e−7 of the image, times 1/cos of the angle to the axis.
///
/// ```
/// use etendue::{Mask, Vec3};
/// use etendue_render::intensity::Projector;
/// let slide = Projector { tan_half: [1.0, 0.5] };
/// let (uv, inside) = slide.place(Vec3::lit([0.5, 0.25, 1.0]).normalize());
/// let (u, v) = (uv.x.to_array()[0], uv.y.to_array()[0]);
/// assert!(inside.all() && (u - 0.75).abs() < 1e-6 && (v - 0.25).abs() < 1e-6);
/// assert!(!slide.place(Vec3::lit([0.0, 0.0, -1.0])).1.any());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projector {
    /// Tangents of half the horizontal and vertical angle of view, greater than 0.
    pub tan_half: [f32; 2],
}

impl Projector {
    /// Position in the image of the unit directions `w`, in [0, 1)², and whether it is there. Where it is not, the position is 0.
    pub fn place(&self, w: V8) -> (Vec2<X8>, M8) {
        let (zero, one, half) = (X8::lit(0.0), X8::lit(1.0), X8::lit(0.5));
        let [across, up] = self.tan_half.map(|t| X8::splat(t) * w.z);
        // compared before it is divided: nothing overflows
        let inside = across.gt(zero) & up.gt(zero) & w.x.ge(-across) & w.x.lt(across) & w.y.gt(-up) & w.y.le(up);
        let part = |x: X8, reach: X8| {
            Real::mul_add(x / select(inside, reach, one), half, half).clamped(zero, X8::ONE_MINUS_EPSILON)
        };
        let (u, v) = (part(w.x, across), part(-w.y, up));
        (Vec2::new(u.keep(inside), v.keep(inside)), inside)
    }
    /// A cosine of the angle to the axis from which on it is dark: that of the corners, less a rounding.
    #[must_use]
    pub fn cos_cone(&self) -> f32 {
        let [x, y] = self.tan_half.map(f64::from);
        (1.0 / Real::sqrt(1.0 + x * x + y * y) * (1.0 - 1e-6)) as f32
    }
    /// Solid angle of a texel of a w × h image, in steradians: exact to some 1e−16.
    #[must_use]
    pub fn texel_solid_angle(&self, [width, height]: [usize; 2], [x, y]: [usize; 2]) -> f64 {
        let edges = |i: usize, n: usize, tangent: f32| {
            [i, i + 1].map(|i| (2.0 * i as f64 / n as f64 - 1.0) * f64::from(tangent))
        };
        let [[left, right], [top, bottom]] = [edges(x, width, self.tan_half[0]), edges(y, height, self.tan_half[1])];
        // the solid angle of the rectangle from the axis to a corner
        let corner = |x: f64, y: f64| Real::atan2(x * y, Real::sqrt(1.0 + x * x + y * y));
        let solid_angle = corner(right, bottom) - corner(left, bottom) - corner(right, top) + corner(left, top);
        // a texel that rounding would take away keeps a chance
        solid_angle.max(f64::MIN_POSITIVE)
    }
}
