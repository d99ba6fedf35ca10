//! Images and their parts: any bytes, and files that are whole but say anything.

use etendue_render::Identity;
use etendue_render::drive::parts::{Piece, PieceFile, encode};
use etendue_render::film::files::FileError;
use etendue_render::film::image::Compression;
use etendue_render::film::image::layer::{self, Layer, Numbers};
use etendue_render::scene::area::count;
use serde_json::{Value, json};
use std::io::Cursor;
use std::path::Path;

fn read(bytes: &[u8]) -> Result<(Identity, Piece), FileError> {
    let mut part = PieceFile::new(Path::new("fuzz.exr"), Cursor::new(bytes), bytes.len() as u64)?;
    let piece = part.read()?;
    Ok((part.header.identity, piece))
}

/// Any bytes give the part of an image, or an error with the file's name, but never a panic; and the part is read as it is written. So do
/// files with right checksums whose texts and planes are made of the bytes.
pub fn part(bytes: &[u8]) {
    check(bytes);
    if let Some(made) = make(&mut bytes.iter().copied()) {
        check(&made);
    }
}

fn check(bytes: &[u8]) {
    match read(bytes) {
        Ok((identity, piece)) => {
            let encode = |identity: &Identity, piece| encode(identity, piece, Compression::RLE);
            let written = encode(&identity, piece).unwrap_or_else(|error| panic!("not written again: {error}"));
            let (same, again) = read(&written).unwrap_or_else(|error| panic!("not read again: {error}"));
            // NaN differs from itself, but not its bits
            assert!(same == identity && encode(&same, again) == Ok(written), "not the same again");
        }
        Err(error) => assert!(error.to_string().starts_with("fuzz.exr: "), "{error}"),
    }
}

/// A file of one layer that could be a part.
fn make(bytes: &mut impl Iterator<Item = u8>) -> Option<Vec<u8>> {
    let mut next = || bytes.next().map(u32::from);
    let choose = |from: &[Value], at: u32| from[at as usize % from.len()].clone();
    let sides = [16, 32, 20, 1].map(Value::from);
    let mut identity = json!({
        "scene": "fuzz", "digest": "0", "width": choose(&sides, next()?), "height": choose(&sides, next()?),
        "spp": 1 + next()?, "technique": "auto", "choice": "auto", "depth": 8,
        "sampler": choose(&["sobol", "independent", "adaptive", "stratified"].map(Value::from), next()?),
        "sets": choose(&[0, 1, 2, 4].map(Value::from), next()?), "seed": 0, "sensor": "radiance",
        "exposure": "1.0", "averaged": [], "build": "fuzz", "place": null,
    });
    let [width, height] = ["width", "height"].map(|key| identity[key].as_u64().unwrap_or(1) as u32);
    let lights = next()? % 12;
    let kind = choose(&[json!("pixels"), json!({ "pilot": lights }), json!({ "counts": lights })], next()?);
    // now and then, something else is in its place
    let key = next()? as usize;
    let odd = choose(&[json!(null), json!(-1), json!(u64::MAX), json!("x"), json!([]), json!(0)], next()?);
    if let Some(value) = identity.as_object_mut()?.values_mut().nth(key) {
        *value = odd;
    }
    let corner = |at: u32, side: u32| (at % 3 * 16).min(side.saturating_sub(1));
    let [x0, y0] = [corner(next()?, width), corner(next()?, height)];
    let area = [x0, y0, width.max(x0 + 1), height.max(y0 + 1)];
    let (mut names, halves) = (vec!["samples.N".to_owned(), "packets".to_owned()], ["high", "low"]);
    for set in 0..4 {
        names.extend(["R", "G", "B"].iter().flat_map(|c| halves.map(|half| format!("sum.set{set}.{c}.{half}"))));
    }
    names.extend(halves.map(|half| format!("variance.{half}")));
    names.extend((0..12).flat_map(|k| ["pairs", "taken"].map(|name| format!("{name}.{k}"))));
    let floats = ["R", "G", "B"].into_iter().flat_map(|c| [c.to_owned(), format!("variance.{c}")]);
    let floats = floats.chain((0..12).flat_map(|k| ["spread", "weight"].map(|name| format!("{name}.{k}"))));
    let floats = floats.chain(["squares".to_owned()]);
    let (dropped, value) = (next()? as usize * 3, next()? | next()? << 8 | next()? << 16 | next()? << 24);
    let n = count(area);
    let integers = names.into_iter().map(|name| (name, Numbers::U32(vec![value; n])));
    let floats = floats.map(|name| (name, Numbers::F32(vec![f32::from_bits(value); n])));
    let mut planes: Vec<_> = integers.chain(floats).collect();
    if dropped < planes.len() {
        planes.remove(dropped);
    }
    let text = json!({ "identity": identity, "kind": kind });
    layer::encode([width, height], text, Layer { area, planes }, Compression::RLE).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_oracle::tier::cases;

    /// Some of the files that are made are parts: the others are refused for what they say, not because they are damaged.
    #[test]
    fn some_files_that_are_made_are_parts() {
        let (mut state, mut parts, mut kinds) = (1_u64, 0, std::collections::BTreeSet::new());
        for _ in 0..cases(1_200, 3_000) {
            let bytes: Vec<u8> = (0..24)
                .map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    (state >> 33) as u8
                })
                .collect();
            part(&bytes);
            let made = make(&mut bytes.iter().copied()).map(|made| read(&made));
            if let Some(Ok((_, piece))) = made {
                parts += 1;
                kinds.insert(format!("{:?}", piece.kind()).split('(').next().map(str::to_owned));
            }
        }
        assert!(parts > cases(30, 75) && kinds.len() == 3, "{parts} parts of {} kinds", kinds.len());
    }
}
