//! Spheres after the map of a reflection: elliptic cones, sampled nearly by projected solid angle.

use crate::lanewise::lanewise;
use crate::math::{difference_of_products, quotient, ratio};
use crate::real::{Mask, Real, blended, unit_interval};
use crate::vector::{Vec2, Vec3};
use core::f64::consts::{PI, TAU};

/// Cells of the density over the angle.
const CELLS: usize = 8;
/// sin²θ and ½ sin 2θ for θ = π/16, 2π/16, … between the cells.
const ENDS: [(f64, f64); CELLS - 1] = [
    (0.038_060_233_744_356_63, 0.191_341_716_182_544_9),
    (0.146_446_609_406_726_24, 0.353_553_390_593_273_8),
    (0.308_658_283_817_455_1, 0.461_939_766_255_643_4),
    (0.5, 0.5),
    (0.691_341_716_182_544_9, 0.461_939_766_255_643_4),
    (0.853_553_390_593_273_8, 0.353_553_390_593_273_8),
    (0.961_939_766_255_643_4, 0.191_341_716_182_544_9),
];

lanewise! {
    /// Directions from a point to a sphere, after the map of a reflection and above the horizon.
    ///
    /// The map turns the circle in which the sphere is seen into an ellipse c + x u + y v, x² + y² ≤ 1, with two conjugate radii of which v
    /// is horizontal. Half planes that end at the line along v through the point meet the horizon there and the ellipse in chords of
    /// constant x. With the angle φ of a half plane to the horizon, and in it the latitude λ from the perpendicular of v, cosθ dω is
    /// sinφ cos²λ dφ dλ. The angle goes from φ₀ by Φ sin²θ, where 16 θ/π has a density of cells, exact at their ends; that of the latitude is
    /// two lines, exact at both ends of the chord and in its middle. So the pdf is known exactly, and has no difference of large numbers,
    /// however small the sphere is and however little of it is above the horizon.
    pub(crate) struct ReflectedCap {
        /// Unit vector along v: its x and y.
        along: Vec2<R>,
        /// Components along v of c and u.
        center: R,
        slope: R,
        /// Length of v.
        half: R,
        /// (c × u)·v over the length of v.
        span: R,
        /// 1 + x and 1 − x of the first chord: 0 and 2, unless the horizon cuts the ellipse.
        start: R,
        width: R,
        /// cosφ₀ and sinφ₀.
        first: Vec2<R>,
        /// Distances from the point to the lines through the first and the last chord.
        distances: Vec2<R>,
        /// Φ in turns.
        angle: R,
        nodes: Nodes<R>,
        /// Sum of the cells.
        total: R,
    }
}

/// The density over θ between the cells, in any unit. It is 0 at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
struct Nodes<R>([R; CELLS - 1]);
impl<R> Nodes<R> {
    #[inline(always)]
    fn map<S>(self, f: impl FnMut(R) -> S) -> Nodes<S> {
        Nodes(self.0.map(f))
    }
}
blended!(Nodes { 0 });
impl<R: Real> Nodes<R> {
    /// Cell `i`: the first and the last are parabolas, as the true density grows there; the others are lines.
    #[inline(always)]
    fn cell(&self, i: usize, before: R) -> Cell<R> {
        let a = if i == 0 { R::lit(0.0) } else { self.0[i - 1] };
        let b = if i == CELLS - 1 { R::lit(0.0) } else { self.0[i] };
        let share = if i == 0 || i == CELLS - 1 { 1.0 / 3.0 } else { 0.5 };
        Cell { index: R::lit(i as f64), before, mass: (a + b) * R::lit(share), a, b }
    }
    /// The last cell for which the closure is true, of its number and of the sum of those before it.
    #[inline(always)]
    fn find(&self, is_reached: impl Fn(usize, R) -> R::Mask) -> Cell<R> {
        let mut found = self.cell(0, R::lit(0.0));
        let mut sum = found.mass;
        for i in 1..CELLS {
            let cell = self.cell(i, sum);
            found = Cell::blend(is_reached(i, sum), cell, found);
            sum += cell.mass;
        }
        found
    }
}

