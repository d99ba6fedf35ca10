//! Misuse is answered by a message that names what is wrong, and where.

use super::{Folder, fails_untouched, faulty, scene};
use std::fs;
use std::process::{Command, Stdio};

/// Command lines, each with the parts of the message that refuses it: also of negative numbers, which are values, not options. No file is written, and
/// those of the folder stay as they are.
#[test]
fn what_cannot_be_is_named_and_nothing_is_written() {
    let folder = Folder::new();
    for line in include_str!("misuse.txt").lines() {
        let (command, said) = line.split_once(" => ").unwrap();
        let arguments: Vec<&str> = command.split(' ').collect();
        fails_untouched(&folder, &arguments, &said.split(" | ").collect::<Vec<_>>());
    }
}

#[test]
fn there_is_one_limit_of_samples() {
    let folder = Folder::new();
    let sampler =
        |samples: &str| scene("").replace("WorldBegin", &format!("Sampler \"stratified\" {samples}\nWorldBegin"));
    let grid = sampler("\"integer xsamples\" 4096 \"integer ysamples\" 4096");
    let limit = ["many.pbrt:2: ", "16777216 samples per pixel: ", "must be from 1 to 4194304"];
    faulty(&folder, "many.pbrt", grid, &limit);
}

#[test]
fn a_light_that_is_too_bright_is_named() {
    let folder = Folder::new();
    let bright = |radiance: &str| scene("").replace("[2 2 2]", &format!("[{radiance} 2 2]"));
    let render = |more: &[&str]| {
        let output = folder.run(&[&["render", "light.pbrt"], more].concat());
        let [out, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code(), out, error)
    };
    // the image is right, but its variance is too large
    folder.write("light.pbrt", bright("1e30"));
    let (code, out, error) = render(&["--spp", "16"]);
    assert_eq!(code, Some(0), "{error}");
    assert!(
        error.contains("warning: light.pbrt:3: ") && error.contains("so bright that variances may overflow"),
        "{error}"
    );
    let said = "estimated error not known, because the variance of pixel (";
    assert!(out.contains(said) && out.contains("a light is too bright or too near"), "{out}");
    let (code, _, error) = render(&["--error", "1%"]);
    assert!(code == Some(2) && error.contains("is not known, because the variance of pixel ("), "{error}");
    // so near that a pixel is infinite
    let near = scene("LightSource \"point\" \"rgb I\" [1e38 1 1] \"point3 from\" [0 0.1 0]");
    folder.write("light.pbrt", near);
    for more in [&["--spp", "64", "--size", "32x32"][..], &["--time", "0.3", "--size", "32x32"]] {
        let (code, out, error) = render(more);
        assert_eq!(code, Some(0), "{error}");
        assert!(
            out.contains("not known, because pixel (") && out.contains(") is not finite: a light is too bright"),
            "{out}"
        );
    }
    let (_, out, _) = render(&["--spp", "1"]);
    assert!(out.contains("pixel (") || out.contains("single set"), "{out}");
    // what was right stays so
    folder.write("light.pbrt", bright("1e17"));
    let (code, out, error) = render(&["--spp", "16"]);
    assert!(code == Some(0) && out.contains(" % (relative RMS)"), "{out}");
    assert!(error.starts_with("hint: the PNG is nearly white"), "{error}");
    assert!(
        folder
            .succeed(&["render", "quads", "--size", "8x8", "--spp", "1"])
            .contains("a pixel is a single set of samples")
    );
}

