//! Lights that are in the same place.

use super::description::Shape;
use etendue::Vec3;
use etendue_visible::{ENDS, Solid};

type V64 = Vec3<f64>;

/// At most so many pairs of lights whose boxes meet along an axis are looked at.
const MOST: usize = 1 << 24;

/// Two lights of which parts are in the same place, but for rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coincidence {
    /// Their indices in the scene's list, in ascending order.
    pub lights: [u32; 2],
    /// Whether they shine towards the same side: of the second light, what is behind the first is then dark. Otherwise, each is seen from
    /// the side that it shines to.
    pub hides: bool,
}

/// A light, with what is needed to find those in the same place.
struct Lamp {
    index: u32,
    two_sided: bool,
    low: [f64; 3],
    high: [f64; 3],
    form: Form,
}

enum Form {
    Ball(V64, f64),
    /// Corners in order around, and the unit normal.
    Flat(Vec<V64>, V64),
}

/// The pairs of lights in the same place, by the index of the second, then of the first. (Of scenes with millions of lights that are
/// close together, not all are found.)
#[must_use]
pub fn coincidences(shapes: &[Shape]) -> Vec<Coincidence> {
    let mut lamps: Vec<Lamp> = (0..).zip(shapes).filter_map(|(index, shape)| Lamp::new(index, shape)).collect();
    let extent = |k: usize| {
        let ends = lamps.iter().map(|lamp| [lamp.low[k], lamp.high[k]]);
        ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).map_or(0.0, |[low, high]| high - low)
    };
    let axis = if extent(0) >= extent(1).max(extent(2)) { 0 } else { 1 + usize::from(extent(2) > extent(1)) };
    lamps.sort_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
    let (mut pairs, mut looked_at) = (Vec::new(), 0);
    for (i, lamp) in lamps.iter().enumerate() {
        for other in lamps[i + 1..].iter().take_while(|other| other.low[axis] <= lamp.high[axis]) {
            looked_at += 1;
            if lamp.meets(other) && lamp.is_level(other) {
                let [first, second] = if lamp.index < other.index { [lamp, other] } else { [other, lamp] };
                let hides = first.two_sided || second.two_sided || first.faces(second);
                pairs.push(Coincidence { lights: [first.index, second.index], hides });
            }
        }
        if looked_at > MOST {
            break;
        }
    }
    pairs.sort_by_key(|pair| [pair.lights[1], pair.lights[0]]);
    pairs
}

impl Lamp {
    fn new(index: u32, shape: &Shape) -> Option<Self> {
        let two_sided = shape.emission.filter(|emission| !emission.is_unseen)?.two_sided;
        let [low, high] = shape.geometry.bounds().map(|corner| corner.map(f64::from));
        let form = match (shape.geometry.outline().solid(), shape.geometry.plane()) {
            (Solid::Sphere { center, radius }, None) => Form::Ball(center, radius),
            (solid, Some([_, normal])) => {
                let (corners, count) = solid.outline()?;
                Form::Flat(corners[..count].to_vec(), normal)
            }
            _ => return None,
        };
        // boxes meet where they are apart by rounding
        let bound = 2.0 * ENDS * low.iter().chain(&high).fold(0.0, |most: f64, x| most.max(x.abs()));
        let (low, high) = (low.map(|x| x - bound), high.map(|x| x + bound));
        Some(Self { index, two_sided, low, high, form })
    }
    fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
    /// Whether both shine towards the same side, of lights that are level.
    fn faces(&self, other: &Self) -> bool {
        match (&self.form, &other.form) {
            (Form::Flat(_, a), Form::Flat(_, b)) => a.dot(*b) > 0.0,
            _ => true,
        }
    }
    /// Whether parts of both are in the same place, but for rounding.
    fn is_level(&self, other: &Self) -> bool {
        match (&self.form, &other.form) {
            (Form::Ball(a, r), Form::Ball(b, s)) => {
                (*a - *b).length() + (r - s).abs() <= ENDS * (a.max_abs() + r).max(b.max_abs() + s)
            }
            (Form::Flat(a, n), Form::Flat(b, m)) => {
                let bound = ENDS * a.iter().chain(b).fold(0.0, |most: f64, v| most.max(v.max_abs()));
                n.dot(*m).abs() > 0.999
                    && level_part(a, *m, b[0], bound)
                    && level_part(b, *n, a[0], bound)
                    && overlap(a, b, *n, bound)
            }
            _ => false,
        }
    }
}

