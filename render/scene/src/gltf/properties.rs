//! Compares the properties of a file with the list of the format: those that it lacks may be misspelt, and some are ignored.

use super::source::Source;
use crate::list::{Entry, GLTF, State};
use crate::message::{Notes, shortened};
use crate::nearest::nearest;
use serde_json::{Map, Value};

/// Deeper objects are not looked at; the reader of JSON stops at 128.
const DEEPEST: usize = 128;

/// The files' objects, and what was found in them.
struct Walk<'a, 's> {
    source: &'a Source<'s>,
    notes: &'a mut Notes,
}

/// Warns of properties that are unknown, and of those that are ignored.
pub(super) fn check(source: &Source<'_>, json: &[u8], notes: &mut Notes) {
    let Ok(Value::Object(root)) = serde_json::from_slice(json) else { return };
    if let Some(entry) = GLTF.entry("glTF", "") {
        Walk { source, notes }.object(entry, &root, "", DEEPEST);
    }
}

impl Walk<'_, '_> {
    fn stand_in(&mut self, kind: &str, item: &str, what: &str) {
        let text = if item.is_empty() { what.to_owned() } else { format!("{item}: {what}") };
        self.notes.stand_in(kind, || self.source.message(text));
    }

    fn object(&mut self, entry: &Entry, object: &Map<String, Value>, item: &str, left: usize) {
        for (name, value) in object {
            match name.as_str() {
                "extras" => {}
                "extensions" => self.extensions(value, item, left),
                // attributes of an application
                _ if name.starts_with('_') && entry.name == "attributes" => {}
                _ => self.property(entry, name, value, item, left),
            }
        }
    }

    fn property(&mut self, entry: &Entry, name: &str, value: &Value, item: &str, left: usize) {
        let Some(listed) = entry.parameter(name) else {
            let at = if item.is_empty() { String::new() } else { format!("{item}: ") };
            let text = format!("{at}unknown property {:?}", shortened(name));
            match nearest(name, entry.names()) {
                Some(near) => self.notes.misspelt(self.source.message(format!("{text}; did you mean {near}?"))),
                None => self.notes.warn_once(&format!("property {} {name}", entry.name), || self.source.message(text)),
            }
            return;
        };
        // a reader that looks at it tells more
        if listed.state == State::Ignored && !TOLD.contains(&listed.name) {
            let why = if listed.note.is_empty() { String::new() } else { format!(": {}", listed.note) };
            let its = if item.is_empty() { String::new() } else { "its ".to_owned() };
            let is = if its.is_empty() { "are" } else { "is" };
            self.stand_in(&format!("property {name}"), item, &format!("{its}{name} {is} ignored{why}"));
        }
        let of = listed.kind.trim_end_matches("[]");
        let Some(inner) = GLTF.entry(of, "").filter(|_| left > 0) else { return };
        let is_list = of.len() < listed.kind.len();
        let place = |index: Option<usize>| {
            let own = index.map_or_else(|| name.to_owned(), |index| format!("{of} {index}"));
            // what is in a list of the file has a number, which is enough
            if entry.name == "glTF" || item.is_empty() { own } else { format!("{item}, {own}") }
        };
        match value {
            Value::Object(object) => self.object(inner, object, &place(None), left - 1),
            Value::Array(list) if is_list => {
                for (index, value) in list.iter().enumerate() {
                    if let Value::Object(object) = value {
                        self.object(inner, object, &place(Some(index)), left - 1);
                    }
                }
            }
            _ => {}
        }
    }

    fn extensions(&mut self, value: &Value, item: &str, left: usize) {
        for (name, value) in value.as_object().into_iter().flatten() {
            let entry = GLTF.entry(name, "");
            let what = match entry.map(|entry| (entry.state, entry.note)) {
                Some((State::Exact | State::Inert | State::Approximated, _)) => None,
                Some((State::Ignored, note)) if !note.is_empty() => Some(format!("{name} is ignored: {note}")),
                Some(_) => Some(format!("{name} is ignored")),
                None => Some(format!("{} is not supported and ignored", shortened(name))),
            };
            if let Some(what) = what {
                self.stand_in(&format!("extension {name}"), item, &what);
            }
            if let (Some(entry), Value::Object(object)) = (entry.filter(|_| left > 0), value) {
                self.object(
                    entry,
                    object,
                    &if item.is_empty() { name.clone() } else { format!("{item}, {name}") },
                    left - 1,
                );
            }
        }
    }
}

/// Ignored properties whose warnings the readers give.
const TOLD: [&str; 1] = ["range"];
