//! Flat lights with pictures.

use super::cells::{Box2, Measure, Slabs};
use super::direction::{DirectionSample, to_unit};
use super::disk::Disk;
use super::parallelogram::area::PlacedParallelogram;
use super::parallelogram::{
    Parallelogram, ParallelogramByArea, ParallelogramByProjectedSolidAngle, ParallelogramBySolidAngle,
};
use super::pictured::{PicturedLight, PicturedSampler, Texel, TexelSurface};
use super::rectangle::Rectangle;
use super::sample::{LightSample, direction_to, solid_angle_pdf};
use super::sampler::LightSampler;
use super::surface::{AreaSurface, Surface, SurfaceHit};
use super::triangle::Triangle;
use crate::math::{quotient, rsqrt};
use crate::real::{Mask, Real};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Bilinear, Warp};

/// A flat light as the parallelogram of its surface coordinates.
pub trait FlatLight<R: Real> {
    /// Where (u, v) = (0, 0) is, and the edges to (1, 0) and (0, 1).
    fn coordinates(&self) -> Parallelogram<R>;
}
impl<R: Real> FlatLight<R> for Parallelogram<R> {
    #[inline(always)]
    fn coordinates(&self) -> Parallelogram<R> {
        *self
    }
}
impl<R: Real> FlatLight<R> for Rectangle<R> {
    #[inline(always)]
    fn coordinates(&self) -> Parallelogram<R> {
        (*self).into()
    }
}
impl<R: Real> FlatLight<R> for Triangle<R> {
    #[inline(always)]
    fn coordinates(&self) -> Parallelogram<R> {
        Parallelogram { corner: self.v0, edge_s: self.e1, edge_t: self.e2 }
    }
}
impl<R: Real> FlatLight<R> for Disk<R> {
    #[inline(always)]
    fn coordinates(&self) -> Parallelogram<R> {
        let Frame { s, t, .. } = Frame::new(self.normal);
        let diameter = self.radius + self.radius;
        let corner = s.mul_add(-self.radius, t.mul_add(-self.radius, self.center));
        // a radius below 0 has no area
        let diameter = diameter.greater(R::lit(0.0));
        Parallelogram { corner, edge_s: s * diameter, edge_t: t * diameter }
    }
}

impl<'a, L> PicturedLight<'a, L> {
    #[inline(always)]
    fn by<R: Real, M>(&self, p: Vec3<R>, measure: M) -> PicturedSampler<'a, Flat<R, M>>
    where
        L: FlatLight<R>,
    {
        let Parallelogram { corner, edge_s, edge_t } = self.light.coordinates();
        let corner = corner - p;
        let surface = PlacedParallelogram::new(corner, edge_s, edge_t);
        let surface = Flat { frame: Parallelogram { corner, edge_s, edge_t }, surface, measure };
        PicturedSampler { picture: self.picture, surface }
    }
    /// By radiance times area, seen from the point `p`: for lights that are small for their distance. The pdf is the pmf of the texel, over
    /// its area, times distance²/|cosθ'|, per steradian.
    #[inline(always)]
    pub fn by_area<R: Real>(&self, p: Vec3<R>) -> PicturedSampler<'a, Flat<R, Area>>
    where
        L: FlatLight<R>,
    {
        self.by(p, Area)
    }
    /// By radiance times solid angle at the point `p`: if the radiance is constant in each texel, the samples of a light whose texels are
    /// small for their distance are worth nearly the same. The pdf is the pmf of the texel, over its solid angle, per steradian.
    ///
    /// The parts of a box are compared by their solid angles where they are large for their distance, by those of their centres where
    /// not, and by radiance alone where they are too small to differ: shares are within 1 % of the exact ones.
    #[inline(always)]
    pub fn by_solid_angle<R: Real>(&self, p: Vec3<R>) -> PicturedSampler<'a, Flat<R, SolidAngle<R>>>
    where
        L: FlatLight<R>,
    {
        self.by(p, SolidAngle::new(&self.light.coordinates(), p))
    }
    /// By radiance times projected solid angle above the horizon of the unit normal `n` at the point `p`. The pdf is the pmf of the texel,
    /// over its projected solid angle, times the cosine, per steradian.
    #[inline(always)]
    pub fn by_projected_solid_angle<R: Real>(
        &self,
        p: Vec3<R>,
        n: Vec3<R>,
    ) -> PicturedSampler<'a, Flat<R, Projected<R>>>
    where
        L: FlatLight<R>,
    {
        self.by(p, Projected { solid_angle: SolidAngle::new(&self.light.coordinates(), p), normal: n })
    }
}

