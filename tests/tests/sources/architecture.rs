//! What the sources themselves must keep: imports go one way, manifests are whole, and documents are short.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All files below a folder whose name ends with one of the given endings.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        // links lead to files that are elsewhere, too
        if path.is_dir() && !path.is_symlink() {
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

type Module = Vec<String>;

/// The paths from the root of the crate that a module names by `crate::`, `super::` or `self::`, outside of its tests and of macros, and
/// whether one of its modules has the attribute `path`.
struct Named<'m> {
    module: &'m [String],
    paths: Vec<Module>,
    has_path: bool,
}

impl Named<'_> {
    /// Adds a path, if it begins at the root of the crate or at this module.
    fn take(&mut self, path: &[String]) {
        let start = match path[0].as_str() {
            "crate" => Vec::new(),
            "super" => self.module[..self.module.len() - 1].to_vec(),
            "self" if path.len() > 1 => self.module.to_vec(),
            _ => return,
        };
        let add = |mut module: Module, part: &String| {
            match part.as_str() {
                "super" => drop(module.pop()),
                "self" => {}
                _ => module.push(part.clone()),
            }
            module
        };
        self.paths.push(path[1..].iter().fold(start, add));
    }
    fn tree(&mut self, tree: &syn::UseTree, mut prefix: Module) {
        match tree {
            syn::UseTree::Path(path) => {
                prefix.push(path.ident.to_string());
                self.tree(&path.tree, prefix);
            }
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| self.tree(tree, prefix.clone())),
            syn::UseTree::Name(syn::UseName { ident }) | syn::UseTree::Rename(syn::UseRename { ident, .. }) => {
                prefix.push(ident.to_string());
                self.take(&prefix);
            }
            syn::UseTree::Glob(_) => self.take(&prefix),
        }
    }
}

impl<'ast> Visit<'ast> for Named<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let attributes = match item {
            syn::Item::Mod(item) => &item.attrs,
            syn::Item::Fn(item) => &item.attrs,
            syn::Item::Use(item) => &item.attrs,
            _ => return visit::visit_item(self, item),
        };
        self.has_path |= attributes.iter().any(|attribute| attribute.path().is_ident("path"));
        let is_test = |attribute: &syn::Attribute| matches!(&attribute.meta, syn::Meta::List(list) if list.path.is_ident("cfg") && list.tokens.to_string() == "test");
        if !attributes.iter().any(is_test) {
            visit::visit_item(self, item);
        }
    }
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.tree(&item.tree, Vec::new());
    }
    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.take(&path.segments.iter().map(|segment| segment.ident.to_string()).collect::<Vec<_>>());
        visit::visit_path(self, path);
    }
    // exported macros are at the root, wherever they are written
    fn visit_macro(&mut self, _: &'ast syn::Macro) {}
    // visibility is no import
    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}
}

