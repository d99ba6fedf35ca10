//! What the sources themselves must keep: imports that go one way, a README that can be read, and names that are gone.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All files below a folder whose name ends with one of the given endings.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(files(&path, endings));
        } else if endings.iter().any(|ending| path.to_string_lossy().ends_with(ending)) {
            all.push(path);
        }
    }
    all
}

/// The files of sources, so without those that a build or a fuzzer wrote.
fn sources(endings: &[&str]) -> Vec<PathBuf> {
    let folders = ["core", "render", "tests", "benches", "fuzz/bodies", "fuzz/fuzz_targets", ".ci"];
    let all = folders.iter().flat_map(|folder| files(&root().join(folder), endings));
    all.filter(|path| path.iter().all(|part| part != "target")).collect()
}

/// The tokens of a source, without comments and literals of text. Punctuation is one character each, except for `::`.
fn tokens(text: &str) -> Vec<String> {
    let text: Vec<char> = text.chars().collect();
    let at = |i: usize| text.get(i).copied().unwrap_or(' ');
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut all, mut i) = (Vec::new(), 0);
    while i < text.len() {
        let start = i;
        match (at(i), at(i + 1)) {
            ('/', '/') => i += text[i..].iter().take_while(|c| **c != '\n').count(),
            ('/', '*') => {
                i += 2;
                while i < text.len() && (at(i), at(i + 1)) != ('*', '/') {
                    i += 1;
                }
                i += 2;
            }
            ('"', _) => {
                i += 1;
                while i < text.len() && at(i) != '"' {
                    i += if at(i) == '\\' { 2 } else { 1 };
                }
                i += 1;
            }
            ('\'', '\\') => i += 3 + text[i + 3..].iter().take_while(|c| **c != '\'').count() + 1,
            ('\'', _) => i += if at(i + 2) == '\'' { 3 } else { 1 },
            (':', ':') => {
                all.push("::".to_owned());
                i += 2;
            }
            (c, _) if is_word(c) => {
                i += text[i..].iter().take_while(|c| is_word(**c)).count();
                let word: String = text[start..i].iter().collect();
                let hashes = text[i..].iter().take_while(|c| **c == '#').count();
                if ["r", "br", "cr"].contains(&word.as_str()) && at(i + hashes) == '"' {
                    i += hashes + 1;
                    let closes = |i: usize| at(i) == '"' && (1..=hashes).all(|k| at(i + k) == '#');
                    while i < text.len() && !closes(i) {
                        i += 1;
                    }
                    i += hashes + 1;
                } else {
                    all.push(word);
                }
            }
            (c, _) => {
                if !c.is_whitespace() {
                    all.push(c.to_string());
                }
                i += 1;
            }
        }
    }
    all
}

/// The same tokens without the items that are compiled for tests alone.
fn without_tests(tokens: &[String]) -> Vec<String> {
    let (mut all, mut i) = (Vec::new(), 0);
    while i < tokens.len() {
        if !tokens[i..].iter().map(String::as_str).take(7).eq(["#", "[", "cfg", "(", "test", ")", "]"]) {
            all.push(tokens[i].clone());
            i += 1;
            continue;
        }
        // up to the end of the block, or to a semicolon outside of brackets
        let mut depth = 0;
        i += 7;
        while i < tokens.len() {
            let token = tokens[i].as_str();
            depth += i32::from(["(", "[", "{"].contains(&token)) - i32::from([")", "]", "}"].contains(&token));
            i += 1;
            if depth == 0 && [";", "}"].contains(&token) {
                break;
            }
        }
    }
    all
}

type Module = Vec<String>;

