//! The list of lights and techniques for the page, from that of the core.

use serde_json::{Value, json};

/// The lights of `etendue::techniques!` as JSON. The sampler of another light gets its name and size from there.
macro_rules! list {
    ($(
        $(#[doc = $light_doc:literal])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[doc = $field_doc:literal])* $field:ident as $argument:ident: $kind:ident,)+
        } $(reflected { $($lobe:tt)* })? by $default:literal {
            $(
                $(#[doc = $doc:literal])* $sampler:ident $([$n:literal])? $(= $sampler_c:ident, $name:ident[$size:literal])?:
                    $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        /// Samplers: type, name in C, and how many numbers they consist of.
        const SAMPLERS: &[(&str, &str, usize)] = &[$($($((stringify!($sampler), stringify!($name), $size),)?)+)+];

        /// Each light: its name, documentation, fields and techniques, and which of them is the default.
        pub(crate) fn lights() -> Value {
            json!([$({
                "name": stringify!($light),
                "about": text(&[$($light_doc),*]),
                "default": $default,
                "fields": [$({
                    "name": stringify!($field),
                    "kind": stringify!($kind),
                    "about": text(&[$($field_doc),*]),
                }),+],
                "techniques": [$({
                    "by": stringify!($by),
                    "function": sampler(stringify!($sampler)).1,
                    "numbers": sampler(stringify!($sampler)).2,
                    "place": stringify!($place),
                    "about": text(&[$($doc),*]),
                }),+],
            }),+])
        }
    };
}
etendue::techniques!(list! {});

fn sampler(name: &str) -> (&'static str, &'static str, usize) {
    *SAMPLERS.iter().find(|sampler| sampler.0 == name).expect("the list names the sampler of each technique")
}

/// The lines of a documentation comment as one paragraph.
fn text(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

/// The functions of the C interface that the page calls.
pub(crate) fn functions(lights: &Value) -> Vec<String> {
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut names: Vec<String> =
        ["owen_sobol", "independent", "stratified"].map(|s| format!("etendue_{s}_pairs")).into();
    for warp in ["uniform_hemisphere", "cosine_hemisphere"] {
        names.extend(["sample", "pdf", "invert"].map(|what| format!("etendue_{warp}_{what}_batch")));
    }
    for light in list(lights) {
        for technique in list(&light["techniques"]) {
            let function = word(&technique["function"]);
            let what = ["prepare", "sample_batch", "pdf_batch", "invert_batch"];
            names.extend(what.map(|what| format!("etendue_{function}_{what}")));
        }
    }
    names.sort();
    names.dedup();
    names
}
