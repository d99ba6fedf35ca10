//! Tests of the core, in one program: the compiler instantiates its generic routines once.

mod choices;
mod estimate;
mod fuzz_bodies;
mod lights;
mod math;
mod oracle;
mod reflection;
mod sequences;
mod sources;
mod warps;
