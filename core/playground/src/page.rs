//! Joins the sources of the page into one file.

use base64::Engine;
use serde_json::Value;

const HTML: &str = include_str!("../page/index.html");
const STYLE: &str = include_str!("../page/style.css");
/// The scripts, in the order in which they use each other.
const SCRIPTS: [&str; 16] = [
    include_str!("../page/vector.js"),
    include_str!("../page/library.js"),
    include_str!("../page/lights.js"),
    include_str!("../page/presets.js"),
    include_str!("../page/shapes.js"),
    include_str!("../page/closed.js"),
    include_str!("../page/textbook.js"),
    include_str!("../page/estimates.js"),
    include_str!("../page/canvas.js"),
    include_str!("../page/maps.js"),
    include_str!("../page/scene.js"),
    include_str!("../page/charts.js"),
    include_str!("../page/lecture.js"),
    include_str!("../page/controls.js"),
    include_str!("../page/state.js"),
    include_str!("../page/main.js"),
];

/// Compressed bytes.
pub(crate) fn gzip(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut packed = Vec::new();
    zopfli::compress(zopfli::Options::default(), zopfli::Format::Gzip, bytes, &mut packed)
        .map_err(|e| e.to_string())?;
    Ok(packed)
}

/// The page, with the library as text, since a page in a folder may not load other files.
pub(crate) fn join(lights: &Value, warps: &Value, packed: &[u8]) -> String {
    // one scope for all scripts, which declare nothing for the page but what the last one says
    let lists = format!("const LIGHTS = {lights};\nconst WARPS = {warps};");
    let script = format!("\"use strict\";\n(() => {{\n{lists}\n{}\n}})();", SCRIPTS.join("\n"));
    let library = base64::engine::general_purpose::STANDARD.encode(packed);
    let parts = [("/*style*/", STYLE), ("/*script*/", &script), ("/*library*/", &library)];
    parts.into_iter().fold(HTML.to_owned(), |page, (mark, part)| page.replacen(mark, part, 1))
}
