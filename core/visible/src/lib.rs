//! Proofs of what hides a light from a part of a surface, and the light that arrives past it: in closed form, without rays and without
//! random numbers. Without std; what is found is in memory on the heap.
//!
//! The host has a tree of its own. It is asked once for what may meet a convex region, and answers with [solids](Solid).
//!
//! ```
//! use etendue::Vec3;
//! use etendue_visible::{Light, Occluder, Patch, Proof, Prover, Solid};
//! // a square light that faces down, a box below it, and a square patch of the floor below both
//! let square = |y: f64, half: f64| [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, z]| Vec3::new(x, y, z));
//! let light = Light::new(Solid::quadrilateral(square(2.0, 1.0)), false).unwrap();
//! let block = Solid::block(Vec3::new(-0.3, 0.9, -0.3), Vec3::new(0.3, 1.0, 0.3)).unwrap();
//! let mut corners = square(0.0, 0.2);
//! corners.reverse(); // counterclockwise from above
//! let patch = Patch::polygon(&corners, 1e-9, 0.0).unwrap();
//! let mut prover = Prover::new(2.0);
//! let mut seen = prover.prove(&patch, &light, |region, found| {
//!     // a host asks its tree what meets the region
//!     region.misses_box(Vec3::new(-0.3, 0.9, -0.3), Vec3::new(0.3, 1.0, 0.3)) || found(Occluder::Whole(block.clone()))
//! });
//! assert_eq!(seen.proof, Proof::Behind(&[block.clone()]));
//! // for any point of the patch: the irradiance by a light of radiance 1, and the greatest error of it
//! let e = seen.irradiance(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)).unwrap();
//! assert!(e.value > 0.2 && e.value < 0.6 && e.error.unwrap() < 2e-5);
//! ```
//!
//! # What is proved, and for which points
//! [`Prover::prove`] considers all segments from any point of a [`Patch`] to any point of a [`Light`] above the horizon of the first.
//! What is level with their ends but for rounding ([`ENDS`]) does not count. What a [`Proof`] says holds for each of them, in double precision, with margins for
//! the rounding of points, of points on the light and of directions in single precision: a shadow ray that is computed in single precision
//! cannot contradict it. A patch is a convex polygon, or the part of a triangle or of a sphere that a [`Pyramid`] of rays sees.
//!
//! # What is never proved
//! - Anything of a light that is no polygon, parallelogram or sphere; of one whose radiance varies, the proof holds, the irradiance does not.
//! - That a light is covered by a sphere, or by several solids together, unless they are two triangles of a quadrilateral or the faces of one
//!   polyhedron. Then the proof is [`Behind`](Proof::Behind), and the irradiance 0 up to its error.
//! - [`Lit`](Proof::Lit) and [`Behind`](Proof::Behind) where something that the host calls [`Within`](Occluder::Within) may be in the way,
//!   or more than [`MOST`] solids; and anything of a patch that straddles the plane of a light, touches a sphere light, or is
//!   inside a sphere.
//! - That more than the patch is lit: points that are further from it than it says are not covered.
//!
//! # What it costs, and when it is not worth asking
//! A proof takes as long as some tens of shadow rays, and the closed form for a point as long as a few (see [`measure`]). So a patch is worth
//! asking about that has a hundred samples or more. It is not worth it among leaves, hair or small triangles, where patches stay
//! [`Open`](Proof::Open); for so many lights that each has few samples; and through lenses and in mirrors, where points are not on few
//! patches. Ask about a large patch first, and about its quarters where it is open: what a patch decides holds for its parts.
//!
//! # Precision
//! [`Seen::irradiance`] computes in double precision. Hosts that compute many points of a patch use [`Occlusion::visible`] themselves, with
//! packets of single precision where [`Seen::precision`] says so; its error is then below [`ALLOWED`] of the light without occluders.
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;

mod between;
mod hull;
mod light;
#[cfg(test)]
mod margins;
pub mod measure;
mod patch;
mod polyhedron;
mod precision;
mod prove;
mod shaft;
mod solid;

pub use hull::V64;
pub use light::Light;
pub use measure::{ENDS, Occlusion};
pub use patch::{Lift, Patch, Pyramid, Viewer};
pub use polyhedron::{Edge, Polyhedron};
pub use precision::{ALLOWED, Precision};
pub use prove::{Irradiance, MOST, Occluder, Proof, Prover, Seen};
pub use shaft::{HalfSpace, Region};
pub use solid::Solid;
