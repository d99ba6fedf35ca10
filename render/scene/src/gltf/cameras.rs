//! Reads cameras, and makes one for a scene without any.

use super::source::Source;
use crate::builder::Builder;
use crate::message::{Notes, shortened};
use crate::nearest::did_you_mean;
use crate::transform::{Transform, add, cross, dot, length, scaled, sub, unit};
use etendue_render::scene::limits::MOST_SIDE;
use etendue_render::scene::{CameraSettings, FilmSettings, Message, Screen};
use gltf_json::Index;
use gltf_json::camera::{Camera, Type};
use gltf_json::validation::Checked;

/// The size of an image whose camera has no aspect ratio.
const SIZE: [u32; 2] = [1280, 720];
/// From where the camera of a scene without any looks: angles from the z axis to the x axis, and up, in degrees.
const AZIMUTH: f64 = 30.0;
const ELEVATION: f64 = 20.0;
/// Its angle of view in degrees.
const FOV: f64 = 40.0;

/// An image of this size.
fn film([width, height]: [u32; 2]) -> FilmSettings {
    FilmSettings { width, height, diagonal: 35.0, filename: None, place: None, exposure: 1.0 }
}

/// Reads the camera of a node, which looks along its −z axis with its y axis up. Scales of the node do not change the image, but reflections
/// mirror it.
pub(super) fn read(
    source: &Source<'_>,
    camera: Index<Camera>,
    node: usize,
    transform: &Transform,
) -> Result<(CameraSettings, FilmSettings), Message> {
    let (index, camera) = source.item(&source.root.cameras, camera, "camera", &format!("node {node}"))?;
    let failed = |what: String| source.message(format!("camera {index}: {what}"));
    let sized = |aspect: f64| {
        let height = (f64::from(SIZE[0]) / aspect).round().clamp(1.0, f64::from(MOST_SIDE));
        [SIZE[0], height as u32]
    };
    let narrowed = |size: [u32; 2]| (f64::from(size[0]) / f64::from(size[1])).min(1.0);
    // half of the shorter side, and which axes are mirrored
    let (is_orthographic, half, size, signs) = match camera.type_ {
        Checked::Valid(Type::Perspective) => {
            let missing = || failed("a perspective camera without \"perspective\"".into());
            let perspective = camera.perspective.as_ref().ok_or_else(missing)?;
            let yfov = f64::from(perspective.yfov);
            if !(yfov > 0.0 && yfov < std::f64::consts::PI) {
                return Err(failed(format!("yfov: must be greater than 0 and less than π, not {yfov}")));
            }
            let size = match perspective.aspect_ratio.map(f64::from) {
                Some(aspect) if !(aspect > 0.0 && aspect.is_finite()) => {
                    return Err(failed(format!("aspectRatio: must be finite and greater than 0, not {aspect}")));
                }
                Some(aspect) => sized(aspect),
                None => SIZE,
            };
            let half = libm::tan(yfov / 2.0) * narrowed(size);
            if !(half > 0.0 && half < 1e15) {
                return Err(failed(format!("yfov {yfov}: a tangent of {half} of half the shorter side of the image")));
            }
            (false, half, size, [1.0; 2])
        }
        Checked::Valid(Type::Orthographic) => {
            let missing = || failed("an orthographic camera without \"orthographic\"".into());
            let orthographic = camera.orthographic.as_ref().ok_or_else(missing)?;
            let sides = [orthographic.xmag, orthographic.ymag].map(f64::from);
            if !sides.iter().all(|side| side.is_finite() && *side != 0.0) {
                return Err(failed(format!("xmag {} and ymag {}: must be finite and not 0", sides[0], sides[1])));
            }
            let [x, y] = sides.map(f64::abs);
            let size = sized(x / y);
            (true, y * narrowed(size), size, sides.map(f64::signum))
        }
        Checked::Invalid => return Err(failed("its type is not \"perspective\" or \"orthographic\"".into())),
    };
    let axis = |v: [f64; 3], others: &[[f64; 3]]| {
        let v = transform.direction(v, 1e-6)?;
        let rest = others.iter().fold(v, |v, other| sub(v, scaled(*other, dot(v, *other))));
        (length(rest) > 1e-6).then(|| unit(rest)).flatten()
    };
    let axes = || {
        let forward = axis([0.0, 0.0, -1.0], &[])?;
        let right = axis([signs[0], 0.0, 0.0], &[forward])?;
        Some([forward, right, axis([0.0, signs[1], 0.0], &[forward, right])?])
    };
    let [forward, right, up] =
        axes().ok_or_else(|| source.message(format!("node {node}: the transform of its camera is singular")))?;
    let (origin, screen) = (transform.shift, Screen::Half(half));
    Ok((CameraSettings { origin, forward, right, up, is_orthographic, screen, lens: None }, film(size)))
}

