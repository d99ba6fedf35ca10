//! The built-in scene `chandelier`: bulbs and glass on five rings of brass, over a table between columns, in metres.

use super::solids::{Point, Sink, WHITE, cuboid, noise, parallelogram, ring, rod, scaled, sphere, sum, turned};
use std::f64::consts::TAU;

/// Where the axis of the chandelier meets the floor, and the height of the ceiling.
const AXIS: Point = [0.0, 0.0, -0.5];
const CEILING: f64 = 5.0;
/// Radius, height and number of bulbs of each ring.
const RINGS: [(f64, f64, i32); 5] =
    [(1.3, 2.75, 48), (1.08, 3.05, 40), (0.84, 3.35, 32), (0.6, 3.65, 24), (0.36, 3.95, 16)];
/// Plates of glass below each bulb, one below the other.
const PLATES: i32 = 5;
/// Strings of glass below the middle, and plates on each.
const DROPS: [i32; 2] = [8, 5];
const BULB: f64 = 0.022;
/// Height of a candle, including its cup.
const CANDLE: f64 = 0.13;
const COLUMNS: [[f64; 2]; 4] = [[-2.9, -3.4], [2.9, -3.4], [-2.9, 1.2], [2.9, 1.2]];

fn on_ring(radius: f64, height: f64, angle: f64) -> Point {
    sum(AXIS, [radius * libm::cos(angle), height, radius * libm::sin(angle)])
}

/// The angle of each bulb of a ring.
fn angles(bulbs: i32) -> impl Iterator<Item = f64> {
    (0..bulbs).map(move |k| TAU * f64::from(k) / f64::from(bulbs))
}

/// The frame: rings, arms, candles, and a turned stem that hangs from the ceiling.
pub(super) fn brass(sink: &mut Sink) {
    let stem = [
        [0.0, 2.62],
        [0.05, 2.66],
        [0.09, 2.75],
        [0.05, 2.85],
        [0.03, 3.0],
        [0.07, 3.2],
        [0.03, 3.4],
        [0.02, 3.7],
        [0.05, 3.95],
        [0.02, 4.2],
        [0.015, CEILING - 0.12],
        [0.1, CEILING - 0.1],
        [0.12, CEILING - 0.001],
        [0.0, CEILING - 0.001],
    ];
    turned(AXIS, &stem, 24, sink);
    for (radius, height, bulbs) in RINGS {
        ring(sum(AXIS, [0.0, height, 0.0]), radius, 0.014, 96, sink);
        for angle in angles(bulbs / 4) {
            // an arm sags between the stem and the ring
            let along = |t: f64| on_ring(radius * t, height - 0.12 * libm::sin(std::f64::consts::PI * t), angle);
            (0..8).for_each(|k| rod(along(f64::from(k) / 8.0), along(f64::from(k + 1) / 8.0), 0.006, sink));
        }
        let candle = [[0.0, 0.005], [0.02, 0.02], [0.025, 0.03], [0.012, 0.03], [0.012, CANDLE], [0.0, CANDLE]];
        angles(bulbs).for_each(|angle| turned(on_ring(radius, height, angle), &candle, 8, sink));
    }
}

/// The columns.
pub(super) fn marble(sink: &mut Sink) {
    for [x, z] in COLUMNS {
        cuboid([x - 0.32, -0.01, z - 0.32], [x + 0.32, 0.22, z + 0.32], sink);
        cuboid([x - 0.32, CEILING - 0.2, z - 0.32], [x + 0.32, CEILING + 0.01, z + 0.32], sink);
        let shaft = [
            [0.3, 0.22],
            [0.31, 0.27],
            [0.3, 0.32],
            [0.24, 0.36],
            [0.23, 2.0],
            [0.2, CEILING - 0.42],
            [0.23, CEILING - 0.4],
            [0.23, CEILING - 0.36],
            [0.3, CEILING - 0.2],
        ];
        turned([x, 0.0, z], &shaft, 40, sink);
    }
}