/// Adds the paths of a use tree that begins at a token, and returns where it ends.
fn tree(tokens: &[String], mut at: usize, mut prefix: Module, paths: &mut Vec<Module>) -> usize {
    while let Some(token) = tokens.get(at) {
        match token.as_str() {
            "super" => drop(prefix.pop()),
            "self" => {}
            "{" => {
                at += 1;
                while at < tokens.len() && tokens[at] != "}" {
                    at = tree(tokens, at, prefix.clone(), paths);
                    // `as` and the new name, and the comma
                    while at < tokens.len() && tokens[at] != "," && tokens[at] != "}" {
                        at += 1;
                    }
                    at += usize::from(tokens.get(at).is_some_and(|token| token == ","));
                }
                return at + 1;
            }
            word if word.starts_with(|c: char| c.is_alphabetic() || c == '_') => prefix.push(word.to_owned()),
            _ => break,
        }
        at += 1;
        if tokens.get(at).is_none_or(|token| token != "::") {
            break;
        }
        at += 1;
    }
    paths.push(prefix);
    at
}

/// The paths from the root of the crate that a module names by `crate::`, `super::` or `self::`, outside of its tests.
fn named(text: &str, module: &[String]) -> Vec<Module> {
    let tokens = without_tests(&tokens(text));
    let mut paths = Vec::new();
    for i in 1..tokens.len() {
        // visibility is no import
        if tokens[i] != "::" || i > 1 && ["::", "in"].contains(&tokens[i - 2].as_str()) {
            continue;
        }
        let start = match tokens[i - 1].as_str() {
            "crate" => Vec::new(),
            "super" => module[..module.len() - 1].to_vec(),
            "self" => module.to_vec(),
            _ => continue,
        };
        tree(&tokens, i + 1, start, &mut paths);
    }
    paths
}

type Graph = BTreeMap<String, BTreeSet<String>>;

/// For each folder of modules, its modules and which of them each one imports, with all that is below it. The file of the folder itself
/// imports each of them.
fn levels(package: &str) -> BTreeMap<String, Graph> {
    let source = root().join(package).join("src");
    let mut texts = BTreeMap::new();
    for path in files(&source, &[".rs"]) {
        let relative = path.strip_prefix(&source).unwrap().with_extension("");
        let module: Module = relative.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if module.iter().any(|part| part == "tests") {
            continue;
        }
        let is_root = module == ["lib"] || module == ["main"];
        texts.insert(if is_root { Vec::new() } else { module }, fs::read_to_string(path).unwrap());
    }
    let own = |module: &[String]| module.last().map_or_else(|| package.to_owned(), Clone::clone);
    let name = |module: &[String]| [&[package.to_owned()], module].concat().join("::");
    let mut levels: BTreeMap<String, Graph> = BTreeMap::new();
    for (module, text) in &texts {
        if let Some((_, above)) = module.split_last() {
            assert!(texts.contains_key(above), "{}: no file of the folder", name(module));
            let graph = levels.entry(name(above)).or_default();
            graph.entry(own(above)).or_default().insert(own(module));
            graph.entry(own(module)).or_default();
        }
        for path in named(text, module) {
            let known = (0..=path.len()).rev().map(|n| &path[..n]).find(|path| texts.contains_key(*path)).unwrap();
            let common = known.iter().zip(module).take_while(|(a, b)| a == b).count();
            let graph = levels.entry(name(&module[..common])).or_default();
            if common < module.len() {
                let to = known.get(common).cloned().unwrap_or_else(|| own(known));
                graph.entry(module[common].clone()).or_default().insert(to);
            }
        }
    }
    levels
}

/// A path from a module back to itself, if there is one.
fn cycle(imports: &Graph) -> Option<Vec<String>> {
    fn search(imports: &Graph, path: &mut Vec<String>, done: &mut BTreeSet<String>) -> Option<Vec<String>> {
        let last = path.last().unwrap().clone();
        for next in imports.get(&last).into_iter().flatten() {
            if let Some(start) = path.iter().position(|module| module == next) {
                return Some(path[start..].to_vec());
            }
            if !done.contains(next) {
                path.push(next.clone());
                if let Some(found) = search(imports, path, done) {
                    return Some(found);
                }
                path.pop();
            }
        }
        done.insert(last);
        None
    }
    let mut done = BTreeSet::new();
    imports.keys().find_map(|module| search(imports, &mut vec![module.clone()], &mut done))
}

