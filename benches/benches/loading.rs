//! How fast meshes are read: million triangles per second, on one thread, of files of some 8 million triangles in the system's folder for
//! temporary files, which the first of the five runs leaves in memory.
//!
//! `cargo bench -p etendue-benches --bench loading -- [SIDE]` reads grids of SIDE × SIDE vertices (2,000).

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A grid of bumps.
struct Grid {
    side: u32,
}

impl Grid {
    /// Points, and normals that are not those of the triangles.
    fn vertices(&self) -> impl Iterator<Item = [[f32; 3]; 2]> {
        let side = self.side;
        let height = |i: u32, j: u32| ((i * 7 + j * 13) % 11) as f32 * 0.01;
        let vertex = move |i: u32, j: u32| [[i as f32, j as f32, height(i, j)], [height(j, i), height(i, j), 1.0]];
        (0..side).flat_map(move |i| (0..side).map(move |j| vertex(i, j)))
    }
    fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let side = self.side;
        let cells = (0..side - 1).flat_map(move |i| (0..side - 1).map(move |j| i * side + j));
        cells.flat_map(move |at| [[at, at + side, at + side + 1], [at, at + side + 1, at + 1]])
    }
    fn vertex_bytes(&self, with_normals: bool) -> Vec<u8> {
        let numbers =
            self.vertices().flat_map(|[p, n]| p.into_iter().chain(n.into_iter().filter(move |_| with_normals)));
        numbers.flat_map(f32::to_le_bytes).collect()
    }
    fn count(&self) -> usize {
        2 * (self.side as usize - 1).pow(2)
    }
    /// A binary PLY file.
    fn ply(&self, with_normals: bool) -> Vec<u8> {
        let names = if with_normals { "x y z nx ny nz" } else { "x y z" };
        let properties: String = names.split(' ').map(|name| format!("property float {name}\n")).collect();
        let (vertices, faces) = (self.side * self.side, self.count());
        let header = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n{properties}element face {faces}\n\
             property list uchar int vertex_indices\nend_header\n"
        );
        let mut file = header.into_bytes();
        file.extend(self.vertex_bytes(with_normals));
        for triangle in self.triangles() {
            file.push(3);
            file.extend(triangle.into_iter().flat_map(u32::to_le_bytes));
        }
        file
    }
    /// A binary glTF file.
    fn glb(&self, with_normals: bool) -> Vec<u8> {
        let indices: Vec<u8> = self.triangles().flatten().flat_map(u32::to_le_bytes).collect();
        let vertices = self.vertex_bytes(with_normals);
        let (all, most) = (vertices.len() + indices.len(), self.side - 1);
        let (count, stride) = (self.side * self.side, if with_normals { 24 } else { 12 });
        let of = |offset: u32| {
            serde_json::json!({"bufferView": 0, "byteOffset": offset, "componentType": 5126,
            "count": count, "type": "VEC3", "min": [0, 0, 0], "max": [most, most, 1]})
        };
        let mut accessors = vec![
            serde_json::json!({"bufferView": 1, "componentType": 5125, "count": 3 * self.count(), "type": "SCALAR"}),
            of(0),
        ];
        let mut attributes = serde_json::json!({"POSITION": 1});
        if with_normals {
            accessors.push(of(12));
            attributes["NORMAL"] = 2.into();
        }
        let json = serde_json::json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": attributes, "indices": 0}]}], "accessors": accessors,
            "buffers": [{"byteLength": all}],
            "bufferViews": [
                {"buffer": 0, "byteLength": vertices.len(), "byteStride": stride},
                {"buffer": 0, "byteOffset": vertices.len(), "byteLength": indices.len()},
            ],
        });
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut file = b"glTF\x02\0\0\0".to_vec();
        let chunk = |kind: &[u8; 4], size: usize| [&(size as u32).to_le_bytes()[..], kind].concat();
        file.extend((28 + json.len() as u32 + all as u32).to_le_bytes());
        file.extend(chunk(b"JSON", json.len()));
        file.extend(json);
        file.extend(chunk(b"BIN\0", all));
        file.extend([vertices, indices].concat());
        file
    }
}

fn write(path: &Path, bytes: &[u8]) {
    let mut file = fs::File::create(path).expect("a folder for temporary files");
    file.write_all(bytes).expect("room for temporary files");
}

fn main() {
    let side = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(2000_u32).max(2);
    let grid = Grid { side };
    let folder = std::env::temp_dir().join(format!("etendue-loading-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder for temporary files");
    println!("| file | triangles | MB | seconds | million triangles per second |");
    println!("|---|---|---|---|---|");
    for with_normals in [false, true] {
        let row = |kind: &str, path: &Path, bytes: usize| {
            let read = || {
                let start = Instant::now();
                let scene = etendue_scene::load(path).expect("a valid file");
                assert_eq!(scene.triangles.len(), grid.count());
                start.elapsed().as_secs_f64()
            };
            let mut seconds: [f64; 5] = std::array::from_fn(|_| read());
            seconds.sort_by(f64::total_cmp);
            let normals = if with_normals { ", with normals" } else { "" };
            let (triangles, megabytes) = (grid.count(), bytes as f64 / 1e6);
            let rate = triangles as f64 / seconds[2] / 1e6;
            println!("| {kind}{normals} | {triangles} | {megabytes:.0} | {:.3} | {rate:.1} |", seconds[2]);
        };
        let file = |name: &str| -> PathBuf { folder.join(name) };
        let mesh = grid.ply(with_normals);
        write(&file("mesh.ply"), &mesh);
        write(
            &file("ply.pbrt"),
            b"Camera \"perspective\" WorldBegin Shape \"plymesh\" \"string filename\" \"mesh.ply\"",
        );
        row("PLY", &file("ply.pbrt"), mesh.len());
        let mesh = grid.glb(with_normals);
        write(&file("mesh.glb"), &mesh);
        row("glTF", &file("mesh.glb"), mesh.len());
    }
    let _ = fs::remove_dir_all(&folder);
}
