//! The lights of a scene: packets choose one per lane, and sample it.

use crate::bvh::NOTHING;
use crate::geometry::Geometry;
use crate::packet::{M8, V8, X8, equal, select};
use crate::scene::{DeltaLight, Scene, Shape};
use crate::sky::Sky;
use crate::technique::Measure;
use etendue::select::{Allocated, Choice, FEW, LightBound, LightChoice, LightsAt, PowerLights, SpatialLights};
use etendue::{
    DirectionalLight, LightSample, LightSampler, Parallelogram, PointLight, Real, Sphere, SpotLight, Triangle, Vec2,
    Vec3, u32x8,
};
use std::sync::Arc;

// kinds of lights, and a flag beside them
const SPHERE: u32 = 0;
const TRIANGLE: u32 = 1;
const PARALLELOGRAM: u32 = 2;
const POINT: u32 = 3;
const SPOT: u32 = 4;
const DISTANT: u32 = 5;
const SKY: u32 = 6;
const KINDS: u32 = 7;
const TWO_SIDED: u32 = 8;
const ONLY_DELTAS: u32 = 1 << POINT | 1 << SPOT | 1 << DISTANT;
const ONLY_AREAS: u32 = 1 << SPHERE | 1 << TRIANGLE | 1 << PARALLELOGRAM;

/// A light.
#[derive(Clone, Copy, Debug, Default)]
struct LightRecord {
    /// Centre of a sphere, corner of a triangle or parallelogram, position of a point or spot light, direction to a distant light.
    place: [f32; 3],
    /// First edge of a triangle or parallelogram, axis of a spot light; a sphere has its radius in x.
    first: [f32; 3],
    /// Second edge of a triangle or parallelogram; a spot light has the cosines of its inner and outer angle in x and y.
    second: [f32; 3],
    /// Radiance; intensity of a point or spot light, irradiance of a distant light.
    radiance: [f32; 3],
    /// Its kind, and [`TWO_SIDED`].
    kind: u32,
    /// Index of its shape, or [`NOTHING`].
    shape: u32,
}

/// A [`LightRecord`] in two halves of eight numbers: two transpositions gather eight lights. [`Chosen::new`] unpacks it.
type PackedLight = [[f32; 8]; 2];

impl LightRecord {
    /// A shape that emits, and its power in units of π.
    fn of(index: u32, shape: &Shape) -> Option<(Self, f64)> {
        let emission = shape.emission?;
        let (kind, [place, first, second]) = match shape.geometry {
            Geometry::Sphere { center, radius } => (SPHERE, [center, [radius, 0.0, 0.0], [0.0; 3]]),
            Geometry::Triangle([a, b, c]) => {
                let edge = |to: [f32; 3]| std::array::from_fn(|k| to[k] - a[k]);
                (TRIANGLE, [a, edge(b), edge(c)])
            }
            Geometry::Parallelogram { p, u, v } => (PARALLELOGRAM, [p, u, v]),
        };
        let (sides, flag) = if emission.two_sided { (2.0, TWO_SIDED) } else { (1.0, 0) };
        let power = sum(emission.radiance) * shape.geometry.area() * sides;
        let record = Self { place, first, second, radiance: emission.radiance, kind: kind | flag, shape: index };
        Some((record, power))
    }
    fn pack(&self) -> PackedLight {
        let Self { place: [a, b, c], first: [d, e, f], second: [g, h, i], radiance: [red, green, blue], .. } = *self;
        [
            [a, b, c, d, e, f, g, h],
            [i, red, green, blue, f32::from_bits(self.kind), f32::from_bits(self.shape), 0.0, 0.0],
        ]
    }
    /// The bound of what a light with an area contributes, by its power.
    fn bound(&self, power: f64) -> LightBound {
        let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
        let (p, u, v) = (wide(self.place), wide(self.first), wide(self.second));
        let (center, radius, normal) = match self.kind & KINDS {
            SPHERE => (p, f64::from(self.first[0]), Vec3::default()),
            TRIANGLE => {
                let center = p + (u + v) * (1.0 / 3.0);
                let corners = [p, p + u, p + v];
                (center, corners.into_iter().map(|c| (c - center).length()).fold(0.0, f64::max), u.cross(v))
            }
            _ => {
                let center = p + (u + v) * 0.5;
                (center, 0.5 * (u + v).length().max((u - v).length()), u.cross(v))
            }
        };
        let length = normal.length();
        let narrow = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
        let two_sided = self.kind & TWO_SIDED != 0;
        LightBound {
            center: narrow(center),
            // the rounding of the centre moves the sphere by less than this
            radius: (radius * (1.0 + 1e-6)) as f32,
            normal: narrow(if length > 0.0 { normal * (1.0 / length) } else { normal }),
            two_sided: two_sided && length > 0.0,
            power: power as f32 * if two_sided { 0.5 } else { 1.0 },
        }
    }
}

