//! The one table of tolerances, each with its reason.

/// Half the distance from 1 to the next f32: the rounding of one operation.
pub const ULP: f64 = 1.0 / 16_777_216.0;
/// [`ULP`] where a sum of rounded terms is compared, and a quarter more in builds that round each product and sum twice: the most measured
/// is 1.17 times what others need.
pub const ROUNDING: f64 = if etendue::real::SAME_BITS { ULP } else { 1.25 * ULP };
/// Half the distance from 1 to the next f64.
pub const ULP_F64: f64 = 1.0 / 9_007_199_254_740_992.0;
/// Probability at which a statistical test fails. Seeds are fixed, so a test fails always or never; with about 1000 tests in the suite, the
/// probability that correct code is rejected is 0.1 %, once, when the test is written.
pub const SIGNIFICANCE: f64 = 1e-6;
/// How far a point may seem to lie beyond the farthest vertex of a flat shape, in units of [`ULP`]: both its distance and its direction are
/// rounded.
pub const REACH: f64 = 8.0;
/// Truncation error of the five-point derivative with steps of 1e−3, for maps whose fifth derivative is below 1e5 times the first.
pub const JACOBIAN: f64 = 1e-5;
/// Error over the whole square of adaptive quadrature to 1e−9 per cell.
pub const QUADRATURE: f64 = 2e-8;
/// Least diameter of a shape whose f32 samples are binned, in units of the granularity: the rounding of a direction is then at most 1e−3 of
/// the width of a bin.
pub const RESOLVED: f64 = 1e-3;

/// Greatest errors of a warp, in units of [`ULP`] (of [`ULP_F64`] for the f64 code). Each is the greatest error measured over the regimes,
/// rounded up.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Error of the point, f32 against f64; multiplied by the shape's granularity.
    pub point: f64,
    /// Further error of the point, in steps of 2⁻²⁴ in `u`: for shapes where the rounding of Ω and u₀Ω matters that much.
    pub steps: f64,
    /// Error of the distance, f32 against f64, relative. As many steps of `u` as the point may move by are allowed besides, but at least 4,
    /// because a sphere's distance has infinite slope at its limb.
    pub distance: f64,
    /// Error of the pdf against the true one, relative; multiplied by the shape's condition.
    pub pdf: f64,
    /// Error of the inverse, as the distance to the point for which the returned `u` is exact; multiplied by the granularity.
    pub round_trip: f64,
}

