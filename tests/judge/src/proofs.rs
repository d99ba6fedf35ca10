//! Judges proofs of visibility against an oracle: what they say of a light behind occluders, for all points of a patch of a floor, and the
//! irradiance of these points with its error.

use crate::lights::measured::{Figure, Measured};
use crate::lights::scene::Axis;
use crate::lights::verdict::{Case, Finding, Judgement};
use crate::random::Random;
use etendue::Vec3;
use etendue_oracle::visible::{Shape, spared, visible};
use etendue_oracle::{V3, along, sub};
use etendue_visible::{ENDS, Light, Occluder, Patch, Proof, Solid};
use std::time::Instant;

/// The normal of the floor.
const UP: V3 = [0.0, 1.0, 0.0];
/// The greatest coordinate of a room.
const REACH: f64 = 8.0;

/// A light or an occluder. Coordinates are numbers of single precision.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A sphere, or a convex polygon.
    Shape(Shape),
    /// A box, by its least and greatest corner.
    Block([V3; 2]),
}

/// A patch of the floor y = 0, a light above it, and what is between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The corners of the patch, counterclockwise from above.
    pub patch: [V3; 4],
    /// The light, which shines to both sides.
    pub light: Body,
    /// What may hide it.
    pub occluders: Vec<Body>,
}

/// What is said of a light for all points of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// Nothing hides any of it.
    Lit,
    /// All of it is hidden.
    Dark,
    /// Some of it may be hidden.
    Open,
}

/// What a prover says of a room: its claim, and for each point that was asked for the irradiance by the radiance 1 and its greatest error.
#[derive(Clone, Debug)]
pub struct Answer {
    /// What is claimed.
    pub claim: Claim,
    /// The irradiances that are known.
    pub irradiance: Vec<Option<[f64; 2]>>,
}

/// Proves visibility; `None` if it supports no such room.
pub type Prover<'a> = dyn Fn(&Room, &[V3]) -> Option<Answer> + 'a;

impl Room {
    /// A random room.
    #[must_use]
    pub fn new(random: &mut Random) -> Self {
        let single = |v: V3| v.map(|x| f64::from(x as f32));
        let mut vector = |low: f64, high: f64| single([(); 3].map(|()| random.range(low, high)));
        let (from, turn, at, [size, r, _]) =
            (vector(-1.0, 1.0), vector(-1.0, 1.0), vector(3.5, 4.5), vector(0.05, 0.5));
        let edges = [vector(-1.0, 1.0), vector(-1.0, 1.0)];
        let flat = |corner: V3, [u, v]: [V3; 2], is_triangle: bool| {
            let far = if is_triangle { vec![] } else { vec![along(along(corner, u, 1.0), v, 1.0)] };
            let all = [vec![corner, along(corner, u, 1.0)], far, vec![along(corner, v, 1.0)]].concat();
            Body::Shape(Shape::Polygon(all.into_iter().map(single).collect()))
        };
        let middle = single([turn[0], at[1], turn[2]]);
        let mut occluders = Vec::new();
        let kinds = [(); 4].map(|()| vector(0.0, 1.0));
        for [kind, width, height] in &kinds[..(kinds[0][2] * 4.0) as usize] {
            let [low, u, v] = [vector(-1.0, 1.0), vector(-3.0, 3.0), vector(-3.0, 3.0)];
            let low = single([low[0], 1.5 + 0.3 * low[1], low[2]]);
            let level = |v: V3| [v[0], 0.05 * v[1], v[2]];
            occluders.push(match (kind * 4.0) as u32 {
                0 => Body::Shape(Shape::Sphere(low, f64::from((0.05 + 0.65 * width) as f32))),
                1 => flat(low, [u, v].map(|v| v.map(|x| x / 3.0)), true),
                2 => flat(along(low, along(u, v, 1.0), -0.5), [u, v].map(level), true),
                _ => Body::Block([low, single([low[0] + 0.1 + width, low[1] + 0.01 + 0.5 * height, low[2] + 0.5])]),
            });
        }
        let corner = |i: f64, j: f64| single([from[0] + i * size, 0.0, from[2] + j * size]);
        Self {
            patch: [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, 0.0)],
            light: match (turn[1] * 1.5 + 1.5) as u32 {
                0 => Body::Shape(Shape::Sphere(middle, r)),
                kind => flat(middle, edges, kind == 1),
            },
            occluders,
        }
    }

    /// Four points of the patch.
    #[must_use]
    pub fn points(&self, random: &mut Random) -> [V3; 4] {
        let [a, b, _, d] = self.patch;
        [(); 4].map(|()| along(along(a, sub(b, a), random.unit_f64()), sub(d, a), random.unit_f64()))
    }

    /// How far an answer for these points is off at most, relative to the error that it states: infinitely where a claim is wrong.
    #[must_use]
    pub fn worst(&self, points: &[V3], answer: &Answer) -> Measured {
        let mut worst = Measured::right(Figure::Bias, 1.0);
        for (&p, value) in points.iter().zip(&answer.irradiance) {
            let light = self.light.shapes(p).swap_remove(0);
            let occluders: Vec<Shape> = self.occluders.iter().flat_map(|body| body.shapes(p)).collect();
            let Some(truth) = visible(&light, &occluders, UP, spared(&light, p, ENDS)) else { continue };
            let is_wrong = match answer.claim {
                Claim::Lit => truth.occluders > 0,
                Claim::Dark => truth.left > 1e-12,
                Claim::Open => false,
            };
            let off = value.map_or(0.0, |[value, error]| (value - truth.left).abs() / (error + 1e-15));
            let off = if is_wrong { f64::INFINITY } else { off };
            if !(off <= worst.value) {
                let at = format!("{:?}, {value:?} instead of {} at {p:?}", answer.claim, truth.left);
                worst = Measured { value: off, at, ..worst };
            }
        }
        worst
    }
}