/// Scenes may have any name that the system allows, as images may.
#[cfg(target_os = "linux")]
#[test]
fn names_need_not_be_text() {
    use std::ffi::{OsStr, OsString};
    use std::os::unix::ffi::{OsStrExt, OsStringExt};
    let folder = Folder::new();
    let path = |name: &[u8]| folder.0.join(OsStr::from_bytes(name));
    let run = |words: &[&[u8]]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
        command.current_dir(&folder.0).args(words.iter().map(|word| OsString::from_vec(word.to_vec())));
        let output = command.output().unwrap();
        (output.status.code(), output.stdout, String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for name in [&b"a\xff.pbrt"[..], b"a\xfe.pbrt"] {
        fs::write(path(name), scene("")).unwrap();
        let (code, out, error) = run(&[b"render", name, b"--json"]);
        assert_eq!(code, Some(0), "{error}");
        super::json(&String::from_utf8(out).unwrap());
    }
    // each has an image of its own
    assert!([&b"a\xff.exr"[..], b"a\xfe.exr", b"a\xff.png", b"a\xfe.png"].iter().all(|name| path(name).is_file()));
    // messages, and the other commands that take scenes
    let (code, _, error) = run(&[b"render", b"b\xff.pbrt"]);
    assert!(code == Some(2) && error.contains("cannot read \"b\u{fffd}.pbrt\""), "{error}");
    let (code, _, error) = run(&[b"chart", b"b\xff.pbrt", b"-o", b"c\xff"]);
    assert!(code == Some(2) && error.contains("b\u{fffd}.pbrt"), "{error}");
}

/// What cannot be printed is reported as such; a reader that leaves ends the program quietly, but not successfully.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_named() {
    let folder = Folder::new();
    let image = ["render", "quads", "--size", "8x8", "--spp", "4", "-o", "a.exr"];
    folder.succeed(&image);
    let full = "standard output: cannot write: No space left on device";
    for (arguments, more) in [
        (&["list"][..], ""),
        (&image, "; a.exr and a.png were written"),
        (&[&image[..], &["--json"]].concat(), "; a.exr and a.png were written"),
        (&["compare", "a.exr", "a.exr"], ""),
        (&["compare", "a.exr", "a.exr", "--json"], ""),
    ] {
        let to = |out: Stdio| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
            command.current_dir(&folder.0).args(arguments).stdout(out).stderr(Stdio::piped()).spawn().unwrap()
        };
        let device = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = to(device.into()).wait_with_output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(full) && error.trim_end().ends_with(more), "{arguments:?}: {error}");
        // a pipe that nobody reads
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = to(writer.into()).wait_with_output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), &*error), (Some(141), ""), "{arguments:?}");
    }
}

/// A log that is full loses its messages, but no image.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_error_loses_no_image() {
    let folder = Folder::new();
    folder.write("warned.pbrt", scene("").replace("WorldBegin", "Accelerator \"bvh\"\nWorldBegin"));
    let run = |arguments: &[&str]| {
        let device = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
        command.current_dir(&folder.0).args(arguments).stderr(device).stdout(Stdio::null()).status().unwrap().code()
    };
    assert_eq!(run(&["render", "warned.pbrt", "--threads", "100000"]), Some(0));
    assert_eq!(folder.names(), ["warned.exr", "warned.pbrt", "warned.png"]);
    assert_eq!(run(&["render", "none.pbrt"]), Some(2));
    assert_eq!(run(&["render", "--spp", "-1"]), Some(2));
}

#[test]
fn files_that_are_no_images_or_folders_are_named() {
    let folder = Folder::new();
    folder.write("room.pbrt", scene(""));
    folder.write("room.obj", "v 0 0 0");
    for (name, what) in [
        ("picture.png", "; -o writes an image: etendue render SCENE -o picture.exr"),
        ("room", "; did you mean room.pbrt?"),
        ("./rom.pbrt", "; did you mean ./room.pbrt?"),
        (
            "room.obj",
            "room.obj:1: unknown directive v; a file whose name does not end in .gltf or .glb is read as one of pbrt",
        ),
    ] {
        let error = folder.fail(&["render", name]);
        assert!(error.contains(what), "{name}: {error}");
    }
    assert!(!folder.fail(&["render", "nothing.pbrt"]).contains("built-in"));
    assert!(folder.fail(&["compare", "a.png", "b.exr"]).contains("a.png: EXR files are compared, such as a.exr"));
    folder.write("file.exr", "");
    let error = folder.fail(&["compare", "file.exr", "file.exr"]);
    assert!(error.contains("file.exr: not a valid EXR image: it is cut off"), "{error}");
    let error = folder.fail(&["chart", "quads", "-o", "file.exr"]);
    assert!(error.contains("file.exr: cannot make this folder: a file has this name"), "{error}");
    let film = scene("").replace("Film \"rgb\"", "Film \"rgb\" \"string filename\" \"nowhere/taken.png\"");
    folder.write("film.pbrt", film);
    fs::create_dir(folder.path("taken.exr")).unwrap();
    let error = folder.fail(&["render", "film.pbrt"]);
    assert!(error.contains("taken.exr: ") && error.contains("film asks for \"taken.png\"; -o"), "{error}");
    // neither blocks nor reads for ever
    #[cfg(unix)]
    assert!(folder.fail(&["compare", "/dev/zero", "file.exr"]).contains("/dev/zero: cannot read: not a regular file"));
}
