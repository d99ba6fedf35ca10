//! The parts of the bindings that no macro can expand are what the core's list of techniques gives. `WRITE=1 cargo test -p etendue-tests
//! bindings` writes them anew.

use etendue::listed::light::{ENTRIES, Entry, With};
use etendue::listed::warp::{self, WarpEntry};
use std::fmt::Write;
use std::path::Path;

/// A light with its techniques.
struct Light {
    name: &'static str,
    /// Its fields by name, argument and kind.
    fields: Vec<[&'static str; 3]>,
    default: &'static str,
    techniques: &'static [Entry],
}

/// The name of a technique in words that begin with capitals.
fn class(technique: &Entry) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    technique.name.split('_').map(capital).collect()
}
/// How the functions of a technique are called beside the point: the number of the macro in the test of C, and the macro of C and C++.
fn kind(technique: &Entry) -> (u8, &'static str) {
    match technique.with() {
        With::Normal => (1, "ON_SURFACE"),
        With::Reflection => (2, "REFLECTED"),
        With::Nothing => (0, "ANYWHERE"),
    }
}

fn lights() -> Vec<Light> {
    let light = |techniques: &'static [Entry]| {
        let Entry { light: name, fields, default, .. } = techniques[0];
        let fields = fields.iter().map(|field| [field.name, field.argument, field.kind]).collect();
        Light { name, fields, default, techniques }
    };
    const { &ENTRIES }.chunk_by(|a, b| a.light == b.light).map(light).collect()
}

