//! Coated metals in a packet.

use super::fresnel::fresnel;
use super::metal::{Metal, shadowing};
use super::walk::Walk;
use crate::packet::{M8, V8, X8};
use crate::scene::Roughness;
use etendue::warp::GgxVisibleNormals;
use etendue::{Real, Vec2, u32x8};

/// Coated metals in some of the lanes.
#[derive(Clone, Copy)]
pub(super) struct Coated {
    pub(super) lanes: M8,
    /// Roughness of the coat, with which it reflects.
    alpha: [X8; 2],
    /// Probabilities with which the lobe of the coat is sampled, and the whole hemisphere; else it is that of the metal.
    shares: [X8; 2],
    seed: [u32x8; 2],
}

impl Coated {
    #[inline(never)]
    pub(super) fn new(metal: &Metal, view: V8, numbers: Vec2<X8>) -> Self {
        let lanes = metal.walks();
        let [eta, along, across, ..] = metal.through.unwrap_or_default();
        let alpha = [along, across].map(|x| Real::blend(lanes, x.greater(X8::splat(Roughness::LEAST)), X8::lit(1.0)));
        // by what a smooth interface reflects; an eighth finds what is far from both lobes
        let above = fresnel(view.z, Real::blend(lanes, eta, X8::lit(1.0)), X8::lit(0.0));
        let shares = [above.mul_add(X8::lit(0.7), X8::lit(0.05)), X8::lit(0.125)];
        Self { lanes, alpha, shares, seed: [numbers.x.to_bits(), numbers.y.to_bits()] }
    }
    /// f cosθ of a pair of directions to the view and to the light, and its pdf, where the lobe of the metal and that by the cosine have these.
    #[inline(never)]
    pub(super) fn evaluate(&self, metal: &Metal, [view, light]: [V8; 2], [by_metal, by_cosine]: [X8; 2]) -> (V8, X8) {
        let Some(numbers) = &metal.through else { return (V8::default(), by_metal) };
        let m = (light + view).normalize();
        let density = GgxVisibleNormals::new(self.alpha[0], self.alpha[1], view).reflected_pdf(m);
        let eta = Real::blend(self.lanes, numbers[0], X8::lit(1.0));
        let reflected = density * shadowing(self.alpha, view, light) * fresnel(view.dot(m), eta, X8::lit(0.0));
        let under = Walk::new(metal, numbers, self.lanes).under(view, light, self.seed);
        let [above, all] = self.shares;
        let rest = X8::lit(1.0) - above - all;
        let pdf = above.mul_add(density, all.mul_add(by_cosine, rest * by_metal));
        (under + V8::new(reflected, reflected, reflected), pdf)
    }
    /// Numbers for the lobe that the first one chooses, the roughness of that, and the lanes in which it is that by the cosine.
    #[inline(always)]
    pub(super) fn choose(&self, u: Vec2<X8>, below: [X8; 2]) -> (Vec2<X8>, [X8; 2], M8) {
        let [above, all] = self.shares;
        let (first, last) = (u.x.lt(above), u.x.ge(X8::lit(1.0) - all));
        let start = Real::blend(first, X8::lit(0.0), Real::blend(last, X8::lit(1.0) - all, above));
        let width = Real::blend(first, above, Real::blend(last, all, X8::lit(1.0) - above - all));
        let x = Real::blend(self.lanes, ((u.x - start) / width).lesser(X8::lit(LAST)), u.x);
        let alpha = [0, 1].map(|i| Real::blend(self.lanes & first, self.alpha[i], below[i]));
        (Vec2::new(x, u.y), alpha, self.lanes & last)
    }
}

/// The largest number below 1.
pub(super) const LAST: f64 = 1.0 - 1.0 / 16_777_216.0;
