//! Sets of lights, and points among them, at which a bound or a choice may fail.

use super::{Lamp, PointAndNormal};
use crate::area_lights::LightShape;
use crate::random::Random;
use core::f64::consts::TAU;
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};

macro_rules! regimes {
    ($($name:ident)+) => {
        /// How lights are placed.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "the names say it")]
        pub enum Regime {
            $($name),+
        }
        impl Regime {
            /// All regimes.
            pub const ALL: [Self; [$(stringify!($name)),+].len()] = [$(Self::$name),+];
        }
    };
}
regimes! {
    Room Tiny Huge OnePoint Line Plane Lattice SphereOutwards Powers Malformed Points Spots NarrowSpots TwoSided OneSided Spheres
    Slivers Shells Clusters SmallAndFar Spreads
}

impl Regime {
    /// What a light of a tree may be.
    pub(crate) const SHAPES: [LightShape; 7] = [
        LightShape::Triangle,
        LightShape::Parallelogram,
        LightShape::Disk,
        LightShape::Sphere,
        LightShape::PointLight,
        LightShape::SpotLight,
        LightShape::Line,
    ];

    /// The unit of lengths.
    #[must_use]
    pub fn unit(self) -> f64 {
        match self {
            Self::Tiny => libm::exp2(-60.0),
            Self::Huge => libm::exp2(60.0),
            _ => 1.0,
        }
    }
    fn kind(self, random: &mut Random) -> LightShape {
        let among = match self {
            Self::SphereOutwards | Self::Plane | Self::TwoSided | Self::OneSided | Self::Slivers | Self::Spreads => {
                0..3
            }
            Self::Spheres => 3..4,
            Self::Points => 4..5,
            Self::Spots | Self::NarrowSpots => 5..6,
            _ => 0..Self::SHAPES.len(),
        };
        Self::SHAPES[among.start + random.below(among.len())]
    }

    /// Lights of this regime.
    #[must_use]
    pub fn lamps(self, count: usize, random: &mut Random) -> Vec<Lamp> {
        let axis = random.direction();
        let (s, t) = basis(axis);
        let at: V3 = core::array::from_fn(|_| random.range(-1.0, 1.0));
        let clusters: [V3; 4] = core::array::from_fn(|_| core::array::from_fn(|_| random.range(-1.0, 1.0)));
        let lamp = |i: usize| {
            let kind = self.kind(random);
            let mut size = random.magnitude(0.02, 0.3);
            let mut normal = random.direction();
            let near = if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
            let center = match self {
                Self::OnePoint => at,
                Self::Line => along(at, axis, random.range(-1.0, 1.0)),
                Self::Plane => {
                    normal = axis.map(|x| x * near);
                    along(along(at, s, random.range(-1.0, 1.0)), t, random.range(-1.0, 1.0))
                }
                Self::Lattice => core::array::from_fn(|k| (i >> (2 * k) & 3) as f64 * 0.5),
                Self::SphereOutwards => normal,
                Self::Shells => {
                    let radius = libm::exp2(-0.02 * i as f64).max(1e-12);
                    size *= radius;
                    random.direction().map(|x| x * radius)
                }
                Self::Clusters => along(clusters[i % 4], random.direction(), 0.1 * random.unit_f64()),
                _ => core::array::from_fn(|_| random.range(-1.0, 1.0)),
            };
            match self {
                Self::SphereOutwards => size = size.min(0.05),
                // the centre of a light is then rounded by more than its radius
                Self::SmallAndFar => size = random.magnitude(1e-8, 1e-3),
                _ => {}
            }
            let power = match self {
                Self::Powers => random.magnitude(1e-30, 1e30),
                Self::Malformed => [0.0, f64::NAN, -1.0, f64::INFINITY, 1.0, 3.0, 1e-45, 1e38][random.below(8)],
                Self::Room => random.magnitude(1e-3, 1e3),
                _ => 1.0,
            };
            let two_sided = match self {
                Self::TwoSided => true,
                Self::OneSided | Self::SphereOutwards => false,
                _ => random.word().is_multiple_of(4),
            };
            let cosine = match self {
                Self::NarrowSpots => 1.0 - random.magnitude(1e-5, 1e-2),
                _ => random.range(0.1, 0.99),
            };
            let slim = if self == Self::Slivers { random.magnitude(1e-4, 1.0) } else { 1.0 };
            let spread = if self == Self::Spreads { random.magnitude(0.02, 3.1) } else { 0.0 };
            let lamp = about(kind, [center, normal], size, slim, cosine, random).scaled(self.unit() as f32);
            Lamp { power: power as f32, two_sided, spread: spread as f32, ..lamp }
        };
        (0..count).map(lamp).collect()
    }
}

