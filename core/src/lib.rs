//! Light sampling for renderers: for every shape of light the map from random numbers to directions, its density and its
//! inverse, one sample at a time or 4 or 8 at once, without std and without alloc.
//!
//! ```
//! use etendue::{Parallelogram, Vec2, f32x8, sequence::{Independent, Sequence}};
//! // eight samples of a panel overhead, seen from the origin; one body serves f32, f32x4, f32x8, f64 and f64x4
//! let panel = Parallelogram {
//!     p: [-1.0, 2.0, -1.0].into(),
//!     u: [2.0, 0.0, 0.0].into(),
//!     v: [0.0, 0.0, 2.0].into(),
//! };
//! let (pixel, samples) = (etendue::u32x8::splat(0), etendue::u32x8::from([0, 1, 2, 3, 4, 5, 6, 7]));
//! let u: Vec2<f32x8> = Independent::new(1).pair(pixel, samples, 0);
//! let light = panel.by_solid_angle([0.0, 0.0, 0.0].into(), u);
//! // irradiance from one sample each, on a receiver that faces up: L cosθ / pdf, with L = 1
//! let irradiance = light.direction.y / light.pdf;
//! assert!(irradiance.to_array().iter().all(|e| *e > 0.5 && *e < 1.0));
//! ```
//!
//! # The contract
//! 1. **Total.** No panic, NaN or infinity for any finite input; degenerate lanes have pdf 0 and never spoil their neighbours.
//! 2. **Closed.** `invert(sample(u)) = u`, ∫pdf = 1, and the pdf of a sample is the pdf that is evaluated for its direction.
//! 3. **Threshold-free.** No size, distance or unit at which a routine changes to a worse answer; scaling all lengths by a power of
//!    two changes no bit of a direction or a density.
//! 4. **Lane-identical.** `f32`, `f32x4` and `f32x8` give the same bits.
//! 5. **Bounded.** The greatest error is stated, as measured by the tests.
//!
//! # Conventions
//! Lengths in any unit; angles in radians, or in turns where the name says so; solid angles in steradians; densities per steradian
//! or per unit area as stated. `u` is uniform in [0, 1)². Directions are unit vectors pointing away from the shading point.
//! Local frames have z up.
//!
#![doc = include_str!("index.md")]
//!
//! # Speed
//! `wide` chooses its vector width when it is compiled. Build with `-C target-cpu=x86-64-v3` (or native), or a packet of 8
//! is two or more registers and has no fused multiply-add.
#![no_std]
#![forbid(unsafe_code)]

pub mod discrete;
pub mod estimate;
mod interop;
mod lanewise;
pub mod light;
pub mod math;
pub mod random;
pub mod real;
pub mod select;
pub mod sequence;
pub mod spherical;
pub mod vector;
pub mod warp;

pub use light::{
    BilinearPatch, ConstantEnvironment, Cylinder, DirectionalLight, Disk, LightSample, LightSampler, Line,
    Parallelogram, PointLight, Polygon, Rectangle, Sphere, SpotLight, Sun, Triangle,
};
pub use real::{Mask, Real, Uint};
pub use vector::{Frame, Vec2, Vec3};
pub use warp::{Warp, Warp1};
pub use wide::{f32x4, f32x8, f64x4, u32x4, u32x8};