impl Body {
    /// Its surface, relative to a point.
    fn shapes(&self, p: V3) -> Vec<Shape> {
        let from = |q: V3| sub(q, p);
        match self {
            Self::Shape(Shape::Sphere(center, radius)) => vec![Shape::Sphere(from(*center), *radius)],
            Self::Shape(Shape::Polygon(corners)) => vec![Shape::Polygon(corners.iter().map(|&q| from(q)).collect())],
            Self::Block(ends) => {
                let corner = |k: usize| from([0, 1, 2].map(|axis| ends[k >> axis & 1][axis]));
                let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
                faces.map(|face| Shape::Polygon(face.map(corner).to_vec())).to_vec()
            }
        }
    }
    fn solid(&self) -> Option<Solid> {
        let at = |corners: &[V3], k: usize| Vec3::from(corners[k]);
        match self {
            Self::Shape(Shape::Sphere(center, radius)) => {
                Some(Solid::Sphere { center: (*center).into(), radius: *radius })
            }
            Self::Shape(Shape::Polygon(corners)) => Some(match corners.len() {
                3 => Solid::triangle([0, 1, 2].map(|k| at(corners, k))),
                _ => Solid::quadrilateral([0, 1, 2, 3].map(|k| at(corners, k))),
            }),
            Self::Block([low, high]) => Solid::block((*low).into(), (*high).into()),
        }
    }
}

/// Judges a prover in so many rooms, at four points in each: a claim must not be contradicted, and no irradiance may be off by more than it
/// says.
#[must_use]
pub fn judge(name: &str, prover: &Prover<'_>, rooms: usize, seed: u64) -> Judgement {
    let (start, mut random) = (Instant::now(), Random::new(seed));
    let (mut cases, mut findings) = (Vec::new(), Vec::<Finding>::new());
    for number in 0..rooms {
        let room = Room::new(&mut random);
        let points = room.points(&mut random);
        let mut figures = Vec::new();
        if let Some(answer) = prover(&room, &points) {
            let worst = room.worst(&points, &answer);
            if worst.is_finding() && findings.is_empty() {
                let said = format!("it contradicts the oracle: {}", worst.at);
                findings.push(Finding { figure: Figure::Bias, value: worst.value, said, input: format!("{room:?}") });
            }
            figures.push(worst);
        }
        cases.push(Case { axis: Axis::Ordinary, value: number as f64, figures });
    }
    let seconds = start.elapsed().as_secs_f64();
    Judgement { seconds, ..Judgement::new(name, "room", "proof", cases, findings) }
}

/// What `etendue-visible` says of a room.
#[must_use]
pub fn own(room: &Room, points: &[V3]) -> Option<Answer> {
    let patch = Patch::polygon(&room.patch.map(Vec3::from), 1e-7, 0.0)?;
    let light = Light::new(room.light.solid()?, true)?;
    let mut prover = etendue_visible::Prover::new(REACH);
    let mut all = room.occluders.iter().map(Body::solid);
    let mut seen =
        prover.prove(&patch, &light, |_, found| all.all(|solid| solid.is_some_and(|s| found(Occluder::Whole(s)))));
    let claim = match seen.proof {
        Proof::Lit => Claim::Lit,
        Proof::Dark => Claim::Dark,
        Proof::Behind(_) | Proof::Open => Claim::Open,
    };
    let known = |p: &V3| seen.irradiance((*p).into(), UP.into()).and_then(|found| Some([found.value, found.error?]));
    Some(Answer { claim, irradiance: points.iter().map(known).collect() })
}
