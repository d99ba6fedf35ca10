//! Renders the samples of a square of pixels.

use super::light_weights::{LightBlocks, LightWeights};
use super::pixel_statistics::{Statistics, StatisticsSum};
use super::radiance::Radiance;
use super::runs::{Run, TilePiece, next_packet, z_order};
use super::world::World;
use crate::bvh::{GROUP, RayCount};
use crate::camera::{Camera, CameraSample, Group, Numbers, Paths, PreparedScene, counted_from};
use crate::choose::Chooser;
use crate::choose::allocation::Allocated;
use crate::estimate::Sampled;
use crate::film::Accumulator;
use crate::film::sensor::Exposure;
use crate::know::{Know, Ledger, Outlook};
use crate::lights::Lights;
use crate::packet::{M8, V8, X8, product};
use crate::sampler::{CHOICE, FILM, LENS, NumberSource, Packet, SURFACE};
use crate::scene::area::Area;
use crate::settings::Settings;
use etendue::{Mask, Vec2, u32x8};
use std::ops::Range;

/// Renders tiles, and keeps the scratch memory for it.
pub(super) struct TileRenderer<'a> {
    scene: &'a PreparedScene,
    /// The lights that are sampled, and how they are chosen.
    lights: &'a Lights,
    pub(super) chooser: &'a Chooser,
    pub(super) settings: &'a Settings,
    /// The camera, and the weights of radiance if there are any, for positions counted from the first pixel of the image.
    whole: (Camera, Option<Exposure>),
    /// The pixel from which positions are counted, and the same for these.
    pub(super) start: [u32; 2],
    pub(super) camera: Camera,
    exposure: Option<Exposure>,
    /// Whether samples need a point of the lens.
    lens: bool,
    pub(super) source: NumberSource,
    pub(super) paths: Paths<'a>,
    /// What is known without samples, and what was written of it for the last group.
    pub(super) know: Option<Box<dyn Know + 'a>>,
    ledger: Ledger,
    /// What is foreseen of that in the tile.
    pub(super) outlook: Outlook,
    sampled: Sampled,
    /// Whether samples only see what the camera sees directly.
    only_looks: bool,
}

impl<'a> TileRenderer<'a> {
    pub(super) fn new(
        world: &'a World,
        settings: &'a Settings,
        camera: Camera,
        exposure: Option<Exposure>,
        know: Option<Box<dyn Know + 'a>>,
        is_counted: bool,
    ) -> Self {
        let Settings { sampler, seed, spp, sets, width, .. } = *settings;
        let scene = &world.scene;
        let sampled = scene.sampled(settings.technique, settings.choice);
        let (lights, chooser) = sampled.unwrap_or_else(|what| panic!("the choice of a light needs {what}"));
        let sampled = Sampled::new(settings.technique, know.is_some() && scene.surfaces.has_rough());
        Self {
            scene,
            lights,
            chooser,
            settings,
            whole: (camera, exposure),
            start: [0; 2],
            camera,
            lens: camera.has_lens() || exposure.is_some(),
            exposure,
            source: NumberSource::new(sampler, seed, [spp, sets], width, is_counted),
            paths: Paths::new(scene, settings.depth),
            ledger: Ledger::all_open(know.is_some()),
            know,
            outlook: Outlook::default(),
            sampled,
            only_looks: false,
        }
    }

    /// Rays traced since the last call.
    pub(super) fn take_count(&mut self) -> RayCount {
        let [proofs, met, forms] = self.know.as_mut().map_or([0; 3], |know| know.take_counts());
        RayCount { proofs, met, forms, ..std::mem::take(&mut self.paths.tracer.count) }
    }

    /// Renders all samples of the pixels of a tile [x0, y0, x1, y1), row by row.
    pub(super) fn all<A: Accumulator>(&mut self, area: Area, sum: A) -> Vec<A::Output> {
        let Settings { spp, .. } = *self.settings;
        let set_size = if self.source.set_size() == 0 { spp } else { self.source.set_size() };
        let whole = set_size.is_multiple_of(8);
        self.begin(area);
        let weights = if whole { self.weights(area, set_size) } else { None };
        self.samples(area, [set_size; 2], spp / set_size, weights.as_ref(), sum, |_, _| [0, set_size])
    }

    /// Renders packets `from` to `to` of each of the `sets` of pixels of a tile, row by row; `range` returns them for a pixel. Samples are
    /// allocated to the lights by `weights` if given, otherwise by the corners of the pixels. The tile must have [begun](Self::begin).
    pub(super) fn parts(
        &mut self,
        area: Area,
        pilot: u32,
        sets: Range<u32>,
        weights: Option<&LightWeights<'_>>,
        range: impl Fn([u32; 2]) -> [u32; 2],
    ) -> Vec<Statistics> {
        let found = if weights.is_none() { self.weights(area, 8 * pilot) } else { None };
        let weights = weights.or(found.as_ref());
        // where the lights of a tile are known, no sample is allocated
        let allocated = if self.allocates(8 * pilot) { self.chooser.few().unwrap_or(0) } else { 0 };
        let sum = StatisticsSum::new(weights.map_or(allocated, |weights| weights.lights));
        let range = |pixel, set| if sets.contains(&set) { range(pixel).map(|packet| 8 * packet) } else { [0; 2] };
        self.samples(area, [0, 8 * pilot], sets.end, weights, sum, range)
    }