/// Whether a polygon is level with a plane somewhere.
fn level_part(corners: &[V64], normal: V64, point: V64, bound: f64) -> bool {
    let heights = corners.iter().map(|&corner| normal.dot(corner - point));
    let [least, most] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], h| [a.min(h), b.max(h)]);
    least <= bound && most >= -bound
}

/// Whether two convex polygons overlap, as seen along a normal, by more than the bound: those that share an edge do not.
fn overlap(a: &[V64], b: &[V64], normal: V64, bound: f64) -> bool {
    let across = |corners: &[V64]| -> Vec<V64> {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(&from, &to)| normal.cross(to - from).normalize()).collect()
    };
    let range = |corners: &[V64], axis: V64| {
        let along = corners.iter().map(|&corner| axis.dot(corner));
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
    };
    across(a).into_iter().chain(across(b)).all(|axis| {
        let ([least, most], [other_least, other_most]) = (range(a, axis), range(b, axis));
        least + 2.0 * bound < other_most && other_least + 2.0 * bound < most
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Emission, Geometry, Parallelogram, Sphere};

    fn lamp(geometry: Geometry, two_sided: bool) -> Shape {
        let emission = Emission { radiance: [1.0; 3], two_sided, ..Emission::default() };
        Shape { geometry, material: 0, emission: Some(emission) }
    }
    fn quad(p: [f32; 3], side: f32) -> Geometry {
        Geometry::Parallelogram(Parallelogram { p, u: [side, 0.0, 0.3 * side], v: [0.0, side, 0.0] })
    }
    fn turned(geometry: &Geometry) -> Geometry {
        let Geometry::Parallelogram(Parallelogram { p, u, v }) = *geometry else { unreachable!("a quad") };
        Geometry::Parallelogram(Parallelogram { p, u: v, v: u })
    }

    #[test]
    fn lights_in_the_same_place_are_found() {
        let (big, ball) =
            (quad([1.0, 2.0, 3.0], 1.0), |x, radius| Geometry::Sphere(Sphere { center: [x, 0.0, 0.0], radius }));
        let within = quad([1.25, 2.25, 3.075], 0.5);
        let shape = |of: &Geometry| lamp(of.clone(), false);
        for (first, second, expected) in [
            (shape(&big), shape(&big), Some(true)),
            (shape(&big), shape(&within), Some(true)),
            (shape(&big), shape(&turned(&big)), Some(false)),
            (shape(&big), lamp(turned(&big), true), Some(true)),
            // a rounding of the coordinates apart, and twenty
            (shape(&big), shape(&quad([1.0, 2.0, 3.0 + 3e-7], 1.0)), Some(true)),
            (shape(&big), shape(&quad([1.0, 2.0, 3.0 + 6e-6], 1.0)), None),
            // beside each other
            (shape(&big), shape(&quad([2.0, 2.0, 3.3], 1.0)), None),
            (shape(&ball(1.0, 2.0)), shape(&ball(1.0, 2.0)), Some(true)),
            (shape(&ball(1.0, 2.0)), shape(&ball(1.1, 2.0)), None),
        ] {
            let dark = Shape { emission: None, ..shape(&big) };
            let found = coincidences(&[dark, first.clone(), second.clone()]);
            let expected: Vec<_> = expected.map(|hides| Coincidence { lights: [1, 2], hides }).into_iter().collect();
            assert_eq!(found, expected, "{first:?} {second:?}");
        }
    }
}
