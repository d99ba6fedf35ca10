//! Reads the directives that give a transform: `Translate`, `Scale`, `Rotate`, `LookAt`, `Transform` and `ConcatTransform`.

use super::lexer::{Lexer, Token};
use crate::message::Place;
use crate::transform::Transform;
use etendue_render::scene::Message;

/// Reads the numbers of a directive.
pub(super) fn read(word: &str, place: &Place, lexer: &mut Lexer<'_>) -> Result<Transform, Message> {
    let matrix = word == "Transform" || word == "ConcatTransform";
    let count = match word {
        "LookAt" => 9,
        "Rotate" => 4,
        "Translate" | "Scale" => 3,
        _ => 16,
    };
    let bracket = |lexer: &mut Lexer<'_>, wanted: Token<'_>| {
        let (found, line) = lexer.expect(&wanted.show())?;
        let wrong = || lexer.place(line).message(format!("{word}: expected {}, found {}", wanted.show(), found.show()));
        if found == wanted { Ok(()) } else { Err(wrong()) }
    };
    if matrix {
        bracket(lexer, Token::Open)?;
    }
    let mut m = [0.0; 16];
    for x in &mut m[..count] {
        *x = lexer.number(word)?;
    }
    if matrix {
        bracket(lexer, Token::Close)?;
    }

    let three = |i: usize| [m[i], m[i + 1], m[i + 2]];
    let made = match word {
        "Translate" => Ok(Transform::translate(three(0))),
        "Scale" => Ok(Transform::scale(three(0))),
        "Rotate" => Transform::rotate(m[0], three(1)).ok_or("the axis must not be zero"),
        "LookAt" => Transform::look_at(three(0), three(3), three(6)).ok_or("eye, target and up do not define a view"),
        _ => Transform::from_columns(&m).ok_or("not affine: every fourth number must be 0, the last one 1"),
    };
    made.map_err(|why| place.message(format!("{word} {:?}: {why}", &m[..count])))
}
