//! Reads materials, and the textures and images that they name.

use super::source::Source;
use crate::builder::Builder;
use crate::image::{Encoding, read_texels, sound};
use crate::message::shortened;
use crate::radiance::{brightness, rounded};
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::texture::{Mapping, Mask, Picture, Texels, Texture, Wrap};
use etendue_render::scene::{Emission, Message, NormalMap, Varying};
use gltf_json::extensions::material::PbrSpecularGlossiness;
use gltf_json::extensions::texture::TextureTransform;
use gltf_json::material::AlphaMode;
use gltf_json::texture::{Info, MagFilter, Sampler, WrappingMode};
use gltf_json::validation::Checked;
use gltf_json::{Index, material, texture};
use serde_json::Value;
use std::collections::HashMap;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

/// A material as primitives need it.
#[derive(Debug)]
pub(super) struct Surface {
    /// Index into the materials of the scene.
    pub(super) material: u32,
    /// The set of texture coordinates of its textures, if it has any.
    pub(super) set: Option<u32>,
    pub(super) glow: Option<Glow>,
}

/// The light that a material emits.
#[derive(Debug)]
pub(super) struct Glow {
    /// Its radiance is that where the texture is 1.
    pub(super) emission: Emission,
    /// The picture and its set of texture coordinates.
    pub(super) texture: Option<(Picture, u32)>,
}

/// The materials and images that were read so far.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// By index, and whether vertices have colours.
    surfaces: HashMap<(Option<usize>, bool), Rc<Surface>>,
    images: HashMap<(usize, bool), Arc<Texels>>,
}

/// The extension of anisotropic materials.
pub(super) const ANISOTROPY: &str = "KHR_materials_anisotropy";

/// Reads one material.
struct Reader<'r, 's> {
    source: &'r Source<'s>,
    out: &'r mut Builder,
    images: &'r mut HashMap<(usize, bool), Arc<Texels>>,
    item: String,
    set: Option<u32>,
}

impl Materials {
    /// The material of this index, or the default one.
    pub(super) fn surface(
        &mut self,
        source: &Source<'_>,
        out: &mut Builder,
        (index, is_tinted): (Option<Index<material::Material>>, bool),
        user: &str,
    ) -> Result<Rc<Surface>, Message> {
        let key = index.map(|index| index.value());
        if let Some(surface) = self.surfaces.get(&(key, is_tinted)) {
            return Ok(surface.clone());
        }
        let default = material::Material::default();
        let material = match index {
            Some(index) => source.item(&source.root.materials, index, "material", user)?.1,
            None => &default,
        };
        let item = key.map_or("the default material".into(), |key| format!("material {key}"));
        let mut reader = Reader { source, out, images: &mut self.images, item, set: None };
        let surface = Rc::new(reader.read(material, is_tinted)?);
        self.surfaces.insert((key, is_tinted), surface.clone());
        Ok(surface)
    }
}

impl Reader<'_, '_> {
    fn error(&self, what: &str) -> Message {
        self.source.message(format!("{}: {what}", self.item))
    }

    fn stand_in(&mut self, kind: &str, what: &str) {
        let message = self.error(what);
        self.out.notes.stand_in(kind, || message);
    }

    /// Numbers from 0 to 1; others are clamped.
    fn shares<const N: usize>(&mut self, name: &str, values: [f32; N]) -> [f32; N] {
        if !values.iter().all(|x| (0.0..=1.0).contains(x)) {
            let message = self.error(&format!("{name} {values:?} is clamped to 0 to 1"));
            self.out.notes.warn(message);
        }
        values.map(|x| x.clamp(0.0, 1.0))
    }

    fn read(&mut self, material: &material::Material, is_tinted: bool) -> Result<Surface, Message> {
        if matches!(material.alpha_mode, Checked::Invalid) {
            self.stand_in("alpha", "its alphaMode is unknown: the surface is opaque");
        }
        let extensions = material.extensions.as_ref();
        if extensions.is_some_and(|all| all.unlit.is_some()) {
            self.stand_in("unlit", "KHR_materials_unlit: a diffuse surface of its base colour stands for it");
        }
        let varying = self.metallic(material)?;
        let read = if is_tinted { self.out.materials.varied(varying) } else { self.out.materials.vary(varying) };
        let read = self.normals(material)?.map_or(read, |normals| self.out.materials.relief(read, normals));
        let mask = self.mask(material)?;
        let set = self.set;
        let glow = self.glow(material)?;
        if mask.is_some() && glow.is_some() {
            self.stand_in("light with holes", "a surface with holes that emits becomes opaque");
        }
        let whole = self.out.materials.material_of_sides(read, material.double_sided);
        let material = match mask {
            Some(mask) if glow.is_none() => self.out.materials.masked(whole, mask),
            _ => whole,
        };
        Ok(Surface { material, set, glow })
    }

