//! Interprets the directives of a scene file and keeps the graphics state.

use super::builder::{Builder, ShapeAttributes};
use super::builtin::BUILTIN_IMAGES;
use super::description::{CameraSettings, Emission, FilmSettings, Lens, Scene};
use super::includes::Includes;
pub(super) use super::includes::Origin;
use super::lexer::{Lexer, Token, shortened};
use super::lights::{self, DeltaLight, Environment};
use super::materials::{self, Material};
use super::message::{Message, Place, utf8};
use super::params::{MOST_RADIANCE, Params, brightness, rounded, shown};
use super::shapes;
use super::transform::{Transform, length, scaled};
use crate::image;
use crate::limits::{MOST_SAMPLES, is_size};
use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Greatest depth of nested `AttributeBegin`s.
const DEEPEST_ATTRIBUTES: usize = 1024;

/// The graphics state that `AttributeBegin` saves and `AttributeEnd` restores.
#[derive(Clone, Debug)]
struct State {
    ctm: Transform,
    reverse: bool,
    material: Material,
    emission: Option<Emission>,
}

struct Reader<'a> {
    main_dir: &'a Path,
    is_builtin: bool,
    camera: Option<CameraSettings>,
    film: Option<FilmSettings>,
    pixel_samples: Option<u32>,
    delta_lights: Vec<DeltaLight>,
    environment: Option<Environment>,
    out: Builder,
    state: State,
    saved: Vec<(State, Place)>,
    systems: HashMap<String, Transform>,
    named: HashMap<String, Material>,
    in_world: bool,
    includes: Includes,
    inputs: RefCell<Vec<PathBuf>>,
}

