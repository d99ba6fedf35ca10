//! The binary light tree of Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", Proc. ACM on
//! Computer Graphics and Interactive Techniques 1(2), 2018, without splitting: one light is chosen by one random number.
//!
//! The bound of a cluster, the importance and the cost of a split are those of the paper; where it leaves a choice, this is as in
//! "Physically Based Rendering", 4th ed., 12.6.3. Eight lanes descend together, and cosines and sines take the place of angles.

use etendue::select::{Choice, NO_LIGHT};
use etendue::{Mask, Real, Vec3, f32x8, u32x8};
use std::f32::consts::{FRAC_PI_2, PI};

type X8 = f32x8;
type V8 = Vec3<f32x8>;

/// Number of bins along an axis.
const BINS: usize = 12;
/// From this depth on, clusters are halved, so that no path is longer than 64.
const HALVED: u32 = 40;
/// Clusters of fewer lights are built by one thread.
const ALONE: usize = 4096;
/// Flags in the word of a child: the child is a light, and its lights emit from both sides.
const LIGHT: u32 = 1 << 31;
const TWO_SIDED: u32 = 1 << 30;

/// What the tree knows of a light, or of a cluster of lights.
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    /// Least corner of the box.
    pub low: [f32; 3],
    /// Greatest corner of the box.
    pub high: [f32; 3],
    /// Radiance times area.
    pub power: f32,
    /// Axis of the cone of normals.
    pub axis: [f32; 3],
    /// Half of its angle.
    pub normals: f32,
    /// The greatest angle to a normal at which light is emitted.
    pub emission: f32,
    /// Whether a light among them emits from both sides.
    pub two_sided: bool,
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The angle between unit vectors, also if it is small.
fn angle(a: [f32; 3], b: [f32; 3]) -> f32 {
    let (a, b) = (Vec3::<f32>::from(a), Vec3::<f32>::from(b));
    a.cross(b).length().atan2(a.dot(b))
}

impl Cluster {
    const EMPTY: Self = Self {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
        power: 0.0,
        axis: [0.0, 0.0, 1.0],
        normals: 0.0,
        emission: 0.0,
        two_sided: false,
    };

    /// A light with an area: a flat one, or a sphere, which has no normal.
    #[must_use]
    pub fn light([low, high]: [[f32; 3]; 2], normal: [f32; 3], power: f32, two_sided: bool) -> Self {
        let flat = normal != [0.0; 3];
        let (axis, normals) = if flat { (normal, 0.0) } else { ([0.0, 0.0, 1.0], PI) };
        Self { low, high, power, axis, normals, emission: FRAC_PI_2, two_sided }
    }
    fn middle(&self, k: usize) -> f32 {
        0.5 * self.low[k] + 0.5 * self.high[k]
    }
    /// Both together.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        if self.power <= 0.0 {
            return *other;
        }
        if other.power <= 0.0 {
            return *self;
        }
        let (a, b) = if self.normals >= other.normals { (self, other) } else { (other, self) };
        let apart = angle(a.axis, b.axis);
        let (mut axis, mut normals) = (a.axis, a.normals);
        if (apart + b.normals).min(PI) > a.normals {
            normals = 0.5 * (a.normals + apart + b.normals);
            let [from, to] = [a.axis, b.axis].map(Vec3::<f32>::from);
            let across = to - from * from.dot(to);
            let length = across.length();
            if normals >= PI {
                normals = PI;
            } else {
                // opposite axes have any plane between them
                let across = if length > 1e-6 { across * (1.0 / length) } else { etendue::Frame::new(from).s };
                let (sin, cos) = (normals - a.normals).sin_cos();
                let turned = (from * cos + across * sin).normalize();
                axis = [turned.x, turned.y, turned.z];
            }
        }
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
            power: self.power + other.power,
            axis,
            normals,
            emission: self.emission.max(other.emission),
            two_sided: self.two_sided | other.two_sided,
        }
    }
    /// The measure of its directions, M_Ω.
    fn directions(&self) -> f32 {
        let (o, w) = (self.normals, (self.normals + self.emission).min(PI));
        let (sin, cos) = o.sin_cos();
        2.0 * PI * (1.0 - cos) + FRAC_PI_2 * (2.0 * w * sin - (o - 2.0 * w).cos() - 2.0 * o * sin + cos)
    }
    fn area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|k| (self.high[k] - self.low[k]).max(0.0));
        2.0 * (x * y + y * z + z * x)
    }
    fn cost(&self) -> f32 {
        if self.power > 0.0 { self.power * self.directions() * self.area() } else { 0.0 }
    }
    fn record(&self, child: u32) -> [f32; 12] {
        let center: [f32; 3] = std::array::from_fn(|k| self.middle(k));
        let half: [f32; 3] = std::array::from_fn(|k| self.high[k] - center[k]);
        let (sin, cos) = self.normals.sin_cos();
        let [ax, ay, az] = self.axis;
        let child = f32::from_bits(child | if self.two_sided { TWO_SIDED } else { 0 });
        let emission = if self.emission >= FRAC_PI_2 { 0.0 } else { self.emission.cos() };
        // rounded, half of the diagonal still reaches the corners
        let radius = dot(half, half).sqrt() * 1.000_001;
        [center[0], center[1], center[2], radius, self.power, ax, ay, az, cos, sin.max(0.0), emission, child]
    }
    /// The importance Φ cosθ'ᵢ cosθ' / d² at points of surfaces.
    #[must_use]
    pub fn importance(&self, p: V8, n: V8) -> X8 {
        Child::of(self.record(0).map(X8::splat)).importance(p, n)
    }
}

