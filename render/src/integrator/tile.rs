//! Renders the samples of a square of pixels.

use super::adaptive::{Statistics, StatisticsSum};
use super::allocation::{Blocks, Weights};
use super::known::Survey;
use super::paths::{Numbers, Paths};
use super::prepared::PreparedScene;
use super::radiance::Radiance;
use super::settings::{RayCount, Settings, TILE};
use crate::area::Area;
use crate::bvh::GROUP;
use crate::camera::{Camera, CameraSample, counted_from};
use crate::film::Accumulator;
use crate::packet::{M8, X8};
use crate::sampler::{CHOICE, FILM, LENS, Packet, Redrawn, SURFACE, Source};
use crate::sensor::Exposure;
use etendue::select::Allocated;
use etendue::{Mask, Real, Vec2, u32x8};
use std::ops::Range;

/// The squared error of a light with contribution c falls about as c² n^−1.5. For a given Σn the sum is least with n ∝ c^0.8.
const POWER: f32 = 0.8;

/// So many lights may take all samples of a block.
const FREE: usize = 8;
/// The same where certificates are asked for: most of these lights are known, and their samples would be wasted. The test
/// `known_lights_take_no_samples_from_others` prints 1.0 times the variance with 4, and 32 times with 8.
const FREE_IF_ASKED: usize = 4;

/// Renders tiles, and keeps the scratch memory for it.
pub(super) struct TileRenderer<'a> {
    scene: &'a PreparedScene,
    settings: &'a Settings,
    /// The camera, and the weights of radiance if there are any, for positions counted from the first pixel of the image.
    whole: (Camera, Option<Exposure>),
    /// The pixel from which positions are counted, and the same for these.
    start: [u32; 2],
    camera: Camera,
    exposure: Option<Exposure>,
    /// Whether samples need a point of the lens.
    lens: bool,
    source: Source,
    paths: Paths<'a>,
}

/// The pixels of an area [x0, y0, x1, y1) along a Z-order curve, so that successive pixels are close in the image.
fn z_order([x0, y0, x1, y1]: Area) -> Vec<[u32; 2]> {
    let even = |i: u32| (0..4).fold(0, |n, bit| n | (i >> (2 * bit) & 1) << bit);
    let all = (0..TILE * TILE).map(|i| [x0 + even(i), y0 + even(i >> 1)]);
    all.filter(|&[x, y]| x < x1 && y < y1).collect()
}

/// Successive samples of one set of a pixel.
#[derive(Clone, Copy)]
struct Run {
    pixel: [u32; 2],
    set: u32,
    /// The next sample, and the end, counted within the set.
    next: u32,
    end: u32,
    /// The samples that are kept, counted likewise.
    kept: [u32; 2],
    /// Whether no other set of the pixel has samples that are kept.
    last_set: bool,
}

/// Lanes of a packet that belong to one run.
struct TilePiece {
    packet: usize,
    lanes: Range<usize>,
    /// The run from the first of these lanes on.
    run: Run,
}

impl TilePiece {
    /// The lanes that are kept.
    fn kept(&self) -> Range<usize> {
        let Run { next, kept, .. } = self.run;
        let lane = |sample: u32| (self.lanes.start + sample.saturating_sub(next) as usize).min(self.lanes.end);
        lane(kept[0])..lane(kept[1])
    }
}

impl<'a> TileRenderer<'a> {
    pub(super) fn new(
        scene: &'a PreparedScene,
        settings: &'a Settings,
        camera: Camera,
        exposure: Option<Exposure>,
        redrawn: Redrawn,
    ) -> Self {
        let Settings { sampler, seed, spp, sets, width, .. } = *settings;
        Self {
            scene,
            settings,
            whole: (camera, exposure),
            start: [0; 2],
            camera,
            lens: camera.has_lens() || exposure.is_some(),
            exposure,
            source: Source::new(sampler, seed, spp, sets, camera.has_lens(), width).redrawn(redrawn),
            paths: Paths::new(scene, settings, &camera),
        }
    }

    /// Rays traced since the last call.
    pub(super) fn take_count(&mut self) -> RayCount {
        std::mem::take(&mut self.paths.count)
    }

