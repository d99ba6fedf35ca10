//! The modules of the laboratory import one way: a module may use those below it, and never, by any detour, one that uses it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

/// The paths of a use tree such as `a::{b, c::{d, e}}`.
fn expanded(tree: &str) -> Vec<String> {
    let Some((head, rest)) = tree.split_once('{') else { return vec![tree.trim().to_owned()] };
    let (mut depth, mut part, mut parts) = (0, String::new(), Vec::new());
    for c in rest.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth < 0 || depth == 0 && c == ',' {
            parts.push(std::mem::take(&mut part));
        } else {
            part.push(c);
        }
        if depth < 0 {
            break;
        }
    }
    parts.iter().flat_map(|p| expanded(p)).map(|p| format!("{}{p}", head.trim())).collect()
}

/// The paths from the crate's root that a module names by `crate::` or `super::`.
fn named(text: &str, module: &[String]) -> Vec<Vec<String>> {
    let lines = text.lines().take_while(|l| *l != "#[cfg(test)]").filter(|l| !l.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join(" ");
    let mut all = Vec::new();
    for (start, up) in [("crate::", module.len()), ("super::", 1)] {
        for part in code.split(start).skip(1) {
            let end = part.find(|c: char| !(c.is_alphanumeric() || "_:{},* ".contains(c))).unwrap_or(part.len());
            // outside of a use tree, a path ends at the first character that is not part of it
            let plain = part.find(|c: char| !(c.is_alphanumeric() || "_:{".contains(c))).unwrap_or(part.len());
            let tree = if part[..plain].contains('{') { &part[..end] } else { &part[..plain] };
            for path in expanded(tree) {
                let above = module[..module.len() - up].iter().cloned();
                all.push(above.chain(path.split("::").map(|s| s.trim().to_owned())).collect());
            }
        }
    }
    all
}

/// Each module with those that it names, and its submodules.
fn imports() -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let module = |path: &Path| -> Vec<String> {
        let relative = path.strip_prefix(&root).unwrap().with_extension("");
        relative.iter().map(|part| part.to_string_lossy().into_owned()).filter(|part| part != "lib").collect()
    };
    let files = sources(&root).into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs"));
    let files: BTreeMap<_, _> = files.map(|path| (module(&path), fs::read_to_string(path).unwrap())).collect();
    let one = |(module, text): (&Vec<String>, &String)| {
        let paths = if module.is_empty() { Vec::new() } else { named(text, module) };
        let known =
            |path: &Vec<String>| (0..=path.len()).rev().map(|n| path[..n].to_vec()).find(|p| files.contains_key(p));
        let mut uses: BTreeSet<_> = paths.iter().filter_map(known).filter(|p| p != module).collect();
        uses.extend(files.keys().filter(|f| f.len() == module.len() + 1 && f.starts_with(module)).cloned());
        (module.clone(), uses)
    };
    files.iter().map(one).collect()
}

/// The modules that remain when those that use none of the others are taken away, again and again.
fn circular(mut imports: BTreeMap<Vec<String>, BTreeSet<Vec<String>>>) -> Vec<String> {
    loop {
        let all: BTreeSet<_> = imports.keys().cloned().collect();
        let before = imports.len();
        imports.retain(|_, uses| !uses.is_disjoint(&all));
        if imports.len() == before {
            return imports.keys().map(|m| m.join("::")).collect();
        }
    }
}

#[test]
fn modules_import_one_way() {
    let mut imports = imports();
    let path = |text: &str| text.split("::").map(str::to_owned).collect::<Vec<_>>();
    for (module, uses) in &imports {
        println!("{} → {}", module.join("::"), uses.iter().map(|u| u.join("::")).collect::<Vec<_>>().join(", "));
    }
    assert!(imports[&path("chart::report")].contains(&path("chart::outcome")), "{imports:?}");
    assert!(imports[&path("figure::convergence")].contains(&path("chart")), "{imports:?}");
    assert_eq!(circular(imports.clone()), Vec::<String>::new());
    // one import in the other direction is found
    imports.get_mut(&path("chart::stats")).unwrap().insert(path("chart"));
    assert!(circular(imports).contains(&"chart::stats".to_owned()));
}
