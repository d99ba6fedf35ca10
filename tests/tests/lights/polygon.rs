//! Polygons as lights: coincident corners, small ones, normals.

use etendue::{LightSampler, Parallelogram, Polygon, Vec2, Vec3};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::{V3, along, basis, cross, exact_sum, triangle_solid_angle, unit};

/// Five corners on an ellipse above the origin, and the unit vector from the origin to their plane.
fn pentagon(random: &mut Random) -> ([V3; 5], V3) {
    let (s, t) = basis(random.direction());
    let n = unit(cross(s, t));
    let start = random.unit_f64();
    let corners = core::array::from_fn(|i| {
        let turn = (i as f64 + start) / 5.0 * core::f64::consts::TAU;
        // counterclockwise as seen from the origin, which is at −n
        let (y, x) = (-turn.sin(), turn.cos());
        along(along(n.map(|n| n * 1.5), s, x + 0.3), t, 0.6 * y)
    });
    (corners, n)
}

// whichever corner stands for several, and whether the polygon faces the surface, contains the zenith or crosses the horizon
#[test]
fn samples_of_polygons_with_repeated_corners_hit_them() {
    let mut random = Random::new(9);
    for _ in 0..300 {
        let (corners, n) = pentagon(&mut random);
        for repeated in 0..5 {
            let corners: [_; 8] = core::array::from_fn(|i| corners[i.min(repeated) + i.saturating_sub(repeated + 3)]);
            let light = Polygon { corners: corners.map(|c| Vec3::<f32>::from(c.map(|x| x as f32))) };
            for receiver in [n, unit(along(n, basis(n).0, 0.2)), unit(along(n, basis(n).0, 2.0))] {
                let receiver = Vec3::from(receiver.map(|x| x as f32));
                let sampler = light.by_projected_solid_angle(Vec3::default(), receiver);
                for _ in 0..4 {
                    let s = sampler.sample(Vec2::new(random.unit(), random.unit()));
                    let pdf = sampler.pdf(s.direction);
                    assert!(
                        s.pdf > 0.0 && pdf == s.pdf,
                        "{corners:?} {receiver:?}: {s:?}, but the direction's pdf is {pdf}"
                    );
                }
            }
        }
    }
}

/// A polygon has the normal of the parallelogram of its corners, whether or not the square of its size is a number.
#[test]
fn polygons_of_any_size_have_their_normal() {
    let o = Vec3::<f32>::default();
    let [c, e, f] = [[0.3, 0.2, 1.0], [1.0, 0.2, -0.1], [-0.3, 0.8, 0.2]].map(Vec3::<f32>::lit);
    for exponent in (-120..=120).step_by(10) {
        let [c, e, f] = [c, e, f].map(|v| v * 2.0_f32.powi(exponent));
        let (polygon, same) = (Polygon::new([c, c + e, c + e + f, c + f]), Parallelogram::new(c, e, f));
        for u in [[0.1, 0.3], [0.97, 0.02]].map(Vec2::from) {
            let (found, truth) = (polygon.by_solid_angle(o).sample(u), same.by_solid_angle(o).sample(u));
            assert!(
                found.pdf > 0.0 && (found.normal - truth.normal).length() < 1e-6,
                "2^{exponent}: {found:?}, {truth:?}"
            );
            assert!((polygon.by_area(o).area() / same.by_area(o).area() - 1.0).abs() < 1e-6 || exponent.abs() > 60);
        }
    }
}

/// From next to any corner, that corner is where it is.
#[test]
fn polygons_have_all_their_corners_in_place() {
    let mut random = Random::new(12);
    for _ in 0..200 {
        let mut vector = || Vec3::<f32>::from(random.direction().map(|x| ((x * 1024.0).round() / 1024.0) as f32));
        let (c, e, f) = (vector(), vector(), vector());
        let corners = [c, c + e, c + e + f, c + f];
        for (corner, distance) in corners.into_iter().flat_map(|c| [1e-2, 1e-4, 1e-6].map(|distance| (c, distance))) {
            let p = Vec3::from(along(corner.at(0), random.direction(), distance).map(|x| x as f32));
            // in 106 bits, from corners that are exact
            let v = corners.map(|c| exact_sum(c.at(0), &[(-p).at(0)]));
            let truth = triangle_solid_angle([v[0], v[1], v[2]]) + triangle_solid_angle([v[0], v[2], v[3]]);
            let found = f64::from(Polygon::new(corners).by_solid_angle(p).solid_angle());
            assert!((found - truth).abs() < 2e-6, "{distance}: {found} for {truth}, {corners:?} from {p:?}");
        }
    }
}
