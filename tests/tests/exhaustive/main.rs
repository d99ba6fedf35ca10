//! Every float of single precision through the functions of one argument.
//!
//! `cargo test --release -p etendue-tests --test exhaustive -- --ignored --nocapture` goes over all of them. Without `--ignored`, the
//! same checks go over every 257th, the edges of all binades and the documented worst inputs.
//!
//! The references are the functions of the standard library in double precision, and the error functions of `libm`. Their errors are
//! about one ulp of f64, which is 2⁻²⁹ of an ulp of f32 (that of `erfc` is up to 400 ulp at −12.8, since its argument is rounded). This
//! would matter for a proof of correct rounding, where results come that close to a tie, but not for a bound that has two digits. Square
//! roots, which are correctly rounded, are compared exactly.

mod functions;
mod sweep;
