//! Greatest errors, from the documentation of the core's types: a number stands in one place.

macro_rules! sources {
    ($($path:literal)+) => {
        &[$(include_str!(concat!("../documented/", $path))),+]
    };
}
/// The files whose types document an error; `documented` is the sources of the core, of which the package has its own.
const SOURCES: &[&str] = sources! {
    "light/cosine_warped.rs"
    "light/disk.rs"
    "light/disk/solid_angle.rs"
    "light/line.rs"
    "light/line/angle.rs"
    "light/line/projected.rs"
    "light/parallelogram.rs"
    "light/parallelogram/solid_angle.rs"
    "light/polygon.rs"
    "light/polygon/projected.rs"
    "light/polygon/solid_angle.rs"
    "light/rectangle.rs"
    "light/rectangle/solid_angle.rs"
    "light/sphere.rs"
    "light/sphere/projected.rs"
    "light/sphere/solid_angle.rs"
    "light/triangle.rs"
    "light/triangle/projected.rs"
    "light/triangle/solid_angle.rs"
    "reflection.rs"
    "warp/bilinear.rs"
    "warp/cone.rs"
    "warp/disk.rs"
    "warp/hemisphere.rs"
    "warp/linear.rs"
    "warp/octahedral.rs"
    "warp/patch.rs"
    "warp/triangle.rs"
    "warp/visible_normals.rs"
};

/// The documentation above the first line for which `is` holds.
fn documentation(source: &str, is: impl Fn(&str) -> bool) -> Option<Vec<&str>> {
    let lines: Vec<&str> = source.lines().map(str::trim).collect();
    let at = lines.iter().position(|line| is(line))?;
    let above = lines[..at].iter().rev().skip_while(|line| line.starts_with("#["));
    let mut lines: Vec<&str> = above.map_while(|line| line.strip_prefix("///")).map(str::trim).collect();
    lines.reverse();
    // an import may look like the definition
    (!lines.is_empty()).then_some(lines)
}

/// The item of a list that begins with these words.
fn item(lines: &[&str], begins: &str) -> Option<String> {
    let at = lines.iter().position(|line| line.strip_prefix("- ").is_some_and(|line| line.starts_with(begins)))?;
    let more = lines[at + 1..].iter().take_while(|line| !line.is_empty() && !line.starts_with("- "));
    Some([lines[at].trim_start_matches("- ")].into_iter().chain(more.copied()).collect::<Vec<_>>().join(" "))
}

/// Text without the marks of links.
fn plain(text: &str) -> String {
    let mut all = String::new();
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("[`") {
        let (name, after) = link.split_once("`]").unwrap_or((link, ""));
        all += before;
        all += name;
        rest = after.strip_prefix('(').and_then(|target| target.split_once(')')).map_or(after, |(_, after)| after);
    }
    all + rest
}

/// The item of the method of a light that the documentation of a prepared shape names.
fn of_named_method(lines: &[&str]) -> Option<String> {
    let (light, method) = lines.last()?.strip_prefix("[`")?.split_once("`]")?.0.split_once("::")?;
    let source = SOURCES.iter().find(|source| {
        source.contains(&format!("pub struct {light} {{")) || source.contains(&format!("pub struct {light}<"))
    })?;
    item(&documentation(source, |line| line.starts_with(&format!("pub fn {method}(")))?, "Greatest error")
}

/// What the core documents about the greatest error of a type and of those that it consists of, given its name with its path; or else of a
/// method that returns the type of this name.
pub(crate) fn greatest_error(type_name: &str, returned: &str) -> Option<String> {
    let shapes = type_name.split(['<', '>', ',', ' ']);
    let modules = ["etendue::light::", "etendue::warp::", "etendue::reflection::"];
    let shapes = shapes.filter(|name| modules.iter().any(|module| name.starts_with(module)));
    // that a sampler has one of these, the name of its type does not tell
    let warped = type_name.contains("::ByCosineWarp<").then_some("CosineWarped");
    let names: Vec<&str> = warped.into_iter().chain(shapes.filter_map(|name| name.rsplit("::").next())).collect();
    let is_struct = |line: &str, name: &str| {
        let rest = line.strip_prefix("pub struct ").and_then(|line| line.strip_prefix(name));
        rest.is_some_and(|rest| rest.starts_with(['<', ' ', ';'])) || line == format!("{name},")
    };
    let of_struct = |name: &&str| {
        let lines = SOURCES.iter().find_map(|source| documentation(source, |line| is_struct(line, name)))?;
        item(&lines, "Greatest error").or_else(|| of_named_method(&lines))
    };
    let is_method = |line: &str| line.starts_with("pub fn ") && line.contains(&format!("-> {returned}<"));
    let of_method = || SOURCES.iter().find_map(|source| documentation(source, is_method));
    let mut all: Vec<String> = names.iter().filter_map(of_struct).map(|text| plain(&text)).collect();
    if all.is_empty() {
        all.extend(of_method().and_then(|lines| item(&lines, "Greatest error")).map(|text| plain(&text)));
    }
    (!all.is_empty()).then(|| all.join(" "))
}
