//! What the parameters of scene files mean: scenes whose only pixel has one right value, which is written by hand from pbrt-v4's file format
//! and glTF's specifications, in double precision, and shares no code with the renderer.

mod cameras;
mod deltas;
mod emitters;
mod gltf;
mod place;
mod row;
mod skies;

use exr::prelude::{
    Encoding, Image, ImageAttributes, IntegerBounds, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};
use rayon::prelude::*;
use row::Row;
use std::fs;
use std::path::Path;

/// Writes grey texels, row by row from the top.
fn write_pfm(path: &Path, [width, height]: [usize; 2], texels: &[f32]) {
    let mut bytes = format!("Pf\n{width} {height}\n-1\n").into_bytes();
    // the lowest row is the first
    bytes.extend(texels.chunks(width).rev().flatten().flat_map(|x| x.to_le_bytes()));
    fs::write(path, bytes).unwrap();
}

/// The files that scenes name.
fn write_files(folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    let write = |name: &str, size: [usize; 2], texels: &[f32]| write_pfm(&folder.join(name), size, texels);
    write("one.pfm", [1, 1], &[1.0]);
    write("quarters.pfm", [2, 2], &[1.0, 2.0, 3.0, 4.0]);
    write("wide.pfm", [2, 1], &[1.0, 2.0]);
    write("tall.pfm", [1, 2], &[1.0, 2.0]);
    write("longitudes.pfm", [4, 2], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    for (name, size) in
        [("1x3.pfm", [1, 3]), ("3x3.pfm", [3, 3]), ("7x7.pfm", [7, 7]), ("6x2.pfm", [6, 2]), ("4x3.pfm", [4, 3])]
    {
        let texels: Vec<f32> = (0..size[0] * size[1]).map(|k| 1.0 / (1 + k % size[0] + k / size[0]) as f32).collect();
        write(name, size, &texels);
    }
    // 90 cd at the nadir, 0 from 60 degrees on; and the same everywhere below
    let head = "IESNA:LM-63-2019\nTILT=NONE\n1 -1 3 2 1 1 2 0 0 0\n1 1 9\n";
    fs::write(folder.join("cone.ies"), format!("{head}0 60\n0\n30 0\n")).unwrap();
    fs::write(folder.join("below.ies"), format!("{head}0 90\n0\n3 3\n")).unwrap();
    let quad = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                -1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n";
    fs::write(folder.join("quad.ply"), quad).unwrap();
    let attributes = LayerAttributes { layer_position: Vec2(2, 1), ..LayerAttributes::default() };
    let texel = SpecificChannels::rgb(|_| (1.0_f32, 2.0_f32, 4.0_f32));
    let layer = Layer::new((1, 1), attributes, Encoding::UNCOMPRESSED, texel);
    let display = IntegerBounds { position: Vec2(0, 0), size: Vec2(4, 4) };
    Image::new(ImageAttributes::new(display), layer).write().to_file(folder.join("window.exr")).unwrap();
}

#[test]
fn values_of_parameters() {
    let folder = std::env::temp_dir().join(format!("etendue-values-{}", std::process::id()));
    write_files(&folder);
    let tables = [deltas::rows(), skies::rows(), emitters::rows(), gltf::rows(), cameras::rows()];
    let rows: Vec<Row> = tables.into_iter().flatten().collect();
    let seen: Vec<Result<String, String>> = rows.par_iter().map(|row| row.check(&folder)).collect();
    fs::remove_dir_all(&folder).unwrap();
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