fn named<'m>(text: &str, module: &'m [String]) -> Named<'m> {
    let mut named = Named { module, paths: Vec::new(), has_path: false };
    named.visit_file(&syn::parse_file(text).unwrap_or_else(|error| panic!("{}: {error}", module.join("::"))));
    named
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
        for path in named(text, module).paths {
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

/// How far the modules of a package must import one way.
#[derive(Clone, Copy, PartialEq)]
enum Order {
    /// It has one module, or those of a test.
    None,
    /// Its own modules must. In the core and the properties, the file of a folder has the traits and types that all its modules share, so they
    /// import it.
    Top,
    /// So must those in its folders.
    All,
}

/// All packages of the workspace, each after those that it may use.
const PACKAGES: [(&str, Order); 23] = [
    ("tests/oracle", Order::All),
    ("core", Order::Top),
    ("core/visible", Order::All),
    ("core/batch", Order::All),
    ("core/c", Order::All),
    ("core/python", Order::None),
    ("core/shader/device", Order::None),
    ("core/playground", Order::All),
    ("tests/judge", Order::Top),
    ("core/shader", Order::All),
    ("tests/bits", Order::All),
    ("tests/proof", Order::None),
    ("tests", Order::None),
    ("render", Order::All),
    ("render/scene", Order::All),
    ("render/bits", Order::None),
    ("render/laboratory", Order::All),
    ("render/cli", Order::All),
    ("render/tests", Order::None),
    ("benches/routines", Order::All),
    ("benches", Order::None),
    ("fuzz/bodies", Order::None),
    ("fuzz", Order::None),
];

#[test]
fn modules_import_one_way() {
    for (package, order) in PACKAGES.into_iter().filter(|(_, order)| *order != Order::None) {
        let levels = levels(package);
        for (level, graph) in levels.into_iter().filter(|(level, _)| order == Order::All || level == package) {
            println!("{level}");
            for (module, imports) in &graph {
                println!("    {module:16} → {}", imports.iter().cloned().collect::<Vec<_>>().join(", "));
            }
            assert!(graph.len() > 1, "{level} has no modules");
            assert_eq!(cycle(&graph), None, "modules of {level} import each other");
            // any import in the other direction is found
            for (from, to) in graph.iter().flat_map(|(from, imports)| imports.iter().map(move |to| (from, to))) {
                let mut planted = graph.clone();
                planted.get_mut(to).unwrap().insert(from.clone());
                assert!(cycle(&planted).is_some(), "{level}: {to} → {from}");
            }
        }
    }
}

/// Imports that are known to exist are found, so that the other test cannot pass because it reads nothing.
#[test]
fn imports_are_found() {
    let mut packages = BTreeMap::new();
    for (package, level, from, to) in [
        ("core", "core", "light", "reflection"),
        ("core/c", "core/c", "technique", "list"),
        ("core/visible", "core/visible", "prove", "shaft"),
        ("render", "render", "drive", "estimate"),
        ("render", "render::film", "image", "pixels"),
        ("render", "render::bvh", "bvh", "stream"),
        ("render/laboratory", "render/laboratory::chart", "report", "outcome"),
        ("tests/judge", "tests/judge", "suite", "properties"),
    ] {
        let levels = packages.entry(package).or_insert_with(|| levels(package));
        assert!(levels[level][from].contains(to), "{level}: {from} → {to}");
    }
    let text = r##"
        //! [`a`](crate::comment)
        use crate::{a::{self, B}, c::*, d as e};
        use super::super::f;
        pub(in crate::visible) fn g<'x>(x: &'x str) -> char { super::h::<u8>("crate::text"); '"' }
        #[cfg(test)]
        mod tests { use super::super::tested; }
        fn i() { self::j() /* crate::block */ }
    "##;
    let path = |text: &str| text.split("::").map(str::to_owned).collect::<Vec<_>>();
    let found: Vec<_> = named(text, &path("m::n")).paths.iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["a", "a::B", "c", "d", "f", "m::h", "m::n::j"]);
    assert!(named("#[path = \"other.rs\"] mod module;", &path("m::n")).has_path);
}

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

/// The folders of the packages that each one uses by the table of the architecture; and those that only its tests, benchmarks and examples use.
fn arrows() -> BTreeMap<String, [BTreeSet<String>; 2]> {
    let text = fs::read_to_string(root().join("render/ARCHITECTURE.md")).unwrap();
    let folders = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<BTreeSet<_>>();
    let mut arrows = BTreeMap::new();
    for row in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<_> = row.split('|').collect();
        let (normal, dev) = cells[3].split_once('(').unwrap_or((cells[3], ""));
        arrows.extend(folders(cells[1]).into_iter().map(|folder| (folder, [normal, dev].map(folders))));
    }
    arrows
}

