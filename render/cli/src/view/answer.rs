//! What the page may ask: its files, what there is to show, an image, and to change what is rendered.

use super::http::{Body, Request, Response};
use super::page;
use super::server::CountGuard;
use super::state::{Picture, Shared, State, Way};
use etendue_render::camera::Orbit;
use etendue_render::film::Film;
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

/// All that the page shows besides the pixels.
fn status(shared: &Shared) -> Response {
    let (done, of) = (shared.done.load(Ordering::Relaxed), shared.of.load(Ordering::Relaxed));
    // files may be on a slow disk, for which nobody else has to wait
    let watch = Arc::clone(&shared.lock().watch);
    let changed = watch.changed().map(|path| path.display().to_string());
    let State { wishes, facts, pictures, message, .. } = &*shared.lock();
    let way = |way: &Way| json!({ "technique": way.technique.name(), "sampler": way.sampler.name() });
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
        "orbit": wishes.orbit.map(|orbit| [orbit.around, orbit.over, orbit.distance]),
        "techniques": Technique::NAMES,
        "samplers": Sampler::NAMES,
        "way": way(&wishes.way),
        "crop": wishes.crop,
        "paused": wishes.paused,
        "pictures": pictures.iter().map(picture).collect::<Vec<_>>(),
        "pass": if of == 0 { 0.0 } else { done as f64 / of as f64 },
        "changed": changed,
        "message": message,
    });
    Response::new(200, "application/json", object.to_string().into_bytes())
}

/// The pixels of an image: width, height and version (u32 each, and 0), the radiance of each pixel (three f32), the variance of each (three
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
    let place = CountGuard::new(&shared.sending);
    if place.number > SENT {
        return Response::text(503, "too many images are being sent");
    }
    let (film, version) = match shared.lock().picture(way) {
        Some(picture) => (Arc::clone(&picture.film), picture.version),
        None => return Response::text(404, "there is no such image"),
    };
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
