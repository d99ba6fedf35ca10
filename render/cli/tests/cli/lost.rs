//! Nothing is lost: `render` writes nothing over the files of its scene or over what is not an image, and says what it has written.

use super::{Folder, json, scene, until};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SMALL: [&str; 4] = ["--size", "8x8", "--spp", "2"];

impl Folder {
    fn render(&self, scene: &str, more: &[&str]) -> String {
        self.succeed(&[&["render", scene], more, &SMALL].concat())
    }
    /// Renders, which must fail and leave all files as they are.
    fn refuse(&self, scene: &str, more: &[&str], message: &[&str]) {
        let contents = || {
            let path = |name: &String| self.path(name);
            self.names().iter().map(path).filter(|p| p.is_file()).map(|p| fs::read(p).unwrap()).collect::<Vec<_>>()
        };
        let (names, before) = (self.names(), contents());
        let error = self.fail(&[&["render", scene], more, &SMALL].concat());
        for part in message {
            assert!(error.contains(part), "{more:?}: {error:?} should contain {part:?}");
        }
        assert!(self.names() == names && contents() == before, "{more:?}: {names:?}, then {:?}", self.names());
    }
    pub(super) fn spawn(&self, arguments: &[&str]) -> Child {
        let program = env!("CARGO_BIN_EXE_etendue");
        // a test that runs in the background inherits ignored signals, which the program would go on ignoring
        let first: &[&str] =
            if cfg!(target_os = "linux") { &["env", "--default-signal=INT,TERM,HUP", program] } else { &[program] };
        let mut command = Command::new(first[0]);
        command.args(&first[1..]);
        command.current_dir(&self.0).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }
}

#[test]
fn the_files_of_a_scene_are_not_overwritten() {
    let folder = Folder::new();
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    for name in ["sky.pbrt", "sky.exr"] {
        fs::copy(shipped.join(name), folder.path(name)).unwrap();
    }
    let sky = fs::read(folder.path("sky.exr")).unwrap();
    folder.render("sky.pbrt", &[]);
    folder.render("sky", &[]);
    assert_eq!(fs::read(folder.path("sky.exr")).unwrap(), sky);
    assert_eq!(folder.names(), ["sky-render.exr", "sky-render.png", "sky.exr", "sky.pbrt"]);

    let read = "the scene has been read from this file";
    folder.refuse("sky.pbrt", &["-o", "sky.exr"], &["sky.exr: ", read, "-o"]);
    folder.refuse("sky.pbrt", &["-o", "../nowhere/../sky.exr"], &["nowhere"]);
    let absolute = folder.path("sky.exr");
    folder.refuse("sky.pbrt", &["-o", absolute.to_str().unwrap()], &[read]);
    fs::hard_link(&absolute, folder.path("same.exr")).unwrap();
    folder.refuse("sky.pbrt", &["-o", "same.exr"], &["same.exr: ", read]);
    folder.refuse("sky.pbrt", &["-o", "sky.pbrt"], &["sky.pbrt", "must end in .exr"]);

    // the scene, an included file and a mesh, whatever their names
    let mesh = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    folder.write("mesh.exr", mesh);
    folder.write("part.exr", "Shape \"plymesh\" \"string filename\" \"mesh.exr\"");
    folder.write("main.exr", scene("Include \"part.exr\""));
    for name in ["main.exr", "part.exr", "mesh.exr"] {
        folder.refuse("main.exr", &["-o", name], &[name, read]);
    }
    // the image that the scene's film asks for, and the PNG beside an image
    let film = scene("LightSource \"infinite\" \"string filename\" \"sky.exr\"");
    let film = film.replace("Film \"rgb\"", "Film \"rgb\" \"string filename\" \"sky.png\"");
    folder.write("film.pbrt", film);
    folder.refuse("film.pbrt", &[], &["sky.exr: ", read, "choose another name with -o"]);
    fs::copy(folder.path("sky-render.png"), folder.path("map.png")).unwrap();
    folder.write("map.pbrt", scene("LightSource \"infinite\" \"string filename\" \"map.png\""));
    folder.refuse("map.pbrt", &[], &["map.png: ", read, "the PNG beside map.exr"]);
    folder.render("map.pbrt", &["-o", "other.exr"]);
}