/// Chooses among any number of lights by their power: a block of neighbours by one number, a light of the block by another.
#[derive(Debug, Default)]
pub struct PowerTable {
    /// Lights in a block, all but the last one.
    block: usize,
    blocks: Vec<f32>,
    lights: Vec<f32>,
}

impl PowerTable {
    fn new(powers: &[f64]) -> Self {
        // at least as many lights in a block as blocks
        let block = if powers.len() <= PowerLights::MOST { powers.len().max(1) } else { powers.len().isqrt() + 1 };
        let greatest = powers.iter().fold(f64::MIN_POSITIVE, |m, &p| m.max(p));
        // relative to the greatest, so that all sums are finite; no light vanishes
        let relative = |p: f64| if p > 0.0 { ((p / greatest) as f32).max(f32::MIN_POSITIVE) } else { 0.0 };
        let powers: Vec<f32> = powers.iter().map(|&p| relative(p)).collect();
        let mut table = Self { block, blocks: Vec::new(), lights: vec![0.0; powers.len()] };
        let sums: Vec<f32> = powers.chunks(block).map(|powers| powers.iter().sum()).collect();
        for (powers, sums) in powers.chunks(block).zip(table.lights.chunks_mut(block)) {
            PowerLights::new(powers, sums).expect("a block is small enough");
        }
        table.blocks = vec![0.0; sums.len()];
        PowerLights::new(&sums, &mut table.blocks).expect("less than 2²⁸ lights");
        table
    }
    fn lights_of(&self, block: u32) -> PowerLights<'_> {
        let start = block as usize * self.block;
        let end = (start + self.block).min(self.lights.len());
        PowerLights::from_buffer(self.lights.get(start..end).unwrap_or_default())
    }
    /// Chooses by `u`, and by `second` if there are blocks.
    fn choose(&self, u: X8, second: X8) -> Choice<X8> {
        let first = PowerLights::from_buffer(&self.blocks);
        if self.blocks.len() == 1 {
            return self.lights_of(0).choose(u);
        }
        let block: Choice<X8> = first.choose(u);
        let each: [Choice<f32>; 8] =
            std::array::from_fn(|i| self.lights_of(block.index.as_array()[i]).choose(second.as_array()[i]));
        let size = u32x8::splat(self.block as u32);
        Choice {
            index: block.index * size + u32x8::new(std::array::from_fn(|i| each[i].index)),
            pmf: block.pmf * X8::from_fn(|i| each[i].pmf),
            u: X8::from_fn(|i| each[i].u),
        }
    }
    fn pmf(&self, light: u32) -> f32 {
        let block = light / self.block as u32;
        let within: f32 = self.lights_of(block).pmf(light % self.block as u32);
        if self.blocks.len() == 1 {
            return within;
        }
        let block: f32 = PowerLights::from_buffer(&self.blocks).pmf(block);
        block * within
    }
}

