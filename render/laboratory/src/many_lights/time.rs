//! The time of each part of a sample: the choice, its pmf, the sample of the light, and the shadow ray.

use super::moments::Method;
use super::stage::{Point, ROWS, Stage};
use crate::cost::{self, Rounds, median};
use etendue::discrete::AliasTable;
use etendue::select::{Choice, LightChoice, UniformLights};
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Vec2, u32x8};
use etendue_render::bvh::{Rays, Scratch};
use etendue_render::packet::{M8, V8, X8, equal};
use etendue_render::surfaces::Surface;
use etendue_render::technique::Measure;
use std::cell::{Cell, RefCell};
use std::hint::black_box;

/// The methods whose time is measured.
pub const TIMED: [Method; 5] = [Method::Uniform, Method::Power, Method::Published, Method::Intensity, Method::Own];

/// Samples of each pixel of a block that are timed together: as few as another program is unlikely to interrupt.
const SAMPLES: usize = 16;

/// How long the parts of a sample take, in nanoseconds a lane.
#[derive(Clone, Copy, Debug, Default)]
pub struct Times {
    /// Choosing a light.
    pub choose: f64,
    /// Evaluating the pmf of a light.
    pub pmf: f64,
    /// Sampling the light that was chosen.
    pub sample: f64,
    /// Tracing its shadow ray.
    pub shadow: f64,
}

impl Times {
    /// The time of a whole sample, which needs no separate pmf.
    #[must_use]
    pub fn all(&self) -> f64 {
        self.choose + self.sample + self.shadow
    }
}

/// Chooses lights at points of surfaces.
pub struct Chooser<'a> {
    stage: &'a Stage,
    method: Method,
    table: AliasTable<'a>,
}

impl Chooser<'_> {
    #[inline(always)]
    fn choose(&self, p: V8, n: V8, pixel: u32x8, sequence: Independent) -> Choice<X8> {
        let lanes = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let u = || -> Vec2<X8> { sequence.pair(pixel, lanes, 0) };
        match self.method {
            Method::Uniform => UniformLights { count: self.stage.lights.len() as u32 }.choose(u().x),
            Method::Power => {
                let cell = self.table.cell(u().x);
                Choice { index: cell.index, pmf: cell.pmf, u: cell.offset }
            }
            Method::Published => self.stage.published.choose(p, n, u().x),
            Method::Intensity => self.stage.intensity.choose(p, n, u().x),
            Method::Own | Method::Exhaustive => {
                let u = u();
                let bits = [u.x, u.y].map(|u| (u * X8::lit(16_777_216.0)).to_uint());
                self.stage.own.get().at(p, n).choose_by([bits[0] << 8u32 | bits[1] >> 16u32, bits[1]])
            }
        }
    }
    #[inline(always)]
    fn pmf(&self, p: V8, n: V8, light: u32x8) -> X8 {
        match self.method {
            Method::Uniform => UniformLights { count: self.stage.lights.len() as u32 }.pmf(light),
            Method::Power => self.table.pmf(light),
            Method::Published => self.stage.published.pmf(p, n, light),
            Method::Intensity => self.stage.intensity.pmf(p, n, light),
            Method::Own | Method::Exhaustive => self.stage.own.get().at(p, n).pmf(light),
        }
    }
}

/// What a method has drawn for a packet.
struct Ready {
    rays: Rays,
    limit: X8,
    target: u32x8,
    lit: M8,
}

