//! The lights of a scene: packets choose one per lane, and sample it.
//!
//! How lights that do not emit evenly are sampled, here and elsewhere: by pbrt-v4 (`diffuse`, `portal` and `goniometric` lights), Mitsuba 3.9.1,
//! Cycles 4.2 (by its manual) and MoonRay (`RectLight`, `PortalLight`).
//!
//! | what emits | here | pbrt-v4 | Mitsuba 3 | Cycles | MoonRay |
//! |---|---|---|---|---|---|
//! | a picture on a flat light | radiance × projected solid angle, or in closed form | the shape | radiance × area | the shape | radiance × area |
//! | a picture on a sphere | radiance × bounds of the visible area | the shape | radiance × area | the shape | radiance × area |
//! | a spread | what the point sees, by solid angle | none | none | what the point sees, by solid angle | what the point sees, by area |
//! | a picture and a spread | the picture | none | none | what the point sees | the picture; samples beyond the spread are lost |
//! | an IES file | a point, a spot, or a flat light | a point, as an image | none | any light | none |
//! | emission of a profile | in proportion to it, with pdf and inverse | in proportion to it | a point's only | none | none |
//! | a projected image | all of it | all of it | all of it | by nodes | by a filter |
//! | an image sky through portals | what is seen, in proportion to its radiance, up to 8, without counting twice | one | none | portals by area or solid angle | a portal by area |
//! | a sky without a file | CIE, 15 types | none | sun and sky models | sun and sky models | none |
//!
//! `cargo run --release -- render render/gallery/emitters/FILE.pbrt` shows a picture (`television`, `window`), a spread (`panel`), portals, a
//! sky without a file and its sun (`windows`), and an IES file (`washers`). `benches/peers/beside_mitsuba.py` measures each against Mitsuba.

mod chosen;
mod directed;
mod irradiance;
mod pictures;
pub(crate) mod record;
mod spread;

use crate::bvh::NOTHING;
use crate::geometry::Geometry;
use crate::light_picture::LightPicture;
use crate::light_profile::LightProfile;
use crate::packet::{M8, V8, X8, each_group, equal, select};
use crate::scene::{Emission, Scene, Shape};
use crate::sky::Sky;
use crate::technique::Measure;
pub use chosen::{Chosen, Drawn};
use directed::{DirectedLight, directed_lights};
use etendue::light::Spread;
use etendue::select::{FEW, LightBound};
use etendue::{
    DirectionalLight, LightSample, LightSampler, Mask, Parallelogram, PointLight, Real, Sphere, SpotLight, Triangle,
    Vec2, u32x8,
};
pub use irradiance::PictureIrradiance;
use pictures::Tables;
use rayon::prelude::*;
pub(crate) use record::Candidate;
use record::{
    DIRECTED, DISTANT, KINDS, LightRecord, ONLY_AREAS, ONLY_DELTAS, PARALLELOGRAM, PICTURED, PICTURES, POINT, PROFILED,
    PROFILES, PackedLight, SKY, SPHERE, SPOT, SPREAD, SPREADS, TRIANGLE, TWO_SIDED, UNEVEN, area_lights, delta_lights,
};
use std::sync::Arc;

/// The lights of a scene.
#[derive(Debug, Default)]
pub struct Lights {
    /// The lights, without those of `unpacked`.
    packed: Vec<PackedLight>,
    /// Of more than [`FEW`] lights, the ones that are shapes, which come first: their indices. They are packed when they are chosen, since
    /// a copy of each is as large as the shape.
    unpacked: Vec<u32>,
    shapes: Arc<[Shape]>,
    pictures: Arc<[LightPicture]>,
    profiles: Arc<[LightProfile]>,
    /// By which shapes with pictures are sampled.
    tables: Tables,
    /// By which the light of a few shapes with pictures is known without samples, in the order of the lights.
    irradiances: Vec<Option<PictureIrradiance>>,
    /// The lights that are no shapes.
    others: Vec<Candidate>,
    /// Bit k is set if there is a light of kind k, [`SPREADS`] if one has a spread, [`PICTURES`] if one shows a picture, and [`PROFILES`] if
    /// one with an area has a profile.
    kinds: u32,
    directed: Vec<DirectedLight>,
    sky: Option<Arc<Sky>>,
    /// Index of the light of each shape; [`NOTHING`] for shapes that are not lights.
    shape_lights: Vec<u32>,
}

fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}

