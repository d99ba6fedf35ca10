//! Messages about the lines of a scene file.

use std::fmt;

/// An error or warning about a line of a scene file, shown as `file:line: text`, or about a whole file, shown as `file: text`.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The file as the user named it, or as its parent included it.
    pub file: String,
    /// The line number, from 1; 0 for the whole file.
    pub line: u32,
    /// What is wrong with the line.
    pub text: String,
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.file, self.text),
            line => write!(f, "{}:{line}: {}", self.file, self.text),
        }
    }
}
