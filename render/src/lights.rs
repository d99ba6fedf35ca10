//! The lights of a scene: packets choose one per lane, and sample it.

use crate::bvh::NOTHING;
use crate::packet::{M8, V8, X8, select};
use crate::scene::{DeltaLight, Geometry, Scene};
use crate::sky::Sky;
use crate::technique::Measure;
use etendue::{
    DirectionalLight, LightSample, LightSampler, Parallelogram, PointLight, Real, Sphere, SpotLight, Triangle, Vec2,
    Vec3, u32x8,
};
use std::sync::Arc;

const SPHERE: u32 = 0;
const TRIANGLE: u32 = 1;
const PARALLELOGRAM: u32 = 2;
const POINT: u32 = 3;
const SPOT: u32 = 4;
const DISTANT: u32 = 5;
const SKY: u32 = 6;
const KINDS: u32 = 7;
const TWO_SIDED: u32 = 8;
/// The largest number of lights among which a packet chooses by comparing with all of them. The choice leaves enough digits of `u` for a
/// point on the light.
pub const FEW: usize = 32;

/// Sixteen numbers per light, so that two transpositions gather eight lanes: geometry (9), radiance (3), pmf, start of its interval of u,
/// kind and sides (bits), index of its shape (bits).
type Record = [f32; 16];

/// What the choice of a light needs of it: bounds of what it can contribute to a point.
#[derive(Clone, Copy, Debug)]
struct Reach {
    center: [f32; 3],
    /// Radius of a sphere around the light, in scene units.
    radius: f32,
    /// Unit normal of a flat light; 0 for a sphere.
    normal: [f32; 3],
    /// 1/4 for a sphere, whose area is four times its cross section; 0 for a flat light.
    round: f32,
    /// True for a flat light that emits from both sides.
    two_sided: bool,
    /// Power of one side, in units of π.
    power: f32,
}

/// The lights of a scene, chosen in proportion to their power or to what they can contribute to a point.
#[derive(Debug)]
pub struct Lights {
    records: Vec<Record>,
    /// One per light if there are 2 to [`FEW`] lights and all have an area; otherwise empty.
    reaches: Vec<Reach>,
    /// Upper ends of the intervals of `u`; the last is 1.
    ends: Vec<f32>,
    /// Bit k is set if there is a light of kind k.
    kinds: u32,
    sky: Option<Arc<Sky>>,
    /// Pmf of each shape of the scene; 0 for shapes that are not lights.
    shape_probabilities: Vec<f32>,
    /// Index of the light of each shape.
    shape_lights: Vec<u32>,
    sky_probability: f32,
}

/// What each light can contribute to the points of a packet: power · cosθ cosθ' / d² for its centre. cosθ is that of the direction within
/// the light's bounding sphere that is nearest to the normal, and d is at least the radius of the sphere. It is 0 only where the light is
/// below the horizon or faces away.
pub struct Near {
    /// Sums of the contributions up to and including each light.
    ends: [X8; FEW],
}

