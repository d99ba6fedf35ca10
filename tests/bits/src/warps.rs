//! Every warp in every regime: points, pdfs, inverses, directions and distances.

use crate::figures::{Figures, List, Routine};
use etendue::Real;
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::{self, Case, Random};
use etendue_judge::packets::{Coordinates, squares_of};

/// Warps and points of the square, in groups that fit into packets, and points that did not come from a sample.
struct Warped<S> {
    slots: Vec<(S, [f32; 2], [f64; 3])>,
    points: Points,
}
/// What points are.
#[derive(Clone, Copy, PartialEq)]
enum Points {
    /// Those of the plane.
    Plane,
    /// Those of space.
    Space,
    /// Directions of shapes that are seen at a distance.
    Seen,
}

/// Points at the ends of the domains, and near them.
const GIVEN: [[f64; 3]; 8] = [
    [0.0; 3],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 0.0, 0.0],
    [-0.6, 0.8, -0.0],
    [1e-30, -1e-42, 1.0],
    [0.5, 0.25, 0.0],
    [0.6, 0.0, 0.8],
];

impl<S: Fixture> Warped<S> {
    fn new(cases: &[Case<S>], points: Points) -> Self {
        // the corners and edges of the square, as far as `each` allows, and as many random points
        let mut random = Random::new(71);
        let (square, each) = (generators::square(0, 0), (1600 / cases.len()).max(12));
        let slot = |k: usize| {
            let word = random.word();
            let edge = square[word as u32 as usize % square.len()];
            let u = if word >> 63 == 0 { edge } else { [random.unit(), random.unit()] };
            let w = if word >> 62 & 1 == 0 { random.direction() } else { GIVEN[(word >> 40) as usize % 8] };
            let w = if points == Points::Plane { [w[0], w[1], 0.0] } else { w };
            (cases[k % cases.len()].1, u, w)
        };
        let slots = (0..(cases.len() * each).next_multiple_of(Figures::MOST)).map(slot).collect();
        Self { slots, points }
    }
}

impl<S: Fixture> Routine for Warped<S> {
    fn run<R: Real>(&self, figures: &mut Figures) {
        figures.packets::<R>(self.slots.len(), |first, lanes| {
            let slots = &self.slots[first..first + R::LANES];
            let warp = S::prepare::<R>(&slots.iter().map(|slot| slot.0).collect::<Vec<_>>());
            let sampled = warp.sample(squares_of(&slots.iter().map(|slot| slot.1).collect::<Vec<_>>()));
            let given = Coordinates::gather(&slots.iter().map(|slot| slot.2).collect::<Vec<_>>());
            for point in [sampled.direction, given] {
                (0..R::LANES).for_each(|i| point.at(i).into_iter().for_each(|x| lanes.lane(i, x)));
                lanes.real(warp.pdf(point));
                lanes.pair(warp.invert(point));
            }
            if self.points == Points::Seen {
                lanes.vector(sampled.direction);
                lanes.real(sampled.distance);
            }
        });
    }
}

macro_rules! rows {
    ({ $list:ident } $($name:ident $points:ident $random:literal $(: $warp:path)? $(= $cases:expr)?;)+) => {$(
        let cases = etendue_judge::warps!(@cases $(: $warp)? $(= $cases)?);
        $list.add(concat!("warp/", stringify!($name)), &Warped::new(&generators::seen(cases), Points::$points));
    )+};
}
pub(crate) fn add(list: &mut List<'_>) {
    etendue_judge::warps!(rows! { { list } });
}
