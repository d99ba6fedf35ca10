//! How surfaces reflect.

use super::texture::Texture;
use std::sync::Arc;

/// How a surface reflects, the same on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// A Lambertian surface with this albedo, linear RGB.
    Diffuse([f32; 3]),
    /// A perfect mirror with this reflectance at every angle, linear RGB.
    Mirror([f32; 3]),
    /// A metal with Fresnel reflectance.
    Conductor {
        /// Real part of the index of refraction, per channel.
        eta: [f32; 3],
        /// Imaginary part of the index, per channel: the absorption coefficient.
        k: [f32; 3],
        /// Roughness of the GGX distribution; 0 in both directions is a perfect mirror.
        roughness: Roughness,
    },
    /// A rough surface over a diffuse one: f = (1 − F) diffuse/π + F D G₂/(4 cosθᵢ cosθₒ), with the GGX distribution and Schlick's
    /// F = F₀ + (F₉₀ − F₀)(1 − cosθₕ)⁵ (glTF 2.0, appendix B).
    Glossy {
        /// Albedo of the diffuse part, linear RGB.
        diffuse: [f32; 3],
        /// Reflectance F₀ of the rough part at normal incidence, linear RGB.
        specular: [f32; 3],
        /// Reflectance F₉₀ of the rough part at grazing incidence, linear RGB.
        grazing: [f32; 3],
        /// Roughness of the GGX distribution, at least [`Roughness::LEAST`] in both directions.
        roughness: Roughness,
        /// Whether the diffuse part is dimmed in all channels by the greatest one of F, and not in each by its own
        /// (`KHR_materials_specular`).
        greatest: bool,
    },
    /// A diffuse surface below a dielectric interface, with the light that this sends back: [`coat`](crate::surfaces::coat) has the formula.
    Layered {
        /// Albedo of the diffuse surface, linear RGB.
        diffuse: [f32; 3],
        /// Index of refraction of the coat, at least 1.
        eta: f32,
        /// Roughness of the GGX distribution, at least [`Roughness::LEAST`] in both directions.
        roughness: Roughness,
    },
    /// A metal below a dielectric interface, with the light that goes back and forth between them. If both are smooth, it is a perfect mirror:
    /// F + (1 − F)² R/(1 − F R), where F is the reflectance of the interface and R that of the metal in the coat, at the refracted direction.
    /// Otherwise each sample estimates it by a random walk between both.
    CoatedConductor {
        /// Real part of the index of refraction of the metal, per channel, relative to air.
        eta: [f32; 3],
        /// Imaginary part, per channel, relative to air.
        k: [f32; 3],
        /// Roughness of the GGX distribution of the metal.
        roughness: Roughness,
        /// Index of refraction of the coat, at least 1.
        coat: f32,
        /// Roughness of the GGX distribution of the interface; below 0.01 what it reflects is that of 0.01, unless the metal is smooth, too.
        interface: Roughness,
    },
    /// The material of this index in [`Scene::varying`](super::Scene::varying), which varies over the surface.
    Varying(u32),
}

/// Roughness α of a GGX distribution, which may differ by direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// α in the direction `turn`, 0 to 1.
    pub along: f32,
    /// α at right angles to it, 0 to 1.
    pub across: f32,
    /// The direction, in radians: 0 is that of growing u, and π/2 is at right angles to it on the side of falling v. Surfaces without
    /// texture coordinates choose a direction.
    pub turn: f32,
}

impl Roughness {
    /// The least roughness of [`Material::Glossy`] and [`Material::Layered`]: a smooth coat is that of this roughness.
    pub const LEAST: f32 = 0.01;

    /// Whether it is the same in all directions.
    #[must_use]
    pub const fn is_isotropic(self) -> bool {
        self.along == self.across
    }
    /// Whether it is 0 in all directions.
    #[must_use]
    pub const fn is_smooth(self) -> bool {
        self.along == 0.0 && self.across == 0.0
    }
    /// The geometric mean in all directions.
    #[must_use]
    pub fn mean(self) -> Self {
        if self.is_isotropic() { self.along.into() } else { (self.along * self.across).sqrt().into() }
    }
}