/// Imports that close a cycle: folder, module, what it imports, and why.
const EXCEPTIONS: [(&str, &str, &str, &str); 2] = [
    ("tests/properties", "fixtures", "generators", "`Random` is in generators.rs, beside the shapes that it generates"),
    ("tests/properties", "properties", "generators", "the same"),
];

/// The packages, and whether the files inside of their folders must import one way, too. In the core and the properties, the file of a
/// folder has the traits and types that all its modules share, so they import it.
const PACKAGES: [(&str, bool); 8] = [
    ("core", false),
    ("render", true),
    ("render/laboratory", true),
    ("render/cli", true),
    ("tests/bits", true),
    ("tests/oracle", true),
    ("tests/properties", false),
    ("benches/routines", true),
];

#[test]
fn modules_import_one_way() {
    let mut exceptions = Vec::new();
    for (package, folders) in PACKAGES {
        let levels = levels(package);
        for (level, mut graph) in levels.into_iter().filter(|(level, _)| folders || level == package) {
            println!("{level}");
            for (module, imports) in &graph {
                println!("    {module:16} → {}", imports.iter().cloned().collect::<Vec<_>>().join(", "));
            }
            assert!(graph.len() > 1, "{level} has no modules");
            for &(_, from, to, why) in EXCEPTIONS.iter().filter(|exception| exception.0 == level) {
                assert!(
                    graph.get_mut(from).is_some_and(|imports| imports.remove(to)),
                    "{level}: {from} → {to} is gone"
                );
                println!("    except {from} → {to}: {why}");
                exceptions.push((level.clone(), from, to));
            }
            assert_eq!(cycle(&graph), None, "modules of {level} import each other");
            for (_, from, to) in exceptions.iter().filter(|exception| exception.0 == level) {
                let mut one = graph.clone();
                one.get_mut(*from).unwrap().insert((*to).to_owned());
                assert!(cycle(&one).is_some(), "{level}: {from} → {to} is no exception any more");
            }
            // any import in the other direction is found
            for (from, to) in graph.iter().flat_map(|(from, imports)| imports.iter().map(move |to| (from, to))) {
                let mut planted = graph.clone();
                planted.get_mut(to).unwrap().insert(from.clone());
                assert!(cycle(&planted).is_some(), "{level}: {to} → {from}");
            }
        }
    }
    assert_eq!(exceptions.len(), EXCEPTIONS.len(), "exceptions in folders that do not exist");
}

/// Imports that are known to exist are found, so that the other test cannot pass because it reads nothing.
#[test]
fn imports_are_found() {
    for (package, level, from, to) in [
        ("core", "core", "light", "spherical"),
        ("render", "render", "integrator", "lights"),
        ("render", "render", "scene", "image"),
        ("render", "render::bvh", "stream", "single_ray"),
        ("render", "render::bvh", "bvh", "stream"),
        ("render", "render::integrator", "tile", "paths"),
        ("render/laboratory", "render/laboratory", "figure", "chart"),
        ("render/laboratory", "render/laboratory::chart", "report", "outcome"),
        ("render/laboratory", "render/laboratory::chart", "plot", "stats"),
        ("render/laboratory", "render/laboratory::atlas", "survey", "truth"),
        ("render/cli", "render/cli", "render", "output"),
        ("tests/oracle", "tests/oracle", "flat", "quadrature"),
        ("tests/properties", "tests/properties", "suite", "properties"),
        ("benches/routines", "benches/routines", "rays", "baseline"),
    ] {
        assert!(levels(package)[level][from].contains(to), "{level}: {from} → {to}");
    }
    let text = r##"
        //! [`a`](crate::comment)
        use crate::{a::{self, B}, c::*, d as e};
        use super::super::f;
        pub(in crate::visible) fn g<'x>(x: &'x str) -> char { super::h::<u8>(r#"" crate::raw"#, "\" crate::text"); '"' }
        #[cfg(test)]
        #[allow(unused)]
        mod tests { use super::super::tested; fn f() -> [u8; 2] { [0; 2] } }
        #[cfg(test)]
        mod other;
        fn i() { self::j() /* crate::block */ }
    "##;
    let path = |text: &str| text.split("::").map(str::to_owned).collect::<Vec<_>>();
    let found: Vec<_> = named(text, &path("m::n")).iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["a", "a::B", "c", "d", "f", "m::h", "m::n::j"]);
}