    /// The same for what the camera sees directly alone, without samples of lights.
    pub(super) fn looks(
        &mut self,
        area: Area,
        sets: Range<u32>,
        range: impl Fn([u32; 2]) -> [u32; 2],
    ) -> Vec<Statistics> {
        self.only_looks = true;
        let range = |pixel, set| if sets.contains(&set) { range(pixel).map(|packet| 8 * packet) } else { [0; 2] };
        let found = self.samples(area, [0; 2], sets.end, None, StatisticsSum::new(0), range);
        self.only_looks = false;
        found
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
        let Some(know) = &mut self.know else { return };
        know.begin([x0, y0]);
        let place = |first: u32, end: u32, k: usize| first as f32 + (end - first) as f32 * (2 * k + 1) as f32 / 16.0;
        let [left, top, right, bottom] = [x0 - start[0], y0 - start[1], x1 - start[0], y1 - start[1]];
        let x: [f32; 8] = std::array::from_fn(|lane| place(left, right, lane));
        let y: [f32; GROUP] = std::array::from_fn(|row| place(top, bottom, row));
        let pixel = |x: f32, y: f32| [start[0] + (x as u32).min(right - 1), start[1] + (y as u32).min(bottom - 1)];
        self.rehearse(&[M8::splat(true); GROUP], None, |row| [X8::from(x), X8::splat(y[row])]);
        if let Some(know) = &mut self.know {
            self.outlook = know.look_ahead(&self.paths.points, &y.map(|y| x.map(|x| pixel(x, y))));
        }
        self.paths.tracer.count.corner += 64;
    }

    /// Follows rays through places of the film and the middle of the lens, packet by packet, before any sample: for what is worth asking, for
    /// what lights can contribute, and for how far closed forms may be off.
    pub(super) fn rehearse(&mut self, active: &[M8], pixel: Option<[u32; 2]>, film: impl Fn(usize) -> [X8; 2]) {
        for p in 0..active.len() {
            let [x, y] = film(p);
            let sample = CameraSample { film: Vec2::new(x, y), lens: Vec2::default() };
            self.paths.start(p, self.camera.rays(&sample), pixel);
        }
        self.paths.follow(active);
        if self.know.is_some() {
            self.paths.note_lobes(active.len());
        }
    }

    /// A bound of the error of closed forms in the middle of a pixel of a tile, seen through the middle of the lens.
    pub(super) fn error_bound(&mut self, pixel: [u32; 2]) -> [f32; 3] {
        let [x, y] = [0, 1].map(|k| X8::splat((pixel[k] - self.start[k]) as f32 + 0.5));
        self.rehearse(&[M8::from_bits(1)], Some(pixel), |_| [x, y]);
        let points = &self.paths.points;
        let known = self.know.as_mut().map_or(V8::default(), |know| know.error_bound(points));
        let error_bound = product(points.ends[0].throughput, known);
        let sample = CameraSample { film: Vec2::new(x, y), lens: Vec2::default() };
        self.exposure.map_or(error_bound, |exposure| error_bound * exposure.weight(&sample)).lane(0).into()
    }

