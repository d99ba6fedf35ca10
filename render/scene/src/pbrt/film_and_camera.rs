//! Reads `Camera`, `Film` and `Sampler`.

use super::given::Given;
use super::params::Params;
use crate::message::Notes;
use crate::nearest::did_you_mean;
use crate::transform::{Transform, length, scaled};
use etendue_render::scene::area::{Area, PlaceInImage};
use etendue_render::scene::limits::{MOST_SAMPLES, is_size};
use etendue_render::scene::{CameraSettings, FilmSettings, Lens, Message, Screen};
use std::path::Path;

/// Reads a `Camera`, which looks along +z of camera space, its transform to world space, and the time of exposure, whose unit
/// pbrt does not tell. The transform that holds is that from world space.
pub(super) fn camera(kind: &str, given: &mut Given<'_>) -> Result<(CameraSettings, Transform, f64), Message> {
    match kind {
        "perspective" | "orthographic" => {}
        "realistic" | "spherical" | "environment" => {
            given.stand_in(kind, "becomes a perspective one of 50 degrees");
            given.ignore_all();
            given.set_float("fov", 50.0);
        }
        _ => return Err(given.error("not supported, only \"perspective\", \"orthographic\" and stand-ins for others")),
    }
    let [open, close] = [given.float("shutteropen")?.unwrap_or(0.0), given.float("shutterclose")?.unwrap_or(1.0)];
    // a shutter that does not open is one of pbrt-v3's stills
    let shutter = if close > open && (close - open).is_finite() { close - open } else { 1.0 };
    let frame = given.float("frameaspectratio")?;
    if let Some(frame) = frame {
        given.bound("frameaspectratio", frame, frame > 0.0 && frame.is_finite(), "greater than 0")?;
    }
    // in units of the half of a shorter side
    let window = match given.numbers("screenwindow", "float", 4)?.as_deref() {
        None => frame.map(|frame| [-frame.max(1.0), frame.max(1.0), -(1.0 / frame).max(1.0), (1.0 / frame).max(1.0)]),
        Some(&[left, right, lower, upper]) if left < right && lower < upper => Some([left, right, lower, upper]),
        Some(numbers) => {
            return Err(given.error(format!("\"screenwindow\": {numbers:?} is not x0 x1 y0 y1, ascending")));
        }
    };
    let [radius, focus] = lens(given)?;
    // as in pbrt-v3
    let whole = given.float("halffov")?.filter(|half| *half > 0.0).map(|half| 2.0 * half);
    let fov = whole.or(given.float("fov")?).unwrap_or(90.0);
    given.bound("fov", fov, fov > 0.0 && fov < 180.0, "greater than 0 and less than 180 degrees")?;
    let singular = || given.error("its transform is singular");
    let world = given.ctm.inverse().ok_or_else(singular)?;
    let forward = world.vector([0.0, 0.0, 1.0]);
    let unit = length(forward);
    let axis = |v: [f64; 3]| scaled(world.vector(v), 1.0 / unit);
    let lens = (radius > 0.0).then_some(Lens { radius, focus, unit });
    if let Some(lens) =
        lens.filter(|l| !((l.radius * unit) as f32).is_normal() || !((l.radius / l.focus) as f32).is_normal())
    {
        let Lens { radius, focus, .. } = lens;
        return Err(given.error(format!("a lens of radius {radius:e} focused at {focus:e} is out of the range of f32")));
    }
    let half = match (kind, lens) {
        ("orthographic", None) => unit,
        // pbrt's rays leave from the lens towards the places of the screen in the plane of focus
        ("orthographic", Some(_)) => 1.0 / focus,
        _ => libm::tan(fov.to_radians() / 2.0),
    };
    let camera = CameraSettings {
        origin: world.point([0.0; 3]),
        forward: axis([0.0, 0.0, 1.0]),
        right: axis([1.0, 0.0, 0.0]),
        up: axis([0.0, 1.0, 0.0]),
        is_orthographic: kind == "orthographic" && lens.is_none(),
        screen: window.map_or(Screen::Half(half), |window| Screen::Edges(window.map(|edge| edge * half))),
        lens,
    };
    let edges = camera.edges(1, 1);
    let mut numbers = camera.forward.iter().chain(&camera.right).chain(&camera.up).chain(&edges);
    if !numbers.all(|x| x.is_finite()) {
        return Err(singular());
    }
    Ok((camera, world, shutter))
}

