//! The C sources return the bits of the Rust routines, compiled by the C compiler of the machine.

mod driver;
mod header;
mod lights;
mod operations;
mod tools;
mod warps;
