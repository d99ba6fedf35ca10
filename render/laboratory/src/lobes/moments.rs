//! The standard deviation of one sample, from integrals of its second moment.

use super::cell::Cell;
use super::quadrature::integrate;
use etendue::estimate::Heuristic;
use etendue::light::{
    ParallelogramByArea, ParallelogramByProjectedSolidAngle, ParallelogramByReflection, RectangleBySolidAngle,
};
use etendue::reflection::Reflection;
use etendue::warp::GgxVisibleNormals;
use etendue::{LightSampler, Parallelogram, Real, Rectangle, Vec3, Warp};
use etendue_oracle::{V3, along};

/// Names of the estimators, in the order of [`Moments::deviations`].
pub const METHODS: [&str; 7] = ["area", "solid angle", "projected", "BSDF", "MIS", "reflection", "fit + rest"];
/// Estimators that take one sample of the light.
pub const OF_LIGHT: [usize; 4] = [AREA, SOLID_ANGLE, PROJECTED, REFLECTION];
/// By area.
pub const AREA: usize = 0;
/// By solid angle.
pub const SOLID_ANGLE: usize = 1;
/// By projected solid angle.
pub const PROJECTED: usize = 2;
/// By visible normals.
pub const BSDF: usize = 3;
/// One sample by solid angle and one by visible normals, with the power heuristic.
pub const MIS: usize = 4;
/// By the fit of the lobe.
pub const REFLECTION: usize = 5;
/// The closed form of the fit, and the rest as [`MIS`].
pub const REST: usize = 6;
/// The heuristic of [`MIS`] and [`REST`], which is that of the renderer.
pub const HEURISTIC: Heuristic = Heuristic::POWER;

/// How many samples each estimator takes.
#[must_use]
pub const fn samples(method: usize) -> usize {
    if matches!(method, MIS | REST) { 2 } else { 1 }
}

/// The samplers of the library for a cell.
pub struct Samplers<R: Real> {
    /// By area.
    pub area: ParallelogramByArea<R>,
    /// By solid angle.
    pub solid_angle: RectangleBySolidAngle<R>,
    /// By projected solid angle.
    pub projected: ParallelogramByProjectedSolidAngle<R>,
    /// By visible normals.
    pub normals: GgxVisibleNormals<R>,
    /// By the fit of the lobe.
    pub by_reflection: ParallelogramByReflection<R>,
    /// The fit of the lobe.
    pub fit: Reflection<R>,
    /// Unit vector towards the viewer.
    pub view: Vec3<R>,
}

/// A vector of the library.
#[must_use]
pub fn vector<R: Real>([x, y, z]: V3) -> Vec3<R> {
    Vec3::new(R::lit(x), R::lit(y), R::lit(z))
}

impl<R: Real> Samplers<R> {
    /// Prepares all.
    #[must_use]
    pub fn new(cell: &Cell) -> Self {
        let [across, up] = cell.sides;
        let corner = along(along(cell.middle, across, -cell.half), up, -cell.half);
        // in this order it faces the surface
        let [corner, s, t] = [corner, up.map(|x| 2.0 * x * cell.half), across.map(|x| 2.0 * x * cell.half)].map(vector);
        let (light, origin, normal) = (Parallelogram::new(corner, s, t), Vec3::default(), vector([0.0, 0.0, 1.0]));
        let (view, alpha) = (vector(cell.view), R::lit(cell.alpha));
        let fit = Reflection::new(alpha, normal, view);
        Self {
            area: light.by_area(origin),
            solid_angle: Rectangle::new(corner, s, t).by_solid_angle(origin),
            projected: light.by_projected_solid_angle(origin, normal),
            normals: GgxVisibleNormals::new(alpha, alpha, view),
            by_reflection: light.by_reflection(origin, &fit),
            fit,
            view,
        }
    }
    /// Density of directions reflected about visible normals, per steradian.
    #[must_use]
    pub fn by_normals(&self, w: Vec3<R>) -> R {
        self.normals.reflected_pdf((w + self.view).normalize())
    }
}

/// What is known of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    /// The cell.
    pub cell: Cell,
    /// The reflected radiance, for a light of radiance 1.
    pub radiance: f64,
    /// The closed form of the fit, relative to [`radiance`](Self::radiance).
    pub closed: f64,
    /// Standard deviation of each estimator, relative to [`radiance`](Self::radiance).
    pub deviations: [f64; METHODS.len()],
}

impl Moments {
    /// Integrates over the part of the light that is above the horizon. The densities are those of the library's samplers in double
    /// precision.
    #[must_use]
    pub fn new(cell: &Cell) -> Self {
        let samplers = Samplers::<f64>::new(cell);
        let albedo = samplers.fit.albedo();
        let integrand = |x: f64, y: f64| {
            let (direction, solid_angle) = cell.direction(x, y);
            let (w, f) = (vector(direction), cell.reflected(direction));
            let pdfs = [
                samplers.area.pdf(w),
                samplers.solid_angle.pdf(w),
                samplers.projected.pdf(w),
                samplers.by_normals(w),
                samplers.by_reflection.pdf(w),
            ];
            let [area, light, projected, surface, reflection] =
                pdfs.map(|pdf| if pdf > 0.0 { f * f / pdf } else { 0.0 });
            let both = [pdfs[SOLID_ANGLE], pdfs[BSDF]];
            let weights = HEURISTIC.weights(both);
            // mean and second moment of both of the samples
            let combined = |value: f64| {
                let [a, b] = [0, 1].map(|k| weights[k] * value);
                let [squared_a, squared_b] = [a * a / both[0], b * b / both[1]];
                [a, b, squared_a, squared_b].map(|x| if x.is_finite() { x } else { 0.0 })
            };
            let rest = f - albedo * samplers.fit.pdf(w);
            let ([a, b, c, d], [e, g, h, i]) = (combined(f), combined(rest));
            [f, area, light, projected, surface, reflection, a, b, c, d, rest, e, g, h, i].map(|x| x * solid_angle)
        };
        let width = 0.5 * cell.alpha * cell.cos;
        let sums = integrate(&integrand, cell.above_horizon(), cell.mirrored(), width, 1e-8);
        let radiance = sums[0];
        let one = |square: f64| (square - radiance * radiance).max(0.0);
        let two = |[a, b, squared_a, squared_b]: [f64; 4]| (squared_a - a * a).max(0.0) + (squared_b - b * b).max(0.0);
        let mis = two([sums[6], sums[7], sums[8], sums[9]]);
        let rest = two([sums[11], sums[12], sums[13], sums[14]]);
        let [area, light, projected, surface, reflection] = [1, 2, 3, 4, 5].map(|k| one(sums[k]));
        let variances = [area, light, projected, surface, mis, reflection, rest];
        Self {
            cell: *cell,
            radiance,
            closed: 1.0 - sums[10] / radiance,
            deviations: variances.map(|variance| variance.sqrt() / radiance),
        }
    }
    /// The standard deviation of the mean of an estimator, relative to the radiance, for as many samples as two.
    #[must_use]
    pub fn of_two_samples(&self, method: usize) -> f64 {
        self.deviations[method] * (samples(method) as f64 / 2.0).sqrt()
    }
}
