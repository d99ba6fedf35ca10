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
mod kinds;
mod pictures;
pub(crate) mod point;
mod record;
pub mod sky;
mod sky_light;
pub(crate) mod spot;
pub(crate) mod sun;

use crate::bvh::{PrimitiveId, PrimitiveIds};
use crate::geometry::{self, Geometry, Kind};
use crate::packet::{V8, X8, each_bit, equal};
use crate::scene::light_picture::LightPicture;
use crate::scene::light_profile::LightProfile;
use crate::scene::{Scene, Shape};
use crate::technique::Measure;
pub use chosen::{Chosen, Drawn, LightDirection};
use directed::DirectedLight;
use etendue::select::{LightBound, SpatialLights};
use etendue::{Mask, Real, Vec2, u32x8};
use kinds::{
    ONLY_AREAS, ONLY_DELTAS, PICTURES, PROFILES, SHAPES, SPREADS, UNEVEN, UNSEENS, area_lights, delta_lights,
    sample_delta,
};
use pictures::Tables;
use record::{DIRECTED, PROFILED, PackedLight, SKY, SPREAD, TWO_SIDED, UNSEEN};
pub(crate) use record::{Far, LightRecord};
use sky::Sky;
use std::sync::Arc;

/// The greatest number of lights that are chosen by what each can contribute to a point.
const FEW: usize = SpatialLights::MOST;

/// Instead of the index of a light: it is none.
pub const NO_LIGHT: u32 = u32::MAX;

/// The lights of a scene.
#[derive(Debug, Default)]
pub struct Lights {
    /// The lights, without those of `unpacked`.
    packed: Vec<PackedLight>,
    /// Of more than [`FEW`] lights, the ones that are shapes, which come first: their indices. They are packed when they are chosen, since
    /// a copy of each is as large as the shape.
    unpacked: Vec<usize>,
    shapes: Arc<[Shape]>,
    pictures: Arc<[LightPicture]>,
    profiles: Arc<[LightProfile]>,
    /// By which shapes with pictures are sampled.
    tables: Tables,
    /// The lights that are no shapes.
    others: Vec<LightRecord>,
    /// Bit k is set if there is a light of kind k, [`SPREADS`] if one has a spread, [`PICTURES`] if one shows a picture, and [`PROFILES`] if
    /// one with an area has a profile.
    kinds: u32,
    directed: Vec<DirectedLight>,
    sky: Option<Arc<Sky>>,
    /// Index of the light of each shape; [`NO_LIGHT`] for shapes that are none.
    shape_lights: Vec<u32>,
}

