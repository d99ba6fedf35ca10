//! Metals below coats, of which at least one is rough: f cosθ by a random walk between both, right in the mean.
//!
//! Light enters the coat through a visible normal of its interface, the metal reflects it, and the interface lets a part of it out and sends
//! the rest back, as in pbrt-v4's `LayeredBxDF` without a medium: both are GGX microsurfaces with the height-correlated
//! G₂ = 1/(1 + Λᵢ + Λₒ) (Heitz 2014), also for what passes, each of which scatters once. Directions in the coat point up, to where light comes
//! from or goes to, so that both sides of the interface have the same formulas (Walter et al. 2007): with the half vector
//! m ∝ η·inside − outside, of length q before it is normalised, dm/d(outside) = (outside·m)/q² and dm/d(inside) = η²(inside·m)/q².
//!
//! Paths with one reflection by the metal are sampled from the view, from the light, and from both with the metal's value between them,
//! by the balance heuristic (Veach 1997, 9.2.2.1); those with more from the view, with either end.

use super::fresnel::fresnel;
use super::metal::{Metal, shadowing};
use crate::packet::{M8, V8, X8};
use etendue::sequence::Independent;
use etendue::warp::GgxVisibleNormals;
use etendue::{Mask, Real, Vec2, Warp, u32x8};

/// More orders of reflection than count: those from the second on end at random.
const MOST: u32 = 64;
/// The least roughness of a microsurface, as in pbrt: below, it is smooth.
const LEAST: f32 = 1e-3;
/// Denominators are at least this.
const TINY: f64 = 1e-20;

/// A microsurface.
#[derive(Clone, Copy)]
struct Micro {
    alpha: [X8; 2],
    /// Lanes in which it is smooth.
    smooth: M8,
}

impl Micro {
    fn new(alpha: [X8; 2]) -> Self {
        let least = X8::splat(LEAST);
        Self { smooth: alpha[0].lt(least) & alpha[1].lt(least), alpha: alpha.map(|alpha| alpha.greater(least)) }
    }
    fn normals(&self, w: V8) -> GgxVisibleNormals<X8> {
        GgxVisibleNormals::new(self.alpha[0], self.alpha[1], w)
    }
    /// A visible normal.
    fn sample(&self, w: V8, u: [X8; 2]) -> V8 {
        V8::blend(self.smooth, up(), self.normals(w).sample(Vec2::new(u[0], u[1])))
    }
    /// G₂/G₁ of two directions; 1 where it is smooth, and 0 if the second one is below the horizon.
    fn shadowing(&self, i: V8, o: V8) -> X8 {
        Real::blend(self.smooth, X8::lit(1.0), shadowing(self.alpha, i, o)).keep(o.z.gt(X8::lit(0.0)))
    }
}

fn up() -> V8 {
    V8::new(X8::lit(0.0), X8::lit(0.0), X8::lit(1.0))
}

fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}

fn quotient(a: X8, b: X8) -> X8 {
    a / b.greater(X8::lit(TINY))
}

/// The interface of a coat.
#[derive(Clone, Copy)]
struct Interface {
    micro: Micro,
    eta: X8,
}

