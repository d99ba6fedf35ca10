//! How lights are sampled.

use crate::named::named;
use etendue::estimate::Heuristic;

named! {
    /// How a light is sampled.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Technique {
        /// Directions uniform over the hemisphere; rays hit lights by chance
        UniformHemisphere = "uniform-hemisphere",
        /// Directions in proportion to the cosine; rays hit lights by chance
        CosineHemisphere = "cosine-hemisphere",
        /// Points uniform over a light's area
        Area = "area",
        /// Directions uniform over the solid angle of a light
        SolidAngle = "solid-angle",
        /// Directions uniform over the projected solid angle of a light
        ProjectedSolidAngle = "projected-solid-angle",
        /// Directions by the BSDF: the cosine, or the visible normals of a rough metal
        Brdf = "brdf",
        /// Solid-angle and brdf, combined by the balance heuristic
        MisBalance = "mis-balance",
        /// Solid-angle and brdf, combined by the power heuristic
        MisPower = "mis-power",
        /// Mis-power, but spheres that rough metals reflect are sampled by the lobe of the metal alone
        MisLobe = "mis-lobe",
        /// Exact where geometry tells what occludes a light, and nearly so on rough surfaces; the rest by solid angle, or as mis-lobe
        Analytic = "analytic",
        /// Choose for me: what a trial finds best, or in small images analytic for at most 32 area lights and a pinhole camera, else mis-lobe or solid-angle
        Auto = "auto",
    }
}

impl Technique {
    /// Whether rays find the lights by chance, so that no light is sampled.
    pub fn finds_lights(self) -> bool {
        matches!(self, Self::UniformHemisphere | Self::CosineHemisphere | Self::Brdf)
    }
    /// How samples of a light and of the BSDF are combined, if they are.
    pub fn heuristic(self) -> Option<Heuristic> {
        match self {
            Self::MisBalance => Some(Heuristic::Balance),
            Self::MisPower | Self::MisLobe => Some(Heuristic::POWER),
            _ => None,
        }
    }
    /// Whether spheres that rough metals reflect are sampled by the lobe alone, where light and BSDF are combined otherwise.
    pub fn samples_lobes(self) -> bool {
        matches!(self, Self::MisLobe | Self::Analytic)
    }
    /// The measure by which it samples lights; solid angle for techniques that sample none.
    pub fn measure(self) -> Measure {
        match self {
            Self::Area => Measure::Area,
            Self::ProjectedSolidAngle => Measure::Projected,
            _ => Measure::SolidAngle,
        }
    }
}

/// The measure by which points of a light are uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Area of the light.
    Area,
    /// Solid angle at the shading point.
    SolidAngle,
    /// Solid angle projected on the surface there.
    Projected,
}