lanewise! {
    /// A cell of the density over θ: its number, the sum of those before it, its integral, and the densities at its ends.
    struct Cell {
        index: R,
        before: R,
        mass: R,
        a: R,
        b: R,
    }
}

impl<R: Real> Cell<R> {
    #[inline(always)]
    fn is_first(&self) -> R::Mask {
        self.index.lt(R::lit(0.5))
    }
    #[inline(always)]
    fn is_last(&self) -> R::Mask {
        self.index.gt(R::lit(CELLS as f64 - 1.5))
    }
    /// The place in [0, 1] below which is this part of the cell, of which the rest is given, too.
    #[inline(always)]
    fn place(&self, part: R, rest: R) -> R {
        let line = along_line(self.a, self.b, part);
        let end = R::blend(self.is_first(), part, rest).cbrt();
        R::blend(self.is_first(), end, R::blend(self.is_last(), R::lit(1.0) - end, line))
    }
    /// The density at a place in [0, 1], and the integral up to there.
    #[inline(always)]
    fn at(&self, x: R) -> (R, R) {
        let (first, last, third) = (self.is_first(), self.is_last(), R::lit(1.0 / 3.0));
        let y = R::lit(1.0) - x;
        let line = (self.b - self.a).mul_add(x, self.a);
        let (rising, falling) = (self.b * x * x, self.a * y * y);
        let density = R::blend(first, rising, R::blend(last, falling, line));
        let below = x * (self.a + line) * R::lit(0.5);
        let below = R::blend(first, rising * x * third, R::blend(last, self.mass - falling * y * third, below));
        (density, below)
    }
}

/// The place in [0, 1] below which is this part of a density that is a line from a to b.
#[inline(always)]
fn along_line<R: Real>(a: R, b: R, part: R) -> R {
    let root = (a * a).mul_add(R::lit(1.0) - part, b * b * part).greater(R::lit(0.0)).sqrt();
    ratio(part * (a + b), a + root).lesser(R::lit(1.0))
}

/// A chord, as latitudes.
struct Chord<R> {
    /// Cosine and sine of the first latitude.
    cos: R,
    sin: R,
    /// From there to the last one, in radians.
    range: R,
    /// ∫ 2 cos².
    area: R,
    /// cos² at the first, the middle and the last latitude.
    squares: [R; 3],
}

/// A direction as sin²θ and cos²θ, its cell and place there, its chord, the part of the range of latitudes, and the cosine of the latitude.
struct DirectionInCell<R> {
    part: R,
    rest: R,
    cell: Cell<R>,
    x: R,
    chord: Chord<R>,
    y: R,
    cos: R,
}