/// Two children in the order of three transpositions.
type Pair = [[f32; 8]; 3];

/// One child in each lane.
struct Child {
    center: V8,
    radius: X8,
    power: X8,
    axis: V8,
    /// Cosine and sine of the cone of normals.
    normals: [X8; 2],
    emission: X8,
    child: u32x8,
}

impl Child {
    #[inline(always)]
    fn of(r: [X8; 12]) -> Self {
        Self {
            center: V8::new(r[0], r[1], r[2]),
            radius: r[3],
            power: r[4],
            axis: V8::new(r[5], r[6], r[7]),
            normals: [r[8], r[9]],
            emission: r[10],
            child: r[11].to_bits(),
        }
    }
    #[inline(always)]
    fn importance(&self, p: V8, n: V8) -> X8 {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let clamped = |x: X8| Real::greater(x, zero).sqrt();
        let v = self.center - p;
        let (squared, reach) = (v.length_squared(), self.radius * self.radius);
        let inverse = one / Real::greater(squared, X8::lit(1e-30)).sqrt();
        let inside = squared.le(reach);
        // the angle that the bounding sphere subtends
        let sin_u = Real::blend(inside, zero, self.radius * inverse);
        let cos_u = Real::blend(inside, -one, clamped(one - sin_u * sin_u));
        let cos_i = v.dot(n) * inverse;
        let sin_i = clamped(one - cos_i * cos_i);
        let towards = Real::blend(cos_i.gt(cos_u), one, cos_i * cos_u + sin_i * sin_u);
        let cos_w = -v.dot(self.axis) * inverse;
        let both = M8::from_bits((self.child & u32x8::splat(TWO_SIDED)).simd_eq(u32x8::splat(0)).to_bitmask());
        let cos_w = Real::blend(both, cos_w, cos_w.abs());
        let sin_w = clamped(one - cos_w * cos_w);
        let [cos_o, sin_o] = self.normals;
        let within = cos_w.gt(cos_o);
        let cos_x = Real::blend(within, one, cos_w * cos_o + sin_w * sin_o);
        let sin_x = Real::blend(within, zero, sin_w * cos_o - cos_w * sin_o);
        let facing = Real::blend(cos_x.gt(cos_u), one, cos_x * cos_u + sin_x * sin_u);
        let some = facing.gt(self.emission) & towards.gt(zero);
        (self.power * facing * towards / Real::greater(Real::greater(squared, reach), X8::lit(1e-30))).keep(some)
    }
}

type M8 = <f32x8 as Real>::Mask;

/// The tree.
#[derive(Debug)]
pub struct PublishedTree {
    pairs: Vec<Pair>,
    /// The way to each light: bit k is set if the second child is taken at depth k.
    trails: Vec<u64>,
}

/// Two children that are chosen between, in each lane.
struct Fork {
    child: [u32x8; 2],
    /// Probability of the first; the mask is false where neither can contribute.
    first: X8,
    some: M8,
}

