//! Sets of lights of all kinds.

mod points;

use etendue::light::{Affine, EnvironmentMap, Rotated};
use etendue::lights::{Emitter, Lights, LightsSample, Number, Receiver, Side, Which};
use etendue::owned::OwnedEnvironment;
use etendue::sequence::{Independent, Sequence};
use etendue::{
    BilinearPatch, ConstantEnvironment, DirectionalLight, Disk, Frame, Line, Parallelogram, PointLight, Polygon, Real,
    Rectangle, Sphere, SpotLight, Sun, Triangle, Vec2, Vec3, Warp, warp::UniformSphere,
};
use etendue_judge::stats;
use etendue_oracle::tier::cases;

type V<R> = Vec3<R>;

fn v<R: Real>(v: [f64; 3]) -> V<R> {
    Vec3::lit(v)
}

fn numbers<R: Real<Scalar = R, Uint = u32>>(seed: u32, i: u32) -> [R; 3] {
    let pair = |dimension| -> Vec2<R> { Independent::new(seed.into()).pair(0, i, dimension) };
    let (a, b) = (pair(0), pair(1));
    [a.x, a.y, b.x]
}

fn ellipsoid<R: Real>() -> Affine<Sphere<R>, R> {
    let axes = [[1.0, 0.2, 0.0], [0.0, 0.4, 0.1], [-0.3, 0.0, 0.6]].map(v);
    Affine::new(Sphere::new(v([0.1, 0.2, 0.0]), R::lit(0.9)), axes, v([1.5, 2.5, -0.5]))
}

/// A sky of different texels.
fn image() -> OwnedEnvironment {
    let weights: Vec<f32> = (0..32).map(|i| 0.2 + (i * 7 % 11) as f32).collect();
    OwnedEnvironment::new(&weights, 8, EnvironmentMap::Equirectangular).unwrap()
}

/// One light of each kind with its radiance, all of which reach the origin from above y = 0.
fn every<R: Real<Scalar = R>>() -> Vec<(Emitter<R>, R)> {
    let down = v([0.0, -1.0, 0.0]);
    let corners = [[-2.0, 2.0, 1.0], [-1.0, 2.0, 1.0], [-0.5, 2.0, 1.7], [-1.0, 2.0, 2.5], [-2.0, 2.0, 2.0]].map(v);
    let disk = Disk::new(v([0.0, 0.0, 0.0]), v([0.0, 0.0, 1.0]), R::lit(0.7));
    let axes = [[1.0, 0.0, 0.2], [0.0, 0.3, 0.5], [0.0, 0.8, 0.0]].map(v);
    let triangles = (0..5).map(|i| {
        let x = f64::from(i) - 2.0;
        Triangle::new(v([x, 3.0, -2.0]), v([x + 0.8, 3.0, -2.0]), v([x, 2.0, -3.0]))
    });
    let lights: Vec<Emitter<R>> = vec![
        Sphere::new(v([0.0, 3.0, 0.0]), R::lit(0.8)).into(),
        Emitter::from(Triangle::new(v([1.0, 1.0, 1.0]), v([2.0, 1.5, 1.0]), v([1.0, 1.0, 2.0]))).facing(down),
        Emitter::from(Parallelogram::new(v([-3.0, 1.0, -1.0]), v([1.0, 0.5, 0.0]), v([0.2, 0.0, 1.0]))).facing(down),
        Emitter::from(Rectangle::new(v([-1.0, 4.0, -1.0]), v([2.0, 0.0, 0.0]), v([0.0, 0.0, 1.5]))).two_sided(),
        Emitter::from(Disk::new(v([2.0, 2.0, -2.0]), v([0.0, -1.0, 0.0]), R::lit(0.6))).facing(down),
        Emitter::from(Polygon::new(corners)).facing(down),
        Emitter::from(BilinearPatch::new(
            v([3.0, 1.0, 0.0]),
            v([1.0, 0.0, 0.0]),
            v([0.0, 0.3, 1.0]),
            v([1.0, 0.6, 1.0]),
        ))
        .two_sided(),
        Line::new(v([-1.0, 1.0, 2.0]), v([1.5, 0.5, 0.0])).into(),
        ellipsoid().into(),
        Emitter::from(Affine::new(disk, axes, v([-2.5, 2.0, -2.0]))).facing(down),
        Emitter::group(triangles).facing(down),
        PointLight::new(v([0.5, 1.0, 0.5])).into(),
        SpotLight::new(
            v([0.0, 2.0, 1.0]),
            v([0.0, -0.894_427_190_999_915_9, -0.447_213_595_499_957_9]),
            [R::lit(0.1), R::lit(0.4)],
        )
        .into(),
        SpotLight::new(v([0.0, 2.0, 0.0]), down, [R::lit(1e-6), R::lit(1e-5)]).into(),
        DirectionalLight::new(v([0.6, 0.8, 0.0])).into(),
        Sun::new(v([0.0, 0.8, 0.6]), R::lit(0.02)).into(),
        ConstantEnvironment.into(),
        // with the image's zenith along x
        Rotated {
            sampler: image(),
            frame: Frame { s: v([0.0, 0.0, 1.0]), t: v([0.0, 1.0, 0.0]), n: v([1.0, 0.0, 0.0]) },
        }
        .into(),
    ];
    lights.into_iter().zip(0..).map(|(light, i)| (light, R::lit(1.0 + 0.3 * f64::from(i)))).collect()
}

