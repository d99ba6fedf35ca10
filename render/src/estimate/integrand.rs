//! What an estimator integrates.

use crate::bvh::GROUP;
use crate::packet::{M8, V8, X8};
use etendue::{Mask, u32x8};

/// The light that a group of shading points reflects, or what is left of it to be sampled.
///
/// What is left may lack whole lights ([`remaining`](Self::remaining)), a part g of f · cosθ that was integrated over a light before
/// ([`fit`](Self::fit)), or a part of its visibility ([`part`](Self::part)). The latter two are control variates: an estimator
/// samples (f cosθ − g) · L · V, or f cosθ · L · (V − part), so that its mean and the integral of the part together are the light.
pub(crate) trait Integrand {
    /// Lanes in which each light remains, for each light and packet; all of them everywhere, if `None`.
    fn remaining(&self) -> Option<&[[M8; GROUP]]>;
    /// Whether no light remains anywhere.
    fn is_empty(&self) -> bool;
    /// What is proved of these lights, one for each lane of a packet, if anything is.
    fn proof(&self, packet: usize, lights: u32x8) -> Option<Proof>;
    /// The part of f · cosθ that was integrated over lights [where that is so](Proof::fitted), for the unit directions `w` with the cosine
    /// `cos` to the normal.
    fn fit(&self, packet: usize, w: V8, cos: X8) -> V8;
    /// The part of these lights that was counted as visible, if such parts were.
    fn part(&self, packet: usize, lights: u32x8) -> Option<X8>;
}

/// What is proved of a light, as seen from a packet.
#[derive(Clone, Copy)]
pub(crate) struct Proof {
    /// Lanes in which the [fit](Integrand::fit) was integrated over the light.
    pub(crate) fitted: M8,
    /// Lanes that see all of the light, so that samples need no shadow ray.
    pub(crate) lit: M8,
    /// Lanes that see nothing of the light.
    pub(crate) dark: M8,
}

impl Default for Proof {
    fn default() -> Self {
        let none = M8::splat(false);
        Self { fitted: none, lit: none, dark: none }
    }
}

/// All of the light, of which nothing is known.
pub(crate) struct Plain;

impl Integrand for Plain {
    #[inline(always)]
    fn remaining(&self) -> Option<&[[M8; GROUP]]> {
        None
    }
    #[inline(always)]
    fn is_empty(&self) -> bool {
        false
    }
    #[inline(always)]
    fn proof(&self, _: usize, _: u32x8) -> Option<Proof> {
        None
    }
    #[inline(always)]
    fn fit(&self, _: usize, _: V8, _: X8) -> V8 {
        V8::default()
    }
    #[inline(always)]
    fn part(&self, _: usize, _: u32x8) -> Option<X8> {
        None
    }
}
