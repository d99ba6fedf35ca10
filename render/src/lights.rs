//! The emitters of a scene as a table from which packets draw: which light, and where on it.

use crate::accel::{M8, V8, X8, select};
use crate::scene::{Geometry, Scene};
use etendue::{LightSample, Parallelogram, Real, Sphere, Triangle, Vec2, Vec3, u32x8};

/// How a light is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Technique {
    /// Directions uniform over the hemisphere; lights are found by chance
    UniformHemisphere,
    /// Directions in proportion to the cosine; lights are found by chance
    CosineHemisphere,
    /// Points uniform over a light's area
    Area,
    /// Directions uniform over the solid angle of a light
    SolidAngle,
}

const SPHERE: u32 = 0;
const TRIANGLE: u32 = 1;
const PARALLELOGRAM: u32 = 2;
const TWO_SIDED: u32 = 4;
/// Up to here a light is found by comparing with all; and choosing one leaves enough digits of `u` to choose a point with.
const FEW: usize = 32;

/// Sixteen numbers a light, so that eight lanes are gathered by two transpositions: geometry (9), radiance (3), probability, the start of
/// its interval of u, kind and sides (bits), index of its shape (bits).
type Record = [f32; 16];

/// All emitters, chosen in proportion to their power.
#[derive(Debug)]
pub struct Lights {
    records: Vec<Record>,
    /// Upper ends of the intervals of `u`; the last is 1.
    ends: Vec<f32>,
    kinds: [bool; 3],
}

/// One light in each lane.
pub struct Chosen {
    geometry: [X8; 9],
    /// Radiance.
    pub radiance: V8,
    /// Probability with which it was chosen.
    pub probability: X8,
    kind: u32x8,
    /// Index of its shape.
    pub shape: u32x8,
}

fn area(geometry: &Geometry) -> f64 {
    let cross = |a: [f32; 3], b: [f32; 3], o: [f32; 3]| {
        let edge = |p: [f32; 3]| Vec3::<f64>::from(std::array::from_fn(|k| f64::from(p[k]) - f64::from(o[k])));
        edge(a).cross(edge(b)).length()
    };
    match *geometry {
        Geometry::Sphere { radius, .. } => 4.0 * std::f64::consts::PI * f64::from(radius).powi(2),
        Geometry::Triangle([a, b, c]) => 0.5 * cross(b, c, a),
        Geometry::Parallelogram { u, v, .. } => cross(u, v, [0.0; 3]),
    }
}

impl Lights {
    /// The emitting shapes of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut records = Vec::new();
        let mut powers = Vec::new();
        let mut kinds = [false; 3];
        for (index, shape) in scene.shapes.iter().enumerate() {
            let Some(emission) = shape.emission else { continue };
            let mut record = [0.0; 16];
            let kind = match shape.geometry {
                Geometry::Sphere { center, radius } => {
                    record[..3].copy_from_slice(&center);
                    record[3] = radius;
                    SPHERE
                }
                Geometry::Triangle([a, b, c]) => {
                    record[..3].copy_from_slice(&a);
                    for k in 0..3 {
                        (record[3 + k], record[6 + k]) = (b[k] - a[k], c[k] - a[k]);
                    }
                    TRIANGLE
                }
                Geometry::Parallelogram { p, u, v } => {
                    record[..9].copy_from_slice([p, u, v].as_flattened());
                    PARALLELOGRAM
                }
            };
            kinds[kind as usize] = true;
            record[9..12].copy_from_slice(&emission.radiance);
            record[14] = f32::from_bits(kind | if emission.two_sided { TWO_SIDED } else { 0 });
            record[15] = f32::from_bits(index as u32);
            records.push(record);
            let sides = if emission.two_sided { 2.0 } else { 1.0 };
            powers.push(emission.radiance.iter().map(|&x| f64::from(x)).sum::<f64>() * area(&shape.geometry) * sides);
        }
        let total: f64 = powers.iter().sum();
        let mut sum = 0.0;
        let mut ends = Vec::with_capacity(records.len());
        for (record, power) in records.iter_mut().zip(&powers) {
            let start = (sum / total) as f32;
            sum += power;
            let end = (sum / total) as f32;
            (record[12], record[13]) = (end - start, start);
            ends.push(end);
        }
        if let (Some(last), Some(end)) = (records.last_mut(), ends.last_mut()) {
            *end = 1.0;
            last[12] = 1.0 - last[13];
        }
        Self { records, ends, kinds }
    }
    /// Number of lights.
    pub fn len(&self) -> usize {
        self.records.len()
    }
    /// Is there no light at all?
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }
    /// Does the choice of a light need a random number of its own?
    pub fn many(&self) -> bool {
        self.len() > FEW
    }
    /// A light per lane for `u`, and `u` stretched over what its interval leaves.
    #[inline]
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
        let rows = index.map(|i| &self.records[i]);
        let half = |start: usize| X8::transpose(rows.map(|r| X8::from(&r[start..start + 8])));
        let (a, b) = (half(0), half(8));
        let chosen = Chosen::new(std::array::from_fn(|k| if k < 8 { a[k] } else { b[k - 8] }));
        let rest = Real::clamp((u - b[5]) / chosen.probability, X8::lit(0.0), X8::below_one());
        (chosen, rest)
    }
    /// A sample of the chosen lights from points `p`; `emits` already takes account of lights with two sides.
    #[inline]
    pub fn sample(&self, chosen: &Chosen, by_area: bool, p: V8, u: Vec2<X8>) -> LightSample<X8> {
        let [a, b, c] = [0, 3, 6].map(|k| V8::new(chosen.geometry[k], chosen.geometry[k + 1], chosen.geometry[k + 2]));
        let sphere = || {
            let light = Sphere { center: a, radius: b.x };
            if by_area { light.by_area(p, u) } else { light.by_solid_angle(p, u) }
        };
        let triangle = || {
            let light = Triangle { v0: a, e1: b, e2: c };
            if by_area { light.by_area(p, u) } else { light.by_solid_angle(p, u) }
        };
        let parallelogram = || {
            let light = Parallelogram { p: a, u: b, v: c };
            if by_area { light.by_area(p, u) } else { light.by_solid_angle(p, u) }
        };
        let mut sample = match self.kinds {
            [true, false, false] => sphere(),
            [false, true, false] => triangle(),
            [false, false, true] => parallelogram(),
            _ => {
                let mut sample = sphere();
                for (kind, other) in [(TRIANGLE, triangle()), (PARALLELOGRAM, parallelogram())] {
                    let here = crate::accel::equal(chosen.kind & u32x8::splat(3), u32x8::splat(kind));
                    sample.direction = V8::select(here, other.direction, sample.direction);
                    sample.distance = select(here, other.distance, sample.distance);
                    sample.pdf = select(here, other.pdf, sample.pdf);
                    sample.emits = sample.emits & !here | other.emits & here;
                }
                sample
            }
        };
        sample.emits = sample.emits | chosen.two_sided();
        sample
    }
}

impl Chosen {
    #[inline]
    fn new(r: [X8; 16]) -> Self {
        Self {
            geometry: std::array::from_fn(|k| r[k]),
            radiance: V8::new(r[9], r[10], r[11]),
            probability: r[12],
            kind: r[14].to_bits(),
            shape: r[15].to_bits(),
        }
    }
    #[inline]
    fn two_sided(&self) -> M8 {
        !crate::accel::equal(self.kind & u32x8::splat(TWO_SIDED), u32x8::splat(0))
    }
}
