//! The one table of tolerances, each with its reason.

/// Half the distance from 1 to the next f32: the rounding of one operation.
pub const ULP: f64 = 1.0 / 16_777_216.0;
/// The same in double precision.
pub const ULP_F64: f64 = 1.0 / 9_007_199_254_740_992.0;
/// Probability at which a statistical test fails. Seeds are fixed, so that it fails always or never; with ~1000 tests in the suite a
/// good body is wrongly refused with a probability of 0.1 %, once, when the test is written.
pub const SIGNIFICANCE: f64 = 1e-6;
/// How far beyond the farthest vertex of a flat shape a point may seem to be: the length is rounded, and so is the direction.
pub const REACH: f64 = 8.0;
/// Truncation of the five-point derivative with steps of 1e−3, for maps whose fifth derivative is below 1e5 of the first.
pub const JACOBIAN: f64 = 1e-5;
/// What adaptive quadrature to 1e−9 a cell leaves over a square.
pub const QUADRATURE: f64 = 2e-8;
/// Least diameter, in units of the granularity, from which samples in f32 are binned: the rounding of a direction is then
/// 1e−3 of a bin's width.
pub const RESOLVED: f64 = 1e-3;

/// What a warp may be off by, in units of [`ULP`] (of [`ULP_F64`] for the f64 body): each figure is the greatest that was measured
/// over the domain, rounded up.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Point, f32 against f64; times the shape's granularity.
    pub point: f64,
    /// Besides, what so many steps of 2⁻²⁴ in `u` do to the point: for shapes where Ω and u₀Ω, which are rounded, decide that much.
    pub steps: f64,
    /// Distance, f32 against f64, relative; besides 4 steps, since a sphere's distance has an infinite slope at its limb, or as many
    /// as the point may move by.
    pub distance: f64,
    /// Density against truth, relative; times the shape's condition.
    pub pdf: f64,
    /// How far off a point may be for which the returned `u` is exact; times the granularity.
    pub round_trip: f64,
}

/// A product of a square root and a sine: 0.5 + 0.7 + 0.5 units, in two coordinates: √2 of that. Fuzzing has seen 2.43,
/// and 1.02 of the inverse.
pub const DISK: Tolerance = Tolerance { point: 2.5, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 1.2 };
/// Two products; the inverse has a sum and a quotient.
pub const AREA_TRIANGLE: Tolerance = Tolerance { point: 2.0, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 1.0 };
/// Two products with a root and a sum of sine and cosine each; the inverse has two roots and an arc tangent.
pub const OCTAHEDRAL: Tolerance = Tolerance { point: 4.0, steps: 0.0, distance: 0.0, pdf: 1.0, round_trip: 4.0 };
/// As the disk, with a third coordinate. The inverse has 1−cosθ of rounded coordinates; fuzzing has seen 4.1 units, and 3.013 of the point.
pub const CONE: Tolerance = Tolerance { point: 3.02, steps: 0.0, distance: 0.0, pdf: 2.0, round_trip: 5.0 };
/// A root of a sum of products, a sum and a quotient.
pub const LINEAR: Tolerance = Tolerance { point: 3.0, steps: 0.0, distance: 0.0, pdf: 4.0, round_trip: 3.0 };
/// A root, a sum and a quotient; the density has two quotients.
pub const TENT: Tolerance = Tolerance { point: 3.0, steps: 0.0, distance: 0.0, pdf: 4.0, round_trip: 3.0 };
/// A logarithm good to 1.3e−7 of up to 16.7 means; the exponential of the density takes back the rounding of its argument.
pub const EXPONENTIAL: Tolerance = Tolerance { point: 40.0, steps: 0.0, distance: 0.0, pdf: 4.0, round_trip: 40.0 };
/// A quantile good to 3.3e−7 of up to 5.42σ, and a sum.
pub const NORMAL: Tolerance = Tolerance { point: 30.0, steps: 0.0, distance: 0.0, pdf: 8.0, round_trip: 30.0 };
/// Two linear densities; x is drawn from the one at the rounded y, so that it moves as if u had moved by so many steps.
pub const BILINEAR: Tolerance = Tolerance { point: 6.0, steps: 4.0, distance: 0.0, pdf: 8.0, round_trip: 6.0 };
/// A cone, a sum that is short where a grazing view sees normals turned away from it (there a step of u turns the normal as much as
/// rounding does), and a stretch.
pub const VISIBLE_NORMALS: Tolerance = Tolerance { point: 8.0, steps: 4.0, distance: 0.0, pdf: 8.0, round_trip: 8.0 };
/// As the cone.
pub const COSINE: Tolerance = Tolerance { point: 3.0, steps: 0.0, distance: 0.0, pdf: 2.0, round_trip: 2.5 };
/// A cone in a frame that is orthonormal to 4 units. The density has two squares, two quotients, a root and a sum. Fuzzing has
/// seen 7.3 units of the point, 4.1 of the density and 7.1 of the inverse where the sphere is touched.
pub const CAP: Tolerance = Tolerance { point: 8.0, steps: 0.0, distance: 6.0, pdf: 5.0, round_trip: 8.0 };
/// As the cap, in a frame about the normal. An area that is inverted is a sum of a dozen rounded terms; near the horizon, where z is a
/// square root, that is worth 4 steps of u. For a lune times 1/sin²ω: the segments of circle and ellipse of which it is the
/// difference are alike when the axis is far below.
pub const PROJECTED_CAP: Tolerance = Tolerance { point: 7.0, steps: 4.0, distance: 8.0, pdf: 5.0, round_trip: 8.0 };
/// A tangent and an arc of a dozen roundings each; times 1/sin of vertices that lie nearly opposite, and for inverses the aspect. The tests'
/// regimes stay below 9 units; fuzzing has seen 12 at the far corner of a thin triangle and a distance off by 14 near a hemisphere: twice
/// that, and a seventh of the 1e−5 of its size that a direction may be off by. The density has three reciprocal lengths of three roundings
/// each, four products, an arc tangent and a quotient: √17 of them.
pub const TRIANGLE: Tolerance = Tolerance { point: 24.0, steps: 0.0, distance: 28.0, pdf: 4.0, round_trip: 24.0 };
/// As the triangle, of which it has two.
pub const PARALLELOGRAM: Tolerance = TRIANGLE;
/// As the triangle, but that x follows from u₀Ω, where both Ω and the product are rounded: everywhere, by so many steps. Ω has lengths for
/// edges, which are roots. Fuzzing has seen 9.8 units of the point and 4.2 of the density.
pub const RECTANGLE: Tolerance = Tolerance { point: 10.0, steps: 8.0, distance: 10.0, pdf: 5.0, round_trip: 10.0 };
/// As the triangle, of which it has four; a sum is known as its terms are. u₀Ω less the sum of those before is known as two sums of solid
/// angles are: in steps of u, twice the density's units.
pub const POLYGON: Tolerance = Tolerance { point: 10.0, steps: 0.0, distance: 9.0, pdf: 4.0, round_trip: 10.0 };
/// As the triangle; the azimuth is found by Newton's method to 1e−7 of itself, from areas that are known to a few units times their
/// condition: everywhere, by so many steps of u. Beside the triangle's roundings an area has two arc tangents and a quadrature. The tests'
/// regimes stay below 7 units but for two at 10 (a sliver, and a light 30 times its distance across); fuzzing has seen 13.4.
pub const PROJECTED_POLYGON: Tolerance =
    Tolerance { point: 15.0, steps: 8.0, distance: 28.0, pdf: 12.0, round_trip: 24.0 };
