//! The shortcut of rays that leave a surface, against double precision.

use super::*;
use crate::bvh::double_precision::{to_triangle, wide};
use etendue::Frame;

/// A generator of numbers in [−1, 1) (Marsaglia 2003).
fn number(state: &mut u64) -> f32 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 40) as f32 / 8_388_608.0 - 1.0
}
fn vector(state: &mut u64) -> Vec3<f32> {
    Vec3::new(number(state), number(state), number(state))
}

/// A triangle, and a ray from beside its plane, along it or across, from as far as the shortcut reaches and farther. Every fourth triangle
/// is a sliver.
fn close_call(state: &mut u64) -> ([Vec3<f32>; 3], Vec3<f32>, Vec3<f32>) {
    let (a, b) = (vector(state), vector(state));
    let c = if (*state).is_multiple_of(4) { a + (b - a) * number(state) + vector(state) * 1e-3 } else { vector(state) };
    let normal = (b - a).cross(c - a).normalize();
    let reach = if *state % 5 < 3 { 60.0 } else { 2.5 };
    let [s, t] = [number(state), number(state)].map(|x| x * x * x * reach);
    let lift = number(state) * 10.0_f32.powf(3.5 * (number(state) - 1.0));
    let origin = a + (b - a) * s + (c - a) * t + normal * lift;
    let within = a + (b - a) * number(state).abs() * 0.5 + (c - a) * number(state).abs() * 0.5;
    let towards = if (*state).is_multiple_of(3) { vector(state) } else { within - origin };
    ([a, b, c], origin, (if (*state).is_multiple_of(2) { towards } else { -towards }).normalize())
}

/// No triangle that double precision finds ahead is surely behind, however far it is and however it is seen.
#[test]
fn what_is_surely_behind_is_not_ahead() {
    let (mut state, mut sure, mut far, mut close) = (1, 0, 0, 0);
    for _ in 0..400_000 {
        let cases: [_; 8] = std::array::from_fn(|_| close_call(&mut state));
        let lanes = |f: &dyn Fn(usize) -> Vec3<f32>| {
            let axis = |f: &dyn Fn(usize) -> f32| X8::from_fn(f);
            Vec3::new(axis(&|i| f(i).x), axis(&|i| f(i).y), axis(&|i| f(i).z))
        };
        let corners: [V8; 3] = std::array::from_fn(|k| lanes(&|i| cases[i].0[k]));
        let (origin, direction) = (lanes(&|i| cases[i].1), lanes(&|i| cases[i].2));
        let near = X8::from_fn(|i| from_exponent(near_exponent(&cases[i].0.map(|v| [v.x, v.y, v.z]))));
        let Frame { s, t, .. } = Frame::new(direction);
        let projected = project(corners, origin, [s, t]);
        let distance = projected.distance(direction);
        let behind = (undecided::<false>(distance, near, X8::splat(f32::INFINITY))
            & projected.surely_behind(distance, near))
        .bits();
        for (lane, (corners, origin, direction)) in cases.into_iter().enumerate() {
            if behind >> lane & 1 == 0 {
                continue;
            }
            let exact = to_triangle(corners.map(wide), wide(origin), wide(direction));
            assert!(
                exact.is_none_or(|exact| exact <= 0.0),
                "{exact:?}: {corners:?} from {origin:?} along {direction:?}"
            );
            sure += 1;
            far += u32::from((corners[0] - origin).length() > 16.0 * near.as_array()[lane]);
            close += u32::from(exact.is_some_and(|exact| exact > -0.1 * f64::from(near.as_array()[lane])));
        }
    }
    assert!(sure > 20_000 && far > 5_000 && close > 1_000, "{sure} sure, {far} far, {close} close");
}
