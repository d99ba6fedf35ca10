//! Light from all around as an image tells it.

use super::distant::{distant, met};
use super::sample::{LightSample, TexelSample};
use super::sampler::LightSampler;
use crate::discrete::{PiecewiseConstant2d, TableError, locate, place};
use crate::math::atan2_turns;
use crate::real::{GREATEST, Real, unit_interval};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Octahedral, Warp};

const PI: f64 = core::f64::consts::PI;

/// How an image covers the sphere of directions. In both z is up and the first row of the image comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentMap {
    /// [`Octahedral`]: a square image whose texels all have the solid angle 4π/(wh), as in pbrt-v4. Columns are u₀, rows u₁.
    EqualArea,
    /// Longitude and latitude: columns are the azimuth from +x in [0, 2π), rows the angle from +z in [0, π].
    Equirectangular,
}

impl EnvironmentMap {
    /// Solid angle of a texel in row `y` of a w × h image, in steradians.
    #[must_use]
    pub fn texel_solid_angle(self, width: usize, height: usize, y: usize) -> f64 {
        match self {
            Self::EqualArea => 4.0 * PI / (width as f64 * height as f64),
            Self::Equirectangular => {
                // the difference of the cosines of its edges, as a product
                let middle = ((2 * y + 1) as f64 / (4 * height) as f64).sin_cos_turns().0;
                let half = (1.0 / (4 * height) as f64).sin_cos_turns().0;
                4.0 * PI / width as f64 * middle * half
            }
        }
    }
}

/// A texel of an environment, and a position in it.
#[derive(Clone, Copy, Debug)]
pub struct Texel<R: Real> {
    /// Column.
    pub x: R::Uint,
    /// Row.
    pub y: R::Uint,
    /// Position in [0, 1)²: uniform by solid angle, from the first column and row on.
    pub offset: Vec2<R>,
}

/// Light from all around, as an image tells it: a texel by its weight times its solid angle, and in the texel uniform by solid angle.
/// If the weight is the radiance, and that is constant in each texel, every sample of the sphere is worth the same.
///
/// - Formula: [`PiecewiseConstant2d`] over the texels; in an equirectangular one at heights z₁ > z₂ the azimuth is uniform, and z.
///   Distances from the pole, 1−z = 2sin²(θ/2), are what is computed: no texel is too near to a pole.
/// - Domain: u in [0, 1)²; any image of 1 to 2²⁴ columns and rows; finite weights ≥ 0, of any unit.
/// - Density: probability of the texel over its solid angle, per steradian; 0 where the weight is 0.
/// - Degenerate: no weight at all is an error when the table is built.
/// - Greatest error: direction 6e−7, besides half a step of u; pdf 5e−7 relative to probability over solid angle, with the
///   probability as drawn (see [`discrete`](crate::discrete)); in `invert(sample(u))` what so much of the direction is. A direction
///   within 6e−7 of an edge of its texel may be found in the neighbour: where that matters take the texel that comes with the sample.
/// - Source: PBR 4th ed., 12.5.2, but uniform by solid angle in each texel, so that no sine divides.
///
/// ```
/// use etendue::light::{EnvironmentMap, ImageEnvironment};
/// use etendue::{LightSampler, Vec2, Vec3};
/// // dark but for the quarter of the upper half that is next to +x, +y
/// let weights = [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let mut buffer = [0.0; ImageEnvironment::buffer(4, 2)];
/// let sky = ImageEnvironment::build(&weights, 4, EnvironmentMap::Equirectangular, &mut buffer).unwrap();
/// let s = sky.by_radiance().sample(Vec2::new(0.3_f32, 0.6));
/// assert!(s.direction.x > 0.0 && s.direction.y > 0.0 && s.direction.z > 0.0);
/// assert!((s.pdf * core::f32::consts::FRAC_PI_2 - 1.0).abs() < 1e-6);
/// assert_eq!(sky.by_radiance().pdf(Vec3::new(0.0_f32, -0.6, 0.8)), 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ImageEnvironment<'a> {
    table: PiecewiseConstant2d<'a>,
    map: EnvironmentMap,
}

