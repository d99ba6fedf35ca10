//! Reads the parameter lists that follow most directives: `"type name" [ values ]`.

use super::inputs::Files;
use super::lexer::{Lexer, Token, number};
use super::spectrum::{self, Named, Samples};
use crate::list::{Entry, PBRT, Parameter, State};
pub(super) use crate::message::shown;
use crate::message::{Notes, Place, shortened};
use crate::nearest::nearest;
use etendue_render::scene::Message;
use std::path::Path;

/// Far more than any directive has; bounds the linear look-up by name.
const MOST_PARAMETERS: usize = 100;

/// The values of one parameter.
#[derive(Clone, Debug)]
enum Values {
    Numbers(Vec<f64>),
    Flags(Vec<bool>),
    Texts(Vec<String>),
}

/// A colour, which may be given in several ways.
pub(super) enum Color {
    /// Linear RGB, none negative.
    Rgb([f64; 3]),
    /// A black body of a temperature in kelvins.
    Blackbody(f64),
    /// A spectrum.
    Samples(Samples),
    /// The name of a spectrum.
    Named(Named),
    /// The name of a texture.
    Texture(String),
}

/// One parameter and the line of its declaration.
#[derive(Clone, Debug)]
pub(super) struct Param {
    kind: &'static str,
    name: String,
    values: Values,
    line: u32,
}

/// The parameters of one directive. A look-up removes the parameter; those left at the end cause warnings.
#[derive(Clone, Debug)]
pub(super) struct Params {
    /// The directive as messages show it, such as `Shape "sphere"`.
    pub(super) owner: String,
    /// The line of the directive.
    pub(super) place: Place,
    list: Vec<Param>,
    /// Warnings of parameters that are given twice.
    repeated: Vec<Message>,
    /// What the list of the format says of the directive.
    listed: Option<&'static Entry>,
}

/// The names of parameter types.
const KINDS: &str = "integer float point2 vector2 point3 vector3 normal rgb spectrum blackbody xyz bool string texture";

/// The canonical name of a parameter type.
fn canonical(kind: &str) -> Option<&'static str> {
    let older = [("point", "point3"), ("vector", "vector3"), ("normal3", "normal"), ("color", "rgb")];
    let kind = older.into_iter().find(|(name, _)| *name == kind).map_or(kind, |(_, name)| name);
    KINDS.split(' ').find(|name| *name == kind)
}

impl Values {
    fn new(kind: &str) -> Self {
        match kind {
            "bool" => Values::Flags(Vec::new()),
            "string" | "texture" | "spectrum" => Values::Texts(Vec::new()),
            _ => Values::Numbers(Vec::new()),
        }
    }

    fn texts(&self) -> &[String] {
        if let Self::Texts(texts) = self { texts } else { &[] }
    }

    fn numbers(&self) -> &[f64] {
        if let Self::Numbers(numbers) = self { numbers } else { &[] }
    }

    fn push(&mut self, kind: &str, token: Token<'_>) -> Result<(), String> {
        let found = token.show();
        match (self, token) {
            (Values::Flags(flags), Token::Word("true")) => flags.push(true),
            (Values::Flags(flags), Token::Word("false")) => flags.push(false),
            (Values::Flags(flags), Token::Text(s)) if s == "true" || s == "false" => flags.push(s == "true"),
            (Values::Flags(_), _) => return Err(format!("expected true or false, found {found}")),
            (Values::Texts(texts), Token::Text(s)) => texts.push(s),
            (Values::Texts(texts), Token::Word(_)) if kind == "spectrum" => texts.push(found),
            (Values::Texts(_), _) => return Err(format!("expected a string in quotes, found {found}")),
            (Values::Numbers(numbers), token) => {
                let value = number(&token)?;
                let range = f64::from(i32::MIN)..=f64::from(i32::MAX);
                if kind == "integer" && !(value.fract() == 0.0 && range.contains(&value)) {
                    return Err(format!("expected an integer, found {found}"));
                }
                numbers.push(value);
            }
        }
        Ok(())
    }
}