#[test]
fn an_image_has_a_name_that_fits() {
    let folder = Folder::new();
    folder.write("y.png", "a picture");
    for name in ["y.png", "x.jpg", "x", ".exr", "x.exr.gz", "x."] {
        folder.refuse("quads", &["-o", name], &[&format!("--output {name}: the name must end in .exr"), "PNG"]);
    }
    folder.render("quads", &["-o", "X.EXR"]);
    assert_eq!(folder.names(), ["X.EXR", "X.png", "y.png"]);
    // a name as long as names can be
    let long = format!("{}.exr", "x".repeat(251));
    folder.render("quads", &["-o", &long]);
    let longer = format!("{}.exr", "x".repeat(252));
    folder.refuse("quads", &["-o", &longer], &["xxx.exr: cannot write"]);
}

#[cfg(unix)]
#[test]
fn only_regular_files_are_replaced() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    use std::os::unix::net::UnixListener;
    let folder = Folder::new();
    assert!(Command::new("mkfifo").arg(folder.path("pipe.exr")).status().unwrap().success());
    let _socket = UnixListener::bind(folder.path("socket.exr")).unwrap();
    folder.write("target.exr", "an image");
    symlink("target.exr", folder.path("link.exr")).unwrap();
    symlink("nowhere.exr", folder.path("dangling.exr")).unwrap();
    for (name, kind) in [
        ("pipe.exr", "a named pipe"),
        ("socket.exr", "a socket"),
        ("link.exr", "a symbolic link"),
        ("dangling.exr", "a symbolic link"),
    ] {
        folder.refuse("quads", &["-o", name], &[name, "cannot write: this is ", kind]);
    }
    assert!(fs::symlink_metadata(folder.path("pipe.exr")).unwrap().file_type().is_fifo());
    assert!(fs::symlink_metadata(folder.path("link.exr")).unwrap().file_type().is_symlink());
    // so is the PNG
    symlink("target.exr", folder.path("a.png")).unwrap();
    folder.refuse("quads", &["-o", "a.exr"], &["a.png: cannot write: this is a symbolic link"]);

    let mode =
        |name: &str, bits: u32| fs::set_permissions(folder.path(name), fs::Permissions::from_mode(bits)).unwrap();
    let mode_of = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o7777;
    let plain = folder.write("plain", "");
    folder.render("quads", &["-o", "b.exr"]);
    assert_eq!(mode_of("b.exr"), fs::metadata(plain).unwrap().permissions().mode() & 0o7777, "the umask");
    mode("b.exr", 0o640);
    mode("b.png", 0o606);
    folder.render("quads", &["-o", "b.exr"]);
    assert_eq!((mode_of("b.exr"), mode_of("b.png")), (0o640, 0o606));
    mode("b.png", 0o444);
    folder.refuse("quads", &["-o", "b.exr"], &["b.png: cannot write: this file is read-only"]);
}

/// Waits until a process has run for a fifth of a second, after which it has read its scene and renders.
#[cfg(target_os = "linux")]
fn until_it_renders(child: &Child) {
    let ticks = || {
        let text = fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
        // after the name in parentheses, the 12th and 13th number are the hundredths of a second that it and its calls of the system took
        let times = text.rsplit_once(") ").unwrap().1.split(' ').skip(11).take(2);
        times.map(|time| time.parse::<u32>().unwrap()).sum::<u32>()
    };
    until("it has run for a fifth of a second", || ticks() >= 20);
}

#[cfg(target_os = "linux")]
#[test]
fn a_png_that_fails_does_not_hide_the_exr() {
    let folder = Folder::new();
    let child = folder.spawn(&["render", "quads", "--size", "128x128", "--spp", "64", "--threads", "1", "-o", "a.exr"]);
    until_it_renders(&child);
    assert!(!folder.path("a.exr").exists(), "this test needs a rendering that takes longer");
    fs::create_dir(folder.path("a.png")).unwrap();
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(
        error.contains("a.png: cannot write: ") && error.contains("a.exr was written, but its PNG was not"),
        "{error}"
    );
    etendue_render::film::image::read_exr(&folder.path("a.exr")).unwrap();
    assert_eq!(folder.names(), ["a.exr", "a.png"]);
}