#[test]
fn packages_depend_one_way() {
    let [_, workspace, ..] = &sections(&root().join("Cargo.toml"))[..] else { panic!("no workspace") };
    let lines = workspace.1.iter().skip_while(|line| *line != "members = [").take_while(|line| *line != "]");
    let members: BTreeSet<_> = lines.flat_map(|line| line.split('"').skip(1).step_by(2)).collect();
    assert_eq!(members, PACKAGES.iter().map(|package| package.0).collect());
    let name = |package: &str| {
        let lines = sections(&root().join(package).join("Cargo.toml")).into_iter().flat_map(|(_, lines)| lines);
        lines.filter_map(|line| Some(line.strip_prefix("name = \"")?.trim_end_matches('"').to_owned())).next().unwrap()
    };
    let names = PACKAGES.map(|(package, _)| name(package));
    let arrows = arrows();
    assert_eq!(arrows.len(), PACKAGES.len());
    for (k, (package, _)) in PACKAGES.into_iter().enumerate() {
        for is_dev in [false, true] {
            let own = dependencies(package, is_dev).into_iter().filter(|name| name.starts_with("etendue"));
            let place = |other: String| names[..k].iter().position(|name| *name == other);
            let folders = own.map(|other| match place(other.clone()) {
                Some(place) => PACKAGES[place].0.to_owned(),
                None => panic!("{package} must not depend on {other}"),
            });
            assert_eq!(folders.collect::<BTreeSet<_>>(), arrows[package][usize::from(is_dev)], "{package}, {is_dev}");
        }
    }
    assert!(dependencies("tests/oracle", false).is_empty(), "the oracle must depend on nothing");
    let scene = dependencies("render/scene", false);
    assert!(scene.iter().any(|name| name == "image"), "{scene:?}");
    let render = dependencies("render", false);
    for other in ["clap", "csv", "etendue-scene", "image", "indicatif"] {
        assert!(!render.iter().any(|name| name == other), "the renderer must not depend on {other}");
    }
}

/// The packages that go to a registry.
const PUBLISHED: [&str; 4] = ["core", "core/batch", "core/shader", "core/visible"];

/// Packages that hosts use say all that a registry shows, and the others are not published.
#[test]
fn manifests_are_whole() {
    for (package, _) in PACKAGES {
        let sections = sections(&root().join(package).join("Cargo.toml"));
        let lines = &sections.iter().find(|(name, _)| name == "package").unwrap().1;
        let value = |key: &str| lines.iter().find_map(|line| line.strip_prefix(&format!("{key} = ")));
        let is_inherited = |key: &str| lines.contains(&format!("{key}.workspace = true"));
        for key in ["version", "edition", "rust-version", "license"] {
            assert!(is_inherited(key), "{package}: {key}");
        }
        if !PUBLISHED.contains(&package) {
            assert_eq!(value("publish"), Some("false"), "{package}");
            continue;
        }
        // one place for the owner to fill in
        assert!(value("publish").is_none() && is_inherited("repository"), "{package}");
        for (key, count) in [("keywords", 3..=5), ("categories", 2..=5)] {
            let found = value(key).unwrap_or_else(|| panic!("{package}: {key}")).matches('"').count() / 2;
            assert!(count.contains(&found), "{package} has {found} {key}");
        }
        let name = value("name").unwrap().trim_matches('"');
        assert_eq!(value("documentation"), Some(&*format!("\"https://docs.rs/{name}\"")), "{package}");
        assert!(value("description").is_some() && value("include").is_some(), "{package}");
        assert!(sections.iter().any(|(name, _)| name == "package.metadata.docs.rs"), "{package}");
        // what a registry shows has nothing beside it
        let readme = fs::read_to_string(root().join(package).join(value("readme").unwrap().trim_matches('"'))).unwrap();
        let links = readme.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
        assert!(links.clone().count() > 0, "{package} has no link");
        for link in links {
            assert!(link.starts_with("https://") || link.starts_with('#'), "{package}: {link}");
        }
        assert!(
            !readme.contains("cargo run -p") && !readme.contains(" -p etendue"),
            "{package}: a command of the workspace"
        );
        for file in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(root().join(package).join(file).is_file(), "{package} has no {file}");
        }
    }
}