impl Params {
    /// Reads the parameters that follow the directive `owner`.
    pub(super) fn read(lexer: &mut Lexer<'_>, owner: String, place: Place) -> Result<Self, Message> {
        let mut params = Params { owner, place, list: Vec::new(), repeated: Vec::new(), listed: None };
        while let Some(Token::Text(_)) = lexer.peek()? {
            let param = Self::read_one(lexer, &params.owner)?;
            if params.list.len() == MOST_PARAMETERS {
                let why = "too many parameters";
                return Err(lexer.place(param.line).message(format!("{}: {:?}: {why}", params.owner, param.name)));
            }
            // as in pbrt, the last one counts
            if params.has(&param.name) {
                params.list.retain(|other| other.name != param.name);
                params.repeated.push(params.at(&param, "given twice: this one counts"));
            }
            params.list.push(param);
        }
        Ok(params)
    }

    fn read_one(lexer: &mut Lexer<'_>, owner: &str) -> Result<Param, Message> {
        let (token, line) = lexer.expect("a parameter")?;
        let Token::Text(declaration) = token else {
            return Err(lexer.place(line).message(format!("{owner}: expected a parameter, found {}", token.show())));
        };
        let wrong = |line: u32, text: String| lexer.place(line).message(format!("{owner}: {text}"));
        let mut words = declaration.split_whitespace();
        let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
            return Err(wrong(
                line,
                format!("expected a parameter's type and name, found {:?}", shortened(&declaration)),
            ));
        };
        let name = shortened(name);
        let kind = canonical(kind)
            .ok_or_else(|| wrong(line, format!("parameter {name:?} has unknown type {:?}", shortened(kind))))?;