/// Radius of the lens, and distance of what is in focus.
fn lens(params: &mut Params) -> Result<[f64; 2], Message> {
    let radius = params.float("lensradius")?.unwrap_or(0.0);
    let focus = params.float("focaldistance")?.unwrap_or(1e6);
    params.bound("lensradius", radius, radius >= 0.0, "at least 0")?;
    params.bound("focaldistance", focus, focus > 0.0, "greater than 0")?;
    Ok([radius, focus])
}

/// Makes a camera show what its film shows.
pub(super) fn fit(camera: &mut CameraSettings, film: &FilmSettings) {
    let [width, height] = film.place.map_or([film.width, film.height], |place| place.whole);
    // a screen of square pixels around the axis can have any shape
    if let Screen::Edges([left, right, lower, upper]) = camera.screen
        && left + right == 0.0
        && lower + upper == 0.0
        && (right * f64::from(height) / (upper * f64::from(width)) - 1.0).abs() < 1e-6
    {
        camera.screen = Screen::Half(right.min(upper));
    }
    if let Some(PlaceInImage { start: [x, y], .. }) = film.place {
        let [left, right, lower, upper] = camera.edges(width, height);
        let across = |x: u32| left + (right - left) * (f64::from(x) / f64::from(width));
        let down = |y: u32| upper + (lower - upper) * (f64::from(y) / f64::from(height));
        camera.screen = Screen::Edges([across(x), across(x + film.width), down(y + film.height), down(y)]);
    }
}

/// Reads a `Film`.
pub(super) fn film(kind: &str, params: &mut Params) -> Result<FilmSettings, Message> {
    params.require(
        ["rgb", "image", "gbuffer", "spectral"].contains(&kind),
        || "not supported, only \"rgb\", and \"gbuffer\" and \"spectral\" as if they were that",
    )?;
    let width = params.integer("xresolution")?.unwrap_or(1280);
    let height = params.integer("yresolution")?.unwrap_or(720);
    // a negative number is a very large one here
    params.require(is_size(width as u64, height as u64), || {
        format!("{width} × {height} pixels: each side must be 1 to 65536, and the area at most 2^28")
    })?;
    let diagonal = params.float("diagonal")?.unwrap_or(35.0);
    params.require((1e-2..=1e6).contains(&diagonal), || {
        format!("\"diagonal\": must be from 1e-2 to 1e6 mm, not {diagonal:e}")
    })?;
    // a file that is read writes to no other folder; users can
    let name = |text: String| Path::new(&text).file_name().map(|name| name.to_string_lossy().into_owned());
    let filename = params.text("filename")?.and_then(name);
    let iso = params.float("iso")?.unwrap_or(100.0);
    let exposure = params.bound("iso", iso, iso > 0.0 && iso.is_finite(), "greater than 0")? / 100.0;
    let whole = [width as u32, height as u32];
    let Some([x0, y0, x1, y1]) = window(params, whole)?.filter(|area| *area != [0, 0, whole[0], whole[1]]) else {
        return Ok(FilmSettings { width: whole[0], height: whole[1], diagonal, filename, place: None, exposure });
    };
    let [width, height] = [x1 - x0, y1 - y0];
    let part = f64::from(width).hypot(height.into()) / f64::from(whole[0]).hypot(whole[1].into());
    let place = Some(PlaceInImage { start: [x0, y0], whole });
    Ok(FilmSettings { width, height, diagonal: diagonal * part, filename, place, exposure })
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
    params.require(x0 < x1 && y0 < y1, || format!("{name:?}: no pixel of {width} × {height} is in it"))?;
    Ok(Some([x0, y0, x1, y1]))
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
        let nearest = match kind {
            "zsobol" => "z-order",
            "halton" | "sobol" | "paddedsobol" | "pmj02bn" | "02sequence" | "lowdiscrepancy" | "maxmindist" => "sobol",
            "random" => "independent",
            other => {
                let near =
                    did_you_mean(other, ["independent", "stratified", "zsobol", "halton", "sobol", "paddedsobol"]);
                notes.misspelt(params.error(format!("unknown: only its number of samples is used{near}")));
                return Ok(samples);
            }
        };
        notes
            .warn(params.error(format!("only its number of samples is used; the nearest here is --sampler {nearest}")));
    }
    Ok(samples)
}
