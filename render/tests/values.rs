//! What the parameters of scene files mean: scenes whose only pixel has one right value, which is written by hand from pbrt-v4's file format
//! and glTF's specifications, in double precision, and shares no code with the renderer.

mod cameras;
mod deltas;
mod emitters;
mod gltf;
mod place;
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

#[test]
fn values_of_parameters() {
    let folder = Folder::new();
    write_files(&folder);
    let tables = [deltas::rows(), skies::rows(), emitters::rows(), gltf::rows(), cameras::rows()];
    let rows: Vec<Row> = tables.into_iter().flatten().collect();
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