        let mut values = Values::new(kind);
        let mut push = |lexer: &Lexer<'_>, (token, at): (Token<'_>, u32)| {
            let pushed = values.push(kind, token);
            pushed.map_err(|why| lexer.place(at).message(format!("{owner}: {name:?}: {why}")))
        };
        let mut next = lexer.expect(&format!("a value of {name:?}"))?;
        if next.0 == Token::Open {
            let what = format!("the ] of {name:?}");
            next = lexer.expect(&what)?;
            while next.0 != Token::Close {
                push(lexer, next)?;
                next = lexer.expect(&what)?;
            }
        } else {
            push(lexer, next)?;
        }
        Ok(Param { kind, name, values, line })
    }

    /// The parameters are those of a directive of this type in the list of the format.
    pub(super) fn of(mut self, directive: &str, kind: &str) -> Self {
        self.listed = PBRT.entry(directive, kind);
        self
    }

    /// Checks that the list of the format has a parameter that the reader asks for.
    fn check(&self, name: &str) {
        let is_listed = self.listed.is_none_or(|entry| entry.parameter(name).is_some());
        debug_assert!(is_listed, "the list lacks {name:?} of {}", self.owner);
    }

    /// A message at the directive's line.
    pub(super) fn error(&self, text: impl AsRef<str>) -> Message {
        self.place.message(format!("{}: {}", self.owner, text.as_ref()))
    }

    /// An error at the directive's line, unless what is required holds.
    pub(super) fn require<T: AsRef<str>>(&self, holds: bool, text: impl FnOnce() -> T) -> Result<(), Message> {
        if holds { Ok(()) } else { Err(self.error(text())) }
    }

    /// A number that a parameter gives, if it is in this range.
    pub(super) fn bound(&self, name: &str, x: f64, holds: bool, range: &str) -> Result<f64, Message> {
        self.require(holds, || format!("{name:?}: must be {range}, not {}", shown(x))).map(|()| x)
    }

    /// A message at one parameter's line.
    fn at(&self, param: &Param, text: impl AsRef<str>) -> Message {
        let place = Place { file: self.place.file.clone(), line: param.line };
        place.message(format!("{}: {:?}: {}", self.owner, param.name, text.as_ref()))
    }

    /// Where a parameter is in the list, if it is given.
    fn find(&self, name: &str) -> Option<usize> {
        self.check(name);
        self.list.iter().position(|p| p.name == name)
    }

    /// Numbers of type `kind`, whose count must be a multiple of `group`.
    pub(super) fn numbers(&mut self, name: &str, kind: &str, group: usize) -> Result<Option<Vec<f64>>, Message> {
        self.numbers_of(name, &[kind], group)
    }

    /// Numbers of any of these types, whose count must be a multiple of `group`.
    pub(super) fn numbers_of(&mut self, name: &str, kinds: &[&str], group: usize) -> Result<Option<Vec<f64>>, Message> {
        let Some(param) = self.take(name, kinds)? else { return Ok(None) };
        let numbers = param.values.numbers().to_vec();
        if !numbers.len().is_multiple_of(group) {
            return Err(self.at(&param, format!("expected a multiple of {group} numbers, found {}", numbers.len())));
        }
        Ok(Some(numbers))
    }

    /// The only value of a parameter of type `kind`.
    fn one<T: Clone>(&mut self, name: &str, kind: &str, of: fn(&Values) -> &[T]) -> Result<Option<T>, Message> {
        let Some(param) = self.take(name, &[kind])? else { return Ok(None) };
        match of(&param.values) {
            [value] => Ok(Some(value.clone())),
            [] => Err(self.at(&param, "expected one value, found none")),
            values => Err(self.at(&param, format!("expected one value, found {}", values.len()))),
        }
    }

    /// One `float`.
    pub(super) fn float(&mut self, name: &str) -> Result<Option<f64>, Message> {
        self.one(name, "float", Values::numbers)
    }

    /// One `integer`.
    pub(super) fn integer(&mut self, name: &str) -> Result<Option<i64>, Message> {
        Ok(self.one(name, "integer", Values::numbers)?.map(|value| value as i64))
    }

    /// One `bool`.
    pub(super) fn flag(&mut self, name: &str) -> Result<Option<bool>, Message> {
        self.one(name, "bool", |values| if let Values::Flags(flags) = values { flags } else { &[] })
    }

    /// One `string`.
    pub(super) fn text(&mut self, name: &str) -> Result<Option<String>, Message> {
        self.one(name, "string", Values::texts)
    }

    /// Several `string`s.
    pub(super) fn texts(&mut self, name: &str) -> Result<Option<Vec<String>>, Message> {
        Ok(self.take(name, &["string"])?.map(|param| param.values.texts().to_vec()))
    }

    /// Removes a parameter if it is of one of these types.
    fn take(&mut self, name: &str, kinds: &[&str]) -> Result<Option<Param>, Message> {
        let Some(i) = self.find(name) else { return Ok(None) };
        let param = self.list.remove(i);
        if kinds.contains(&param.kind) {
            return Ok(Some(param));
        }
        Err(self.at(&param, format!("type {} is not supported, only {}", param.kind, kinds.join(", "))))
    }

    /// The name of the texture as which a parameter is given, if it is.
    pub(super) fn texture(&mut self, name: &str) -> Result<Option<String>, Message> {
        if !self.is_texture(name) {
            return Ok(None);
        }
        self.one(name, "texture", Values::texts)
    }

    /// A colour or spectrum, or the name of a texture.
    pub(super) fn color(&mut self, name: &str, files: &Files<'_>) -> Result<Option<Color>, Message> {
        if let Some(texture) = self.texture(name)? {
            return Ok(Some(Color::Texture(texture)));
        }
        let kinds = ["rgb", "spectrum", "blackbody", "xyz", "texture", "float"];
        let Some(param) = self.take(name, &kinds)? else { return Ok(None) };
        let wrong = |why: String| self.at(&param, why);
        Ok(Some(match (&param.values, param.kind) {
            (Values::Numbers(numbers), "blackbody") => match numbers[..] {
                // the second number of older files is a scale
                [kelvins, ..] if (200.0..=1e6).contains(&kelvins) && numbers.len() <= 2 => Color::Blackbody(kelvins),
                _ => return Err(wrong(format!("expected a temperature from 200 to 1e6 K, found {numbers:?}"))),
            },
            (Values::Numbers(numbers), "float") => match numbers[..] {
                [x] if x >= 0.0 => Color::Rgb([x + 0.0; 3]),
                _ => return Err(wrong(format!("expected one number of at least 0, found {numbers:?}"))),
            },
            (Values::Numbers(numbers), kind) => {
                let Ok(rgb) = <[f64; 3]>::try_from(numbers.as_slice()) else {
                    return Err(wrong(format!("expected three numbers, found {}", numbers.len())));
                };
                if let Some(x) = rgb.iter().find(|&&x| x < 0.0) {
                    return Err(wrong(format!("must be at least 0, not {}", shown(*x))));
                }
                // no −0
                let rgb = rgb.map(|x| x + 0.0);
                Color::Rgb(if kind == "xyz" { spectrum::srgb(rgb).map(|x| x.max(0.0)) } else { rgb })
            }
            (Values::Texts(texts), _) => {
                let numbers: Option<Vec<f64>> = texts.iter().map(|text| text.parse().ok()).collect();
                match (numbers, &texts[..]) {
                    (Some(numbers), _) => Color::Samples(Samples::new(&numbers).map_err(wrong)?),
                    (None, [name]) => match spectrum::named(name) {
                        Some(named) => Color::Named(named),
                        None if Path::new(name).extension().is_some() => {
                            Color::Samples(Samples::read(&files.find(name), files).map_err(wrong)?)
                        }
                        None => return Err(wrong(format!("no spectrum is called {:?}", shortened(name)))),
                    },
                    (None, _) => return Err(wrong("expected a name, or wavelengths and values".to_owned())),
                }
            }
            (Values::Flags(_), _) => return Err(wrong("expected a colour".to_owned())),
        }))
    }

    /// The colour of light, in the unit of the parameter; spectra have luminance 1.
    pub(super) fn light(&mut self, name: &str, files: &Files<'_>) -> Result<Option<[f64; 3]>, Message> {
        Ok(match self.color(name, files)? {
            None => None,
            Some(Color::Rgb(rgb)) => Some(rgb),
            Some(Color::Blackbody(kelvins)) => Some(spectrum::blackbody(kelvins)),
            Some(Color::Samples(samples)) => Some(samples.illuminant()),
            Some(Color::Named(Named::Illuminant(rgb))) => Some(rgb),
            Some(Color::Named(Named::Index(_))) => {
                return Err(self.error(format!("{name:?}: this spectrum is no light")));
            }
            Some(Color::Texture(_)) => return Err(self.error(format!("{name:?}: a light cannot have a texture"))),
        })
    }

    /// Adds parameters that are not given, unless there are too many.
    pub(super) fn default_to(&mut self, others: &[Param]) {
        for other in others {
            if !self.has(&other.name) && self.list.len() < MOST_PARAMETERS {
                self.list.push(other.clone());
            }
        }
    }

    /// The parameters themselves.
    pub(super) fn into_list(self) -> Vec<Param> {
        self.list
    }

    /// Removes the parameter, of whatever type; returns whether it was given.
    pub(super) fn given(&mut self, name: &str) -> bool {
        self.check(name);
        let before = self.list.len();
        self.list.retain(|p| p.name != name);
        self.list.len() != before
    }

    /// Gives a number.
    pub(super) fn set_float(&mut self, name: &str, value: f64) {
        self.given(name);
        let line = self.place.line;
        self.list.push(Param { kind: "float", name: name.to_owned(), values: Values::Numbers(vec![value]), line });
    }

    /// Whether the parameter is given as a texture.
    pub(super) fn is_texture(&self, name: &str) -> bool {
        self.list.iter().any(|p| p.name == name && p.kind == "texture")
    }

    /// Gives a parameter another name, unless it is given by that, too.
    pub(super) fn rename(&mut self, from: &str, to: &str) {
        if !self.has(to) {
            self.list.iter_mut().filter(|param| param.name == from).for_each(|param| param.name = to.to_owned());
        }
    }

    /// Removes all parameters, so that none of them causes a warning.
    pub(super) fn ignore_all(&mut self) {
        self.list.clear();
    }

    /// Whether the parameter is given, of whatever type.
    pub(super) fn has(&self, name: &str) -> bool {
        self.list.iter().any(|p| p.name == name)
    }

    /// Warns of each parameter that was not looked up: as the list of the format says, or else with the name that may be meant.
    pub(super) fn finish(self, notes: &mut Notes) {
        self.repeated.iter().cloned().for_each(|message| notes.warn(message));
        for param in &self.list {
            let listed = self.listed.and_then(|entry| Some((entry, entry.parameter(&param.name)?)));
            match listed {
                // the directive as a whole has a warning
                Some((_, Parameter { name: "*", .. } | Parameter { state: State::Inert, .. })) => {}
                Some((entry, Parameter { name, note, .. })) => {
                    let why = if note.is_empty() { String::new() } else { format!(": {note}") };
                    notes.stand_in(&format!("{} {name}", entry.name), || self.at(param, format!("ignored{why}")));
                }
                None => match nearest(&param.name, self.listed.into_iter().flat_map(Entry::names)) {
                    Some(near) => notes.misspelt(self.at(param, format!("ignored; did you mean {near:?}?"))),
                    None => notes.warn(self.at(param, "ignored")),
                },
            }
        }
    }
}