/// A flat light, relative to the shading point, whose texels are sampled by a measure.
#[derive(Clone, Copy, Debug)]
pub struct Flat<R, M> {
    frame: Parallelogram<R>,
    surface: PlacedParallelogram<R>,
    measure: M,
}

impl<R: Real, M> Flat<R, M> {
    #[inline(always)]
    fn texel(&self, texel: &Texel<R>) -> Parallelogram<R> {
        let Parallelogram { corner, edge_s, edge_t } = self.frame;
        let corner = edge_s.mul_add(texel.low.x, edge_t.mul_add(texel.low.y, corner));
        Parallelogram { corner, edge_s: edge_s * texel.size.x, edge_t: edge_t * texel.size.y }
    }
}

impl<R: Real, M: Measure<R>> Measure<R> for Flat<R, M> {
    #[inline(always)]
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask) {
        self.measure.densities(of)
    }
}

impl<R: Real, M: TexelMeasure<R>> TexelSurface<R> for Flat<R, M> {
    const FLAT: bool = true;
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.surface.at(w)
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.surface.contains(w)
    }
    #[inline(always)]
    fn draw(&self, texel: &Texel<R>, u: Vec2<R>) -> LightSample<R> {
        let (corners, near) = self.weights(texel);
        let within = corners.sample(u);
        let uv = texel.place(within);
        let Parallelogram { corner, edge_s, edge_t } = self.frame;
        let position = edge_s.mul_add(uv.x, edge_t.mul_add(uv.y, corner));
        let DirectionSample { direction, distance } = direction_to(position);
        let pdf = self.far_pdf(texel, direction, corners.pdf(within));
        let Vec3 { x, y, z } = direction;
        let [x, y, z, distance, pdf, u, v] = R::where_any(near, [x, y, z, distance, pdf, uv.x, uv.y], || {
            let light = self.measure.texel(&self.texel(texel)).sample(u);
            let (Vec3 { x, y, z }, uv) = (light.direction, texel.place(light.uv));
            [x, y, z, light.distance, light.pdf, uv.x, uv.y]
        });
        let direction = Vec3::new(x, y, z);
        let normal = self.surface.at(direction).normal;
        let (emits, delta) = (direction.dot(normal).lt(R::lit(0.0)), R::Mask::splat(false));
        LightSample { direction, distance, pdf, normal, uv: Vec2::new(u, v), emits, delta }
    }
    #[inline(always)]
    fn pdf(&self, texel: &Texel<R>, w: Vec3<R>, _: &SurfaceHit<R>, within: Vec2<R>) -> R {
        let (corners, near) = self.weights(texel);
        let far = self.far_pdf(texel, w, corners.pdf(within));
        let [pdf] = R::where_any(near, [far], || [self.measure.texel(&self.texel(texel)).pdf_of_hit(w)]);
        pdf
    }
    #[inline(always)]
    fn invert(&self, texel: &Texel<R>, w: Vec3<R>, within: Vec2<R>) -> Vec2<R> {
        let (corners, near) = self.weights(texel);
        let far = corners.invert(within);
        let [x, y] = R::where_any(near, [far.x, far.y], || {
            let Vec2 { x, y } = self.measure.texel(&self.texel(texel)).invert(w);
            [x, y]
        });
        Vec2::new(x, y)
    }
}

#[allow(private_bounds, reason = "the measures are those below")]
impl<R: Real, M: TexelMeasure<R>> Flat<R, M> {
    /// Radiance times the measure at the corners of a texel; and whether it is too large for its distance to be bilinear in between.
    #[inline(always)]
    fn weights(&self, texel: &Texel<R>) -> (Bilinear<R>, R::Mask) {
        let of = Box2 { low: texel.low, high: texel.low + texel.size };
        let (measures, near) = self.measure.corners(&of);
        let one = R::lit(1.0);
        let radiance = texel.corners.unwrap_or([one; 4]);
        (Bilinear { corners: core::array::from_fn(|k| radiance[k] * measures[k]) }, near)
    }
    /// The pdf of a point of the texel, given that of its position in it.
    #[inline(always)]
    fn far_pdf(&self, texel: &Texel<R>, w: Vec3<R>, pdf: R) -> R {
        let at = self.surface.at(w);
        let area = self.surface.area() * texel.size.x * texel.size.y;
        solid_angle_pdf(at.distance, w.dot(at.normal).abs() * area) * pdf
    }
}

