//! Light sampling for renderers: for every shape of light the map from random numbers to directions, its pdf and its inverse, one
//! sample at a time or 4, 8 or 16 at once, without std and without alloc.
//!
//! ```
//! use etendue::sequence::{Independent, Sequence};
//! use etendue::{LightSampler, Parallelogram, Vec2, Vec3, f32x8, u32x8};
//! // eight samples of a panel overhead, from the origin; the same code serves all types of Real
//! let [corner, s, t] = [[-1.0, 2.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]].map(Vec3::lit);
//! let sampler = Parallelogram::new(corner, s, t).by_solid_angle(Vec3::lit([0.0; 3]));
//! let samples = u32x8::from([0, 1, 2, 3, 4, 5, 6, 7]);
//! let u: Vec2<f32x8> = Independent::new(1).pair(u32x8::splat(0), samples, 0);
//! let light = sampler.sample(u);
//! // irradiance from one sample each, on a receiver that faces up: L cosθ / pdf with L = 1
//! let irradiance = light.direction.y * light.weight();
//! assert!(irradiance.to_array().iter().all(|e| *e > 0.5 && *e < 1.0));
//! ```
//!
#![cfg_attr(feature = "alloc", doc = "Start at [`lights`] for a set of lights of any kind,")]
#![cfg_attr(
    not(feature = "alloc"),
    doc = "Start at `lights` (these pages were made without its feature `alloc`) for a set of lights of any kind,"
)]
//! at [`light`] to sample one, at [`warp`] for maps without a shading point, at [`sequence`] for random numbers, at
//! [`estimate`] for weights of combined techniques, and at [`select`] to choose among lights.
//!
//! # The contract
//! Every routine is *total*, *closed*, *threshold-free*, *lane-identical* and *bounded*. The README, which comes with this package, says
//! what each word promises. *Closed* and *bounded* fail only where `f32` cannot represent the result; the list below the index names
//! the exceptions.
//!
//! # Conventions
//! Lengths may be in any unit. Angles are in radians, or in turns where the name says so; solid angles in steradians; pdfs per steradian
//! or per unit area as stated. `u` is uniform in [0, 1)². Directions are unit vectors that point away from the shading point. Local frames
//! have z up.
//!
#![doc = include_str!("index.md")]
//!
//! # Features
//! None is on by default. `alloc` adds `lights`, sets of lights of any kind, and trees, environments and pictures with their memory on the heap. `glam` converts vectors to and from those of `glam`, `mint` to and from those of `mint`, which `nalgebra` and `cgmath` convert, too; `rand` makes `sequence::CounterRng` a generator of `rand_core`.
//! `same-bits` makes [all processors](real::SAME_BITS) return the same bits.
//!
//! A host's own function over this library takes `R: Real<Scalar = f32>`; for single numbers alone, `f32`. The methods `greater` and `lesser` are
//! maximum and minimum. All lights and prepared samplers are `Copy`, `Send` and `Sync`; a set of lights is shared among threads, and what it
//! prepares for a point belongs to one. Prepared by solid angle in single precision, a sphere takes 68 bytes, a triangle 324, a rectangle
//! 340, a parallelogram 516, a disk 156 and a polygon of eight corners 1,796; by projected solid angle a triangle takes 656 and a
//! parallelogram 1,192. In double precision each is twice as large.
//!
//! # Speed
//! Nanoseconds per sample of single numbers with their preparation, for triangles, rectangles and spheres by solid angle, on one core of an AMD
//! EPYC, 2026-11-29, beside the plainest forms of textbooks' formulas, which have neither guards nor care for accuracy; and by `lights::Lights` of
//! one light, which also tell distance, point and bound (`benches/host/run`):
//!
//! | build | the techniques | textbooks | ratio | a set of one light | its pdf afterwards, over that |
//! |---|---|---|---|---|---|
//! | x86-64-v3, f32 | 59 / 100 / 13.5 | 71 / 66 / 10.4 | 0.84 / 1.51 / 1.31 | 134 / 198 / 92 | 0.09 / 0.07 / 0.11 |
//! | x86-64-v3, f64 | 75 / 120 / 16.7 | 81 / 83 / 15.0 | 0.93 / 1.44 / 1.11 | 148 / 221 / 99 | 0.08 / 0.07 / 0.14 |
//! | x86-64, f32 | 75 / 111 / 15.6 | 74 / 68 / 10.9 | 1.01 / 1.63 / 1.43 | 148 / 224 / 102 | 0.09 / 0.06 / 0.12 |
//! | x86-64, f64 | 96 / 155 / 18.9 | 82 / 90 / 16.7 | 1.16 / 1.73 / 1.13 | 171 / 265 / 106 | 0.10 / 0.06 / 0.13 |
//! | debug host, f32 | | 257 / 256 / 75 | | 175 / 249 / 122 | 0.03 / 0.05 / 0.12 |
//! | x86-64-v3, f32x8 | 8.0 / 16.0 / 1.9 | 7.7 / 9.9 / 1.7 | 1.04 / 1.63 / 1.13 | | |
//! | x86-64, f32x8 | 19.2 / 28.6 / 4.0 | 14.4 / 14.6 / 4.0 | 1.34 / 1.96 / 1.00 | | |
//!
//! What accuracy costs beyond the textbook: a rectangle keeps its coordinates and its height in twice the working precision, and counts the
//! height from the nearer end and along a far edge; these steps are the smaller part, and forms of angles and strips without
//! cancellation the greater. A sphere takes care of points near it or inside and of any scale, and forms the cosine from the sine.
//!
//! `wide` chooses its vector width when it is compiled. Build with `-C target-cpu=x86-64-v3` (or native): otherwise a packet of 8 is two
//! or more registers, and products and sums take two instructions, with the errors of the index. With `same-bits`, software then rounds
//! them once, which takes several times as long. A debug build of a host compiles the techniques without optimisation; `lights::Lights`,
//! whose routines are compiled with this library, and `etendue-batch` take what the table says, with `opt-level = 3` for dependencies.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod discrete;
pub mod estimate;
mod interop;
mod lanewise;
pub mod light;
#[cfg(feature = "alloc")]
pub mod lights;
#[doc(hidden)]
pub mod listed;
pub mod math;
#[doc(hidden)]
#[cfg(feature = "alloc")]
pub mod owned;
pub mod real;
pub mod reflection;
pub mod select;
pub mod sequence;
pub mod vector;
pub mod warp;

pub use lanewise::Lanewise;
pub use light::{
    BilinearPatch, ConstantEnvironment, DirectionalLight, Disk, LightSample, LightSampler, Line, Parallelogram,
    PointLight, Polygon, Rectangle, Sphere, SpotLight, Sun, Triangle,
};
pub use real::{Mask, Real, Uint};
pub use vector::{Frame, Vec2, Vec3};
pub use warp::Warp;
pub use wide::{f32x4, f32x8, f32x16, f64x4, f64x8, u32x4, u32x8, u32x16};
