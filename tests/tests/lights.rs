//! Lights: what their samplers return.

mod area;
mod below_the_horizon;
mod environment;
mod irradiance;
mod mistakes_of_hosts;
mod on_surface;
mod patches;
mod pictures;
mod polygon;
mod portals;
mod projected;
mod samplers;
mod sets;