#[test]
fn too_many_threads_are_reduced() {
    let folder = Folder::new();
    let start = Instant::now();
    let output = folder.run(&[&["render", "quads", "--threads", "100000", "--json"], &SMALL[..]].concat());
    assert!(start.elapsed() < Duration::from_secs(20));
    let error = String::from_utf8(output.stderr).unwrap();
    let threads = json(&String::from_utf8(output.stdout).unwrap())["threads"].as_u64().unwrap();
    assert!((64..10_000).contains(&threads), "{threads}");
    assert!(error.contains("--threads 100000") && error.contains(&format!("{threads} threads are used")), "{error}");
}

/// Ends a rendering by a signal once it renders and is `ready`; returns its message.
#[cfg(target_os = "linux")]
fn ended(folder: &Folder, signal: &str, code: i32, more: &[&str], ready: impl Fn() -> bool) -> String {
    let child = folder.spawn(&[&["render", "quads", "--size", "64x64", "-o", "a.exr"], more].concat());
    until_it_renders(&child);
    until("it is ready", ready);
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{error}");
    assert!(output.stdout.is_empty() && error.starts_with("interrupted: "), "{error}");
    error
}

/// The exit code tells the signal, and the message what is on disk.
#[cfg(target_os = "linux")]
#[test]
fn an_interruption_says_what_is_on_disk() {
    let folder = Folder::new();
    let part = |name: &str| etendue_render::film::image::read_exr(&folder.path(name)).unwrap();
    let names = ["a-partial.exr", "a-partial.png"];
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let error = ended(&folder, signal, code, &["--spp", "4096"], || true);
        assert!(error.starts_with("interrupted: a-partial.exr and a-partial.png have "), "{error}");
        assert!(error.contains(" samples per pixel") && error.ends_with("; a.exr does not exist\n"), "{error}");
        assert_eq!(folder.names(), names);
        // as bright as the whole, or black where nothing was rendered, and of no known error there
        let picture = part("a-partial.exr");
        let lit = picture.radiance.iter().filter(|pixel| pixel[1] > 0.0).count();
        let known = picture.variance.unwrap().iter().filter(|v| v[1].is_finite()).count();
        assert!(lit > 0 && known <= lit && known < 64 * 64, "{lit} {known}");
        names.iter().for_each(|name| fs::remove_file(folder.path(name)).unwrap());
    }
    folder.write("a.exr", "an image");
    folder.write("a-partial.png", "another");
    let error = ended(&folder, "-INT", 130, &["--spp", "4096", "--sampler", "sobol"], || true);
    assert!(
        error.contains("a-partial-2.exr and a-partial-2.png have ") && error.ends_with("; a.exr is unchanged\n"),
        "{error}"
    );
    assert!(error.contains("pixels without any are black"), "{error}");
    assert_eq!(fs::read(folder.path("a.exr")).unwrap(), b"an image");
    for name in ["a-partial.png", "a-partial-2.exr", "a-partial-2.png"] {
        fs::remove_file(folder.path(name)).unwrap();
    }
    // a later pass, after its pilot, of which the image on disk has nothing yet
    for more in [&["--time", "6"][..], &["--error", "1e-5", "--technique", "solid-angle"]] {
        ["a.exr", "a.png"].iter().for_each(|name| fs::remove_file(folder.path(name)).unwrap_or_default());
        let first = || {
            let is_written = folder.names().contains(&"a.png".to_owned());
            std::thread::sleep(Duration::from_millis(200));
            is_written
        };
        let error = ended(&folder, "-TERM", 143, more, first);
        assert!(error.starts_with("interrupted: a-partial.exr and a-partial.png have "), "{error}");
        assert!(error.contains(" samples per pixel; a.exr holds an image of ") && error.contains("estimated error "));
        let lit = |name: &str| part(name).radiance.iter().filter(|pixel| pixel[1] > 0.0).count();
        assert!(lit("a-partial.exr") >= lit("a.exr") && lit("a.exr") > 0);
        assert_eq!(folder.names(), ["a-partial.exr", "a-partial.png", "a.exr", "a.png"]);
        names.iter().for_each(|name| fs::remove_file(folder.path(name)).unwrap());
    }
}

