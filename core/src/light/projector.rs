//! Images that a light projects through a pinhole.

use crate::discrete::{PiecewiseConstant2d, TableError};
use crate::real::{GREATEST, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// A light that projects a rectangular image through a pinhole, as a slide projector does.
///
/// Directions are those in which light travels, in the space of the projector: +z is the axis, +x the right and +y the upper edge of the
/// image. Positions in the image run from the upper left corner. A host turns directions into this space, looks its image up at
/// [`place`](Self::place), and samples the light by [`PointLight::by_profile`](super::PointLight::by_profile). A [`ProjectedImage`] samples
/// what it emits.
///
/// - Formula: u = (1 + x/(z tₓ))/2 and v = (1 − y/(z tᵧ))/2, with tₓ and tᵧ the tangents of half the angles of view.
/// - Domain: tangents > 0.
/// - Degenerate: a direction that misses the image, one with z ≤ 0, and a tangent that is not greater than 0 give `None` or a mask that is
///   false.
/// - Greatest error: 2e−7 of the image, times 1/cos of the angle to the axis.
///
/// ```
/// use etendue::{Vec3, light::Projector};
/// let slide = Projector { tan_half: [1.0, 0.5] };
/// let (uv, inside) = slide.place(Vec3::new(0.5_f32, 0.25, 1.0).normalize());
/// assert!(inside && (uv.x - 0.75).abs() < 1e-6 && (uv.y - 0.25).abs() < 1e-6);
/// assert!(!slide.place(Vec3::new(0.0_f32, 0.0, -1.0)).1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projector {
    /// Tangents of half the horizontal and vertical angle of view, greater than 0.
    pub tan_half: [f32; 2],
}

impl Projector {
    #[inline(always)]
    fn tangents<R: Real>(&self) -> [R; 2] {
        self.tan_half.map(|t| R::lit(f64::from(t)))
    }
    /// Position in the image of the unit direction `w`, in [0, 1)², and whether it is there. Where it is not, the position is 0.
    #[inline(always)]
    pub fn place<R: Real>(&self, w: Vec3<R>) -> (Vec2<R>, R::Mask) {
        Self::place_by(self.tangents(), w)
    }
    /// The same for tangents of half the angles of view that may differ by lane.
    #[inline(always)]
    pub fn place_by<R: Real>(tan_half: [R; 2], w: Vec3<R>) -> (Vec2<R>, R::Mask) {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let [across, up] = tan_half.map(|t| t * w.z);
        // compared before it is divided: nothing overflows
        let inside = across.gt(zero) & up.gt(zero) & w.x.ge(-across) & w.x.lt(across) & w.y.gt(-up) & w.y.le(up);
        let part =
            |x: R, reach: R| (x / R::blend(inside, reach, one)).mul_add(half, half).clamped(zero, R::ONE_MINUS_EPSILON);
        let (u, v) = (part(w.x, across), part(-w.y, up));
        (Vec2::new(u.keep(inside), v.keep(inside)), inside)
    }
    /// The unit direction in which the light of a position in the image travels.
    #[inline(always)]
    pub fn direction<R: Real>(&self, uv: Vec2<R>) -> Vec3<R> {
        Self::direction_by(self.tangents(), uv)
    }
    /// The same for tangents of half the angles of view that may differ by lane.
    #[inline(always)]
    pub fn direction_by<R: Real>([across, up]: [R; 2], uv: Vec2<R>) -> Vec3<R> {
        let (one, two) = (R::lit(1.0), R::lit(2.0));
        Vec3::new(two.mul_add(uv.x, -one) * across, -two.mul_add(uv.y, -one) * up, one).normalize()
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
        solid_angle.greater(f64::MIN_POSITIVE)
    }
}

/// What a [`Projector`] emits of an image, for light tracing: a texel by its weight times its solid angle, and in the texel uniform in the
/// plane of the image. If the weight is the intensity, samples of small texels are worth almost the same.
///
/// - Formula: [`PiecewiseConstant2d`] over the texels. A direction at the angle θ to the axis has du dv = dω/(4 tₓ tᵧ cos³θ).
/// - Domain: u in [0, 1)²; any image of 1 to 2²⁴ columns and rows; finite weights ≥ 0, of any unit.
/// - Density: probability of the texel times the number of texels, over 4 tₓ tᵧ cos³θ, per steradian; 0 where the weight is 0, and outside
///   the image. Every texel with a weight can be drawn.
/// - Degenerate: no weight at all is an error when the table is built.
/// - Greatest error: direction 3e−7; pdf 1e−6 relative to that of the texel in which the direction is found, which may be the neighbour
///   for the 3e−7 next to an edge.
/// - Source: PBR 4th ed., 12.2.2, with the exact solid angles of texels.
///
/// ```
/// use etendue::light::{ProjectedImage, Projector};
/// use etendue::{Vec2, Warp};
/// let slide = Projector { tan_half: [1.0, 0.5] };
/// let mut buffer = [0.0; ProjectedImage::buffer(2, 1)];
/// let emission = ProjectedImage::build(slide, &[0.0, 3.0], 2, &mut buffer)?;
/// let w = emission.sample(Vec2::new(0.3_f32, 0.6));
/// // only the right half emits
/// assert!(w.x > 0.0 && emission.pdf(w) > 0.0);
/// # Ok::<(), etendue::discrete::TableError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ProjectedImage<'a> {
    projector: Projector,
    table: PiecewiseConstant2d<'a>,
}

impl<'a> ProjectedImage<'a> {
    /// Length of the buffer for w × h texels.
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        PiecewiseConstant2d::buffer(width, height)
    }
    /// Builds the table in the caller's buffer, of [`buffer`](Self::buffer) entries, from a weight per steradian for each texel, row by row.
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0.
    pub fn build(
        projector: Projector,
        weights: &[f32],
        width: usize,
        buffer: &'a mut [f32],
    ) -> Result<Self, TableError> {
        let size = [width, weights.len().checked_div(width).unwrap_or(0)];
        let solid_angle = |x: usize, y: usize| projector.texel_solid_angle(size, [x, y]);
        let table = PiecewiseConstant2d::build_by_cells(weights, width, solid_angle, buffer)?;
        Ok(Self { projector, table })
    }
    /// The image whose table [`build`](Self::build) has left in the buffer, for the same projector.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a table with so many columns.
    pub fn from_buffer(projector: Projector, buffer: &'a [f32], width: usize) -> Result<Self, TableError> {
        Ok(Self { projector, table: PiecewiseConstant2d::from_buffer(buffer, width)? })
    }
}

/// Directions in proportion to the weights.
impl<R: Real> Warp<R> for ProjectedImage<'_> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.projector.direction(self.table.sample(u))
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let (uv, inside) = self.projector.place(w);
        let [across, up] = self.projector.tangents::<R>();
        let area = R::lit(4.0) * across * up * (w.z * w.z * w.z);
        let pdf = self.table.pdf(uv) / R::blend(inside & area.gt(R::lit(0.0)), area, R::lit(1.0));
        pdf.lesser(R::lit(GREATEST)).keep(inside)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.table.invert(self.projector.place(w).0)
    }
}