impl Stage {
    /// Measures all parts at these points: medians over rounds, in which the methods take turns. `go_on` says whether to continue.
    pub fn times(
        &self,
        blocks: &[[Surface; ROWS]],
        seed: u64,
        rounds: usize,
        go_on: impl FnMut(usize) -> bool,
    ) -> [Times; TIMED.len()] {
        // lanes that show nothing repeat the first that does, so that every lane counts
        let packets: Vec<[Point<V8>; ROWS]> = blocks
            .iter()
            .filter_map(|block| {
                let lanes = |s: &Surface| {
                    let s = *s;
                    (0..8).filter(move |&k| s.reflects.lane(k)).map(move |k| Point::lane(&s, k))
                };
                let all: Vec<Point<[f32; 3]>> = block.iter().flat_map(lanes).collect();
                (!all.is_empty()).then(|| {
                    std::array::from_fn(|row| {
                        let of = |part: fn(&Point<[f32; 3]>) -> [f32; 3]| {
                            let rows: [[f32; 3]; 8] =
                                std::array::from_fn(|k| part(&all[(8 * row + k).min(all.len() - 1)]));
                            let [x, y, z] = [0, 1, 2].map(|k| X8::from(rows.map(|row| row[k])));
                            V8::new(x, y, z)
                        };
                        Point { p: of(|p| p.p), n: of(|p| p.n), albedo: of(|p| p.albedo) }
                    })
                })
            })
            .collect();
        let count = SAMPLES * ROWS;
        let (mut thresholds, mut aliases) = (vec![0.0; self.powers.len()], vec![0; self.powers.len()]);
        let table = AliasTable::build(&self.powers, &mut thresholds, &mut aliases).expect("lights with power");
        let choosers = TIMED.map(|method| Chooser { stage: self, method, table });
        let sequence = Independent::new(seed);
        let chosen: [_; TIMED.len()] = std::array::from_fn(|_| RefCell::new(vec![u32x8::splat(0); count]));
        let ready: [_; TIMED.len()] = std::array::from_fn(|_| RefCell::new(Vec::<Ready>::with_capacity(count)));
        let counters: [_; TIMED.len()] = std::array::from_fn(|_| Cell::new(0_u32));
        let lanes = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let mut routines: Vec<Box<dyn FnMut() + '_>> = Vec::new();
        for (((chooser, chosen), ready), counter) in choosers.iter().zip(&chosen).zip(&ready).zip(&counters) {
            let packets = &packets;
            // every round has another block and other numbers
            let block = move || (0..SAMPLES).flat_map(move |_| &packets[counter.get() as usize % packets.len()]);
            routines.push(Box::new(move || {
                counter.set(counter.get() + 1);
                for (k, (at, chosen)) in (0_u32..).zip(block().zip(&mut *chosen.borrow_mut())) {
                    let pixel = u32x8::splat(k) + u32x8::splat(counter.get() << 16);
                    let choice = chooser.choose(at.p, at.n, pixel, sequence);
                    black_box((choice.pmf, choice.u));
                    *chosen = choice.index;
                }
            }));
            routines.push(Box::new(move || {
                for (at, &chosen) in block().zip(&*chosen.borrow()) {
                    black_box(chooser.pmf(at.p, at.n, chosen));
                }
            }));
            routines.push(Box::new(move || {
                let (chosen, mut ready) = (chosen.borrow(), ready.borrow_mut());
                ready.clear();
                for (k, (at, &index)) in (0_u32..).zip(block().zip(&*chosen)) {
                    let u = sequence.pair(u32x8::splat(k), lanes, 1);
                    let none = equal(index, u32x8::splat(u32::MAX));
                    let index = X8::blend_uint(none, u32x8::splat(0), index);
                    let (light, sample, value) = self.sample(index, Measure::SolidAngle, at, u);
                    let (rays, limit) = self.shadow(at, &sample);
                    ready.push(Ready { rays, limit, target: light.shape, lit: value.gt(X8::lit(0.0)) & !none });
                }
            }));
            let mut scratch = Scratch::default();
            routines.push(Box::new(move || {
                for group in ready.borrow().chunks_exact(ROWS) {
                    let each = |k: usize| &group[k];
                    let rays: [Rays; ROWS] = std::array::from_fn(|k| each(k).rays);
                    let mut lit: [M8; ROWS] = std::array::from_fn(|k| each(k).lit);
                    let limit: [X8; ROWS] = std::array::from_fn(|k| each(k).limit);
                    let target: [u32x8; ROWS] = std::array::from_fn(|k| each(k).target);
                    self.surfaces.bvh.occluded(&rays, &mut lit, &limit, &target, &mut scratch);
                    black_box(lit);
                }
            }));
        }
        let plan = Rounds { count: rounds, calls: 1, samples: 8 * count };
        let times = cost::measure(&mut routines, plan, go_on);
        let of = |k: usize| median(&times[k]);
        std::array::from_fn(|m| Times {
            choose: of(4 * m),
            pmf: of(4 * m + 1),
            sample: of(4 * m + 2),
            shadow: of(4 * m + 3),
        })
    }
}
