//! Reads perspective cameras, and makes one for a scene without any.

use super::super::builder::Builder;
use super::super::description::{CameraSettings, FilmSettings};
use super::super::message::Message;
use super::super::transform::{Transform, add, cross, dot, length, scaled, sub, unit};
use super::source::Source;
use crate::limits::MOST_SIDE;
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
    FilmSettings { width, height, diagonal: 35.0, filename: None }
}

/// Reads the camera of a node, which looks along its −z axis with its y axis up; `None` if it is orthographic. Scales of the node do
/// not change the image, but reflections mirror it.
pub(super) fn read(
    source: &Source<'_>,
    camera: Index<Camera>,
    node: usize,
    transform: &Transform,
) -> Result<Option<(CameraSettings, FilmSettings)>, Message> {
    let (index, camera) = source.item(&source.root.cameras, camera, "camera", &format!("node {node}"))?;
    let failed = |what: String| source.message(format!("camera {index}: {what}"));
    match camera.type_ {
        Checked::Valid(Type::Perspective) => {}
        Checked::Valid(Type::Orthographic) => return Ok(None),
        Checked::Invalid => return Err(failed("its type is not \"perspective\" or \"orthographic\"".into())),
    }
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
        Some(aspect) => {
            let height = (f64::from(SIZE[0]) / aspect).round().clamp(1.0, f64::from(MOST_SIDE));
            [SIZE[0], height as u32]
        }
        None => SIZE,
    };
    // across the shorter side
    let narrowed = (f64::from(size[0]) / f64::from(size[1])).min(1.0);
    let fov = 2.0 * libm::atan(libm::tan(yfov / 2.0) * narrowed).to_degrees();
    let axis = |v: [f64; 3], others: &[[f64; 3]]| {
        let v = unit(transform.vector(v))?;
        let rest = others.iter().fold(v, |v, other| sub(v, scaled(*other, dot(v, *other))));
        (length(rest) > 1e-6).then(|| unit(rest)).flatten()
    };
    let axes = || {
        let forward = axis([0.0, 0.0, -1.0], &[])?;
        let right = axis([1.0, 0.0, 0.0], &[forward])?;
        Some([forward, right, axis([0.0, 1.0, 0.0], &[forward, right])?])
    };
    let [forward, right, up] =
        axes().ok_or_else(|| source.message(format!("node {node}: the transform of its camera is singular")))?;
    if !(fov > 0.0 && fov < 180.0) {
        return Err(failed(format!("yfov {yfov}: {fov} degrees across the shorter side of the image")));
    }
    Ok(Some((CameraSettings { origin: transform.shift, forward, right, up, fov, lens: None }, film(size))))
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
    (CameraSettings { origin, forward, right, up, fov: FOV, lens: None }, film(SIZE))
}