/// The lights of a scene.
#[derive(Debug)]
pub struct Lights {
    /// The lights, without those of `unpacked`.
    packed: Vec<PackedLight>,
    /// Of more than [`FEW`] lights, the ones that are shapes, which come first: their indices. They are packed when they are chosen, since
    /// a copy of each is as large as the shape.
    unpacked: Vec<u32>,
    shapes: Arc<[Shape]>,
    /// For 2 to [`FEW`] lights that all have an area.
    spatial: Option<SpatialLights>,
    powers: PowerTable,
    /// Bit k is set if there is a light of kind k.
    kinds: u32,
    sky: Option<Arc<Sky>>,
    /// Index of the light of each shape; [`NOTHING`] for shapes that are not lights.
    shape_lights: Vec<u32>,
}

/// The probabilities with which the lights are chosen at the shading points of a packet.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack, for one packet")]
pub enum LightPmf<'a> {
    /// By power.
    Power(&'a PowerTable),
    /// By what each light can contribute.
    Near(LightsAt<X8>),
    /// By an allocation of the samples.
    Allocated(&'a Allocated<'a, X8>),
}

impl LightPmf<'_> {
    /// The pmf of a light.
    #[inline]
    pub fn of(&self, light: u32) -> X8 {
        match self {
            Self::Near(near) => near.pmf_of(light),
            Self::Allocated(allocated) => allocated.pmf_of(light),
            Self::Power(table) => X8::splat(table.pmf(light)),
        }
    }
}

/// A direction to a light in each lane: the part of a [`LightSample`] that direct lighting needs.
#[derive(Clone, Copy)]
pub struct Drawn {
    /// Unit direction to the light.
    pub direction: V8,
    /// Distance to the light along it.
    pub distance: X8,
    /// Pdf per steradian, without the choice of the light; 0 where there is no sample.
    pub pdf: X8,
    /// True where the light emits towards the point.
    pub emits: M8,
    /// True where no other technique can hit the light.
    pub delta: M8,
}

impl From<LightSample<X8>> for Drawn {
    #[inline(always)]
    fn from(s: LightSample<X8>) -> Self {
        let LightSample { direction, distance, pdf, emits, delta, .. } = s;
        Self { direction, distance, pdf, emits, delta }
    }
}

/// One light in each lane.
pub struct Chosen {
    /// As in the light's record.
    place: V8,
    first: V8,
    second: V8,
    /// Radiance; intensity or irradiance for a delta light.
    pub radiance: V8,
    kind: u32x8,
    /// Index of its shape; [`NOTHING`] for a light without one.
    pub shape: u32x8,
}

/// Squared radius of a sphere around all surfaces.
fn squared_radius(scene: &Scene) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let boxes = scene.shapes.iter().map(|shape| shape.geometry.bounds());
    for [least, most] in scene.triangles.iter().flatten().map(|&p| [p, p]).chain(boxes) {
        for k in 0..3 {
            low[k] = low[k].min(f64::from(least[k]));
            high[k] = high[k].max(f64::from(most[k]));
        }
    }
    let squared: f64 = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>() / 4.0;
    if squared.is_finite() { squared } else { 1.0 }
}

fn sum(rgb: [f32; 3]) -> f64 {
    rgb.iter().map(|&x| f64::from(x)).sum()
}

/// Records and their powers, in units of π.
type Powered = Vec<(LightRecord, f64)>;

fn area_lights(scene: &Scene) -> Powered {
    (0..).zip(scene.shapes.iter()).filter_map(|(index, shape)| LightRecord::of(index, shape)).collect()
}

fn delta_lights(scene: &Scene) -> Powered {
    let light = |light: &DeltaLight| {
        let none = LightRecord { shape: NOTHING, ..LightRecord::default() };
        match *light {
            DeltaLight::Point { position: place, intensity: radiance } => {
                (LightRecord { place, radiance, kind: POINT, ..none }, 4.0 * sum(radiance))
            }
            DeltaLight::Spot { position: place, axis: first, cos_inner, cos_outer, intensity: radiance } => {
                let cone = 2.0 - f64::from(cos_inner) - f64::from(cos_outer);
                let second = [cos_inner, cos_outer, 0.0];
                // a cone too narrow for its cosine to differ from 1 still has a chance
                (LightRecord { place, first, second, radiance, kind: SPOT, ..none }, cone.max(1e-7) * sum(radiance))
            }
            DeltaLight::Distant { direction: place, irradiance: radiance } => {
                (LightRecord { place, radiance, kind: DISTANT, ..none }, sum(radiance) * squared_radius(scene))
            }
        }
    };
    scene.delta_lights.iter().map(light).collect()
}