impl PublishedTree {
    /// Builds the tree on the threads of the pool.
    #[must_use]
    pub fn new(lights: &[Cluster]) -> Self {
        let mut order: Vec<u32> = (0..lights.len() as u32).collect();
        let mut pairs = vec![Pair::default(); lights.len().max(2) - 1];
        if lights.len() > 1 {
            build(lights, &mut order, &mut pairs, 0, 0);
        } else {
            pairs[0] = pack(lights.first().unwrap_or(&Cluster::EMPTY), LIGHT, &Cluster::EMPTY, LIGHT);
        }
        let mut tree = Self { pairs, trails: vec![0; lights.len()] };
        let mut pending = vec![(0, 0_u64, 0_u32)];
        while let Some((pair, trail, depth)) = pending.pop() {
            for (side, child) in (0_u64..).zip(tree.children(pair)) {
                let trail = trail | side << depth;
                if child & LIGHT == 0 {
                    pending.push((child, trail, depth + 1));
                } else if let Some(to) = tree.trails.get_mut((child & !LIGHT) as usize)
                    && (side == 0 || lights.len() > 1)
                {
                    *to = trail;
                }
            }
        }
        tree
    }
    /// Size in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.pairs[..]) + size_of_val(&self.trails[..])
    }
    fn children(&self, pair: u32) -> [u32; 2] {
        let pair = &self.pairs[pair as usize];
        [pair[1][3], pair[1][7]].map(|word| word.to_bits() & !TWO_SIDED)
    }
    #[inline(always)]
    fn fork(&self, at: [u32; 8], p: V8, n: V8) -> Fork {
        let rows = at.map(|pair| &self.pairs[pair as usize]);
        let [a, both, b] = [0, 1, 2].map(|k| X8::transpose(rows.map(|row| X8::from(row[k]))));
        let record = |head: [X8; 8], tail: usize| {
            Child::of(std::array::from_fn(|k| if k < 8 { head[k] } else { both[tail + k - 8] }))
        };
        let (a, b) = (record(a, 0), record(b, 4));
        let weights = [a.importance(p, n), b.importance(p, n)];
        let sum = weights[0] + weights[1];
        let some = sum.gt(X8::lit(0.0));
        Fork {
            child: [a.child, b.child].map(|word| word & u32x8::splat(!TWO_SIDED)),
            first: weights[0] / Real::blend(some, sum, X8::lit(1.0)),
            some,
        }
    }
    /// Chooses by `u` in [0, 1), which is stretched again at every level.
    #[inline]
    #[must_use]
    pub fn choose(&self, p: V8, n: V8, mut u: X8) -> Choice<X8> {
        let one = X8::lit(1.0);
        let (mut pmf, mut at, mut index) = (one, u32x8::splat(0), u32x8::splat(NO_LIGHT));
        let mut active = M8::splat(true);
        while active.any() {
            let fork = self.fork(at.to_array(), p, n);
            let left = u.lt(fork.first);
            let second = one - fork.first;
            let probability = Real::blend(left, fork.first, second);
            let stretched = Real::blend(left, u, u - fork.first) / Real::greater(probability, X8::lit(1e-30));
            u = Real::lesser(stretched, X8::lit(1.0 - 1.0 / 16_777_216.0));
            pmf = Real::blend(active, (pmf * probability).keep(fork.some), pmf);
            let child = f32x8::blend_uint(left, fork.child[0], fork.child[1]);
            let light = M8::from_bits(((child & u32x8::splat(LIGHT)).simd_eq(u32x8::splat(LIGHT))).to_bitmask());
            let found = active & fork.some & light;
            index = f32x8::blend_uint(found, child & u32x8::splat(!LIGHT), index);
            active = active & fork.some & !light;
            at = f32x8::blend_uint(active, child, u32x8::splat(0));
        }
        Choice { index, pmf, u }
    }
    /// Probability with which these lights are chosen.
    #[inline]
    #[must_use]
    pub fn pmf(&self, p: V8, n: V8, lights: u32x8) -> X8 {
        let one = X8::lit(1.0);
        let mut trails = lights.to_array().map(|light| self.trails.get(light as usize).copied().unwrap_or(0));
        let known = M8::from_bits(lights.simd_lt(u32x8::splat(self.trails.len() as u32)).to_bitmask());
        let (mut pmf, mut at, mut active) = (one.keep(known), u32x8::splat(0), known);
        while active.any() {
            let fork = self.fork(at.to_array(), p, n);
            let left = u32x8::new(trails.map(|trail| trail as u32 & 1)).simd_eq(u32x8::splat(0));
            let left = M8::from_bits(left.to_bitmask());
            trails = trails.map(|trail| trail >> 1);
            let probability = Real::blend(left, fork.first, one - fork.first);
            pmf = Real::blend(active, (pmf * probability).keep(fork.some), pmf);
            let child = f32x8::blend_uint(left, fork.child[0], fork.child[1]);
            let light = M8::from_bits(((child & u32x8::splat(LIGHT)).simd_eq(u32x8::splat(LIGHT))).to_bitmask());
            active = active & fork.some & !light;
            at = f32x8::blend_uint(active, child, u32x8::splat(0));
        }
        pmf
    }
    /// Probabilities of all lights at one point.
    #[must_use]
    pub fn all(&self, p: [f32; 3], n: [f32; 3]) -> Vec<f64> {
        let (p, n) = (V8::from(p), V8::from(n));
        let (mut own, mut all) = (vec![0.0; self.pairs.len()], vec![0.0; self.trails.len()]);
        own[0] = 1.0;
        // parents come before their children
        for start in (0..self.pairs.len() as u32).step_by(8) {
            let last = self.pairs.len() as u32 - 1;
            let fork = self.fork(std::array::from_fn(|k| (start + k as u32).min(last)), p, n);
            let (first, some) = (fork.first.to_array(), fork.some.bits());
            for (lane, pair) in (start..=last).take(8).enumerate() {
                let probability = if some >> lane & 1 == 1 { own[pair as usize] } else { 0.0 };
                let first = f64::from(first[lane]);
                for (child, share) in fork.child.iter().zip([first, 1.0 - first]) {
                    let child = child.to_array()[lane];
                    let to = if child & LIGHT == 0 {
                        own.get_mut(child as usize)
                    } else {
                        all.get_mut((child & !LIGHT) as usize)
                    };
                    if let Some(to) = to {
                        *to += probability * share;
                    }
                }
            }
        }
        all
    }
}