impl Near {
    /// The contribution of each light.
    pub fn parts(&self, lights: usize) -> impl Iterator<Item = X8> {
        (0..lights).map(|k| if k == 0 { self.ends[0] } else { self.ends[k] - self.ends[k - 1] })
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
    geometry: [X8; 9],
    /// Radiance; intensity or irradiance for a delta light.
    pub radiance: V8,
    /// Probability with which it was chosen.
    pub pmf: X8,
    /// Start of its interval of `u`, where the choice is by power.
    start: X8,
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

impl Lights {
    /// All lights of a scene: emitting shapes, delta lights, the sky.
    pub fn new(scene: &Scene, sky: Option<Arc<Sky>>) -> Self {
        let mut table = Table::default();
        for (index, shape) in scene.shapes.iter().enumerate() {
            let Some(emission) = shape.emission else { continue };
            let mut geometry = [0.0; 9];
            let kind = match shape.geometry {
                Geometry::Sphere { center, radius } => {
                    geometry[..3].copy_from_slice(&center);
                    geometry[3] = radius;
                    SPHERE
                }
                Geometry::Triangle([a, b, c]) => {
                    geometry[..3].copy_from_slice(&a);
                    for k in 0..3 {
                        (geometry[3 + k], geometry[6 + k]) = (b[k] - a[k], c[k] - a[k]);
                    }
                    TRIANGLE
                }
                Geometry::Parallelogram { p, u, v } => {
                    geometry.copy_from_slice([p, u, v].as_flattened());
                    PARALLELOGRAM
                }
            };
            let sides = if emission.two_sided { 2.0 } else { 1.0 };
            let power = sum(emission.radiance) * shape.geometry.area() * sides;
            let kind = kind | if emission.two_sided { TWO_SIDED } else { 0 };
            table.push(geometry, emission.radiance, kind, index as u32, power);
        }
        table.deltas(scene);
        if let Some(sky) = &sky {
            // what enters the sphere around the scene
            table.push([0.0; 9], [0.0; 3], SKY, NOTHING, sky.flux() * squared_radius(scene));
        }
        table.finish(scene.shapes.len(), sky)
    }
    /// The delta lights of a scene alone.
    pub fn deltas(scene: &Scene) -> Self {
        let mut table = Table::default();
        table.deltas(scene);
        table.finish(scene.shapes.len(), None)
    }
    /// Number of lights.
    pub fn len(&self) -> usize {
        self.records.len()
    }
    /// Is there no light at all?
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }
    /// True if the choice of a light needs a random number of its own.
    pub fn many(&self) -> bool {
        self.len() > FEW
    }
    /// True if all lights are delta lights, which need no pair for a point on the light.
    pub fn only_deltas(&self) -> bool {
        self.kinds & !(1 << POINT | 1 << SPOT | 1 << DISTANT) == 0
    }
    /// The number of lights if they are few and all delta lights: then all are sampled, without random numbers.
    pub fn each(&self) -> Option<usize> {
        (self.only_deltas() && !self.many()).then(|| self.len())
    }
    /// The same light in every lane, with pmf 1.
    pub fn one(&self, index: usize) -> Chosen {
        Chosen { pmf: X8::lit(1.0), ..Chosen::new(self.records[index].map(X8::splat)) }
    }
    /// Chooses a light per lane by power, and returns what is left of `u`, uniform in [0, 1).
    #[inline(always)]
    pub fn choose(&self, u: X8) -> (Chosen, X8) {
        if let [record] = &self.records[..] {
            return (Chosen::new(record.map(X8::splat)), u);
        }
        let index: [usize; 8] = if self.many() {
            u.to_array().map(|u| self.ends.partition_point(|&end| end <= u).min(self.ends.len() - 1))
        } else {
            let one = X8::lit(1.0);
            let passed = self.ends[..self.ends.len() - 1]
                .iter()
                .fold(X8::lit(0.0), |sum, &end| sum + one.keep(u.ge(X8::splat(end))));
            passed.to_uint().to_array().map(|i| i as usize)
        };
        let chosen = self.gathered(index);
        let rest = Real::clamped((u - chosen.start) / chosen.pmf, X8::lit(0.0), X8::ONE_MINUS_EPSILON);
        (chosen, rest)
    }
    /// What each light can contribute to points of a surface; `None` where the choice is by power.
    #[inline(always)]
    pub fn near(&self, p: V8, normal: V8) -> Option<Near> {
        if self.reaches.is_empty() {
            return None;
        }
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let mut ends = [zero; FEW];
        let mut sum = zero;
        for (reach, end) in self.reaches.iter().zip(&mut ends) {
            let to = V8::from(reach.center) - p;
            let radius = X8::splat(reach.radius);
            let inverse = one / X8::max(to.length_squared(), radius * radius).sqrt();
            let cos = X8::min(X8::max((to.dot(normal) + radius) * inverse, zero), one);
            let facing = -to.dot(V8::from(reach.normal)) * inverse;
            let facing = X8::max(if reach.two_sided { facing.abs() } else { facing }, zero) + X8::splat(reach.round);
            sum += cos * facing * (X8::splat(reach.power) * inverse * inverse);
            *end = sum;
        }
        Some(Near { ends })
    }
    /// The number of lights if there are 2 to [`FEW`] and all have an area.
    pub fn few(&self) -> Option<usize> {
        (!self.reaches.is_empty()).then_some(self.reaches.len())
    }
    /// The light that is allocated to each lane, with its share of the samples.
    #[inline(always)]
    pub fn allocated(&self, light: u32x8, share: X8) -> Chosen {
        Chosen { pmf: share, ..self.gathered(light.to_array().map(|i| i as usize)) }
    }
    /// Chooses a light per lane by `u`, and returns what is left of `u`: by contribution, or by power if `near` is `None`.
    #[inline(always)]
    pub fn choose_near(&self, near: Option<&Near>, u: X8) -> (Chosen, X8) {
        let Some(Near { ends }) = near else { return self.choose(u) };
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let last = self.reaches.len() - 1;
        let sum = ends[last];
        let target = u * sum;
        let (mut index, mut start, mut end) = (zero, zero, ends[0]);
        for k in 0..last {
            let passed = target.ge(ends[k]);
            index += one.keep(passed);
            start = select(passed, ends[k], start);
            end = select(passed, ends[k + 1], end);
        }
        let mut chosen = self.gathered(index.to_uint().to_array().map(|i| i as usize));
        let width = end - start;
        let some = width.gt(zero);
        chosen.pmf = (width / select(some, sum, one)).keep(some);
        let rest = Real::clamped((target - start) / select(some, width, one), zero, X8::ONE_MINUS_EPSILON);
        (chosen, rest)
    }
    #[inline(always)]
    fn gathered(&self, index: [usize; 8]) -> Chosen {
        let rows = index.map(|i| &self.records[i]);
        let half = |start: usize| X8::transpose(rows.map(|r| X8::from(&r[start..start + 8])));
        let (a, b) = (half(0), half(8));
        let mut chosen = Chosen::new(std::array::from_fn(|k| if k < 8 { a[k] } else { b[k - 8] }));
        chosen.start = b[5];
        chosen
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
            let here = crate::packet::equal(chosen.kind & u32x8::splat(KINDS), u32x8::splat(kind));
            let [a, b, c] = chosen.vectors();
            let sample = match kind {
                SPHERE => chosen.sphere(measure, p, normal, u),
                TRIANGLE => chosen.triangle(measure, p, normal, u),
                PARALLELOGRAM => chosen.parallelogram(measure, p, normal, u),
                POINT => PointLight::new(a).prepare(p).sample(u).into(),
                SPOT => SpotLight { position: a, axis: b, cos_inner: c.x, cos_outer: c.y }.prepare(p).sample(u).into(),
                DISTANT => DirectionalLight::new(a).prepare(p).sample(u).into(),
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
    pub fn shape_pdf(&self, near: Option<&Near>, shape: usize, geometry: &Geometry, p: V8, w: V8) -> X8 {
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
        pdf * match near {
            None => X8::splat(self.shape_probabilities[shape]),
            Some(Near { ends }) => {
                let (zero, sum) = (X8::lit(0.0), ends[self.reaches.len() - 1]);
                let light = self.shape_lights[shape] as usize;
                let before = if light == 0 { zero } else { ends[light - 1] };
                (ends[light] - before) / select(sum.gt(zero), sum, X8::lit(1.0))
            }
        }
    }
    /// The same for a direction to the sky.
    #[inline]
    pub fn sky_pdf(&self, normal: V8, w: V8) -> X8 {
        match &self.sky {
            Some(sky) => sky.pdf(Measure::SolidAngle, normal, w) * X8::splat(self.sky_probability),
            None => X8::lit(0.0),
        }
    }
}

/// Records and powers on their way to [`Lights`].
#[derive(Default)]
struct Table {
    records: Vec<Record>,
    powers: Vec<f64>,
    kinds: u32,
}

impl Table {
    /// Adds a light; powers are all in units of π.
    fn push(&mut self, geometry: [f32; 9], radiance: [f32; 3], kind: u32, shape: u32, power: f64) {
        let mut record = [0.0; 16];
        record[..9].copy_from_slice(&geometry);
        record[9..12].copy_from_slice(&radiance);
        (record[14], record[15]) = (f32::from_bits(kind), f32::from_bits(shape));
        self.kinds |= 1 << (kind & KINDS);
        self.records.push(record);
        self.powers.push(power);
    }
    fn deltas(&mut self, scene: &Scene) {
        for light in &scene.delta_lights {
            let mut geometry = [0.0; 9];
            match *light {
                DeltaLight::Point { position, intensity } => {
                    geometry[..3].copy_from_slice(&position);
                    self.push(geometry, intensity, POINT, NOTHING, 4.0 * sum(intensity));
                }
                DeltaLight::Spot { position, axis, cos_inner, cos_outer, intensity } => {
                    geometry[..6].copy_from_slice([position, axis].as_flattened());
                    (geometry[6], geometry[7]) = (cos_inner, cos_outer);
                    let cone = 2.0 - f64::from(cos_inner) - f64::from(cos_outer);
                    // a cone too narrow for its cosine to differ from 1 still has a chance
                    self.push(geometry, intensity, SPOT, NOTHING, cone.max(1e-7) * sum(intensity));
                }
                DeltaLight::Distant { direction, irradiance } => {
                    geometry[..3].copy_from_slice(&direction);
                    self.push(geometry, irradiance, DISTANT, NOTHING, sum(irradiance) * squared_radius(scene));
                }
            }
        }
    }
    fn finish(mut self, shapes: usize, sky: Option<Arc<Sky>>) -> Lights {
        let total: f64 = self.powers.iter().sum();
        let mut sum = 0.0;
        let mut ends = Vec::with_capacity(self.records.len());
        for (record, power) in self.records.iter_mut().zip(&self.powers) {
            let start = (sum / total) as f32;
            sum += power;
            let end = (sum / total) as f32;
            (record[12], record[13]) = (end - start, start);
            ends.push(end);
        }
        if let (Some(last), Some(end)) = (self.records.last_mut(), ends.last_mut()) {
            *end = 1.0;
            last[12] = 1.0 - last[13];
        }
        let mut shape_probabilities = vec![0.0; shapes];
        let mut shape_lights = vec![0; shapes];
        let mut sky_probability = 0.0;
        for (index, record) in (0..).zip(&self.records) {
            match (record[14].to_bits() & KINDS, record[15].to_bits()) {
                (SKY, _) => sky_probability = record[12],
                (_, NOTHING) => {}
                (_, shape) => {
                    shape_probabilities[shape as usize] = record[12];
                    shape_lights[shape as usize] = index;
                }
            }
        }
        let only_areas = self.kinds & !(1 << SPHERE | 1 << TRIANGLE | 1 << PARALLELOGRAM) == 0;
        let few = only_areas && (2..=FEW).contains(&self.records.len());
        let reaches = if few { self.records.iter().zip(&self.powers).map(reach).collect() } else { Vec::new() };
        Lights {
            reaches,
            records: self.records,
            ends,
            kinds: self.kinds,
            sky,
            shape_probabilities,
            shape_lights,
            sky_probability,
        }
    }
}

/// Bounds of a light with an area.
fn reach((record, power): (&Record, &f64)) -> Reach {
    let vector = |k: usize| -> Vec3<f64> { std::array::from_fn(|i| f64::from(record[k + i])).into() };
    let kind = record[14].to_bits();
    let (p, u, v) = (vector(0), vector(3), vector(6));
    let (center, radius, normal) = match kind & KINDS {
        SPHERE => (p, f64::from(record[3]), Vec3::default()),
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
    Reach {
        center: narrow(center),
        // the rounding of the centre moves the sphere by less than this
        radius: (radius * (1.0 + 1e-6)) as f32,
        normal: narrow(if length > 0.0 { normal * (1.0 / length) } else { normal }),
        round: if length > 0.0 { 0.0 } else { 0.25 },
        two_sided: kind & TWO_SIDED != 0 && length > 0.0,
        power: *power as f32 * if kind & TWO_SIDED != 0 { 0.5 } else { 1.0 },
    }
}

/// Not inlined, so that its registers do not burden the cheaper measures.
#[inline(never)]
fn projected(sample: impl Fn() -> Drawn) -> Drawn {
    sample()
}

impl Chosen {
    #[inline(always)]
    fn new(r: [X8; 16]) -> Self {
        Self {
            geometry: std::array::from_fn(|k| r[k]),
            radiance: V8::new(r[9], r[10], r[11]),
            pmf: r[12],
            start: r[13],
            kind: r[14].to_bits(),
            shape: r[15].to_bits(),
        }
    }
    #[inline(always)]
    fn vectors(&self) -> [V8; 3] {
        let [a, b, c, d, e, f, g, h, i] = self.geometry;
        [V8::new(a, b, c), V8::new(d, e, f), V8::new(g, h, i)]
    }
    #[inline]
    fn sphere(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let [center, b, _] = self.vectors();
        let light = Sphere { center, radius: b.x };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => light.by_projected_solid_angle(p, normal).sample(u).into(),
        }
    }
    #[inline]
    fn triangle(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let [v0, e1, e2] = self.vectors();
        let light = Triangle { v0, e1, e2 };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn parallelogram(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> Drawn {
        let [corner, u_edge, v_edge] = self.vectors();
        let light = Parallelogram { p: corner, u: u_edge, v: v_edge };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn two_sided(&self) -> M8 {
        !crate::packet::equal(self.kind & u32x8::splat(TWO_SIDED), u32x8::splat(0))
    }
}
