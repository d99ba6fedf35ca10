//! The files of the page.

use super::http::Response;

const HTML: &str = include_str!("../../page/index.html");
const STYLE: &str = include_str!("../../page/style.css");
/// The scripts, in the order in which they use each other, in one scope.
const SCRIPT: &str = concat!(
    "\"use strict\";\n(() => {\n",
    include_str!("../../page/tones.js"),
    include_str!("../../page/picture.js"),
    include_str!("../../page/scale.js"),
    include_str!("../../page/plot.js"),
    include_str!("../../page/main.js"),
    "})();\n"
);

/// The file of this name, if it is one of the page.
pub(crate) fn file(name: &str) -> Option<Response> {
    let (kind, text) = match name {
        "" => ("text/html; charset=utf-8", HTML),
        "view.css" => ("text/css; charset=utf-8", STYLE),
        "view.js" => ("text/javascript; charset=utf-8", SCRIPT),
        _ => return None,
    };
    Some(Response::new(200, kind, text.as_bytes()))
}
