//! Lights of no extent, and what surfaces emit.

use crate::geometry::spread::Spread;

/// A light that is seen from every point in a single direction, and that no ray can hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeltaLight {
    /// A point light of the same intensity in all directions.
    Point {
        /// World position.
        position: [f32; 3],
        /// Radiant intensity, linear RGB.
        intensity: [f32; 3],
    },
    /// A spotlight: a cone whose intensity falls off smoothly between two angles.
    Spot {
        /// World position.
        position: [f32; 3],
        /// Unit vector along which the light travels.
        axis: [f32; 3],
        /// 1 − cosθ of the angle up to which the intensity is constant.
        one_minus_cos_inner: f32,
        /// 1 − cosθ of the angle from which on the intensity is 0.
        one_minus_cos_outer: f32,
        /// Radiant intensity on the axis, linear RGB.
        intensity: [f32; 3],
    },
    /// A point light whose intensity differs by direction.
    Directed {
        /// World position.
        position: [f32; 3],
        /// Rows of the orthogonal matrix from world space to the space of its intensity.
        to_light: [[f32; 3]; 3],
        /// Greatest radiant intensity, linear RGB.
        intensity: [f32; 3],
        /// Index of its relative intensity in the scene.
        table: u32,
        /// The cone of a spot light, by whose falloff the intensity is multiplied.
        cone: Option<Cone>,
    },
    /// Parallel light from infinitely far away.
    Distant {
        /// Unit vector towards the light.
        direction: [f32; 3],
        /// Irradiance of a surface that faces the light, linear RGB.
        irradiance: [f32; 3],
    },
}

/// The cone of a spot light whose intensity differs by direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit vector along which the light travels.
    pub axis: [f32; 3],
    /// 1 − cosθ of the angle up to which the falloff is 1.
    pub one_minus_cos_inner: f32,
    /// 1 − cosθ of the angle from which on it is 0.
    pub one_minus_cos_outer: f32,
    /// ∫ falloff · relative intensity dω, in steradians.
    pub flux: f64,
}

/// Emission of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Emission {
    /// Radiance, linear RGB; at least one channel is greater than 0. With a picture, it is the mean over the surface.
    pub radiance: [f32; 3],
    /// Whether both sides emit, or only the side of the normal.
    pub two_sided: bool,
    /// The picture that the surface shows, if its radiance varies: an index into [`Scene::pictures`](super::Scene::pictures).
    pub picture: Option<u32>,
    /// The cone about the normal within which a flat light emits, unless that is all of a hemisphere. Of a light with a profile only the
    /// angle counts.
    pub spread: Option<Spread<f32>>,
    /// How a flat light distributes what it emits, if not by the spread: an index into [`Scene::profiles`](super::Scene::profiles).
    pub profile: Option<u32>,
    /// Whether no ray hits the surface: it lights others, and is neither seen nor in the way, as a lamp of opacity 0.
    pub is_unseen: bool,
}

impl Emission {
    /// Whether its radiance is the same at all points and in all directions of the sides that emit.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.picture.is_none() && self.spread.is_none() && self.profile.is_none()
    }
}
