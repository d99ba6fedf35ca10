//! The lists of what the formats can say, against the readers: what the readers ask for is listed (a debug assertion of the reader of
//! parameters), what is listed is asked for, defaults are what the list says, and the pages of the documentation are made of the lists.

use crate::kit::Folder;
use etendue_render::scene::Scene;
use etendue_scene::list::{Entry, GLTF, PBRT, Parameter, State, Table};
use etendue_scene::parse;
use std::collections::HashSet;
use std::fmt::Write;

/// What a directive of this type needs besides the parameter that is looked at.
fn needed(name: &str, kind: &str, parameter: &str) -> String {
    let triangle = "\"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]";
    let patch = "\"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
    let given = match (name, kind) {
        ("Shape", "trianglemesh" | "loopsubdiv") if parameter == "indices" => "\"point3 P\" [0 0 0 1 0 0 0 1 0]",
        ("Shape", "trianglemesh" | "loopsubdiv") => triangle,
        ("Shape", "bilinearmesh") => patch,
        ("Shape", "plymesh") => "\"string filename\" \"quad.ply\"",
        ("Texture", "imagemap") => "\"string filename\" \"one.exr\"",
        ("LightSource", "goniometric") if parameter == "mapname" => "",
        ("LightSource", "goniometric") => "\"string filename\" \"one.exr\"",
        ("LightSource", "infinite") if ["type", "azimuth", "sun"].contains(&parameter) => {
            "\"string sky\" \"cie\" \"float elevation\" 30"
        }
        ("LightSource", "infinite") if parameter == "elevation" => "\"string sky\" \"cie\"",
        ("Material", "mix") if parameter.starts_with("namedmaterial") => "",
        ("Material", "mix") => "\"string materials\" [\"a\" \"b\"]",
        _ => "",
    };
    // the parameter itself instead
    if given.contains(&format!(" {parameter}\"")) { String::new() } else { given.to_owned() }
}

/// A scene with a directive of this type and this text of parameters.
fn scene(name: &str, kind: &str, text: &str) -> String {
    let camera = "Camera \"perspective\"";
    let named =
        "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"b\" \"string type\" \"mirror\"";
    let triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";
    let own = format!("{name} \"{kind}\" {text}\n");
    match name {
        "Camera" => format!("{own}WorldBegin\n{triangle}"),
        "Film" | "Sampler" | "PixelFilter" | "Integrator" | "Accelerator" => {
            format!("{own}{camera} WorldBegin\n{triangle}")
        }
        "Texture" => format!(
            "{camera} WorldBegin\nTexture \"t\" \"spectrum\" \"{kind}\" {text}\nMaterial \"diffuse\" \"texture reflectance\" \"t\" {triangle}"
        ),
        "Material" => format!("{camera} WorldBegin\n{named} {own}{triangle}"),
        "AreaLightSource" => format!("{camera} WorldBegin\n{own}{triangle}"),
        _ => format!("{camera} WorldBegin\n{own}"),
    }
}