fn up<R: Real>() -> Side<R> {
    Side::Surface(v([0.0, 1.0, 0.0]))
}

/// The mean of numbers, and its standard error.
fn mean(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let values: Vec<f64> = values.collect();
    assert!(values.iter().all(|x| x.is_finite()));
    let (mean, variance) = stats::mean_variance(&values);
    [mean, (variance / values.len() as f64).sqrt()]
}

/// The mean of L cosθ · weight over samples, and its standard error; without a normal, of L · weight.
fn estimate<R: Number + Real<Uint = u32>>(
    lights: &[(Emitter<R>, R)],
    side: Side<R>,
    point: V<R>,
    seed: u32,
) -> [f64; 2] {
    let set = Lights::new(lights.iter().cloned()).unwrap();
    let at = set.at(Receiver { point, side, on: None });
    mean((0..cases(30_000, 1_000_000)).map(|i| {
        let s = at.sample(numbers(seed, i));
        let cos = match side {
            Side::Surface(n) => s.direction.dot(n).lane_f64(0).max(0.0),
            _ => 1.0,
        };
        lights[s.which.light as usize].1.lane_f64(0) * cos * s.weight().lane_f64(0)
    }))
}

fn agree([a, error]: [f64; 2], [b, other]: [f64; 2], what: &str) {
    let deviation = (error * error + other * other).sqrt();
    assert!((a - b).abs() <= 5.0 * deviation + 1e-5 * b.abs(), "{what}: {a} ± {error}, {b} ± {other}");
}

/// The set of all lights has the sum of what each has alone, above a surface, and all around.
#[test]
fn a_set_has_the_sum_of_its_lights() {
    fn check<R: Number + Real<Uint = u32>>(side: Side<R>) {
        let all = every::<R>();
        let mut sum = [0.0; 2];
        for (light, seed) in all.iter().zip(100..) {
            let [mean, error] = estimate(std::slice::from_ref(light), side, v([0.0; 3]), seed);
            assert!(mean > 0.0, "{light:?}");
            sum = [sum[0] + mean, (sum[1] * sum[1] + error * error).sqrt()];
        }
        agree(estimate(&all, side, v([0.0; 3]), 1), sum, &format!("{side:?}"));
    }
    for side in [up(), Side::Both, Side::None] {
        check::<f32>(side);
    }
    check::<f64>(up());
}

/// What is known in closed form: a sphere overhead, a square by Lambert, a point, a sun, a sky, a directional light.
#[test]
fn single_lights_agree_with_closed_forms() {
    let square = Emitter::from(Rectangle::new(v([-1.0, 1.0, -1.0]), v([2.0, 0.0, 0.0]), v([0.0, 0.0, 2.0])));
    // the form factor of a unit square to the foot of its corner at the distance 1, four times
    let corner = 2.0 * (1.0 / 2.0_f64.sqrt()) * (1.0 / 2.0_f64.sqrt()).atan() / 2.0;
    let pi = std::f64::consts::PI;
    let known: [(Emitter<f64>, f64); 6] = [
        (Sphere::new(v([0.0, 2.0, 0.0]), 1.0).into(), pi * 0.25),
        (square.facing(v([0.0, -1.0, 0.0])), 4.0 * corner),
        (PointLight::new(v([1.0, 1.0, 1.0])).into(), 1.0 / (3.0 * 3.0_f64.sqrt())),
        (Sun::new(v([0.6, 0.8, 0.0]), 0.1).into(), pi * 0.1 * 1.9 * 0.8),
        (ConstantEnvironment.into(), pi),
        (DirectionalLight::new(v([0.6, 0.8, 0.0])).into(), 0.8),
    ];
    for (light, truth) in known {
        agree(estimate(&[(light.clone(), 1.0)], up(), v([0.0; 3]), 7), [truth, 1e-7], &format!("{light:?}"));
    }
}

