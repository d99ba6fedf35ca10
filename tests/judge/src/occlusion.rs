//! Lights behind occluders, and the properties of their visible parts that hold for any numbers.

use crate::packets::{twice, vectors_of};
use core::f32::consts::PI;
use etendue::{Real, f32x4, f32x8, f32x16};
use etendue_visible::{Occlusion, Solid};

/// A light, occluders, and eight points with the normals of their surfaces.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The light.
    pub light: Solid,
    /// The occluders.
    pub occluders: Vec<Solid>,
    /// The shading points.
    pub points: [[f32; 3]; 8],
    /// Unit normals.
    pub normals: [[f32; 3]; 8],
}

impl Scene {
    /// Ω⊥ of the visible part from the points `first` and after, in any precision and width. Sixteen lanes have the points [`twice`].
    #[must_use]
    pub fn found<R: Real>(&self, first: usize) -> Option<R> {
        let (points, normals) = (twice(&self.points), twice(&self.normals));
        let [p, n] = [points, normals].map(|v| vectors_of::<R>(|i| v[first + i]));
        Occlusion::new().visible(p, n, &self.light, &self.occluders)
    }
    /// **Total**: results are finite, at least 0, and at most what there is without occluders.
    pub fn total(&self) {
        let bare = Self { occluders: Vec::new(), ..self.clone() };
        let all = bare.found::<f32x8>(0).expect("there are no occluders");
        let left = self.found::<f32x8>(0).unwrap_or_default();
        for (all, left) in all.as_array().iter().zip(left.as_array()) {
            assert!(all.is_finite() && (0.0..=PI).contains(all), "{all}: {self:?}");
            assert!((0.0..=*all).contains(left), "{left} of {all}: {self:?}");
        }
    }
    /// **Lane-identical**: f32, f32x4, f32x8 and f32x16 give the same bits. What eight lanes can compute, each can alone; four may have too
    /// many corners.
    pub fn lanes(&self) {
        let Some(eight) = self.found::<f32x8>(0) else { return };
        let sixteen = self.found::<f32x16>(0).map(|x| x.to_array().map(f32::to_bits));
        let expected = twice(&eight.to_array().map(f32::to_bits));
        assert_eq!(sixteen, Some(expected), "{self:?}");
        for lane in 0..8 {
            let four = self.found::<f32x4>(lane / 4 * 4).map(|x| x.lane(lane % 4).to_bits());
            let one = self.found::<f32>(lane).map(f32::to_bits);
            let expected = Some(eight.lane(lane).to_bits());
            let four_agree = four.is_none() || four == expected;
            assert!(one == expected && four_agree, "lane {lane}: {one:?} {four:?} {expected:?}: {self:?}");
        }
    }
    /// **Threshold-free**: multiplying all lengths by a power of two changes no bit.
    pub fn scale(&self, exponent: i32) {
        let factor = 2.0_f32.powi(exponent);
        let times = |shape: &Solid| shape.scaled(factor.into());
        let scaled = Self {
            light: times(&self.light),
            occluders: self.occluders.iter().map(times).collect(),
            points: self.points.map(|p| p.map(|x| x * factor)),
            normals: self.normals,
        };
        let [one, other] = [self, &scaled].map(|scene| scene.found::<f32x8>(0).map(|x| x.as_array().map(f32::to_bits)));
        assert_eq!(one, other, "times 2^{exponent}: {self:?}");
    }
}
