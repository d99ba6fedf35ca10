//! Mesh files in all three encodings, and malformed files.

use crate::damaged::damaged;
use crate::kit::{Folder, faults};
use crate::pbrt::text::{LIGHT, normal, read, warnings, world};
use etendue_oracle::tier::cases;
use etendue_render::scene::{Geometry, Parallelogram, Scene};
use etendue_scene::parse;

const POINTS: [[f32; 3]; 5] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 3.0, -1.25]];
const FACES: [&[u32]; 2] = [&[0, 1, 2, 3], &[3, 2, 4]];

fn header(format: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment x\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nelement face {faces}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
}

fn ascii() -> Vec<u8> {
    let mut text = header("ascii", 5, 2);
    for p in POINTS {
        text += &format!("{} {} {} 7\n", p[0], p[1], p[2]);
    }
    for face in FACES {
        let indices: Vec<_> = face.iter().map(u32::to_string).collect();
        text += &format!("{} {}\n", face.len(), indices.join(" "));
    }
    text.into_bytes()
}

fn binary(big: bool) -> Vec<u8> {
    let mut bytes = header(if big { "binary_big_endian" } else { "binary_little_endian" }, 5, 2).into_bytes();
    let word = |bits: u32| if big { bits.to_be_bytes() } else { bits.to_le_bytes() };
    for p in POINTS {
        p.iter().for_each(|x| bytes.extend(word(x.to_bits())));
        bytes.push(7);
    }
    for face in FACES {
        bytes.push(face.len() as u8);
        face.iter().for_each(|&i| bytes.extend(word(i)));
    }
    bytes
}

fn load_mesh(bytes: &[u8], before: &str) -> Result<Scene, String> {
    load_mesh_in(&Folder::new(), bytes, before)
}

fn load_mesh_in(dir: &Folder, bytes: &[u8], before: &str) -> Result<Scene, String> {
    dir.write("m.ply", bytes);
    let text = world(&format!("{before}\nShape \"plymesh\" \"string filename\" \"m.ply\""));
    parse(&text, "a.pbrt", dir.root()).map_err(|error| error.to_string().replace(&dir.root().display().to_string(), ""))
}

#[test]
fn all_encodings_give_the_same_triangles() {
    let p = POINTS;
    let expected = [[p[0], p[1], p[2]], [p[0], p[2], p[3]], [p[3], p[2], p[4]]];
    for bytes in [ascii(), binary(false), binary(true)] {
        let scene = load_mesh(&bytes, "").unwrap();
        assert_eq!(scene.triangles, expected);
        assert_eq!(scene.warnings.len(), 1, "no light: {:?}", warnings(&scene));
        // as a light, the quad is one shape
        let scene = load_mesh(&bytes, LIGHT).unwrap();
        assert!(scene.triangles.is_empty() && scene.warnings.is_empty());
        let quad = Geometry::Parallelogram(Parallelogram { p: p[0], u: [2.0, 0.0, 0.0], v: [0.0, 1.0, 0.0] });
        assert_eq!((scene.shapes.len(), &scene.shapes[0].geometry), (2, &quad));
        assert_eq!(scene.shapes[1].geometry, Geometry::Triangle(expected[2]));
    }
    // Windows line ends, doubles, the other name of the list, an unknown element
    let text = "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\nproperty double z\r\n\
        element edge 1\r\nproperty int a\r\nelement face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n\
        0 0 0\r\n1e0 0 0\r\n0 1 0\r\n5\r\n3 0 1 2\r\n";
    let scene = load_mesh(text.as_bytes(), LIGHT).unwrap();
    assert_eq!(scene.shapes.len(), 1);
    assert_eq!(warnings(&scene).len(), 1);
    assert!(warnings(&scene)[0].contains("element \"edge\" ignored"));
}

/// A negative index is shown as the file has it, and texture coordinates that are no numbers are 0.
#[test]
fn numbers_out_of_range() {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
        property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        .to_vec();
    bytes.extend([0; 12]);
    bytes.push(3);
    bytes.extend([-1_i32; 3].iter().flat_map(|i| i.to_le_bytes()));
    let error = load_mesh(&bytes, "").unwrap_err().to_string();
    assert!(error.contains("face 0: index -1 is out of range: there are 1 vertices"), "{error}");
}

#[test]
fn quads_are_split_only_if_planar_and_convex() {
    let with = |x: &str| String::from_utf8(ascii()).unwrap().replace("2 1 0 7", x).into_bytes();
    let trapezoid = load_mesh(&with("1 1 0 7"), "").unwrap();
    assert_eq!(
        trapezoid.triangles[..2],
        [[POINTS[0], POINTS[1], [1.0, 1.0, 0.0]], [POINTS[0], [1.0, 1.0, 0.0], POINTS[3]]]
    );
    assert_eq!(load_mesh(&with("1 1 0 7"), LIGHT).unwrap().shapes.len(), 3);
    // others are patches, of more triangles the more they are bent
    for (bent, least, smooth) in [("2 1 1 7", 200, true), ("0.1 0.1 0 7", 200, false), ("2 1 0.01 7", 9, true)] {
        let scene = load_mesh(&with(bent), "").unwrap();
        assert!(scene.triangles.len() >= least, "{bent}: {}", scene.triangles.len());
        assert_eq!(scene.details.of_triangles.len(), if smooth { scene.triangles.len() } else { 0 });
    }
}

