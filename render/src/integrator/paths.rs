//! Follows camera rays to a surface, and gathers the light that it reflects.
//!
//! A camera ray is followed, without random numbers, through perfect mirrors to the first other surface. Then light and surface are
//! sampled for all lanes at once. A path thus has one reflection besides those at mirrors; mirrors occlude shadow rays. (Rays
//! between mirrors keep their lanes: compacted into fewer packets they took as long in the mirror room, 1.00 ± 0.03, and 1.04 times
//! as long among three thousand balls.)

use super::analytic::{Analytic, Places};
use super::choice::Which;
use super::end::{End, bsdf, keep, product};
use super::known::{Fitted, Survey};
use super::prepared::PreparedScene;
use super::radiance::Radiance;
use super::settings::{RayCount, Settings};
use crate::bsdf::Evaluated;
use crate::bvh::{GROUP, Hits, NOTHING, Rays, Scratch};
use crate::camera::Camera;
use crate::lights::Lights;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8, pick, select};
use crate::sky::SunBeside;
use crate::surfaces::Surface;
use crate::technique::Technique;
use etendue::estimate::{Heuristic, technique_pdf};
use etendue::occlusion::SPARED;
use etendue::select::{Allocated, FEW};
use etendue::{Mask, Real, Vec2, u32x8};

/// Fraction of the distance to a light that a shadow ray covers: it stops short, so that surfaces touching the light do not occlude it.
pub(super) const COVERED: f64 = 1.0 - SPARED;

/// Random numbers of each packet of a group.
pub(super) struct Numbers {
    /// For the point on the light, or the direction.
    pub(super) light: [Vec2<X8>; GROUP],
    /// For the choice of a light, if there are so many that it needs numbers of its own.
    pub(super) choice: Option<[Vec2<X8>; GROUP]>,
    /// For a direction from the BSDF in addition to a light, if the technique combines them.
    pub(super) surface: Option<[Vec2<X8>; GROUP]>,
}

/// The paths of a group of packets, and their scratch memory.
pub(super) struct Paths<'a> {
    pub(super) scene: &'a PreparedScene,
    pub(super) technique: Technique,
    depth: u32,
    /// Rays traced so far.
    pub(super) count: RayCount,
    pub(super) scratch: Scratch,
    /// Camera rays and shadow rays.
    pub(super) rays: Box<[[Rays; GROUP]; 2]>,
    /// The reflecting surfaces at the ends of the paths.
    pub(super) surfaces: Box<[Surface; GROUP]>,
    pub(super) ends: Box<[End; GROUP]>,
    /// Where the paths end. The pixels are set from outside.
    pub(super) places: Box<[Places; GROUP]>,
    pub(super) analytic: Option<Analytic<'a>>,
    /// Lanes in which a light must be sampled, for each light and packet.
    unknown: Vec<[M8; GROUP]>,
    /// The part of each light that has been counted where it must be sampled, if lights have such parts.
    counted: Option<Vec<[X8; GROUP]>>,
    /// The fits of rough surfaces, where certificates are asked for, and what is known of each light there.
    pub(super) lobes: Box<[Option<Lobe>; GROUP]>,
    pub(super) fitted: Vec<[Fitted; GROUP]>,
    radiance: Box<[Radiance; GROUP]>,
}

impl<'a> Paths<'a> {
    pub(super) fn new(scene: &'a PreparedScene, settings: &Settings, camera: &Camera) -> Self {
        Self {
            scene,
            technique: settings.technique,
            depth: settings.depth,
            count: RayCount::default(),
            scratch: Scratch::default(),
            rays: Box::default(),
            surfaces: Box::new([Surface::default(); GROUP]),
            ends: Box::new([End::start(); GROUP]),
            places: Box::default(),
            analytic: settings
                .technique
                .is_analytic(scene.lights.only_few_areas())
                .then(|| Analytic::new(scene, camera, settings)),
            radiance: Box::default(),
            unknown: vec![[M8::splat(false); GROUP]; FEW],
            counted: scene.lights.has_irradiances().then(|| vec![[X8::lit(0.0); GROUP]; FEW]),
            lobes: Box::default(),
            fitted: vec![[Fitted::default(); GROUP]; FEW],
        }
    }

