//! Every float of single precision through the functions of one argument, and every `u` through the warps of one dimension.
//!
//! `cargo test --release -p etendue-tests --test exhaustive -- --ignored --nocapture` goes over all of them. Without `--ignored`, the
//! same checks go over every 257th, the edges of all binades and the documented worst inputs.
//!
//! The references are those of `libm` in double precision. Their errors are below one ulp of f64 (those of `erfc`, whose argument is
//! rounded, below 400 at −12.8), which is 2⁻²⁹ of an ulp of f32. That would matter for a proof of correct rounding, whose ties come
//! closer, but not for a bound on an error that is stated to two digits.

mod functions;
mod sweep;
mod warps;
