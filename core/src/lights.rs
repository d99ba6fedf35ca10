//! A set of lights of any kind, chosen and sampled by one call.
//!
//! ```
//! use etendue::lights::{Emitter, Lights, Receiver, Side};
//! use etendue::{ConstantEnvironment, PointLight, Sphere, Vec3};
//! // lights of any kind, each with its radiance or intensity
//! let lamps: [(Emitter<f32>, f32); 3] = [
//!     (Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), 0.3).into(), 8.0),
//!     (PointLight::new(Vec3::lit([2.0, 1.0, 0.0])).into(), 1.5),
//!     (ConstantEnvironment.into(), 0.2),
//! ];
//! let lights = Lights::new(lamps)?;
//! let (point, normal) = (Vec3::lit([0.5, 0.0, 0.0]), Vec3::lit([0.0, 1.0, 0.0]));
//! let at = lights.at(Receiver { point, side: Side::Surface(normal), on: None });
//! let s = at.sample([0.3, 0.6, 0.2]);
//! // here a renderer traces a shadow ray along s.direction up to s.reach()
//! let radiance = [8.0, 1.5, 0.2][s.which.light as usize];
//! let irradiance = radiance * normal.dot(s.direction).max(0.0) * s.weight();
//! assert!(irradiance > 0.0 && (s.delta || at.pdf(s.which, s.direction) == s.pdf));
//! # Ok::<(), etendue::select::LightsError>(())
//! ```
//!
//! # Other hosts
//! That is *direct light*. *Multiple importance sampling* also follows the rays that a surface proposes, and weights both by their pdfs:
//!
//! ```
//! # use etendue::lights::{Lights, Receiver, Side};
//! # use etendue::{Frame, Sphere, Vec2, Vec3, Warp, estimate::Heuristic, sequence::{OwenSobol, Sequence}, warp::CosineHemisphere};
//! # use std::f32::consts::PI;
//! # let ball = Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), 1.0_f32);
//! # let lights = Lights::new([(ball, 8.0)])?;
//! # let (point, normal) = (Vec3::lit([0.0; 3]), Vec3::<f32>::lit([0.0, 1.0, 0.0]));
//! # let at = lights.at(Receiver { point, side: Side::Surface(normal), on: None });
//! # let hits_ball = |w: Vec3<f32>| w.y > 0.75_f32.sqrt();
//! # let mut sum = 0.0;
//! # for i in 0..1024 {
//! # let [u, v]: [Vec2<f32>; 2] = [0, 1].map(|k| OwenSobol::new(1).pair(0_u32, i, k));
//! // one sample of the light; a delta light is met in no other way
//! let s = at.sample([u.x, u.y, 0.5]);
//! let by_surface = |w: Vec3<f32>| normal.dot(w).max(0.0) / PI;
//! let [weight, _] = Heuristic::Power(2).weights([s.pdf, if s.delta { 0.0 } else { by_surface(s.direction) }]);
//! let mut irradiance = 8.0 * normal.dot(s.direction).max(0.0) * s.weight() * weight;
//! // one of the surface: here a ray finds what it hits
//! let w = Frame::new(normal).to_world(CosineHemisphere.sample(v));
//! if hits_ball(w) {
//!     let [_, weight] = Heuristic::Power(2).weights([at.pdf(0, w), by_surface(w)]);
//!     irradiance += 8.0 * PI * weight;
//! }
//! # sum += irradiance / 1024.0;
//! # }
//! # assert!((sum / (8.0 * PI * 0.25) - 1.0).abs() < 0.01, "{sum}");
//! # Ok::<(), etendue::select::LightsError>(())
//! ```
//!
//! A *point of a volume* has no side; its phase function takes the place of the cosine:
//!
//! ```
//! # use etendue::lights::{Lights, Receiver, Side};
//! # use etendue::{Sphere, Vec2, Vec3, sequence::{OwenSobol, Sequence}};
//! # use std::f32::consts::PI;
//! # let lights = Lights::new([(Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), 1.0_f32), 8.0)])?;
//! # let point = Vec3::lit([0.0; 3]);
//! let at = lights.at(Receiver { point, side: Side::None, on: None });
//! # let mut sum = 0.0;
//! # for i in 0..256 {
//! # let u: Vec2<f32> = OwenSobol::new(1).pair(0_u32, i, 0);
//! let s = at.sample([u.x, u.y, 0.5]);
//! let scattered = 8.0 * s.weight() / (4.0 * PI); // times the transmittance up to s.reach()
//! # sum += scattered / 256.0;
//! # }
//! # assert!((sum / (4.0 * (1.0 - 0.75_f32.sqrt())) - 1.0).abs() < 1e-3, "{sum}");
//! # Ok::<(), etendue::select::LightsError>(())
//! ```
//!
//! *Many lights* are the same call, which chooses by a tree; the third number serves the choice, and `s.pdf` and `at.pdf` contain its chance:
//!
//! ```
//! # use etendue::lights::{Lights, Receiver, Side};
//! # use etendue::{Sphere, Vec3, sequence::{Independent, Sequence}};
//! let bulb = |i: u32| Sphere::new(Vec3::new((i % 100) as f32, 3.0, (i / 100) as f32), 0.05);
//! let lights = Lights::new((0..10_000).map(|i| (bulb(i), 8.0)))?;
//! let (point, normal) = (Vec3::<f32>::lit([30.2, 0.0, 71.4]), Vec3::lit([0.0, 1.0, 0.0]));
//! let at = lights.at(Receiver { point, side: Side::Surface(normal), on: None });
//! # let mut sum = 0.0_f64;
//! # for i in 0..20_000 {
//! # let [a, b]: [etendue::Vec2<f32>; 2] = [0, 1].map(|k| Independent::new(1).pair(0_u32, i, k));
//! # let u = [a.x, a.y, b.x];
//! let s = at.sample(u);
//! let irradiance = 8.0 * normal.dot(s.direction).max(0.0) * s.weight();
//! # sum += f64::from(irradiance) / 20_000.0;
//! # }
//! # let of = |i: u32| {
//! #     let d = bulb(i).center - point;
//! #     let square = d.dot(d);
//! #     f64::from(8.0 * std::f32::consts::PI * 0.05 * 0.05 * (d.y / square.sqrt()) / square)
//! # };
//! # let exact: f64 = (0..10_000).map(of).sum();
//! # assert!((sum / exact - 1.0).abs() < 0.05, "{sum} {exact}");
//! # Ok::<(), etendue::select::LightsError>(())
//! ```
//!
//! [`Lights`] are of `f32` or `f64`, and compiled with this library: a debug build of a host with `opt-level = 3` for its dependencies calls
//! optimised code.
//!
//! What cannot send light, such as a sphere with a negative radius, is dark without a word. The sample of an empty set has the weight 0 and
//! names light 0: a host that looks that up asks [`Lights::is_empty`] first.

mod emission;
mod emitter;
mod mixture;
mod prepared;
mod receiver;
mod set;

pub use emission::Emission;
pub use emitter::Emitter;
pub use mixture::{Mixture, MixtureAt, Source};
pub use receiver::{LightsSample, Receiver, Side, Which};
pub use set::{Lights, LightsAt, Number};
