//! What the formats can say, and what is read of it: tables of data beside the readers, which these are checked against.

use std::sync::LazyLock;

/// What becomes of something that a file says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It means here what the format says.
    Exact,
    /// It has no effect on what is rendered, in other renderers either, and the reader need not ask for it.
    Inert,
    /// It is replaced by something near to it.
    Approximated,
    /// It changes nothing, and a warning says so.
    Ignored,
    /// It is an error.
    Refused,
}

impl State {
    /// Names in the tables and on the pages.
    const NAMES: [(&'static str, &'static str, Self); 5] = [
        ("exact", "exact", Self::Exact),
        ("inert", "no effect", Self::Inert),
        ("approximated", "approximated", Self::Approximated),
        ("ignored", "ignored", Self::Ignored),
        ("refused", "refused", Self::Refused),
    ];
    /// Its name on the page.
    #[must_use]
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }
}

/// A parameter or property.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its type, as in files.
    pub kind: &'static str,
    /// Its name; `*` stands for all others.
    pub name: &'static str,
    /// What it is where it is not given; empty if that is nothing, or no single value.
    pub default: &'static str,
    /// What becomes of it.
    pub state: State,
    /// What that means.
    pub note: &'static str,
}

/// A directive with its types, or an object.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its name; of directives without parameters, several names.
    pub name: &'static str,
    /// Its types.
    pub kinds: Vec<&'static str>,
    /// What becomes of it.
    pub state: State,
    /// What that means.
    pub note: &'static str,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
}

impl Entry {
    /// The parameter of this name, or the one that stands for all others.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        let named = |name: &str| self.parameters.iter().find(|parameter| parameter.name == name);
        named(name).or_else(|| named("*"))
    }
    /// The names of its parameters.
    pub(super) fn names(&self) -> impl Iterator<Item = &'static str> {
        self.parameters.iter().map(|parameter| parameter.name).filter(|name| *name != "*")
    }
}

/// A table of a format.
#[derive(Debug)]
pub struct Table {
    /// Its entries, in the order of the page.
    pub entries: Vec<Entry>,
}

impl Table {
    /// Reads a table; a line that cannot be read is left out, which a test notices.
    fn parse(text: &'static str) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for line in text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
            let mut parts = line.split(" | ").map(str::trim);
            let (Some(head), Some(state)) = (parts.next(), parts.next()) else { continue };
            let Some((.., state)) = State::NAMES.into_iter().find(|(name, ..)| *name == state) else { continue };
            let note = parts.next().unwrap_or_default();
            if line.starts_with(' ') {
                let mut words = head.splitn(3, ' ');
                let (first, second) = (words.next().unwrap_or_default(), words.next());
                let (kind, name) = second.map_or(("", first), |name| (first, name));
                let default = words.next().filter(|default| *default != "-").unwrap_or_default();
                entries.iter_mut().last().into_iter().for_each(|entry| {
                    entry.parameters.push(Parameter { kind, name, default, state, note });
                });
            } else {
                let (name, kinds) = head.split_once(" \"").unwrap_or((head, ""));
                let kinds = kinds.strip_suffix('"').unwrap_or(kinds).split("\" \"");
                let kinds = if head.contains('"') { kinds.collect() } else { Vec::new() };
                entries.push(Entry { name, kinds, state, note, parameters: Vec::new() });
            }
        }
        Self { entries }
    }
    /// The entry of a directive and a type, or of an object.
    #[must_use]
    pub fn entry(&self, name: &str, kind: &str) -> Option<&Entry> {
        let is = |entry: &&Entry| entry.name == name && (entry.kinds.is_empty() || entry.kinds.contains(&kind));
        self.entries.iter().find(is)
    }
    /// The types of a directive that are not left out.
    pub(super) fn kinds(&self, name: &str) -> Vec<&'static str> {
        let named = self.entries.iter().filter(|entry| entry.name == name && entry.state != State::Ignored);
        named.flat_map(|entry| entry.kinds.iter().copied().filter(|kind| !kind.is_empty())).collect()
    }
}

/// What is read of pbrt-v4's format.
#[cfg(feature = "pbrt")]
pub static PBRT: LazyLock<Table> = LazyLock::new(|| Table::parse(include_str!("pbrt/list.txt")));

/// What is read of glTF 2.0.
#[cfg(feature = "gltf")]
pub static GLTF: LazyLock<Table> = LazyLock::new(|| Table::parse(include_str!("gltf/list.txt")));
