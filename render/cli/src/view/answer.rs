//! What the page may ask: its files, what there is to show, an image, and to change what is rendered.

use super::draft::{Draft, Way};
use super::http::{Body, Request, Response};
use super::page;
use super::server::CountGuard;
use super::state::{Picture, Shared, State};
use etendue_render::camera::Orbit;
use etendue_render::film::Film;
use etendue_render::scene::CameraSettings;
use etendue_render::scene::area::Area;
use etendue_render::{Sampler, Settings, Technique};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Greatest number of images that are sent at a time. Each may be older than the one that is kept, if its client reads slowly.
const SENT: usize = 4;
/// Pixels of an image that are made into bytes at a time.
const CHUNK: usize = 4096;

/// Answers a request for this path.
pub(crate) fn answer(shared: &Shared, path: &str, request: &Request) -> Response {
    match (path, request.method.as_str()) {
        ("wish", "POST") => match wish(shared, &request.body) {
            Ok(()) => status(shared),
            Err(what) => Response::text(400, &what),
        },
        ("wish", _) => Response::text(405, "a wish is a POST"),
        (_, method) if method != "GET" => Response::text(405, "only wishes are not a GET"),
        ("status", _) => status(shared),
        ("image", _) => image(shared, request),
        ("reference", _) => match &shared.reference {
            Some((_, film)) => sent(shared, film, 1),
            None => Response::text(404, "there is no reference: --reference FILE.exr names one"),
        },
        _ => page::file(path).unwrap_or_else(|| Response::text(404, "there is no such page")),
    }
}

/// The value of this name among those of an option.
fn value<T: FromStr>(option: &str, text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{option}: {text:?} is not one of those that `etendue list` prints"))
}

/// Changes what is rendered: an object with any of `technique`, `sampler`, `crop` ([x0, y0, x1, y1], or null), `paused`, `reload`,
/// `save` and `orbit` ([around, over, distance] as in [`Orbit`], or null).
fn wish(shared: &Shared, body: &[u8]) -> Result<(), String> {
    let wished: Value = serde_json::from_slice(body).map_err(|error| format!("not JSON: {error}"))?;
    let Value::Object(wished) = wished else { return Err("not an object".into()) };
    // one wish after another, so that none is lost and a part is one of the image as it is now
    shared.wish(|next, facts| {
        for (key, of) in &wished {
            let wrong = |what: &str| format!("{key}: {of} is not {what}");
            let text = || of.as_str().ok_or_else(|| wrong("a name"));
            let flag = || of.as_bool().ok_or_else(|| wrong("true or false"));
            match key.as_str() {
                "technique" => next.way.technique = value(key, text()?)?,
                "sampler" => next.way.sampler = value(key, text()?)?,
                "crop" if of.is_null() => next.crop = None,
                "crop" => next.crop = Some(crop(of, facts.size).ok_or_else(|| wrong("a part of the image"))?),
                "paused" => next.paused = flag()?,
                "reload" => next.reload = flag()?,
                "save" => next.save = flag()?,
                "orbit" if of.is_null() => next.orbit = None,
                "orbit" => next.orbit = Some(orbit(of).ok_or_else(|| wrong("a turn of the camera"))?),
                _ => return Err(format!("{key}: there is no such wish")),
            }
        }
        Ok(())
    })
}

/// The tiles that a rectangle [x0, y0, x1, y1] touches; `None` if it is not one of the image's.
fn crop(value: &Value, [width, height]: [u32; 2]) -> Option<Area> {
    let sides = value.as_array()?.iter().map(|side| u32::try_from(side.as_u64()?).ok());
    let [x0, y0, x1, y1] = sides.collect::<Option<Vec<u32>>>()?.try_into().ok()?;
    let outer = |a: u32, b: u32, end: u32| {
        let is_range = a < b && b <= end;
        is_range.then(|| [a / Settings::TILE * Settings::TILE, b.next_multiple_of(Settings::TILE).min(end)])
    };
    let ([x0, x1], [y0, y1]) = (outer(x0, x1, width)?, outer(y0, y1, height)?);
    Some([x0, y0, x1, y1])
}

/// A turn of the camera; `None` if it is none.
fn orbit(value: &Value) -> Option<Orbit> {
    let numbers = value.as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>()?;
    let [around, over, distance] = numbers.try_into().ok()?;
    let is_one = [around, over].iter().all(|angle| angle.abs() <= 1e3) && (1e-3..=1e3).contains(&distance);
    is_one.then_some(Orbit { around, over, distance })
}