/// What a texel of a flat light is sampled by.
pub(super) trait TexelMeasure<R: Real>: Measure<R> {
    type Texel: LightSampler<R>;
    /// A texel relative to the shading point.
    fn texel(&self, texel: &Parallelogram<R>) -> Self::Texel;
    /// The measure per area at the corners of a box, in any unit, and where it is so large for its distance that it is sampled as a shape of
    /// its own.
    fn corners(&self, of: &Box2<R>) -> ([R; 4], R::Mask);
}

/// Texels of more than so much of their distance are sampled as shapes of their own.
const LARGE: f64 = 1.0 / 8.0;

/// The measure of [`PicturedLight::by_area`].
#[derive(Clone, Copy, Debug)]
pub struct Area;

impl<R: Real> Measure<R> for Area {
    #[inline(always)]
    fn densities(&self, _: &Slabs<R>) -> ([R; 4], R::Mask) {
        ([R::lit(1.0); 4], R::Mask::splat(false))
    }
}
impl<R: Real> TexelMeasure<R> for Area {
    type Texel = ParallelogramByArea<R>;
    #[inline(always)]
    fn texel(&self, texel: &Parallelogram<R>) -> Self::Texel {
        texel.by_area(Vec3::default())
    }
    #[inline(always)]
    fn corners(&self, _: &Box2<R>) -> ([R; 4], R::Mask) {
        ([R::lit(1.0); 4], R::Mask::splat(false))
    }
}

/// The measure of [`PicturedLight::by_solid_angle`]: a light in units in which no coordinate exceeds 2.
#[derive(Clone, Copy, Debug)]
pub struct SolidAngle<R> {
    corner: Vec3<R>,
    edge_s: Vec3<R>,
    edge_t: Vec3<R>,
    /// Squared lengths of the edges.
    edges: Vec2<R>,
    /// Six times the volume of the pyramid from the point over half the parallelogram, as the product of triples is.
    volume: R,
}

/// Slabs of which half is at most so much of their distance are points: then the solid angle is off by less than 1 %.
const NEAR: f64 = 1.0 / 4.0;
/// Slabs of which half is at most so much of their distance have parts that are alike.
const ALIKE: f64 = 1.0 / 128.0;
/// Squared distances count as at least so much, in units in which no coordinate exceeds 2.
const LEAST: f64 = 1e-12;

impl<R: Real> SolidAngle<R> {
    #[inline(always)]
    fn new(light: &Parallelogram<R>, p: Vec3<R>) -> Self {
        let ([corner, edge_s, edge_t], _) = to_unit([light.corner - p, light.edge_s, light.edge_t]);
        let edges = Vec2::new(edge_s.length_squared(), edge_t.length_squared());
        Self { corner, edge_s, edge_t, edges, volume: corner.dot(edge_s.cross(edge_t)).abs() }
    }
    #[inline(always)]
    fn at(&self, s: R, t: R) -> Vec3<R> {
        self.edge_s.mul_add(s, self.edge_t.mul_add(t, self.corner))
    }
    #[inline(always)]
    fn middle(&self, of: &Box2<R>) -> Vec3<R> {
        let half = R::lit(0.5);
        self.at((of.low.x + of.high.x) * half, (of.low.y + of.high.y) * half)
    }
    /// Whether half the sides of a box are longer than a length, given its square.
    #[inline(always)]
    fn longer(&self, of: &Box2<R>, square: R) -> R::Mask {
        let (s, t) = (of.high.x - of.low.x, of.high.y - of.low.y);
        (self.edges.x * s).mul_add(s, self.edges.y * t * t).gt(square * R::lit(4.0))
    }
    /// The corners of a box: (0, 0), (1, 0), (0, 1), (1, 1).
    #[inline(always)]
    fn quad(&self, of: &Box2<R>) -> [Vec3<R>; 4] {
        let Box2 { low, high } = of;
        [(low.x, low.y), (high.x, low.y), (low.x, high.y), (high.x, high.y)].map(|(s, t)| self.at(s, t))
    }
    /// Squared distances of the corners of a box, at least so large that their powers are numbers.
    #[inline(always)]
    fn squares(&self, of: &Box2<R>) -> [R; 4] {
        self.quad(of).map(|v| v.length_squared().greater(R::lit(LEAST)))
    }
    /// Whether a box is large for its distance.
    #[inline(always)]
    fn large(&self, of: &Box2<R>, [a, b, c, d]: [R; 4]) -> R::Mask {
        let least = a.lesser(b).lesser(c.lesser(d));
        self.longer(of, least * R::lit(LARGE * LARGE)) | least.le(R::lit(LEAST))
    }
    /// Squared distances of the middles of slabs, at least so large that their powers are numbers.
    #[inline(always)]
    fn middles(&self, of: &Slabs<R>) -> [R; 4] {
        of.each().map(|slab| self.middle(&slab).length_squared().greater(R::lit(LEAST)))
    }
    /// Solid angles of slabs, over their parts of the light: by the triangles of their corners.
    #[inline(always)]
    fn exact(&self, of: &Slabs<R>) -> [R; 4] {
        let at = |along: R, across: R| if of.axis == 0 { self.at(along, across) } else { self.at(across, along) };
        let [near, far] = of.across.map(|across| {
            of.along.map(|along| {
                let v = at(along, across);
                let squared = v.length_squared();
                let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-30)));
                (v * inverse, inverse)
            })
        });
        // of each diagonal, and of the side in the middle
        let one = R::lit(1.0);
        core::array::from_fn(|k| {
            let ((a, i), (b, j), (c, l), (d, m)) = (near[k], near[k + 1], far[k + 1], far[k]);
            let part = area(&of.slab(k));
            let volume = self.volume * part;
            // tan Ω/2 of a triangle of unit vectors is their triple product over this sum (van Oosterom and Strackee 1983)
            let ac = one + a.dot(c);
            let (x1, y1) = (ac + a.dot(b) + b.dot(c), volume * i * j * l);
            let (x2, y2) = (ac + c.dot(d) + d.dot(a), volume * i * l * m);
            // the argument of the product of both is the sum, half the solid angle
            let half = x1.mul_add(y2, x2 * y1).abs().atan2(x1.mul_add(x2, -(y1 * y2)));
            half / part.greater(R::lit(1e-30))
        })
    }
    /// Whether half the longest slab is longer than a fraction of the least of these squared distances.
    #[inline(always)]
    fn nearer(&self, of: &Slabs<R>, [a, b, c, d]: [R; 4], fraction: f64) -> R::Mask {
        self.longer(&of.slab(0), a.lesser(b).lesser(c.lesser(d)) * R::lit(fraction * fraction))
    }
}

