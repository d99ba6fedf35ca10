//! Interprets the directives of a scene file and keeps the graphics state.

use super::area_lights::{self, Shown};
use super::blocks::{Blocks, State};
use super::film_and_camera;
use super::given::Given;
use super::includes::Includes;
pub(super) use super::includes::Origin;
use super::inputs::Files;
use super::lexer::{Lexer, Token};
use super::material_parameters::{self, Context, Finish};
use super::mixtures::{self, Mixture};
use super::named_materials::NamedMaterials;
use super::params::Params;
use super::portal_sides;
use super::shape_state::ShapeState;
use super::shapes;
use super::sources::Sources;
use super::textures::Textures;
use super::transform_directives;
use crate::builder::{Builder, Rest};
use crate::list::PBRT;
use crate::message::{Place, shortened, utf8};
use crate::nearest::did_you_mean;
use crate::transform::Transform;
use etendue_render::scene::{CameraSettings, FilmSettings, Message, Scene};
use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Directives before `WorldBegin`.
const OPTIONS: [&str; 7] = ["Camera", "Film", "Sampler", "PixelFilter", "Integrator", "Accelerator", "Option"];
/// Directives after it.
const WORLD: [&str; 14] = [
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
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
];

struct Reader<'a> {
    files: Files<'a>,
    camera: Option<CameraSettings>,
    /// The time of exposure.
    shutter: f64,
    film: Option<FilmSettings>,
    pixel_samples: Option<u32>,
    sources: Sources,
    out: Builder,
    state: State,
    blocks: Blocks,
    systems: HashMap<String, Transform>,
    named: NamedMaterials,
    mixtures: Vec<Mixture>,
    textures: Textures,
    /// The pictures of lights.
    shown: Shown,
    in_world: bool,
    includes: Includes,
}

