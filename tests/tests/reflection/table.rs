//! The table of the fit: of the transforms near each of its own, none fits GGX better, by quadratures in double precision.

use super::ReflectingSurface;
use core::f64::consts::PI;
use etendue::warp::GgxVisibleNormals;
use etendue::{Vec2, Vec3, Warp};
use etendue_judge::packets::Coordinates;
use etendue_oracle::{V3, along, dot, unit};

const SIDE: usize = 16;

/// A direction of a quadrature, and the part of the hemisphere for which it stands.
struct Node {
    w: V3,
    solid_angle: f64,
    /// f cosθ.
    reflected: f64,
}

/// `count`² directions by visible normals and as many by the cosine, each weighted by the sum of both densities.
fn quadrature(place: &ReflectingSurface, count: usize) -> Vec<Node> {
    let normals = GgxVisibleNormals::new(place.alpha, place.alpha, Vec3::from(place.view));
    let at = |k: usize| (k as f64 + 0.5) / count as f64;
    let directions = (0..count * count).flat_map(|k| {
        let [x, y] = [at(k / count), at(k % count)];
        let m = normals.sample(Vec2::new(x, y)).at(0);
        let (sin, cos) = (2.0 * PI * y).sin_cos();
        let cosine = [x.sqrt() * cos, x.sqrt() * sin, (1.0 - x).sqrt()];
        [along(place.view.map(|v| -v), m, 2.0 * dot(place.view, m)), cosine]
    });
    let each = (count * count) as f64;
    let node = |w: V3| {
        let half = unit(along(place.view, w, 1.0));
        let densities = normals.reflected_pdf(Vec3::from(half)) + w[2] / PI;
        Node { w, solid_angle: 1.0 / (each * densities), reflected: place.reflected(w) }
    };
    directions.filter(|w| w[2] > 0.0).map(node).collect()
}

/// A transform (x, y, z) → (a (x + b z), c y, z) from the first three numbers of a cell.
fn transform([root, slope, across]: [f64; 3], alpha: f64, tangent: f64) -> [f64; 3] {
    [root.powi(4) / (2.0 * alpha), slope * tangent, across / (2.0 * alpha)]
}

/// ∫ f²/g, which is least where ∫ (f − g)²/g is, since g integrates to 1.
fn residual(nodes: &[Node], [a, b, c]: [f64; 3]) -> f64 {
    let of = |node: &Node| {
        let [x, y, z] = [a * (node.w[0] + b * node.w[2]), c * node.w[1], node.w[2]];
        let g = z * a * c / (PI * (x * x + y * y + z * z).powi(2));
        node.solid_angle * node.reflected * node.reflected / g
    };
    nodes.iter().map(of).sum()
}

#[test]
fn no_transform_nearby_fits_better() {
    let table = etendue::reflection::table();
    assert_eq!(table.len(), SIDE * SIDE * 5);
    let square = |k: usize| (k as f64).max(0.25).powi(2) / ((SIDE - 1) * (SIDE - 1)) as f64;
    // where the view has a cosine over 0.8, at cosines from 0.2, and anywhere
    let mut greatest = [0.0_f64; 3];
    let mut off = [0.0_f64; 3];
    // how many of all numbers would be noticed if they were a twentieth off
    let mut noticed = 0;
    for cell in 0..SIDE * SIDE {
        let (alpha, cos) = (square(cell / SIDE), square(cell % SIDE).min(0.999_999));
        let view = [(1.0 - cos * cos).sqrt(), 0.0, cos];
        let place = ReflectingSurface { alpha, normal: [0.0, 0.0, 1.0], view };
        let nodes = quadrature(&place, 128);
        let numbers: [f64; 5] = core::array::from_fn(|k| f64::from(table[cell * 5 + k]));
        let [root, slope, across, albedo, schlick] = numbers;
        let sum = |of: &dyn Fn(&Node) -> f64| nodes.iter().map(|n| n.solid_angle * n.reflected * of(n)).sum::<f64>();
        let all = sum(&|_| 1.0);
        let weight = sum(&|n| (1.0 - dot(unit(along(view, n.w, 1.0)), view)).powi(5)) / all;
        off = [off[0].max((albedo / all - 1.0).abs()), off[1].max((schlick - weight).abs()), off[2]];
        let of = |numbers: [f64; 3]| residual(&nodes, transform(numbers, alpha, view[0] / cos));
        // by how much a step of a hundredth of one number lessens the residual
        let better = |numbers: [f64; 3]| {
            let moved = |k: usize, step: f64| core::array::from_fn(|i| numbers[i] * if i == k { step } else { 1.0 });
            let steps = (0..3).flat_map(|k| [0.99, 1.01].map(|step| of(moved(k, step))));
            1.0 - steps.fold(f64::INFINITY, f64::min) / of(numbers)
        };
        let own = [root, slope, across];
        off[2] = off[2].max(better(own));
        assert!(better(own) < 2e-4, "α {alpha}, cosθ {cos}: {:e} less beside {numbers:?}", better(own));
        for k in 0..3 {
            let wrong = core::array::from_fn(|i| own[i] * if i == k { 1.05 } else { 1.0 });
            noticed += u32::from(better(wrong) > 2e-4);
        }
        let least = of(own);
        let deviation = (least / (all * all) - 1.0).max(0.0).sqrt();
        let kind = if cos > 0.8 { 0 } else { 1 + usize::from(cos < 0.2) };
        greatest[kind] = greatest[kind].max(deviation);
    }
    println!("standard deviation of f/g up to {greatest:.3?}; albedo, Schlick's weight and residual off by {off:?}");
    println!("a twentieth off is noticed in {noticed} of {} numbers", 3 * SIDE * SIDE);
    assert!(noticed > 680, "{noticed}");
    assert!(off[0] < 4e-4 && off[1] < 2e-4, "{off:?}");
    assert!(greatest[0] < 0.2 && greatest[1] < 0.6 && greatest[2] < 10.0, "{greatest:?}");
}