#[test]
fn malformed_files_name_both_files() {
    let sound = String::from_utf8(ascii()).unwrap();
    let changed = |from: &str, to: &str| {
        assert!(sound.contains(from), "{from}");
        sound.replacen(from, to, 1).into_bytes()
    };
    let cut = binary(false)[..binary(false).len() - 3].to_vec();
    let cut_message = format!("/m.ply: byte {}: the file ends within element \"face\"", cut.len());
    let mut cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "/m.ply:1: the file ends within the header"),
        (b"plyx\n".to_vec(), "/m.ply:1: the header: \"plyx\""),
        (b"ply\nformat ascii 1.0\nelem".to_vec(), "/m.ply:3: the file ends within the header: the line \"end_header\""),
        (b"ply\nformat ascii 1.0\n".to_vec(), "/m.ply:3: the file ends within the header: the line \"end_header\""),
        ([&b"ply\nformat ascii 1.0\nelement vertex 1\xff"[..], b"\n"].concat(), "/m.ply:"),
        (cut, &cut_message),
    ];
    cases.extend(faults(include_str!("faults_of_meshes.txt")).map(|(edit, said)| {
        let (from, to) = edit.split_once(" ->").unwrap();
        let [from, to] = [from, to.trim_start()].map(|text| text.replace("\\n", "\n"));
        (changed(&from, &to), said)
    }));
    for (bytes, part) in cases {
        let message = load_mesh(&bytes, "").unwrap_err();
        assert!(message.starts_with("a.pbrt:3: Shape \"plymesh\": "), "{message}");
        assert!(message.contains(part) && !message.contains(['\n', '{']), "{message}\n{part}");
    }
    let polygon = load_mesh(&changed("3 3 2 4", "5 3 2 4 1 0"), "").unwrap();
    assert!(
        warnings(&polygon).iter().any(|text| text.contains("face 1 has 5 corners: 1 face(s)")),
        "{:?}",
        warnings(&polygon)
    );
    // packed by gzip, whole and cut
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut packer, sound.as_bytes()).unwrap();
    let packed = packer.finish().unwrap();
    assert_eq!(load_mesh(&packed, "").unwrap().triangles, load_mesh(sound.as_bytes(), "").unwrap().triangles);
    let message = load_mesh(&packed[..packed.len() / 2], "").unwrap_err();
    assert!(message.contains("/m.ply") && message.contains("damaged by its gzip compression"), "{message}");
    // normals decide the emitting side in pbrt
    let normals = ["nx", "ny", "nz"].map(|name| format!("property float {name}\n")).concat();
    let normals = sound.replace("property uchar", &format!("{normals}property uchar")).replace(" 7\n", " 0 0 1 7\n");
    let turned = |normals: &str| {
        let scene = load_mesh(normals.as_bytes(), LIGHT).unwrap();
        normal(&scene.shapes[0].geometry)
    };
    assert_eq!(
        [turned(&normals), turned(&normals.replace(" 0 0 1 7\n", " 0 0 -1 7\n"))],
        [[0.0, 0.0, 2.0], [0.0, 0.0, -2.0]]
    );
    let trailing = [ascii(), b"more".to_vec()].concat();
    assert!(warnings(&load_mesh(&trailing, "").unwrap())[0].contains("4 bytes after the last element ignored"));
}

/// Every beginning of a file, and many files with a few bytes changed, give a mesh or an error, in little memory.
#[test]
fn no_file_panics() {
    let dir = Folder::new();
    for sound in [ascii(), binary(false), binary(true)] {
        damaged(&sound, &["0", "7", "-1", " ", "\n", "nan"], cases(1000, 3000), |bytes| {
            drop(load_mesh_in(&dir, bytes, ""))
        });
    }
}

#[test]
fn bent_lights_emit_on_the_side_of_their_order() {
    let sides = |text: &str| {
        let patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 .5]";
        let scene = read(&world(&format!("{text} {LIGHT} {patch}")));
        assert!(scene.shapes.len() > 8, "{}", scene.shapes.len());
        scene.shapes.iter().map(|shape| normal(&shape.geometry)[2].signum()).sum::<f32>() / scene.shapes.len() as f32
    };
    assert_eq!(
        [sides(""), sides("ReverseOrientation"), sides("Scale 1 -1 1"), sides("Scale 1 1 -1")],
        [1.0, -1.0, 1.0, -1.0]
    );
}

#[test]
fn coordinates_that_are_not_finite_become_0() {
    let board = "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\"\n";
    let folder = Folder::new();
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n\
                property float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    folder.write("a.ply", format!("{head}0 0 0 inf 1\n1 0 0 .5 -inf\n0 1 0 .25 .75\n3 0 1 2\n"));
    let text = world(&format!("{board}Shape \"plymesh\" \"string filename\" \"a.ply\""));
    let scene = parse(&text, "a.pbrt", folder.root()).unwrap();
    assert_eq!(scene.details.corners[0].uvs, [[0.0; 2], [0.0; 2], [0.25, 0.75]]);
}