    /// Renders a range of the samples of the pixels of an area [x0, y0, x1, y1), row by row.
    pub(super) fn range<A: Accumulator>(&mut self, area: Area, range: Range<u32>, sum: A) -> Vec<A::Output> {
        let Settings { spp, .. } = *self.settings;
        let span = if self.source.span() == 0 { spp } else { self.source.span() };
        let whole = span.is_multiple_of(8);
        self.begin(area);
        let weights = if whole { self.weights(area, span) } else { None };
        let of_set = |_, set: u32| [range.start, range.end].map(|at| at.saturating_sub(set * span).min(span));
        self.samples(area, whole, [span; 2], spp / span, weights.as_ref(), sum, of_set)
    }

    /// Renders packets `from` to `to` of each of the `sets` of pixels of a tile, row by row; `range` returns them for a pixel. Samples are
    /// allocated to the lights by `weights` if given, otherwise by the corners of the pixels. The tile must have [begun](Self::begin).
    pub(super) fn parts(
        &mut self,
        area: Area,
        pilot: u32,
        sets: Range<u32>,
        weights: Option<&Weights<'_>>,
        range: impl Fn([u32; 2]) -> [u32; 2],
    ) -> Vec<Statistics> {
        let found = if weights.is_none() { self.weights(area, 8 * pilot) } else { None };
        let weights = weights.or(found.as_ref());
        // where the lights of a tile are known, no sample is allocated
        let allocated = if self.allocates(8 * pilot) { self.scene.lights.few().unwrap_or(0) } else { 0 };
        let sum = StatisticsSum::new(weights.map_or(allocated, |weights| weights.lights));
        let range = |pixel, set| if sets.contains(&set) { range(pixel).map(|packet| 8 * packet) } else { [0; 2] };
        self.samples(area, true, [0, 8 * pilot], sets.end, weights, sum, range)
    }

    /// Prepares for the pixels of a tile: counts positions near it, and looks at an 8 × 8 grid of places in it, to decide where certificates are
    /// worth asking for.
    pub(super) fn begin(&mut self, [x0, y0, x1, y1]: Area) {
        let start = counted_from([x0, y0]);
        if start != self.start {
            let (camera, exposure) = self.whole;
            (self.start, self.camera) = (start, camera.counted_from(start));
            self.exposure = exposure.map(|exposure| exposure.counted_from(start));
        }
        let Some(analytic) = &mut self.paths.analytic else { return };
        analytic.begin([x0, y0]);
        let place = |first: u32, end: u32, k: usize| first as f32 + (end - first) as f32 * (2 * k + 1) as f32 / 16.0;
        let [left, top, right, bottom] = [x0 - start[0], y0 - start[1], x1 - start[0], y1 - start[1]];
        let mut pixels = [[[0; 2]; 8]; GROUP];
        for (row, pixels) in pixels.iter_mut().enumerate() {
            let y = place(top, bottom, row);
            let x: [f32; 8] = std::array::from_fn(|lane| place(left, right, lane));
            *pixels = x.map(|x| [start[0] + (x as u32).min(right - 1), start[1] + (y as u32).min(bottom - 1)]);
            let film = Vec2::new(X8::from(x), X8::splat(y));
            self.paths.start(row, self.camera.rays(&CameraSample { film, lens: Vec2::default() }));
        }
        self.paths.try_out(&pixels);
        self.paths.count.corner += 64;
    }

    /// Starts the ray through the middle of a pixel and of the lens.
    fn look(&mut self, [x, y]: [u32; 2]) -> CameraSample {
        let middle = |k: usize, at: u32| X8::splat((at - self.start[k]) as f32 + 0.5);
        let sample = CameraSample { film: Vec2::new(middle(0, x), middle(1, y)), lens: Vec2::default() };
        self.paths.start(0, self.camera.rays(&sample));
        self.paths.places[0].pixel = Some([x, y]);
        sample
    }

    /// What is known of the lights in the middle of pixels of a tile, seen through the middle of the lens.
    pub(super) fn survey(&mut self, pixels: &[[u32; 2]]) -> Vec<Survey> {
        let mut surveys = Vec::with_capacity(pixels.len());
        for &pixel in pixels {
            self.look(pixel);
            surveys.push(self.paths.survey());
        }
        self.paths.count.corner += pixels.len() as u64;
        surveys
    }

