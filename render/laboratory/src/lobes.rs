//! One square light on a glossy surface: how well each sampler estimates what the surface reflects.
//!
//! [`cell`] has the surfaces and the lights, [`moments`] the standard deviation of one sample without the noise of sampling, [`samples`] what
//! the samplers draw, and [`quadrature`] the integrals.

pub mod cell;
pub mod moments;
pub mod quadrature;
pub mod samples;
