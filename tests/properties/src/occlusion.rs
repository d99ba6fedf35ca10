//! Lights behind blockers, and the properties of their visible parts that hold for any numbers.

use crate::properties::vectors_of;
use etendue::occlusion::{Convex, Occlusion};
use etendue::{Real, Vec3, f32x4, f32x8};

/// A light, blockers, and eight points with the normals of their surfaces.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The light.
    pub light: Convex<f32>,
    /// The blockers.
    pub blockers: Vec<Convex<f32>>,
    /// The shading points.
    pub points: [[f32; 3]; 8],
    /// Unit normals.
    pub normals: [[f32; 3]; 8],
}

fn converted<S: From<f32>>(shape: &Convex<f32>) -> Convex<S> {
    let vector = |v: Vec3<f32>| Vec3 { x: v.x.into(), y: v.y.into(), z: v.z.into() };
    match *shape {
        Convex::Polygon { corners, count } => Convex::Polygon { corners: corners.map(vector), count },
        Convex::Sphere { center, radius } => Convex::Sphere { center: vector(center), radius: radius.into() },
    }
}

impl Scene {
    /// Ω⊥ of the visible part from the points `first` and after, in any precision and width.
    #[must_use]
    pub fn found<R: Real>(&self, first: usize) -> Option<R>
    where
        R::Scalar: From<f32>,
    {
        let blockers: Vec<_> = self.blockers.iter().map(converted).collect();
        Occlusion::new().visible(
            vectors_of::<R>(|i| self.points[first + i]),
            vectors_of::<R>(|i| self.normals[first + i]),
            &converted(&self.light),
            &blockers,
        )
    }
    /// The results are finite, at least 0, and at most what there is without blockers.
    ///
    /// # Panics
    /// If they are not.
    pub fn total(&self) {
        let bare = Self { blockers: Vec::new(), ..self.clone() };
        let all = bare.found::<f32x8>(0).expect("there are no blockers");
        let left = self.found::<f32x8>(0).unwrap_or_default();
        for (all, left) in all.as_array().iter().zip(left.as_array()) {
            assert!(all.is_finite() && (0.0..=core::f32::consts::PI).contains(all), "{all}: {self:?}");
            assert!((0.0..=*all).contains(left), "{left} of {all}: {self:?}");
        }
    }
    /// f32, f32x4 and f32x8 give the same bits. What eight lanes can compute, each can alone.
    ///
    /// # Panics
    /// If they do not.
    pub fn lanes(&self) {
        let Some(eight) = self.found::<f32x8>(0) else { return };
        for lane in 0..8 {
            let four = self.found::<f32x4>(lane / 4 * 4).map(|x| x.lane(lane % 4).to_bits());
            let one = self.found::<f32>(lane).map(f32::to_bits);
            let expected = Some(eight.lane(lane).to_bits());
            assert!(one == expected && four == expected, "lane {lane}: {one:?} {four:?} {expected:?}: {self:?}");
        }
    }
    /// Multiplying all lengths by a power of two changes no bit.
    ///
    /// # Panics
    /// If it does.
    pub fn scale(&self, exponent: i32) {
        let factor = 2.0_f32.powi(exponent);
        let times = |shape: &Convex<f32>| match *shape {
            Convex::Polygon { corners, count } => Convex::Polygon { corners: corners.map(|c| c * factor), count },
            Convex::Sphere { center, radius } => Convex::Sphere { center: center * factor, radius: radius * factor },
        };
        let scaled = Self {
            light: times(&self.light),
            blockers: self.blockers.iter().map(times).collect(),
            points: self.points.map(|p| p.map(|x| x * factor)),
            normals: self.normals,
        };
        let [one, other] = [self, &scaled].map(|scene| scene.found::<f32x8>(0).map(|x| x.as_array().map(f32::to_bits)));
        assert_eq!(one, other, "times 2^{exponent}: {self:?}");
    }
}