    /// The lights that are sampled: techniques that find lights by chance never hit a delta light, so they sample those.
    pub(super) fn sampled(&self) -> &'a Lights {
        if self.technique.finds_lights() { &self.scene.deltas } else { &self.scene.lights }
    }

    /// Sets the camera rays of a packet.
    #[inline(always)]
    pub(super) fn start(&mut self, packet: usize, (origin, direction): (V8, V8)) {
        self.rays[0][packet] = self.scene.surfaces.bvh.rays(origin, direction);
    }

    /// Follows the rays that have been started.
    pub(super) fn surfaces(&mut self, active: &[M8]) {
        if self.scene.surfaces.is_plain {
            self.follow::<false>(active);
        } else {
            self.follow::<true>(active);
        }
    }

    /// The surfaces at the ends of the rays that have been followed, which reflect but whose emission does not count.
    pub(super) fn ends(&self, count: usize) -> &[Surface] {
        &self.surfaces[..count]
    }

    /// Looks at the ends of the rays that have been started, each of them in one of these pixels, to decide where certificates are worth
    /// asking for.
    pub(super) fn try_out(&mut self, pixels: &[[[u32; 2]; 8]; GROUP]) {
        self.surfaces(&[M8::splat(true); GROUP]);
        self.note_glossy(GROUP);
        if let Some(analytic) = &mut self.analytic {
            analytic.try_out(&self.surfaces[..], &self.places, pixels);
        }
    }

    /// Sets the lanes in which each light must be sampled at the ends of the rays of some packets, which have been followed, in these
    /// pixels.
    pub(super) fn open(&mut self, pixels: &[[[u32; 2]; 8]; GROUP], count: usize, open: &mut [Vec<M8>; GROUP]) {
        self.note_glossy(count);
        let Self { analytic, surfaces, places, .. } = self;
        let Some(analytic) = analytic else { return };
        for p in 0..count {
            analytic.open(&surfaces[p], &places[p], &pixels[p], &mut open[p]);
        }
    }

    /// What is known of the lights at the end of the first ray that has been started.
    pub(super) fn survey(&mut self) -> Survey {
        self.surfaces(&[M8::from_bits(1)]);
        self.note_glossy(1);
        let Self { analytic, surfaces, places, .. } = self;
        analytic.as_mut().map_or(Survey::default(), |analytic| analytic.survey(&surfaces[0], &places[0], 0))
    }

    /// A bound of the error that closed forms have at the end of the first ray that has been started, as the camera sees it.
    pub(super) fn doubt(&mut self) -> V8 {
        self.surfaces(&[M8::from_bits(1)]);
        self.note_glossy(1);
        let Self { scene, analytic, surfaces, places, ends, lobes, .. } = self;
        let doubt = analytic.as_mut().map_or(V8::default(), |analytic| match &lobes[0] {
            Some(lobe) if (surfaces[0].reflects & places[0].fitted).lane(0) => {
                analytic.doubt_fitted(&surfaces[0], &places[0], lobe)
            }
            _ => analytic.doubt(&surfaces[0], &places[0]),
        });
        if scene.surfaces.is_plain { doubt } else { product(ends[0].throughput, doubt) }
    }

    fn note_glossy(&mut self, count: usize) {
        if !self.scene.surfaces.is_plain {
            for p in 0..count {
                let (end, surface) = (&self.ends[p], &self.surfaces[p]);
                let lobe = end.metal.and_then(|metal| metal.lobe(surface.normal, surface.albedo, -end.direction));
                let fitted = lobe.as_ref().map_or(M8::splat(false), |lobe| lobe.lanes & !end.smooth);
                self.places[p].fitted = fitted;
                self.places[p].glossy = end.smooth | end.rough() & !fitted;
                self.lobes[p] = lobe;
            }
        }
    }

    /// Whether light and BSDF are combined on rough surfaces only.
    pub(super) fn is_mixed(&self) -> bool {
        self.analytic.is_some() && self.scene.surfaces.has_rough()
    }

    /// How samples of a light and of the BSDF are combined, if they are anywhere.
    pub(super) fn heuristic(&self) -> Option<Heuristic> {
        if self.is_mixed() { Some(Heuristic::POWER) } else { self.technique.heuristic() }
    }

    /// Whether spheres that rough metals reflect are sampled by the lobe alone.
    pub(super) fn samples_lobes(&self) -> bool {
        self.technique.samples_lobes() && self.heuristic().is_some()
    }

    /// Radiance along the rays that have been started. `allocated` is empty, or allocates each sample to a light; a bit of `expected` is set for
    /// each light that is worth samples in a packet, then.
    pub(super) fn radiance(
        &mut self,
        active: &[M8],
        numbers: &Numbers,
        allocated: &[Allocated<'_, X8>],
        expected: &[u32; GROUP],
    ) -> &mut [Radiance] {
        for active in active {
            self.count.camera += u64::from(active.bits().count_ones());
        }
        // what a scene does not need is not compiled in
        if self.scene.surfaces.is_plain {
            self.gather::<false>(active, numbers, allocated, expected);
        } else {
            self.gather::<true>(active, numbers, allocated, expected);
        }
        &mut self.radiance[..active.len()]
    }

    fn gather<const METAL: bool>(
        &mut self,
        active: &[M8],
        numbers: &Numbers,
        allocated: &[Allocated<'_, X8>],
        expected: &[u32; GROUP],
    ) {
        self.follow::<METAL>(active);
        let count = active.len();
        let (mut known, mut reflected) = ([V8::default(); GROUP], [V8::default(); GROUP]);
        if self.scene.lights.is_empty() {
            self.radiance.iter_mut().for_each(|radiance| radiance.reflected = V8::default());
            return;
        }
        let lights = self.sampled();
        let all = lights.len();
        if self.analytic.is_some() || METAL {
            self.note_glossy(count);
        }
        if let Some(analytic) = self.analytic.as_mut().filter(|analytic| !analytic.is_hopeless()) {
            let mut unknown = std::mem::take(&mut self.unknown);
            let counted = self.counted.as_deref_mut().unwrap_or_default();
            let (surfaces, lobes, fitted) = (&self.surfaces[..count], &self.lobes, &mut self.fitted[..]);
            if METAL {
                fitted[..all].fill([Fitted::default(); GROUP]);
            }
            if analytic.gather(surfaces, &self.places, lobes, &mut known, &mut unknown, counted, fitted) {
                let which = if allocated.is_empty() {
                    Which::Among(&unknown)
                } else {
                    Which::Expected(allocated, expected, &unknown)
                };
                self.by_light::<METAL>(lights, &which, count, numbers, &mut reflected);
            }
            self.unknown = unknown;
        } else if let Some(each) = lights.each() {
            for light in 0..each {
                self.by_light::<METAL>(lights, &Which::Given(light), count, numbers, &mut reflected);
            }
        } else {
            self.by_light::<METAL>(lights, &Which::Chosen(allocated), count, numbers, &mut reflected);
            if let Some(sun) = self.sun_beside() {
                self.by_sun::<METAL>(sun, count, numbers, &mut reflected);
            }
        }
        let is_closed = self.analytic.as_ref().is_some_and(|analytic| !analytic.is_hopeless());
        if self.technique.finds_lights() {
            self.by_surface::<METAL>(count, &numbers.light, allocated, is_closed, &mut reflected);
        } else if let Some(surface) = &numbers.surface {
            self.by_surface::<METAL>(count, surface, allocated, is_closed, &mut reflected);
        }
        for p in 0..count {
            let through = |part: V8| if METAL { product(self.ends[p].throughput, part) } else { part };
            (self.radiance[p].known, self.radiance[p].reflected) = (through(known[p]), through(reflected[p]));
        }
    }

    /// Follows the rays of a group through mirrors, and adds the radiance of the lights and the sky that they hit.
    #[inline(always)]
    fn follow<const METAL: bool>(&mut self, active: &[M8]) {
        let Self { scene, scratch, rays, surfaces, ends, radiance, places, .. } = self;
        let (world, count) = (&scene.surfaces, active.len());
        let mut going = [M8::splat(false); GROUP];
        going[..count].copy_from_slice(active);
        if METAL {
            radiance[..count].fill(Radiance::default());
            surfaces[..count].fill(Surface::default());
            ends[..count].fill(End { throughput: V8::from([1.0; 3]), ..End::start() });
        }
        for depth in 0.. {
            let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
            world.bvh.closest(&rays[0][..count], &going[..count], &mut hits[..count], scratch);
            let mut on = false;
            for p in 0..count {
                if METAL && !going[p].any() {
                    continue;
                }
                let (ray, here) = (&rays[0][p], going[p]);
                let see = |surface: &Surface| {
                    let missed = here & !hits[p].any();
                    match &scene.sky {
                        Some(sky) if missed.any() => {
                            V8::blend(missed, sky.radiance(ray.origin, ray.direction), surface.emission)
                        }
                        _ => surface.emission,
                    }
                };
                if !METAL {
                    surfaces[p] = world.hit(&hits[p], ray);
                    places[p].primitives = hits[p].place;
                    radiance[p].seen = see(&surfaces[p]);
                    continue;
                }
                let mut surface = world.hit(&hits[p], ray);
                let seen = see(&surface);
                let incoming = ray.direction;
                let end = &mut ends[p];
                radiance[p].seen += keep(product(end.throughput, seen), here);
                let reflects = surface.reflects & here;
                let flat = surface.normal;
                let (metal, smooth) = world.materials(&hits[p], reflects, incoming, &mut surface);
                let mirrors = metal.mirrors() & reflects;
                let ends_here = reflects & !mirrors;
                end.smooth = end.smooth | (smooth & ends_here);
                end.flat = V8::blend(ends_here, flat, end.flat);
                end.settle(&mut surfaces[p], &surface, ends_here, incoming, metal);
                places[p].primitives = pick(ends_here, hits[p].place, places[p].primitives);
                places[p].direct = if depth == 0 { ends_here } else { places[p].direct & !ends_here };
                going[p] = M8::splat(false);
                if mirrors.any() && depth < self.depth {
                    let (origin, direction) = end.reflect(&surface, &metal, mirrors, incoming);
                    // the mirror image of a smooth normal may be below the flat surface
                    let mirrors = mirrors & (direction.dot(flat).gt(X8::lit(0.0)) | !smooth);
                    going[p] = mirrors;
                    on |= mirrors.any();
                    rays[0][p] = world.bvh.rays(origin, direction).leaving(hits[p].place);
                    self.count.mirror += u64::from(mirrors.bits().count_ones());
                }
            }
            if !on {
                return;
            }
        }
    }

    /// The sun, if it is sampled besides the other lights.
    fn sun_beside(&self) -> Option<SunBeside<'a>> {
        let sky = self.scene.sky.as_ref().filter(|_| !self.technique.finds_lights())?;
        sky.sun_beside()
    }

    /// Not inlined, so that it does not burden scenes without portals.
    #[inline(never)]
    fn by_sun<const METAL: bool>(
        &mut self,
        sun: SunBeside<'_>,
        count: usize,
        numbers: &Numbers,
        reflected: &mut [V8; GROUP],
    ) {
        self.by_light::<METAL>(&self.scene.lights, &Which::Sun(sun), count, numbers, reflected);
    }

    /// Adds the light reflected by sampling a light, with its MIS weight if the technique combines two.
    #[inline(always)]
    fn by_light<const METAL: bool>(
        &mut self,
        lights: &Lights,
        which: &Which<'_>,
        count: usize,
        numbers: &Numbers,
        reflected: &mut [V8; GROUP],
    ) {
        let measure = self.technique.measure();
        let (heuristic, is_mixed) = (self.heuristic(), self.is_mixed());
        let samples_lobes = self.samples_lobes();
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let mut lit = [M8::splat(false); GROUP];
        let mut limit = [zero; GROUP];
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut found = [V8::default(); GROUP];
        let is_closed = matches!(which, Which::Among(_) | Which::Expected(..));
        let Self { scene, surfaces, ends, rays, places, counted, lobes, fitted, .. } = self;
        for (p, surface) in surfaces[..count].iter().enumerate().filter(|(_, surface)| surface.reflects.any()) {
            let bsdf = bsdf::<METAL>(surface, &ends[p]);
            let mut u = numbers.light[p];
            let [number, second] = numbers.choice.map_or([u.x, zero], |choice| [choice[p].x, choice[p].y]);
            let rough = if METAL { ends[p].rough() } else { M8::splat(false) };
            let gloss = lobes[p].as_ref().filter(|_| METAL && !is_closed).map(Lobe::gloss);
            let (choice, lanes) = which.choose(lights, surface, (rough, gloss.as_ref()), p, [number, second]);
            if numbers.choice.is_none() {
                u.x = choice.u;
            }
            let mut chosen = lights.chosen(choice.index);
            let mut sample = match which {
                Which::Sun(sun) => {
                    let (sample, radiance) = sun.sample(surface.point, u);
                    chosen.radiance = radiance;
                    sample.into()
                }
                _ => lights.sample(&mut chosen, measure, surface.point, surface.normal, u),
            };
            let mut alone = M8::splat(false);
            if METAL
                && samples_lobes
                && let Some(lobe) = &lobes[p]
            {
                alone = chosen.sample_lobe(&mut sample, lobe, surface.point, u);
            }
            let cos = sample.direction.dot(surface.normal);
            let some = sample.pdf.gt(zero) & choice.pmf.gt(zero);
            let own = chosen.is_own(places[p].primitives, surface.point, surface.normal);
            lit[p] = lanes & sample.emits & some & cos.gt(zero) & !own;
            let Evaluated { mut color, factor, pdf: surface_pdf } = bsdf.evaluate(sample.direction);
            let mut seen = M8::splat(false);
            if METAL
                && is_closed
                && let Some(lobe) = lobes[p].as_ref().filter(|_| places[p].fitted.any())
            {
                let known = Fitted::of(fitted, p, choice.index);
                color += keep(-lobe.evaluate(sample.direction, cos), known.counted);
                (lit[p], seen) = (lit[p] & !known.dark, known.lit);
            }
            let pdf = select(lit[p], sample.pdf * choice.pmf, one);
            let factor = match heuristic {
                None => factor,
                Some(by) => {
                    let weight = by.weights([technique_pdf(one, pdf, sample.delta), surface_pdf])[0];
                    let weight = select(alone, one, weight);
                    factor * if is_mixed { select(rough, weight, one) } else { weight }
                }
            };
            found[p] = product(color, chosen.radiance) * (factor / pdf);
            rays[1][p] = scene.surfaces.bvh.rays(surface.point, sample.direction).leaving(places[p].primitives);
            limit[p] = sample.distance * X8::lit(COVERED);
            target[p] = chosen.shape;
            if is_closed && let Some(counted) = counted {
                let part = X8::from_fn(|lane| {
                    counted.get(choice.index.as_array()[lane] as usize).map_or(0.0, |of| of[p].lane(lane))
                });
                reflected[p] += keep(found[p] * -part, lit[p]);
            }
            if METAL && seen.any() {
                reflected[p] += keep(found[p], lit[p] & seen);
                lit[p] = lit[p] & !seen;
            }
            // a sky or a profile may be dark in a direction, and a surface black
            lit[p] = lit[p] & found[p].max_abs().gt(zero);
            self.count.shadow += u64::from(lit[p].bits().count_ones());
        }
        self.add_unoccluded(count, &found, lit, &limit, &target, reflected);
    }

    /// Adds what arrives along the shadow rays that are not occluded.
    #[inline(always)]
    pub(super) fn add_unoccluded(
        &mut self,
        count: usize,
        found: &[V8; GROUP],
        mut lit: [M8; GROUP],
        limit: &[X8; GROUP],
        target: &[u32x8; GROUP],
        reflected: &mut [V8; GROUP],
    ) {
        let (rays, bvh) = (&self.rays[1][..count], &self.scene.surfaces.bvh);
        bvh.occluded(rays, &mut lit[..count], &limit[..count], &target[..count], &mut self.scratch);
        for p in 0..count {
            reflected[p] += keep(found[p], lit[p]);
        }
    }
}
