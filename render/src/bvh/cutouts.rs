//! Triangles with holes: opacity that varies over them.

use super::primitive::PrimitiveId;
use crate::packet::{V8, each_bit};
use crate::scene::texture::Mask;
use std::sync::Arc;

/// Instead of an index: the triangle has no mask.
const OPAQUE: u32 = u32::MAX;

/// The mask of a triangle.
#[derive(Clone, Copy, Debug)]
struct Cut {
    mask: u32,
    /// Texture coordinates of the corners.
    uvs: [[f32; 2]; 3],
}

/// The masks of the triangles of a tree, in leaf order.
#[derive(Debug)]
pub(super) struct Cutouts {
    masks: Arc<[Mask]>,
    /// For each triangle an index into `cuts`, or [`OPAQUE`].
    of: Vec<u32>,
    cuts: Vec<Cut>,
}

impl Cutouts {
    /// From the mask and the texture coordinates of each triangle that has one. `None` if none does.
    pub(super) fn new(
        masks: &Arc<[Mask]>,
        triangles: impl Iterator<Item = Option<(u32, [[f32; 2]; 3])>>,
    ) -> Option<Self> {
        let mut cuts = Vec::new();
        let of = triangles.map(|cut| {
            cut.map_or(OPAQUE, |(mask, uvs)| {
                cuts.push(Cut { mask, uvs });
                (cuts.len() - 1) as u32
            })
        });
        let of = of.collect();
        (!cuts.is_empty()).then(|| Self { masks: Arc::clone(masks), of, cuts })
    }
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.of[..]) + size_of_val(&self.cuts[..])
    }
    /// Whether a triangle has a mask.
    pub(super) fn has(&self, triangle: usize) -> bool {
        self.of[triangle] != OPAQUE
    }
    /// The lanes of `hit` in which a ray meets what is opaque. `lane` tells of each its index, the triangle, and the weights of
    /// its corners at the hit, whose sum is not 1.
    ///
    /// Where a triangle is partly opaque, a random number decides, which depends on the ray and the triangle alone (PBR 4th ed., 4.5.1): a
    /// ray that is traced twice meets the same.
    #[inline(never)]
    pub(super) fn opaque(
        &self,
        hit: u32,
        origin: V8,
        direction: V8,
        lane: impl Fn(usize) -> (usize, PrimitiveId, [f32; 3]),
    ) -> u32 {
        let mut opaque = hit;
        each_bit(hit, |k| {
            let (index, triangle, weights) = lane(k);
            let Some(cut) = self.cuts.get(self.of[index] as usize) else { return };
            let mask = &self.masks[cut.mask as usize];
            let sum = weights[0] + weights[1] + weights[2];
            // the weights of slivers may be nothing but rounding error
            let [_, s, t] = weights.map(|w| (w / sum).clamp(0.0, 1.0)).map(|w| if w.is_nan() { 0.0 } else { w });
            let at = |axis: usize| {
                let [a, b, c] = cut.uvs.map(|uv| uv[axis]);
                a + (b - a) * s + (c - a) * t
            };
            let opacity = mask.opacity.at([at(0), at(1)])[0];
            let stops = match mask.least {
                Some(least) => opacity >= least,
                None => number(triangle, origin.lane(k).into(), direction.lane(k).into()) < opacity,
            };
            if !stops {
                opaque &= !(1 << k);
            }
        });
        opaque
    }
}

/// A number in [0, 1) that depends on a ray and a triangle.
fn number(triangle: PrimitiveId, origin: [f32; 3], direction: [f32; 3]) -> f32 {
    // the finalizer of MurmurHash3 (Appleby 2011) after each word
    let mixed = |h: u64, word: u32| {
        let h = (h ^ u64::from(word)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (h ^ h >> 33).wrapping_mul(0xc4ce_b9fe_1a85_ec53) ^ h >> 29
    };
    let words = origin.into_iter().chain(direction).map(f32::to_bits);
    let h = words.chain([triangle.0]).fold(0x9e37_79b9_7f4a_7c15, mixed);
    (h >> 40) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::texture::{Mapping, Texture};

    #[test]
    fn numbers_are_uniform_and_differ_between_triangles_and_rays() {
        let count = 20_000;
        let mut bins = [0; 16];
        let (mut products, mut last) = (0.0, 0.5);
        for i in 0..count {
            // successive floats, as neighbouring samples have them
            let x = f32::from_bits(0x3f80_0000 + i / 4);
            let u = number(PrimitiveId::of_triangle(i % 4), [1.0, 2.0, 3.0], [x, 0.5, 0.25]);
            bins[(u * 16.0) as usize] += 1;
            products += f64::from((u - 0.5) * (last - 0.5));
            last = u;
        }
        // four and a half standard deviations
        let expected = f64::from(count) / 16.0;
        let worst = bins.iter().map(|&n| (f64::from(n) - expected).abs()).fold(0.0, f64::max);
        assert!(worst < 4.5 * expected.sqrt(), "{bins:?}");
        assert!((products / f64::from(count)).abs() < 4.5 / 12.0 / f64::from(count).sqrt(), "{products}");
    }

    #[test]
    fn cutoffs_stop_what_reaches_them() {
        let picture = Texture::Checkerboard(
            Arc::new([0.5, 0.25].map(Texture::number)),
            Mapping([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        );
        let mask = |least: f32| Mask { opacity: picture.clone(), least: Some(least) };
        let masks: Arc<[Mask]> = [0.5, 0.51, 0.25, 0.0].map(mask).into();
        let uvs = [[0.5, 0.5], [1.5, 0.5], [0.5, 0.5]];
        let cutouts = Cutouts::new(&masks, (0..5).map(|mask| (mask < 4).then_some((mask, uvs)))).unwrap();
        // at the first corner, the second, and on either side of their middle; a sliver has no weights
        let weights = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.1, 1.9, 0.0], [-1.9, -2.1, 0.0], [0.0; 3]];
        let stopped = |triangle: usize| {
            cutouts.opaque(0b11111, V8::default(), V8::default(), |k| {
                (triangle, PrimitiveId::of_triangle(triangle as u32), weights[k])
            })
        };
        assert_eq!([0, 1, 2, 3, 4].map(stopped), [0b10101, 0, 0b11111, 0b11111, 0b11111]);
        assert_eq!([3, 4].map(|triangle| cutouts.has(triangle)), [true, false]);
    }
}