/// The name of the camera of a node: its own, or that of the node.
pub(super) fn name(source: &Source<'_>, camera: Index<Camera>, node: usize) -> String {
    let own = source.root.cameras.get(camera.value()).and_then(|camera| camera.name.clone());
    own.or_else(|| source.root.nodes[node].name.clone()).unwrap_or_default()
}

/// The camera of this name or number, or else the first one; `None` if there is none.
pub(super) fn choose(
    source: &Source<'_>,
    all: &[(Index<Camera>, usize, Transform)],
    asked: Option<&str>,
    notes: &mut Notes,
) -> Result<Option<(CameraSettings, FilmSettings)>, Message> {
    let is_named = |(camera, node, _): &(Index<Camera>, usize, Transform), wanted: &str| {
        let own = source.root.cameras.get(camera.value()).and_then(|camera| camera.name.as_deref());
        own == Some(wanted) || source.root.nodes[*node].name.as_deref() == Some(wanted)
    };
    let index = match asked {
        Some(wanted) => {
            let by_name = all.iter().position(|camera| is_named(camera, wanted));
            let index = by_name.or_else(|| wanted.parse().ok()).filter(|&index| index < all.len());
            let unknown = || {
                let names: Vec<String> = all.iter().map(|(camera, node, _)| name(source, *camera, *node)).collect();
                let near = did_you_mean(wanted, names.iter().map(String::as_str));
                let count = all.len();
                source.message(format!("has no camera {:?}: there are {count}, from 0 on{near}", shortened(wanted)))
            };
            index.ok_or_else(unknown)?
        }
        None => 0,
    };
    if all.len() > 1 && asked.is_none() {
        let (count, first) = (all.len(), shortened(&name(source, all[0].0, all[0].1)));
        notes.warn(source.message(format!(
            "{count} cameras: the first one, {first:?}, is taken; --camera NAME or a number from 0 on takes another"
        )));
    }
    all.get(index).map(|(camera, node, transform)| read(source, *camera, *node, transform)).transpose()
}

/// A camera that sees all surfaces, from above and from the side.
pub(super) fn framing(out: &Builder) -> (CameraSettings, FilmSettings) {
    let corners = out.bounds().map(|corner| corner.map(f64::from));
    let [low, high] = if corners[0][0] <= corners[1][0] { corners } else { [[-1.0; 3], [1.0; 3]] };
    let center = scaled(add(low, high), 0.5);
    let radius = 0.5 * length(sub(high, low));
    let distance = radius / libm::sin(FOV.to_radians() / 2.0);
    let [(sin_a, cos_a), (sin_e, cos_e)] = [AZIMUTH, ELEVATION].map(|angle| libm::sincos(angle.to_radians()));
    let towards_eye = [cos_e * sin_a, sin_e, cos_e * cos_a];
    let forward = scaled(towards_eye, -1.0);
    let right = [cos_a, 0.0, -sin_a];
    let up = cross(right, forward);
    let origin = add(center, scaled(towards_eye, distance));
    let screen = Screen::Half(libm::tan(FOV.to_radians() / 2.0));
    (CameraSettings { origin, forward, right, up, is_orthographic: false, screen, lens: None }, film(SIZE))
}