impl Lights {
    /// All lights of a scene: emitting shapes, delta lights, the sky.
    pub fn new(scene: &Scene, sky: Option<Arc<Sky>>) -> Self {
        let mut others = delta_lights(scene);
        others.extend(sky.as_ref().map(|sky| Candidate::sky(sky.flux())));
        Self::of(others, scene, &scene.shapes, sky)
    }
    /// The delta lights of a scene alone.
    pub fn deltas(scene: &Scene) -> Self {
        Self::of(delta_lights(scene), scene, &Arc::default(), None)
    }
    fn of(others: Vec<Candidate>, scene: &Scene, shapes: &Arc<[Shape]>, sky: Option<Arc<Sky>>) -> Self {
        let mut own = Self {
            others,
            sky,
            shape_lights: vec![NOTHING; shapes.len()],
            directed: directed_lights(scene),
            shapes: Arc::clone(shapes),
            pictures: Arc::clone(&scene.pictures),
            profiles: Arc::clone(&scene.profiles),
            ..Self::default()
        };
        let all = own.candidates();
        let flag = |kind: u32, flag: u32, bit: u32| if kind & flag == 0 { 0 } else { bit };
        let flags = [(SPREAD, SPREADS), (PICTURED, PICTURES), (PROFILED, PROFILES)];
        let bits = |kind: u32| flags.iter().fold(1 << (kind & KINDS), |bits, (own, bit)| bits | flag(kind, *own, *bit));
        own.kinds = all.iter().fold(0, |kinds, light| kinds | bits(light.record.kind));
        for (index, Candidate { record, .. }) in (0..).zip(&all) {
            if let Some(light) = own.shape_lights.get_mut(record.shape as usize) {
                *light = index;
            }
        }
        let is_unpacked = |record: &&LightRecord| all.len() > FEW && record.shape != NOTHING;
        let records = || all.iter().map(|light| &light.record);
        own.unpacked = records().take_while(is_unpacked).map(|record| record.shape).collect();
        own.packed = records().skip(own.unpacked.len()).map(LightRecord::pack).collect();
        if own.kinds & PICTURES != 0 {
            own.tables = Tables::new(shapes, &scene.pictures);
        }
        if own.kinds & PICTURES != 0 && own.only_few_areas() {
            let irradiance = |light: &Candidate| {
                let Shape { emission, geometry, .. } = shapes.get(light.record.shape as usize)?;
                let emission = emission.filter(|emission| emission.spread.is_none() && emission.profile.is_none())?;
                PictureIrradiance::new(&scene.pictures[emission.picture? as usize], geometry)
            };
            own.irradiances = all.par_iter().map(irradiance).collect();
        }
        own
    }
    /// The lights with their powers, in their order: those that are shapes come first, the sky last.
    pub(crate) fn candidates(&self) -> Vec<Candidate> {
        area_lights(&self.shapes).chain(self.others.iter().copied()).collect()
    }
    /// The sky, if it is one of the lights.
    pub(crate) fn sky(&self) -> Option<&Arc<Sky>> {
        self.sky.as_ref()
    }
    /// Bounds of the lights of a scene that have an area, in their order.
    pub fn bounds(scene: &Scene) -> Vec<LightBound> {
        area_lights(&scene.shapes).map(|Candidate { record, power }| record.bound(power)).collect()
    }
    /// Number of lights.
    pub fn len(&self) -> usize {
        self.unpacked.len() + self.packed.len()
    }
    /// Is there no light at all?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// True if all lights are delta lights, which need no pair for a point on the light.
    pub fn only_deltas(&self) -> bool {
        self.kinds & !ONLY_DELTAS == 0
    }
    /// Whether there are 1 to [`FEW`] lights, and all have an area.
    pub fn only_few_areas(&self) -> bool {
        self.kinds & !ONLY_AREAS == 0 && (1..=FEW).contains(&self.len())
    }
    /// The irradiance from the picture of one of a few lights, if it shows one and has a closed form.
    pub fn irradiance(&self, light: usize) -> Option<&PictureIrradiance> {
        self.irradiances.get(light)?.as_ref()
    }
    /// Whether the pictures of any lights have closed forms.
    pub fn has_irradiances(&self) -> bool {
        self.irradiances.iter().any(Option::is_some)
    }
    /// Whether all lights are shapes that show pictures, without closed forms.
    pub fn only_sampled(&self) -> bool {
        let is_sampled = |shape: &Shape| shape.emission.is_none_or(|emission| emission.picture.is_some());
        self.kinds & !ONLY_AREAS == 0
            && self.kinds & PICTURES != 0
            && !self.has_irradiances()
            && self.shapes.iter().all(is_sampled)
    }
    /// Lights with these indices.
    #[inline(always)]
    pub fn chosen(&self, index: u32x8) -> Chosen {
        if let [only] = &self.packed[..]
            && self.unpacked.is_empty()
        {
            return Chosen::new(only.map(|half| half.map(X8::splat)));
        }
        let own;
        let rows = if self.unpacked.is_empty() {
            index.to_array().map(|i| &self.packed[i as usize])
        } else {
            own = index.to_array().map(|i| self.pack(i));
            own.each_ref()
        };
        Chosen::new([0, 1].map(|half| X8::transpose(rows.map(|row| X8::from(row[half])))))
    }
    /// One of more than [`FEW`] lights. Not inlined, since it would burden fewer.
    #[inline(never)]
    fn pack(&self, light: u32) -> PackedLight {
        let light = light as usize;
        let Some(&shape) = self.unpacked.get(light) else { return self.packed[light - self.unpacked.len()] };
        LightRecord::of(shape, &self.shapes[shape as usize]).map(|light| light.record.pack()).unwrap_or_default()
    }
    /// Samples the chosen lights from points `p` on surfaces with this normal. `emits` allows for two-sided lights. For skies, pictures,
    /// directed lights and those with a spread, `radiance` of `chosen` becomes that of the sampled direction.
    #[inline(always)]
    pub fn sample(&self, chosen: &mut Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        const ONLY_SPHERES: u32 = 1 << SPHERE;
        const ONLY_TRIANGLES: u32 = 1 << TRIANGLE;
        const ONLY_PARALLELOGRAMS: u32 = 1 << PARALLELOGRAM;
        let mut sample = match self.kinds {
            ONLY_SPHERES => chosen.sphere(measure, p, normal, u),
            ONLY_TRIANGLES => chosen.triangle(measure, p, normal, u),
            ONLY_PARALLELOGRAMS => chosen.parallelogram(measure, p, normal, u),
            kinds if kinds & UNEVEN != 0 => self.uneven(chosen, measure, p, normal, u),
            _ => self.mixed(chosen, measure, p, normal, u).unwrap_or_else(|| unreachable!("there is a light")),
        };
        sample.emits = sample.emits | chosen.has(TWO_SIDED);
        sample
    }
    /// Samples a scene with lights that emit unevenly: those in lanes of their own, and what the points see of panels with a spread.
    #[inline(never)]
    fn uneven(&self, chosen: &mut Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        // normals before the lights are narrowed
        let normal_of_light = (self.kinds & SPREADS != 0).then(|| chosen.narrow(p));
        let mut drawn = self.mixed(chosen, measure, p, normal, u);
        if self.kinds >> DIRECTED & 1 == 1 {
            let here = equal(chosen.kind & u32x8::splat(KINDS), u32x8::splat(DIRECTED));
            let index = chosen.second.x.to_bits();
            let (sample, intensity) = directed::sample(&self.directed, index, chosen.place, p, here);
            chosen.radiance = V8::blend(here, product(chosen.radiance, intensity), chosen.radiance);
            drawn = Some(Drawn::blend(here, sample.into(), drawn));
        }
        let sample = drawn.unwrap_or_else(|| unreachable!("there is a light"));
        if let Some(normal) = normal_of_light {
            let lanes = chosen.has(SPREAD) & !chosen.has(PROFILED);
            let factor = spread::attenuation(normal, sample.direction, &chosen.spread, lanes);
            chosen.radiance = chosen.radiance * factor;
            if self.kinds & PROFILES != 0 {
                self.distribute(chosen, sample.direction, normal.normalize());
            }
        }
        sample
    }
    /// Multiplies the radiance of lights with profiles by what these have in the sampled directions.
    fn distribute(&self, chosen: &mut Chosen, direction: V8, normal: V8) {
        each_group(chosen.shape, chosen.has(PROFILED), |index, lanes| {
            if let Some(profile) = self.shapes[index as usize].emission.and_then(|emission| emission.profile) {
                let factor = self.profiles[profile as usize].factor(-direction, normal);
                chosen.radiance = chosen.radiance * select(lanes, factor, X8::splat(1.0));
            }
        });
    }
    /// Samples every kind of light that the scene has, but for those with directions of their own, each in its lanes.
    fn mixed(&self, chosen: &mut Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Option<Drawn> {
        let mut mixed: Option<Drawn> = None;
        for kind in (SPHERE..=SKY).filter(|kind| self.kinds >> kind & 1 == 1) {
            let here = equal(chosen.kind & u32x8::splat(KINDS), u32x8::splat(kind));
            let Chosen { place, first, second, .. } = *chosen;
            let sample = match kind {
                SPHERE | TRIANGLE | PARALLELOGRAM if self.kinds & PICTURES != 0 => {
                    self.pictured(kind, here, chosen, measure, p, normal, u)
                }
                SPHERE => chosen.sphere(measure, p, normal, u),
                TRIANGLE => chosen.triangle(measure, p, normal, u),
                PARALLELOGRAM => chosen.parallelogram(measure, p, normal, u),
                POINT => PointLight::new(place).by_delta(p).sample(u).into(),
                SPOT => {
                    let [one_minus_cos_inner, one_minus_cos_outer] = [second.x, second.y];
                    let light = SpotLight { position: place, axis: first, one_minus_cos_inner, one_minus_cos_outer };
                    light.by_delta(p).sample(u).into()
                }
                DISTANT => DirectionalLight::new(place).by_delta(p).sample(u).into(),
                _ => {
                    let sky = self.sky.as_ref().unwrap_or_else(|| unreachable!("a sky among the records"));
                    let (sample, radiance) = sky.sample(measure, p, normal, u);
                    chosen.radiance = V8::blend(here, radiance, chosen.radiance);
                    sample.into()
                }
            };
            mixed = Some(Drawn::blend(here, sample, mixed));
        }
        mixed
    }
    /// Samples shapes of one kind, some of which show pictures, and puts the radiance of the sampled points into the lanes `here`.
    // not inlined, so that it does not burden scenes without pictures
    #[inline(never)]
    #[allow(clippy::too_many_arguments, reason = "those of `sample`, and which lanes")]
    fn pictured(
        &self,
        kind: u32,
        here: M8,
        chosen: &mut Chosen,
        measure: Measure,
        p: V8,
        normal: V8,
        u: Vec2<X8>,
    ) -> Drawn {
        let pictured = here & chosen.has(PICTURED);
        let by_shape = || -> LightSample<X8> {
            match kind {
                SPHERE => chosen.sphere(measure, p, normal, u),
                TRIANGLE => chosen.triangle(measure, p, normal, u),
                _ => chosen.parallelogram(measure, p, normal, u),
            }
        };
        let mut sample = None;
        each_group(chosen.shape, pictured, |index, lanes| {
            let shape = &self.shapes[index as usize];
            let Some(picture) = shape.emission.and_then(|emission| emission.picture) else { return };
            let picture = &self.pictures[picture as usize];
            if let Some(table) = self.tables.of(index as usize) {
                let drawn = table.sample((&shape.geometry, &picture.axes), measure, p, normal, u);
                // in a packet of one light, no other map is needed
                let others = sample.unwrap_or_else(|| if lanes.all() { drawn } else { by_shape() });
                sample = Some(LightSample::blend(lanes, drawn, others));
            }
        });
        let sample = sample.unwrap_or_else(by_shape);
        let shapes = chosen.shape;
        each_group(shapes, pictured, |index, lanes| {
            let shape = &self.shapes[index as usize];
            if let Some(picture) = shape.emission.and_then(|emission| emission.picture) {
                let picture = &self.pictures[picture as usize];
                picture.show(&shape.geometry, lanes, sample.uv, sample.normal, &mut chosen.radiance);
            }
        });
        sample.into()
    }
    /// The light of a shape that is one.
    #[inline]
    pub fn of_shape(&self, shape: usize) -> u32 {
        self.shape_lights[shape]
    }
    /// The sky, which is the last of the lights.
    #[inline]
    pub fn of_sky(&self) -> u32 {
        self.len() as u32 - 1
    }
    /// Pdf per steradian, without the choice of the light, with which [`sample`](Self::sample) by solid angle draws the direction `w` to a
    /// shape from `p`, which it hits.
    #[inline]
    pub fn shape_pdf(&self, shape: usize, geometry: &Geometry, p: V8, w: V8) -> X8 {
        if let Some(table) = self.tables.of(shape)
            && let Some(picture) = self.shapes[shape].emission.and_then(|emission| emission.picture)
        {
            let axes = &self.pictures[picture as usize].axes;
            return table.pdf((geometry, axes), p, w);
        }
        match *geometry {
            Geometry::Sphere { center, radius } => {
                Sphere::new(center.into(), X8::splat(radius)).by_solid_angle(p).pdf_of_hit(w)
            }
            Geometry::Triangle([a, b, c]) => {
                // the edges as the light's record has them
                let edge = |to: [f32; 3]| V8::from(std::array::from_fn(|k| to[k] - a[k]));
                Triangle { v0: a.into(), e1: edge(b), e2: edge(c) }.by_solid_angle(p).pdf_of_hit(w)
            }
            Geometry::Parallelogram { p: corner, u, v } => {
                let mut light = Parallelogram::new(corner.into(), u.into(), v.into());
                if self.kinds & SPREADS != 0
                    && let Some(Emission { spread: Some(spread), picture: None, .. }) = self.shapes[shape].emission
                {
                    light = light.visible_part(p, &Spread::splat(spread));
                }
                light.by_solid_angle(p).pdf_of_hit(w)
            }
        }
    }
    /// The same for a direction to the sky.
    #[inline]
    pub fn sky_pdf(&self, p: V8, normal: V8, w: V8) -> X8 {
        match &self.sky {
            Some(sky) => sky.pdf(Measure::SolidAngle, p, normal, w),
            None => X8::lit(0.0),
        }
    }
}