/// Reads a whole scene; only a built-in scene may name `builtin:` meshes.
pub(super) fn read(text: &str, file: &str, dir: &Path, origin: Origin<'_>) -> Result<Scene, Message> {
    let material = Material::Diffuse([0.5; 3]);
    let state = State { ctm: Transform::IDENTITY, reverse: false, material, emission: None };
    let mut reader = Reader {
        main_dir: dir,
        is_builtin: matches!(origin, Origin::Builtin),
        camera: None,
        film: None,
        pixel_samples: None,
        delta_lights: Vec::new(),
        environment: None,
        out: Builder::default(),
        state,
        saved: Vec::new(),
        systems: HashMap::new(),
        named: HashMap::new(),
        in_world: false,
        includes: Includes::new(origin),
        inputs: RefCell::default(),
    };
    let file: Arc<str> = Arc::from(file);
    reader.file(text, file.clone(), dir)?;

    let lines = u32::try_from(text.lines().count()).unwrap_or(u32::MAX);
    let end = Place { file: file.clone(), line: lines.max(1) };
    if let Some((_, place)) = reader.saved.last() {
        return Err(place.message("this AttributeBegin or TransformBegin is never closed"));
    }
    let Some(camera) = reader.camera else {
        return Err(end.message("the scene has no Camera"));
    };
    if !reader.in_world {
        return Err(end.message("the scene has no WorldBegin"));
    }
    let mut out = reader.out;
    out.finish();
    let emits = out.shapes.iter().any(|shape| shape.emission.is_some());
    if !emits && reader.delta_lights.is_empty() && reader.environment.is_none() {
        out.warnings.push(end.message("nothing emits light: the image will be black"));
    }
    let name = Path::new(&*file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    Ok(Scene {
        name: name.unwrap_or_else(|| file.to_string()),
        camera,
        film: reader.film.unwrap_or(FilmSettings { width: 1280, height: 720, diagonal: 35.0, filename: None }),
        pixel_samples: reader.pixel_samples.unwrap_or(16),
        materials: out.materials,
        triangles: out.triangles,
        triangle_materials: out.triangle_materials,
        varying: out.varying,
        details: out.details.into(),
        shapes: out.shapes.into(),
        delta_lights: reader.delta_lights,
        environment: reader.environment,
        warnings: out.warnings,
        inputs: reader.inputs.into_inner(),
    })
}

impl Reader<'_> {
    fn file(&mut self, text: &str, file: Arc<str>, dir: &Path) -> Result<(), Message> {
        let mut lexer = Lexer::new(text, file);
        while let Some((token, line)) = lexer.next()? {
            let place = lexer.place(line);
            match token {
                Token::Word(word) => self.directive(word, place, &mut lexer, dir)?,
                other => return Err(place.message(format!("expected a directive, found {}", other.show()))),
            }
        }
        Ok(())
    }

    fn directive(&mut self, word: &str, place: Place, lexer: &mut Lexer<'_>, dir: &Path) -> Result<(), Message> {
        const OPTIONS: [&str; 7] = ["Camera", "Film", "Sampler", "PixelFilter", "Integrator", "Accelerator", "Option"];
        const WORLD: [&str; 11] = [
            "AttributeBegin",
            "AttributeEnd",
            "TransformBegin",
            "TransformEnd",
            "ReverseOrientation",
            "AreaLightSource",
            "LightSource",
            "Material",
            "MakeNamedMaterial",
            "NamedMaterial",
            "Shape",
        ];
        if self.in_world && OPTIONS.contains(&word) {
            return Err(place.message(format!("{word} must come before WorldBegin")));
        }
        if !self.in_world && WORLD.contains(&word) {
            return Err(place.message(format!("{word} must come after WorldBegin")));
        }
        match word {
            "Identity" => self.state.ctm = Transform::IDENTITY,
            "Translate" | "Scale" | "Rotate" | "LookAt" | "Transform" | "ConcatTransform" => {
                self.transform(word, &place, lexer)?;
            }
            "CoordinateSystem" => {
                self.systems.insert(lexer.text("a name")?, self.state.ctm);
            }
            "CoordSysTransform" => {
                let name = lexer.text("a name")?;
                let unknown = || place.message(format!("undefined CoordinateSystem {:?}", shortened(&name)));
                self.state.ctm = *self.systems.get(&name).ok_or_else(unknown)?;
            }
            "ActiveTransform" => match lexer.expect("All, StartTime or EndTime")?.0 {
                Token::Word("All") => {}
                other => {
                    return Err(place.message(format!("ActiveTransform {}: not supported, only All", other.show())));
                }
            },
            "ReverseOrientation" => self.state.reverse = !self.state.reverse,
            "WorldBegin" => {
                if self.in_world {
                    return Err(place.message("a second WorldBegin: only one is allowed"));
                }
                self.in_world = true;
                self.state.ctm = Transform::IDENTITY;
                self.systems.insert("world".into(), Transform::IDENTITY);
            }
            "AttributeBegin" | "TransformBegin" => {
                if self.saved.len() == DEEPEST_ATTRIBUTES {
                    return Err(place.message(format!("{word} is nested more than {DEEPEST_ATTRIBUTES} deep")));
                }
                self.saved.push((self.state.clone(), place));
            }
            "AttributeEnd" | "TransformEnd" => match self.saved.pop() {
                Some((state, _)) => self.state = state,
                None => return Err(place.message(format!("{word} has no matching Begin"))),
            },
            "Include" => self.include(&place, lexer, dir)?,
            "ColorSpace" => {
                let name = lexer.text("a name")?;
                if name != "srgb" {
                    self.warn(&place, format!("ColorSpace {:?} ignored: colours are linear sRGB", shortened(&name)));
                }
            }
            "Option" => {
                let name = lexer.text("an option")?;
                lexer.expect("the option's value")?;
                self.warn(&place, format!("Option {:?} ignored", shortened(&name)));
            }
            "NamedMaterial" => {
                let name = lexer.text("a name")?;
                let unknown = || place.message(format!("no MakeNamedMaterial {:?} precedes this", shortened(&name)));
                self.state.material = *self.named.get(&name).ok_or_else(unknown)?;
            }
            "Camera" | "Film" | "Sampler" | "PixelFilter" | "Integrator" | "Accelerator" | "AreaLightSource"
            | "LightSource" | "Material" | "MakeNamedMaterial" | "Shape" => {
                let kind = lexer.text("a type")?;
                let params = Params::read(lexer, format!("{word} {:?}", shortened(&kind)), place)?;
                self.with_params(word, &kind, params, dir)?;
            }
            "Texture" | "ObjectBegin" | "ObjectEnd" | "ObjectInstance" | "MediumInterface" | "MakeNamedMedium"
            | "Attribute" | "Import" | "TransformTimes" => {
                return Err(place.message(format!("{word} is not supported")));
            }
            _ => return Err(place.message(format!("unknown directive {}", shortened(word)))),
        }
        Ok(())
    }

    fn with_params(&mut self, word: &str, kind: &str, mut params: Params, dir: &Path) -> Result<(), Message> {
        match word {
            "Camera" => self.camera(kind, &mut params)?,
            "Film" => self.film(kind, &mut params)?,
            "Sampler" => self.sampler(kind, &mut params)?,
            "PixelFilter" => {
                let mut half = |name| Ok(params.float(name)?.is_none_or(|radius| radius == 0.5));
                if !(half("xradius")? & half("yradius")? & (kind == "box")) {
                    let text = params.error("ignored: the filter is always a box of one pixel").text;
                    self.warn(&params.place, text);
                }
            }
            "Integrator" => {
                let direct = params.integer("maxdepth")? == Some(1);
                if !(direct && ["path", "volpath", "simplepath"].contains(&kind)) {
                    let text = params.error("only direct light is rendered, as with \"path\" and maxdepth 1").text;
                    self.warn(&params.place, text);
                }
            }
            "Accelerator" => {
                self.warn(&params.place, params.error("ignored").text);
                return Ok(());
            }
            "Material" => self.state.material = materials::read(kind, &mut params, &mut self.out.warnings)?,
            "MakeNamedMaterial" => {
                let Some(of) = params.text("type")? else {
                    return Err(params.error("\"string type\" is missing"));
                };
                let material = materials::read(&of, &mut params, &mut self.out.warnings)?;
                self.named.insert(kind.into(), material);
            }
            "AreaLightSource" => self.area_light(kind, &mut params)?,
            "LightSource" => self.light(kind, &mut params, dir)?,
            _ => self.shape(kind, &mut params, dir)?,
        }
        self.out.warnings.extend(params.finish());
        Ok(())
    }

    fn warn(&mut self, place: &Place, text: String) {
        self.out.warnings.push(place.message(text));
    }

    fn include(&mut self, place: &Place, lexer: &mut Lexer<'_>, dir: &Path) -> Result<(), Message> {
        let name = lexer.text("a file name")?;
        let path = self.resolve(&name, dir);
        let bytes = self.includes.open(place, &path)?;
        let file: Arc<str> = Arc::from(path.display().to_string());
        let text = utf8(&bytes, &file)?;
        self.file(text, file, path.parent().unwrap_or(Path::new("")))?;
        self.includes.close();
        Ok(())
    }

    /// Resolves the name of a file to be read, relative to the file that names it, else relative to the main file, as in pbrt.
    fn resolve(&self, name: &str, dir: &Path) -> PathBuf {
        let near = dir.join(name);
        let main = self.main_dir.join(name);
        let path = if !near.exists() && main.exists() { main } else { near };
        self.inputs.borrow_mut().push(path.clone());
        path
    }

    fn transform(&mut self, word: &str, place: &Place, lexer: &mut Lexer<'_>) -> Result<(), Message> {
        let matrix = word == "Transform" || word == "ConcatTransform";
        let count = match word {
            "LookAt" => 9,
            "Rotate" => 4,
            "Translate" | "Scale" => 3,
            _ => 16,
        };
        let bracket = |lexer: &mut Lexer<'_>, wanted: Token<'_>| {
            let (found, line) = lexer.expect(&wanted.show())?;
            let wrong =
                || lexer.place(line).message(format!("{word}: expected {}, found {}", wanted.show(), found.show()));
            if found == wanted { Ok(()) } else { Err(wrong()) }
        };
        if matrix {
            bracket(lexer, Token::Open)?;
        }
        let mut m = [0.0; 16];
        for x in &mut m[..count] {
            *x = lexer.number(word)?;
        }
        if matrix {
            bracket(lexer, Token::Close)?;
        }

        let three = |i: usize| [m[i], m[i + 1], m[i + 2]];
        let made = match word {
            "Translate" => Ok(Transform::translate(three(0))),
            "Scale" => Ok(Transform::scale(three(0))),
            "Rotate" => Transform::rotate(m[0], three(1)).ok_or("the axis must not be zero"),
            "LookAt" => {
                Transform::look_at(three(0), three(3), three(6)).ok_or("eye, target and up do not define a view")
            }
            _ => Transform::from_columns(&m).ok_or("not affine: every fourth number must be 0, the last one 1"),
        };
        let made = made.map_err(|why| place.message(format!("{word} {:?}: {why}", &m[..count])))?;
        self.state.ctm = if word == "Transform" { made } else { self.state.ctm.after(&made) };
        if !self.state.ctm.is_finite() {
            return Err(place.message(format!("{word}: the transform is no longer finite")));
        }
        Ok(())
    }

    fn camera(&mut self, kind: &str, params: &mut Params) -> Result<(), Message> {
        if kind != "perspective" {
            return Err(params.error("not supported, only \"perspective\""));
        }
        if self.camera.is_some() {
            return Err(params.error("a second camera: only one is supported"));
        }
        params.reject(&["screenwindow", "frameaspectratio"])?;
        let radius = params.float("lensradius")?.unwrap_or(0.0);
        if radius < 0.0 {
            return Err(params.error(format!("\"lensradius\": must be at least 0, not {}", shown(radius))));
        }
        let focus = params.float("focaldistance")?.unwrap_or(1e6);
        if focus <= 0.0 {
            return Err(params.error(format!("\"focaldistance\": must be greater than 0, not {}", shown(focus))));
        }
        let fov = params.float("fov")?.unwrap_or(90.0);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(
                params.error(format!("\"fov\": must be greater than 0 and less than 180 degrees, not {}", shown(fov)))
            );
        }
        let singular = || params.error("its transform is singular");
        let world = self.state.ctm.inverse().ok_or_else(singular)?;
        self.systems.insert("camera".into(), world);
        let forward = world.vector([0.0, 0.0, 1.0]);
        let unit = length(forward);
        let axis = |v: [f64; 3]| scaled(world.vector(v), 1.0 / unit);
        let lens = (radius > 0.0).then_some(Lens { radius, focus, unit });
        if let Some(lens) =
            lens.filter(|l| !((l.radius * unit) as f32).is_normal() || !((l.radius / l.focus) as f32).is_normal())
        {
            let Lens { radius, focus, .. } = lens;
            return Err(
                params.error(format!("a lens of radius {radius:e} focused at {focus:e} is out of the range of f32"))
            );
        }
        let camera = CameraSettings {
            origin: world.shift,
            forward: axis([0.0, 0.0, 1.0]),
            right: axis([1.0, 0.0, 0.0]),
            up: axis([0.0, 1.0, 0.0]),
            fov,
            lens,
        };
        let mut numbers = camera.forward.iter().chain(&camera.right).chain(&camera.up);
        if !numbers.all(|x| x.is_finite()) {
            return Err(singular());
        }
        self.camera = Some(camera);
        Ok(())
    }

    fn film(&mut self, kind: &str, params: &mut Params) -> Result<(), Message> {
        if kind != "rgb" {
            return Err(params.error("not supported, only \"rgb\""));
        }
        let width = params.integer("xresolution")?.unwrap_or(1280);
        let height = params.integer("yresolution")?.unwrap_or(720);
        // a negative number is a very large one here
        if !is_size(width as u64, height as u64) {
            return Err(params
                .error(format!("{width} × {height} pixels: each side must be 1 to 65536, and the area at most 2^28")));
        }
        let diagonal = params.float("diagonal")?.unwrap_or(35.0);
        if !(1e-2..=1e6).contains(&diagonal) {
            return Err(params.error(format!("\"diagonal\": must be from 1e-2 to 1e6 mm, not {diagonal:e}")));
        }
        let filename = params.text("filename")?;
        self.film = Some(FilmSettings { width: width as u32, height: height as u32, diagonal, filename });
        Ok(())
    }

    fn sampler(&mut self, kind: &str, params: &mut Params) -> Result<(), Message> {
        let samples = if kind == "stratified" {
            params.integer("xsamples")?.unwrap_or(4).saturating_mul(params.integer("ysamples")?.unwrap_or(4))
        } else {
            params.integer("pixelsamples")?.unwrap_or(16)
        };
        let samples = u32::try_from(samples)
            .ok()
            .filter(|n| (1..=MOST_SAMPLES).contains(n))
            .ok_or_else(|| params.error(format!("{samples} samples per pixel: must be from 1 to {MOST_SAMPLES}")))?;
        if kind != "independent" && kind != "stratified" {
            self.warn(
                &params.place,
                params.error("only the number of samples is used; --sampler chooses the sampler").text,
            );
        }
        self.pixel_samples = Some(samples);
        Ok(())
    }

    fn light(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<(), Message> {
        let mut warnings = Vec::new();
        let open = |name: &str| match BUILTIN_IMAGES.iter().find(|(known, _)| self.is_builtin && *known == name) {
            Some((_, bytes)) => image::decode(Path::new(name), bytes),
            None => image::read(&self.resolve(name, dir)),
        };
        let source = lights::read(kind, params, &self.state.ctm, &open, &mut warnings)?;
        self.out.warnings.append(&mut warnings);
        match source {
            lights::Source::Delta(light) => self.delta_lights.push(light),
            lights::Source::Environment(_) if self.environment.is_some() => {
                return Err(params.error("a second one: only one infinite light is supported"));
            }
            lights::Source::Environment(environment) => self.environment = Some(environment),
            lights::Source::Dark => {}
        }
        Ok(())
    }

    fn area_light(&mut self, kind: &str, params: &mut Params) -> Result<(), Message> {
        if kind != "diffuse" {
            return Err(params.error("not supported, only \"diffuse\""));
        }
        params.reject(&["power", "filename"])?;
        let radiance = params.rgb("L")?.unwrap_or([1.0; 3]);
        let scale = params.float("scale")?.unwrap_or(1.0);
        if scale < 0.0 {
            return Err(params.error(format!("\"scale\": must be at least 0, not {}", shown(scale))));
        }
        let radiance = radiance.map(|x| x * scale);
        let two_sided = params.flag("twosided")?.unwrap_or(false);
        let too_large = || params.error(format!("the radiance {radiance:?}: at most {MOST_RADIANCE:e} is supported"));
        let radiance = rounded(radiance).filter(|rgb| rgb.iter().all(|&x| x <= MOST_RADIANCE)).ok_or_else(too_large)?;
        if let Some(text) = brightness(radiance) {
            self.warn(&params.place, params.error(text).text);
        }
        let dark = radiance == [0.0; 3];
        if dark {
            self.warn(&params.place, params.error("emits nothing").text);
        }
        self.state.emission = (!dark).then_some(Emission { radiance, two_sided });
        Ok(())
    }

    fn shape(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<(), Message> {
        let det = self.state.ctm.determinant();
        if det == 0.0 || !det.is_finite() {
            return Err(params.error("its transform is singular"));
        }
        let surface = ShapeAttributes {
            ctm: self.state.ctm,
            flip: self.state.reverse != (det < 0.0),
            material: self.out.material(self.state.material),
            emission: self.state.emission,
        };
        params.reject(&["alpha", "displacement", "emissionfilename"])?;
        match kind {
            "sphere" => shapes::sphere(&mut self.out, &surface, params),
            "trianglemesh" => shapes::triangle_mesh(&mut self.out, &surface, params),
            "bilinearmesh" => shapes::bilinear_mesh(&mut self.out, &surface, params),
            "loopsubdiv" => shapes::loop_mesh(&mut self.out, &surface, params),
            "disk" => shapes::disk(&mut self.out, &surface, params),
            "cylinder" => shapes::cylinder(&mut self.out, &surface, params),
            "plymesh" => {
                let Some(name) = params.text("filename")? else {
                    return Err(params.error("\"string filename\" is missing"));
                };
                if let Some(name) = name.strip_prefix("builtin:").filter(|_| self.is_builtin) {
                    return shapes::computed(&mut self.out, &surface, params, name);
                }
                let path = self.resolve(&name, dir);
                shapes::ply_mesh(&mut self.out, &surface, params, &path)
            }
            _ => Err(params.error("shape not supported, only sphere, trianglemesh, bilinearmesh and plymesh")),
        }
    }
}
