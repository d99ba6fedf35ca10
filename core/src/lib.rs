//! Light sampling for renderers: for every shape of light the map from random numbers to directions, its pdf and its inverse, one
//! sample at a time or 4, 8 or 16 at once, without std and without alloc.
//!
//! ```
//! use etendue::{LightSampler, Parallelogram, Vec2, Vec3, f32x8, u32x8, sequence::{Independent, Sequence}};
//! // eight samples of a panel overhead from the origin; the same code serves f32, f32x4, f32x8, f32x16, f64 and f64x4
//! let panel = Parallelogram::new(Vec3::lit([-1.0, 2.0, -1.0]), Vec3::lit([2.0, 0.0, 0.0]), Vec3::lit([0.0, 0.0, 2.0]));
//! let sampler = panel.by_solid_angle(Vec3::lit([0.0; 3]));
//! let u: Vec2<f32x8> = Independent::new(1).pair(u32x8::splat(0), u32x8::from([0, 1, 2, 3, 4, 5, 6, 7]), 0);
//! let light = sampler.sample(u);
//! // irradiance from one sample each, on a receiver that faces up: L cosθ / pdf with L = 1
//! let irradiance = light.direction.y * light.weight();
//! assert!(irradiance.to_array().iter().all(|e| *e > 0.5 && *e < 1.0));
//! ```
//!
//! Start at [`light`] to sample a light, at [`warp`] for maps without a shading point, at [`sequence`] for random numbers, at
//! [`estimate`] for weights of combined techniques, at [`select`] to choose among lights, and at [`occlusion`] for the visible part of a
//! light behind a few convex blockers, without samples.
//!
//! # The contract
//! 1. **Total.** No panic, NaN or infinity for any finite input. Degenerate lanes have pdf 0 and do not affect their neighbours.
//! 2. **Closed.** `invert(sample(u)) = u` to rounding, ∫pdf = 1, and the pdf of a sample is the pdf that is evaluated for its direction.
//! 3. **Threshold-free.** No size, distance or unit at which a routine switches to a worse formula. Scaling all lengths by a power of two
//!    changes no bit of a direction or a pdf.
//! 4. **Lane-identical.** Equal input gives the same bits in `f32`, `f32x4`, `f32x8` and `f32x16`, on every processor and with all
//!    compiler flags. CI compares a hash per routine on x86-64 with and without AVX2, FMA and AVX-512, on 64-bit ARM, and on WebAssembly
//!    with and without vectors.
//! 5. **Bounded.** Each routine states its greatest error, as measured by the tests.
//!
//! *Closed* and *bounded* hold where single precision can express the answer. Below, the table of limits names the exceptions: points
//! nearly in the plane of a flat light, and lights on the horizon. Over the atlas of sizes, elevations, distances and aspect ratios,
//! direction, pdf and inverse stay within 10⁻⁵ in all cells for spheres, disks and lines, in 99 % of them for flat lights by solid angle
//! and in 96 % by projected solid angle (`cargo run --release -- atlas --quick`).
//!
//! # Conventions
//! Lengths may be in any unit. Angles are in radians, or in turns where the name says so; solid angles in steradians; pdfs per steradian
//! or per unit area as stated. `u` is uniform in [0, 1)². Directions are unit vectors that point away from the shading point. Local frames
//! have z up.
//!
#![doc = include_str!("index.md")]
//!
//! # Speed
//! `wide` chooses its vector width when it is compiled. Build with `-C target-cpu=x86-64-v3` (or native); otherwise a packet of 8 is two
//! or more registers, and software computes each fused multiply-add, with the same bits.
#![no_std]
#![forbid(unsafe_code)]

pub mod discrete;
pub mod estimate;
mod interop;
mod lanewise;
pub mod light;
pub mod math;
pub mod occlusion;
pub mod random;
pub mod real;
pub mod select;
pub mod sequence;
pub mod spherical;
pub mod vector;
pub mod warp;

pub use lanewise::Lanewise;
pub use light::{
    BilinearPatch, ConstantEnvironment, Cylinder, DirectionalLight, Disk, LightSample, LightSampler, Line,
    Parallelogram, PointLight, Polygon, Rectangle, Sphere, SpotLight, Sun, Triangle,
};
pub use real::{Mask, Real, Uint};
pub use vector::{Frame, Vec2, Vec3};
pub use warp::{Warp, Warp1};
pub use wide::{f32x4, f32x8, f32x16, f64x4, u32x4, u32x8, u32x16};