fn files() -> Folder {
    let folder = Folder::new();
    folder.picture("one.exr", [1, 1], |_, _| [1.0; 3]);
    folder.write(
        "quad.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    );
    folder
}

fn every(mut of: impl FnMut(&Entry, &str, &Parameter)) -> usize {
    let mut count = 0;
    for entry in PBRT.entries.iter().filter(|entry| !entry.kinds.is_empty()) {
        for kind in &entry.kinds {
            for parameter in entry.parameters.iter().filter(|parameter| parameter.name != "*") {
                of(entry, kind, parameter);
                count += 1;
            }
        }
    }
    count
}

/// The reader asks for each parameter that is exact or approximated: of a type that it cannot have, it is an error that names it. What is
/// ignored is a warning, and what changes nothing is none.
#[test]
fn readers_ask_for_what_is_listed() {
    let folder = files();
    let mut faults = Vec::new();
    let count = every(|entry, kind, parameter| {
        let Parameter { name, state, .. } = parameter;
        let wrong = if *name == "N" || *name == "P" { "bool" } else { "normal" };
        let value = if wrong == "bool" { "true" } else { "[0 0 0]" };
        let text = scene(entry.name, kind, &format!("{} \"{wrong} {name}\" {value}", needed(entry.name, kind, name)));
        let read = parse(&text, "a.pbrt", folder.root());
        let what = format!("{} {kind:?}, {name}", entry.name);
        let warned =
            |scene: &Scene| scene.warnings.iter().any(|warning| warning.text.contains(&format!("{name:?}: ignored")));
        let is_right = match (state, &read) {
            (State::Exact | State::Approximated | State::Refused, Err(error)) => {
                // the older name of uv is taken for it
                error.to_string().contains(if *name == "st" { "uv" } else { name })
            }
            (State::Exact | State::Approximated | State::Refused, Ok(_)) => false,
            (State::Ignored, Ok(scene)) => warned(scene),
            (State::Inert, Ok(scene)) => !warned(scene),
            (State::Ignored | State::Inert, Err(_)) => false,
        };
        if !is_right {
            let found = read.map(|scene| scene.warnings.iter().map(ToString::to_string).collect::<Vec<_>>());
            faults.push(format!("{what}, listed as {}: {:?}", state.name(), found.map_err(|error| error.to_string())));
        }
    });
    assert!(count > 400, "{count}");
    assert!(faults.is_empty(), "{} of {count}:\n{}", faults.len(), faults.join("\n"));
}

/// A directive with a parameter of its default is the one without it.
#[test]
fn defaults_are_those_of_the_list() {
    let folder = files();
    let (mut faults, mut count) = (Vec::new(), 0);
    every(|entry, kind, Parameter { kind: of, name, default, state, .. }| {
        if default.is_empty() || *state == State::Ignored || (*name == "fov" && kind == "orthographic") {
            return;
        }
        let value = match (*of, *default) {
            ("string", text) => format!("\"string {name}\" \"{text}\""),
            ("spectrum", text) if text.starts_with("metal-") => format!("\"spectrum {name}\" \"{text}\""),
            // an index is one number
            ("spectrum", x) if *name == "eta" => format!("\"float {name}\" {x}"),
            ("spectrum", x) => format!("\"rgb {name}\" [{x} {x} {x}]"),
            (of, text) => format!("\"{of} {name}\" [{text}]"),
        };
        let debug = |text: &str| match parse(text, "a.pbrt", folder.root()) {
            Ok(scene) => {
                format!("{:?}", Scene { inputs: Vec::new(), warnings: Vec::new(), stand_ins: Vec::new(), ..scene })
            }
            Err(error) => panic!("{text}: {error}"),
        };
        let needed = needed(entry.name, kind, name);
        let [with, without] =
            [value, String::new()].map(|text| debug(&scene(entry.name, kind, &format!("{needed} {text}"))));
        count += 1;
        if with != without {
            faults.push(format!("{} {kind:?}, {name} {default}:\n  {with}\n  {without}", entry.name));
        }
    });
    assert!(count > 150, "{count}");
    assert!(faults.is_empty(), "{} of {count}:\n{}", faults.len(), faults.join("\n"));
}

/// No line of the lists is lost, no name is listed twice, and each object that a property of glTF names is listed.
#[test]
fn lists_are_sound() {
    let texts = [include_str!("../scene/src/pbrt/list.txt"), include_str!("../scene/src/gltf/list.txt")];
    for (table, text) in [&*PBRT, &*GLTF].into_iter().zip(texts) {
        let lines = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
        let rows: usize = table.entries.iter().map(|entry| 1 + entry.parameters.len()).sum();
        assert_eq!(rows, lines.count());
        let mut names = HashSet::new();
        for entry in &table.entries {
            let kinds = if entry.kinds.is_empty() { &vec![""] } else { &entry.kinds };
            assert!(kinds.iter().all(|kind| names.insert((entry.name, *kind))), "{} is listed twice", entry.name);
            let mut own = HashSet::new();
            assert!(entry.parameters.iter().all(|parameter| own.insert(parameter.name)), "{entry:?}");
        }
    }
    let plain = ["integer", "number", "string", "bool", "integer[]", "string[]", "number[]", ""];
    for entry in &GLTF.entries {
        for Parameter { kind, name, .. } in &entry.parameters {
            let of = kind.trim_end_matches("[]");
            let is_known = plain.contains(kind) || kind.starts_with("number[") || GLTF.entry(of, "").is_some();
            assert!(is_known, "{} {kind} {name}", entry.name);
        }
    }
}

/// What the states on the pages mean.
const STATES: &str = "Exact: it means what the format says. No effect: it changes no picture. Approximated: something near replaces it. \
    Ignored: it is left out, and a warning says so. Refused: it is an error. With `--strict`, what is approximated or ignored is one, too.";
/// A whole scene, with which the page of pbrt begins.
const SMALLEST: &str = r#"LookAt 0 2 6  0 1 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 320 "integer yresolution" 240
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [8 8 8]
  Translate 2 3 0
  Shape "sphere" "float radius" 0.5
AttributeEnd
Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
Shape "bilinearmesh" "point3 P" [-5 0 5  5 0 5  -5 0 -5  5 0 -5]
Translate 0 1 0
Shape "sphere"
"#;

#[test]
fn the_smallest_scene_is_read_as_it_is() {
    let scene = parse(SMALLEST, "smallest.pbrt", std::path::Path::new(".")).unwrap();
    assert!(scene.warnings.is_empty() && scene.stand_ins.is_empty(), "{:?}", scene.warnings);
    let lights = scene.shapes.iter().filter(|shape| shape.emission.is_some()).count();
    assert_eq!((lights, scene.film.width), (1, 320));
}

/// A table as a page of Markdown.
fn page(table: &Table, title: &str) -> String {
    let mut page = format!("# {title}\n\n{STATES}\n");
    if std::ptr::eq(table, &raw const *PBRT) {
        let _ = write!(
            page,
            "\nA whole scene, which `etendue render FILE` draws (more are in [scenes](../scenes)):\n\n```\n{SMALLEST}```\n"
        );
    } else {
        page.push_str("\nMeshes whose material has an `emissiveFactor` are area lights; `KHR_lights_punctual` has point, spot and directional ones. An image is 1,280 pixels wide and as high as the camera's `aspectRatio` says, or 720: `--size` changes that.\n");
    }
    for Entry { name, kinds, state, note, parameters } in &table.entries {
        let kinds: String = kinds.iter().map(|kind| format!(" `\"{kind}\"`")).collect();
        let note = if note.is_empty() { String::new() } else { format!(": {note}") };
        let _ = writeln!(page, "\n**{name}**{kinds} — {}{note}", state.name());
        if !parameters.is_empty() {
            page.push_str("\n| parameter | default | state | |\n|---|---|---|---|\n");
        }
        for Parameter { kind, name, default, state, note } in parameters {
            let name =
                if *name == "*" { "all others".to_owned() } else { format!("`{kind} {name}`").replace("` ", "`") };
            let _ = writeln!(page, "| {name} | {default} | {} | {note} |", state.name());
        }
    }
    page
}

/// The pages of the documentation are those of the lists. `ETENDUE_WRITE_PAGES=1` writes them.
#[test]
fn pages_are_made_of_the_lists() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../formats");
    let pages: [(&str, &str, &Table); 2] =
        [("pbrt.md", "What is read of pbrt-v4's format", &PBRT), ("gltf.md", "What is read of glTF 2.0", &GLTF)];
    for (file, title, table) in pages {
        let (path, page) = (folder.join(file), page(table, title));
        if std::env::var_os("ETENDUE_WRITE_PAGES").is_some() {
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(&path, &page).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(found == page, "{} is not that of the list: ETENDUE_WRITE_PAGES=1 writes it", path.display());
    }
}