/// A cross product, an arc tangent, a sine and a frame; the point is the direction times up to 2. Fuzzing has seen 9.6 units of it, and 4.1 of
/// the density.
pub const SEGMENT: Tolerance = Tolerance { point: 9.7, steps: 0.0, distance: 8.0, pdf: 5.0, round_trip: 8.0 };
/// As that. An irradiance that is inverted is a sum of three terms: as for the projected cap, 4 steps.
pub const PROJECTED_SEGMENT: Tolerance = Tolerance { steps: 4.0, ..SEGMENT };
/// The half-angles are roots of a dozen roundings, the solid angle a product with a sum of 20 terms. The integral that is inverted is such a
/// sum: 4 steps. Fuzzing has seen 6.4 units of the density and 8.1 of the inverse.
pub const SPHERICAL_DISK: Tolerance = Tolerance { point: 4.0, steps: 4.0, distance: 4.0, pdf: 7.0, round_trip: 9.0 };
/// A frame and a sum; coordinates are rounded to their size: 3 ulp. Fuzzing has seen 5.1 units. The density has a length, two products and a
/// quotient; fuzzing has seen 4.2.
pub const SURFACE: Tolerance = Tolerance { point: 6.0, steps: 0.0, distance: 0.0, pdf: 5.0, round_trip: 8.0 };
/// A bilinear density, with its steps, and a sum; the inverse is a quadratic equation's root.
pub const PATCH: Tolerance = Tolerance { point: 4.0, steps: 6.0, distance: 0.0, pdf: 8.0, round_trip: 8.0 };
/// Steps where a flat shape covers more than a quarter of the sphere: near the far edge and vertex the map turns by 1/(height over the
/// plane) per unit of area, and Ω is known to 4 units.
pub const NEAR_HEMISPHERE_STEPS: f64 = 8.0;

/// Mean over a 1024² grid of a technique by solid angle, relative to the projected solid angle of the shape when it faces the receiver:
/// kinks at the horizon leave about n^(−3/2)/12 = 2.5e−6, the density's error 5e−7.
pub const GRID: f64 = 3e-6;
/// The same by area: the integrand has two more factors, cosθ' and 1/d², and half a sphere is cut off.
pub const GRID_AREA: f64 = 6e-6;
