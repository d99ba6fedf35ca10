//! How much of a light is visible past a few convex occluders: the projected solid angle of the visible part, without random numbers.
//!
//! A diffuse surface with albedo ρ reflects ρ/π · L · Ω⊥, where Ω⊥ is the projected solid angle of the visible part of a light with the
//! radiance L. [`Occlusion::visible`] computes it for one light, some occluders, and as many shading points as there are lanes.
//!
//! ```
//! use etendue::{Vec3, f32x8};
//! use etendue_visible::{Occlusion, Solid};
//! let square = |y: f64, half: f64| {
//!     let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
//!     Solid::quadrilateral(corners.map(|[x, z]| Vec3::new(x, y, z)))
//! };
//! let (light, occluder) = (square(2.0, 1.0), square(1.0, 0.25));
//! // eight points below the light; the occluder hides the middle of the light from the first of them
//! let point = Vec3::new(f32x8::from([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5]), f32x8::ZERO, f32x8::ZERO);
//! let normal = Vec3::lit([0.0, 1.0, 0.0]);
//! let mut occlusion = Occlusion::new();
//! let all = occlusion.visible(point, normal, &light, &[]).unwrap();
//! let part = occlusion.visible(point, normal, &light, &[occluder]).unwrap();
//! assert!(part.as_array()[0] < 0.8 * all.as_array()[0] && part.as_array()[7] == all.as_array()[7]);
//! ```
//!
//! - Formula: Ω⊥(L \ ∪Bᵢ) = Ω⊥(L) − Σᵢ Ω⊥((L ∩ Bᵢ) \ ∪ⱼ₍ⱼ﹤ᵢ₎Bⱼ), recursively. All intersections are convex. A polygon is clipped by planes
//!   through the point (Sutherland and Hodgman 1974) and has Ω⊥ = ½ n·Σ θᵢ Γᵢ over its edges, with their angles θᵢ and unit normals Γᵢ
//!   (Lambert 1760; Baum, Rushmeier and Winget 1989). For a sphere, arcs of its circle replace the edges outside: from the azimuth φ₁ to φ₂
//!   about the axis a, an arc of half-angle α has ∫ r × dr = sin²α (φ₂ − φ₁) a + sinα cosα a × (e(φ₂) − e(φ₁)).
//! - Domain: any points and shapes with finite coordinates. A point lies outside of spheres, and in front of what it sees.
//! - What lies behind the light, or between the point and the light but within 2⁻¹⁷ of the way from the light, does not occlude. A sphere
//!   ends at the circle in which its tangents from the point touch it.
//! - Degenerate input: occluders without area hide nothing. A light that is seen edge-on, lies below the horizon or has no area has Ω⊥ = 0.
//! - Greatest error: see [`Occlusion::visible`].
//!
//! `benches/RESULTS.md` has the times. An occluder beside the light takes a quarter of the time of one before it.
//!

mod cap;
mod capacity;
mod flat;
mod line;
mod outline;
mod planes;
mod visible;

pub use capacity::OCCLUDERS;
pub use outline::COMPACT;
pub use visible::{ENDS, Occlusion};
