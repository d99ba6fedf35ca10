//! Reads `Texture`, and the parameters of materials that may be textures.

use super::given::Given;
use super::params::{Color, Params};
use super::spectrum::Named;
use crate::image::{Encoding, read_texels, sound};
use crate::message::shortened;
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
    pub(super) fn define(&mut self, name: &str, value: &str, kind: &str, given: &mut Given<'_>) -> Result<(), Message> {
        let is_color = match value {
            "spectrum" | "color" => true,
            "float" => false,
            _ => return Err(given.error(format!("a texture of {:?}: only spectrum and float", shortened(value)))),
        };
        let texture = self.read(is_color, kind, given)?;
        if texture.parts(MOST_PARTS).is_none() {
            let often = "each counted as often as others name it";
            return Err(given.error(format!("a value of it takes more than {MOST_PARTS} textures, {often}")));
        }
        let map = if is_color { &mut self.colors } else { &mut self.numbers };
        map.insert(name.to_owned(), texture);
        Ok(())
    }

    fn read(&mut self, is_color: bool, kind: &str, given: &mut Given<'_>) -> Result<Texture, Message> {
        let value = |given: &mut Given<'_>, name: &str, default: f32| {
            let found = if is_color { self.color(name, given)? } else { self.number(name, given)? };
            Ok::<_, Message>(found.unwrap_or(Texture::number(default)))
        };
        Ok(match kind {
            "constant" => value(given, "value", 1.0)?,
            "scale" => {
                // older files name two factors
                let names = if given.has("tex1") || given.has("tex2") { ["tex1", "tex2"] } else { ["tex", "scale"] };
                let scale = if names[1] == "scale" {
                    self.number("scale", given)?.unwrap_or(Texture::number(1.0))
                } else {
                    value(given, "tex2", 1.0)?
                };
                value(given, names[0], 1.0)?.times(scale)
            }
            "mix" => {
                let (a, b) = (value(given, "tex1", 0.0)?, value(given, "tex2", 1.0)?);
                let amount = self.number("amount", given)?.unwrap_or(Texture::number(0.5));
                Texture::mix(a, b, amount)
            }
            "checkerboard" => {
                let (a, b) = (value(given, "tex1", 1.0)?, value(given, "tex2", 0.0)?);
                if given.integer("dimension")? == Some(3) {
                    given.stand_in("checkerboard", "in space: becomes its mean");
                    Texture::mix(a, b, Texture::number(0.5))
                } else {
                    Texture::Checkerboard(Arc::new([a, b]), mapping(given)?)
                }
            }
            "imagemap" => {
                let texture = self.image(given)?;
                if is_color { texture } else { texture.channel(0) }
            }
            _ => {
                let what = format!("texture {:?} becomes 0.5 everywhere", shortened(kind));
                given.stand_in(&what, &what);
                Texture::number(0.5)
            }
        })
    }

    fn image(&self, given: &mut Given<'_>) -> Result<Texture, Message> {
        let Some(name) = given.text("filename")? else {
            return Err(given.error("\"string filename\" is missing"));
        };
        let encoding = given.text("encoding")?;
        let gamma = given.flag("gamma")?;
        let text = encoding.unwrap_or_else(|| if gamma == Some(false) { "linear" } else { "sRGB" }.to_owned());
        let wrap = match given.text("wrap")?.as_deref() {
            None | Some("repeat") => Wrap::Repeat,
            Some("clamp") => Wrap::Clamp,
            Some("black") => Wrap::Black,
            Some("octahedralsphere") => Wrap::Mirror,
            Some(other) => return Err(given.error(format!("\"wrap\": unknown mode {:?}", shortened(other)))),
        };
        let bilinear = given.text("filter")?.as_deref() != Some("point");
        let scale = given.float("scale")?.unwrap_or(1.0);
        let scale = finite("scale", scale, given)?;
        let invert = given.flag("invert")?.unwrap_or(false);
        let mapping = mapping(given)?.then(&UPWARDS);
        let texels = self.texels(&name, &text, given)?;
        let picture = Texture::Picture(Picture { texels, mapping, wrap: [wrap; 2], bilinear });
        let scaled = picture.times(Texture::number(scale));
        Ok(if invert { scaled.inverse() } else { scaled })
    }

    /// The texels of an image in an encoding, which is read once.
    fn texels(&self, name: &str, encoding: &str, given: &mut Given<'_>) -> Result<Arc<Texels>, Message> {
        let path = given.files.find(name);
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
            _ => return Err(given.error(format!("\"encoding\": unknown encoding {:?}", shortened(encoding)))),
        };
        let failed = |why: String| given.error(format!("{}: {why}", path.display()));
        let bytes = given.files.read(&path).map_err(|error| failed(format!("cannot read: {error}")))?;
        let texels = read_texels(&path, &bytes, encoding).map_err(|error| given.error(error.to_string()))?;
        let texels = Arc::new(sound(texels, name, |what| given.warn(what)));
        self.images.borrow_mut().insert(key, Arc::clone(&texels));
        Ok(texels)
    }

    /// The normals of a material, if it names an image of them.
    pub(super) fn normals(&self, given: &mut Given<'_>) -> Result<Option<NormalMap>, Message> {
        let Some(name) = given.text("normalmap")? else { return Ok(None) };
        let texels = self.texels(&name, "linear", given)?;
        let texture = Texture::Picture(Picture { texels, mapping: UPWARDS, wrap: [Wrap::Repeat; 2], bilinear: true });
        Ok(Some(NormalMap { texture, scale: 1.0, follows_v: false }))
    }

    /// A colour in double precision, or a texture that varies.
    pub(super) fn color_or_texture(&self, name: &str, given: &mut Given<'_>) -> Result<Option<Value>, Message> {
        let rgb = match given.color(name)? {
            None => return Ok(None),
            Some(Color::Texture(texture)) => {
                let Some(texture) = self.colors.get(&texture).cloned() else {
                    let near = did_you_mean(&texture, self.colors.keys().map(String::as_str));
                    given.misspelt(format!(
                        "{name:?}: no spectrum Texture {:?} precedes this: its default stands for it{near}",
                        shortened(&texture)
                    ));
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
                return Err(given.error(format!("{name:?}: a light's spectrum is no reflectance")));
            }
            Some(Color::Named(Named::Index(rgb))) => rgb,
        };
        if let Some(x) = rgb.iter().find(|&&x| x > 1.0) {
            given.warn(format!("{name:?}: {x} is greater than 1: the surface reflects more light than it receives"));
        }
        given.require(rgb.iter().all(|&x| (x as f32).is_finite()), || {
            format!("{name:?}: {rgb:?} is too large for f32")
        })?;
        Ok(Some(Value::Constant(rgb)))
    }

    /// A texture or a constant for a colour between 0 and 1, of a reflectance or an opacity.
    pub(super) fn color(&self, name: &str, given: &mut Given<'_>) -> Result<Option<Texture>, Message> {
        Ok(self.color_or_texture(name, given)?.map(|value| match value {
            Value::Constant(rgb) => Texture::Constant(rgb.map(|x| x as f32)),
            Value::Varying(texture) => texture,
        }))
    }

    /// A texture or a constant for a number.
    pub(super) fn number(&self, name: &str, given: &mut Given<'_>) -> Result<Option<Texture>, Message> {
        let Some(texture) = given.texture(name)? else {
            let number = given.float(name)?.map(|x| finite(name, x, given)).transpose()?;
            return Ok(number.map(Texture::number));
        };
        // older files have colours as numbers
        let color = || self.colors.get(&texture).map(|color| color.clone().channel(0));
        let found = self.numbers.get(&texture).cloned().or_else(color);
        if found.is_none() {
            let near = did_you_mean(&texture, self.numbers.keys().map(String::as_str));
            given.misspelt(format!(
                "{name:?}: no float Texture {:?} precedes this: its default stands for it{near}",
                shortened(&texture)
            ));
        }
        Ok(found)
    }

    /// An index of refraction or an absorption coefficient, per channel.
    pub(super) fn index(name: &str, given: &mut Given<'_>) -> Result<Option<[f64; 3]>, Message> {
        Ok(match given.color(name)? {
            None => None,
            Some(Color::Rgb(rgb) | Color::Named(Named::Index(rgb))) => Some(rgb),
            Some(Color::Samples(samples)) => Some(samples.reflectance()),
            Some(_) => return Err(given.error(format!("{name:?}: this spectrum is no index of refraction"))),
        })
    }
}

/// A number that is finite in f32.
fn finite(name: &str, x: f64, given: &Params) -> Result<f32, Message> {
    Ok(given.bound(name, x, (x as f32).is_finite(), "finite in f32")? as f32)
}

/// The mapping of a texture: "uv", or as if it were that.
fn mapping(given: &mut Given<'_>) -> Result<Mapping, Message> {
    if let Some(kind) = given.text("mapping")?.filter(|kind| kind != "uv") {
        let what = format!("mapping {:?} becomes that of u and v", shortened(&kind));
        given.stand_in(&what, &what);
    }
    let mut number = |name: &str, default: f64| {
        let x = given.float(name)?.unwrap_or(default);
        finite(name, x, given)
    };
    let (us, vs) = (number("uscale", 1.0)?, number("vscale", 1.0)?);
    let (ud, vd) = (number("udelta", 0.0)?, number("vdelta", 0.0)?);
    Ok(Mapping([[us, 0.0, ud], [0.0, vs, vd]]))
}