impl Interface {
    /// Where light from outside goes in the coat, and which part of it.
    fn enter(&self, outside: V8, u: [X8; 2]) -> (V8, X8) {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let m = self.micro.sample(outside, u);
        let cos = outside.dot(m);
        let ratio = one / self.eta;
        let refracted = (one - (one - cos * cos) * ratio * ratio).greater(zero).sqrt();
        let inside = m.mul_add(refracted - cos * ratio, outside * ratio);
        let passed = one - fresnel(cos, self.eta, zero);
        (inside, (passed * self.micro.shadowing(outside, inside)).keep(cos.gt(zero)))
    }
    /// The half vector of a pair of directions, its length before it is normalised, and where it exists.
    fn half(&self, inside: V8, outside: V8) -> (V8, X8, M8) {
        let zero = X8::lit(0.0);
        let half = inside * self.eta - outside;
        let length = half.length_squared().greater(X8::lit(TINY)).sqrt();
        let m = half * (X8::lit(1.0) / length);
        let exists = m.z.gt(zero) & m.dot(inside).gt(zero) & m.dot(outside).gt(zero) & inside.z.gt(zero);
        (m, length, exists)
    }
    /// The pdf with which [`enter`](Self::enter) finds a direction, per steradian in the coat.
    fn density(&self, outside: V8, inside: V8) -> X8 {
        let (m, length, exists) = self.half(inside, outside);
        let jacobian = self.eta * self.eta * inside.dot(m) / (length * length);
        (self.micro.normals(outside).pdf(m) * jacobian).keep(exists & !self.micro.smooth)
    }
    /// The part of light in a direction in the coat that leaves it, per steradian outside; 0 where the interface is smooth.
    fn leave(&self, inside: V8, outside: V8) -> X8 {
        let one = X8::lit(1.0);
        let (m, length, exists) = self.half(inside, outside);
        let passed = one - fresnel(outside.dot(m), self.eta, X8::lit(0.0));
        let jacobian = outside.dot(m) / (length * length);
        let part = self.micro.normals(inside).pdf(m) * jacobian * passed * self.micro.shadowing(inside, outside);
        part.keep(exists & !self.micro.smooth)
    }
    /// Where the interface sends light back, and which part of it.
    fn send_back(&self, inside: V8, u: [X8; 2]) -> (V8, X8) {
        let zero = X8::lit(0.0);
        let m = self.micro.sample(inside, u);
        let cos = inside.dot(m);
        let back = m.mul_add(cos + cos, -inside);
        let part = fresnel(cos, X8::lit(1.0) / self.eta, zero) * self.micro.shadowing(inside, back);
        (back, part.keep(cos.gt(zero)))
    }
}

/// The metal below.
#[derive(Clone, Copy)]
struct Base<'a> {
    micro: Micro,
    metal: &'a Metal,
}

impl Base<'_> {
    /// Where light goes, and which part of it, per channel.
    fn sample(&self, w: V8, u: [X8; 2]) -> (V8, V8) {
        let m = self.micro.sample(w, u);
        let cos = w.dot(m);
        let reflected = m.mul_add(cos + cos, -w);
        let part = self.micro.shadowing(w, reflected).keep(cos.gt(X8::lit(0.0)));
        (reflected, self.metal.fresnel(cos) * part)
    }
    /// The pdf with which [`sample`](Self::sample) finds a direction; 1 where the metal is smooth.
    fn density(&self, w: V8, reflected: V8) -> X8 {
        let density = self.micro.normals(w).reflected_pdf((w + reflected).normalize());
        Real::blend(self.micro.smooth, X8::lit(1.0), density)
    }
    /// The BRDF; 0 where the metal is smooth.
    fn brdf(&self, w: V8, o: V8) -> V8 {
        let m = (w + o).normalize();
        let seen = w.z.gt(X8::lit(0.0)) & o.z.gt(X8::lit(0.0)) & !self.micro.smooth;
        let part = self.micro.normals(w).reflected_pdf(m) * quotient(self.micro.shadowing(w, o), o.z);
        self.metal.fresnel(w.dot(m)) * part.keep(seen)
    }
}

/// The way from one end of a path, outside, into the coat.
#[derive(Clone, Copy)]
struct Way {
    outside: V8,
    inside: V8,
    part: X8,
}

/// A coat over a metal, in the frame of the surface.
pub(super) struct Walk<'a> {
    coat: Interface,
    base: Base<'a>,
    lanes: M8,
}

impl<'a> Walk<'a> {
    /// The layers of the lanes that have them, from the second half of their records.
    pub(super) fn new(metal: &'a Metal, [eta, a, b, c, d, ..]: &[X8; 8], lanes: M8) -> Self {
        // no coat at all would leave no direction of half vectors
        let eta = Real::blend(lanes, (*eta).greater(X8::lit(1.001)), X8::lit(1.5));
        let [above, below] =
            [[*a, *b], [*c, *d]].map(|alpha| Micro::new(alpha.map(|x| Real::blend(lanes, x, X8::lit(1.0)))));
        Self { coat: Interface { micro: above, eta }, base: Base { micro: below, metal }, lanes }
    }