    /// Renders a range of the samples of each set of the pixels of an area, row by row. Samples are allocated to the lights by `weights`,
    /// if given, in blocks of which the first has `block` samples. If the sets of `set_size` samples consist of whole packets, no packet has
    /// samples of two.
    fn samples<A: Accumulator>(
        &mut self,
        area: Area,
        [set_size, block]: [u32; 2],
        sets: u32,
        weights: Option<&LightWeights<'_>>,
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
                let [next, end] = range(pixel, set);
                Run { pixel, set, next, end, is_new: true, last_set: last == Some(set) }
            };
            (0..sets).filter(some).map(run)
        });
        let mut run = runs.next();
        let mut outputs = vec![A::Output::default(); pixels.len()];
        let mut blocks = LightBlocks::new(block);
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
                let packet = next_packet(&mut run, &mut runs, set_size, packets.len(), &mut pieces);
                if let Some(weights) = weights {
                    expected[packets.len()] = weights.expected(first.pixel);
                    places.push(blocks.find(weights, first.pixel, first.next));
                }
                packets.push(packet);
            }
            let at = |&(block, sample): &(usize, u32)| blocks.allocations()[block].samples(sample);
            let all = |first: &(usize, u32)| std::array::from_fn(|p| at(places.get(p).unwrap_or(first)));
            let allocated: Option<[Allocated<'_>; GROUP]> = places.first().map(all);
            let allocated = allocated.as_ref().map_or(&[][..], |all| &all[..places.len()]);
            let radiance = self.radiance(&packets, allocated, &expected);
            for TilePiece { packet, lanes, run } in pieces.drain(..) {
                let (radiance, count) = (radiance[packet], lanes.len() as u32);
                if run.is_new {
                    sum.begin(run.next);
                }
                if count == 8 && run.next.is_multiple_of(8) {
                    sum.push_packet(radiance.total(), [radiance.seen, radiance.known], allocated.get(packet));
                } else {
                    let total = radiance.total();
                    lanes.for_each(|lane| sum.push(total.lane(lane).into()));
                }
                if run.last_set && run.next + count == run.end {
                    let [x, y] = run.pixel;
                    outputs[((y - y0) * (x1 - x0) + (x - x0)) as usize] = sum.finish();
                }
            }
        }
        outputs
    }

    /// Measured values of the samples of a group of packets. `allocated` is empty, or allocates each sample to a light.
    fn radiance(
        &mut self,
        packets: &[Packet],
        allocated: &[Allocated<'_>],
        expected: &[u32; GROUP],
    ) -> [Radiance; GROUP] {
        let (samples, numbers) = self.numbers(packets, allocated);
        let Self {
            scene,
            lights,
            chooser,
            camera,
            exposure,
            paths,
            know,
            ledger,
            outlook,
            sampled: rest,
            only_looks,
            ..
        } = self;
        let count = packets.len();
        // follow the camera rays
        let mut active = [M8::splat(false); GROUP];
        for (p, packet) in packets.iter().enumerate() {
            paths.start(p, camera.rays(&samples[p]), packet.pixel());
            active[p] = packet.active;
            let count = &mut paths.tracer.count;
            let rays = if *only_looks { &mut count.look } else { &mut count.camera };
            *rays += u64::from(packet.active.bits().count_ones());
        }
        if *only_looks {
            paths.look(&active[..count]);
        } else {
            paths.follow(&active[..count]);
        }
        // what is known of the lights there, and an estimate of the rest
        let [mut known, mut sampled] = [[V8::default(); GROUP]; 2];
        if !scene.lights.is_empty() && !*only_looks {
            paths.note_lobes(count);
            let group =
                Group { scene, lights, chooser, points: &paths.points, count, numbers: &numbers, allocated, expected };
            ledger.forget();
            if let Some(know) = know.as_mut().filter(|_| outlook.some) {
                know.know(&group, ledger, &mut known);
            }
            rest.add(&group, ledger, &mut paths.tracer, &mut sampled);
        }
        let is_plain = scene.surfaces.is_plain;
        std::array::from_fn(|p| {
            let through =
                |part: V8| if is_plain || *only_looks { part } else { product(paths.points.ends[p].throughput, part) };
            let radiance = Radiance { seen: paths.seen[p], known: through(known[p]), reflected: through(sampled[p]) };
            exposure.map_or(radiance, |exposure| radiance.times(exposure.weight(&samples[p])))
        })
    }

    /// The random numbers of a group of packets: for the camera, and for lights and surfaces.
    #[inline(always)]
    fn numbers(&self, packets: &[Packet], allocated: &[Allocated<'_>]) -> ([CameraSample; GROUP], Numbers) {
        let Self { lights, chooser, source, start, settings, .. } = self;
        // delta lights alone need no point on the light, but coated metals need its numbers
        let point = settings.technique.finds_lights() || !lights.only_deltas();
        let any = (point || self.scene.surfaces.has_estimates()) && !self.only_looks;
        let own = |dimension: u32| {
            let mut pairs = [Vec2::default(); GROUP];
            pairs.iter_mut().zip(packets).for_each(|(pair, packet)| *pair = source.pair(packet, dimension));
            pairs
        };
        let mut numbers = Numbers {
            light: [Vec2::default(); GROUP],
            choice: (chooser.needs_numbers() && !self.only_looks).then(|| own(CHOICE)),
            surface: (point && any && self.sampled.is_combined()).then(|| own(SURFACE)),
        };
        let mut samples = [CameraSample { film: Vec2::default(), lens: Vec2::default() }; GROUP];
        let start = start.map(u32x8::splat);
        for (p, packet) in packets.iter().enumerate() {
            let film = if any {
                let [film, light] = match allocated.get(p) {
                    Some(allocated) => source.film_and_light_of(packet, allocated.light, allocated.sample),
                    None => source.film_and_light(packet),
                };
                numbers.light[p] = light;
                film
            } else {
                source.pair(packet, FILM)
            };
            let lens = self.lens.then(|| source.pair(packet, LENS));
            samples[p] = CameraSample::new(packet.x - start[0], packet.y - start[1], film, lens);
        }
        (samples, numbers)
    }
}