/// A rendering does not replace what another program has written since it began, and loses nothing.
#[cfg(target_os = "linux")]
#[test]
fn two_renderings_do_not_share_a_file() {
    let folder = Folder::new();
    let child = folder.spawn(&["render", "quads", "--size", "128x128", "--spp", "64", "--threads", "1", "-o", "a.exr"]);
    until_it_renders(&child);
    folder.render("quads", &["-o", "a.exr"]);
    let first = fs::read(folder.path("a.exr")).unwrap();
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{error}");
    assert!(
        error.contains("a.exr: another program has written this file meanwhile: this image is in a-2.exr and a-2.png"),
        "{error}"
    );
    assert_eq!(fs::read(folder.path("a.exr")).unwrap(), first);
    assert_eq!(etendue_render::film::image::read_exr(&folder.path("a-2.exr")).unwrap().width, 128);
    assert_eq!(folder.names(), ["a-2.exr", "a-2.png", "a.exr", "a.png"]);
}

/// Scenes of the same name and of other kinds do not replace each other's images unasked, nor what is no image of theirs.
#[test]
fn scenes_of_one_name_keep_their_images() {
    let folder = Folder::new();
    folder.write("room.pbrt", scene(""));
    let everything = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/gltf/everything.gltf");
    fs::copy(everything, folder.path("room.gltf")).unwrap();
    folder.render("room.pbrt", &[]);
    folder.render("room.pbrt", &["--seed", "2"]);
    let own =
        "room.exr: this file has an image that may be of room.pbrt instead of room.gltf, and is not replaced unasked";
    folder.refuse("room.gltf", &[], &[own, "choose a name with -o"]);
    // alone, a scene may change
    fs::remove_file(folder.path("room.gltf")).unwrap();
    folder.write("room.pbrt", scene("# changed"));
    folder.render("room.pbrt", &[]);
    folder.write("dining.pbrt", scene(""));
    fs::copy(folder.path("room.exr"), folder.path("dining.exr")).unwrap();
    folder.refuse("dining.pbrt", &[], &["dining.exr: this file has an image of room, and"]);
    folder.write("room.exr", "a treasure");
    folder.refuse("room.pbrt", &[], &["room.exr: this file has no image of this scene"]);
    folder.render("room.pbrt", &["-o", "room.exr"]);
}

/// Where the image cannot be written, the scene is not even read.
#[test]
fn a_name_is_refused_before_the_scene_is_read() {
    let folder = Folder::new();
    folder.write("bad.pbrt", "Nonsense");
    folder.refuse("bad.pbrt", &["-o", "a.jpg"], &["--output a.jpg: the name must end in .exr"]);
    folder.refuse("bad.pbrt", &["-o", "none/a.exr"], &["the folder none does not exist"]);
    folder.refuse("bad.pbrt", &["-o", "a.exr"], &["bad.pbrt:1: "]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_stays_so() {
    let folder = Folder::new();
    // as `nohup` begins a program
    let command =
        format!("trap '' HUP; exec '{}' render quads --size 64x64 --spp 256 -o a.exr", env!("CARGO_BIN_EXE_etendue"));
    let mut shell = Command::new("sh");
    let child = shell.current_dir(&folder.0).args(["-c", &command]).stdout(Stdio::null()).spawn().unwrap();
    until_it_renders(&child);
    assert!(!folder.path("a.exr").exists(), "this test needs a rendering that takes longer");
    assert!(Command::new("kill").args(["-HUP", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{:?}", output.status);
    assert_eq!(folder.names(), ["a.exr", "a.png"]);
}
