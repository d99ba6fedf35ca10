//! Any number of lights: how long trees take to build, how large they are, and the time of a choice.

use super::published::{Cluster, PublishedTree};
use crate::cost::{self, Rounds, median};
use etendue::select::{LightBound, LightChoice, LightTree, Sequential, TreeChild};
use etendue::sequence::{Independent, Sequence};
use etendue::{Real, Vec2, Vec3, u32x8};
use etendue_render::light_tree::{OwnedTree, Threads};
use etendue_render::packet::{V8, X8};
use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::time::Instant;

/// Lights of a house.
const PER_HOUSE: u32 = 400;
/// Distance of neighbouring houses, and half the width of one.
const PITCH: f32 = 20.0;
const HALF: f32 = 7.0;
/// Packets and samples of each that are timed together: as few as another program is unlikely to interrupt.
const PACKETS: usize = 8;
const SAMPLES: usize = 8;
/// Half the side of a window.
const WINDOW: f32 = 0.4;

/// Windows on the facades of houses that stand in a square, as many houses as it takes.
#[derive(Clone, Copy, Debug)]
pub struct Windows {
    count: u32,
    seed: u64,
}

impl Windows {
    /// So many windows.
    #[must_use]
    pub const fn new(count: u32, seed: u64) -> Self {
        Self { count, seed }
    }
    fn random(&self, i: u32, dimension: u32) -> [f32; 2] {
        let u: Vec2<f32> = Independent::new(self.seed).pair(i, dimension, 0);
        [u.x, u.y]
    }
    fn across(&self) -> u32 {
        f64::from(self.count.div_ceil(PER_HOUSE)).sqrt().ceil() as u32
    }
    fn light(&self, i: u32) -> (LightBound, Cluster) {
        let house = i / PER_HOUSE;
        let [tall, brightness] = self.random(u32::MAX - house, 0);
        let ([along, up], [side, power]) = (self.random(i, 1), self.random(i, 2));
        let (x, z) = ((house % self.across()) as f32 * PITCH, (house / self.across()) as f32 * PITCH);
        let (along, y) = ((along * 2.0 - 1.0) * (HALF - 1.0), 1.0 + up * (10.0 + 40.0 * tall * tall));
        let (sign, turned) = ([-1.0, 1.0][(side * 2.0) as usize & 1], side * 4.0 % 2.0 < 1.0);
        let out = sign * (HALF + 0.01);
        let (center, normal, half) = if turned {
            ([x + along, y, z + out], [0.0, 0.0, sign], [WINDOW, WINDOW, 0.0])
        } else {
            ([x + out, y, z + along], [sign, 0.0, 0.0], [0.0, WINDOW, WINDOW])
        };
        let power = (0.2 + power) * (0.3 + brightness);
        let corner = |sign: f32| std::array::from_fn(|k| center[k] + sign * half[k]);
        let bound =
            LightBound { center, radius: WINDOW * std::f32::consts::SQRT_2, normal, power, ..LightBound::default() };
        (bound, Cluster::light([corner(-1.0), corner(1.0)], normal, power, false))
    }
    /// Bounds of the lights.
    #[must_use]
    pub fn bounds(&self) -> Vec<LightBound> {
        (0..self.count).map(|i| self.light(i).0).collect()
    }
    /// The lights as the published tree knows them.
    #[must_use]
    pub fn clusters(&self) -> Vec<Cluster> {
        (0..self.count).map(|i| self.light(i).1).collect()
    }
    /// Packets of eight neighbouring points of streets and facades.
    #[must_use]
    pub fn packets(&self, count: u32) -> Vec<(V8, V8)> {
        let side = self.across() as f32 * PITCH;
        let packet = |i: u32| {
            let i = i | 1 << 30;
            let ([a, b], [c, d]) = (self.random(i, 3), self.random(i, 4));
            let steps = X8::from([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
            let house = |u: f32| (u * self.across() as f32).floor() * PITCH;
            if c < 0.5 {
                let z = house(b) + PITCH / 2.0 + (d - 0.5) * 5.0;
                let p = V8::new(X8::splat(a * side) + steps, X8::splat(0.0), X8::splat(z));
                (p, V8::from([0.0, 1.0, 0.0]))
            } else {
                let x = house(a) + HALF + 0.02;
                let p = V8::new(X8::splat(x), X8::splat(d * 30.0), X8::splat(house(b) + (c - 0.75) * 26.0) + steps);
                (p, V8::from([1.0, 0.0, 0.0]))
            }
        };
        (0..count).map(packet).collect()
    }
}

/// Numbers of a tree of so many lights.
#[derive(Clone, Copy, Debug, Default)]
pub struct Size {
    /// Number of lights.
    pub lights: u32,
    /// Seconds to build the tree on one thread, and on all.
    pub seconds: [f64; 2],
    /// Size of the tree in bytes.
    pub bytes: usize,
    /// The greatest number of nodes on the way to a light.
    pub levels: u32,
    /// Nanoseconds of a choice and of a pmf, of a lane.
    pub nanoseconds: [f64; 2],
    /// The same for the published tree, with seconds on all threads; `None` if it was not built.
    pub published: Option<Published>,
}

/// Numbers of the published tree.
#[derive(Clone, Copy, Debug, Default)]
pub struct Published {
    /// Seconds to build it on all threads.
    pub seconds: f64,
    /// Size in bytes.
    pub bytes: usize,
    /// Nanoseconds of a choice and of a pmf, of a lane.
    pub nanoseconds: [f64; 2],
}

fn levels(tree: LightTree<'_>) -> u32 {
    let at = tree.at::<f32>(Vec3::default(), Vec3::new(0.0, 0.0, 1.0));
    let (mut most, mut pending) = (0, vec![(0, 1)]);
    while let Some((node, level)) = pending.pop() {
        most = most.max(level);
        pending.extend(at.shares(0, node).into_iter().filter_map(|(_, child)| match child {
            TreeChild::Node(child) => Some((child, level + 1)),
            _ => None,
        }));
    }
    most
}

/// Measures a tree of so many windows.
#[must_use]
pub fn measure(count: u32, seed: u64, published: bool) -> Size {
    let windows = Windows::new(count, seed);
    let bounds = windows.bounds();
    let timed = |build: &mut dyn FnMut()| {
        let start = Instant::now();
        build();
        start.elapsed().as_secs_f64()
    };
    let mut own = None;
    let alone = timed(&mut || drop(black_box(OwnedTree::new(&bounds, &Sequential))));
    let together = timed(&mut || own = OwnedTree::new(&bounds, &Threads).ok());
    drop(bounds);
    let own = own.unwrap_or_else(|| unreachable!("it was built"));
    let mut other = None;
    let clusters = if published { windows.clusters() } else { Vec::new() };
    let seconds = timed(&mut || other = published.then(|| PublishedTree::new(&clusters)));
    drop(clusters);
    let (packets, tree) = (windows.packets(1024), own.get());
    let chosen = RefCell::new(vec![u32x8::splat(0); PACKETS * SAMPLES]);
    let (round, sequence) = (Cell::new(0_u32), Independent::new(seed ^ 0x5ca1e));
    let lanes = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
    let numbers = |k: u32| -> Vec2<X8> { sequence.pair(u32x8::splat(k) + u32x8::splat(round.get() << 16), lanes, 0) };
    // every round has other packets and other numbers
    let part = || {
        let start = round.get() as usize * PACKETS % packets.len();
        let packets = &packets[start..start + PACKETS];
        (0_u32..).zip((0..SAMPLES).flat_map(move |_| packets))
    };
    let mut routines: Vec<Box<dyn FnMut() + '_>> = vec![
        Box::new(|| {
            round.set(round.get() + 1);
            for ((k, &(p, n)), chosen) in part().zip(&mut *chosen.borrow_mut()) {
                let u = numbers(k);
                let [a, b] = [u.x, u.y].map(|u| (u * X8::lit(16_777_216.0)).to_uint());
                let choice = tree.at(p, n).choose_by([a << 8_u32 | b >> 16_u32, b]);
                black_box((choice.pmf, choice.u));
                *chosen = choice.index;
            }
        }),
        Box::new(|| {
            for ((_, &(p, n)), &chosen) in part().zip(&*chosen.borrow()) {
                black_box(tree.at(p, n).pmf(chosen));
            }
        }),
    ];
    if let Some(other) = &other {
        routines.push(Box::new(|| {
            for (k, &(p, n)) in part() {
                let choice = other.choose(p, n, numbers(k).x);
                black_box((choice.index, choice.pmf, choice.u));
            }
        }));
        routines.push(Box::new(|| {
            for ((_, &(p, n)), &chosen) in part().zip(&*chosen.borrow()) {
                black_box(other.pmf(p, n, chosen));
            }
        }));
    }
    let rounds = Rounds { count: 501, calls: 1, samples: 8 * PACKETS * SAMPLES };
    let times = cost::measure(&mut routines, rounds, |_| true);
    let of = |k: usize| median(&times[k]);
    Size {
        lights: count,
        seconds: [alone, together],
        bytes: own.bytes(),
        levels: levels(tree),
        nanoseconds: [of(0), of(1)],
        published: other.as_ref().map(|other| Published { seconds, bytes: other.bytes(), nanoseconds: [of(2), of(3)] }),
    }
}
