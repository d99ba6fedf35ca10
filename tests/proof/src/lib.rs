//! Proofs of the greatest errors of warps: for every `u` and every parameter in a box, by the routines themselves.
//!
//! [`Traced`] implements [`etendue::Real`], so that the shipped body of a routine runs over intervals and records its rounding errors.
//! [`error`](tape::error) bounds their effect on a result, [`search`] divides the box until the bound is below the limit everywhere, and
//! [`theorems`] states what is proved. What the elementary functions contribute is proved by trying all their arguments ([`lemmas`]).
//!
//! What a theorem says: F(δ), which the routine computes, differs by at most the limit from F(0), the same branches in exact arithmetic.
//! Where a routine chooses between two expressions by a rounded number, the choice is the computed one: both must then be the same
//! function. That F(0) is the map that the documentation defines is not proved, but checked at random points by an independent formula
//! in double precision, to within 10⁻⁹.

pub mod affine;
pub mod defect;
pub mod interval;
pub mod lemmas;
pub mod limits;
pub mod search;
pub mod tape;
pub mod theorems;
pub mod traced;

pub use interval::Interval;
pub use traced::Traced;