/// Rays that leave a light carry its irradiance: through a disk before it they bring the power that sampling from the points of the disk finds.
#[test]
fn emitted_rays_carry_the_irradiance_of_their_light() {
    fn check<R: Number + Real<Uint = u32>>() {
        let (n, scene) = (cases(40_000, 1_000_000) as u32, Sphere::new(v([0.0; 3]), R::lit(3.0)));
        for (i, (light, radiance)) in every::<R>().into_iter().enumerate() {
            // the narrow spot light meets a dot
            let radius = R::lit(if i == 13 { 1e-4 } else { 2.0 });
            let lights = Lights::new([(light, radiance)]).unwrap();
            let leaves =
                |part: u32| lights.emit(Which { light: 0, part }, [R::lit(0.3); 4], scene).pdf.lane_f64(0) > 0.0;
            let parts = (0..).take_while(|&part| leaves(part));
            let parts = parts.count() as u32;
            let samples = (0..n).map(|k| {
                let ([a, b, c], [d, e, f]) = (numbers::<R>(i as u32, k), numbers::<R>(i as u32 + 100, k));
                let ray = lights.emit(Which { light: 0, part: k % parts }, [a, b, d, e], scene);
                // down through the disk
                let at = ray.direction.mul_add(-ray.origin.y / ray.direction.y, ray.origin);
                let hits = ray.direction.y.lt(R::lit(0.0)) & ray.origin.y.gt(R::lit(0.0)) & at.length().lt(radius);
                let disk = etendue::warp::ConcentricDisk.sample(Vec2::new(c, f)) * radius;
                let point = Vec3::new(disk.x, R::lit(0.0), disk.y);
                let s = lights.at(Receiver { point, side: up(), on: None }).sample([a, b, d]);
                let irradiance = s.weight() * s.direction.y.greater(R::lit(0.0));
                let power = irradiance * radius * radius * R::lit(core::f64::consts::PI);
                [ray.weight.keep(hits) * R::lit(f64::from(parts)), power].map(|x| x.lane_f64(0))
            });
            let both: Vec<_> = samples.collect();
            let [rays, samples] = [0, 1].map(|which| mean(both.iter().map(|pair| pair[which])));
            agree(rays, samples, &format!("light {i}"));
            assert!(rays[0] > 0.0, "light {i}");
        }
    }
    check::<f32>();
    check::<f64>();
}

/// The density of a ray that leaves a surface is cosθ/π over the area, half of that if both sides emit; its weight is the cosine over it.
#[test]
fn rays_leave_surfaces_with_the_density_of_cosine_and_area() {
    let half = |a: [f64; 3], b: [f64; 3]| 0.5 * v::<f64>(a).cross(v(b)).length();
    let pi = std::f64::consts::PI;
    // the areas of the first six lights, and of the triangles of the mesh
    let fan =
        [([1.0, 0.0, 0.0], [1.5, 0.0, 0.7]), ([1.5, 0.0, 0.7], [1.0, 0.0, 1.5]), ([1.0, 0.0, 1.5], [0.0, 0.0, 1.0])];
    let areas = [
        (0, 4.0 * pi * 0.64),
        (1, half([1.0, 0.5, 0.0], [0.0, 0.0, 1.0])),
        (2, 2.0 * half([1.0, 0.5, 0.0], [0.2, 0.0, 1.0])),
        (3, 2.0 * 3.0),
        (4, pi * 0.36),
        (5, fan.into_iter().map(|(a, b)| half(a, b)).sum()),
        (10, half([0.8, 0.0, 0.0], [0.0, -1.0, -1.0])),
    ];
    let (all, scene) = (every::<f64>(), Sphere::new(v([0.0; 3]), 3.0));
    for (light, area) in areas {
        let lights = Lights::new([all[light].clone()]).unwrap();
        for k in 0..200 {
            let ([a, b, c], [d, ..]) = (numbers(3, k), numbers(4, k));
            let ray = lights.emit(Which { light: 0, part: 0 }, [a, b, c, d], scene);
            let cos = ray.direction.dot(ray.normal);
            assert!((ray.pdf * pi * area / cos - 1.0).abs() < 1e-12, "light {light}: {ray:?}");
            assert!((ray.weight * ray.pdf / cos - 1.0).abs() < 1e-12, "light {light}: {ray:?}");
        }
    }
}
fn bits<R: Real>(x: R) -> u64 {
    x.lane_f64(0).to_bits()
}

