//! Reads `Texture`, and the parameters of materials that may be textures.

use super::inputs::Files;
use super::params::{Color, Params, shown};
use super::spectrum::Named;
use crate::image::{Encoding, read_texels, sound};
use crate::message::{Notes, shortened};
use crate::nearest::did_you_mean;
use etendue_render::scene::texture::{Mapping, Picture, Texels, Texture, Wrap};
use etendue_render::scene::{Message, NormalMap};
use std::cell::RefCell;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The textures that a scene has named, and the images that it has read.
#[derive(Debug, Default)]
pub(super) struct Textures {
    colors: HashMap<String, Texture>,
    numbers: HashMap<String, Texture>,
    images: RefCell<HashMap<(PathBuf, String), Arc<Texels>>>,
}

/// Most textures of which a value is computed: their number may double with each that names another one twice.
const MOST_PARTS: usize = 4096;

/// pbrt's (0, 0) is the lower left corner of an image.
const UPWARDS: Mapping = Mapping([[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]);

/// A colour.
pub(super) enum Value {
    /// The same everywhere.
    Constant([f64; 3]),
    /// One that varies.
    Varying(Texture),
}

impl Textures {
    /// Reads a `Texture` directive: a texture of colours ("spectrum", "color") or of numbers ("float").
    pub(super) fn define(
        &mut self,
        name: &str,
        value: &str,
        kind: &str,
        params: &mut Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<(), Message> {
        let is_color = match value {
            "spectrum" | "color" => true,
            "float" => false,
            _ => return Err(params.error(format!("a texture of {:?}: only spectrum and float", shortened(value)))),
        };
        let texture = self.read(is_color, kind, params, files, notes)?;
        if texture.parts(MOST_PARTS).is_none() {
            let often = "each counted as often as others name it";
            return Err(params.error(format!("a value of it takes more than {MOST_PARTS} textures, {often}")));
        }
        let map = if is_color { &mut self.colors } else { &mut self.numbers };
        map.insert(name.to_owned(), texture);
        Ok(())
    }

    fn read(
        &mut self,
        is_color: bool,
        kind: &str,
        params: &mut Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<Texture, Message> {
        let value = |this: &Self, params: &mut Params, notes: &mut Notes, name: &str, default: f32| {
            let found =
                if is_color { this.color(name, params, files, notes)? } else { this.number(name, params, notes)? };
            Ok::<_, Message>(found.unwrap_or(Texture::number(default)))
        };
        Ok(match kind {
            "constant" => value(self, params, notes, "value", 1.0)?,
            "scale" => {
                // older files name two factors
                let names = if params.has("tex1") || params.has("tex2") { ["tex1", "tex2"] } else { ["tex", "scale"] };
                let scale = if names[1] == "scale" {
                    self.number("scale", params, notes)?.unwrap_or(Texture::number(1.0))
                } else {
                    value(self, params, notes, "tex2", 1.0)?
                };
                value(self, params, notes, names[0], 1.0)?.times(scale)
            }
            "mix" => {
                let (a, b) = (value(self, params, notes, "tex1", 0.0)?, value(self, params, notes, "tex2", 1.0)?);
                let amount = self.number("amount", params, notes)?.unwrap_or(Texture::number(0.5));
                Texture::mix(a, b, amount)
            }
            "checkerboard" => {
                let (a, b) = (value(self, params, notes, "tex1", 1.0)?, value(self, params, notes, "tex2", 0.0)?);
                if params.integer("dimension")? == Some(3) {
                    notes.stand_in("checkerboard", || params.error("in space: becomes its mean"));
                    Texture::mix(a, b, Texture::number(0.5))
                } else {
                    Texture::Checkerboard(Arc::new([a, b]), mapping(params, notes)?)
                }
            }
            "imagemap" => {
                let texture = self.image(params, files, notes)?;
                if is_color { texture } else { texture.channel(0) }
            }
            _ => {
                let what = format!("texture {:?} becomes 0.5 everywhere", shortened(kind));
                notes.stand_in(&what, || params.error(&what));
                Texture::number(0.5)
            }
        })
    }

    fn image(&self, params: &mut Params, files: &Files<'_>, notes: &mut Notes) -> Result<Texture, Message> {
        let Some(name) = params.text("filename")? else {
            return Err(params.error("\"string filename\" is missing"));
        };
        let encoding = params.text("encoding")?;
        let gamma = params.flag("gamma")?;
        let text = encoding.unwrap_or_else(|| if gamma == Some(false) { "linear" } else { "sRGB" }.to_owned());
        let wrap = match params.text("wrap")?.as_deref() {
            None | Some("repeat") => Wrap::Repeat,
            Some("clamp") => Wrap::Clamp,
            Some("black") => Wrap::Black,
            Some("octahedralsphere") => Wrap::Mirror,
            Some(other) => return Err(params.error(format!("\"wrap\": unknown mode {:?}", shortened(other)))),
        };
        let bilinear = params.text("filter")?.as_deref() != Some("point");
        let scale = params.float("scale")?.unwrap_or(1.0);
        let scale = finite("scale", scale, params)?;
        let invert = params.flag("invert")?.unwrap_or(false);
        let mapping = mapping(params, notes)?.then(&UPWARDS);
        let texels = self.texels(&name, &text, params, files, notes)?;
        let picture = Texture::Picture(Picture { texels, mapping, wrap: [wrap; 2], bilinear });
        let scaled = picture.times(Texture::number(scale));
        Ok(if invert { scaled.inverse() } else { scaled })
    }

    /// The texels of an image in an encoding, which is read once.
    fn texels(
        &self,
        name: &str,
        encoding: &str,
        params: &Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<Arc<Texels>, Message> {
        let path = files.find(name);
        let key = (path.clone(), encoding.to_owned());
        if let Some(texels) = self.images.borrow().get(&key) {
            return Ok(Arc::clone(texels));
        }
        let encoding = match encoding.split_whitespace().collect::<Vec<_>>()[..] {
            ["sRGB" | "srgb"] => Encoding::Srgb,
            ["linear"] => Encoding::Linear,
            ["gamma", gamma] if gamma.parse().is_ok_and(|gamma: f32| gamma > 0.0 && gamma < 100.0) => {
                Encoding::Gamma(gamma.parse().unwrap_or(1.0))
            }
            _ => return Err(params.error(format!("\"encoding\": unknown encoding {:?}", shortened(encoding)))),
        };
        let failed = |why: String| params.error(format!("{}: {why}", path.display()));
        let bytes = files.read(&path).map_err(|error| failed(format!("cannot read: {error}")))?;
        let texels = read_texels(&path, &bytes, encoding).map_err(|error| params.error(error.to_string()))?;
        let texels = Arc::new(sound(texels, name, |what| notes.warn(params.error(what))));
        self.images.borrow_mut().insert(key, Arc::clone(&texels));
        Ok(texels)
    }

    /// The normals of a material, if it names an image of them.
    pub(super) fn normals(
        &self,
        params: &mut Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<Option<NormalMap>, Message> {
        let Some(name) = params.text("normalmap")? else { return Ok(None) };
        let texels = self.texels(&name, "linear", params, files, notes)?;
        let texture = Texture::Picture(Picture { texels, mapping: UPWARDS, wrap: [Wrap::Repeat; 2], bilinear: true });
        Ok(Some(NormalMap { texture, scale: 1.0, follows_v: false }))
    }

    /// A colour in double precision, or a texture that varies.
    pub(super) fn color_or_texture(
        &self,
        name: &str,
        params: &mut Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<Option<Value>, Message> {
        let rgb = match params.color(name, files)? {
            None => return Ok(None),
            Some(Color::Texture(texture)) => {
                let Some(texture) = self.colors.get(&texture).cloned() else {
                    let near = did_you_mean(&texture, self.colors.keys().map(String::as_str));
                    notes.misspelt(params.error(format!(
                        "{name:?}: no spectrum Texture {:?} precedes this: its default stands for it{near}",
                        shortened(&texture)
                    )));
                    return Ok(None);
                };
                return Ok(Some(match texture.constant() {
                    Some(rgb) => Value::Constant(rgb.map(f64::from)),
                    None => Value::Varying(texture),
                }));
            }
            Some(Color::Rgb(rgb)) => rgb,
            Some(Color::Samples(samples)) => samples.reflectance(),
            Some(Color::Blackbody(_) | Color::Named(Named::Illuminant(_))) => {
                return Err(params.error(format!("{name:?}: a light's spectrum is no reflectance")));
            }
            Some(Color::Named(Named::Index(rgb))) => rgb,
        };
        if let Some(x) = rgb.iter().find(|&&x| x > 1.0) {
            notes.warn(
                params.error(format!(
                    "{name:?}: {x} is greater than 1: the surface reflects more light than it receives"
                )),
            );
        }
        if rgb.iter().any(|&x| !(x as f32).is_finite()) {
            return Err(params.error(format!("{name:?}: {rgb:?} is too large for f32")));
        }
        Ok(Some(Value::Constant(rgb)))
    }

    /// A texture or a constant for a colour between 0 and 1, of a reflectance or an opacity.
    pub(super) fn color(
        &self,
        name: &str,
        params: &mut Params,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<Option<Texture>, Message> {
        Ok(self.color_or_texture(name, params, files, notes)?.map(|value| match value {
            Value::Constant(rgb) => Texture::Constant(rgb.map(|x| x as f32)),
            Value::Varying(texture) => texture,
        }))
    }

    /// A texture or a constant for a number.
    pub(super) fn number(
        &self,
        name: &str,
        params: &mut Params,
        notes: &mut Notes,
    ) -> Result<Option<Texture>, Message> {
        let Some(texture) = params.texture(name)? else {
            let number = params.float(name)?.map(|x| finite(name, x, params)).transpose()?;
            return Ok(number.map(Texture::number));
        };
        // older files have colours as numbers
        let color = || self.colors.get(&texture).map(|color| color.clone().channel(0));
        let found = self.numbers.get(&texture).cloned().or_else(color);
        if found.is_none() {
            let near = did_you_mean(&texture, self.numbers.keys().map(String::as_str));
            notes.misspelt(params.error(format!(
                "{name:?}: no float Texture {:?} precedes this: its default stands for it{near}",
                shortened(&texture)
            )));
        }
        Ok(found)
    }

    /// An index of refraction or an absorption coefficient, per channel.
    pub(super) fn index(name: &str, params: &mut Params, files: &Files<'_>) -> Result<Option<[f64; 3]>, Message> {
        Ok(match params.color(name, files)? {
            None => None,
            Some(Color::Rgb(rgb) | Color::Named(Named::Index(rgb))) => Some(rgb),
            Some(Color::Samples(samples)) => Some(samples.reflectance()),
            Some(_) => return Err(params.error(format!("{name:?}: this spectrum is no index of refraction"))),
        })
    }
}

/// A number that is finite in f32.
fn finite(name: &str, x: f64, params: &Params) -> Result<f32, Message> {
    let wrong = || params.error(format!("{name:?}: must be finite in f32, not {}", shown(x)));
    Some(x as f32).filter(|x| x.is_finite()).ok_or_else(wrong)
}

/// The mapping of a texture: "uv", or as if it were that.
fn mapping(params: &mut Params, notes: &mut Notes) -> Result<Mapping, Message> {
    if let Some(kind) = params.text("mapping")?.filter(|kind| kind != "uv") {
        let what = format!("mapping {:?} becomes that of u and v", shortened(&kind));
        notes.stand_in(&what, || params.error(&what));
    }
    let mut number = |name: &str, default: f64| {
        let x = params.float(name)?.unwrap_or(default);
        finite(name, x, params)
    };
    let (us, vs) = (number("uscale", 1.0)?, number("vscale", 1.0)?);
    let (ud, vd) = (number("udelta", 0.0)?, number("vdelta", 0.0)?);
    Ok(Mapping([[us, 0.0, ud], [0.0, vs, vd]]))
}
