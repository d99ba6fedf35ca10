//! Carries out the directives that change the current transform.

use super::blocks::State;
use super::lexer::{Lexer, Token};
use crate::message::{Notes, Place, shortened};
use crate::nearest::did_you_mean;
use crate::transform::Transform;
use etendue_render::scene::Message;
use std::collections::HashMap;

/// Carries out a directive; `systems` are the named coordinate systems.
pub(super) fn apply(
    word: &str,
    place: &Place,
    lexer: &mut Lexer<'_>,
    state: &mut State,
    systems: &mut HashMap<String, Transform>,
    notes: &mut Notes,
) -> Result<(), Message> {
    match word {
        "Identity" => {
            if !state.is_end {
                state.ctm = Transform::IDENTITY;
            }
        }
        "CoordinateSystem" => {
            systems.insert(lexer.text("a name")?, state.ctm);
        }
        "CoordSysTransform" => {
            let name = lexer.text("a name")?;
            match systems.get(&name) {
                Some(system) => state.ctm = *system,
                None => notes.misspelt(place.message(format!(
                    "undefined CoordinateSystem {:?}: the transform stays as it is, as in pbrt{}",
                    shortened(&name),
                    did_you_mean(&name, systems.keys().map(String::as_str))
                ))),
            }
        }
        "ActiveTransform" => match lexer.expect("All, StartTime or EndTime")?.0 {
            Token::Word(which @ ("All" | "StartTime" | "EndTime")) => {
                if which != "All" {
                    let why = "motion becomes a still at its start";
                    notes.stand_in("motion", || place.message(format!("ActiveTransform {which}: {why}")));
                }
                state.is_end = which == "EndTime";
            }
            other => {
                let wanted = "expected All, StartTime or EndTime";
                return Err(place.message(format!("ActiveTransform: {wanted}, found {}", other.show())));
            }
        },
        "TransformTimes" => {
            lexer.number(word)?;
            lexer.number(word)?;
        }
        _ => {
            let made = read(word, place, lexer)?;
            if !state.is_end {
                state.ctm = if word == "Transform" { made } else { state.ctm.after(&made) };
                if !state.ctm.is_finite() {
                    return Err(place.message(format!("{word}: the transform is no longer finite")));
                }
            }
        }
    }
    Ok(())
}

/// Reads the numbers of `Translate`, `Scale`, `Rotate`, `LookAt`, `Transform` or `ConcatTransform`.
fn read(word: &str, place: &Place, lexer: &mut Lexer<'_>) -> Result<Transform, Message> {
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
        _ => Transform::from_columns(&m).ok_or("not affine: every fourth number must be 0, but for the last one"),
    };
    made.map_err(|why| place.message(format!("{word} {:?}: {why}", &m[..count])))
}