/// The pdf of the direction of a sample is its pdf, bit for bit; but of patches and lines. It is the product of the probability of the choice
/// and the pdf of the light alone.
#[test]
fn pdfs_of_directions_are_those_of_samples() {
    fn check<R: Number + Real<Uint = u32>>() {
        let all = every::<R>();
        let set = Lights::new(all.iter().cloned()).unwrap();
        let alone: Vec<_> = all.iter().map(|light| Lights::new([light.clone()]).unwrap()).collect();
        for (side, point) in [(up(), [0.1, 0.0, 0.2]), (Side::None, [0.3, 0.5, 0.0]), (Side::Both, [0.0; 3])] {
            let receiver = Receiver { point: v(point), side, on: None };
            let at = set.at(receiver);
            let mut seen = vec![0; all.len()];
            for i in 0..20_000 {
                let s = at.sample(numbers(5, i));
                seen[s.which.light as usize] += 1;
                let pdf =
                    if i % 2 == 0 { at.pdf(s.which, s.direction) } else { set.at(receiver).pdf(s.which, s.direction) };
                let alone = alone[s.which.light as usize].at(receiver).pdf(0, s.direction);
                match s.which.light {
                    11..=14 => assert_eq!(bits(s.pmf), bits(s.pdf)),
                    // a line has a measure of its own, and the pmf of a mesh is that of the triangle
                    7 | 10 => assert!(s.pmf.lane_f64(0) > 0.0),
                    _ => assert!(
                        ((alone * s.pmf).lane_f64(0) - pdf.lane_f64(0)).abs() <= 1e-6 * pdf.lane_f64(0),
                        "{s:?}"
                    ),
                }
                match s.which.light {
                    // from the side, a direction may meet the patch twice
                    6 if s.direction.dot(s.normal).lane_f64(0) > -0.1 => {}
                    6 => assert!((pdf / s.pdf - R::lit(1.0)).abs().lane_f64(0) < 1e-4, "{pdf:?} {s:?}"),
                    7 | 11..=14 => assert!(s.delta && bits(pdf) == 0),
                    // a direction beside the edge of an ellipsoid may miss it: both are 0 then
                    _ => assert_eq!(bits(pdf), bits(s.pdf), "{s:?}"),
                }
            }
            // the narrow beam does not reach beside its axis
            assert!(seen.iter().zip(0..).all(|(seen, light)| *seen > 0 || light == 13), "{seen:?}");
        }
    }
    check::<f32>();
    check::<f64>();
}

/// Over all lights, the probabilities of lights without an area and the integrals of the pdfs of the others are 1.
#[test]
fn pdfs_integrate_to_1() {
    let mut all = every::<f64>();
    all.retain(|(light, _)| !format!("{light:?}").contains("Line("));
    let set = Lights::new(all.iter().cloned()).unwrap();
    let at = set.at(Receiver { point: v([0.0; 3]), side: up(), on: None });
    let parts = all
        .iter()
        .zip(0..)
        .flat_map(|(_, light)| (0..if light == 9 { 5 } else { 1 }).map(move |part| Which { light, part }));
    let parts: Vec<Which> = parts.collect();
    let [mean, error] = mean((0..cases(40_000, 400_000)).map(|i| {
        let w: V<f64> = UniformSphere.sample(Independent::new(2).pair(0, i, 0));
        parts.iter().map(|which| at.pdf(*which, w)).sum::<f64>() * 4.0 * std::f64::consts::PI
    }));
    let draws = 200_000;
    let deltas = (0..draws).filter(|&i| at.sample(numbers(8, i)).delta).count() as f64 / f64::from(draws);
    let error = error.hypot((deltas / f64::from(draws)).sqrt());
    agree([mean + deltas, error], [1.0, 0.0], "the integral");
    assert!(deltas > 0.02 && error < 0.02, "{deltas} {error}");
}