/// The product of a square root and a sine errs by 0.5 + 0.7 + 0.5 units, two coordinates by √2 times that. Fuzzing found at most 2.43, and
/// 1.02 for the inverse.
pub const DISK: Tolerance = Tolerance { point: 2.5, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 1.2 };
/// Two products; the inverse has a sum and a quotient.
pub const AREA_TRIANGLE: Tolerance = Tolerance { point: 2.0, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 1.0 };
/// Two products with a root and a sum of sine and cosine each; the inverse has two roots and an arc tangent.
pub const OCTAHEDRAL: Tolerance = Tolerance { point: 4.0, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 4.0 };
/// Like the disk, with a third coordinate. The inverse has 1−cosθ of rounded coordinates. Fuzzing found at most 4.1 units for the inverse,
/// and 3.013 for the point.
pub const CONE: Tolerance = Tolerance { point: 3.02, steps: 0.0, distance: 0.0, pdf: 2.0, round_trip: 5.0 };
/// Two linear densities; x is drawn from the density at the rounded y, which moves it as much as these steps of u would.
pub const BILINEAR: Tolerance = Tolerance { point: 6.0, steps: 4.0, distance: 0.0, pdf: 8.0, round_trip: 6.0 };
/// A cone; a sum that is short where a grazing view sees normals turned away from it (a step of u turns the normal there as much as
/// rounding does); and a stretch.
pub const VISIBLE_NORMALS: Tolerance = Tolerance { point: 8.0, steps: 4.0, distance: 0.0, pdf: 8.0, round_trip: 8.0 };
/// Like the cone.
pub const COSINE: Tolerance = Tolerance { point: 3.0, steps: 0.0, distance: 0.0, pdf: 2.0, round_trip: 2.5 };
/// A cone in a frame that is orthonormal to 4 units. The pdf has two squares, two quotients, a root and a sum. Fuzzing found at most 7.3
/// units for the point, 4.1 for the pdf and 7.1 for the inverse, with the viewpoint almost on the sphere.
pub const CAP: Tolerance = Tolerance { point: 8.0, steps: 0.0, distance: 6.0, pdf: 5.0, round_trip: 8.0 };
/// Like the cap, in a frame about the normal. The inverted area is a sum of a dozen rounded terms; near the horizon, where z is a square
/// root, its error amounts to 4 steps of u. A lune's errors are multiplied by 1/sin²ω: the segments of circle and ellipse whose difference
/// it is are nearly equal when the axis is far below the horizon.
pub const PROJECTED_CAP: Tolerance = Tolerance { point: 7.0, steps: 4.0, distance: 8.0, pdf: 5.0, round_trip: 8.0 };
/// A tangent and an arc of a dozen roundings each; multiplied by 1/sin of the angle between vertices that are nearly opposite, and for
/// inverses by the aspect. The tests' regimes stay below 9 units. Fuzzing found at most 12, at the far corner of a thin triangle, and 14
/// for a distance near a hemisphere. The tolerances are twice these, and a seventh of the error that a direction may have, 1e−5 of the
/// shape's size. The pdf has three reciprocal lengths of three roundings each, four products, an arc tangent and a quotient: √17 roundings.
pub const TRIANGLE: Tolerance = Tolerance { point: 24.0, steps: 0.0, distance: 28.0, pdf: 4.0, round_trip: 24.0 };
/// Like the triangle: it consists of two.
pub const PARALLELOGRAM: Tolerance = TRIANGLE;
/// Like the triangle, except that x follows from u₀Ω, where both Ω and the product are rounded: these steps apply everywhere. Ω is computed
/// from the edges' lengths, which are roots. Fuzzing found at most 9.8 units for the point and 4.2 for the pdf.
pub const RECTANGLE: Tolerance = Tolerance { point: 10.0, steps: 8.0, distance: 10.0, pdf: 5.0, round_trip: 10.0 };
/// Like the triangle: it consists of four, and a sum is as accurate as its terms. u₀Ω less the sum of the preceding triangles is as
/// accurate as two sums of solid angles: twice the pdf's units, in steps of u.
pub const POLYGON: Tolerance = Tolerance { point: 10.0, steps: 0.0, distance: 9.0, pdf: 4.0, round_trip: 10.0 };
/// Like the triangle. Newton's method finds the azimuth to 1e−7 relative to its own size, from areas accurate to a few units times their
/// condition: these steps apply everywhere. In addition to the triangle's roundings, an area has two arc tangents and a quadrature. The
/// tests' regimes stay below 7 units, except for two at 10 (a sliver, and a light 30 times as wide as it is distant); fuzzing found at most
/// 13.4.
pub const PROJECTED_POLYGON: Tolerance =
    Tolerance { point: 15.0, steps: 8.0, distance: 28.0, pdf: 12.0, round_trip: 24.0 };
/// A cross product, an arc tangent, a sine and a frame; the point is the direction times up to 2. Fuzzing found at most 9.75 units for the
/// point. Of the pdf, the arc tangent errs by 3.5 units, the length of the cross product by 2, and the quotient by 1.
pub const SEGMENT: Tolerance = Tolerance { point: 9.8, steps: 0.0, distance: 8.0, pdf: 6.5, round_trip: 8.0 };
/// Like [`SEGMENT`]. The inverted irradiance is a sum of three terms: 4 steps, as for the projected cap.
pub const PROJECTED_SEGMENT: Tolerance = Tolerance { steps: 4.0, ..SEGMENT };
/// The half-angles are roots of a dozen roundings; the solid angle is a product with a sum of 20 terms. The inverted integral is such a sum
/// too: 4 steps. Fuzzing found at most 7.3 units for the pdf, of a disk that is seen nearly edge-on, and 8.1 for the inverse.
pub const SPHERICAL_DISK: Tolerance = Tolerance { point: 4.0, steps: 4.0, distance: 4.0, pdf: 7.5, round_trip: 9.0 };
/// A frame and a sum; coordinates are rounded relative to their size: 3 ulp. Fuzzing found at most 5.1 units. The pdf has a length, two
/// products and a quotient; fuzzing found at most 4.2.
pub const SURFACE: Tolerance = Tolerance { point: 6.0, steps: 0.0, distance: 0.0, pdf: 5.0, round_trip: 8.0 };
/// A bilinear density with its steps, and a sum; the inverse is the root of a quadratic equation. Fuzzing found at most 8.06 units for the
/// pdf.
pub const PATCH: Tolerance = Tolerance { point: 4.0, steps: 6.0, distance: 0.0, pdf: 8.1, round_trip: 8.0 };
/// Steps for a flat shape that covers more than a quarter of the sphere: near the far edge and vertex the map turns by 1/(height over the
/// plane) per unit of area, and Ω is accurate to 4 units.
pub const NEAR_HEMISPHERE_STEPS: f64 = 8.0;