/// A round table with glasses on it, and chairs around.
pub(super) fn wood(sink: &mut Sink) {
    let table = [
        [0.45, -0.01],
        [0.45, 0.05],
        [0.1, 0.12],
        [0.08, 0.6],
        [0.2, 0.7],
        [1.3, 0.72],
        [1.32, 0.74],
        [1.3, 0.76],
        [0.0, 0.76],
    ];
    turned(AXIS, &table, 64, sink);
    let goblet =
        [[0.035, 0.761], [0.035, 0.765], [0.006, 0.77], [0.006, 0.85], [0.035, 0.88], [0.042, 0.93], [0.036, 0.98]];
    let vase =
        [[0.09, 0.761], [0.13, 0.8], [0.16, 0.9], [0.13, 1.02], [0.06, 1.1], [0.05, 1.16], [0.08, 1.2], [0.0, 1.1]];
    turned(AXIS, &vase, 32, sink);
    for angle in angles(8).map(|angle| angle + TAU / 16.0) {
        turned(on_ring(1.05, 0.0, angle), &goblet, 16, sink);
        // a chair that faces the table: seat and back are thick rods
        let (out, across) = ([libm::cos(angle), 0.0, libm::sin(angle)], [-libm::sin(angle), 0.0, libm::cos(angle)]);
        let at = |far: f64, side: f64, height: f64| {
            sum(AXIS, sum(scaled(out, far), sum(scaled(across, side), [0.0, height, 0.0])))
        };
        for side in [-0.2, 0.2] {
            rod(at(1.45, side, 0.0), at(1.45, side, 0.46), 0.022, sink);
            rod(at(1.85, side, 0.0), at(1.92, side, 1.05), 0.022, sink);
        }
        for k in 0..9 {
            let far = 1.45 + 0.05 * f64::from(k);
            rod(at(far, -0.22, 0.47), at(far, 0.22, 0.47), 0.027, sink);
        }
        for k in 0..4 {
            let (height, lean) = (0.65 + 0.12 * f64::from(k), 0.012 * f64::from(k));
            rod(at(1.89 + lean, -0.2, height), at(1.89 + lean, 0.2, height), 0.03, sink);
        }
    }
}

/// 160 spheres just above the candles.
pub(super) fn bulbs(sink: &mut Sink) {
    for (radius, height, bulbs) in RINGS {
        for angle in angles(bulbs) {
            sphere(on_ring(radius, height + CANDLE + BULB + 0.004, angle), BULB, WHITE, sink);
        }
    }
}

/// 840 plates on strings: below each bulb and below the middle. Each is turned about the vertical, and has a brightness and tint of its own.
pub(super) fn glass(sink: &mut Sink) {
    let mut plate = |top: Point, key: [i32; 3]| {
        let random = |k: i32| noise(&[key[0], key[1], key[2], k]);
        let angle = TAU * random(0);
        let (width, height) = (0.03, 0.042);
        let u = [width * libm::cos(angle), 0.0, width * libm::sin(angle)];
        let v = [0.0, height, 0.0];
        let corner = sum(top, sum(scaled(u, -0.5), [0.0, -height, 0.0]));
        // few plates sparkle, most are dim
        let bright = 0.1 + 0.9 * random(1).powi(6);
        let tint = [random(2), random(3), random(4)].map(|x| bright * (0.75 + 0.25 * x));
        parallelogram(corner, u, v, tint, sink);
    };
    for (tier, (radius, height, bulbs)) in (0..).zip(RINGS) {
        for (k, angle) in (0..).zip(angles(bulbs)) {
            for n in 0..PLATES {
                plate(on_ring(radius, height - 0.03 - 0.05 * f64::from(n), angle), [tier, k, n]);
            }
        }
    }
    for (k, angle) in (0..).zip(angles(DROPS[0])) {
        for n in 0..DROPS[1] {
            let (radius, down) = (0.12 - 0.02 * f64::from(n), 0.05 * f64::from(n));
            plate(on_ring(radius, 2.58 - down, angle), [-1, k, n]);
        }
    }
}
