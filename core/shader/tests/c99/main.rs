//! The C sources return the bits of the Rust routines, compiled by the C compiler of the machine. What WGSL makes of each operation has them,
//! too: its translation into Metal is compiled as C++.

mod devices;
mod driver;
mod header;
mod lights;
mod opencl;
mod operations;
mod program;
mod tables;
mod tools;
mod warps;