/// A camera that looks at a point in this distance, as pbrt's `LookAt` and as the matrix of a glTF node, whose space is that of the scene.
fn placed(camera: &CameraSettings, distance: f64) -> String {
    let unit = |v: [f64; 3]| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
    let [right, up, forward] = [camera.right, camera.up, camera.forward].map(unit);
    let at: [f64; 3] = std::array::from_fn(|k| camera.origin[k] + distance * forward[k]);
    let cross: [f64; 3] = std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        up[i] * forward[j] - up[j] * forward[i]
    });
    // pbrt's space is left-handed, unless a file mirrors it
    let is_mirrored = (0..3).map(|k| right[k] * cross[k]).sum::<f64>() < 0.0;
    let words = |numbers: &[f64]| {
        let rounded = numbers.iter().map(|x| format!("{}", (1e6 * x).round() / 1e6 + 0.0));
        rounded.collect::<Vec<_>>()
    };
    let mirror = if is_mirrored { "Scale -1 1 1 " } else { "" };
    let look = [camera.origin, at, up].map(|v| words(&v).join(" ")).join("  ");
    let back = forward.map(|x| -x);
    let columns = [(right, 0.0), (up, 0.0), (back, 0.0), (camera.origin, 1.0)];
    let matrix: Vec<String> = columns.iter().flat_map(|([x, y, z], w)| words(&[*x, *y, *z, *w])).collect();
    format!("{mirror}LookAt {look}\n\"matrix\": [{}]", matrix.join(", "))
}

/// All that the page shows besides the pixels.
fn status(shared: &Shared) -> Response {
    let (done, of) = (shared.done.load(Ordering::Relaxed), shared.of.load(Ordering::Relaxed));
    // files may be on a slow disk, for which nobody else has to wait
    let watch = Arc::clone(&shared.lock().watch);
    let changed = watch.changed().map(|path| path.display().to_string());
    let way = |way: &Way| json!({ "technique": way.technique.name(), "sampler": way.sampler.name() });
    let draft = |draft: &Draft| json!({ "way": way(&draft.way), "version": draft.version, "coarse": draft.is_coarse });
    let draft = shared.draft().as_ref().map(draft);
    let State { wishes, facts, pictures, message, .. } = &*shared.lock();
    let picture = |picture: &Picture| {
        json!({
            "way": way(&picture.way),
            "chosen": picture.chosen.name(),
            "version": picture.version,
            "spp": picture.spp,
            "error": picture.error.map(|claim| claim.total()),
            "systematic": picture.error.map(|claim| claim.systematic),
            "uncertain": picture.error.and_then(|claim| claim.uncertain()),
            "seconds": picture.seconds,
            "history": picture.history,
            "end": picture.end,
        })
    };
    let object = json!({
        "scene": facts.scene,
        "size": facts.size,
        "exposure": facts.exposure,
        "sensor": facts.sensor,
        "target": facts.target,
        "files": facts.files,
        "copy": facts.copy,
        "reference": shared.reference.as_ref().map(|(name, _)| name),
        "camera": facts.camera.as_ref().map(|(camera, depth)| {
            let turned = wishes.orbit.map(|orbit| camera.orbited(*depth, orbit));
            placed(turned.as_ref().unwrap_or(camera), *depth * wishes.orbit.map_or(1.0, |orbit| orbit.distance))
        }),
        "orbit": wishes.orbit.map(|orbit| [orbit.around, orbit.over, orbit.distance]),
        "techniques": Technique::NAMES,
        "samplers": Sampler::NAMES,
        "way": way(&wishes.way),
        "crop": wishes.crop,
        "paused": wishes.paused,
        "pictures": pictures.iter().map(picture).collect::<Vec<_>>(),
        "draft": draft,
        "pass": if of == 0 { 0.0 } else { done as f64 / of as f64 },
        "changed": changed,
        "message": message,
    });
    Response::new(200, "application/json", object.to_string().into_bytes())
}