/// Which packages of the workspace each one may use, and which more its tests, benchmarks and examples may.
const ARROWS: [(&str, &[&str], &[&str]); 16] = [
    ("core", &[], &[]),
    ("core/batch", &["etendue"], &[]),
    ("core/c", &["etendue", "etendue-batch"], &[]),
    ("core/python", &["etendue", "etendue-batch"], &[]),
    ("render", &["etendue"], &["etendue-oracle"]),
    ("render/laboratory", &["etendue", "etendue-oracle", "etendue-render"], &["etendue-properties"]),
    ("render/cli", &["etendue-laboratory", "etendue-render"], &["etendue-oracle"]),
    ("tests/bits", &["etendue", "etendue-properties"], &[]),
    ("tests/oracle", &[], &[]),
    ("tests/proof", &["etendue", "etendue-oracle"], &[]),
    ("tests/properties", &["etendue", "etendue-oracle"], &[]),
    ("tests", &[], &["etendue", "etendue-bits", "etendue-oracle", "etendue-properties"]),
    ("benches/routines", &["etendue", "etendue-render"], &[]),
    ("benches", &[], &["etendue", "etendue-laboratory", "etendue-render", "etendue-routines"]),
    ("fuzz/bodies", &["etendue", "etendue-c", "etendue-oracle", "etendue-render"], &[]),
    ("fuzz", &["etendue-fuzz-bodies", "etendue-properties"], &[]),
];

/// The sections of a manifest, each with its name and lines.
fn sections(manifest: &Path) -> Vec<(String, Vec<String>)> {
    let mut all = vec![(String::new(), Vec::new())];
    for line in fs::read_to_string(manifest).unwrap().lines().filter(|line| !line.starts_with('#')) {
        match line.strip_prefix('[') {
            Some(name) => all.push((name.trim_end().trim_end_matches(']').to_owned(), Vec::new())),
            None => all.last_mut().unwrap().1.push(line.to_owned()),
        }
    }
    all
}

/// The dependencies of a package; those of tests, benchmarks and examples if `dev`.
fn dependencies(package: &str, dev: bool) -> Vec<String> {
    let is_asked = |name: &str| name.ends_with("dependencies") && name.ends_with("dev-dependencies") == dev;
    let sections = sections(&root().join(package).join("Cargo.toml"));
    let lines = sections.into_iter().filter(|(name, _)| is_asked(name)).flat_map(|(_, lines)| lines);
    let name = |line: &str| match line.split_once("package = \"") {
        Some((_, package)) => package.split('"').next().unwrap_or_default().to_owned(),
        None => line.split([' ', '.', '=']).next().unwrap_or_default().to_owned(),
    };
    lines.map(|line| name(&line)).filter(|name| !name.is_empty()).collect()
}

