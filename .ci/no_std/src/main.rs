//! Irradiance under a sphere and under a panel, without std, alloc or libc (Linux, x86-64): the exit code is the result.
#![no_std]
#![no_main]

use core::arch::{asm, global_asm};
use etendue::sequence::{Sequence, Stratified};
use etendue::{LightSample, Mask, Parallelogram, Real, Sphere, Vec2, Vec3, f32x8, u32x8};

// the kernel enters here with an aligned stack; a function expects that of its caller before the call
global_asm!(".globl _start", "_start:", "and rsp, -16", "call {main}", "ud2", main = sym main);

fn exit(code: u32) -> ! {
    // SAFETY: system call 60 is exit, which takes a code and does not return
    unsafe { asm!("syscall", in("rax") 60, in("rdi") code, options(noreturn)) }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    exit(101)
}

const SAMPLES: u32 = 1 << 14;

/// Mean of cosθ/pdf over samples of a light with radiance 1, on a receiver that faces up.
fn irradiance(sample: impl Fn(Vec2<f32x8>) -> LightSample<f32x8>) -> f32 {
    let strata = Stratified::new(1, SAMPLES);
    let mut sum = f32x8::splat(0.0);
    for start in (0..SAMPLES).step_by(8) {
        let index = u32x8::from(core::array::from_fn(|lane| start + lane as u32));
        let light = sample(strata.pair(u32x8::splat(0), index, 0));
        sum += (light.direction.y / light.pdf).keep(light.emits & light.pdf.gt(f32x8::splat(0.0)));
    }
    (0..8).map(|i| sum.lane(i)).sum::<f32>() / SAMPLES as f32
}

extern "C" fn main() -> ! {
    let origin = Vec3::from([0.0; 3]);
    // E = π R²/d², here π/4
    let sphere = Sphere { center: [0.0, 2.0, 0.0].into(), radius: f32x8::splat(1.0) };
    let by_solid_angle = irradiance(|u| sphere.by_solid_angle(origin, u));
    let panel = Parallelogram { p: [-1.0, 1.5, -1.0].into(), u: [2.0, 0.0, 0.0].into(), v: [0.0, 0.0, 2.0].into() };
    let (one, other) = (irradiance(|u| panel.by_area(origin, u)), irradiance(|u| panel.by_solid_angle(origin, u)));
    let same = (one - other).abs() < 1e-3 * one;
    let all = f32x8::splat(one).gt(f32x8::splat(0.0)).all();
    // 50 where everything is right
    exit(if same && all { (by_solid_angle * 200.0 * core::f32::consts::FRAC_1_PI).round_ties_even() as u32 } else { 1 })
}