    /// The normal map of a material, if it has one.
    fn normals(&mut self, material: &material::Material) -> Result<Option<NormalMap>, Message> {
        let Some(of) = &material.normal_texture else { return Ok(None) };
        // its extensions are those of other textures
        let others = of.extensions.as_ref().map(|all| serde_json::from_value(Value::Object(all.others.clone())));
        let extensions = others.transpose().map_err(|error| self.error(&format!("its normalTexture: {error}")))?;
        let info = Info { index: of.index, tex_coord: of.tex_coord, extensions, extras: Default::default() };
        if !of.scale.is_finite() {
            return Err(self.error("the scale of its normalTexture is not finite"));
        }
        let texture = self.textured([1.0; 3], Some(&info), Encoding::Linear)?;
        Ok(Some(NormalMap { texture, scale: of.scale, follows_v: true }))
    }

    /// The holes of a material, if it has any.
    fn mask(&mut self, material: &material::Material) -> Result<Option<Mask>, Message> {
        let least = match material.alpha_mode {
            // 0.5 is the default
            Checked::Valid(AlphaMode::Mask) => Some(material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0)),
            Checked::Valid(AlphaMode::Blend) => None,
            _ => return Ok(None),
        };
        let of = &material.pbr_metallic_roughness;
        let (factor, info) = (of.base_color_factor.0[3], of.base_color_texture.as_ref());
        let [factor] = self.shares("the opacity", [factor]);
        let mut opacity = Texture::number(factor);
        if let Some(info) = info
            && factor > 0.0
            && let (Texture::Picture(picture), set) = self.picture(info, Encoding::Srgb)?
            && picture.texels.alpha.is_some()
        {
            self.set.get_or_insert(set);
            opacity = opacity.times(Texture::Opacity(picture));
        }
        let is_whole = match (opacity.constant(), least) {
            (Some([x, ..]), Some(least)) => x >= least,
            (Some([x, ..]), None) => x >= 1.0,
            (None, _) => false,
        };
        Ok((!is_whole).then_some(Mask { opacity, least }))
    }

    fn metallic(&mut self, material: &material::Material) -> Result<Varying, Message> {
        let extensions = material.extensions.as_ref();
        let surface = &material.pbr_metallic_roughness;
        let [r, g, b, _] = self.shares("baseColorFactor", surface.base_color_factor.0);
        let base = self.textured([r, g, b], surface.base_color_texture.as_ref(), Encoding::Srgb)?;
        if extensions.is_some_and(|all| all.unlit.is_some()) {
            return Ok(Varying::Diffuse(base));
        }
        let [metallic] = self.shares("metallicFactor", [surface.metallic_factor.0]);
        let [roughness] = self.shares("roughnessFactor", [surface.roughness_factor.0]);
        if let Some(of) = extensions.and_then(|all| all.pbr_specular_glossiness.as_ref()) {
            return self.glossiness(of);
        }
        let map = surface.metallic_roughness_texture.as_ref();
        let map = self.textured([1.0; 3], map, Encoding::Linear)?;
        let metallic = if metallic == 0.0 {
            Texture::number(0.0)
        } else {
            Texture::number(metallic).times(map.clone().channel(2))
        };
        let roughness = Texture::number(roughness).times(map.channel(1));
        let ior = extensions.and_then(|all| all.ior.as_ref()).map_or(1.5, |ior| ior.ior.0);
        let specular = extensions.and_then(|all| all.specular.as_ref());
        let grain = self.grain(material)?;
        if ior == 1.5 && specular.is_none() && grain.is_none() {
            return Ok(Varying::Metallic { base, metallic, roughness });
        }
        if !(ior == 0.0 || ior >= 1.0 && ior.is_finite()) {
            return Err(self.error(&format!("ior: must be 0, or finite and at least 1, not {ior}")));
        }
        let ratio = (ior - 1.0) / (ior + 1.0);
        let (mut at_normal, mut grazing) = (Texture::number(ratio * ratio), Texture::number(1.0));
        if let Some(specular) = specular {
            let [factor] = self.shares("specularFactor", [specular.specular_factor.0]);
            let color = specular.specular_color_factor.0.map(|x| if x > 0.0 { x.min(f32::MAX) } else { 0.0 });
            if factor == 0.0 && metallic.constant() == Some([0.0; 3]) {
                return Ok(Varying::Diffuse(base));
            }
            at_normal = Texture::Constant(color.map(|x| (x * ratio * ratio).min(1.0) * factor));
            grazing = Texture::mix(Texture::number(factor), grazing, metallic.clone());
        }
        let alpha = roughness.clone().times(roughness);
        let (strength, turn) = grain.unwrap_or((0.0, 0.0));
        let along = match strength {
            0.0 => alpha.clone(),
            _ => Texture::mix(alpha.clone(), Texture::number(1.0), Texture::number(strength * strength)),
        };
        Ok(Varying::Glossy {
            diffuse: base.clone().times(metallic.clone().inverse()),
            specular: Texture::mix(at_normal, base, metallic),
            grazing,
            roughness: [along, alpha],
            turn,
            // the extension takes the light that none of the channels reflects
            greatest: specular.is_some(),
        })
    }

    /// A material by its diffuse and specular colours and its glossiness, 1 − √α.
    fn glossiness(&mut self, of: &PbrSpecularGlossiness) -> Result<Varying, Message> {
        let [r, g, b, _] = of.diffuse_factor.0;
        let diffuse = self.shares("diffuseFactor", [r, g, b]);
        let specular = self.shares("specularFactor", of.specular_factor.0);
        let [gloss] = self.shares("glossinessFactor", [of.glossiness_factor.0]);
        let map = of.specular_glossiness_texture.as_ref();
        let diffuse = self.textured(diffuse, of.diffuse_texture.as_ref(), Encoding::Srgb)?;
        let mut gloss = Texture::number(gloss);
        if let Some(map) = map
            && let (Texture::Picture(picture), set) = self.picture(map, Encoding::Srgb)?
            && picture.texels.alpha.is_some()
        {
            self.set.get_or_insert(set);
            gloss = gloss.times(Texture::Opacity(picture));
        }
        let specular = self.textured(specular, map, Encoding::Srgb)?;
        let rough = gloss.inverse();
        let alpha = rough.clone().times(rough);
        let roughness = [alpha.clone(), alpha];
        Ok(Varying::Glossy { diffuse, specular, grazing: Texture::number(1.0), roughness, turn: 0.0, greatest: true })
    }

    /// Strength and rotation in radians of an anisotropic material.
    fn grain(&mut self, material: &material::Material) -> Result<Option<(f32, f32)>, Message> {
        let extensions = material.extensions.as_ref();
        let Some(of) = extensions.and_then(|all| all.others.get(ANISOTROPY)) else { return Ok(None) };
        let number = |name: &str| match of.get(name).map_or(Some(0.0), serde_json::Value::as_f64) {
            Some(x) if (x as f32).is_finite() => Ok(x as f32),
            _ => Err(self.error(&format!("{ANISOTROPY}: {name}: must be a finite number"))),
        };
        let (strength, turn) = (number("anisotropyStrength")?, number("anisotropyRotation")?);
        let [strength] = self.shares("anisotropyStrength", [strength]);
        Ok((strength > 0.0).then_some((strength, turn)))
    }

    fn glow(&mut self, material: &material::Material) -> Result<Option<Glow>, Message> {
        let factor = material.emissive_factor.0;
        let extension = material.extensions.as_ref().and_then(|all| all.emissive_strength.as_ref());
        let strength = extension.map_or(1.0, |extension| extension.emissive_strength.0);
        let radiance = factor.map(|x| f64::from(x) * f64::from(strength));
        let valid = rounded(radiance).filter(|rgb| rgb.iter().all(|x| (0.0..=MOST_RADIANCE).contains(x)));
        let radiance = valid.ok_or_else(|| {
            self.error(&format!(
                "emissiveFactor {factor:?} times emissiveStrength {strength}: must be from 0 to {MOST_RADIANCE:e}"
            ))
        })?;
        if radiance == [0.0; 3] {
            return Ok(None);
        }
        if let Some(text) = brightness(radiance) {
            let message = self.error(&format!("the radiance {text}"));
            self.out.notes.warn(message);
        }
        let texture = match &material.emissive_texture {
            None => None,
            Some(info) => match self.picture(info, Encoding::Srgb)? {
                (Texture::Picture(picture), set) => Some((picture, set)),
                _ => None,
            },
        };
        let emission = Emission { radiance, two_sided: material.double_sided, ..Emission::default() };
        Ok(Some(Glow { emission, texture }))
    }

    /// A colour times a texture. The first texture tells the set of texture coordinates for all.
    fn textured(&mut self, factor: [f32; 3], info: Option<&Info>, encoding: Encoding) -> Result<Texture, Message> {
        let factor = Texture::Constant(factor);
        let Some(info) = info else { return Ok(factor) };
        // black stays black, whatever the texture is
        if factor.constant() == Some([0.0; 3]) {
            return Ok(factor);
        }
        let (texture, set) = self.picture(info, encoding)?;
        let first = *self.set.get_or_insert(set);
        if first != set {
            self.stand_in("sets", &format!("its textures use several sets of texture coordinates: all use {first}"));
        }
        Ok(factor.times(texture))
    }

    /// A texture, and its set of texture coordinates.
    fn picture(&mut self, info: &Info, encoding: Encoding) -> Result<(Texture, u32), Message> {
        let transform = info.extensions.as_ref().and_then(|all| all.texture_transform.as_ref());
        let set = transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord);
        let mapping = match transform {
            None => Mapping::IDENTITY,
            Some(transform) => {
                mapping(transform).ok_or_else(|| self.error("its KHR_texture_transform is not finite"))?
            }
        };
        let source = self.source;
        let (index, texture) = source.item(&source.root.textures, info.index, "texture", &self.item)?;
        let item = format!("texture {index}");
        let default = Sampler::default();
        let sampler = match texture.sampler {
            Some(sampler) => source.item(&source.root.samplers, sampler, "sampler", &item)?.1,
            None => &default,
        };
        let wrap = [sampler.wrap_s, sampler.wrap_t].map(|wrap| match wrap {
            Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
            Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
            Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
        });
        let bilinear = sampler.mag_filter != Some(Checked::Valid(MagFilter::Nearest));
        let texels = self.image(texture, &item, encoding)?;
        Ok((Texture::Picture(Picture { texels, mapping, wrap, bilinear }), set))
    }

    fn image(&mut self, texture: &texture::Texture, item: &str, encoding: Encoding) -> Result<Arc<Texels>, Message> {
        let source = self.source;
        // the index of no image
        if texture.source.value() == u32::MAX as usize {
            let others = texture.extensions.as_ref().and_then(|all| all.others.keys().next());
            let why = others.map_or(String::new(), |name| {
                format!(": its only image is that of {}, which is not supported", shortened(name))
            });
            return Err(source.message(format!("{item}: has no image{why}")));
        }
        let (index, image) = source.item(&source.root.images, texture.source, "image", item)?;
        let key = (index, encoding == Encoding::Srgb);
        if let Some(texels) = self.images.get(&key) {
            return Ok(texels.clone());
        }
        let item = format!("image {index}");
        let read = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => {
                let (path, bytes) = source.open(uri, &item)?;
                read_texels(&path, &bytes, encoding)
            }
            (None, Some(view)) => read_texels(&PathBuf::from(&item), source.view(view, &item)?.bytes, encoding),
            (None, None) => return Err(source.message(format!("{item}: has neither a URI nor a bufferView"))),
        };
        let read = read.map_err(|error| source.message(error.to_string()))?;
        let texels = Arc::new(sound(read, &item, |what| self.out.notes.warn(source.message(what))));
        self.images.insert(key, texels.clone());
        Ok(texels)
    }
}

/// The mapping of a `KHR_texture_transform`: a scale, then a turn that is counter-clockwise as v points down, then an offset.
fn mapping(transform: &TextureTransform) -> Option<Mapping> {
    let (sin, cos) = libm::sincosf(transform.rotation.0);
    let ([du, dv], [su, sv]) = (transform.offset.0, transform.scale.0);
    let rows = [[cos * su, sin * sv, du], [-sin * su, cos * sv, dv]];
    rows.iter().flatten().all(|x| x.is_finite()).then_some(Mapping(rows))
}
