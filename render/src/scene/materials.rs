//! How surfaces reflect.

use crate::texture::Texture;

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
        /// Roughness α of the GGX distribution; 0 is a perfect mirror.
        alpha: f32,
    },
    /// A rough surface over a diffuse one: f = (1 − F) diffuse/π + F D G₂/(4 cosθᵢ cosθₒ), with the GGX distribution and Schlick's
    /// F = F₀ + (1 − F₀)(1 − cosθₕ)⁵ (glTF 2.0, appendix B).
    Glossy {
        /// Albedo of the diffuse part, linear RGB.
        diffuse: [f32; 3],
        /// Reflectance F₀ of the rough part at normal incidence, linear RGB.
        specular: [f32; 3],
        /// Roughness α of the GGX distribution, at least [`Material::LEAST_ALPHA`].
        alpha: f32,
    },
    /// The material of this index in [`Scene::varying`](super::Scene::varying), which varies over the surface.
    Varying(u32),
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
        /// Roughness α.
        alpha: Texture,
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
}

impl Varying {
    /// The material at texture coordinates.
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> Material {
        self.with(|texture| texture.at(uv))
    }
    /// The material of the textures' means.
    #[must_use]
    pub fn mean(&self) -> Material {
        self.with(Texture::mean)
    }
    /// Whether it is glossy anywhere.
    #[must_use]
    pub const fn is_glossy(&self) -> bool {
        !matches!(self, Self::Diffuse(_))
    }
    /// The material itself, if no texture varies.
    #[must_use]
    pub fn constant(&self) -> Option<Material> {
        let textures = match self {
            Self::Diffuse(albedo) => [albedo; 3],
            Self::Glossy { diffuse, specular, alpha } => [diffuse, specular, alpha],
            Self::Metallic { base, metallic, roughness } => [base, metallic, roughness],
        };
        textures.iter().all(|texture| texture.constant().is_some()).then(|| self.mean())
    }
    fn with(&self, value: impl Fn(&Texture) -> [f32; 3]) -> Material {
        // textures may hold any numbers
        let share = |x: f32| x.clamp(0.0, 1.0);
        let color = |texture: &Texture| value(texture).map(share);
        let alpha = |x: f32| share(x).max(Material::LEAST_ALPHA);
        match self {
            Self::Diffuse(albedo) => Material::Diffuse(color(albedo)),
            Self::Glossy { diffuse, specular, alpha: rough } => {
                Material::Glossy { diffuse: color(diffuse), specular: color(specular), alpha: alpha(value(rough)[0]) }
            }
            Self::Metallic { base, metallic, roughness } => {
                let (base, metallic, roughness) = (color(base), share(value(metallic)[0]), share(value(roughness)[0]));
                Material::Glossy {
                    diffuse: base.map(|x| x * (1.0 - metallic)),
                    specular: base.map(|x| 0.04 + (x - 0.04) * metallic),
                    alpha: alpha(roughness * roughness),
                }
            }
        }
    }
}

impl Material {
    /// The least roughness α of [`Material::Glossy`]: a smooth coat is that of this roughness.
    pub const LEAST_ALPHA: f32 = 0.01;

    /// Whether the material reflects nothing at all.
    pub fn is_black(&self) -> bool {
        matches!(self, Self::Diffuse(c) | Self::Mirror(c) if *c == [0.0; 3])
    }
    /// Whether the material is a perfect mirror.
    pub fn is_mirror(&self) -> bool {
        matches!(self, Self::Mirror(_) | Self::Conductor { alpha: 0.0, .. })
    }
    /// Whether the material reflects more in some directions than a diffuse one, but is no mirror. Of varying ones [`Varying`] knows.
    pub fn is_glossy(&self) -> bool {
        matches!(self, Self::Conductor { .. } | Self::Glossy { .. }) && !self.is_mirror()
    }
    /// A key for hashing: equal materials have equal words.
    pub(super) fn words(&self) -> [u32; 8] {
        let of = |kind: u32, a: [f32; 3], b: [f32; 3], c: f32| {
            let [x, y, z] = a.map(f32::to_bits);
            let [u, v, w] = b.map(f32::to_bits);
            [kind, x, y, z, u, v, w, c.to_bits()]
        };
        match *self {
            Self::Diffuse(albedo) => of(0, albedo, [0.0; 3], 0.0),
            Self::Mirror(reflectance) => of(1, reflectance, [0.0; 3], 0.0),
            Self::Conductor { eta, k, alpha } => of(2, eta, k, alpha),
            Self::Glossy { diffuse, specular, alpha } => of(3, diffuse, specular, alpha),
            Self::Varying(index) => [4, index, 0, 0, 0, 0, 0, 0],
        }
    }
}
