//! Points of samples, and what lights under maps are.

use super::{V, agree, ellipsoid, estimate, every, mean, numbers, up, v};
use etendue::light::Affine;
use etendue::lights::{Emitter, Lights, Receiver, Side};
use etendue::sequence::{Independent, Sequence};
use etendue::{Disk, Sphere, Warp, warp::UniformSphere};
use etendue_oracle::tier::cases;

/// The point of a sample is as near to the light as it says, by the shape in double precision; and the reach of a shadow ray is near.
#[test]
fn points_are_within_their_bounds() {
    let mut greatest = [0.0_f64; 17];
    for shift in [0.0, 1.0, 300.0] {
        let moved = |a: [f64; 3]| [a[0] + shift, a[1] + shift * 0.5, a[2] - shift];
        let all = every::<f32>();
        for k in [0_usize, 1, 2, 3, 4, 8, 9, 10] {
            let set = Lights::new([all[k].clone()]).unwrap();
            let p = v::<f32>(moved([0.0; 3]));
            let at = set.at(Receiver { point: p, side: Side::None, on: None });
            let exact = distance_from(k);
            for i in 0..cases(2_000, 50_000) {
                let s = at.sample(numbers(4, i));
                if s.pdf == 0.0 {
                    continue;
                }
                let off = exact(s.point.map(f64::from));
                greatest[k] = greatest[k].max(off / f64::from(s.bound));
                assert!(off <= f64::from(s.bound), "{k}: {off} {s:?}");
                assert!(s.bound < 1e-4 && s.reach() <= s.distance, "{s:?}");
            }
        }
    }
    assert!(greatest.iter().any(|x| *x > 0.02), "the bounds are far too wide: {greatest:?}");
}

/// The distance of a point from one of all lights, or from its plane.
fn distance_from(light: usize) -> Box<dyn Fn(V<f64>) -> f64> {
    let f = |a: [f64; 3]| v::<f32>(a).map(f64::from);
    let (on, n) = match light {
        0 => return Box::new(|q| ((q - v([0.0, 3.0, 0.0])).length() - f64::from(0.8_f32)).abs()),
        8 => {
            let lamp = ellipsoid::<f32>();
            let wide = |a: V<f32>| a.map(f64::from);
            let ([x, y, z], origin) = (lamp.axes.map(wide), wide(lamp.origin));
            let (center, radius, volume) = (wide(lamp.shape.center), f64::from(lamp.shape.radius), x.dot(y.cross(z)));
            return Box::new(move |q| {
                let d = q - origin;
                let local = V::new(d.dot(y.cross(z)), d.dot(z.cross(x)), d.dot(x.cross(y))) * (1.0 / volume) - center;
                // the least stretch is more than 0.3
                (local.length() - radius).abs() * 0.3
            });
        }
        1 => (f([1.0, 1.0, 1.0]), f([1.0, 0.5, 0.0]).cross(f([0.0, 0.0, 1.0]))),
        2 => (f([-3.0, 1.0, -1.0]), f([1.0, 0.5, 0.0]).cross(f([0.2, 0.0, 1.0]))),
        3 => (f([-1.0, 4.0, -1.0]), f([0.0, 1.0, 0.0])),
        4 => (f([2.0, 2.0, -2.0]), f([0.0, 1.0, 0.0])),
        9 => (f([-2.5, 2.0, -2.0]), f([1.0, 0.0, 0.2]).cross(f([0.0, 0.3, 0.5]))),
        // of the mesh
        _ => (f([0.0, 3.0, -2.0]), f([0.0, 1.0, -1.0])),
    };
    let n = n.unit_and_length().0;
    Box::new(move |q| (q - on).dot(n).abs())
}

/// A sphere or a disk under a map that keeps angles is one; if it is stretched by a thousandth, it is not.
#[test]
fn round_images_are_spheres_and_disks() {
    let axes = |stretch: f64| [[0.0, 1.2, 1.6], [2.0 * stretch, 0.0, 0.0], [0.0, 1.6, -1.2]].map(v::<f32>);
    let light =
        |stretch| Emitter::from(Affine::new(Sphere::new(v([0.5, 0.0, 0.0]), 0.25), axes(stretch), v([0.0, 3.0, 0.0])));
    assert!(format!("{:?}", light(1.0)).contains("Sphere(Sphere { center: Vec3 { x: 0.0, y: 3.6"));
    assert!(format!("{:?}", light(1.001)).contains("Ellipsoid("));
    let (round, stretched) = ([(light(1.0), 1.0)], [(light(1.001), 1.0)]);
    let [a, b] = [&round, &stretched].map(|lights| estimate(lights, up(), v([0.0; 3]), 11));
    assert!((a[0] / b[0] - 1.0).abs() < 0.004, "{a:?} {b:?}");
    // seen from both sides, by maps that mirror and that do not
    for mirror in [1.0, -1.0] {
        let disk = |stretch| {
            let [x, y, z] = axes(stretch);
            let disk = Disk::new(v([0.5, 0.0, 0.0]), v([0.0, -0.6, 0.8]), 0.25);
            [(Emitter::from(Affine::new(disk, [x * mirror, y, z], v([0.0, 3.0, 0.0]))), 1.0)]
        };
        let [round, stretched] = [disk(1.0), disk(1.001)];
        assert!(format!("{round:?}").contains("shape: Disk(") && format!("{stretched:?}").contains("Ellipse("));
        for side in [up(), Side::Surface(v([0.0, -1.0, 0.0]))] {
            for height in [0.0, 8.0] {
                let [a, b] = [&round, &stretched].map(|lights| estimate(lights, side, v([0.3, height, 0.2]), 12));
                assert!((a[0] - b[0]).abs() <= 0.006 * b[0], "{mirror} {height} {a:?} {b:?}");
            }
        }
    }
}

/// Irradiance of an ellipsoid by directions all around that hit it.
#[test]
fn ellipsoids_are_sampled_as_they_are_seen() {
    let lamp = ellipsoid::<f64>();
    let [x, y, z] = lamp.axes;
    let volume = x.dot(y.cross(z));
    let local = |d: V<f64>| V::new(d.dot(y.cross(z)), d.dot(z.cross(x)), d.dot(x.cross(y))) * (1.0 / volume);
    let p = local(-lamp.origin) - lamp.shape.center;
    let truth = mean((0..cases(400_000, 4_000_000)).map(|i| {
        let w: V<f64> = UniformSphere.sample(Independent::new(9).pair(0, i, 0));
        let d = local(w);
        // the least distance of the line from the centre
        let along = -p.dot(d) / d.length_squared();
        let hit = along > 0.0 && (p + d * along).length() < lamp.shape.radius;
        if hit { w.y.max(0.0) * 4.0 * std::f64::consts::PI } else { 0.0 }
    }));
    agree(estimate(&[(lamp.into(), 1.0)], up(), v([0.0; 3]), 3), truth, "an ellipsoid");
}