/// The light that the receiver is on is skipped, of a mesh the triangle alone; and there is no light beyond the last.
#[test]
fn the_own_light_is_skipped() {
    let all = every::<f32>();
    let set = Lights::new(all.iter().cloned()).unwrap();
    for on in [Which::from(0), Which::from(16), Which { light: 10, part: 3 }] {
        let at = set.at(Receiver { point: v([0.0; 3]), side: up(), on: Some(on) });
        let mut others = 0;
        for i in 0..20_000 {
            let s = at.sample(numbers(6, i));
            assert_eq!(s.which == on, s.which == on && s.pdf == 0.0 && s.weight() == 0.0);
            others += u32::from(s.which.light == on.light && s.which != on && s.weight() > 0.0);
            assert_eq!(at.pdf(on, s.direction), 0.0);
        }
        assert_eq!(others > 0, on.light == 10, "{others}");
        for beyond in
            [Which::from(18), Which::from(u32::MAX), Which { light: 10, part: 5 }, Which { light: 0, part: u32::MAX }]
        {
            assert_eq!(at.pdf(beyond, v([0.0, 1.0, 0.0])), 0.0);
        }
    }
}

/// A triangle emits from the side that the order of its vertices tells, from the other one if a host asks for that, or from both.
#[test]
fn lights_emit_from_the_sides_that_they_are_told() {
    let lamp = || Emitter::<f32>::from(Triangle::new(v([-1.0, 1.0, -1.0]), v([1.0, 1.0, -1.0]), v([0.0, 1.0, 1.0])));
    // counterclockwise as seen from below
    let sides = [
        (lamp(), [1, 0]),
        (lamp().facing(v([0.1, -1.0, 0.0])), [1, 0]),
        (lamp().facing(v([0.1, 1.0, 0.0])), [0, 1]),
        (lamp().two_sided(), [1, 1]),
        (lamp().two_sided().facing(v([0.0, 1.0, 0.0])), [1, 1]),
    ];
    for (light, expected) in sides {
        let set = Lights::new([(light.clone(), 1.0)]).unwrap();
        let lit = [0.0, 2.0].map(|height| {
            let at = set.at(Receiver { point: v([0.0, height, 0.0]), side: Side::None, on: None });
            let s = at.sample([0.5; 3]);
            assert!(s.weight() == 0.0 || s.direction.dot(s.normal) < 0.0, "{s:?}");
            i32::from(s.weight() > 0.0)
        });
        assert_eq!(lit, expected, "{light:?}");
    }
}

