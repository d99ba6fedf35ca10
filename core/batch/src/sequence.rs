//! Sequences that a loop over packets knows.

use crate::sealed::Sealed;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified};

/// How many sequences there are.
pub(crate) const SEQUENCES: usize = 4;

/// A sequence.
pub trait BatchSequence: Sequence + Sealed {
    /// Its number.
    const INDEX: usize;
}

macro_rules! sequences {
    ($($index:literal: $sequence:ident;)+) => {$(
        impl Sealed for $sequence {}
        impl BatchSequence for $sequence {
            const INDEX: usize = $index;
        }
    )+};
}
sequences! {
    0: Independent;
    1: OwenSobol;
    2: JointSobol;
    3: Stratified;
}
