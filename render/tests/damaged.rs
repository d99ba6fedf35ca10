//! Damaged copies of files.

use crate::random::Random;

/// Calls `judge` with each beginning of a file, and with this many copies of which a few bytes are others, missing, exchanged or one of
/// these pieces.
pub(crate) fn damaged(whole: &[u8], pieces: &[&str], copies: usize, mut judge: impl FnMut(&[u8])) {
    (0..whole.len()).for_each(|end| judge(&whole[..end]));
    let mut random = Random::new(whole.len() as u64);
    let mut below = |n: usize| random.below(n);
    for _ in 0..copies {
        let mut bytes = whole.to_vec();
        for _ in 0..1 + below(4) {
            let at = below(bytes.len());
            match below(5) {
                0 => bytes[at] = below(256) as u8,
                // digits for digits reach further than other characters
                1 if bytes[at].is_ascii_digit() => bytes[at] = b'0' + below(10) as u8,
                2 => drop(bytes.drain(at..(at + below(20)).min(bytes.len() - 1))),
                3 => bytes.swap(at, at / 2),
                _ => drop(bytes.splice(at..at, pieces[below(pieces.len())].bytes())),
            }
        }
        judge(&bytes);
    }
}
