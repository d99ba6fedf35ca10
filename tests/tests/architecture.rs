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

/// The lines of a source that are not comments.
fn code(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(str::to_owned).collect()
}

/// The modules of the core, and which of them each one names.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let source = root().join("core/src");
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in files(&source, &[".rs"]) {
        let relative = path.strip_prefix(&source).unwrap();
        let module = relative.iter().next().unwrap().to_string_lossy().trim_end_matches(".rs").to_owned();
        if module == "lib" {
            continue;
        }
        let named = all.entry(module.clone()).or_default();
        for line in code(&path) {
            for part in line.split("crate::").skip(1) {
                let name: String = part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                assert!(!name.is_empty(), "{}: `{line}` hides which modules it names", path.display());
                if name != module {
                    named.insert(name);
                }
            }
        }
    }
    all
}

/// A path from a module back to itself, if there is one.
fn cycle(imports: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    fn search(
        imports: &BTreeMap<String, BTreeSet<String>>,
        path: &mut Vec<String>,
        done: &mut BTreeSet<String>,
    ) -> Option<Vec<String>> {
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

#[test]
fn modules_of_the_core_import_one_way() {
    let imports = imports();
    for (module, named) in &imports {
        println!("{module:10} → {}", named.iter().cloned().collect::<Vec<_>>().join(", "));
    }
    assert!(imports.len() > 10 && imports["light"].contains("spherical"), "the sources were not found: {imports:?}");
    assert_eq!(cycle(&imports), None, "modules import each other");
    // the search finds one
    let mut planted = imports;
    planted.get_mut("real").unwrap().insert("light".to_owned());
    assert!(cycle(&planted).is_some());
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
        "is told",
        "hat which",
        "where it is none",
        "Of each:",
    ];
    let mut found = Vec::new();
    for folder in
        ["core", "render/src", "render/tests", "tests/src", "tests/tests", "benches", "fuzz/fuzz_targets", ".ci"]
    {
        for path in files(&root().join(folder), &[".rs", ".md"]) {
            // this list, and the list of what changed
            if path.ends_with("architecture.rs") || path.ends_with("CHANGELOG.md") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            for (number, line) in text.lines().enumerate() {
                let is_old = |name: &&&str| line.contains(**name) && !line.contains("two_prod_error(");
                found
                    .extend(old.iter().filter(is_old).map(|name| format!("{}:{}: {name}", path.display(), number + 1)));
            }
        }
    }
    assert!(found.is_empty(), "old names:\n{}", found.join("\n"));
}
