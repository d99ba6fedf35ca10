//! Reads glTF 2.0 scene files: JSON text that names other files, or one binary file.
//!
//! What the renderer does not have is ignored, with one warning of each kind. An extension that the file requires and that is not supported
//! is an error.
//! Photometric units count as radiometric ones of the same number, as in most renderers.

mod accessors;
mod cameras;
mod container;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod properties;
mod skins;
mod source;

use crate::asked::{Asked, Contents};
use crate::builder::{Builder, Rest};
use crate::list::{Entry, GLTF, State};
use crate::message::shortened;
use etendue_render::scene::{Message, Scene};
use materials::Materials;
use skins::Pose;
use source::Source;
use std::collections::HashMap;
use std::path::Path;

/// Whether bytes or the name of a file are those of glTF.
pub(super) fn is_gltf(path: &Path, bytes: &[u8]) -> bool {
    let named = |name: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(name));
    bytes.starts_with(container::MAGIC) || named("gltf") || named("glb")
}

/// Checks that the extensions that a file requires are supported or may be ignored.
fn check_extensions(source: &Source<'_>) -> Result<(), Message> {
    for name in &source.root.extensions_required {
        // what is ignored where it is optional is ignored with the same warning here
        let entry = GLTF.entry(name, "");
        if entry.is_none_or(|entry| entry.state == State::Refused) {
            let compressed = entry.filter(|entry| entry.note.contains("compressed"));
            let why = compressed.map_or_else(String::new, |entry| format!(": {}", entry.note));
            let shown = shortened(name);
            return Err(source.message(format!("requires the extension {shown:?}, which is not supported{why}")));
        }
    }
    Ok(())
}

/// The scenes of a file and the cameras of the one that is asked for.
pub(super) fn contents(bytes: &[u8], file: &str, asked: &Asked) -> Result<Contents, Message> {
    let source = Source::new(bytes, file, None)?;
    let placed = nodes::walk(&source, asked.scene.as_deref())?;
    let cameras = placed.iter().filter_map(|placed| Some((source.root.nodes[placed.index].camera?, placed.index)));
    let cameras = cameras.map(|(camera, node)| cameras::name(&source, camera, node)).collect();
    let scenes = source.root.scenes.iter().map(|scene| scene.name.clone().unwrap_or_default()).collect();
    Ok(Contents { scenes, cameras })
}

/// Reads a scene. Messages call it `file`; it may name files in `folder`, if there is one.
pub(super) fn read(bytes: &[u8], file: &str, folder: Option<&Path>, asked: &Asked) -> Result<Scene, Message> {
    let source = Source::new(bytes, file, folder)?;
    let root = &source.root;
    check_extensions(&source)?;
    let mut out = Builder::default();
    let mut materials = Materials::default();
    let (mut delta_lights, mut intensities) = (Vec::new(), Vec::new());
    let mut seen = Vec::new();
    properties::check(&source, source.json, &mut out.notes);
    let placed = nodes::walk(&source, asked.scene.as_deref())?;
    let mut uses: HashMap<usize, usize> = HashMap::new();
    let mut copies = HashMap::new();
    for placed in &placed {
        if let Some(mesh) = root.nodes[placed.index].mesh {
            let own = nodes::copies(&source, placed.index)?;
            *uses.entry(mesh.value()).or_default() += own.len();
            copies.insert(placed.index, own);
        }
    }
    // meshes that are placed several times, and that emit nothing
    let mut objects: HashMap<usize, u32> = HashMap::new();
    for &nodes::Placed { index, transform } in &placed {
        let node = &root.nodes[index];
        let pose = match node.skin {
            Some(skin) => Pose::new(&source, skin, index, &placed)?,
            None => None,
        };
        if node.skin.is_some() && pose.is_none() {
            let what = format!("node {index}: its skin is ignored: a joint is not in the scene, or singular");
            out.notes.stand_in("skins", || source.message(what));
        }
        for copy in copies.get(&index).into_iter().flatten() {
            let Some(mesh) = node.mesh else { continue };
            let transform = transform.after(copy);
            // weights of a node make the mesh its own
            let is_shared = node.weights.is_none()
                && pose.is_none()
                && uses[&mesh.value()] > 1
                && !meshes::glows(&source, &mut materials, &mut out, mesh, index)?;
            // no instance is flat
            if !is_shared || transform.determinant() == 0.0 {
                out.begin(source.message(format!("node {index}")));
                meshes::add(&source, &mut materials, &mut out, mesh, index, &transform, pose.as_ref())?;
                continue;
            }
            let object = match objects.get(&mesh.value()) {
                Some(&object) => object,
                None => meshes::object(&source, &mut materials, &mut out, mesh, index)?,
            };
            objects.insert(mesh.value(), object);
            let added = out.instance(object, &transform);
            added.map_err(|why| source.message(format!("node {index}: {why}")))?;
        }
        if let Some(described) = node.camera {
            seen.push((described, index, transform));
        }
        if let Some(light) = node.extensions.as_ref().and_then(|all| all.khr_lights_punctual.as_ref()) {
            match lights::read(&source, light.light, index, &transform, &mut intensities, &mut out.notes)? {
                Some(light) => delta_lights.push(light),
                None => {
                    out.notes.warn_once("dark", || source.message(format!("node {index}: its light emits nothing")))
                }
            }
        }
    }
    for name in &root.extensions_used {
        let is_known = |entry: &Entry| matches!(entry.state, State::Exact | State::Inert | State::Approximated);
        if !GLTF.entry(name, "").is_some_and(is_known) {
            out.notes.stand_in(&format!("extension {name}"), || {
                source.message(format!("the extension {:?} is ignored", shortened(name)))
            });
        }
    }
    let left_out = out.left_out();
    if left_out > 0 {
        out.notes.warn(source.message(format!("{left_out} triangle(s) without area are left out")));
    }
    let camera = cameras::choose(&source, &seen, asked.camera.as_deref(), &mut out.notes)?;
    let (camera, film) = camera.unwrap_or_else(|| {
        let framing = cameras::framing(&out);
        out.notes.warn(source.message("no camera: framing the whole scene"));
        framing
    });
    let message = |text: &str| source.message(text);
    let inputs = source.inputs();
    let rest = Rest { camera, film, pixel_samples: 16, delta_lights, intensities, environment: None, inputs };
    Ok(out.scene(file, rest, message))
}