impl Lights {
    /// All lights of a scene: emitting shapes, delta lights, the sky.
    pub fn new(scene: &Scene, sky: Option<Arc<Sky>>) -> Self {
        let mut all = area_lights(scene);
        all.extend(delta_lights(scene));
        if let Some(sky) = &sky {
            // what enters the sphere around the scene
            let record = LightRecord { kind: SKY, shape: NOTHING, ..LightRecord::default() };
            all.push((record, sky.flux() * squared_radius(scene)));
        }
        Self::of(all, &scene.shapes, sky)
    }
    /// The delta lights of a scene alone.
    pub fn deltas(scene: &Scene) -> Self {
        Self::of(delta_lights(scene), &scene.shapes, None)
    }
    fn of(all: Powered, shapes: &Arc<[Shape]>, sky: Option<Arc<Sky>>) -> Self {
        let kinds = all.iter().fold(0, |kinds, (light, _)| kinds | 1 << (light.kind & KINDS));
        let bounds = all.iter().map(|(light, power)| light.bound(*power));
        let few = kinds & !ONLY_AREAS == 0 && (2..=FEW).contains(&all.len());
        let spatial = few.then(|| SpatialLights::new(&bounds.collect::<Vec<_>>()).expect("few lights"));
        let (records, powers): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let mut shape_lights = vec![NOTHING; shapes.len()];
        for (index, record) in (0..).zip(&records) {
            if let Some(light) = shape_lights.get_mut(record.shape as usize) {
                *light = index;
            }
        }
        let is_unpacked = |record: &&LightRecord| records.len() > FEW && record.shape != NOTHING;
        let unpacked: Vec<u32> = records.iter().take_while(is_unpacked).map(|record| record.shape).collect();
        let packed = records[unpacked.len()..].iter().map(LightRecord::pack).collect();
        let shapes = Arc::clone(shapes);
        Self { powers: PowerTable::new(&powers), packed, unpacked, shapes, spatial, kinds, sky, shape_lights }
    }
    /// Number of lights.
    pub fn len(&self) -> usize {
        self.unpacked.len() + self.packed.len()
    }
    /// Is there no light at all?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// True if the choice of a light needs random numbers of its own.
    pub fn many(&self) -> bool {
        self.len() > FEW
    }
    /// True if all lights are delta lights, which need no pair for a point on the light.
    pub fn only_deltas(&self) -> bool {
        self.kinds & !ONLY_DELTAS == 0
    }
    /// The number of lights if they are few and all delta lights: then all are sampled, without random numbers.
    pub fn each(&self) -> Option<u32> {
        (self.only_deltas() && !self.many()).then(|| self.len() as u32)
    }
    /// The number of lights among which samples can be allocated: 2 to [`FEW`] that all have an area.
    pub fn few(&self) -> Option<usize> {
        self.spatial.as_ref().map(SpatialLights::len)
    }
    /// The number of lights if there are 1 to [`FEW`] and all have an area.
    pub fn areas(&self) -> Option<usize> {
        (self.kinds & !ONLY_AREAS == 0 && (1..=FEW).contains(&self.len())).then(|| self.len())
    }
    /// What each light can contribute to points of surfaces, where samples can be allocated.
    #[inline]
    pub fn contributions(&self, p: V8, normal: V8) -> Option<LightsAt<X8>> {
        self.spatial.as_ref().map(|lights| lights.at(p, normal))
    }
    /// Chooses a light for each of these points of surfaces: by contribution, or by power where lights are many, of several kinds or
    /// without area. The second number is for more lights than one table holds.
    #[inline(always)]
    pub fn choose(&self, p: V8, normal: V8, [u, second]: [X8; 2]) -> Choice<X8> {
        match &self.spatial {
            Some(lights) => lights.at(p, normal).choose(u),
            None if self.len() == 1 => Choice { index: u32x8::splat(0), pmf: X8::lit(1.0), u },
            None => self.powers.choose(u, second),
        }
    }
    /// The probabilities with which [`choose`](Self::choose) chooses at these points.
    #[inline(always)]
    pub fn pmf(&self, p: V8, normal: V8) -> LightPmf<'_> {
        self.contributions(p, normal).map_or(LightPmf::Power(&self.powers), LightPmf::Near)
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
        LightRecord::of(shape, &self.shapes[shape as usize]).map(|(record, _)| record.pack()).unwrap_or_default()
    }
    /// Samples the chosen lights from points `p` on surfaces with this normal. `emits` allows for two-sided lights. For a sky, `radiance` of
    /// `chosen` becomes that of the sampled direction.
    #[inline(always)]
    pub fn sample(&self, chosen: &mut Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        const ONLY_SPHERES: u32 = 1 << SPHERE;
        const ONLY_TRIANGLES: u32 = 1 << TRIANGLE;
        const ONLY_PARALLELOGRAMS: u32 = 1 << PARALLELOGRAM;
        let mut sample = match self.kinds {
            ONLY_SPHERES => chosen.sphere(measure, p, normal, u),
            ONLY_TRIANGLES => chosen.triangle(measure, p, normal, u),
            ONLY_PARALLELOGRAMS => chosen.parallelogram(measure, p, normal, u),
            _ => self.mixed(chosen, measure, p, normal, u),
        };
        sample.emits = sample.emits | chosen.two_sided();
        sample
    }
    /// Samples every kind of light that the scene has, each in its lanes.
    fn mixed(&self, chosen: &mut Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let mut mixed: Option<Drawn> = None;
        for kind in (SPHERE..=SKY).filter(|kind| self.kinds >> kind & 1 == 1) {
            let here = equal(chosen.kind & u32x8::splat(KINDS), u32x8::splat(kind));
            let Chosen { place, first, second, .. } = *chosen;
            let sample = match kind {
                SPHERE => chosen.sphere(measure, p, normal, u),
                TRIANGLE => chosen.triangle(measure, p, normal, u),
                PARALLELOGRAM => chosen.parallelogram(measure, p, normal, u),
                POINT => PointLight::new(place).prepare(p).sample(u).into(),
                SPOT => {
                    let light = SpotLight { position: place, axis: first, cos_inner: second.x, cos_outer: second.y };
                    light.prepare(p).sample(u).into()
                }
                DISTANT => DirectionalLight::new(place).prepare(p).sample(u).into(),
                _ => {
                    let sky = self.sky.as_ref().unwrap_or_else(|| unreachable!("a sky among the records"));
                    let (sample, radiance) = sky.sample(measure, normal, u);
                    chosen.radiance = V8::blend(here, radiance, chosen.radiance);
                    sample.into()
                }
            };
            mixed = Some(match mixed {
                None => sample,
                Some(other) => Drawn {
                    direction: V8::blend(here, sample.direction, other.direction),
                    distance: select(here, sample.distance, other.distance),
                    pdf: select(here, sample.pdf, other.pdf),
                    emits: sample.emits & here | other.emits & !here,
                    delta: sample.delta & here | other.delta & !here,
                },
            });
        }
        mixed.unwrap_or_else(|| unreachable!("there is a light"))
    }
    /// Pdf per steradian, including the pmf of the choice, with which [`sample`](Self::sample) by solid angle draws the direction `w` to a
    /// shape from `p`.
    #[inline]
    pub fn shape_pdf(&self, pmf: &LightPmf<'_>, shape: usize, geometry: &Geometry, p: V8, w: V8) -> X8 {
        let pdf = match *geometry {
            Geometry::Sphere { center, radius } => {
                Sphere::new(center.into(), X8::splat(radius)).by_solid_angle(p).pdf(w)
            }
            Geometry::Triangle([a, b, c]) => {
                // the edges as the light's record has them
                let edge = |to: [f32; 3]| V8::from(std::array::from_fn(|k| to[k] - a[k]));
                Triangle { v0: a.into(), e1: edge(b), e2: edge(c) }.by_solid_angle(p).pdf(w)
            }
            Geometry::Parallelogram { p: corner, u, v } => {
                Parallelogram::new(corner.into(), u.into(), v.into()).by_solid_angle(p).pdf(w)
            }
        };
        pdf * pmf.of(self.shape_lights[shape])
    }
    /// The same for a direction to the sky, which is the last of the lights.
    #[inline]
    pub fn sky_pdf(&self, pmf: &LightPmf<'_>, normal: V8, w: V8) -> X8 {
        match &self.sky {
            Some(sky) => sky.pdf(Measure::SolidAngle, normal, w) * pmf.of(self.len() as u32 - 1),
            None => X8::lit(0.0),
        }
    }
}

