//! Defects to plant in a routine, so that a test sees its proof fail.

use std::cell::Cell;

/// A defect to plant, so that a proof must fail.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Defect {
    /// None.
    #[default]
    None,
    /// A constant of this value has a wrong digit: it is greater by this part of itself.
    Constant {
        /// The right value.
        value: f64,
        /// The relative error.
        off: f64,
    },
    /// The n-th call of `clamped`, `lesser` or `greater` returns its argument.
    NoClamp(u32),
    /// Rounding counts as half as large as it is.
    HalfRounding,
    /// Intervals are rounded inwards.
    Inwards,
}
thread_local! {
    static DEFECT: Cell<Defect> = const { Cell::new(Defect::None) };
    static CLAMPS: Cell<u32> = const { Cell::new(0) };
}
/// Plants a defect in all routines that this thread traces from now on.
pub fn plant(defect: Defect) {
    DEFECT.set(defect);
    CLAMPS.set(0);
}
/// The defect that is planted.
#[must_use]
pub fn planted() -> Defect {
    DEFECT.get()
}
/// Begins to count clamps anew: for each run of a routine.
pub(crate) fn begin() {
    CLAMPS.set(0);
}
/// Whether this call of `clamped`, `lesser` or `greater` is the one to leave out.
pub(crate) fn clamp_is_missing() -> bool {
    let Defect::NoClamp(n) = DEFECT.get() else { return false };
    CLAMPS.set(CLAMPS.get() + 1);
    CLAMPS.get() == n
}
