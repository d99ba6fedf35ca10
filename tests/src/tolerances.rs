//! The one table of tolerances, each with its reason.

/// Half the distance from 1 to the next f32: the rounding of one operation.
pub const ULP: f64 = 1.0 / 16_777_216.0;
/// The same in double precision.
pub const ULP_F64: f64 = 1.0 / 9_007_199_254_740_992.0;
/// Probability at which a statistical test fails. Seeds are fixed, so that it fails always or never; with ~1000 tests in the suite a
/// good body is wrongly refused with a probability of 0.1 %, once, when the test is written.
pub const SIGNIFICANCE: f64 = 1e-6;
/// Truncation of the five-point derivative with steps of 1e−3, for maps whose fifth derivative is below 1e5 of the first.
pub const JACOBIAN: f64 = 1e-5;
/// What adaptive quadrature to 1e−9 a cell leaves over a square.
pub const QUADRATURE: f64 = 2e-8;
/// Least diameter, in units of the granularity, from which samples in f32 are binned: the rounding of a direction is then
/// 1e−3 of a bin's width.
pub const RESOLVED: f64 = 1e-3;

/// What a warp may be off by, in units of [`ULP`] (of [`ULP_F64`] for the f64 body).
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Point, f32 against f64; times the shape's granularity.
    pub point: f64,
    /// Distance, f32 against f64, relative.
    pub distance: f64,
    /// Density against truth, relative; times the shape's condition.
    pub density: f64,
    /// How far off a point may be for which the returned `u` is exact; times the granularity.
    pub round_trip: f64,
}

/// Disks.
pub const DISK: Tolerance = Tolerance { point: 2.0, distance: 0.0, density: 1.0, round_trip: 4.0 };
/// Barycentrics.
pub const AREA_TRIANGLE: Tolerance = Tolerance { point: 2.0, distance: 0.0, density: 1.0, round_trip: 4.0 };
/// Cones.
pub const CONE: Tolerance = Tolerance { point: 3.0, distance: 0.0, density: 4.0, round_trip: 6.0 };
/// Cosine hemisphere.
pub const COSINE: Tolerance = Tolerance { point: 3.0, distance: 0.0, density: 4.0, round_trip: 6.0 };
/// Spheres.
pub const CAP: Tolerance = Tolerance { point: 8.0, distance: 16.0, density: 8.0, round_trip: 12.0 };
/// Triangles.
pub const TRIANGLE: Tolerance = Tolerance { point: 16.0, distance: 32.0, density: 3.0, round_trip: 16.0 };
/// Parallelograms.
pub const PARALLELOGRAM: Tolerance = Tolerance { point: 16.0, distance: 32.0, density: 3.0, round_trip: 16.0 };
/// Rectangles.
pub const RECTANGLE: Tolerance = Tolerance { point: 16.0, distance: 32.0, density: 3.0, round_trip: 16.0 };
