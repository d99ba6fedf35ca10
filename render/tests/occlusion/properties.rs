//! Properties of visible parts, and special cases.

use super::accuracy::BOUND;
use super::regimes::{Regime, regimes};
use super::truth::{Truth, polygon, sphere};
use etendue::{Real, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::occlusion::Scene;
use etendue_oracle::Greatest;
use etendue_visible::Solid;

/// Scenes of all regimes.
fn scenes(count: u32, seed: u64, mut f: impl FnMut(&Regime, Scene, &mut Random)) {
    let mut random = Random::new(seed);
    let regimes = regimes();
    for regime in (0..count).flat_map(|_| &regimes) {
        let scene = (regime.scene)(&mut random);
        f(regime, scene, &mut random);
    }
}

/// Total, within [0, Ω⊥], lane-identical and independent of the unit of length, in all regimes.
#[test]
fn properties_in_all_regimes() {
    scenes(30, 71, |_, scene, _| {
        scene.total();
        scene.lanes();
        scene.scale(20);
        scene.scale(-20);
    });
}

/// The order of corners and of occluders, and the direction around, only change the rounding; a further occluder never adds light.
#[test]
fn orders() {
    let (mut order, mut more) = (Greatest::NONE, Greatest::NONE);
    scenes(30, 73, |regime, scene, random| {
        if regime.has_polyhedra {
            return;
        }
        let mut other = scene.clone();
        for shape in core::iter::once(&mut other.light).chain(&mut other.occluders) {
            if let Solid::Polygon { corners, count, .. } = shape {
                corners[..*count].rotate_left(random.word() as usize % *count);
                if random.word() & 1 == 0 {
                    corners[..*count].reverse();
                }
            }
        }
        for i in (1..other.occluders.len()).rev() {
            other.occluders.swap(i, random.word() as usize % (i + 1));
        }
        let mut fewer = scene.clone();
        fewer.occluders.pop();
        let (Some(found), others, fewer) = (scene.found::<f32x8>(0), other.found::<f32x8>(0), fewer.found::<f32x8>(0))
        else {
            return;
        };
        for lane in 0..8 {
            let Some([truth, far]) = scene.truth(lane) else { continue };
            let unit = truth.around * truth.occluders.max(1) as f64 / scene.condition(lane);
            // where the limit in front of the light decides, rounding may too
            if unit <= 0.0 || (truth.left - far.left).abs() > 1e-9 * unit {
                continue;
            }
            let found = found.lane_f64(lane);
            if let Some(others) = others {
                order.take((others.lane_f64(lane) - found).abs() / unit, ());
            }
            if let Some(fewer) = fewer {
                more.take((found - fewer.lane_f64(lane)) / unit, ());
            }
        }
    });
    println!("another order: {:.1e} of the angle; light added by an occluder: {:.1e}", order.error(), more.error());
    assert!(order.error() < 2.0 * BOUND && more.error() < 2.0 * BOUND, "{order:?} {more:?}");
}

/// What has no area hides nothing, covered lights have 0, and what cannot be computed is `None`.
#[test]
fn special_cases() {
    let square = |y: f64, half: f64| polygon(&[[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]);
    let scene = |light, occluders| Scene { light, occluders, points: [[0.0; 3]; 8], normals: [[0.0, 1.0, 0.0]; 8] };
    let value = |light: &Solid, occluders: Vec<_>| scene(light.clone(), occluders).found::<f32>(0);
    let light = square(2.0, 1.0);
    let all = value(&light, vec![]).unwrap();
    // a plane, a point, an edge, an occluder seen edge-on, and those behind the light and below the horizon
    let edge = polygon(&[[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let edge_on = polygon(&[[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.5, 0.0]]);
    for hidden in [square(1.0, 0.0), edge, edge_on, square(2.0, 1.0), square(3.0, 1.0), square(-1.0, 1.0)] {
        assert_eq!(value(&light, vec![hidden.clone()]), Some(all), "{hidden:?}");
    }
    // a quadrilateral whose corners coincide is a triangle, in any order
    let triangle = [[-0.4, 1.0, -0.3], [0.5, 1.0, -0.2], [0.1, 1.0, 0.6]];
    let part = value(&light, vec![polygon(&triangle)]).unwrap();
    for k in 0..3 {
        let mut twice = triangle.to_vec();
        twice.insert(k, triangle[k]);
        let found = value(&light, vec![polygon(&twice)]).unwrap();
        assert!((found - part).abs() < 1e-6 && part < 0.99 * all, "{found} {part} {all}");
        let found = value(&polygon(&twice), vec![]).unwrap();
        assert!((found - value(&polygon(&triangle), vec![]).unwrap()).abs() < 1e-6);
    }
    assert_eq!(value(&light, vec![square(1.0, 0.6)]), Some(0.0));
    assert_eq!(value(&light, vec![square(1.0, 0.5)]), Some(0.0));
    assert_eq!(value(&light, vec![square(1.0, 0.5); 16]), Some(0.0));
    assert_eq!(value(&light, vec![square(1.0, 0.1); 17]), None);
    // spheres beside each other, and spheres that overlap
    let ball = |x: f64| sphere([x, 1.0, 0.0], 0.1);
    assert!(value(&light, vec![ball(-0.2), ball(0.2)]).is_some());
    assert_eq!(value(&light, vec![ball(-0.05), ball(0.05)]), None);
    assert_eq!(value(&sphere([0.0, 2.0, 0.0], 0.5), vec![ball(0.0)]), None);
    // a sphere cut by the plane of the light
    assert_eq!(value(&light, vec![sphere([0.0, 2.0, 0.0], 0.1)]), None);
    assert_eq!(value(&light, vec![sphere([0.0, 3.0, 0.0], 0.1)]), Some(all));
}
