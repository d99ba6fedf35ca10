//! Splits the text of a scene file into tokens with line numbers.

use crate::message::{Place, shortened};
use etendue_render::scene::Message;
use std::sync::Arc;

/// One token.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// `[`
    Open,
    /// `]`
    Close,
    /// A quoted string, unescaped.
    Text(String),
    /// Anything else, up to white space, a quote or a bracket.
    Word(&'a str),
}

impl Token<'_> {
    /// The token as an error message shows it.
    pub(super) fn show(&self) -> String {
        match self {
            Token::Open => "[".into(),
            Token::Close => "]".into(),
            Token::Text(s) => format!("{:?}", shortened(s)),
            Token::Word(s) => shortened(s),
        }
    }
}

/// The tokens of one file.
#[derive(Debug)]
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
    line: u32,
    file: Arc<str>,
    peeked: Option<(Token<'a>, u32)>,
}

impl<'a> Lexer<'a> {
    /// Starts at line 1 of `text`; messages name `file`.
    pub(super) fn new(text: &'a str, file: Arc<str>) -> Self {
        // some editors begin UTF-8 with a byte order mark
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Lexer { text, at: 0, line: 1, file, peeked: None }
    }

    /// A line of this file, for messages.
    pub(super) fn place(&self, line: u32) -> Place {
        Place { file: self.file.clone(), line }
    }

    /// The next token and its line, or `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<(Token<'a>, u32)>, Message> {
        match self.peeked.take() {
            Some(token) => Ok(Some(token)),
            None => self.scan(),
        }
    }

    /// Like [`Lexer::next`], but does not consume the token.
    pub(super) fn peek(&mut self) -> Result<Option<&Token<'a>>, Message> {
        if self.peeked.is_none() {
            self.peeked = self.scan()?;
        }
        Ok(self.peeked.as_ref().map(|(token, _)| token))
    }

    /// The next token; at the end of the file, an error that names `what`.
    pub(super) fn expect(&mut self, what: &str) -> Result<(Token<'a>, u32), Message> {
        let end = |lexer: &Self| lexer.place(lexer.line).message(format!("the file ends where {what} is expected"));
        self.next()?.ok_or_else(|| end(self))
    }

    /// A quoted string.
    pub(super) fn text(&mut self, what: &str) -> Result<String, Message> {
        match self.expect(what)? {
            (Token::Text(s), _) => Ok(s),
            (other, line) => {
                Err(self.place(line).message(format!("expected {what} in quotes, found {}", other.show())))
            }
        }
    }

    /// A finite number.
    pub(super) fn number(&mut self, what: &str) -> Result<f64, Message> {
        let (token, line) = self.expect(what)?;
        number(&token).map_err(|why| self.place(line).message(format!("{what}: {why}")))
    }

    fn scan(&mut self) -> Result<Option<(Token<'a>, u32)>, Message> {
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.at) {
                None => return Ok(None),
                Some(b'\n') => {
                    self.line = self.line.saturating_add(1);
                    self.at += 1;
                }
                Some(b' ' | b'\t' | b'\r') => self.at += 1,
                Some(b'#') => {
                    self.at += bytes[self.at..].iter().take_while(|b| !matches!(b, b'\n' | b'\r')).count();
                }
                Some(_) => break,
            }
        }
        let start = self.at;
        let token = match bytes[start] {
            b'[' | b']' => {
                self.at += 1;
                if bytes[start] == b'[' { Token::Open } else { Token::Close }
            }
            b'"' => Token::Text(self.scan_text()?),
            _ => {
                // all bytes that end a word are ASCII, so the slice ends on a character boundary
                let ends = |b: &&u8| matches!(b, b' ' | b'\t' | b'\r' | b'\n' | b'"' | b'[' | b']');
                self.at += bytes[start..].iter().take_while(|b| !ends(b)).count();
                Token::Word(&self.text[start..self.at])
            }
        };
        Ok(Some((token, self.line)))
    }

    fn scan_text(&mut self) -> Result<String, Message> {
        let mut out = String::new();
        let mut chars = self.text[self.at + 1..].char_indices();
        while let Some((i, c)) = chars.next() {
            match c {
                '"' => {
                    self.at += i + 2;
                    return Ok(out);
                }
                '\n' => break,
                '\\' => match chars.next() {
                    Some((_, 'n')) => out.push('\n'),
                    Some((_, 't')) => out.push('\t'),
                    Some((_, 'r')) => out.push('\r'),
                    Some((_, 'b')) => out.push('\u{8}'),
                    Some((_, 'f')) => out.push('\u{c}'),
                    Some((_, c @ ('\\' | '"' | '\''))) => out.push(c),
                    Some((_, '\n')) | None => break,
                    Some((_, c)) => {
                        return Err(self
                            .place(self.line)
                            .message(format!("unknown escape \\{} in a string", shortened(&c.to_string()))));
                    }
                },
                c => out.push(c),
            }
        }
        Err(self.place(self.line).message(format!("the string {:?} is not closed on its line", shortened(&out))))
    }
}

/// The value of a number token; the error says why it is none.
pub(super) fn number(token: &Token<'_>) -> Result<f64, String> {
    let Token::Word(word) = token else {
        return Err(format!("expected a number, found {}", token.show()));
    };
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("the number {} is not finite", token.show())),
        Err(_) => Err(format!("expected a number, found {}", token.show())),
    }
}