impl From<f32> for Roughness {
    /// The same roughness in all directions.
    fn from(alpha: f32) -> Self {
        Self { along: alpha, across: alpha, turn: 0.0 }
    }
}

/// A material whose numbers vary over the surface. Shapes that are not triangles have its mean.
#[derive(Clone, Debug, PartialEq)]
pub enum Varying {
    /// [`Material::Diffuse`] with this albedo.
    Diffuse(Texture),
    /// [`Material::Glossy`].
    Glossy {
        /// Albedo of the diffuse part.
        diffuse: Texture,
        /// Reflectance of the rough part at normal incidence.
        specular: Texture,
        /// Reflectance of the rough part at grazing incidence.
        grazing: Texture,
        /// Roughness α in the direction `turn`, and at right angles to it.
        roughness: [Texture; 2],
        /// As [`Roughness::turn`], in radians.
        turn: f32,
        /// As in [`Material::Glossy`].
        greatest: bool,
    },
    /// [`Material::Layered`].
    Layered {
        /// Albedo of the diffuse surface.
        diffuse: Texture,
        /// Index of refraction of the coat.
        eta: f32,
        /// Roughness α along and across.
        roughness: [Texture; 2],
    },
    /// [`Material::Glossy`] by glTF's parameters.
    Metallic {
        /// The albedo of a dielectric, or F₀ of a metal.
        base: Texture,
        /// 0 for a dielectric with F₀ = 0.04, 1 for a metal.
        metallic: Texture,
        /// The square root of α.
        roughness: Texture,
    },
    /// A material that does not vary.
    Constant(Material),
    /// A material whose normals vary.
    Relief(Arc<(Varying, NormalMap)>),
}

/// Normals that vary over a surface, in the frame of the direction in which u grows, one at right angles to it, and the outward normal.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMap {
    /// Channels from 0 to 1 stand for the components of a normal, from −1 to 1.
    pub texture: Texture,
    /// What the first two components are multiplied by.
    pub scale: f32,
    /// Whether the second axis is turned to where v falls, as in glTF; else the frame is right-handed, as in pbrt.
    pub follows_v: bool,
}

impl NormalMap {
    /// The components of the normal at texture coordinates, of any length.
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> [f64; 3] {
        let [x, y, z] = self.texture.at(uv).map(|x| 2.0 * f64::from(x) - 1.0);
        let scale = f64::from(self.scale);
        [scale * x, scale * y, z]
    }
}