/// A row of an equirectangular image, from the nearer pole.
struct Ring<R: Real> {
    /// 1 − |z| at the edge next to the pole.
    start: R,
    /// Its change to the other edge.
    height: R,
    /// Does the row belong to the lower pole?
    lower: R::Mask,
}

impl<'a> ImageEnvironment<'a> {
    /// Length of the buffer for w × h texels.
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        PiecewiseConstant2d::buffer(width, height)
    }
    /// Builds the table in the caller's buffer, of [`buffer`](Self::buffer) entries, from a weight per steradian for each texel, row by
    /// row: its luminance, or a sum of its channels.
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0.
    pub fn build(
        weights: &[f32],
        width: usize,
        map: EnvironmentMap,
        buffer: &'a mut [f32],
    ) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        let solid_angle = |y: usize| map.texel_solid_angle(width, height, y);
        Ok(Self { table: PiecewiseConstant2d::build_by_rows(weights, width, solid_angle, buffer)?, map })
    }
    /// The environment whose table [`build`](Self::build) has left in the buffer.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a table with so many columns.
    #[inline]
    pub fn from_buffer(buffer: &'a [f32], width: usize, map: EnvironmentMap) -> Result<Self, TableError> {
        Ok(Self { table: PiecewiseConstant2d::from_buffer(buffer, width)?, map })
    }
    /// Columns and rows.
    #[inline(always)]
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.table.size()
    }

    /// Directions in proportion to the weights, as a [`LightSampler`].
    #[inline(always)]
    #[must_use]
    pub const fn by_radiance(&self) -> ByRadiance<'a> {
        ByRadiance { environment: *self }
    }
    /// A direction in proportion to the weights, with its texel.
    #[inline(always)]
    pub fn draw<R: Real>(&self, u: Vec2<R>) -> TexelSample<R> {
        let cell = self.table.cell(u);
        let texel = Texel { x: cell.x, y: cell.y, offset: cell.offset };
        let pdf = self.texel_pdf(cell.pmf, cell.y);
        let uv = self.place(&texel);
        TexelSample { light: distant(self.direction(&texel), pdf, uv), x: cell.x, y: cell.y }
    }
    /// The pdf of a direction.
    #[inline(always)]
    fn pdf_of<R: Real>(&self, direction: Vec3<R>) -> R {
        let texel = self.texel(direction);
        self.texel_pdf(self.table.pmf(texel.x, texel.y), texel.y)
    }
    /// The `u` of a direction.
    #[inline(always)]
    fn inverse<R: Real>(&self, direction: Vec3<R>) -> Vec2<R> {
        let texel = self.texel(direction);
        self.table.invert_cell(texel.x, texel.y, texel.offset)
    }
    /// Columns and rows, as numbers.
    #[inline(always)]
    fn counts<R: Real>(&self) -> [R; 2] {
        self.size().map(|n| R::lit(n as f64))
    }
    /// Position of a texel in the image, in [0, 1]².
    #[inline(always)]
    fn place<R: Real>(&self, texel: &Texel<R>) -> Vec2<R> {
        let [w, h] = self.counts();
        Vec2::new(place(texel.x, texel.offset.x, w), place(texel.y, texel.offset.y, h))
    }
    /// The direction of a position in a texel.
    #[inline(always)]
    pub fn direction<R: Real>(&self, texel: &Texel<R>) -> Vec3<R> {
        match self.map {
            EnvironmentMap::EqualArea => Octahedral.sample(self.place(texel)),
            EnvironmentMap::Equirectangular => {
                let (one, two, [w, _]) = (R::lit(1.0), R::lit(2.0), self.counts());
                let ring: Ring<R> = self.ring(texel.y);
                let within = R::blend(ring.lower, one - texel.offset.y, texel.offset.y);
                let k = within.mul_add(ring.height, ring.start).lesser(two);
                let sin = (k * (two - k)).sqrt();
                let (s, c) = place(texel.x, texel.offset.x, w).sin_cos_turns();
                Vec3 { x: sin * c, y: sin * s, z: (one - k).negate_where(ring.lower) }
            }
        }
    }
    /// The texel of a direction.
    #[inline(always)]
    pub fn texel<R: Real>(&self, direction: Vec3<R>) -> Texel<R> {
        let [w, h] = self.counts();
        match self.map {
            EnvironmentMap::EqualArea => {
                let square = Octahedral.invert(direction);
                let ((x, column), (y, row)) = (locate(square.x, w), locate(square.y, h));
                Texel { x, y, offset: Vec2::new(column, row) }
            }
            EnvironmentMap::Equirectangular => {
                let (zero, one) = (R::lit(0.0), R::lit(1.0));
                let Vec3 { x, y, z } = direction;
                let square = x.mul_add(x, y * y);
                let below = z.lt(zero);
                // the angle to the nearer pole, in rows
                let rows = square.sqrt().atan2(z.abs()) * R::lit(1.0 / PI) * h;
                // of two rows in the middle, the upper one
                let [_, height] = self.size();
                let middle = R::lit(((height - 1) / 2) as f64);
                let near = R::from_uint(rows.clamped(zero, middle).to_uint());
                let row = R::blend(below, h - one - near, near).to_uint();
                let ring: Ring<R> = self.ring(row);
                // a middle row belongs to the upper pole as a whole: then 1 − z exceeds 1
                let tall = R::blend(below & !ring.lower, one - z, square / (one + z.abs()));
                let within = unit_interval((tall - ring.start) / ring.height);
                let offset = unit_interval(R::blend(ring.lower, one - within, within));
                let (x, column) = locate(atan2_turns(y, x), w);
                Texel { x, y: row, offset: Vec2::new(column, offset) }
            }
        }
    }

    /// Heights of a row of an equirectangular image: 2sin²(πr/2h) and 2sin(π(2r+1)/2h)sin(π/2h).
    #[inline(always)]
    fn ring<R: Real>(&self, y: R::Uint) -> Ring<R> {
        let [_, rows] = self.counts::<R>();
        let y = R::from_uint(y);
        let mirrored = (rows - R::lit(1.0)) - y;
        let lower = mirrored.lt(y);
        let near = y.lesser(mirrored);
        let quarter = R::lit(0.25) / rows;
        let (s, _) = (near * quarter).sin_cos_turns();
        let (middle, _) = ((near + near + R::lit(1.0)) * quarter).sin_cos_turns();
        let (step, _) = quarter.sin_cos_turns();
        Ring { start: R::lit(2.0) * s * s, height: R::lit(2.0) * middle * step, lower }
    }
    /// Probability over solid angle.
    #[inline(always)]
    fn texel_pdf<R: Real>(&self, pmf: R, y: R::Uint) -> R {
        let [w, h] = self.counts::<R>();
        let per_steradian = match self.map {
            EnvironmentMap::EqualArea => w * h * R::lit(0.25 / PI),
            EnvironmentMap::Equirectangular => w * R::lit(0.5 / PI) / self.ring::<R>(y).height,
        };
        (pmf * per_steradian).lesser(R::lit(GREATEST))
    }
}

/// Directions in proportion to the weights.
impl<R: Real> Warp<R> for ImageEnvironment<'_> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.draw(u).light.direction
    }
    #[inline(always)]
    fn pdf(&self, direction: Vec3<R>) -> R {
        self.pdf_of(direction)
    }
    #[inline(always)]
    fn invert(&self, direction: Vec3<R>) -> Vec2<R> {
        self.inverse(direction)
    }
}

/// An [`ImageEnvironment`] as a [`LightSampler`], the same for all shading points. Surface coordinates: the position in the image.
///
/// Its samples report the pdf of the texel in which their direction lies, which may be the neighbour of the texel that was drawn for the
/// 6e−7 of the directions next to an edge. [`ImageEnvironment::draw`] returns the drawn texel and its pdf instead.
#[derive(Clone, Copy, Debug)]
pub struct ByRadiance<'a> {
    environment: ImageEnvironment<'a>,
}

impl<R: Real> LightSampler<R> for ByRadiance<'_> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        self.hit(self.environment.draw(u).light.direction)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.environment.pdf_of(w)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.environment.inverse(w)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        met(w, self.pdf(w), self.environment.place(&self.environment.texel(w)))
    }
}