#[test]
fn packages_depend_one_way() {
    let [_, workspace, ..] = &sections(&root().join("Cargo.toml"))[..] else { panic!("no workspace") };
    let lines = workspace.1.iter().skip_while(|line| *line != "members = [").take_while(|line| *line != "]");
    let members: BTreeSet<_> = lines.flat_map(|line| line.split('"').skip(1).step_by(2)).collect();
    assert_eq!(members, ARROWS.iter().map(|arrows| arrows.0).collect(), "packages without arrows");
    let mut graph = Graph::new();
    for (package, normal, dev) in ARROWS {
        let lines = sections(&root().join(package).join("Cargo.toml"));
        let line = lines.iter().flat_map(|(_, lines)| lines).find_map(|line| line.strip_prefix("name = \"")).unwrap();
        let imports = graph.entry(line.trim_end_matches('"').to_owned()).or_default();
        for (allowed, is_dev) in [(normal.to_vec(), false), ([normal, dev].concat(), true)] {
            let own = dependencies(package, is_dev).into_iter().filter(|name| name.starts_with("etendue"));
            for name in own {
                assert!(allowed.contains(&name.as_str()), "{package} must not depend on {name}");
                imports.insert(name);
            }
        }
    }
    for (package, imports) in &graph {
        println!("{package:20} → {}", imports.iter().cloned().collect::<Vec<_>>().join(", "));
    }
    assert!(graph["etendue-cli"].contains("etendue-laboratory"), "{graph:?}");
    assert_eq!(cycle(&graph), None);
    assert!(dependencies("tests/oracle", false).is_empty(), "the oracle must depend on nothing");
    let render: Vec<_> = [false, true].into_iter().flat_map(|dev| dependencies("render", dev)).collect();
    assert!(render.iter().any(|name| name == "image"), "{render:?}");
    for other in ["plotters", "csv", "statrs", "base64"] {
        assert!(!render.iter().any(|name| name == other), "the renderer must not depend on {other}");
    }
}

/// Files are where their modules are.
#[test]
fn modules_have_no_other_paths() {
    let all = sources(&[".rs"]);
    assert!(all.len() > 150, "{} sources", all.len());
    for path in all {
        let tokens = tokens(&fs::read_to_string(&path).unwrap());
        let has_path = tokens.windows(3).any(|three| *three == ["#", "[", "path"]);
        assert!(!has_path, "{}", path.display());
    }
}

#[test]
fn readme_is_short() {
    let words = fs::read_to_string(root().join("README.md")).unwrap().split_whitespace().count();
    println!("{words} words");
    assert!((300..=1000).contains(&words), "README.md has {words} words");
}

/// Names that were replaced by those of the field.
#[test]
fn old_names_are_gone() {
    let old = [
        "Sighting",
        "SphereCap",
        "below_one",
        "exponent_reciprocal",
        "product_error(",
        "fn density(&self)",
        ".density()",
        "fn probability(",
        ".probability",
        "::seen::",
        "mod seen",
        "fn built(",
        "mod exact",
        "enum Eye",
        "mod pupil",
        "mod laws",
        "mod subjects",
        "mod planted",
        "mod campaign",
        "uter product",
        "s told",
        "hat which",
        "where it is none",
        "Of each:",
    ];
    // whole words of the renderer alone: the laboratory has a `Way` of another kind
    let old_in_the_renderer = ["crate::accel", "Accel", "Soup", "with_way", "Way::"];
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let has_word = |line: &str, name: &str| {
        line.match_indices(name).any(|(at, _)| {
            let (before, after) = (&line[..at], &line[at + name.len()..]);
            !before.ends_with(is_word) && (name.ends_with(':') || !after.starts_with(is_word))
        })
    };
    assert!(has_word("a Way::B", "Way::") && has_word("Accel", "Accel") && !has_word("\"Accelerator\"", "Accel"));
    let mut found = Vec::new();
    for path in sources(&[".rs", ".md"]) {
        // this list, and the list of what changed
        if path.ends_with("architecture.rs") || path.ends_with("CHANGELOG.md") {
            continue;
        }
        let is_renderer = path.starts_with(root().join("render/src"));
        let text = fs::read_to_string(&path).unwrap();
        for (number, line) in text.lines().enumerate() {
            let everywhere = old.iter().filter(|name| line.contains(**name) && !line.contains("two_prod_error("));
            let here = old_in_the_renderer.iter().filter(|name| is_renderer && has_word(line, name));
            found.extend(everywhere.chain(here).map(|name| format!("{}:{}: {name}", path.display(), number + 1)));
        }
    }
    assert!(found.is_empty(), "old names:\n{}", found.join("\n"));
}