    /// f cosθ of light that has been below the coat, for the unit directions to the view and to the light, by numbers that depend on these
    /// bits.
    pub(super) fn under(&self, view: V8, light: V8, seed: [u32x8; 2]) -> V8 {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let lanes = self.lanes & view.z.gt(zero) & light.z.gt(zero);
        let place = light.x.to_bits() * u32x8::splat(0x9e37_79b1) + light.y.to_bits();
        let numbers = |block: u32| Independent::numbers::<X8>(seed[0], seed[1], place, u32x8::splat(block));
        let way = |outside: V8, u: [X8; 2]| {
            let (inside, part) = self.coat.enter(outside, u);
            Way { outside, inside, part: part.keep(lanes) }
        };
        let [a, b, c, d] = numbers(0);
        let [from_view, from_light] = [way(view, [a, b]), way(light, [c, d])];
        let back = from_light.part * light.z / (self.coat.eta * self.coat.eta);
        let [a, b, c, d] = numbers(1);
        let mut sum = self.between(&from_view, &from_light) * (from_view.part * back);
        let (mut w, mut part, found) = self.from(&from_view, &from_light, [a, b]);
        sum += found;
        let (.., found) = self.from(&from_light, &from_view, [c, d]);
        sum += found * quotient(light.z, view.z);
        for order in 1..MOST {
            let [a, b, c, d] = numbers(2 * order);
            let (down, sent) = self.coat.send_back(w, [a, b]);
            part = part * sent;
            // what is left ends at random
            let most = part.x.greater(part.y).greater(part.z);
            let (chance, [u, ..]) = ((most * X8::lit(3.0)).lesser(one), numbers(2 * order + 1));
            let goes_on = u.lt(chance) & most.gt(zero);
            if !goes_on.any() {
                break;
            }
            let scale = (one / Real::blend(goes_on, chance, one)).keep(goes_on);
            part = part * scale;
            let to_light = self.coat.density(light, from_light.inside);
            let weight = quotient(to_light, to_light + self.base.density(down, from_light.inside));
            let weight = Real::blend(self.coat.micro.smooth, one, weight);
            sum += product(part, self.base.brdf(down, from_light.inside)) * (back * weight);
            let (next, reflected) = self.base.sample(down, [c, d]);
            part = product(part, reflected);
            let own = self.base.density(down, next);
            let other = self.coat.density(light, next).keep(!self.base.micro.smooth);
            sum += part * (self.coat.leave(next, light) * quotient(own, own + other));
            w = next;
        }
        sum.map(|x| x.keep(lanes))
    }

    /// The metal's value between both ends of a path with one reflection, weighed against [`from`](Self::from) either end.
    fn between(&self, a: &Way, b: &Way) -> V8 {
        let one = X8::lit(1.0);
        let ratio = |from: &Way, to: &Way| {
            quotient(self.base.density(from.inside, to.inside), self.coat.density(to.outside, to.inside))
        };
        let weight = one / (one + ratio(a, b) + ratio(b, a));
        self.base.brdf(a.inside, b.inside) * Real::blend(self.coat.micro.smooth, one, weight)
    }

    /// Samples the metal from one end of a path with one reflection: the direction, the part of light that has it, and what reaches the
    /// other end, weighed against the other ways to the same path.
    fn from(&self, a: &Way, b: &Way, u: [X8; 2]) -> (V8, V8, V8) {
        let one = X8::lit(1.0);
        let (w, reflected) = self.base.sample(a.inside, u);
        let part = reflected * a.part;
        let to_other = self.coat.density(b.outside, w);
        let own = self.base.density(a.inside, w);
        let turned = quotient(self.base.density(w, a.inside), self.coat.density(a.outside, a.inside));
        let both = one.keep(!self.base.micro.smooth);
        let weight = one / (one + quotient(to_other, own) * (both + turned));
        (w, part, part * (self.coat.leave(w, b.outside) * weight))
    }
}
