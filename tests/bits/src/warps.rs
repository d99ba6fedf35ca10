//! Every warp in every regime: points, pdfs, inverses, directions and distances.

use crate::figures::{Figures, List, Routine};
use etendue::light::shapes::DirectionSample;
use etendue::{Real, Vec2, Warp};
use etendue_judge::fixture::Fixture;
use etendue_judge::fixtures::{
    AreaTriangle, ConcentricDisk, CosineHemisphere, LowDistortionTriangle, Octahedral, UniformHemisphere, UniformSphere,
};
use etendue_judge::generators::{self, Case, Random};
use etendue_judge::packets::{Coordinates, squares_of};

/// Warps and points of the square, in groups that fit into packets, and points that did not come from a sample.
struct Warped<S> {
    slots: Vec<(S, [f32; 2], [f64; 3])>,
}

/// Points at the ends of the domains, and near them.
const POINTS: [[f64; 3]; 8] = [
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
    fn new(cases: &[Case<S>]) -> Self {
        // the corners and edges of the square, as far as `each` allows, and as many random points
        let mut random = Random::new(71);
        let (square, each) = (generators::square(0, 0), (1600 / cases.len()).max(12));
        let mut groups: Vec<Vec<S>> = Vec::new();
        for (_, subject) in cases {
            match groups.iter_mut().find(|group| group[0].kin(subject)) {
                Some(group) => group.push(*subject),
                None => groups.push(vec![*subject]),
            }
        }
        let mut slots = Vec::new();
        for group in groups {
            let count = (group.len() * each).next_multiple_of(Figures::MOST);
            for k in 0..count {
                let word = random.word();
                let edge = square[word as u32 as usize % square.len()];
                let u = if word >> 63 == 0 { edge } else { [random.unit(), random.unit()] };
                let w = if word >> 62 & 1 == 0 { random.direction() } else { POINTS[(word >> 40) as usize % 8] };
                slots.push((group[k % group.len()], u, w));
            }
        }
        Self { slots }
    }
}

// Each function once, so that the build does not take longer.
#[inline(never)]
fn prepare<S: Fixture, R: Real>(lanes: &[S]) -> S::Warp<R> {
    S::prepare::<R>(lanes)
}
#[inline(never)]
fn sample<S: Fixture, R: Real>(warp: &S::Warp<R>, u: Vec2<R>) -> S::Point<R> {
    warp.sample(u)
}
#[inline(never)]
fn pdf<S: Fixture, R: Real>(warp: &S::Warp<R>, point: S::Point<R>) -> R {
    warp.pdf(point)
}
#[inline(never)]
fn invert<S: Fixture, R: Real>(warp: &S::Warp<R>, point: S::Point<R>) -> Vec2<R> {
    warp.invert(point)
}
#[inline(never)]
fn direction<S: Fixture, R: Real>(warp: &S::Warp<R>, u: Vec2<R>) -> Option<DirectionSample<R>> {
    S::sample_direction::<R>(warp, u)
}

impl<S: Fixture> Routine for Warped<S> {
    fn run<R: Real>(&self, figures: &mut Figures) {
        figures.packets::<R>(self.slots.len(), |first, lanes| {
            let slots = &self.slots[first..first + R::LANES];
            let warp = prepare::<S, R>(&slots.iter().map(|slot| slot.0).collect::<Vec<_>>());
            let us: Vec<_> = slots.iter().map(|slot| slot.1).collect();
            let (u, sampled) = (squares_of(&us), sample::<S, R>(&warp, squares_of(&us)));
            let given = S::Point::<R>::gather(&slots.iter().map(|slot| slot.2).collect::<Vec<_>>());
            for point in [sampled, given] {
                (0..R::LANES).for_each(|i| point.at(i).into_iter().for_each(|x| lanes.lane(i, x)));
                lanes.real(pdf::<S, R>(&warp, point));
                lanes.pair(invert::<S, R>(&warp, point));
            }
            if let Some(seen) = direction::<S, R>(&warp, u) {
                lanes.vector(seen.direction);
                lanes.real(seen.distance);
            }
        });
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    macro_rules! warps {
        ($($name:literal: $cases:expr;)+) => {$(list.add(concat!("warp/", $name), &Warped::new(&$cases));)+};
    }
    warps! {
        "concentric_disk": [("whole", ConcentricDisk)];
        "area_triangle": [("whole", AreaTriangle)];
        "low_distortion_triangle": [("whole", LowDistortionTriangle)];
        "bilinear": generators::bilinears();
        "ggx_visible_normals": generators::microsurfaces();
        "cosine_hemisphere": [("whole", CosineHemisphere)];
        "uniform_hemisphere": [("whole", UniformHemisphere)];
        "uniform_sphere": [("whole", UniformSphere)];
        "octahedral": [("whole", Octahedral)];
        "cone": generators::cones();
        "patch_surface": generators::patch_surfaces();
        "spherical_cap": generators::caps(3, 11);
        "spherical_triangle": generators::triangles(4, 12);
        "spherical_parallelogram": generators::parallelograms(4, 13);
        "spherical_rectangle": generators::rectangles(4, 14);
        "spherical_polygon": generators::hexagons(3, 15);
        "spherical_disk": generators::disks(3, 31);
        "spherical_segment": generators::segments(3, 21).0;
        "projected_cap": generators::projected_caps(3, 14);
        "projected_triangle": generators::projected_triangles(3, 16);
        "projected_parallelogram": generators::projected_parallelograms(1, 17);
        "projected_polygon": generators::projected_pentagons(2, 18);
        "projected_segment": generators::segments(1, 22).1;
    }
}