/// No input panics or returns what is not finite.
#[test]
fn any_input_gives_finite_samples() {
    fn check<R: Number + Real<Uint = u32>>(extremes: &[f64]) {
        let finite = |s: &LightsSample<R>| {
            let all = [s.direction, s.normal, s.point].into_iter().flat_map(V::to_array).chain([
                s.distance,
                s.pdf,
                s.factor,
                s.weight(),
                s.reach(),
                s.bound,
            ]);
            all.into_iter().all(|x| x.lane_f64(0).is_finite())
        };
        for (case, &a) in extremes.iter().enumerate() {
            for &b in extremes {
                let (p, q) = (v::<R>([a, b, 1.0]), v::<R>([b, 0.0, a]));
                let r = R::lit(b);
                let lights: Vec<Emitter<R>> = vec![
                    Sphere::new(p, r).into(),
                    Triangle::new(p, q, v([0.0; 3])).into(),
                    Parallelogram::new(p, q, p).into(),
                    Rectangle::new(q, p, q).into(),
                    Disk::new(p, q, r).into(),
                    Polygon::new([p, q, v([1.0; 3])]).into(),
                    BilinearPatch::new(p, q, p, q).into(),
                    Line::new(p, q).into(),
                    Affine::new(Sphere::new(p, r), [p, q, p], q).into(),
                    Affine::new(Disk::new(p, q, r), [q, p, v([0.0, 1.0, 0.0])], q).into(),
                    Emitter::group([] as [Triangle<R>; 0]),
                    Emitter::group([Triangle::new(q, p, p)]).facing(p),
                    PointLight::new(p).into(),
                    SpotLight::new(q, p, [r, R::lit(a)]).into(),
                    DirectionalLight::new(p).into(),
                    Sun::new(p, r).into(),
                    ConstantEnvironment.into(),
                    image().into(),
                ];
                let radiances = [1.0, a, b, 1e-30].into_iter().cycle().map(R::lit);
                let set = Lights::new(lights.into_iter().zip(radiances)).unwrap();
                for side in [Side::Surface(p), Side::Both, Side::None, up()] {
                    let at = set.at(Receiver { point: q, side, on: None });
                    for i in 0..40 {
                        let s = at.sample(numbers(case as u32, i));
                        assert!(s.pdf.lane_f64(0) == 0.0 || finite(&s), "{a} {b} {s:?}");
                        assert!(at.pdf(i % 18, s.direction).lane_f64(0).is_finite());
                    }
                    at.sample([R::lit(a), R::lit(b), R::lit(f64::NAN)]);
                }
            }
        }
        let nowhere = Lights::new([(Sun::new(v([0.0; 3]), R::lit(0.5)), R::lit(1.0))]).unwrap();
        let s = nowhere.at(Receiver { point: v([0.0; 3]), side: Side::Both, on: None }).sample([R::lit(0.3); 3]);
        assert_eq!(bits(s.pdf), 0);
        // the square of the distance is subnormal
        for x in [5e-21, 1e-160] {
            let light = Lights::new([(PointLight::new(v([x, 0.0, 0.0])), R::lit(1.0))]).unwrap();
            let s = light.at(Receiver { point: v([0.0; 3]), side: Side::Both, on: None }).sample([R::lit(0.3); 3]);
            assert!(finite(&s), "{s:?}");
        }
        let none = Lights::<R>::new::<Emitter<R>>([]).unwrap();
        assert!(none.is_empty());
        let s = none.at(Receiver { point: v([0.0; 3]), side: up(), on: None }).sample([R::lit(0.5); 3]);
        assert_eq!(bits(s.weight()), 0);
    }
    check::<f32>(&[0.0, 1.0, -1.0, 1e-38, 1e-20, 1e20, 3e38, f64::NAN, f64::INFINITY, 0.3]);
    check::<f64>(&[0.0, 1.0, -1.0, 1e-300, 1e-20, 1e20, 1e300, f64::NAN, f64::INFINITY, 0.3]);
}

/// Sets may be shared among threads and sent to them; a prepared one belongs to its thread. Prepared lights are of the sizes that are stated.
#[test]
fn sets_are_shared() {
    fn shared<T: Send + Sync + Clone>() {}
    fn sent<T: Send + Clone>() {}
    fn copied<T: Send + Sync + Copy>() {}
    shared::<Lights<f32>>();
    shared::<Emitter<f64>>();
    sent::<etendue::lights::LightsAt<'_, f32>>();
    copied::<Receiver<f32>>();
    copied::<LightsSample<f64>>();
    copied::<etendue::light::TriangleBySolidAngle<f32>>();
    copied::<etendue::light::PolygonByProjectedSolidAngle<f64, 8>>();
    copied::<etendue::select::TreeAt<'_, f32>>();
    use etendue::light as by;
    let sizes = [
        size_of::<by::SphereBySolidAngle<f32>>(),
        size_of::<by::TriangleBySolidAngle<f32>>(),
        size_of::<by::RectangleBySolidAngle<f32>>(),
        size_of::<by::ParallelogramBySolidAngle<f32>>(),
        size_of::<by::DiskBySolidAngle<f32>>(),
        size_of::<by::PolygonBySolidAngle<f32, 8>>(),
        size_of::<by::TriangleByProjectedSolidAngle<f32>>(),
        size_of::<by::ParallelogramByProjectedSolidAngle<f32>>(),
        size_of::<by::TriangleBySolidAngle<f64>>() / 2,
    ];
    // as the documentation of the package says
    assert_eq!(sizes, [68, 324, 340, 516, 156, 1796, 656, 1192, 324]);
}