impl<R: Real> ReflectedCap<R> {
    /// Prepares for a sphere that is seen as a circle, whose centre is `height` along a unit vector and whose radius is `spread`. The vectors
    /// are what the map, which has this determinant, makes of `height` times that unit vector, and of two unit vectors that complete it to a
    /// frame. From inside, only the horizon counts.
    #[inline]
    pub(super) fn new([c, u, v]: [Vec3<R>; 3], [height, spread]: [R; 2], determinant: R, inside: R::Mask) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // from inside, the half space above the horizon
        let c = c.keep(!inside);
        let u = Vec3::blend(inside, Vec3::lit([1.0, 0.0, 0.0]), u);
        let v = Vec3::blend(inside, Vec3::lit([0.0, 1.0, 0.0]), v);
        let spread = R::blend(inside, one, spread);
        // turned so that v is horizontal
        let steep = u.z.mul_add(u.z, v.z * v.z).sqrt();
        let some = steep.gt(R::lit(1e-15));
        let inverse = one / R::blend(some, steep, one);
        let (cos, sin) = (R::blend(some, u.z * inverse, one), (v.z * inverse).keep(some));
        let (u, v) = (u.mul_add(cos, v * sin), v.mul_add(cos, u * -sin));
        let steep = steep.keep(some) * spread;
        let size = v.x.mul_add(v.x, v.y * v.y).sqrt();
        let along = Vec2::new(ratio(v.x, size), ratio(v.y, size));
        let across = |v: Vec3<R>| along.x.mul_add(v.y, -(along.y * v.x));
        let upon = |v: Vec3<R>| along.x.mul_add(v.x, along.y * v.y);
        let (c_across, u_across) = (across(c), across(u) * spread);
        let span = (ratio(determinant, size) * height * spread).greater(zero).keep(!inside);
        // the lowest chord above the horizon
        let cut = c.z.lt(steep);
        let from = Vec2::new(c_across - u_across, c.z - steep);
        let from_distance = from.dot(from).sqrt();
        let (by, share) = (ratio(one, from_distance), ratio(one, steep));
        let first = Vec2::new(R::blend(cut, one, from.x * by), (from.y * by).keep(!cut));
        let start = ((steep - c.z) * share).keep(cut);
        let width = R::blend(cut, ((steep + c.z) * share).greater(zero), R::lit(2.0));
        let last = Vec2::new(c_across + u_across, c.z + steep);
        let turn = R::blend(cut, last.y, width * span * by).greater(zero);
        let mut this = Self {
            along,
            center: upon(c),
            slope: upon(u) * spread,
            half: size * spread,
            span,
            start,
            width,
            first,
            distances: Vec2::new(R::blend(cut, span * share, from_distance), last.dot(last).sqrt()),
            angle: turn.atan2(first.dot(last)) * R::lit(1.0 / TAU),
            nodes: Nodes::default(),
            total: zero,
        };
        this.nodes = Nodes(core::array::from_fn(|i| {
            let (square, product) = ENDS[i];
            let (part, rest) = (R::lit(square), R::lit(ENDS[CELLS - 2 - i].0));
            let height = this.turned(part).y.greater(zero) * R::lit(product);
            (this.chord(part, rest).area * height).keep(width.gt(zero))
        }));
        let last = this.nodes.find(|_, _| R::Mask::splat(true));
        this.total = last.before + last.mass;
        this
    }
    /// Cosine and sine of the angle to the horizon after this part of Φ.
    #[inline(always)]
    fn turned(&self, part: R) -> Vec2<R> {
        let (sin, cos) = (part * self.angle).sin_cos_turns();
        let Vec2 { x, y } = self.first;
        Vec2::new(x.mul_add(cos, -(y * sin)), y.mul_add(cos, x * sin))
    }
    /// The chord after this part of Φ, of which the rest is given, too.
    #[inline(always)]
    fn chord(&self, part: R, rest: R) -> Chord<R> {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let sine = |part: R| (part * self.angle).sin_cos_turns().0.greater(zero);
        let (behind, ahead) = (sine(part) * self.distances.x, sine(rest) * self.distances.y);
        let scale = ratio(self.width, behind + ahead);
        let (below, above) = (behind.mul_add(scale, self.start), ahead * scale);
        let distance = self.span * scale;
        let middle = self.slope.mul_add(below - one, self.center);
        let reach = (below * above).sqrt() * self.half;
        let (low, high) = (middle - reach, middle + reach);
        let over = |y: R| ratio(one, distance.mul_add(distance, y * y).sqrt());
        let (by_low, by_high) = (over(low), over(high));
        let (cos, cos_high, both) = (distance * by_low, distance * by_high, by_low * by_high);
        let (square, product) = (distance * distance, low * high);
        let (sin_range, cos_sum) = (distance * (reach + reach) * both, (square - product) * both);
        let range = sin_range.atan2((square + product) * both);
        Chord {
            cos,
            sin: low * by_low,
            range,
            area: sin_range.mul_add(cos_sum, range).greater(zero),
            squares: [cos * cos, half.mul_add(cos_sum, half).greater(zero), cos_high * cos_high],
        }
    }
    /// A unit vector, above the horizon but for rounding.
    #[inline(always)]
    pub(crate) fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (reached, left) = (u.x * self.total, (one - u.x) * self.total);
        let cell = self.nodes.find(|_, before| reached.ge(before));
        let part = ratio(reached - cell.before, cell.mass).clamped(zero, one);
        let x = cell.place(part, R::blend(cell.is_last(), ratio(left, cell.mass).lesser(one), one - part));
        let (sin, cos) = ((cell.index + x) * R::lit(0.25 / CELLS as f64)).sin_cos_turns();
        let part = sin * sin;
        let chord = self.chord(part, cos * cos);
        let [a, b, c] = chord.squares;
        let (lower, upper) = (a + b, b + c);
        let swept = u.y * (lower + upper);
        let is_lower = swept.lt(lower);
        let share = ratio(R::blend(is_lower, swept, swept - lower), R::blend(is_lower, lower, upper));
        let y = along_line(R::blend(is_lower, a, b), R::blend(is_lower, b, c), share.lesser(one));
        let y = R::blend(is_lower, y, one + y) * R::lit(0.5);
        let (sin, cos) = (y * chord.range * R::lit(1.0 / TAU)).sin_cos_turns();
        let flat = chord.cos.mul_add(cos, -(chord.sin * sin));
        let high = chord.sin.mul_add(cos, chord.cos * sin);
        let Vec2 { x, y } = self.turned(part);
        let across = x * flat;
        let Vec2 { x: along_x, y: along_y } = self.along;
        Vec3::new(along_x.mul_add(high, -(along_y * across)), along_y.mul_add(high, along_x * across), y * flat)
    }
    /// A unit vector that is known to hit the sphere.
    #[inline(always)]
    fn locate(&self, w: Vec3<R>) -> DirectionInCell<R> {
        let (zero, one, least) = (R::lit(0.0), R::lit(1.0), R::lit(1e-7));
        let Vec2 { x, y } = self.along;
        let (across, along) = (x.mul_add(w.y, -(y * w.x)), x.mul_add(w.x, y * w.y));
        let Vec2 { x: cos, y: sin } = self.first;
        let turn = difference_of_products(cos, w.z, sin, across).atan2(cos.mul_add(across, sin * w.z));
        let part = ratio(turn * R::lit(1.0 / TAU), self.angle).clamped(least, one - least);
        let rest = one - part;
        let theta = part.sqrt().atan2(rest.sqrt()) * R::lit(2.0 * CELLS as f64 / PI);
        let cell = self.nodes.find(|i, _| theta.ge(R::lit(i as f64)));
        let chord = self.chord(part, rest);
        let flat = across.mul_add(across, w.z * w.z).sqrt();
        let from = difference_of_products(chord.cos, along, chord.sin, flat);
        let up = from.atan2(chord.cos.mul_add(flat, chord.sin * along));
        let y = ratio(up, chord.range).clamped(zero, one);
        DirectionInCell { part, rest, cell, x: (theta - cell.index).clamped(zero, one), chord, y, cos: flat }
    }
    /// The pdf per steradian of a unit vector that is known to hit the sphere above the horizon.
    #[inline(always)]
    pub(crate) fn pdf(&self, w: Vec3<R>) -> R {
        let DirectionInCell { part, rest, cell, x, chord, y, cos } = self.locate(w);
        let over_theta = ratio(cell.at(x).0, self.total);
        let over_angle = quotient(over_theta * R::lit(CELLS as f64 / (PI * TAU)), self.angle * (part * rest).sqrt());
        let [a, b, c] = chord.squares;
        let sum = (a + b) + (b + c);
        let over_latitude = quotient(chord_density(chord.squares, y) * R::lit(4.0), chord.range * sum);
        over_angle * quotient(over_latitude, cos)
    }
    #[inline(always)]
    pub(crate) fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let DirectionInCell { cell, x, chord, y, .. } = self.locate(w);
        let [a, b, c] = chord.squares;
        let value = chord_density(chord.squares, y);
        let (lower, upper, twice) = (a + b, b + c, y + y);
        let is_lower = twice.lt(R::lit(1.0));
        let below = R::blend(is_lower, twice * (a + value), (twice - R::lit(1.0)).mul_add(b + value, lower));
        Vec2 {
            x: unit_interval(ratio(cell.before + cell.at(x).1, self.total)),
            y: unit_interval(ratio(below, lower + upper)),
        }
    }
}

/// The lines through cos² at the first, the middle and the last latitude, at a part of the range.
#[inline(always)]
fn chord_density<R: Real>([a, b, c]: [R; 3], part: R) -> R {
    let (twice, one) = (part + part, R::lit(1.0));
    R::blend(twice.lt(one), (b - a).mul_add(twice, a), (c - b).mul_add(twice - one, b))
}