/// Files are where their modules are.
#[test]
fn modules_have_no_other_paths() {
    let all = sources(&[".rs"]);
    assert!(all.len() > 150, "{} sources", all.len());
    for path in all {
        let text = fs::read_to_string(&path).unwrap();
        // parsing takes longer than this, and few files have something of the kind
        let may_have = text.split_whitespace().collect::<String>().contains("path=\"");
        let module = [path.display().to_string()];
        assert!(!may_have || !named(&text, &module).has_path, "{}", path.display());
    }
}

#[test]
fn documents_are_short() {
    let words = |path: &Path| fs::read_to_string(path).unwrap().split_whitespace().count();
    let more = ["README.md", "fuzz/README.md"].map(|file| root().join(file));
    let all = [&more[..], &sources(&[".md"])].concat();
    let [readme, sum]: [usize; 2] = [words(&more[0]), all.iter().map(|path| words(path)).sum()];
    // what hosts are promised, what judges other renderers, and pages that are made of tables have words of their own
    let own = [
        ("benches/RESULTS.md", 5000),
        ("core/README.md", 420),
        ("core/POLICIES.md", 400),
        ("core/CHANGELOG.md", 150),
        ("core/visible/README.md", 520),
        ("render/bits/CHANGELOG.md", 150),
        ("tests/judge/FIELD.md", 600),
        ("tests/judge/README.md", 520),
        ("render/formats/gltf.md", 3000),
        ("render/formats/pbrt.md", 5000),
    ];
    let own = own.map(|(file, most)| (file, words(&root().join(file)), most));
    let others = sum - own.iter().map(|(_, words, _)| words).sum::<usize>();
    println!("README.md has {readme} words, {own:?}, all others {others}");
    assert!((300..=1000).contains(&readme) && own.iter().all(|(_, words, most)| words <= most) && others <= 9200);
}

/// The README of the tests lists every ignored test, and no others.
#[test]
fn ignored_tests_are_listed() {
    let mut found = BTreeSet::new();
    for path in sources(&[".rs"]) {
        let text = fs::read_to_string(path).unwrap();
        for after in text.split("\n#[ignore").skip(1) {
            found.extend(after.split_once("fn ").map(|(_, rest)| rest.split('(').next().unwrap().to_owned()));
        }
    }
    let text = fs::read_to_string(root().join("tests/README.md")).unwrap();
    let rows =
        text.lines().skip_while(|line| !line.starts_with("| test |")).skip(2).take_while(|line| line.starts_with('|'));
    let first =
        |row: &str| row.split('|').nth(1).unwrap().split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    let mut listed: BTreeSet<_> = rows.flat_map(first).collect();
    // each of its functions is a test of a macro
    assert!(listed.remove("every_float"));
    assert_eq!(listed, found);
}

/// The names in a folder of `fuzz`, without endings.
fn fuzz_names(folder: &str) -> BTreeSet<String> {
    let all = fs::read_dir(root().join("fuzz").join(folder)).unwrap();
    all.map(|entry| entry.unwrap().file_name().into_string().unwrap().split('.').next().unwrap().to_owned()).collect()
}

#[test]
fn every_fuzz_target_has_seeds_and_a_group_and_nothing_else_has() {
    let targets = fuzz_names("fuzz_targets");
    assert_eq!(fuzz_names("seeds"), targets);
    let corpora = fuzz_names("corpora");
    assert!(corpora.is_subset(&targets), "no targets: {:?}", corpora.difference(&targets));
    let campaign = fs::read_to_string(root().join("fuzz/campaign")).unwrap();
    let groups = campaign.split_once("groups=(\n").unwrap().1.split_once("\n)").unwrap().0;
    let grouped = groups.lines().flat_map(|line| line.trim().trim_matches('"').split_once(": ").unwrap().1.split(' '));
    assert_eq!(grouped.map(str::to_owned).collect::<BTreeSet<_>>(), targets);
}