/// A light about a centre.
fn about(shape: LightShape, [center, normal]: [V3; 2], size: f64, slim: f64, cosine: f64, random: &mut Random) -> Lamp {
    let (s, t) = basis(normal);
    let turn = random.range(0.0, TAU);
    let mix = |turn: f64, size: f64| along(s.map(|x| x * libm::cos(turn) * size), t, libm::sin(turn) * size);
    let (e, f) = (mix(turn, size), mix(turn + random.range(0.5, 2.5), size * slim));
    let third = along(along(center, e, -1.0 / 3.0), f, -1.0 / 3.0);
    let corner = along(along(center, e, -0.5), f, -0.5);
    let (a, b, c) = match shape {
        LightShape::Triangle => (third, e, f),
        LightShape::Parallelogram => (corner, e, f),
        LightShape::Line => (along(center, e, -0.5), e, f),
        LightShape::SpotLight => (center, normal, [cosine + (1.0 - cosine) * random.unit_f64(), cosine, 0.0]),
        _ => (center, normal, f),
    };
    let radius =
        if shape == LightShape::PointLight || shape == LightShape::SpotLight { 0.0 } else { (0.5 * size) as f32 };
    Lamp { shape, a: narrow(a), b: narrow(b), c: narrow(c), radius, two_sided: false, spread: 0.0, power: 1.0 }
}

/// A point of a surface that a light, or its plane or its corner, makes difficult, and the index of that light.
pub fn place(regime: Regime, lamps: &[Lamp], random: &mut Random) -> (PointAndNormal, usize) {
    let unit_length = regime.unit();
    let light = random.below(lamps.len());
    let lamp = lamps[light];
    let bound = lamp.bound();
    let (center, normal, size) = (wide(bound.center), wide(bound.normal), f64::from(bound.radius));
    let size = if size > 0.0 { size } else { 1e-3 * unit_length };
    let direction = random.direction();
    let within = unit(cross(normal, direction));
    let any = |random: &mut Random| core::array::from_fn(|_| unit_length * random.range(-1.5, 1.5));
    let corner = match random.word() % 3 {
        0 => wide(lamp.a),
        1 if lamp.shape != LightShape::SpotLight => along(wide(lamp.a), wide(lamp.b), 1.0),
        _ => center,
    };
    let p = match random.word() % 11 {
        0 => center,
        1 => corner,
        2 => along(center, within, size * random.magnitude(1e-2, 1e3)),
        3 => {
            let beside = along(center, within, size * random.magnitude(0.01, 10.0));
            along(beside, normal, size * random.range(-1.0, 1.0) * random.magnitude(1e-7, 1.0))
        }
        4 => along(center, direction, size * random.magnitude(0.1, 1e3)),
        5 => along(center, direction, unit_length * random.magnitude(1e2, 1e12)),
        6 => direction.map(|x| x * 1e30),
        7 => along(center, normal, size * random.magnitude(0.1, 1e4)),
        8 if lamp.shape == LightShape::SpotLight => {
            // at the edge of the cone
            let cos = f64::from(bound.cos_cone) * (1.0 + random.range(-1.0, 1.0) * random.magnitude(1e-8, 1e-3));
            let way = along(normal.map(|x| x * cos), within, (1.0 - cos * cos).max(0.0).sqrt());
            along(center, way, size * random.magnitude(0.1, 1e4))
        }
        _ => any(random),
    };
    let to = sub(corner, p);
    let tilt = |toward: V3, by: f64| {
        // perpendicular to the way there, but for a tilt
        let flat = along(direction, toward, -dot(direction, toward));
        unit(along(flat, toward, by))
    };
    let n = match random.word() % 8 {
        0 if length(to) > 0.0 => tilt(unit(to), 0.0),
        1 if length(to) > 0.0 => tilt(unit(to), random.range(-1.0, 1.0) * random.magnitude(1e-8, 1e-1)),
        2 if length(to) > 0.0 => unit(to),
        3 if length(to) > 0.0 => {
            let tangent = (size / length(to)).min(1.0);
            tilt(unit(to), random.range(-2.0, 2.0) * tangent)
        }
        4 if length(normal) > 0.0 => normal,
        5 if length(normal) > 0.0 => normal.map(|x| -x),
        _ => {
            let mut n = random.direction();
            if random.word().is_multiple_of(4) {
                n = [0.0, 0.0, 1.0];
            }
            n
        }
    };
    let n = if length(n) > 0.0 { n } else { [0.0, 0.0, 1.0] };
    ((narrow(p), narrow(unit(n))), light)
}
