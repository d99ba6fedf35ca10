//! The list of lights and techniques for the page, from that of the core.

use etendue::listed::light::{ENTRIES, Entry, Field, With};
use etendue::listed::warp;
use serde_json::{Value, json};

/// Each light: its name, documentation, fields, and those of its techniques that the page shows, which take a point and at most a normal, with
/// their numbers in the C interface; and which of them is the default.
pub(crate) fn lights() -> Value {
    let technique = |entry: &Entry| {
        json!({
            "by": entry.by,
            "name": entry.name,
            "numbers": entry.numbers[1],
            "place": format!("({})", entry.place.join(", ")),
            "about": text(entry.doc),
            "technique": entry.index,
        })
    };
    let field = |field: &Field| json!({ "name": field.name, "kind": field.kind, "about": text(field.doc) });
    let light = |techniques: &[Entry]| {
        let shown = techniques.iter().filter(|entry| entry.with() != With::Reflection).map(technique);
        let Entry { light, light_doc, default, fields, .. } = techniques[0];
        json!({
            "name": light,
            "about": text(light_doc),
            "default": default,
            "fields": fields.iter().map(field).collect::<Vec<_>>(),
            "techniques": shown.collect::<Vec<_>>(),
        })
    };
    ENTRIES.chunk_by(|a, b| a.light == b.light).map(light).collect()
}

/// The numbers of warps in the C interface, by their names.
pub(crate) fn warps() -> Value {
    warp::ENTRIES.iter().map(|entry| (entry.name.to_owned(), json!(entry.index))).collect()
}

/// The lines of a documentation comment as one paragraph.
fn text(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

/// The functions of the C interface that the page calls.
pub(crate) const FUNCTIONS: [&str; 10] = [
    "etendue_prepare",
    "etendue_sample_batch",
    "etendue_pdf_batch",
    "etendue_invert_batch",
    "etendue_warp_sample_batch",
    "etendue_warp_pdf_batch",
    "etendue_warp_invert_batch",
    "etendue_owen_sobol_pairs",
    "etendue_independent_pairs",
    "etendue_stratified_pairs",
];
