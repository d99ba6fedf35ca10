//! The built-in scene `city`: 12 × 12 blocks of four houses at night, with lit windows, street lamps and cars, in metres.
//!
//! Streets run between the blocks: along z at multiples of 84 m of x, and along x at multiples of 64 m of z.

use super::solids::{Point, Sink, cuboid, noise, parallelogram, quad, scaled, sphere, sum};
use std::ops::Range;

/// Numbers of the blocks along each axis.
const BLOCKS: Range<i32> = -6..6;
/// Distances of the streets along x and z, and their width, with pavements.
const PITCH: [f64; 2] = [84.0, 64.0];
const STREET: f64 = 18.0;
const PAVEMENT: f64 = 3.0;
const CURB: f64 = 0.15;

const STOREY: f64 = 3.5;
/// Width and height of a window, the height of its sill above the floor, and how far apart the middles of windows are.
const WINDOW: [f64; 2] = [1.7, 1.7];
const SILL: f64 = 0.9;
const BAY: f64 = 3.0;
/// How far lights are in front of what they are mounted on.
const GAP: f64 = 0.05;

/// What a house is built of.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Facade {
    Brick,
    Concrete,
    Plaster,
}

struct House {
    key: [i32; 3],
    low: [f64; 2],
    high: [f64; 2],
    storeys: i32,
    facade: Facade,
    /// In offices, whole storeys are lit, and the light is colder.
    is_office: bool,
}

impl House {
    fn height(&self) -> f64 {
        // the ground floor is higher
        1.5 + STOREY * f64::from(self.storeys)
    }
    fn random(&self, what: i32) -> f64 {
        let [i, j, lot] = self.key;
        noise(&[i, j, lot, what])
    }
}

fn houses() -> impl Iterator<Item = House> {
    let lots = BLOCKS.flat_map(|i| BLOCKS.flat_map(move |j| (0..4).map(move |lot| [i, j, lot])));
    lots.map(|key| {
        let random = |what: i32| noise(&[key[0], key[1], key[2], what]);
        let (mut low, mut high) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let margin = STREET / 2.0 + PAVEMENT - 2.0;
            let start = f64::from(key[k]) * PITCH[k] + margin;
            let half = PITCH[k] / 2.0 - margin;
            let far = f64::from(key[2] >> k & 1);
            // set back from the pavement, and from the other house
            low[k] = start + far * half + 1.5 + 2.0 * random(k as i32);
            high[k] = start + (far + 1.0) * half - 1.5 - 2.0 * random(2 + k as i32);
        }
        let [x, z] = [0, 1].map(|k| (low[k] + high[k]) / 2.0);
        let central = libm::exp(-(x * x + z * z) / (190.0 * 190.0));
        let storeys = 6.0 + 9.0 * random(4) + central * 30.0 * random(5).powi(2);
        let is_office = storeys > 16.0 || random(6) < 0.2;
        let facade = match (is_office, random(7) < 0.5) {
            (true, _) => Facade::Concrete,
            (_, true) => Facade::Brick,
            _ => Facade::Plaster,
        };
        House { key, low, high, storeys: storeys as i32, facade, is_office }
    })
}

/// The houses of one kind, each with a smaller box on its roof.
pub(super) fn walls(facade: Facade, sink: &mut Sink) {
    for house in houses().filter(|house| house.facade == facade) {
        let ([x0, z0], [x1, z1], height) = (house.low, house.high, house.height());
        cuboid([x0, -0.5, z0], [x1, height, z1], sink);
        let inner = |a: f64, b: f64, share: f64| a + (b - a) * share;
        let (s, t) = (0.2 + 0.3 * house.random(8), 0.2 + 0.3 * house.random(9));
        cuboid(
            [inner(x0, x1, s), height - 0.5, inner(z0, z1, t)],
            [inner(x0, x1, s + 0.3), height + 2.0 + 2.0 * house.random(10), inner(z0, z1, t + 0.3)],
            sink,
        );
    }
}

