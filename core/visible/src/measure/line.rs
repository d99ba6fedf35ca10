//! Edges of occluders, and how high a light is over the planes through them and a point.

use super::capacity::MOST;
use super::flat::two_words;
use super::outline::Outline;
use etendue::vector::{height_dw, sum_dw};
use etendue::{Mask, Real, Vec3};

/// The line of an edge of an occluder. The plane through it and the point has the normal (p₀ − x) × e, where p₀ is on the line and e along it.
pub(super) struct Line<R> {
    pub(super) from: Vec3<f64>,
    pub(super) edge: Vec3<f64>,
    /// The factors of p₀ − x and of e in the normal, and the product of their greatest coordinates times these.
    pub(super) scales: [R; 2],
    pub(super) reach: R,
}

impl<R: Real> Line<R> {
    /// The height of the base of a flat light over the plane.
    ///
    /// The light is clipped there to a fraction of its own size, however small that is for its distance: so this height needs twice the
    /// precision, and all that is measured from the base does not. It is (p₀ − x) · (e × (b − p₀)), where the second factor is the same for
    /// all points.
    #[inline]
    pub(super) fn height(
        &self,
        plane: Vec3<R>,
        light: &Outline<R, MOST>,
        (base, unit): (Vec3<f64>, R),
        point: Vec3<R>,
    ) -> R {
        let height = plane.dot(light.base());
        // more than the rounding of the normal, which is small for a point near the line
        let reserve = self.reach * R::lit(1e-5);
        let crosses = light.crosses(plane, height, reserve);
        if R::DOUBLE || !crosses.any() {
            return height;
        }
        let ahead = base - self.from;
        // their reciprocals fit single precision
        let most = f64::from(1.0 / f32::MIN_POSITIVE);
        let [long, far] = [self.edge, ahead].map(|v| v.max_abs().pow2_scale().clamp(1.0 / most, most));
        let [across, across_rest] = two_words::<R>((self.edge * long).cross(ahead * far));
        let [from, rest] = two_words::<R>(self.from);
        let [from, rest] = sum_dw([from, rest], [-point, Vec3::default()]).map(|v| v * self.scales[0]);
        let [sum, more] = height_dw(from, [across, across_rest]);
        // the factors together are near 1 where either is extreme
        let exact =
            (sum + (more + rest.dot(across))) * ((self.scales[1] * R::lit(1.0 / long)) * (unit * R::lit(1.0 / far)));
        R::blend(crosses, exact, height)
    }
}
