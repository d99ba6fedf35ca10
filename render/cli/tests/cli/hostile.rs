//! Small files that ask for much, and systems that give little: an error at once, and no file of somebody else replaced.

use super::Folder;
use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

const BEGIN: &str = "LookAt 0 4 6  0 0 0  0 1 0 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8";

const TRIANGLE: &str =
    "AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"trianglemesh\" \"point3 P\" [-9 0 9 9 0 9 0 0 -9]";

/// A scene that ends with a triangle with this texture.
fn textured(textures: &str, last: usize) -> String {
    let first = "Texture \"t0\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.8 .8 .8] \"rgb tex2\" [.2 .2 .2]\n";
    format!(
        "{BEGIN}\nWorldBegin\n{first}{textures}Material \"diffuse\" \"texture reflectance\" \"t{last}\"\n\
         {TRIANGLE}\n"
    )
}

#[test]
fn textures_of_too_many_textures_are_refused() {
    let folder = Folder::new();
    let refused = |name: &str, texture: &dyn Fn(usize) -> String, count: usize| {
        let textures: String = (1..=count).map(texture).collect();
        folder.write(name, textured(&textures, count));
        folder.fail(&["render", name, "--spp", "2", "-o", "a.exr"])
    };
    // each names the one before twice: 2^40 in all
    let double = |kind: &'static str| {
        move |i: usize| {
            let t = i - 1;
            format!("Texture \"t{i}\" \"spectrum\" \"{kind}\" \"texture tex1\" \"t{t}\" \"texture tex2\" \"t{t}\"\n")
        }
    };
    // the first has three parts, and stands in line 3; each has those of the one before twice, itself, and a mix has an amount
    for (kind, first) in [("mix", 10), ("checkerboard", 11)] {
        let error = refused("double.pbrt", &double(kind), 40);
        let place = format!("double.pbrt:{}: Texture \"t{first}\": ", first + 3);
        assert!(error.contains(&place) && error.contains("more than 4096"), "{error}");
    }
    let scale = |i: usize| {
        format!("Texture \"t{i}\" \"spectrum\" \"scale\" \"texture tex\" \"t{}\" \"float scale\" 0.999\n", i - 1)
    };
    let error = refused("chain.pbrt", &scale, 12_000);
    assert!(error.contains("chain.pbrt:") && error.contains("4096"), "{error}");
    let few: String = (1..=1000).map(scale).collect();
    folder.write("few.pbrt", textured(&few, 1000));
    folder.succeed(&["render", "few.pbrt", "--spp", "2", "-o", "few.exr"]);
}

#[test]
fn copies_without_data_are_refused() {
    let folder = Folder::new();
    let scene = |count: u32| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "nodes": [{{"mesh": 0, "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{"TRANSLATION": 1}}}}}}}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"count": 3, "type": "VEC3", "componentType": 5126}},
                {{"count": {count}, "type": "VEC3", "componentType": 5126}}]}}"#
        )
    };
    folder.write("many.gltf", scene(4_194_304));
    let error = folder.fail(&["render", "many.gltf", "--size", "8x8", "--spp", "2"]);
    assert!(error.contains("many.gltf") && error.contains("node 0") && error.contains("1024 copies"), "{error}");
}

/// The distance of 20 MB from every known name would take as many seconds.
#[test]
fn a_word_of_megabytes_is_an_error_at_once() {
    let folder = Folder::new();
    let start = Instant::now();
    folder.write("long.pbrt", format!("{BEGIN}\nWorldBegin\n{}\n", "a".repeat(20_000_000)));
    let error = folder.fail(&["render", "long.pbrt"]);
    assert!(error.contains("long.pbrt:3") && error.len() < 1000, "{error}");
    assert!(start.elapsed() < Duration::from_secs(6), "{:?}", start.elapsed());
}

/// The film of a file that somebody else wrote names no other folder.
#[test]
fn a_film_writes_into_this_folder_alone() {
    let folder = Folder::new();
    fs::create_dir(folder.path("in")).unwrap();
    for (i, name) in ["../victim.txt", "/nowhere/victim.exr", "in/victim.png"].iter().enumerate() {
        let file = format!("{i}.pbrt");
        let film = BEGIN.replace("\"rgb\"", &format!("\"rgb\" \"string filename\" {name:?}"));
        folder.write(&file, format!("{film}\nWorldBegin\n{TRIANGLE}\n"));
        folder.succeed(&["render", &file, "--spp", "2"]);
        assert_eq!(
            folder.names(),
            ["0.pbrt", "1.pbrt", "2.pbrt", "in", "victim.exr", "victim.png"][..]
                .iter()
                .filter(|n| { !n.ends_with(".pbrt") || n[..1].parse::<usize>().unwrap() <= i })
                .copied()
                .collect::<Vec<_>>()
        );
    }
    assert_eq!(fs::read_dir(folder.path("in")).unwrap().count(), 0);
}

/// With a limit of the shell, a message and the exit code 2, and no file left behind.
#[cfg(target_os = "linux")]
#[test]
fn limits_of_the_system_are_errors() {
    let folder = Folder::new();
    let under = |limit: &str, size: &str| {
        let program = env!("CARGO_BIN_EXE_etendue");
        let script =
            format!("ulimit {limit} && exec {program:?} render quads --threads 1 --size {size} --spp 16 -o a.exr");
        let output = Command::new("sh").current_dir(&folder.0).args(["-c", &script]).output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{limit}: {error}");
        assert!(folder.names().is_empty(), "{limit}: {:?}", folder.names());
        error
    };
    // blocks of 512 or 1,024 bytes
    let error = under("-f 1", "64x64");
    assert!(error.contains("a.exr: ") && error.contains("too large"), "{error}");
    let error = under("-v 300000", "2048x1024");
    assert!(error.contains("2048x1024") && error.contains("GB"), "{error}");
}