/// Area of a box, as part of the picture's.
#[inline(always)]
fn area<R: Real>(of: &Box2<R>) -> R {
    (of.high.x - of.low.x) * (of.high.y - of.low.y)
}

impl<R: Real> Measure<R> for SolidAngle<R> {
    #[inline(always)]
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask) {
        let squares = self.middles(of);
        let near = self.nearer(of, squares, NEAR);
        let far = squares.map(|square| R::lit(1.0) / (square * square.sqrt()));
        (R::where_any(near, far, || self.exact(of)), self.nearer(of, squares, ALIKE))
    }
}
impl<R: Real> TexelMeasure<R> for SolidAngle<R> {
    type Texel = ParallelogramBySolidAngle<R>;
    #[inline(always)]
    fn texel(&self, texel: &Parallelogram<R>) -> Self::Texel {
        texel.by_solid_angle(Vec3::default())
    }
    #[inline(always)]
    fn corners(&self, of: &Box2<R>) -> ([R; 4], R::Mask) {
        let squares = self.squares(of);
        (squares.map(|square| R::lit(1.0) / (square * square.sqrt())), self.large(of, squares))
    }
}

/// The measure of [`PicturedLight::by_projected_solid_angle`].
#[derive(Clone, Copy, Debug)]
pub struct Projected<R> {
    solid_angle: SolidAngle<R>,
    normal: Vec3<R>,
}