/// Calls `of` with a corner, both edges and the radiance of each window; a dark one has none. The normal, the product of the edges, points
/// away from the house.
fn windows(mut of: impl FnMut(Point, [Point; 2], Option<[f64; 3]>)) {
    for house in houses() {
        let ([x0, z0], [x1, z1]) = (house.low, house.high);
        let (share, taste) = (0.3 + 0.6 * house.random(11), house.random(12));
        // the left lower corner of each facade as seen from outside, and the direction to the right
        let facades = [
            ([x0 - GAP, z0], [0.0, 1.0], z1 - z0),
            ([x1 + GAP, z1], [0.0, -1.0], z1 - z0),
            ([x1, z0 - GAP], [-1.0, 0.0], x1 - x0),
            ([x0, z1 + GAP], [1.0, 0.0], x1 - x0),
        ];
        for (side, ([x, z], [dx, dz], width)) in (0..).zip(facades) {
            let bays = (width / BAY) as i32;
            let margin = (width - f64::from(bays) * BAY + BAY - WINDOW[0]) / 2.0;
            for (storey, bay) in (0..house.storeys).flat_map(|storey| (0..bays).map(move |bay| (storey, bay))) {
                let [i, j, lot] = house.key;
                let random = |what: i32| noise(&[i, j, lot, what, storey, side, bay]);
                let along = margin + f64::from(bay) * BAY;
                let up = 1.5 + SILL + STOREY * f64::from(storey);
                let is_lit = if house.is_office && noise(&[i, j, lot, 13, storey]) < 0.75 {
                    noise(&[i, j, lot, 14, storey]) < share && random(0) < 0.93
                } else {
                    random(0) < share
                };
                let bright = 0.25 + 1.25 * random(1).powi(2);
                let colour = match (house.is_office, taste + 0.6 * random(2)) {
                    (true, t) if t < 0.9 => [0.75, 0.88, 1.0],
                    (true, _) => [0.92, 1.0, 0.85],
                    // a television
                    (false, _) if random(3) < 0.04 => [0.35, 0.5, 1.0],
                    (false, t) if t < 0.5 => [1.0, 0.86, 0.65],
                    (false, t) if t < 1.0 => [1.0, 0.72, 0.4],
                    (false, _) => [1.0, 0.6, 0.28],
                };
                let corner = [x + along * dx, up, z + along * dz];
                let edges = [[WINDOW[0] * dx, 0.0, WINDOW[0] * dz], [0.0, WINDOW[1], 0.0]];
                of(corner, edges, is_lit.then(|| scaled(colour, bright)));
            }
        }
    }
}

pub(super) fn dark_windows(sink: &mut Sink) {
    windows(|p, [u, v], radiance| {
        if radiance.is_none() {
            quad([p, sum(p, u), sum(p, sum(u, v)), sum(p, v)], sink);
        }
    });
}

/// A slab under each block.
pub(super) fn pavements(sink: &mut Sink) {
    for (i, j) in BLOCKS.flat_map(|i| BLOCKS.map(move |j| (i, j))) {
        let margin = STREET / 2.0 - PAVEMENT;
        let [x, z] = [f64::from(i) * PITCH[0], f64::from(j) * PITCH[1]];
        cuboid([x + margin, -0.5, z + margin], [x + PITCH[0] - margin, CURB, z + PITCH[1] - margin], sink);
    }
}

/// A stretch of a street between two crossings: its start on the middle line, its direction, and its length.
struct Stretch {
    key: [i32; 3],
    start: Point,
    ahead: Point,
    length: f64,
}

impl Stretch {
    /// A point so far along the stretch and to the right of its middle line.
    fn at(&self, along: f64, right: f64, height: f64) -> Point {
        let [x, _, z] = self.ahead;
        sum(sum(self.start, scaled(self.ahead, along)), [-z * right, height, x * right])
    }
    fn random(&self, what: i32) -> f64 {
        noise(&[self.key[0], self.key[1], self.key[2], what])
    }
}

fn stretches() -> impl Iterator<Item = Stretch> {
    let all = BLOCKS.flat_map(|i| BLOCKS.flat_map(move |j| (100..102).map(move |axis| [i, j, axis])));
    all.map(|key| {
        let start = [f64::from(key[0]) * PITCH[0], 0.0, f64::from(key[1]) * PITCH[1]];
        let (ahead, length) = if key[2] == 100 { ([1.0, 0.0, 0.0], PITCH[0]) } else { ([0.0, 0.0, 1.0], PITCH[1]) };
        Stretch { key, start, ahead, length }
    })
}

