//! One light, one shading point, 64 samples: the light is prepared once, and each packet of eight samples pays for its map alone.
//!
//! `cargo run --release -p etendue --example prepare_once`

use etendue::sequence::{OwenSobol, Sequence};
use etendue::{Lanewise, LightSampler, Triangle, Uint, Vec2, f32x8, u32x8};

fn main() {
    let light = Triangle::new([0.0, 1.0, 0.0].into(), [1.0, 1.0, 0.0].into(), [0.0, 1.0, 1.0_f32].into());
    // prepared in scalars, then repeated in eight lanes
    let sampler = light.by_solid_angle([0.2, 0.0, 0.1].into()).splat::<f32x8>();
    let mut irradiance = 0.0;
    for k in 0..8 {
        let u: Vec2<f32x8> = OwenSobol::new(7).pair(u32x8::splat(0), u32x8::from_fn(|lane| 8 * k + lane as u32), 0);
        let s = sampler.sample(u);
        // the receiver faces up; invalid lanes weigh nothing
        irradiance += (s.direction.y * s.weight()).reduce_add() / 64.0;
    }
    println!("irradiance per unit of radiance: {irradiance:.5} over {:.5} sr", sampler.solid_angle().to_array()[0]);
}
