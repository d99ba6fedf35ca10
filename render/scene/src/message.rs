//! Messages about the lines of a scene file.

use etendue_render::scene::Message;
use std::collections::HashSet;
use std::sync::Arc;

/// What a reader has to say about a scene.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// Warnings in the order of the file.
    pub(super) warnings: Vec<Message>,
    /// Those of them that say what stands for something else, or may be misspelt.
    pub(super) stand_ins: Vec<Message>,
    kinds: HashSet<String>,
}

impl Notes {
    /// Adds a warning.
    pub(super) fn warn(&mut self, message: Message) {
        self.warnings.push(message);
    }
    /// Adds a warning, but only the first one of its kind.
    pub(super) fn warn_once(&mut self, kind: &str, message: impl FnOnce() -> Message) {
        if self.kinds.insert(kind.to_owned()) {
            let message = message();
            self.warnings.push(Message { text: format!("{} (reported once)", message.text), ..message });
        }
    }
    /// Adds a warning of what is left out since it may be misspelt.
    pub(super) fn misspelt(&mut self, message: Message) {
        self.stand_ins.push(message.clone());
        self.warnings.push(message);
    }
    /// Warns that something stands for something else, but only of the first one of its kind.
    pub(super) fn stand_in(&mut self, kind: &str, message: impl FnOnce() -> Message) {
        let before = self.warnings.len();
        self.warn_once(kind, message);
        self.stand_ins.extend_from_slice(&self.warnings[before..]);
    }
}

/// A line of a file, cheap to clone.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) file: Arc<str>,
    pub(super) line: u32,
}

impl Place {
    pub(super) fn message(&self, text: impl Into<String>) -> Message {
        Message { file: self.file.to_string(), line: self.line, text: text.into() }
    }

    /// The place as a message about a line of this file calls it.
    pub(super) fn seen_from(&self, file: &str) -> String {
        if *self.file == *file { format!("line {}", self.line) } else { format!("{}:{}", self.file, self.line) }
    }
}

/// A number as a message shows it: with an exponent if it would take many digits otherwise.
pub(super) fn shown(x: f64) -> String {
    if x == 0.0 || (1e-4..1e16).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// The text of a file, or where it is not UTF-8.
pub(super) fn utf8<'a>(bytes: &'a [u8], file: &Arc<str>) -> Result<&'a str, Message> {
    let is_wide = [[0xff, 0xfe], [0xfe, 0xff]].iter().any(|mark| bytes.starts_with(mark));
    if let Some(at) = if is_wide { Some(0) } else { bytes.iter().position(|&b| b == 0) } {
        let line = 1 + bytes[..at].iter().filter(|&&b| b == b'\n').count() as u32;
        let what =
            if is_wide { "begins with the byte order mark of UTF-16" } else { "has a zero byte, as UTF-16 does" };
        return Err(Place { file: file.clone(), line }.message(format!("the file {what}: save it as UTF-8")));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        let line = 1 + valid.iter().filter(|&&b| b == b'\n').count() as u32;
        let byte = bytes[error.valid_up_to()];
        Place { file: file.clone(), line }.message(format!("the byte 0x{byte:02x} is not UTF-8"))
    })
}

/// At most 60 characters of `s`, so that a message stays on one line; characters that cannot be seen are escaped.
pub(super) fn shortened(s: &str) -> String {
    let escape = |c: char| {
        let escaped = c.escape_debug();
        // not those of quotes, backslashes and accents
        let is_visible = !c.is_control() && (escaped.len() <= 2 || c.is_alphanumeric());
        if is_visible { c.to_string() } else { escaped.to_string() }
    };
    let mut shown: String = s.chars().take(60).map(escape).collect();
    if s.chars().nth(60).is_some() {
        shown.push('…');
    }
    shown
}