impl Lights {
    /// All lights of a scene: emitting shapes, delta lights, the sky.
    pub fn new(scene: &Scene, sky: Option<Arc<Sky>>) -> Self {
        Self::of(scene, &scene.shapes, sky)
    }
    /// The lights of a scene that no ray can hit.
    pub fn unhit(scene: &Scene) -> Self {
        let is_unseen = |shape: &Shape| shape.emission.is_some_and(|emission| emission.is_unseen);
        let mut shapes: Vec<Shape> = Vec::new();
        if scene.shapes.iter().any(is_unseen) {
            // the indices of shapes stay what they are
            let only = |shape: &Shape| Shape { emission: shape.emission.filter(|_| is_unseen(shape)), ..shape.clone() };
            shapes.extend(scene.shapes.iter().map(only));
        }
        Self::of(scene, &shapes.into(), None)
    }
    fn of(scene: &Scene, shapes: &Arc<[Shape]>, sky: Option<Arc<Sky>>) -> Self {
        let (mut others, directed) = delta_lights(scene);
        others.extend(sky.as_deref().map(sky_light::record));
        let mut own = Self {
            others,
            sky,
            shape_lights: vec![NO_LIGHT; shapes.len()],
            directed,
            shapes: Arc::clone(shapes),
            pictures: Arc::clone(&scene.pictures),
            profiles: Arc::clone(&scene.profiles),
            ..Self::default()
        };
        let all = own.records();
        own.kinds = all.iter().fold(0, |kinds, light| kinds | light.kinds());
        for (index, record) in (0..).zip(&all) {
            if let Some(light) = record.primitive.shape().and_then(|shape| own.shape_lights.get_mut(shape)) {
                *light = index;
            }
        }
        let is_unpacked = |record: &&LightRecord| all.len() > FEW && record.primitive != PrimitiveId::NONE;
        own.unpacked = all.iter().take_while(is_unpacked).filter_map(|record| record.primitive.shape()).collect();
        own.packed = all.iter().skip(own.unpacked.len()).map(LightRecord::pack).collect();
        if own.kinds & PICTURES != 0 {
            own.tables = Tables::new(shapes, &scene.pictures);
        }
        own
    }
    /// The lights with their powers, in their order: those that are shapes come first, the sky last.
    pub(crate) fn records(&self) -> Vec<LightRecord> {
        area_lights(&self.shapes).chain(self.others.iter().copied()).collect()
    }
    /// The sky, if it is one of the lights.
    pub(crate) fn sky(&self) -> Option<&Arc<Sky>> {
        self.sky.as_ref()
    }
    /// Bounds of the lights of a scene that have an area, in their order.
    pub fn bounds(scene: &Scene) -> Vec<LightBound> {
        area_lights(&scene.shapes).map(|light| light.bound(light.power)).collect()
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
    /// Whether there are 1 to [`SpatialLights::MOST`] lights, and all have an area.
    pub fn only_few_areas(&self) -> bool {
        self.kinds & !ONLY_AREAS == 0 && (1..=FEW).contains(&self.len())
    }
    /// Whether there is one light, whose points can be uniform over projected solid angle and whose radiance is the same everywhere.
    pub fn is_one_projected(&self) -> bool {
        self.len() == 1 && self.kinds & !(SHAPES & !(1 << Kind::Disk as u32)) == 0
    }
    /// Lights with these indices.
    #[inline(always)]
    pub fn chosen(&self, index: u32x8) -> Chosen {
        let first = index.as_array()[0];
        if self.unpacked.is_empty() && equal(index, u32x8::splat(first)).all() {
            return Chosen::new(self.packed[first as usize].map(|half| half.map(X8::splat)));
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
        kinds::of_shape(shape as u32, &self.shapes[shape]).map(|light| light.pack()).unwrap_or_default()
    }
    /// Samples the chosen lights from points `p` on surfaces with this normal. `emits` allows for two-sided lights.
    #[inline(always)]
    pub fn sample(&self, chosen: &Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let kinds = self.kinds;
        let (mut to, radiance) = if kinds & !SHAPES == 0 && kinds.is_power_of_two() {
            let to = geometry::sample(kinds.trailing_zeros(), chosen.vectors(), measure, p, normal, u);
            (to, chosen.radiance)
        } else {
            let (mut to, mut radiance) = (LightDirection::none(), chosen.radiance);
            match kinds & UNEVEN {
                0 => self.by_kind(chosen, (measure, u), [p, normal], &mut to, &mut radiance),
                _ => self.uneven(chosen, (measure, u), [p, normal], &mut to, &mut radiance),
            }
            (to, radiance)
        };
        to.emits = to.emits | chosen.has(TWO_SIDED);
        let mut primitives = chosen.primitives;
        if kinds & UNSEENS != 0 {
            let unseen = chosen.has(UNSEEN);
            to.delta = to.delta | unseen;
            primitives = PrimitiveIds::pick(unseen, PrimitiveIds::none(), primitives);
        }
        Drawn { to, radiance, primitives }
    }
    /// Samples a scene with lights that emit unevenly: those in lanes of their own, and what the points see of panels with a spread.
    #[inline(never)]
    fn uneven(
        &self,
        chosen: &Chosen,
        by: (Measure, Vec2<X8>),
        [p, normal]: [V8; 2],
        to: &mut LightDirection,
        radiance: &mut V8,
    ) {
        let narrowed = (self.kinds & SPREADS != 0).then(|| chosen.narrowed(self.kinds & SHAPES, p));
        let part = narrowed.as_ref().map_or(chosen, |(_, part)| part);
        self.by_kind(part, by, [p, normal], to, radiance);
        if let Some((normal, _)) = narrowed {
            let lanes = chosen.has(SPREAD) & !chosen.has(PROFILED);
            *radiance = *radiance * chosen.spread.attenuation_in(lanes, to.direction, normal);
            if self.kinds & PROFILES != 0 {
                self.distribute(chosen, to.direction, normal.normalize(), radiance);
            }
        }
    }
    /// Multiplies the radiance of lights with profiles by what these have in the sampled directions.
    fn distribute(&self, chosen: &Chosen, direction: V8, normal: V8, radiance: &mut V8) {
        chosen.primitives.each(chosen.has(PROFILED), |primitive, lanes| {
            let shape = primitive.shape().map(|shape| &self.shapes[shape]);
            if let Some(profile) = shape.and_then(|shape| shape.emission).and_then(|emission| emission.profile) {
                let factor = self.profiles[profile as usize].factor(-direction, normal);
                *radiance = *radiance * Real::blend(lanes, factor, X8::splat(1.0));
            }
        });
    }
    /// Samples every kind of light that the scene has, each in its lanes.
    #[inline(never)]
    fn by_kind(
        &self,
        chosen: &Chosen,
        (measure, u): (Measure, Vec2<X8>),
        [p, normal]: [V8; 2],
        to: &mut LightDirection,
        radiance: &mut V8,
    ) {
        each_bit(self.kinds & (SHAPES | ONLY_DELTAS | 1 << SKY), |kind| {
            let kind = kind as u32;
            let here = chosen.is(kind);
            if !here.any() {
                return;
            }
            let sample = match kind {
                kind if SHAPES >> kind & 1 == 0 => match &self.sky {
                    Some(sky) if kind == SKY => {
                        let (sample, from_sky) = sky.sample(measure, p, normal, u);
                        *radiance = V8::blend(here, from_sky, *radiance);
                        sample.into()
                    }
                    _ if kind == DIRECTED => {
                        let (sample, factor) = directed::sample(&self.directed, chosen, p, here);
                        *radiance = V8::blend(here, *radiance * factor, *radiance);
                        sample.into()
                    }
                    _ => sample_delta(kind, chosen, p, u).into(),
                },
                _ if self.kinds & PICTURES != 0 => {
                    let shown = (&self.shapes[..], &self.pictures[..]);
                    self.tables.sample(shown, (kind, here), chosen, (measure, u), [p, normal], radiance)
                }
                _ => geometry::sample(kind, chosen.vectors(), measure, p, normal, u),
            };
            to.put(here, &sample);
        });
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
        let of = |shape: &Shape| shape.emission.filter(|emission| emission.picture.is_none())?.spread;
        let spread = if self.kinds & SPREADS != 0 { of(&self.shapes[shape]) } else { None };
        geometry.pdf(spread, p, w)
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
