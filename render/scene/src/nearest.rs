//! The name that a misspelt one may stand for.

use strsim::levenshtein;

/// Letters of a word beyond which it is no misspelt name: distances take a time in proportion to both lengths.
const LONGEST: usize = 128;

/// The known name that is the fewest letters away, whatever their case, if it is at most two away.
pub(super) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST {
        return None;
    }
    let name = name.to_lowercase();
    let near = known.into_iter().map(|known| (levenshtein(&name, &known.to_lowercase()), known)).min()?;
    // two edits turn any name of two letters into another
    (near.0 <= 2 && near.0 < near.1.len().min(name.len())).then_some(near.1)
}

/// The end of a message about a name that is not known: the one that may be meant, if there is one.
pub(super) fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known).map_or_else(String::new, |near| format!("; did you mean {near}?"))
}