/// Reads a whole scene; only a built-in scene may name `builtin:` meshes.
pub(super) fn read(text: &str, file: &str, dir: &Path, origin: Origin<'_>) -> Result<Scene, Message> {
    let inputs = RefCell::default();
    let mut reader = Reader {
        files: Files { main: dir, folder: dir, is_builtin: matches!(origin, Origin::Builtin), inputs: &inputs },
        camera: None,
        shutter: 1.0,
        film: None,
        pixel_samples: None,
        sources: Sources::default(),
        out: Builder::default(),
        state: State::default(),
        blocks: Blocks::default(),
        systems: HashMap::new(),
        named: NamedMaterials::default(),
        mixtures: Vec::new(),
        textures: Textures::default(),
        shown: Shown::default(),
        in_world: false,
        includes: Includes::new(origin),
    };
    let file: Arc<str> = Arc::from(file);
    reader.file(text, file.clone(), dir)?;

    let lines = u32::try_from(text.lines().count()).unwrap_or(u32::MAX);
    let end = Place { file: file.clone(), line: lines.max(1) };
    reader.blocks.check_closed()?;
    reader.named.keep_promises(&reader.mixtures, &mut reader.out)?;
    let Some(mut camera) = reader.camera else {
        return Err(end.message("the scene has no Camera"));
    };
    if !reader.in_world {
        return Err(end.message("the scene has no WorldBegin"));
    }
    let whole = FilmSettings { width: 1280, height: 720, diagonal: 35.0, filename: None, place: None, exposure: 1.0 };
    let mut film = reader.film.unwrap_or(whole);
    film.exposure *= reader.shutter;
    film_and_camera::fit(&mut camera, &film);
    let Sources { delta_lights, intensities, environment, portals } = reader.sources;
    let rest = Rest {
        camera,
        film,
        pixel_samples: reader.pixel_samples.unwrap_or(16),
        delta_lights,
        intensities,
        environment,
        inputs: inputs.take(),
    };
    let scene = reader.out.scene(&file, rest, |text| end.message(text));
    portal_sides::check(&scene, portals)?;
    Ok(scene)
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
        if self.in_world && OPTIONS.contains(&word) {
            return Err(place.message(format!("{word} must come before WorldBegin")));
        }
        if !self.in_world && WORLD.contains(&word) {
            return Err(place.message(format!("{word} must come after WorldBegin")));
        }
        match word {
            "Identity" | "Translate" | "Scale" | "Rotate" | "LookAt" | "Transform" | "ConcatTransform"
            | "CoordinateSystem" | "CoordSysTransform" | "ActiveTransform" | "TransformTimes" => {
                let Self { state, systems, out, .. } = self;
                transform_directives::apply(word, &place, lexer, state, systems, &mut out.notes)?;
            }
            "ReverseOrientation" => self.state.reverse = !self.state.reverse,
            "WorldBegin" => {
                if self.in_world {
                    return Err(place.message("a second WorldBegin: only one is allowed"));
                }
                self.in_world = true;
                self.state.ctm = Transform::IDENTITY;
                // as in pbrt, it makes all transforms active again
                self.state.is_end = false;
                self.systems.insert("world".into(), Transform::IDENTITY);
            }
            "AttributeBegin" | "TransformBegin" => self.blocks.begin(word, place, &self.state)?,
            "AttributeEnd" | "TransformEnd" => self.state = self.blocks.end(word, &place)?,
            "ObjectBegin" => {
                let name = lexer.text("a name")?;
                self.blocks.begin_object(name, place, &self.state, &mut self.out)?;
            }
            "ObjectEnd" => {
                if let Some(state) = self.blocks.end_object(&place, &mut self.out)? {
                    self.state = state;
                }
            }
            "ObjectInstance" => {
                let name = lexer.text("a name")?;
                self.blocks.instance(&name, &place, &self.state.ctm, &mut self.out)?;
            }
            "Include" | "Import" => self.include_or_import(word, place, lexer, dir)?,
            "MediumInterface" | "MakeNamedMedium" => self.medium(word, &place, lexer)?,
            "Attribute" => self.attribute(place, lexer)?,
            "Texture" => self.texture(place, lexer, dir)?,
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
                self.state.material = self.named.named(name, place);
            }
            // pbrt-v3 has it at the end
            "WorldEnd" if self.in_world => {}
            "Camera" | "Film" | "Sampler" | "PixelFilter" | "Integrator" | "Accelerator" | "AreaLightSource"
            | "LightSource" | "Material" | "MakeNamedMaterial" | "Shape" => {
                let kind = lexer.text("a type")?;
                let params = Params::read(lexer, format!("{word} {:?}", shortened(&kind)), place)?.of(word, &kind);
                self.with_params(word, &kind, params, dir)?;
            }
            _ => {
                let near = did_you_mean(word, PBRT.entries.iter().flat_map(|entry| entry.name.split(", ")));
                return Err(place.message(format!("unknown directive {}{near}", shortened(word))));
            }
        }
        Ok(())
    }

    fn include_or_import(
        &mut self,
        word: &str,
        place: Place,
        lexer: &mut Lexer<'_>,
        dir: &Path,
    ) -> Result<(), Message> {
        if word == "Include" {
            self.include(&place, lexer, dir)?;
            // parameters of the last directive of the file, such as a medium, may go on after it
            if let Some(Token::Text(_)) = lexer.peek()? {
                let params = Params::read(lexer, word.to_owned(), place)?;
                let message = || params.error("the parameters that follow it are ignored");
                self.out.notes.stand_in("parameters", message);
            }
            return Ok(());
        }
        // what an imported file changes ends with it
        let (state, depth) = (self.state.clone(), self.blocks.depth());
        self.include(&place, lexer, dir)?;
        if let Some(opened) = self.blocks.opened(depth) {
            return Err(opened.message("Import: the file does not close what this line opens"));
        }
        if self.blocks.depth() < depth {
            return Err(place.message("Import: the file closes more than it opens"));
        }
        self.state = state;
        Ok(())
    }

    fn medium(&mut self, word: &str, place: &Place, lexer: &mut Lexer<'_>) -> Result<(), Message> {
        let name = lexer.text("a medium")?;
        if word == "MakeNamedMedium" {
            Params::read(lexer, format!("{word} {:?}", shortened(&name)), place.clone())?;
        } else if let Some(Token::Text(_)) = lexer.peek()? {
            lexer.text("a medium")?;
        }
        self.out.notes.stand_in("media", || place.message(format!("{word}: media are ignored")));
        Ok(())
    }

    fn attribute(&mut self, place: Place, lexer: &mut Lexer<'_>) -> Result<(), Message> {
        const TARGETS: [&str; 5] = ["shape", "light", "material", "medium", "texture"];
        let target = lexer.text("what the attributes are for")?;
        if !TARGETS.contains(&&*target) {
            let found = shortened(&target);
            return Err(place.message(format!("Attribute {found:?}: only {}", TARGETS.join(", "))));
        }
        let params = Params::read(lexer, format!("Attribute {target:?}"), place)?;
        self.state.defaults.insert(0, (target, params.into_list()));
        Ok(())
    }

    fn texture(&mut self, place: Place, lexer: &mut Lexer<'_>, dir: &Path) -> Result<(), Message> {
        let (name, value) = (lexer.text("a name")?, lexer.text("a type of value")?);
        let kind = lexer.text("a type")?;
        let params = Params::read(lexer, format!("Texture {:?}", shortened(&name)), place)?;
        let mut params = params.of("Texture", &kind);
        self.with_defaults("texture", &mut params);
        let Self { out, state, files, textures, .. } = self;
        let files = files.at(dir);
        let mut given = Given { params: &mut params, files, notes: &mut out.notes, ctm: &state.ctm };
        textures.define(&name, &value, &kind, &mut given)?;
        params.finish(&mut self.out.notes);
        Ok(())
    }

    fn with_params(&mut self, word: &str, kind: &str, mut params: Params, dir: &Path) -> Result<(), Message> {
        match word {
            "Camera" => self.camera(kind, &mut params, dir)?,
            "Film" => self.film = Some(film_and_camera::film(kind, &mut params)?),
            "Sampler" => self.pixel_samples = Some(film_and_camera::samples(kind, &mut params, &mut self.out.notes)?),
            "PixelFilter" => {
                let mut half = |name| Ok(params.float(name)?.is_none_or(|radius| radius == 0.5));
                if !(half("xradius")? & half("yradius")? & (kind == "box")) {
                    self.out.notes.warn(params.error("ignored: the filter is always a box of one pixel"));
                }
            }
            "Integrator" => {
                let direct = params.integer("maxdepth")? == Some(1);
                if !(direct && ["path", "volpath", "simplepath"].contains(&kind)) {
                    let text = "only direct light is rendered, as with \"path\" and maxdepth 1";
                    self.out.notes.warn(params.error(text));
                }
            }
            "Accelerator" => {
                self.out.notes.warn(params.error("ignored"));
                return Ok(());
            }
            "Material" => {
                self.with_defaults("material", &mut params);
                self.state.material = self.material(kind, &mut params, dir)?;
            }
            "MakeNamedMaterial" => {
                self.with_defaults("material", &mut params);
                let Some(of) = params.text("type")? else {
                    return Err(params.error("\"string type\" is missing"));
                };
                params = params.of("Material", &of);
                let material = self.material(&of, &mut params, dir)?;
                self.named.define(kind.into(), material);
            }
            "AreaLightSource" => {
                self.with_defaults("light", &mut params);
                let Self { out, state, files, shown, .. } = self;
                let files = files.at(dir);
                let mut given = Given { params: &mut params, files, notes: &mut out.notes, ctm: &state.ctm };
                state.area = area_lights::read(kind, &mut given, shown)?;
            }
            "LightSource" => {
                self.with_defaults("light", &mut params);
                self.light(kind, &mut params, dir)?;
            }
            _ => {
                self.with_defaults("shape", &mut params);
                self.shape(kind, &mut params, dir)?;
            }
        }
        params.finish(&mut self.out.notes);
        Ok(())
    }

    /// Adds the parameters of `Attribute`, the newest first.
    fn with_defaults(&self, target: &str, params: &mut Params) {
        for (_, list) in self.state.defaults.iter().filter(|(of, _)| of == target) {
            params.default_to(list);
        }
    }

    fn material(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<Finish, Message> {
        let Self { out, state, named, textures, files, mixtures, .. } = self;
        let given = Given { params, files: files.at(dir), notes: &mut out.notes, ctm: &state.ctm };
        let context = Context { textures, named: &|name| named.get(name), materials: &mut out.materials, given };
        material_parameters::read(kind, context, mixtures)
    }

    fn warn(&mut self, place: &Place, text: String) {
        self.out.notes.warn(place.message(text));
    }

    fn include(&mut self, place: &Place, lexer: &mut Lexer<'_>, dir: &Path) -> Result<(), Message> {
        let name = lexer.text("a file name")?;
        let files = self.files.at(dir);
        let path = files.find(&name);
        let bytes = self.includes.open(place, &path, &files)?;
        let file: Arc<str> = Arc::from(path.display().to_string());
        let text = utf8(&bytes, &file)?;
        self.file(text, file, path.parent().unwrap_or(Path::new("")))?;
        self.includes.close();
        Ok(())
    }

    fn camera(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<(), Message> {
        let Self { out, state, files, .. } = self;
        let mut given = Given { params, files: files.at(dir), notes: &mut out.notes, ctm: &state.ctm };
        if self.camera.is_some() {
            given.warn("a second camera: the last one counts");
        }
        let (camera, world, shutter) = film_and_camera::camera(kind, &mut given)?;
        self.systems.insert("camera".into(), world);
        self.camera = Some(camera);
        self.shutter = shutter;
        Ok(())
    }

    fn light(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<(), Message> {
        let Self { out, state, sources, files, .. } = self;
        sources.read(kind, &mut Given { params, files: files.at(dir), notes: &mut out.notes, ctm: &state.ctm })
    }

    fn shape(&mut self, kind: &str, params: &mut Params, dir: &Path) -> Result<(), Message> {
        let Self { out, state, named, textures, blocks, files, mixtures: known, .. } = self;
        // what emits is no mixture, and one that is defined later is none yet
        let mut parts = vec![(mixtures::greatest(state.material, known), None)];
        if state.area.emission.is_none() && matches!(state.material, Finish::Mix(_)) {
            let mixed = mixtures::parts(state.material, known);
            parts = mixed.into_iter().map(|(finish, share)| (finish, Some(share))).collect();
        }
        let files = files.at(dir);
        // a mixture is several surfaces in one place: a ray passes each but the last with the chance that it is of the others
        let last = parts.len() - 1;
        for (index, (material, share)) in parts.into_iter().enumerate() {
            let mut again = (index < last).then(|| params.clone());
            let own = again.as_mut().unwrap_or(params);
            let shape = ShapeState {
                ctm: state.ctm,
                reverse: state.reverse,
                material,
                share,
                area: state.area.clone(),
                is_object: blocks.is_object(),
            };
            out.begin(own.place.message(""));
            if let Some(surface) = shape.attributes(kind, own, files, textures, named, out)? {
                shapes::read(kind, out, &surface, own, &files)?;
            }
        }
        Ok(())
    }
}