fn pack(a: &Cluster, first: u32, b: &Cluster, second: u32) -> Pair {
    let a = if a.power > 0.0 { *a } else { Cluster { low: [0.0; 3], high: [0.0; 3], ..*a } };
    let b = if b.power > 0.0 { *b } else { Cluster { low: [0.0; 3], high: [0.0; 3], ..*b } };
    let (a, b) = (a.record(first), b.record(second));
    let row = |from: &[f32]| std::array::from_fn(|k| from[k]);
    [row(&a[..8]), row(&[&a[8..], &b[8..]].concat()), row(&b[..8])]
}

/// Builds the cluster of these lights into `pairs`, the first of which has this index.
fn build(lights: &[Cluster], order: &mut [u32], pairs: &mut [Pair], index: u32, depth: u32) -> Cluster {
    if let [light] = *order {
        return lights[light as usize];
    }
    let middle = split(lights, order, depth);
    let parallel = order.len() > ALONE;
    let (left, right) = order.split_at_mut(middle);
    let word = |order: &[u32], index: u32| if let [light] = *order { light | LIGHT } else { index };
    let words = [word(left, index + 1), word(right, index + middle as u32)];
    let (own, pairs) = pairs.split_first_mut().unwrap_or_else(|| unreachable!("a pair for each inner node"));
    let (first, second) = pairs.split_at_mut(middle - 1);
    let mut a = || build(lights, left, first, index + 1, depth + 1);
    let mut b = || build(lights, right, second, index + middle as u32, depth + 1);
    let (a, b) = if parallel { rayon::join(a, b) } else { (a(), b()) };
    *own = pack(&a, words[0], &b, words[1]);
    a.union(&b)
}

