//! Runs the program as a user would, and checks output, messages and exit codes.

mod chart;
mod hints;
mod hostile;
mod lost;
mod misuse;
mod refined;
mod view;
mod viewer;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};
use std::{env, fs, process, thread};

/// The scenes of tests at length.
const TEN_SCENES: [&str; 10] = [
    "studio",
    "sphere-light",
    "triangle-light",
    "quads",
    "cornell-box",
    "mirror-room",
    "plates",
    "delta-lights",
    "sky",
    "defocus",
];

/// A temporary folder for a test, removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("etendue-cli-{}-{}", process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
    /// Writes a file in the folder.
    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).unwrap();
        path
    }
    /// Names of the files in the folder.
    fn names(&self) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(&self.0).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
    /// Runs the program in the folder.
    fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_etendue")).current_dir(&self.0).args(arguments).output().unwrap()
    }
    /// Runs the program, which must succeed without messages, and returns its standard output.
    fn succeed(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() && error.is_empty(), "{arguments:?}: {:?}: {error}", output.status);
        String::from_utf8(output.stdout).unwrap()
    }
    /// Runs the program, which must exit with code 2 and print nothing on standard output, and returns its message.
    fn fail(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty() && !error.is_empty(), "{arguments:?}: {:?}", output.stdout);
        assert!(!error.contains("panicked"), "{error}");
        error
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Waits until something is so: as long as that takes on a machine that does much else, and not for ever.
fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "not so after a minute: {what}");
        thread::sleep(Duration::from_millis(1));
    }
}

