//! Tests that nothing is claimed within the bound of rounding: the sign of each margin shows, since the bound is made large.

use crate::between::crosses;
use crate::hull::{Hull, V64};
use crate::light::Light;
use crate::patch::{Ground, Patch};
use crate::shaft::{Facing, Shaft};
use crate::solid::Solid;
use alloc::vec::Vec;

const EPSILON: f64 = 0.01;

fn hull(points: &[[f64; 3]]) -> Hull {
    Hull::new(&points.iter().map(|&p| p.into()).collect::<Vec<V64>>(), 0.0)
}

/// The segment between two points.
fn shaft(from: [f64; 3], to: [f64; 3]) -> Shaft {
    let mut shaft = Shaft::default();
    (shaft.patch, shaft.light, shaft.epsilon) = (hull(&[from]), hull(&[to]), EPSILON);
    shaft
}

/// Asserts what holds this many times the bound beyond what is exact, but not nearer.
fn begins_at(times: f64, claim: impl Fn(f64) -> bool) {
    for k in [-0.9, -0.5, 0.0, 0.5, 0.9] {
        assert!(!claim(k * times * EPSILON), "claimed at {k} of the margin");
    }
    assert!(claim(1.5 * times * EPSILON), "not claimed beyond the margin");
}

fn ball() -> Solid {
    Solid::Sphere { center: V64::default(), radius: 1.0 }
}

/// A triangle around the y axis, with an edge at z = −1.
fn triangle() -> Solid {
    let corners = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 2.0]];
    Solid::triangle(corners.map(V64::from))
}

#[test]
fn triangles_cover_what_they_are_between() {
    for up in [1.0, -1.0] {
        begins_at(2.0, |gap| triangle().covers(&shaft([0.0, up * gap, 0.0], [0.0, -up, 0.0])));
        begins_at(2.0, |gap| triangle().covers(&shaft([0.0, up, 0.0], [0.0, -up * gap, 0.0])));
        // next to an edge: the corner from which it is seen is √2 away
        let beside = |gap: f64| [gap - 1.0, gap - 1.0];
        begins_at(core::f64::consts::SQRT_2, |gap| {
            triangle().covers(&shaft([0.0, up, beside(gap)[0]], [0.0, -up, beside(gap)[1]]))
        });
    }
}

#[test]
fn occluders_that_may_touch_a_ball_do() {
    let at = |gap: f64| hull(&[[0.0, gap, 0.0]]);
    begins_at(1.0, |gap| !ball().touches(&at(1.0 + gap), EPSILON));
    // the distance to a triangle has no sign
    assert!(triangle().touches(&at(0.9 * EPSILON), EPSILON) && !triangle().touches(&at(1.5 * EPSILON), EPSILON));
}

#[test]
fn what_may_lie_behind_the_light_crosses_it() {
    let mut flat = shaft([0.0, 5.0, 0.0], [0.0; 3]);
    flat.end = Some((V64::new(0.0, 1.0, 0.0), 0.0, 0.25));
    begins_at(1.0, |gap| !crosses(&[V64::new(0.0, 0.25 + gap, 0.0)], 0.0, &flat));
    begins_at(1.0, |gap| !crosses(&[V64::new(0.0, 1.25 + gap, 0.0)], 1.0, &flat));
    // the polar plane of (3, 0, 0)
    let mut round = shaft([3.0, 0.0, 0.0], [0.0; 3]);
    round.light = Hull::new(&[V64::default()], 1.0);
    begins_at(1.12, |gap| !crosses(&[V64::new(1.0 / 3.0 + gap, 0.0, 0.0)], 0.0, &round));
}

#[test]
fn bodies_stand_for_their_triangles_only_if_the_light_is_outside() {
    let Some(Solid::Polyhedron(body)) = Solid::block(V64::default(), V64::new(1.0, 1.0, 1.0)) else {
        panic!("a cube is a polyhedron")
    };
    let below = |gap: f64| {
        let mut shaft = shaft([0.5, 3.0, 0.5], [0.5, -gap, 0.5]);
        shaft.end = Some((V64::new(0.0, 1.0, 0.0), -gap, 0.0));
        shaft
    };
    begins_at(2.0, |gap| body.serves(&below(gap)));
    begins_at(4.0, |gap| Solid::Polyhedron(body.clone()).covers(&shaft([1.0 - gap, 3.0, 0.5], [1.0 - gap, -2.0, 0.5])));
}

/// The bound of rounding in a scene with coordinates of this size, which is more than that of points on lights of size 1.
const REACH: f64 = 1e12;
const ROUNDING: f64 = REACH / (1_u64 << 48) as f64;

fn set(patch: &Patch, solid: Solid) -> (Facing, Shaft) {
    let light = Light::new(solid, false).unwrap();
    let mut shaft = Shaft::default();
    let facing = shaft.set(patch, &light, REACH);
    (facing, shaft)
}

/// A point that is on nothing.
fn loose(y: f64) -> Patch {
    Patch { hull: hull(&[[0.0, y, 0.0]]), ground: None, ball: None }
}

/// A square at y = 0.
fn level() -> Patch {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, z]| [x, 0.0, z]);
    let ground = Ground { normal: V64::new(0.0, 1.0, 0.0), offset: 0.0, height: 0.0 };
    Patch { hull: hull(&corners), ground: Some(ground), ball: None }
}

fn sphere(y: f64) -> Solid {
    Solid::Sphere { center: V64::new(0.0, y, 0.0), radius: 1.0 }
}

#[test]
fn patches_near_the_plane_of_a_light_are_on_no_side() {
    let edges = [V64::new(0.0, 0.0, 2.0), V64::new(2.0, 0.0, 0.0)];
    let panel = Solid::Parallelogram { corner: V64::new(-1.0, 0.0, -1.0), edges };
    for (y, expected) in [(-1.5, 'A'), (-0.9, 'U'), (-0.1, 'U'), (0.1, 'U'), (0.9, 'U'), (1.5, 'T')] {
        let found = match set(&loose(y * ROUNDING), panel.clone()).0 {
            Facing::Away => 'A',
            Facing::Unknown => 'U',
            Facing::Towards => 'T',
        };
        assert_eq!(found, expected, "{y}");
    }
    let (_, shaft) = set(&loose(1.0), panel);
    assert!(shaft.end.unwrap().2 < 0.28 * crate::measure::ENDS - 0.9 * ROUNDING);
}

#[test]
fn patches_near_a_ball_are_on_no_side() {
    for (gap, is_apart) in [(0.5, false), (0.9, false), (1.5, true)] {
        let facing = set(&loose(1.0 + gap * ROUNDING), sphere(0.0)).0;
        assert_eq!(matches!(facing, Facing::Towards), is_apart, "{gap}");
        let facing = set(&level(), sphere(1.0 + gap * ROUNDING)).0;
        assert_eq!(matches!(facing, Facing::Towards), is_apart, "{gap} above");
        // below the horizon, at a distance
        let aside =
            Solid::Sphere { center: V64::new(10.0, f64::from((-1.0 - gap * ROUNDING) as f32), 0.0), radius: 1.0 };
        let facing = set(&level(), aside).0;
        assert_eq!(matches!(facing, Facing::Away), is_apart, "{gap} below");
    }
}

#[test]
fn shafts_are_wider_than_rounding() {
    for patch in [level(), Patch { ground: None, ..level() }] {
        let (_, shaft) = set(&patch, sphere(4.0));
        let misses = |y: f64| shaft.misses(&[V64::new(0.0, y * ROUNDING, 0.0)], 0.0);
        assert!(!misses(0.0) && !misses(-0.9) && misses(-1.5));
    }
}