/// Splits where the cost Φ M_Ω K_r area of both parts is least; returns the number of lights in the first.
fn split(lights: &[Cluster], order: &mut [u32], depth: u32) -> usize {
    let light = |index: u32| &lights[index as usize];
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    let mut extent = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for &index in &*order {
        for k in 0..3 {
            let middle = light(index).middle(k);
            (low[k], high[k]) = (low[k].min(middle), high[k].max(middle));
            extent[0][k] = extent[0][k].min(light(index).low[k]);
            extent[1][k] = extent[1][k].max(light(index).high[k]);
        }
    }
    let size: [f32; 3] = std::array::from_fn(|k| extent[1][k] - extent[0][k]);
    let longest = size.into_iter().fold(0.0, f32::max);
    let mut best = (f32::INFINITY, 0, 0);
    for axis in (0..3).filter(|&k| high[k] > low[k] && depth < HALVED) {
        let scale = BINS as f32 / (high[axis] - low[axis]);
        let mut bins = [Cluster::EMPTY; BINS];
        for &index in &*order {
            let bin = bin_of(light(index).middle(axis), low[axis], scale);
            bins[bin] = bins[bin].union(light(index));
        }
        let mut after = [0.0; BINS];
        let mut all = Cluster::EMPTY;
        for k in (1..BINS).rev() {
            all = bins[k].union(&all);
            after[k] = all.cost();
        }
        let mut before = Cluster::EMPTY;
        for k in 1..BINS {
            before = before.union(&bins[k - 1]);
            let cost = (before.cost() + after[k]) * (longest / size[axis]);
            if cost < best.0 && before.power > 0.0 && after[k] > 0.0 {
                best = (cost, axis, k);
            }
        }
    }
    let (cost, axis, first) = best;
    if cost < f32::INFINITY {
        let scale = BINS as f32 / (high[axis] - low[axis]);
        let mut middle = 0;
        for k in 0..order.len() {
            if bin_of(light(order[k]).middle(axis), low[axis], scale) < first {
                order.swap(k, middle);
                middle += 1;
            }
        }
        if middle > 0 && middle < order.len() {
            return middle;
        }
    }
    let widest = (0..3).max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b]))).unwrap_or(0);
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&a, &b| light(a).middle(widest).total_cmp(&light(b).middle(widest)));
    middle
}

fn bin_of(x: f32, low: f32, scale: f32) -> usize {
    (((x - low) * scale) as usize).min(BINS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue::Uint;
    use etendue::sequence::{Independent, Sequence};

    fn lights(count: u32) -> Vec<Cluster> {
        let random = |i: u32, k: u32| {
            let u: etendue::Vec2<f32> = Independent::new(3).pair(i, k, 0);
            [u.x, u.y]
        };
        let light = |i: u32| {
            let ([x, y], [z, size], [a, b], [kind, power]) = (random(i, 0), random(i, 1), random(i, 2), random(i, 3));
            let low = [x, y, z].map(|x| 4.0 * x);
            let normal = Vec3::<f32>::new(a - 0.5, b - 0.5, 0.3).normalize();
            let normal = if kind < 0.3 { [0.0; 3] } else { [normal.x, normal.y, normal.z] };
            Cluster::light([low, low.map(|x| x + 0.1 * size)], normal, power + 0.1, kind > 0.8)
        };
        (0..count).map(light).collect()
    }

    /// The probabilities of all lights sum to 1, or to less where a branch has no light that can contribute; the frequencies agree with
    /// them, and choice and pmf tell the same probability.
    #[test]
    fn lights_are_chosen_as_often_as_their_pmf_says() {
        for count in [1, 2, 3, 40, 5000] {
            let lights = lights(count);
            let tree = PublishedTree::new(&lights);
            for (p, n) in [([2.0, 2.0, -1.0], [0.0, 0.0, 1.0]), ([1.0, 2.5, 3.0], [0.6, 0.0, 0.8])] {
                let all = tree.all(p, n);
                let sum: f64 = all.iter().sum();
                assert!(sum < 1.0 + 1e-5, "{count}: {sum}");
                let (p, n, draws) = (V8::from(p), V8::from(n), 1 << 18);
                let mut found = vec![0.0; all.len()];
                for i in (0..draws).step_by(8) {
                    let lanes = u32x8::from_fn(|k| i + k as u32);
                    let u: etendue::Vec2<X8> = Independent::new(9).pair(u32x8::splat(0), lanes, 0);
                    let choice = tree.choose(p, n, u.x);
                    let pmf = tree.pmf(p, n, choice.index);
                    for lane in 0..8 {
                        if let Some(found) = found.get_mut(choice.index.lane(lane) as usize) {
                            *found += 1.0;
                            assert_eq!(choice.pmf.lane(lane), pmf.lane(lane));
                        } else {
                            assert_eq!(choice.pmf.lane(lane), 0.0);
                        }
                    }
                }
                let drawn: f64 = found.iter().sum::<f64>() / f64::from(draws);
                assert!((drawn - sum).abs() < 5e-3, "{count}: {drawn}, {sum}");
                for (light, (found, pmf)) in found.iter().zip(&all).enumerate() {
                    let (found, deviation) = (found / f64::from(draws), (pmf / f64::from(draws)).sqrt());
                    assert!((found - pmf).abs() <= 6.0 * deviation + 1e-5, "{light} of {count}: {found}, {pmf}");
                }
            }
        }
    }
}