fn json(text: &str) -> Value {
    assert_eq!(text.trim_end().lines().count(), 1, "one object on one line: {text}");
    serde_json::from_str(text).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

/// A scene of five lines: camera and film, `WorldBegin`, a light, the ground, and `last`.
fn scene(last: &str) -> String {
    format!(
        "LookAt 0 4 6 0 0 0 0 1 0 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n\
         WorldBegin\n\
         AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] Translate 0 3 0 Shape \"sphere\" AttributeEnd\n\
         Shape \"trianglemesh\" \"point3 P\" [-9 0 9 9 0 9 0 0 -9]\n\
         {last}\n"
    )
}

#[test]
fn json_has_the_fields_that_it_should() {
    let folder = Folder::new();
    let words = "render quads --json --size 40x24 --spp 6 --technique area --sampler independent --seed 3 --threads 2 --repeat 3";
    let report = json(&folder.succeed(&[&words.split(' ').collect::<Vec<_>>()[..], &["-o", "a.exr"]].concat()));
    let expected = "choice chosen error height mean missed output passes pixels rays sampler scene seconds seed sensor sets spp \
                    systematic technique threads uncertain width";
    assert_eq!(keys(&report).join(" "), expected);
    assert_eq!(keys(&report["seconds"]), ["build", "load", "render", "trial"]);
    assert_eq!(keys(&report["rays"]), ["camera", "corner", "mirror", "shadow"]);
    assert_eq!((&report["scene"], &report["output"]), (&Value::from("quads"), &Value::from("a.exr")));
    assert_eq!((&report["technique"], &report["sampler"]), (&Value::from("area"), &Value::from("independent")));
    let number = |key: &str| report[key].as_u64().unwrap();
    assert_eq!(["width", "height", "spp", "seed", "threads"].map(number), [40, 24, 6, 3, 2]);
    assert_eq!(report["rays"]["camera"], 40 * 24 * 6);
    assert!((1..=40 * 24 * 6).contains(&report["rays"]["shadow"].as_u64().unwrap()));
    let seconds = report["seconds"]["render"].as_array().unwrap();
    assert_eq!(seconds.len(), 3);
    assert!(
        seconds
            .iter()
            .chain([&report["seconds"]["load"], &report["seconds"]["build"]])
            .all(|s| s.as_f64() >= Some(0.0))
    );
    let mean = report["mean"].as_array().unwrap();
    assert!(mean.len() == 3 && mean.iter().all(|m| (0.05..0.6).contains(&m.as_f64().unwrap())), "{mean:?}");
    assert_eq!(folder.names(), ["a.exr", "a.png"]);
}

#[test]
fn render_writes_an_image_and_a_picture() {
    let folder = Folder::new();
    let text = folder.succeed(&["render", "sphere-light", "--size", "17x5", "--spp", "4"]);
    assert_eq!(folder.names(), ["sphere-light.exr", "sphere-light.png"]);
    assert!(text.contains("wrote sphere-light.exr and sphere-light.png"), "{text}");
    let image = etendue_render::film::image::read_exr(&folder.path("sphere-light.exr")).unwrap();
    assert_eq!((image.width, image.height), (17, 5));
    assert!(image.variance.unwrap().iter().flatten().all(|x| x.is_finite()));
    let picture = fs::read(folder.path("sphere-light.png")).unwrap();
    let header = png::Decoder::new(std::io::Cursor::new(picture)).read_info().unwrap().info().size();
    assert_eq!(header, (17, 5));

    // --output overrides the file name in the scene
    let text = scene("").replace("Film \"rgb\"", "Film \"rgb\" \"string filename\" \"mine.png\"");
    folder.write("file.pbrt", text);
    folder.succeed(&["render", "file.pbrt"]);
    folder.succeed(&["render", "file.pbrt", "-o", "other.exr"]);
    let expected = ["file.pbrt", "mine.exr", "mine.png", "other.exr", "other.png"];
    assert_eq!(folder.names()[..5], expected);
    assert_eq!(fs::read(folder.path("mine.exr")).unwrap(), fs::read(folder.path("other.exr")).unwrap());
}

#[test]
fn bytes_depend_on_the_seed_and_not_on_threads() {
    let folder = Folder::new();
    let of = |seed: &str, threads: &str| {
        let arguments =
            ["render", "quads", "--size", "50x37", "--spp", "8", "-o", "a.exr", "--seed", seed, "--threads", threads];
        folder.succeed(&arguments);
        [fs::read(folder.path("a.exr")).unwrap(), fs::read(folder.path("a.png")).unwrap()]
    };
    let one = of("5", "1");
    assert_eq!(one, of("5", "2"));
    assert_eq!(one, of("5", "3"));
    // the EXR file names the seed, the PNG does not
    assert_ne!(one[1], of("6", "1")[1]);
    assert_ne!(one[1], of("4294967301", "1")[1], "all 64 bits of a seed matter");
}

/// Runs `render` on a faulty scene, with the output over an existing image.
fn faulty(folder: &Folder, name: &str, text: impl AsRef<[u8]>, message: &[&str]) {
    folder.write(name, text);
    fails_untouched(folder, &["render", name, "-o", "kept.exr"], message);
}

fn fails_untouched(folder: &Folder, arguments: &[&str], message: &[&str]) {
    let (image, picture) = (folder.write("kept.exr", "an image"), folder.write("kept.png", "a picture"));
    let names = folder.names();
    let error = folder.fail(arguments);
    for part in message {
        assert!(error.contains(part), "{arguments:?}: {error:?} should contain {part:?}");
    }
    assert_eq!((fs::read(image).unwrap(), fs::read(picture).unwrap()), (b"an image".into(), b"a picture".into()));
    assert_eq!(folder.names(), names, "no file is left behind");
}

#[test]
fn bad_scenes_are_reported_with_file_and_line() {
    let folder = Folder::new();
    // the reader's tests have all messages
    faulty(
        &folder,
        "bad.pbrt",
        scene("Shape \"sphere\"\n\"float radius\" [\n1x]"),
        &["etendue: bad.pbrt:7: ", "expected a number, found 1x"],
    );
    folder.write("mesh.ply", "ply\nformat ascii 1.0\nelement ver");
    let mesh = scene("Shape \"plymesh\" \"string filename\" \"mesh.ply\"");
    faulty(&folder, "bad.pbrt", mesh, &["bad.pbrt:5: ", "mesh.ply:3: the file ends within the header"]);
    // what stands for something else is a warning, and an error only where that is asked for
    folder.write("glass.pbrt", scene("Material \"dielectric\""));
    let strict = ["render", "glass.pbrt", "--strict", "-o", "kept.exr"];
    fails_untouched(
        &folder,
        &strict,
        &["--strict: glass.pbrt:5: Material \"dielectric\": becomes a pane without refraction"],
    );
    for (name, bytes, what) in [
        ("cut.glb", &b"glTF\x02\0\0\0\xff\0\0\0"[..], "etendue: cut.glb: "),
        ("text.gltf", b"{", "etendue: text.gltf:1: not glTF: "),
        ("old.gltf", b"{\"asset\":{\"version\":\"1.0\"}}", "etendue: old.gltf: "),
    ] {
        faulty(&folder, name, bytes, &[what]);
    }
    // a fault in an included file
    folder.write("part.pbrt", "# first line\nShape \"sphere\" \"float radius\" one\n");
    faulty(&folder, "whole.pbrt", scene("Include \"part.pbrt\""), &["part.pbrt:2: ", "expected a number, found one"]);
    faulty(&folder, "bytes.pbrt", b"LookAt\n\xff\xfe", &["bytes.pbrt:2: ", "UTF-8"]);
    faulty(&folder, "empty.pbrt", "", &["empty.pbrt:1: "]);
}

#[test]
fn compare_tells_images_apart() {
    let folder = Folder::new();
    let render = |name: &str, size: &str, spp: &str, seed: &str| {
        folder.succeed(&["render", "quads", "-o", name, "--size", size, "--spp", spp, "--seed", seed]);
    };
    render("a.exr", "32x32", "64", "0");
    render("b.exr", "32x32", "64", "1");
    render("one.exr", "32x32", "1", "0");

    let expected =
        "largest mean_difference mse mse_over_predicted peak predicted_mse psnr reason relative_rms verdict z z_mse";
    let same = json(&folder.succeed(&["compare", "a.exr", "a.exr", "--json"]));
    assert_eq!(keys(&same).join(" "), expected);
    assert_eq!(same["mse"], 0.0);
    assert_eq!(same["z"], serde_json::json!([0.0, 0.0, 0.0]));
    assert_eq!(same["largest"]["difference"], 0.0);
    assert_eq!((&same["verdict"], &same["psnr"]), (&Value::from("identical"), &Value::Null));

    let two = json(&folder.succeed(&["compare", "a.exr", "b.exr", "--json"]));
    assert!(two["verdict"] == "agree" && two["mse"].as_f64().unwrap() > 0.0, "{two}");
    let text = folder.succeed(&["compare", "a.exr", "b.exr"]);
    for part in ["z of the mean", "relative RMS error ", "PSNR ", "verdict            agree: all |z| are less than 4.5"]
    {
        assert!(text.contains(part), "{text}");
    }
    // a light of another size
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/quads.pbrt");
    let other = fs::read_to_string(path).unwrap().replacen("\"rgb L\" [", "\"float scale\" 1.2 \"rgb L\" [", 1);
    folder.write("other.pbrt", other);
    folder.succeed(&["render", "other.pbrt", "-o", "other.exr", "--size", "32x32", "--spp", "64", "--seed", "2"]);
    let differ = json(&folder.succeed(&["compare", "a.exr", "other.exr", "--json"]));
    assert_eq!(differ["verdict"], "differ", "{differ}");

    // an image with one sample has no variance, and no z, on whichever side it is
    for (reference, image, why) in
        [("a.exr", "one.exr", "the image has no variance"), ("one.exr", "a.exr", "the reference has no variance")]
    {
        let blind = json(&folder.succeed(&["compare", reference, image, "--json"]));
        assert_eq!(["z", "z_mse", "predicted_mse"].map(|key| &blind[key]), [&Value::Null; 3]);
        assert_eq!((&blind["verdict"], &blind["reason"]), (&"not known".into(), &why.into()));
        let text = folder.succeed(&["compare", reference, image]);
        assert!(text.contains(&format!("z                  not known, because {why}")), "{text}");
    }
    let mse = json(&folder.succeed(&["compare", "one.exr", "a.exr", "--json"]))["mse"].to_string();
    let told = json(&folder.succeed(&["compare", "one.exr", "a.exr", "--reference-error", &mse, "--json"]));
    assert!(told["z"].is_array() && told["verdict"] == "agree", "{told}");
}

#[test]
fn compare_warns_and_refuses() {
    let folder = Folder::new();
    let render = |name: &str, size: &str, spp: &str| {
        folder.succeed(&["render", "quads", "-o", name, "--size", size, "--spp", spp, "--sampler", "independent"]);
    };
    // images of one seed share their noise
    render("few.exr", "32x32", "32");
    render("many.exr", "32x32", "64");
    render("small.exr", "31x32", "4");
    let output = folder.run(&["compare", "many.exr", "few.exr"]);
    let [out, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(output.status.success() && error.contains("warning: ") && error.contains("same seed?"), "{error}");
    assert!(out.contains("not known: the images seem to share their random numbers"), "{out}");

    let error = folder.fail(&["compare", "few.exr", "small.exr"]);
    assert!(error.contains("32x32") && error.contains("31x32"), "{error}");
    let error = folder.fail(&["compare", "none.exr", "few.exr"]);
    assert!(error.contains("none.exr"), "{error}");
    let bytes = fs::read(folder.path("few.exr")).unwrap();
    for length in [0, 3, 100, bytes.len() / 2, bytes.len() - 1] {
        folder.write("cut.exr", &bytes[..length]);
        let error = folder.fail(&["compare", "few.exr", "cut.exr"]);
        assert!(error.contains("cut.exr"), "{length} of {} bytes: {error}", bytes.len());
    }
    let error = folder.fail(&["compare", "few.exr", "few.png"]);
    assert!(error.contains("few.png"), "{error}");
}

/// Second sets are in the file of an image, of one or of several passes, and judge what any program made of it.
#[test]
fn filtered_images_are_judged() {
    let folder = Folder::new();
    let render = |name: &str, options: &[&str]| {
        folder.succeed(&[&["render", "quads", "-o", name, "--size", "64x64"], options].concat());
    };
    render("a.exr", &["--spp", "64"]);
    render("b.exr", &["--spp", "64", "--seed", "1"]);
    render("passes.exr", &["--error", "0.2%"]);
    render("none.exr", &["--spp", "64", "--sampler", "sobol"]);
    render("many.exr", &["--spp", "2048", "--seed", "9"]);
    render("few.exr", &["--spp", "2", "--seed", "3"]);
    let claim = |image: &str, filtered: &str| json(&folder.succeed(&["compare", image, filtered, "--claim", "--json"]));
    for image in ["a.exr", "passes.exr"] {
        let own = claim(image, image);
        assert_eq!((&own["difference"]["mse"], &own["better"]), (&0.0.into(), &Value::Null), "{own}");
        assert!(own["pixels"].as_u64().unwrap() >= 300, "{own}");
        assert_eq!(own["image"]["mse"], own["filtered"]["mse"]);
        // another image of many or of few samples is what a filter would be that is good or bad
        let [good, bad] = ["many.exr", "few.exr"].map(|filtered| claim(image, filtered));
        assert_eq!([&good["better"], &bad["better"]], ["filtered", "image"].map(|b| b), "{good} {bad}");
        let truth = json(&folder.succeed(&["compare", "many.exr", "few.exr", "--json"]))["mse"].as_f64().unwrap();
        let told = bad["filtered"]["mse"].as_f64().unwrap();
        assert!((told / truth - 1.0).abs() < 0.2, "{image}: {told} {truth}");
    }
    let text = folder.succeed(&["compare", "a.exr", "many.exr", "--claim"]);
    assert!(
        text.contains("better             the filtered image: ") && text.contains("filtered image     mse "),
        "{text}"
    );
    let error = folder.fail(&["compare", "none.exr", "a.exr", "--claim"]);
    assert!(error.contains("none.exr and a.exr: the rendered image has no second sets"), "{error}");
    folder.fail(&["compare", "a.exr", "b.exr", "--claim", "--reference-error", "1"]);
}

/// The left half is the other image, the right half is this one, and a white line is between them.
#[test]
fn another_technique_is_beside_the_image() {
    let folder = Folder::new();
    let image = ["render", "quads", "--size", "34x8", "--spp", "2"];
    let text = folder.succeed(&[&image[..], &["--beside", "area"]].concat());
    assert_eq!(folder.names(), ["quads-beside-area.png", "quads.exr", "quads.png"]);
    let line = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{text}"));
    assert!(line("wrote quads-beside-area.png: ").ends_with("in about the same time"), "{text}");
    for start in ["  left   area: ", "  right  auto (analytic): "] {
        let end = line(start).strip_prefix(start).unwrap();
        assert!(
            end.contains(" s, ") && end.contains(" samples per pixel, ") && end.contains(" shadow rays, error "),
            "{end}"
        );
    }
    let pixels = |name: &str| {
        let bytes = fs::read(folder.path(name)).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels.len(), 3 * 34 * 8);
        pixels
    };
    let (both, this) = (pixels("quads-beside-area.png"), pixels("quads.png"));
    for (y, (both, this)) in both.chunks(3 * 34).zip(this.chunks(3 * 34)).enumerate() {
        assert_eq!((&both[48..54], &both[54..]), (&[255; 6][..], &this[54..]), "row {y}");
    }
    assert_ne!(both[..48], this[..48]);
    // the end says what to try next
    assert!(text.contains("measure: ") && text.ends_with(" view quads\n") && !text.contains("compare: "), "{text}");
    let plain = folder.succeed(&image);
    assert!(plain.contains(" render quads --beside area\nmeasure: "), "{plain}");
    assert!(folder.fail(&[&image[..], &["--beside", "area", "--json"]].concat()).contains("cannot be used with"));
    // nothing is rendered for a picture that cannot be written
    let folder = Folder::new();
    fs::create_dir(folder.path("quads-beside-area.png")).unwrap();
    let error = folder.fail(&[&image[..], &["--beside", "area"]].concat());
    assert!(error.contains("quads-beside-area.png: "), "{error}");
    assert_eq!(folder.names(), ["quads-beside-area.png"]);
}

#[test]
fn list_names_everything() {
    let text = Folder::new().succeed(&["list"]);
    let names: Vec<_> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let expected = "scenes studio sphere-light triangle-light quads terrain cornell-box mirror-room plates delta-lights sky defocus \
                    chandelier city wet-city knot techniques uniform-hemisphere cosine-hemisphere area solid-angle projected-solid-angle brdf \
                    mis-balance mis-power mis-lobe analytic auto choices auto uniform power spatial tree kinds samplers independent \
                    stratified sobol sobol-4d z-order adaptive sensors radiance irradiance power";
    assert_eq!(names.join(" "), expected);
}