/// The constructors and the methods of a light in C++.
fn cpp_light(light: &Light, out: &mut String) -> std::fmt::Result {
    let Light { name, fields, .. } = light;
    writeln!(out, "// Etendue{name} with its constructors and techniques.")?;
    writeln!(out, "struct {name} : Etendue{name} {{")?;
    if fields[0][2] == "corners" {
        out.push_str(
            "    // Corners beyond the eighth are left out; without corners it is a point, whose pdf is 0.
    Polygon(const Vec3* given, size_t count) : EtenduePolygon{} {
        for (size_t i = 0; i < 8 && count > 0; i++) {
            const Vec3 corner = given[i < count ? i : count - 1];
            for (int k = 0; k < 3; k++) corners[i][k] = corner[k];
        }
    }
    template <size_t N>
    Polygon(const Vec3 (&given)[N]) : Polygon(given, N) {
        static_assert(N >= 3 && N <= 8, \"a polygon has 3 to 8 corners\");
    }
",
        );
    } else {
        let list = |f: &dyn Fn(&[&str; 3]) -> String| fields.iter().map(f).collect::<Vec<_>>().join(", ");
        let arguments = list(&|[field, _, kind]| match *kind {
            "number" => format!("float {field}_"),
            _ => format!("Vec3 {field}_"),
        });
        let values = list(&|[field, _, kind]| match *kind {
            "number" => format!("{field}_"),
            _ => format!("{{{field}_.x, {field}_.y, {field}_.z}}"),
        });
        writeln!(out, "    {name}({arguments}) : Etendue{name}{{{values}}} {{}}")?;
        if fields.iter().any(|[_, _, kind]| *kind == "vertex") {
            let arguments = list(&|[_, argument, _]| format!("Vec3 {argument}_"));
            let first = fields[0][1];
            let values = list(&|[_, argument, kind]| match *kind {
                "vertex" => format!("{{{0}_.x - {first}_.x, {0}_.y - {first}_.y, {0}_.z - {first}_.z}}", argument),
                _ => format!("{argument}_"),
            });
            writeln!(out, "    static {name} from_vertices({arguments}) {{ return {{{values}}}; }}")?;
        }
    }
    for technique in light.techniques {
        let (class, by) = (class(technique), technique.by);
        let argument = match technique.place {
            [] => {
                let at = "// The same at every point.";
                writeln!(out, "    {at}\n    {class} {by}() const {{ return {{*this, Vec3()}}; }}")?;
                continue;
            }
            [_] => ("", ""),
            [_, "n"] => (", Vec3 n", ", n"),
            _ => (", const EtendueReflection& reflection", ", reflection"),
        };
        writeln!(out, "    {class} {by}(Vec3 at{}) const {{ return {{*this, at{}}}; }}", argument.0, argument.1)?;
    }
    // of a patch, and of lights without a surface, it is never true
    if light.techniques[0].by == "by_area" && light.techniques.len() > 1 {
        let number = light.techniques[0].name.to_uppercase();
        out.push_str("    // Whether a point is on the light, to within its rounding: see etendue_on_surface.\n");
        writeln!(out, "    bool on_surface(Vec3 at) const {{")?;
        writeln!(out, "        const float p[3] = {{at.x, at.y, at.z}};")?;
        writeln!(out, "        return etendue_on_surface(ETENDUE_TECHNIQUE_{number}, this, p) != 0;\n    }}")?;
    }
    out.push_str("};\n");
    Ok(())
}

fn cpp() -> String {
    let mut out = String::new();
    for light in lights() {
        for technique in light.techniques {
            let (_, kind) = kind(technique);
            let Entry { sampler, name, .. } = technique;
            writeln!(out, "ETENDUE_{kind}({}, {sampler}, {}, etendue_{name})", class(technique), light.name).unwrap();
        }
    }
    out.push('\n');
    for Light { name, .. } in lights() {
        writeln!(out, "using {name}Columns = LightColumns<Etendue{name}Columns>;").unwrap();
    }
    out.push('\n');
    lights().iter().for_each(|light| cpp_light(light, &mut out).unwrap());
    out
}

/// The typed functions of C.
fn c_typed() -> String {
    let mut out = String::new();
    for light in lights() {
        for technique in light.techniques {
            let ((_, kind), Entry { sampler, name, .. }) = (kind(technique), technique);
            writeln!(out, "ETENDUE_{kind}_({name}, {}, {}, {sampler})", name.to_uppercase(), light.name).unwrap();
        }
    }
    out
}

/// The structs that the header has, although no function names them.
fn c_structs() -> String {
    let mut out = String::new();
    for light in lights() {
        let samplers = light.techniques.iter().filter(|technique| technique.is_own).map(|technique| technique.sampler);
        let structs = samplers.map(|sampler| format!("\"Etendue{sampler}\",")).collect::<Vec<_>>();
        writeln!(out, "    \"Etendue{0}\", \"Etendue{0}Columns\", {1}", light.name, structs.join(" ")).unwrap();
    }
    out
}

/// All techniques as a macro of the C test.
fn c() -> String {
    let mut rows = String::from("#define TECHNIQUES(T)");
    for light in lights() {
        for technique in light.techniques {
            let (kind, _) = kind(technique);
            write!(rows, " \\\n    T({}, {}, {}, {kind})", technique.sampler, light.name, technique.name).unwrap();
        }
    }
    rows + "\n"
}

/// The type of a light in Python.
fn python_light(light: &Light, out: &mut String) -> std::fmt::Result {
    let Light { name, fields, .. } = light;
    let arguments: Vec<_> = fields.iter().map(|[_, argument, _]| format!("{argument}: ArrayLike")).collect();
    writeln!(out, "@final\nclass {name}:")?;
    writeln!(out, "    def __new__(cls, {}) -> {name}: ...", arguments.join(", "))?;
    for Entry { by, place, .. } in light.techniques {
        let kind = |name| match name {
            "reflection" => "Reflection",
            _ => "ArrayLike",
        };
        let place: String = place.iter().map(|&name| format!(", {name}: {}", kind(name))).collect();
        writeln!(out, "    def {by}(self{place}) -> Sampler: ...")?;
    }
    writeln!(out, "    def on_surface(self, p: ArrayLike) -> bool: ...")?;
    let by: Vec<_> = light.techniques.iter().map(|technique| format!("\"{}\"", &technique.by[3..])).collect();
    let functions =
        [("sample", "u", "Samples"), ("hit", "w", "Samples"), ("pdf", "w", "_F32"), ("invert", "w", "_F32")];
    for (function, at, result) in functions {
        writeln!(out, "    @staticmethod\n    def {function}_each(")?;
        arguments.iter().try_for_each(|argument| writeln!(out, "        {argument},"))?;
        writeln!(
            out,
            "        *,\n        p: ArrayLike,\n        {at}: ArrayLike,\n        n: ArrayLike | None = None,"
        )?;
        for name in ["alpha", "view"] {
            writeln!(out, "        {name}: ArrayLike | None = None,")?;
        }
        writeln!(out, "        by: Literal[{}] = \"{}\",", by.join(", "), light.default)?;
        if result == "Samples" {
            writeln!(out, "        fields: _Fields | None = None,")?;
        }
        writeln!(out, "        out: {result} | None = None,\n    ) -> {result}: ...")?;
    }
    out.push('\n');
    Ok(())
}

/// The names that Python's `import *` finds.
fn python_names() -> String {
    lights().iter().map(|Light { name, .. }| format!("    \"{name}\",\n")).collect()
}

fn python() -> String {
    let mut out = String::new();
    lights().iter().for_each(|light| python_light(light, &mut out).unwrap());
    out
}

/// A line for each warp without parameters.
fn fixed_warps(line: impl Fn(&WarpEntry) -> String) -> String {
    warp::ENTRIES.iter().filter(|warp| warp.numbers == 0).map(line).collect()
}
fn cpp_warps() -> String {
    fixed_warps(|warp| {
        let WarpEntry { warp, name, coordinates, doc, .. } = warp;
        let doc = doc.join(" ").replace('π', "pi").replace('≥', ">=").replace("  ", " ");
        format!("//{doc}\nETENDUE_FIXED_WARP({warp}, etendue_{name}, {coordinates})\n")
    })
}
fn c_warps() -> String {
    let rows = fixed_warps(|warp| format!(" \\\n    W({}, {})", warp.name, warp.coordinates));
    format!("#define WARPS_WITHOUT(W){rows}\n")
}
fn python_warps() -> String {
    fixed_warps(|WarpEntry { warp, .. }| {
        format!("@final\nclass {warp}(Warp):\n    def __new__(cls) -> {warp}: ...\n\n")
    })
}

/// Compares the part of a file between two marks, or writes it.
fn check(file: &str, mark: &str, part: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let begin = format!("{mark} from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings\n");
    let end = format!("{mark} end of what is from the list\n");
    let (before, rest) = text.split_once(&begin).unwrap_or_else(|| panic!("{file} has no line {begin:?}"));
    let (old, after) = rest.split_once(&end).unwrap_or_else(|| panic!("{file} has no line {end:?}"));
    if std::env::var("WRITE").is_ok() {
        std::fs::write(&path, [before, &begin, part, &end, after].concat()).unwrap();
        return;
    }
    let line = old.lines().zip(part.lines()).find(|(a, b)| a != b);
    assert!(old == part, "{file} is not what the list of techniques gives, beginning with {line:?}: {begin}");
}

#[test]
fn the_test_in_c_is_what_the_list_gives() {
    check("core/c/tests/test.c", "//", &c());
}
#[test]
fn the_header_of_c_is_what_the_list_gives() {
    check("core/c/include/etendue_typed.h", "//", &c_typed());
    check("core/c/cbindgen.toml", "    #", &c_structs());
}
#[test]
fn cpp_is_what_the_list_gives() {
    check("core/c/include/etendue.hpp", "//", &cpp());
}
#[test]
fn python_types_are_what_the_list_gives() {
    check("core/python/etendue.pyi", "#", &python());
    check("core/python/etendue.pyi", "    # lights", &python_names());
}
#[test]
fn warps_without_parameters_are_what_the_list_gives() {
    check("core/c/tests/test.c", "// warps", &c_warps());
    check("core/c/include/etendue.hpp", "// warps", &cpp_warps());
    check("core/python/etendue.pyi", "# warps", &python_warps());
    let names = fixed_warps(|WarpEntry { warp, .. }| format!("    \"{warp}\",\n"));
    check("core/python/etendue.pyi", "    # names of warps", &names);
}
