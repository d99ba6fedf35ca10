//! Reads `Camera`, `Film` and `Sampler`.

use super::description::{CameraSettings, FilmSettings, Lens};
use super::message::{Message, Notes};
use super::params::{Params, shown};
use super::transform::{Transform, add, length, scaled};
use crate::area::Area;
use crate::limits::{MOST_SAMPLES, is_size};

/// Reads a `Camera`, which looks along +z of camera space, and its transform to world space. `ctm` is the transform from world space.
pub(super) fn camera(
    kind: &str,
    params: &mut Params,
    ctm: &Transform,
    notes: &mut Notes,
) -> Result<(CameraSettings, Transform), Message> {
    let far = match kind {
        "perspective" => None,
        "orthographic" => {
            let why = "becomes a perspective one from a thousand times as far as the image is wide";
            notes.stand_in(kind, || params.error(why));
            Some(1000.0)
        }
        "realistic" | "spherical" | "environment" => {
            notes.stand_in(kind, || params.error("becomes a perspective one of 50 degrees"));
            params.ignore_all();
            params.set_float("fov", 50.0);
            None
        }
        _ => return Err(params.error("not supported, only \"perspective\" and stand-ins for pbrt's others")),
    };
    for name in ["shutteropen", "shutterclose", "hither", "yon", "halffov"] {
        params.given(name);
    }
    if params.given("frameaspectratio") {
        let why = "\"frameaspectratio\" is ignored: pixels are square";
        notes.stand_in("frameaspectratio", || params.error(why));
    }
    // half of the screen's shorter side, which is 1 for the field of view that is given
    let screen = match params.numbers("screenwindow", "float", 4)?.as_deref() {
        None => 1.0,
        Some(&[left, right, bottom, top]) if left < right && bottom < top => {
            if left + right != 0.0 || bottom + top != 0.0 {
                let why = "\"screenwindow\" is moved to the middle of the image";
                notes.stand_in("screenwindow", || params.error(why));
            }
            (right - left).min(top - bottom) / 2.0
        }
        Some(numbers) => {
            return Err(params.error(format!("\"screenwindow\": {numbers:?} is not x0 x1 y0 y1, ascending")));
        }
    };
    let radius = params.float("lensradius")?.unwrap_or(0.0);
    if radius < 0.0 {
        return Err(params.error(format!("\"lensradius\": must be at least 0, not {}", shown(radius))));
    }
    let focus = params.float("focaldistance")?.unwrap_or(1e6);
    if focus <= 0.0 {
        return Err(params.error(format!("\"focaldistance\": must be greater than 0, not {}", shown(focus))));
    }
    let given = params.float("fov")?.unwrap_or(90.0);
    let fov = match far {
        None if screen == 1.0 => given,
        None => 2.0 * libm::atan(screen * libm::tan(given.to_radians() / 2.0)).to_degrees(),
        Some(far) => 2.0 * libm::atan(1.0 / far).to_degrees(),
    };
    if !(fov > 0.0 && fov < 180.0) {
        return Err(
            params.error(format!("\"fov\": must be greater than 0 and less than 180 degrees, not {}", shown(fov)))
        );
    }
    let singular = || params.error("its transform is singular");
    let world = ctm.inverse().ok_or_else(singular)?;
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
    let back = far.map_or(0.0, |far| -far * screen);
    let camera = CameraSettings {
        origin: world.point([0.0, 0.0, back]),
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
    Ok((camera, world))
}

/// Reads a `Film`.
pub(super) fn film(kind: &str, params: &mut Params) -> Result<(FilmSettings, Option<Window>), Message> {
    if !["rgb", "image", "gbuffer", "spectral"].contains(&kind) {
        return Err(params.error("not supported, only \"rgb\", and \"gbuffer\" and \"spectral\" as if they were that"));
    }
    let width = params.integer("xresolution")?.unwrap_or(1280);
    let height = params.integer("yresolution")?.unwrap_or(720);
    // a negative number is a very large one here
    if !is_size(width as u64, height as u64) {
        return Err(
            params.error(format!("{width} × {height} pixels: each side must be 1 to 65536, and the area at most 2^28"))
        );
    }
    let diagonal = params.float("diagonal")?.unwrap_or(35.0);
    if !(1e-2..=1e6).contains(&diagonal) {
        return Err(params.error(format!("\"diagonal\": must be from 1e-2 to 1e6 mm, not {diagonal:e}")));
    }
    let filename = params.text("filename")?;
    let full = [width as u32, height as u32];
    let Some([x0, y0, x1, y1]) = window(params, full)?.filter(|area| *area != [0, 0, full[0], full[1]]) else {
        return Ok((FilmSettings { width: full[0], height: full[1], diagonal, filename }, None));
    };
    let lens = params.error("only a part of the image is asked for, but the camera has a lens: the whole is rendered");
    let [width, height] = [x1 - x0, y1 - y0];
    let part = f64::from(width).hypot(height.into()) / f64::from(full[0]).hypot(full[1].into());
    let film = FilmSettings { width, height, diagonal: diagonal * part, filename };
    Ok((film, Some(Window { full, diagonal, area: [x0, y0, x1, y1], lens })))
}

/// The pixels [x0, y0, x1, y1) of an image that are rendered, if the file gives them.
fn window(params: &mut Params, [width, height]: [u32; 2]) -> Result<Option<Area>, Message> {
    let crop = params.numbers("cropwindow", "float", 4)?;
    let pixels = params.numbers("pixelbounds", "integer", 4)?;
    let (name, [x0, x1, y0, y1]) = match (crop.as_deref(), pixels.as_deref()) {
        (Some(&[x0, x1, y0, y1]), _) => {
            let at = |a: f64, side: u32| (a.clamp(0.0, 1.0) * f64::from(side)).ceil();
            let [x, y] =
                [[x0.min(x1), x0.max(x1)].map(|a| at(a, width)), [y0.min(y1), y0.max(y1)].map(|a| at(a, height))];
            ("cropwindow", [x[0], x[1], y[0], y[1]])
        }
        (None, Some(&[x0, x1, y0, y1])) => ("pixelbounds", [x0, x1, y0, y1]),
        (None, None) => return Ok(None),
        _ => return Err(params.error("\"cropwindow\" and \"pixelbounds\" are four numbers each")),
    };
    let [x0, x1] = [x0, x1].map(|x| x.clamp(0.0, width.into()) as u32);
    let [y0, y1] = [y0, y1].map(|y| y.clamp(0.0, height.into()) as u32);
    if x0 >= x1 || y0 >= y1 {
        return Err(params.error(format!("{name:?}: no pixel of {width} × {height} is in it")));
    }
    Ok(Some([x0, y0, x1, y1]))
}

/// The part of an image that is rendered.
pub(super) struct Window {
    /// Size of the whole image in pixels, and its diagonal in millimetres.
    full: [u32; 2],
    diagonal: f64,
    area: Area,
    /// The warning for cameras with a lens.
    lens: Message,
}

impl Window {
    /// Makes a pinhole camera see only this part of its image. For a camera with a lens, the film becomes a whole one.
    pub(super) fn apply(self, camera: &mut CameraSettings, film: &mut FilmSettings, notes: &mut Notes) {
        let [width, height] = self.full;
        if camera.lens.is_some() {
            (film.width, film.height, film.diagonal) = (width, height, self.diagonal);
            return notes.warn(self.lens);
        }
        let [x0, y0, x1, y1] = self.area.map(f64::from);
        let [kx, ky] = camera.tan_half(width, height);
        let [w, h] = self.full.map(f64::from);
        // towards the middle of the part, which is beside the camera's axis
        let [across, up] = [kx * ((x0 + x1) / w - 1.0), ky * (1.0 - (y0 + y1) / h)];
        let middle = add(camera.forward, add(scaled(camera.right, across), scaled(camera.up, up)));
        let far = length(middle);
        camera.forward = scaled(middle, 1.0 / far);
        let shorter = (kx * (x1 - x0) / w).min(ky * (y1 - y0) / h);
        camera.fov = 2.0 * libm::atan(shorter / far).to_degrees();
    }
}

/// Reads the number of samples per pixel of a `Sampler`.
pub(super) fn samples(kind: &str, params: &mut Params, notes: &mut Notes) -> Result<u32, Message> {
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
        notes.warn(params.error("only the number of samples is used; --sampler chooses the sampler"));
    }
    Ok(samples)
}