impl Varying {
    /// The material at texture coordinates.
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> Material {
        self.tinted(uv, [1.0; 3])
    }
    /// The material at texture coordinates, with a colour by which its albedo, or the base colour of a metal, is multiplied.
    #[must_use]
    pub fn tinted(&self, uv: [f32; 2], tint: [f32; 3]) -> Material {
        self.with(|texture| texture.at(uv), tint)
    }
    /// The material of the textures' means.
    #[must_use]
    pub fn mean(&self) -> Material {
        self.with(Texture::mean, [1.0; 3])
    }
    /// Whether it is glossy anywhere.
    #[must_use]
    pub fn is_glossy(&self) -> bool {
        match self {
            Self::Diffuse(_) => false,
            Self::Constant(material) => material.is_glossy(),
            Self::Relief(of) => of.0.is_glossy(),
            _ => true,
        }
    }
    /// Its normals, if they vary.
    #[must_use]
    pub fn normals(&self) -> Option<&NormalMap> {
        if let Self::Relief(of) = self { Some(&of.1) } else { None }
    }
    /// The material itself, if no texture varies.
    #[must_use]
    pub fn constant(&self) -> Option<Material> {
        let textures = match self {
            Self::Diffuse(albedo) => [albedo; 5],
            Self::Glossy { diffuse, specular, grazing, roughness: [along, across], .. } => {
                [diffuse, specular, grazing, along, across]
            }
            Self::Layered { diffuse, roughness: [along, across], .. } => [diffuse, along, across, along, across],
            Self::Metallic { base, metallic, roughness } => [base, metallic, roughness, roughness, roughness],
            Self::Constant(material) => return Some(*material),
            Self::Relief(_) => return None,
        };
        textures.iter().all(|texture| texture.constant().is_some()).then(|| self.mean())
    }
    fn with(&self, value: impl Fn(&Texture) -> [f32; 3], tint: [f32; 3]) -> Material {
        // textures may hold any numbers
        let share = |x: f32| x.clamp(0.0, 1.0);
        let color = |texture: &Texture| value(texture).map(share);
        let tinted = |texture: &Texture| {
            let color = color(texture);
            std::array::from_fn::<f32, 3, _>(|k| color[k] * tint[k])
        };
        let alpha = |x: f32| share(x).max(Roughness::LEAST);
        match self {
            Self::Constant(material) => *material,
            Self::Relief(of) => of.0.with(value, tint),
            Self::Diffuse(albedo) => Material::Diffuse(tinted(albedo)),
            Self::Layered { diffuse, eta, roughness } => {
                let [along, across] = roughness.each_ref().map(|texture| alpha(value(texture)[0]));
                let roughness = Roughness { along, across, turn: 0.0 };
                Material::Layered { diffuse: tinted(diffuse), eta: *eta, roughness }
            }
            Self::Glossy { diffuse, specular, grazing, roughness, turn, greatest } => {
                let [along, across] = roughness.each_ref().map(|texture| alpha(value(texture)[0]));
                let roughness = Roughness { along, across, turn: *turn };
                let [diffuse, specular, grazing] = [tinted(diffuse), color(specular), color(grazing)];
                Material::Glossy { diffuse, specular, grazing, roughness, greatest: *greatest }
            }
            Self::Metallic { base, metallic, roughness } => {
                let (base, metallic, roughness) = (tinted(base), share(value(metallic)[0]), share(value(roughness)[0]));
                Material::Glossy {
                    diffuse: base.map(|x| x * (1.0 - metallic)),
                    specular: base.map(|x| 0.04 + (x - 0.04) * metallic),
                    grazing: [1.0; 3],
                    roughness: alpha(roughness * roughness).into(),
                    greatest: false,
                }
            }
        }
    }
}

impl Material {
    /// Whether the material reflects nothing at all.
    pub fn is_black(&self) -> bool {
        matches!(self, Self::Diffuse(c) | Self::Mirror(c) if *c == [0.0; 3])
    }
    /// Whether the material is a perfect mirror.
    pub fn is_mirror(&self) -> bool {
        match self {
            Self::Mirror(_) => true,
            Self::Conductor { roughness, .. } => roughness.is_smooth(),
            Self::CoatedConductor { roughness, interface, .. } => roughness.is_smooth() && interface.is_smooth(),
            _ => false,
        }
    }
    /// The roughness of a rough surface or coat.
    #[must_use]
    pub fn roughness(&self) -> Option<Roughness> {
        match *self {
            Self::Conductor { roughness, .. } | Self::Glossy { roughness, .. } | Self::Layered { roughness, .. } => {
                Some(roughness)
            }
            // the one that shows
            Self::CoatedConductor { roughness, interface, .. } if roughness.is_isotropic() => Some(interface),
            Self::CoatedConductor { roughness, .. } => Some(roughness),
            _ => None,
        }
    }
    /// Whether the material reflects more in some directions than a diffuse one, but is no mirror. Of varying ones [`Varying`] knows.
    pub fn is_glossy(&self) -> bool {
        self.roughness().is_some() && !self.is_mirror()
    }
    /// The material with the mean of its roughness in all directions.
    #[must_use]
    pub fn isotropic(mut self) -> Self {
        match &mut self {
            Self::Conductor { roughness, .. } | Self::Glossy { roughness, .. } | Self::Layered { roughness, .. } => {
                *roughness = roughness.mean();
            }
            Self::CoatedConductor { roughness, interface, .. } => {
                [*roughness, *interface] = [roughness.mean(), interface.mean()];
            }
            _ => {}
        }
        self
    }
}
