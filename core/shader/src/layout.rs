//! The fields of structs of recorded numbers, as their `Debug` prints them: no second list of fields is needed.

use crate::graph::Id;

/// One or several numbers of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    /// A number.
    Number(Id),
    /// A struct with its name, or an array.
    Fields(String, Vec<(String, Value)>),
}

/// A field of numbers: the names of the fields on the way to it, with `_` between.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Slot {
    pub(crate) name: String,
    /// One number, or the coordinates of a vector.
    pub(crate) parts: Vec<Id>,
}

struct Parser<'a> {
    text: &'a str,
}

impl<'a> Parser<'a> {
    fn rest(&mut self) -> &'a str {
        self.text = self.text.trim_start();
        self.text
    }
    fn eat(&mut self, token: char) -> bool {
        let rest = self.rest();
        let found = rest.starts_with(token);
        if found {
            self.text = &rest[token.len_utf8()..];
        }
        found
    }
    fn word(&mut self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        self.text = &rest[end..];
        &rest[..end]
    }
    fn value(&mut self) -> Value {
        if self.eat('#') {
            let word = self.word();
            return Value::Number(word.parse().unwrap_or_else(|_| panic!("a node is called #{word}")));
        }
        let name = self.word().to_owned();
        let mut fields = Vec::new();
        let close =
            [('{', '}'), ('[', ']'), ('(', ')')].into_iter().find(|&(open, _)| self.eat(open)).map(|(_, close)| close);
        if let Some(close) = close {
            while !self.eat(close) {
                let field = if close == '}' {
                    let field = self.word().to_owned();
                    assert!(self.eat(':'), "no field at {}", self.text);
                    field
                } else {
                    fields.len().to_string()
                };
                fields.push((field, self.value()));
                self.eat(',');
            }
        }
        assert!(close.is_some() || !name.is_empty(), "no value at {}", self.text);
        Value::Fields(name, fields)
    }
}

/// The numbers of a struct, as it prints itself.
pub(crate) fn slots(value: &impl core::fmt::Debug) -> Vec<Slot> {
    fn walk(value: &Value, name: &str, all: &mut Vec<Slot>) {
        match value {
            Value::Number(id) => all.push(Slot { name: name.to_owned(), parts: vec![*id] }),
            Value::Fields(kind, fields) => {
                let parts: Option<Vec<_>> = fields
                    .iter()
                    .map(|(_, value)| if let Value::Number(id) = value { Some(*id) } else { None })
                    .collect();
                match parts {
                    Some(parts) if kind == "Vec2" || kind == "Vec3" => all.push(Slot { name: name.to_owned(), parts }),
                    _ => fields.iter().for_each(|(field, value)| {
                        let path = if name.is_empty() { field.clone() } else { format!("{name}_{field}") };
                        walk(value, &path, all);
                    }),
                }
            }
        }
    }
    let text = format!("{value:?}");
    let mut parser = Parser { text: &text };
    let value = parser.value();
    assert!(parser.rest().is_empty(), "more than a struct: {}", parser.text);
    let mut all = Vec::new();
    walk(&value, "", &mut all);
    all
}