impl<R: Real> Projected<R> {
    /// Mean of the positive part of the height above the horizon; 0 where even the highest corner is below, by more than its rounding. Also,
    /// whether the height is alike all over the box.
    #[inline(always)]
    fn height(&self, of: &Box2<R>) -> (R, R::Mask) {
        let SolidAngle { edge_s, edge_t, .. } = self.solid_angle;
        let (zero, half) = (R::lit(0.0), R::lit(0.5));
        let (s, t) = (of.high.x - of.low.x, of.high.y - of.low.y);
        let rise = |edge: Vec3<R>, part: R| (edge.dot(self.normal) * part).abs().mul_add(half, R::lit(1e-6));
        let (a, b) = (rise(edge_s, s), rise(edge_t, t));
        // of very different ones the differences below would have few digits
        let (a, b) = (a.greater(b * R::lit(1.0 / 64.0)), b.greater(a * R::lit(1.0 / 64.0)));
        let middle = self.solid_angle.middle(of).dot(self.normal);
        // the height is middle + ax + by, x and y uniform in [−1, 1]
        let cube = |x: R| {
            let x = x.greater(zero);
            x * x * x
        };
        let (sum, difference) = (a + b, a - b);
        let cubes = (cube(middle + sum) - cube(middle + difference)) - (cube(middle - difference) - cube(middle - sum));
        let top = (middle + sum).greater(zero);
        let mean = (cubes / (R::lit(24.0) * a * b)).greater(top * R::lit(1e-6));
        (R::blend(middle.lt(sum), mean, middle), (middle * R::lit(ALIKE)).gt(sum))
    }
    /// Projected solid angle of a box above the horizon, over its part of the light: half the sum, over its edges as seen from the point, of
    /// the angle times the cosine between the normal and that of the edge's plane (Lambert; Baum, Rushmeier and Winget 1989).
    #[inline(always)]
    fn exact(&self, of: &Box2<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Box2 { low, high } = of;
        let corners = [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)];
        let corners = corners.map(|(s, t)| self.solid_angle.at(s, t));
        let heights = corners.map(|v| v.dot(self.normal));
        let angle_over_sine = |a: Vec3<R>, b: Vec3<R>| {
            let cross = a.cross(b);
            let sine = cross.length();
            (cross, sine.atan2(a.dot(b)), sine)
        };
        let mut sum = zero;
        // where the outline leaves the upper half of space, and where it comes back
        let (mut left, mut entered) = (Vec3::default(), Vec3::default());
        for i in 0..4 {
            let j = (i + 1) % 4;
            let (a, b, at_a, at_b) = (corners[i], corners[j], heights[i], heights[j]);
            let (above, next) = (at_a.gt(zero), at_b.gt(zero));
            let crosses = above ^ next;
            let part = at_a / R::blend(crosses, at_a - at_b, one);
            let crossing = (b - a).mul_add(part, a);
            left = Vec3::blend(crosses & above, crossing, left);
            entered = Vec3::blend(crosses & next, crossing, entered);
            let (a, b) = (Vec3::blend(above, a, crossing), Vec3::blend(next, b, crossing));
            let (cross, angle, sine) = angle_over_sine(a, b);
            sum += (quotient(cross.dot(self.normal), sine) * angle).keep(above | next);
        }
        let (cross, angle, sine) = angle_over_sine(left, entered);
        sum += quotient(cross.dot(self.normal), sine) * angle;
        sum.abs() * R::lit(0.5) / area(of).greater(R::lit(1e-30))
    }
}

impl<R: Real> Measure<R> for Projected<R> {
    #[inline(always)]
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask) {
        let this = &self.solid_angle;
        let (slabs, squares) = (of.each(), this.middles(of));
        let heights = slabs.map(|slab| self.height(&slab));
        let level = heights.iter().fold(R::Mask::splat(true), |all, (_, level)| all & *level);
        let far: [R; 4] = core::array::from_fn(|k| heights[k].0 / (squares[k] * squares[k]));
        let near = this.nearer(of, squares, NEAR);
        let densities = R::where_any(near, far, || {
            let solid_angles = this.exact(of);
            // what may be visible keeps a little, whatever rounding has left of it
            core::array::from_fn(|k| {
                self.exact(&slabs[k]).greater(solid_angles[k] * R::lit(1e-6)).keep(heights[k].0.gt(R::lit(0.0)))
            })
        });
        (densities, this.nearer(of, squares, ALIKE) | !level)
    }
}
impl<R: Real> TexelMeasure<R> for Projected<R> {
    type Texel = ParallelogramByProjectedSolidAngle<R>;
    #[inline(always)]
    fn texel(&self, texel: &Parallelogram<R>) -> Self::Texel {
        texel.by_projected_solid_angle(Vec3::default(), self.normal)
    }
    #[inline(always)]
    fn corners(&self, of: &Box2<R>) -> ([R; 4], R::Mask) {
        let this = &self.solid_angle;
        let squares = this.squares(of);
        let (zero, slack) = (R::lit(0.0), R::lit(2e-6));
        // no corner above the horizon is lost to rounding
        let heights = this.quad(of).map(|v| v.dot(self.normal) + slack);
        let [a, b, c, d] = heights;
        // what the horizon cuts is clipped
        let is_cut = a.lesser(b).lesser(c.lesser(d)).lt(slack + slack) & a.greater(b).greater(c.greater(d)).gt(zero);
        let measures = core::array::from_fn(|k| heights[k].greater(zero) / (squares[k] * squares[k]));
        (measures, this.large(of, squares) | is_cut)
    }
}