/// Not inlined, so that its registers do not burden the cheaper measures.
#[inline(never)]
fn projected(sample: impl Fn() -> Drawn) -> Drawn {
    sample()
}

impl Chosen {
    /// From the two halves of the records, one light per lane.
    #[inline(always)]
    fn new([a, b]: [[X8; 8]; 2]) -> Self {
        Self {
            place: V8::new(a[0], a[1], a[2]),
            first: V8::new(a[3], a[4], a[5]),
            second: V8::new(a[6], a[7], b[0]),
            radiance: V8::new(b[1], b[2], b[3]),
            kind: b[4].to_bits(),
            shape: b[5].to_bits(),
        }
    }
    #[inline]
    fn sphere(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let light = Sphere { center: self.place, radius: self.first.x };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => light.by_projected_solid_angle(p, normal).sample(u).into(),
        }
    }
    #[inline]
    fn triangle(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let light = Triangle { v0: self.place, e1: self.first, e2: self.second };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn parallelogram(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let light = Parallelogram { p: self.place, u: self.first, v: self.second };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn two_sided(&self) -> M8 {
        !equal(self.kind & u32x8::splat(TWO_SIDED), u32x8::splat(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue::Uint;
    use etendue::sequence::{Independent, Sequence};

    /// A table of one block and one of many, with lights of very different power: the pmf sums to 1, a choice has the pmf of its light, and
    /// lights are chosen as often as their pmf says, also the weakest together.
    #[test]
    fn lights_of_any_power_are_chosen() {
        for count in [1_usize, 7, PowerLights::MOST, PowerLights::MOST + 1, 40_000] {
            let powers: Vec<f64> = (0..count).map(|i| [1.0, 1e-3, 1e-9, 0.0, 50.0][i * 7 % 5]).collect();
            let table = PowerTable::new(&powers);
            assert_eq!(table.blocks.len() > 1, count > PowerLights::MOST);
            let pmf: Vec<f64> = (0..count as u32).map(|i| f64::from(table.pmf(i))).collect();
            assert!((pmf.iter().sum::<f64>() - 1.0).abs() < 1e-4, "{count}: {}", pmf.iter().sum::<f64>());
            assert!(powers.iter().zip(&pmf).all(|(power, pmf)| (*power > 0.0) == (*pmf > 0.0)));
            let (mut weak, draws) = (0.0, 1 << 20);
            for i in (0..draws).step_by(8) {
                let lanes = u32x8::from_fn(|k| i + k as u32);
                let u: Vec2<X8> = Independent::new(5).pair(u32x8::splat(0), lanes, 0);
                let choice = table.choose(u.x, u.y);
                for lane in 0..8 {
                    let light = choice.index.lane(lane);
                    assert_eq!(choice.pmf.lane(lane), table.pmf(light), "light {light} of {count}");
                    weak += f64::from(u8::from(powers[light as usize] < 0.5));
                }
            }
            let expected: f64 = powers.iter().zip(&pmf).filter(|(power, _)| **power < 0.5).map(|(_, pmf)| pmf).sum();
            let deviation = (expected * (1.0 - expected) / f64::from(draws)).sqrt();
            assert!(
                (weak / f64::from(draws) - expected).abs() <= 5.0 * deviation,
                "{count}: {weak} of {draws}, {expected}"
            );
        }
    }
}