    /// A bound of the error of closed forms in the middle of a pixel of a tile, seen through the middle of the lens.
    pub(super) fn doubt(&mut self, pixel: [u32; 2]) -> [f32; 3] {
        let sample = self.look(pixel);
        let doubt = self.paths.doubt();
        self.exposure.map_or(doubt, |exposure| doubt * exposure.weight(&sample)).lane(0).into()
    }

    /// Renders a range of the samples of each set of the pixels of an area, row by row. Samples are allocated to the lights by `weights`,
    /// if given, in blocks of which the first has `block` samples. If the sets of `span` samples consist of `whole` packets, no packet has
    /// samples of two.
    ///
    /// Samples of a packet can depend on each other in the technique `analytic`, so the packets are always
    /// those of an image of all samples: what is not in the range is left out after it has been rendered.
    #[expect(clippy::too_many_arguments, reason = "each is a part of what is to be sampled")]
    fn samples<A: Accumulator>(
        &mut self,
        area: Area,
        whole: bool,
        [span, block]: [u32; 2],
        sets: u32,
        weights: Option<&Weights<'_>>,
        mut sum: A,
        range: impl Fn([u32; 2], u32) -> [u32; 2],
    ) -> Vec<A::Output> {
        let [x0, y0, x1, _] = area;
        let pixels = z_order(area);
        let mut runs = pixels.iter().flat_map(|&pixel| {
            let range = &range;
            let some = move |&set: &u32| range(pixel, set)[0] < range(pixel, set)[1];
            let last = (0..sets).rfind(some);
            let run = move |set: u32| {
                let kept = range(pixel, set);
                let [next, end] = if whole { [kept[0] / 8 * 8, kept[1].next_multiple_of(8)] } else { [0, span] };
                Run { pixel, set, next, end, kept, last_set: last == Some(set) }
            };
            (0..sets).filter(move |set| !whole || some(set)).map(run)
        });
        let mut run = runs.next();
        let mut outputs = vec![A::Output::default(); pixels.len()];
        let mut blocks = Blocks::new(block);
        let (mut packets, mut pieces, mut places) = (Vec::new(), Vec::new(), Vec::new());
        while run.is_some() {
            packets.clear();
            pieces.clear();
            places.clear();
            let mut expected = [0; GROUP];
            blocks.forget();
            while packets.len() < GROUP
                && let Some(first) = run
            {
                let known = pieces.len();
                let packet = Self::packet(&mut run, &mut runs, span, packets.len(), &mut pieces);
                if pieces[known..].iter().all(|piece: &TilePiece| piece.kept().is_empty()) {
                    pieces.truncate(known);
                    continue;
                }
                if let Some(weights) = weights {
                    expected[packets.len()] = weights.expected(first.pixel);
                    places.push(blocks.find(weights, first.pixel, first.next));
                }
                packets.push(packet);
            }
            if packets.is_empty() {
                break;
            }
            let at = |&(block, sample): &(usize, u32)| blocks.allocations()[block].samples(sample);
            let all = |first: &(usize, u32)| std::array::from_fn(|p| at(places.get(p).unwrap_or(first)));
            let allocated: Option<[Allocated<'_, X8>; GROUP]> = places.first().map(all);
            let allocated = allocated.as_ref().map_or(&[][..], |all| &all[..places.len()]);
            let radiance = self.radiance(&packets, allocated, &expected);
            for piece in pieces.drain(..) {
                let kept = piece.kept();
                let TilePiece { packet, lanes, run } = piece;
                if kept.is_empty() {
                    continue;
                }
                let radiance = radiance[packet];
                let first = run.next + (kept.start - lanes.start) as u32;
                if first == run.kept[0] {
                    sum.begin(run.set, first);
                }
                if whole && kept.len() == 8 {
                    sum.push_packet(radiance.total(), radiance.seen + radiance.known, allocated.get(packet));
                } else {
                    let total = radiance.total();
                    kept.clone().for_each(|lane| sum.push(total.lane(lane).into()));
                }
                if run.last_set && first + kept.len() as u32 == run.kept[1] {
                    let [x, y] = run.pixel;
                    outputs[((y - y0) * (x1 - x0) + (x - x0)) as usize] = sum.finish();
                }
            }
        }
        outputs
    }

    /// The next eight samples of successive runs.
    #[inline]
    fn packet(
        run: &mut Option<Run>,
        runs: &mut impl Iterator<Item = Run>,
        span: u32,
        packet: usize,
        pieces: &mut Vec<TilePiece>,
    ) -> Packet {
        let lanes = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let first = run.unwrap_or_else(|| unreachable!("there is a run"));
        if first.end - first.next >= 8 {
            let next = first.next + 8;
            pieces.push(TilePiece { packet, lanes: 0..8, run: first });
            *run = if next == first.end { runs.next() } else { Some(Run { next, ..first }) };
            let [x, y] = first.pixel.map(u32x8::splat);
            let sample = u32x8::splat(first.set * span + first.next) + lanes;
            return Packet { x, y, sample, replicate: u32x8::splat(first.set), active: M8::splat(true) };
        }
        let (mut x, mut y, mut sample, mut replicate) = ([0; 8], [0; 8], [0; 8], [0; 8]);
        let mut filled = 0;
        while filled < 8
            && let Some(current) = *run
        {
            let taken = (current.end - current.next).min(8 - filled);
            let range = filled as usize..(filled + taken) as usize;
            for lane in range.clone() {
                [x[lane], y[lane]] = current.pixel;
                sample[lane] = current.set * span + current.next + lane as u32 - filled;
                replicate[lane] = current.set;
            }
            filled += taken;
            let next = current.next + taken;
            pieces.push(TilePiece { packet, lanes: range, run: current });
            *run = if next == current.end { runs.next() } else { Some(Run { next, ..current }) };
        }
        // the last packet of a tile repeats its last sample
        for lane in filled as usize..8 {
            let last = filled as usize - 1;
            (x[lane], y[lane], sample[lane], replicate[lane]) = (x[last], y[last], sample[last], replicate[last]);
        }
        Packet {
            x: u32x8::new(x),
            y: u32x8::new(y),
            sample: u32x8::new(sample),
            replicate: u32x8::new(replicate),
            active: M8::from_bits((1 << filled) - 1),
        }
    }

    /// Measured values of the samples of a group of packets. `allocated` is empty, or allocates each sample to a light.
    fn radiance(
        &mut self,
        packets: &[Packet],
        allocated: &[Allocated<'_, X8>],
        expected: &[u32; GROUP],
    ) -> &[Radiance] {
        let Self { source, paths, start, camera, settings, .. } = self;
        let start = start.map(u32x8::splat);
        let lights = paths.sampled();
        // delta lights alone need no point on the light
        let point = settings.technique.finds_lights() || !lights.only_deltas();
        let own = |dimension: u32| {
            let mut pairs = [Vec2::default(); GROUP];
            pairs.iter_mut().zip(packets).for_each(|(pair, packet)| *pair = source.pair(packet, dimension));
            pairs
        };
        let is_combined = settings.technique.heuristic().is_some() || paths.is_mixed();
        let mut numbers = Numbers {
            light: [Vec2::default(); GROUP],
            choice: lights.many().then(|| own(CHOICE)),
            surface: (point && is_combined).then(|| own(SURFACE)),
        };
        let mut samples = [CameraSample { film: Vec2::default(), lens: Vec2::default() }; GROUP];
        let mut active = [M8::splat(false); GROUP];
        for (p, packet) in packets.iter().enumerate() {
            let film = if point {
                let [film, light] = match allocated.get(p) {
                    Some(allocated) => source.film_and_light_of(packet, allocated.light, allocated.sample),
                    None => source.film_and_light(packet),
                };
                numbers.light[p] = light;
                film
            } else {
                source.pair(packet, FILM)
            };
            let [x, y] = [packet.x, packet.y].map(|of| of.to_array());
            let alike = (1..8).all(|lane| x[lane] == x[0] && y[lane] == y[0]);
            paths.places[p].pixel = alike.then_some([x[0], y[0]]);
            let lens = self.lens.then(|| source.pair(packet, LENS));
            samples[p] = CameraSample::new(packet.x - start[0], packet.y - start[1], film, lens);
            paths.start(p, camera.rays(&samples[p]));
            active[p] = packet.active;
        }
        let radiance = paths.radiance(&active[..packets.len()], &numbers, allocated, expected);
        for (radiance, sample) in radiance.iter_mut().zip(&samples) {
            if let Some(open) = camera.open(sample) {
                *radiance = radiance.keep(open);
            }
            if let Some(exposure) = &self.exposure {
                *radiance = radiance.times(exposure.weight(sample));
            }
        }
        radiance
    }

    /// Whether samples can be allocated to lights in blocks of `size` samples.
    fn allocates(&self, size: u32) -> bool {
        let Some(lights) = self.scene.lights.few() else { return false };
        // each light takes at least one sample, worth it or not: for many lights, these are limited to half of the samples
        let is_asked = self.paths.analytic.as_ref().is_some_and(|analytic| !analytic.is_hopeless());
        let free = if is_asked { FREE_IF_ASKED } else { FREE };
        let fits = size.is_power_of_two() && size.is_multiple_of(8) && (lights <= free || size as usize >= 2 * lights);
        fits && !self.settings.technique.finds_lights() && self.source.allocates()
    }

    /// Weights of the lights by their possible contributions at the corners of the pixels of an area, seen through the middle of the
    /// lens; `None` if lights are chosen at random, or if there are too many for blocks of `size` samples.
    fn weights(&mut self, area: Area, size: u32) -> Option<Weights<'static>> {
        let lights = self.scene.lights.few()?;
        if !self.allocates(size) || self.paths.analytic.as_ref().is_some_and(|analytic| analytic.knows_all()) {
            return None;
        }
        let is_asked = self.paths.analytic.as_ref().is_some_and(|analytic| !analytic.is_hopeless());
        let [x0, y0, x1, y1] = area;
        let (across, down) = ((x1 - x0 + 1) as usize, (y1 - y0 + 1) as usize);
        let mut corners = vec![0.0; across * down * lights];
        let mut open: [Vec<M8>; GROUP] = std::array::from_fn(|_| vec![M8::splat(true); lights]);
        for start in (0..across * down).step_by(8 * GROUP) {
            let count = (across * down - start).div_ceil(8).min(GROUP);
            let place = |p: usize, lane: usize| (start + 8 * p + lane).min(across * down - 1);
            for p in 0..count {
                let at = |of: &dyn Fn(usize) -> u32| X8::from(std::array::from_fn(|lane| of(place(p, lane)) as f32));
                let (left, top) = (x0 - self.start[0], y0 - self.start[1]);
                let (x, y) = (at(&|i| left + (i % across) as u32), at(&|i| top + (i / across) as u32));
                let sample = CameraSample { film: Vec2::new(x, y), lens: Vec2::default() };
                self.paths.start(p, self.camera.rays(&sample));
            }
            self.paths.surfaces(&[M8::splat(true); GROUP][..count]);
            if is_asked {
                let pixel = |i: usize| [(x0 + (i % across) as u32).min(x1 - 1), (y0 + (i / across) as u32).min(y1 - 1)];
                let pixels = std::array::from_fn(|p| std::array::from_fn(|lane| pixel(place(p, lane))));
                self.paths.open(&pixels, count, &mut open);
            }
            for (p, surface) in self.paths.ends(count).iter().enumerate() {
                let Some(parts) = self.scene.lights.contributions(surface.point, surface.normal) else { continue };
                for (k, part) in parts.weights().enumerate() {
                    let part = part.keep(surface.reflects & open[p][k]).to_array();
                    for (lane, part) in part.into_iter().enumerate() {
                        corners[place(p, lane) * lights + k] = part;
                    }
                }
            }
            self.paths.count.corner += (across * down - start).min(8 * GROUP) as u64;
        }
        let mut of = Vec::with_capacity((TILE * TILE) as usize * lights);
        for (y, x) in (0..down - 1).flat_map(|y| (0..across - 1).map(move |x| (y, x))) {
            let corner = |dx: usize, dy: usize| ((y + dy) * across + x + dx) * lights;
            let four = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
            of.extend((0..lights).map(|k| libm::powf(four.iter().map(|c| corners[c + k]).sum::<f32>(), POWER)));
        }
        Some(Weights { lights, of: of.into(), area, begun: &[] })
    }
}
