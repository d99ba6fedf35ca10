//! What the parameters of scene files mean: scenes whose only pixel has one right value, which is written by hand from pbrt-v4's file format
//! and glTF's specifications, in double precision, and shares no code with the renderer.

mod cameras;
mod coats;
mod deltas;
mod emitters;
mod gltf;
mod meanings;
mod place;
mod relief;
mod row;
mod skies;

use crate::kit::Folder;
use exr::prelude::{
    Encoding, Image, ImageAttributes, IntegerBounds, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};
use rayon::prelude::*;
use row::Row;

/// The files that scenes name.
fn write_files(folder: &Folder) {
    // grey texels, row by row from the top
    let write = |name: &str, size: [usize; 2], texels: &[f32]| {
        folder.picture(name, size, |x, y| [texels[y * size[0] + x]; 3]);
    };
    write("one.exr", [1, 1], &[1.0]);
    write("quarters.exr", [2, 2], &[1.0, 2.0, 3.0, 4.0]);
    write("longitudes.exr", [4, 2], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    for size in [[1, 3], [3, 3], [7, 7], [6, 2], [4, 3]] {
        let texels: Vec<f32> = (0..size[0] * size[1]).map(|k| 1.0 / (1 + k % size[0] + k / size[0]) as f32).collect();
        write(&format!("{}x{}.exr", size[0], size[1]), size, &texels);
    }
    // 90 cd at the nadir, 0 from 60 degrees on; and the same everywhere below
    folder.ies("cone.ies", "0 60", "0", "90 0");
    folder.ies("below.ies", "0 90", "0", "9 9");
    folder.write("relief.png", relief::png());
    write_kinds(folder);
    let quad = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                -1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n";
    folder.write("quad.ply", quad);
    let attributes = LayerAttributes { layer_position: Vec2(2, 1), ..LayerAttributes::default() };
    let texel = SpecificChannels::rgb(|_| (1.0_f32, 2.0_f32, 4.0_f32));
    let layer = Layer::new((1, 1), attributes, Encoding::UNCOMPRESSED, texel);
    let display = IntegerBounds { position: Vec2(0, 0), size: Vec2(4, 4) };
    Image::new(ImageAttributes::new(display), layer).write().to_file(folder.path("window.exr")).unwrap();
}

/// IES files that say the same, 100 cd downwards, in other ways, with all horizontal angles alike.
const IES_KINDS: [&str; 9] = ["lf", "cr", "crlf", "mark", "lower", "spaces", "include", "header", "commas"];
/// PLY files of the same square, with rows that share lines.
const PLY_KINDS: [&str; 4] = ["rows", "one-line", "blank-lines", "words"];

/// Files that other programs write.
fn write_kinds(folder: &Folder) {
    let table = "1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n100 0\n";
    let late = "1 -1 1 2 1 1 2 0 0 0\n1 .5 9\n0 90\n0\n100 0\n";
    let of = |tilt: &str, table: &str| format!("IESNA:LM-63-1995\n[TEST] 1\n{tilt}\n{table}");
    let texts = [
        of("TILT=NONE", table),
        of("TILT=NONE", table).replace('\n', "\r"),
        of("TILT=NONE", table).replace('\n', "\r\n"),
        format!("\u{feff}TILT=NONE\n{table}"),
        of("tilt=none", table),
        of(" TILT = None ", table),
        of("TILT=Include\n1\n2\n0 90\n1 .5", table),
        // of 2002, the third factor is no longer one
        format!("iesna:lm-63-2002\nTILT=NONE\n{late}"),
        of("TILT=NONE", &table.replace(' ', ",")),
    ];
    for (name, text) in IES_KINDS.iter().zip(texts) {
        folder.write(&format!("{name}.ies"), text);
    }
    let angles = "-90 -30 0 60 90";
    let (by_v, by_h) = ([10.0, 40.0, 100.0, 30.0, 5.0], [2.0, 5.0, 9.0, 7.0, 1.0]);
    let column = |h: f64| by_v.map(|v| (v * h / 9.0).to_string()).join(" ");
    let values = by_h.map(column).join("\n");
    for (name, kind) in [("type-a.ies", 3), ("type-b.ies", 2)] {
        folder.write(name, format!("TILT=NONE\n1 -1 1 5 5 {kind} 2 0 0 0\n1 1 9\n{angles}\n{angles}\n{values}\n"));
    }
    folder.write("half-b.ies", "TILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 9\n0 90\n0 90\n90 0 0 0\n");
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    let bodies = [
        "-1 -1 0  1 -1 0\n1 1 0  -1 1 0\n3 0 1 2  3 0 2 3\n",
        "-1 -1 0 1 -1 0 1 1 0 -1 1 0 3 0 1 2 3 0 2 3",
        "\n-1 -1 0\n\n1 -1 0\n1 1 0\n-1 1 0\n\n3 0 1 2\n3 0 2 3\n",
        "-1\n-1\n0\n1 -1 0\n1\n1 0\n-1 1 0\n3\n0 1 2\n3 0 2 3\n",
    ];
    for (name, body) in PLY_KINDS.iter().zip(bodies) {
        folder.write(&format!("{name}.ply"), format!("{head}{body}"));
    }
    let pixel = [128, 64, 32, 129];
    let hdr = [&b"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"[..], &pixel, &pixel].concat();
    folder.write("rgbe.hdr", hdr);
    for (file, channel) in [("grey.exr", "Y"), ("height.exr", "height")] {
        let pixels = SpecificChannels::build().with_channel(channel).with_pixel_fn(|_| (0.3_f32,));
        Image::from_channels((2, 2), pixels).write().to_file(folder.path(file)).unwrap();
    }
}

fn all_rows() -> Vec<Row> {
    let tables = [
        deltas::rows(),
        skies::rows(),
        emitters::rows(),
        gltf::rows(),
        relief::rows(),
        cameras::rows(),
        meanings::rows(),
        coats::rows(),
    ];
    tables.into_iter().flatten().collect()
}

#[test]
fn values_of_parameters() {
    let folder = Folder::new();
    write_files(&folder);
    let rows = all_rows();
    let seen: Vec<Result<String, String>> = rows.par_iter().map(|row| row.check(&folder.path(""))).collect();
    // with `--nocapture`, the table
    seen.iter().flatten().for_each(|line| println!("{line}"));
    let wrong: Vec<&String> = seen.iter().filter_map(|line| line.as_ref().err()).collect();
    let by_choice = rows.iter().filter(|row| row.differs.is_some()).count();
    println!("{} rows, of which {by_choice} differ by choice, and {} are wrong", rows.len(), wrong.len());
    assert!(
        wrong.is_empty(),
        "{} of {} rows are wrong:\n{}",
        wrong.len(),
        rows.len(),
        wrong.iter().map(|line| line.as_str()).collect::<Vec<_>>().join("\n")
    );
}