/// The pixels of an image, which are fewer while it is coarse: width, height and version (u32 each, and 0), the radiance of each pixel (three f32), the variance of each (three
/// f32), and the number of its samples (u32), all little-endian.
fn image(shared: &Shared, request: &Request) -> Response {
    let asked = |key: &str| {
        let found = request.query.iter().find(|pair| pair.0 == key);
        found.map(|pair| pair.1.as_str()).ok_or_else(|| format!("{key}: it is missing"))
    };
    let way = || -> Result<Way, String> {
        let (technique, sampler) = (asked("technique")?, asked("sampler")?);
        Ok(Way { technique: value("technique", technique)?, sampler: value("sampler", sampler)? })
    };
    let way = match way() {
        Ok(way) => way,
        Err(what) => return Response::text(400, &what),
    };
    let draft = shared.draft().as_mut().filter(|draft| draft.way == way).map(Draft::sent);
    let found = match draft {
        Some((film, version)) => Some((Arc::new(film), version)),
        None => shared.lock().picture(way).map(|picture| (Arc::clone(&picture.film), picture.version)),
    };
    found.map_or_else(|| Response::text(404, "there is no such image"), |(film, version)| sent(shared, &film, version))
}

/// An image, unless too many are being sent.
fn sent(shared: &Shared, film: &Arc<Film>, version: u64) -> Response {
    let (place, film) = (CountGuard::new(&shared.sending), Arc::clone(film));
    if place.number > SENT {
        return Response::text(503, "too many images are being sent");
    }
    let length = 16 + 28 * film.pixels.len();
    let send = move |out: &mut dyn Write| {
        let _place = place;
        send(out, &film, version)
    };
    Response { status: 200, kind: "application/octet-stream", body: Body::Stream(length, Box::new(send)) }
}

fn send(out: &mut dyn Write, film: &Film, version: u64) -> io::Result<()> {
    let head = [film.width, film.height, version as u32, 0].map(u32::to_le_bytes);
    out.write_all(head.as_flattened())?;
    let mut bytes = Vec::with_capacity(12 * CHUNK);
    for part in 0..3 {
        for pixels in film.pixels.chunks(CHUNK) {
            bytes.clear();
            for pixel in pixels {
                match part {
                    0 => bytes.extend_from_slice(pixel.mean.map(f32::to_le_bytes).as_flattened()),
                    1 => bytes.extend_from_slice(pixel.variance.map(f32::to_le_bytes).as_flattened()),
                    _ => bytes.extend_from_slice(&pixel.samples.to_le_bytes()),
                }
            }
            out.write_all(&bytes)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: above and in front, looking down at 45°; pbrt's x is to the right where y is up and the camera looks along +z.
    #[test]
    fn a_camera_is_written_as_files_place_it() {
        let half = 0.5_f64.sqrt();
        let mut camera = CameraSettings {
            origin: [1.0, 2.0, -2.0],
            forward: [0.0, -half, half],
            right: [3.0, 0.0, 0.0],
            up: [0.0, half, half],
            is_orthographic: false,
            screen: etendue_render::scene::Screen::Half(1.0),
            lens: None,
        };
        let text = placed(&camera, 8.0_f64.sqrt());
        let look = "LookAt 1 2 -2  1 0 0  0 0.707107 0.707107";
        let matrix = "[1, 0, 0, 0, 0, 0.707107, 0.707107, 0, 0, 0.707107, -0.707107, 0, 1, 2, -2, 1]";
        assert_eq!(text, format!("{look}\n\"matrix\": {matrix}"));
        camera.right = [-1.0, 0.0, 0.0];
        assert!(placed(&camera, 1.0).starts_with("Scale -1 1 1 LookAt 1 2 -2 "), "{}", placed(&camera, 1.0));
    }

    #[test]
    fn a_crop_consists_of_tiles() {
        let of = |value: Value| crop(&value, [100, 40]);
        assert_eq!(of(json!([0, 0, 100, 40])), Some([0, 0, 100, 40]));
        assert_eq!(of(json!([17, 15, 18, 17])), Some([16, 0, 32, 32]));
        assert_eq!(of(json!([99, 39, 100, 40])), Some([96, 32, 100, 40]));
        for wrong in [
            json!([0, 0, 0, 40]),
            json!([0, 0, 101, 40]),
            json!([50, 0, 10, 40]),
            json!([0, 0, 1]),
            json!([-1, 0, 10, 10]),
            json!([0.5, 0, 10, 10]),
            json!([0, 0, 4_294_967_297_u64, 4]),
            json!("all"),
        ] {
            assert_eq!(of(wrong.clone()), None, "{wrong}");
        }
    }
}
