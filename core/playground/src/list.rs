//! The list of lights and techniques for the page, from that of the core.

use serde_json::{Value, json};

/// The lights of `etendue::techniques!` as JSON. A sampler that another technique has as its own gets its size from there.
macro_rules! list {
    ($(
        $(#[doc = $light_doc:literal])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[doc = $field_doc:literal])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[doc = $doc:literal])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        /// Samplers, and how many numbers they consist of.
        const SAMPLERS: &[(&str, usize)] = &[$($($((stringify!($sampler), $size),)?)+)+];

        /// Each light: its name, documentation, fields and techniques, and which of them is the default.
        pub(crate) fn lights() -> Value {
            let mut number = 0;
            json!([$({
                "name": stringify!($light),
                "about": text(&[$($light_doc),*]),
                "default": $default,
                "fields": [$({
                    "name": stringify!($field),
                    "kind": stringify!($kind),
                    "about": text(&[$($field_doc),*]),
                }),+],
                "techniques": shown(&mut number, [$(json!({
                    "by": stringify!($by),
                    "name": stringify!($name),
                    "numbers": numbers(stringify!($sampler)),
                    "place": stringify!($place),
                    "about": text(&[$($doc),*]),
                })),+]),
            }),+])
        }
    };
}
etendue::techniques!(list! {});

/// The techniques that the page shows, with their numbers in the C interface: those that take a point and at most a normal.
fn shown<const N: usize>(number: &mut u32, techniques: [Value; N]) -> Vec<Value> {
    let numbered = techniques.into_iter().map(|mut technique| {
        technique["technique"] = json!(*number);
        *number += 1;
        technique
    });
    let takes = |technique: &Value| technique["place"].as_str().unwrap_or_default().to_owned();
    let is_shown = |place: String| !place.contains("reflection");
    numbered.filter(|technique| is_shown(takes(technique))).collect()
}

fn numbers(sampler: &str) -> usize {
    SAMPLERS.iter().find(|known| known.0 == sampler).expect("one technique has the sampler as its own").1
}

/// The numbers of warps in the C interface, by their names.
pub(crate) fn warps() -> Value {
    macro_rules! names {
        ($($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $name:ident: $coordinates:literal;)+) => {
            [$(stringify!($name)),+]
        };
    }
    let names = etendue::warps!(names! {});
    names.iter().enumerate().map(|(number, name)| ((*name).to_owned(), json!(number))).collect()
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