const LAMP: f64 = 0.22;
const LAMP_HEIGHT: f64 = 6.5;

/// Feet of the lamps of a stretch, on the pavements of both sides, and the side of the street.
fn lamps(stretch: &Stretch) -> impl Iterator<Item = (Point, f64)> {
    let count = (stretch.length / 25.0) as i32;
    let along = move |k: i32| (f64::from(k) + 0.5) / f64::from(count) * (stretch.length - STREET) + STREET / 2.0;
    let side = STREET / 2.0 - PAVEMENT + 0.4;
    (0..count).flat_map(move |k| [-1.0, 1.0].map(|s| (stretch.at(along(k), s * side, CURB), s)))
}

/// Cars in both lanes: the middle of the back, at the height of the road, and the direction, 1 or −1.
fn cars(stretch: &Stretch) -> impl Iterator<Item = (Point, f64)> {
    let places = (0..2).flat_map(|lane| (0..3).map(move |k| (lane, k)));
    places.filter(|(lane, k)| stretch.random(10 + 3 * lane + k) < 0.3).map(|(lane, k)| {
        let direction = if lane == 0 { 1.0 } else { -1.0 };
        let along = 12.0 + (stretch.length - 24.0) * (f64::from(k) + 0.5 * stretch.random(20 + 3 * lane + k)) / 3.0;
        (stretch.at(along, direction * 2.2, 0.0), direction)
    })
}

/// A box in the axes of a car: so far ahead of its back, to its right, and above the road.
fn part_of_car(stretch: &Stretch, back: Point, direction: f64, low: Point, high: Point, sink: &mut Sink) {
    let place = |[along, right, height]: Point| {
        let [x, _, z] = scaled(stretch.ahead, direction);
        sum(back, [x * along - z * right, height, z * along + x * right])
    };
    let (a, b) = (place(low), place(high));
    cuboid([0, 1, 2].map(|k| a[k].min(b[k])), [0, 1, 2].map(|k| a[k].max(b[k])), sink);
}

/// Posts of the lamps, and bodies of the cars.
pub(super) fn metal(sink: &mut Sink) {
    for stretch in stretches() {
        for ([x, y, z], _) in lamps(&stretch) {
            cuboid([x - 0.06, y - 0.2, z - 0.06], [x + 0.06, LAMP_HEIGHT - LAMP - 0.02, z + 0.06], sink);
        }
        for (back, direction) in cars(&stretch) {
            part_of_car(&stretch, back, direction, [0.0, -0.9, 0.3], [4.3, 0.9, 0.85], sink);
            part_of_car(&stretch, back, direction, [0.7, -0.8, 0.85], [3.1, 0.8, 1.45], sink);
        }
    }
}

/// Lit windows, street lamps, headlights and tail lights. The radiance of a bright window is about 1.
pub(super) fn lights(sink: &mut Sink) {
    windows(|p, [u, v], radiance| {
        if let Some(radiance) = radiance {
            parallelogram(p, u, v, radiance, sink);
        }
    });
    for stretch in stretches() {
        for ([x, _, z], _) in lamps(&stretch) {
            sphere([x, LAMP_HEIGHT, z], LAMP, [200.0, 132.0, 62.0], sink);
        }
        for (back, direction) in cars(&stretch) {
            let [x, _, z] = scaled(stretch.ahead, direction);
            let right = [-z, 0.0, x];
            for side in [-0.65, 0.65] {
                let middle = sum(back, sum(scaled(right, side), [0.0, 0.6, 0.0]));
                let edge = scaled(right, 0.3);
                let tail = sum(middle, [-0.03 * x, 0.0, -0.03 * z]);
                let corner = sum(tail, scaled(edge, -0.5));
                parallelogram(corner, edge, [0.0, 0.12, 0.0], [14.0, 0.8, 0.4], sink);
                let head = sum(middle, [4.33 * x, -0.05, 4.33 * z]);
                let corner = sum(head, scaled(edge, 0.5));
                parallelogram(corner, scaled(edge, -1.0), [0.0, 0.18, 0.0], [150.0, 144.0, 125.0], sink);
            }
        }
    }
}
