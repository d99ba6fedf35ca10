//! Every light by every technique, as an integrator uses it: one trait, one pdf.

use crate::lights::stretch;
use etendue::reflection::Reflection;
use etendue::{
    Lanewise, LightSample, LightSampler, Line, Mask, Parallelogram, PointLight, Polygon, Real, Rectangle, Sphere,
    Triangle, Vec2, Vec3, f32x8,
};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_judge::tolerances::ULP;
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};

/// Clearly out of its plane, or not flat, so that the shape is known to more than rounding.
fn clear(light: &AreaLight) -> bool {
    let (v, b, c) = (wide(light.a), wide(light.b), wide(light.c));
    let normal = if light.shape.has_normal() { b } else { cross(b, c) };
    let flat = !matches!(light.shape, LightShape::Sphere | LightShape::Line | LightShape::Patch);
    let slim = length(cross(b, c)) < 0.05 * length(b) * length(c);
    let low = dot(v, normal).abs() < 1e-2 * length(v) * length(normal);
    !(flat && (low || slim && !light.shape.has_normal()))
}

/// The point and the unit normal at surface coordinates, by their definition. `None` of a disk, whose axes are not defined, and of a line.
fn place(light: &AreaLight, [s, t]: [f64; 2]) -> Option<(V3, V3)> {
    let (a, b, c) = (wide(light.a), wide(light.b), wide(light.c));
    Some(match light.shape {
        LightShape::Disk | LightShape::Line => return None,
        LightShape::Sphere => {
            let (z, (sin, cos)) = (1.0 - 2.0 * s, (core::f64::consts::TAU * t).sin_cos());
            let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
            let n = [r * cos, r * sin, z];
            (along(a, n, light.radius.into()), n)
        }
        LightShape::Patch => {
            let twist = sub(sub(wide(light.n), b), c);
            (light.on_patch([s, t]), unit(cross(along(b, twist, t), along(c, twist, s))))
        }
        _ => (along(along(a, b, s), c, t), unit(cross(b, c))),
    })
}

/// The point of a sample is at its distance in its direction, and there are its normal and its surface coordinates; its density is that of the
/// map; and a ray hits that point.
#[test]
fn samples_and_hits_know_their_place() {
    fn check<R: Real<Scalar = R>>(light: &AreaLight, u: [f64; 2], slack: f64) -> Option<bool> {
        let sampler = AreaLight::prepare::<R>(&[*light]);
        let s = sampler.sample(Vec2::lit(u));
        let (n, uv, distance) = (s.normal.at(0), [s.uv.x, s.uv.y].map(|x| x.lane_f64(0)), s.distance.lane_f64(0));
        if !s.valid().all() {
            return None;
        }
        let said = || format!("{light:?} at {u:?}: {s:?}");
        // the corners of a polygon are rounded
        let slack = if light.shape == LightShape::Polygon { slack.max(1.5e-7) } else { slack };
        assert!(uv.iter().all(|x| (0.0..=1.0).contains(x)) && (length(n) - 1.0).abs() < 1e-5, "{}", said());
        let cos = dot(s.direction.at(0), n).abs();
        if !clear(light) || cos < 0.01 {
            return None;
        }
        let to = s.direction.at(0).map(|x| x * distance);
        // a point that is rounded turns the normal of a small sphere
        let bend = 1.0 + if light.shape == LightShape::Sphere { distance / f64::from(light.radius) } else { 0.0 };
        if let Some((point, normal)) = place(light, uv) {
            let off = length(sub(point, to)) / (distance + length(wide(light.b)));
            assert!(off < 64.0 * slack / cos, "{point:?}, off by {off:e}: {}", said());
            let off = length(sub(normal, n));
            assert!(off < 64.0 * slack * bend / cos, "{normal:?}, off by {off:e}: {}", said());
        }
        let is_round = matches!(light.shape, LightShape::Sphere | LightShape::Disk);
        let size = if is_round { f64::from(light.radius) } else { length(wide(light.c)) };
        let draw = |u: Vec2<f64>| {
            let s = sampler.sample(Vec2::lit([u.x, u.y]));
            (s.direction.at(0), s.pdf.lane_f64(0), s.valid().all())
        };
        if let Some(stretch) = stretch(draw, u).filter(|_| R::DOUBLE && light.shape != LightShape::Line) {
            let off = (stretch - 1.0).abs();
            assert!(off < 5e-4 + 1e-9 * distance / size, "the map stretches {stretch} times the density: {}", said());
        }
        if !R::DOUBLE && light.shape == LightShape::Patch {
            // a rounded direction does not determine the point of a bent surface
            return None;
        }
        let hit = sampler.hit(s.direction);
        let found = hit.distance.lane_f64(0);
        if light.shape == LightShape::Line || light.shape == LightShape::Patch && found < 0.999 * distance {
            // another sheet of the patch hides it, if there is one
            let sheet = light.on_patch([hit.uv.x, hit.uv.y].map(|x| x.lane_f64(0)));
            let off = length(sub(sheet, hit.direction.at(0).map(|x| x * found)));
            assert!(light.shape == LightShape::Line || off < 1e3 * slack * distance / cos, "{hit:?}: {}", said());
            return Some(false);
        }
        let off = (found / distance - 1.0).abs().max(length(sub(hit.normal.at(0), n)) / bend);
        assert!(hit.valid().all() && off < 128.0 * slack / cos, "{hit:?}: {}", said());
        let again = [hit.uv.x, hit.uv.y].map(|x| x.lane_f64(0));
        let off = match place(light, again) {
            Some((point, _)) => length(sub(point, to)) / (distance + length(wide(light.b))),
            None => (again[0] - uv[0]).abs().max((again[1] - uv[1]).abs()) / (1.0 + distance / size),
        };
        // azimuths are known to steps of 2⁻²⁴
        assert!(off < 256.0 * ULP / cos, "off by {off:e}, {hit:?}: {}", said());
        Some(true)
    }
    for (kind, (shape, by)) in AreaLight::kinds().iter().enumerate() {
        let (mut random, mut seen) = (Random::new(300 + kind as u64), [0; 2]);
        for round in 0..500 {
            let light = AreaLight::any(kind, 20 * round, &mut random);
            let mut coordinate = || [0.0, 1.0 - ULP, random.unit_f64(), random.unit_f64()][random.below(4)];
            let u = [coordinate(), coordinate()];
            let found = [check::<f32>(&light, u, 1.5e-7), check::<f64>(&light, u, 1e-9)];
            found.into_iter().flatten().for_each(|is_hit| seen[usize::from(is_hit)] += 1);
            if *shape == LightShape::Sphere {
                // in any unit of length
                for power in [-90, 60] {
                    check::<f32>(&light.scaled(2.0_f32.powi(power)), u, 1.5e-7);
                }
            }
        }
        let [hidden, hit] = seen;
        assert!(
            *shape == LightShape::Line || hit > 100 && hidden < hit / 10,
            "{shape:?} {by:?}: {hit}, {hidden} hidden"
        );
    }
}

/// Of lights in a slice, each lane takes the one at its index; past the end there is none.
#[test]
fn lights_are_gathered_by_the_indices_of_lanes() {
    let corner = |k: usize| Vec3::new(k as f32, 1.5, -(k as f32));
    let polygons: Vec<Polygon<f32, 5>> = (0..20)
        .map(|k| Polygon::new(core::array::from_fn(|i| Vec3::new(0.1 * i as f32, k as f32, (i * k) as f32))))
        .collect();
    let lines: Vec<Line<f32>> = (0..20).map(|k| Line::new(corner(k), corner(20 - k))).collect();
    let index = [3, 0, 19, 20, 7, 7, u32::MAX, 11];
    let (some, more) = (Polygon::gather::<f32x8>(&polygons, index.into()), Line::gather::<f32x8>(&lines, index.into()));
    for (lane, k) in index.iter().enumerate() {
        let [polygon, line] = [some.map(|x| x.lane(lane)).corners[4], more.edge.lane(lane)];
        let [wanted, end] = [polygons.get(*k as usize).map(|p| p.corners[4]), lines.get(*k as usize).map(|l| l.edge)];
        assert_eq!([polygon, line], [wanted, end].map(Option::unwrap_or_default), "{lane}");
    }
}

/// Lanes without a sample weigh nothing, and no light divides by 0.
#[test]
fn invalid_lanes_weigh_nothing() {
    let zero = Vec3::<f32x8>::lit([0.0; 3]);
    let flat = Triangle::new(zero, Vec3::lit([1.0, 0.0, 0.0]), Vec3::lit([0.0, 1.0, 0.0]));
    let back = Parallelogram::new(Vec3::lit([-1.0, 2.0, -1.0]), Vec3::lit([0.0, 0.0, 2.0]), Vec3::lit([2.0, 0.0, 0.0]));
    let bulb = Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), f32x8::splat(-1.0));
    let u = Vec2::lit([0.3, 0.6]);
    for (name, s) in [
        ("a point in the plane", flat.by_solid_angle(zero).sample(u)),
        ("a point in the plane, by area", flat.by_area(zero).sample(u)),
        ("behind", back.by_solid_angle(zero).sample(u)),
        ("behind, by area", back.by_area(zero).sample(u)),
        ("a negative radius", bulb.by_solid_angle(zero).sample(u)),
        ("a negative radius, by projected solid angle", bulb.by_projected_solid_angle(zero, zero).sample(u)),
    ] {
        assert_eq!(s.weight(), f32x8::splat(0.0), "{name}: {s:?}");
        assert!(!s.valid().any(), "{name}");
        assert_eq!(s.lane(3).weight(), 0.0, "{name}");
    }
    // from behind the pdf is positive: the light may emit from both sides
    let s = back.by_solid_angle(zero).sample(u);
    assert!(s.pdf.lane(0) > 0.0 && s.two_sided().valid().all());
    assert_eq!(s.two_sided().weight(), f32x8::splat(1.0) / s.pdf);
}

/// The point is beside the middle of an edge, as near to it as a millionth of its length: samples on that edge belong to the rectangle.
/// Its ends are seen in nearly opposite directions, so that rounding turns the plane through it.
#[test]
fn edges_beside_the_point_belong_to_their_rectangle() {
    let mut random = Random::new(60);
    for _ in 0..20_000 {
        let s = random.direction();
        let t = unit(cross(s, random.direction()));
        let n = cross(s, t);
        let near = |random: &mut Random| 10.0_f64.powf(-6.0 * random.unit_f64());
        let length = random.magnitude(1e-7, 10.0);
        let other = length * random.magnitude(1e-2, 1e2);
        let (along, height) = (-length * random.range(0.3, 0.7), length * near(&mut random));
        // the first edge of this direction, or the second
        let (first, off) = (random.word().is_multiple_of(2), length * near(&mut random));
        let across = if first { off } else { -other - off };
        let corner: [f64; 3] = core::array::from_fn(|k| along * s[k] + across * t[k] + height * n[k]);
        let number = random.range(0.3, 0.7) as f32;
        let end = if first { 0.0 } else { f32::ONE_MINUS_EPSILON };
        let edges = [s.map(|x| (x * length) as f32), t.map(|x| (x * other) as f32)];
        for (u, v, number) in
            [(edges[0], edges[1], Vec2::new(number, end)), (edges[1], edges[0], Vec2::new(end, number))]
        {
            let rectangle = Rectangle::new(corner.map(|x| x as f32).into(), u.into(), v.into());
            let sampler = rectangle.by_solid_angle(Vec3::from([0.0; 3]));
            let sample = sampler.sample(number);
            let pdf = sampler.pdf(sample.direction);
            assert_eq!(pdf, sample.pdf, "{rectangle:?} at {number:?}: {sample:?}");
        }
    }
}

/// A receiver, the vertices of a triangle, and two random numbers.
type Found = ([f64; 3], [[f64; 3]; 3], [f64; 2]);

/// Found by fuzzing: one vertex far beyond the others, and two at very different distances in nearly one
/// direction.
const FOUND: [Found; 2] = [
    (
        [0.0, 1.347_311_735_153_198_2, 0.0],
        [
            [1.617_728_710_174_560_5, 0.0, 0.0],
            [-1_563.784_912_109_375, 127_089.703_125, 410_030.25],
            [0.982_470_512_390_136_7, 0.0, 0.0],
        ],
        [0.164_111_137_390_136_72, 0.353_620_648_384_094_24],
    ),
    (
        [0.0, -30.619_531_631_469_727, 0.0],
        [
            [0.0, 1.943_580_389_022_827_1, -1.032_641_172_409_057_6],
            [41_957_179_392.0, -0.107_558_250_427_246_1, 1.708_413_758_419_763_2e16],
            [1.943_580_389_022_827_1, -1.032_641_172_409_057_6, 41_957_179_392.0],
        ],
        [0.426_593_661_308_288_6, 0.999_999_940_395_355_2],
    ),
];

/// Slivers of any width, among them one found by fuzzing: a sampler returns the pdf of its directions, and has samples all along a sliver, or none.
#[test]
fn slivers_have_one_pdf() {
    fn check<R: Real<Scalar = R>>() {
        let one_pdf = |sampler: &dyn LightSampler<R>, u: Vec2<R>, what: &str| {
            let s = sampler.sample(u);
            let (pdf, again) = (s.pdf.lane_f64(0), sampler.pdf(s.direction).lane_f64(0));
            assert!(pdf.is_finite() && pdf.to_bits() == again.to_bits(), "{what}: {s:?}, {again:e}");
            s
        };
        let p = Vec3::<R>::default();
        for (p, vertices, u) in FOUND {
            let [a, b, c] = vertices.map(Vec3::<R>::lit);
            one_pdf(&Triangle::new(a, b, c).by_solid_angle(Vec3::lit(p)), Vec2::lit(u), &format!("{vertices:?}"));
        }
        let edges = [[-1e-30, 8.978_338e-39, -7.627_898e-27], [0.020_098_03; 3]].map(Vec3::lit);
        let found = Parallelogram::new(Vec3::lit([1.000_000_1, -0.017_785_061, -1.0]), edges[0], edges[1]);
        let mut random = Random::new(61);
        for i in 0..40_000 {
            let width = 10.0_f64.powi(-(i % 40));
            let [origin, across, along] = [(); 3].map(|()| random.direction());
            let [n, a, b] = [origin, across.map(|x| x * width), along].map(Vec3::<R>::lit);
            let (a, b) = if random.word().is_multiple_of(2) { (a, b) } else { (b, a) };
            let light = if i == 0 { found } else { Parallelogram::new(n, a, b) };
            let Parallelogram { corner, edge_s, edge_t } = light;
            let triangle = Triangle { v0: corner, e1: edge_s, e2: edge_t };
            let u = Vec2::new(random.unit(), random.unit()).map(|x| R::lit(f64::from(x)));
            let what = format!("{light:?} {u:?}");
            // with one vertex far away
            let distant = Triangle { e1: a * R::lit(1e6 / width.max(1e-7)), ..triangle };
            one_pdf(&distant.by_solid_angle(p), u, &format!("{distant:?} {u:?}"));
            one_pdf(&light.by_area(p), u, &what);
            one_pdf(&triangle.by_area(p), u, &what);
            one_pdf(&light.by_projected_solid_angle(p, n), u, &what);
            one_pdf(&triangle.by_projected_solid_angle(p, n), u, &what);
            let samplers: [&dyn LightSampler<R>; 2] = [&light.by_solid_angle(p), &triangle.by_solid_angle(p)];
            for sampler in samplers {
                let s = one_pdf(sampler, u, &what);
                // the edges, and where the long one begins, are clearly apart
                let clear = length(cross(across, along)) > 0.1 && length(cross(origin, along)) > 0.1;
                let clear = i > 0 && clear && dot(origin, cross(across, along)).abs() > 0.1;
                assert!(!clear || width < 1e-17 || s.pdf.lane_f64(0) > 0.0, "{what}: {s:?}");
                if clear && s.pdf.lane_f64(0) > 0.0 {
                    let [start, end] =
                        [0.0, 0.999].map(|x| sampler.sample(Vec2::new(R::lit(0.5), R::lit(x))).direction);
                    assert!((end - start).length().lane_f64(0) > 0.01, "{what}: {start:?} to {end:?}");
                }
            }
        }
    }
    check::<f32>();
    check::<f64>();
}

/// A number that is none in a light, in the point, in its normal or among the random numbers leaves neither samples nor densities nor hits.
#[test]
fn what_is_no_number_gives_no_light() {
    let mut random = Random::new(77);
    let others = [
        (LightShape::Sun, Measure::SolidAngle),
        (LightShape::PointLight, Measure::Delta),
        (LightShape::SpotLight, Measure::Delta),
        (LightShape::DirectionalLight, Measure::Delta),
    ];
    let mut lost = [0; 2];
    for round in 0..20 {
        for (shape, by) in AreaLight::kinds().iter().copied().chain(others) {
            let kind = AreaLight::kinds().iter().position(|kind| *kind == (shape, by)).unwrap_or(0);
            let light = AreaLight { shape, by, ..AreaLight::any(kind, round, &mut random) };
            let u = Vec2::new(random.unit(), random.unit());
            let (drawn, any) = (AreaLight::prepare::<f32>(&[light]).sample(u).direction, random.direction());
            let observe = |light: AreaLight, u: Vec2<f32>| {
                let sampler = AreaLight::prepare::<f32>(&[light]);
                let s = sampler.sample(u);
                let found = [drawn, Coordinates::gather(&[any])].map(|w| [sampler.pdf(w), sampler.hit(w).weight()]);
                ([s.weight(), s.pdf], found)
            };
            let before = observe(light, u);
            for field in 0..16 {
                let mut broken = light;
                let AreaLight { p, a, b, c, n, radius, .. } = &mut broken;
                *p.iter_mut().chain(a).chain(b).chain(c).chain(n).chain([radius]).nth(field).unwrap() = f32::NAN;
                let after = observe(broken, u);
                // a number that the light does not have changes nothing
                let nothing = after == ([0.0; 2], [[0.0; 2]; 2]);
                assert!(nothing || after == before, "{broken:?}: {after:?}");
                lost[0] += u32::from(nothing && before.0[0] > 0.0);
            }
            for broken in [Vec2::new(f32::NAN, u.y), Vec2::new(u.x, f32::NAN)] {
                let (after, _) = observe(light, broken);
                assert!(after == [0.0; 2] || after == before.0, "{light:?} at {broken:?}: {after:?}");
                lost[1] += u32::from(after[1] == 0.0 && before.0[1] > 0.0);
            }
        }
    }
    assert!(lost[0] > 1000 && lost[1] > 500, "{lost:?}");
}

/// Nor does it where samples are drawn by a lobe.
#[test]
fn what_is_no_number_leaves_no_samples_of_lobes() {
    /// A point, three vectors, a normal's height, a radius and two random numbers.
    type Numbers = [f32; 16];
    fn vectors(x: &Numbers) -> [Vec3<f32>; 4] {
        [0, 3, 6, 9].map(|k| Vec3::new(x[k], x[k + 1], x[k + 2]))
    }
    fn sample<S: LightSampler<f32>>(x: &Numbers, by: impl FnOnce(&Reflection<f32>) -> S) -> LightSample<f32> {
        let lobe = Reflection::new(0.5, Vec3::new(0.0, x[12], 0.0), Vec3::new(0.0, 0.8, 0.6));
        by(&lobe).sample(Vec2::new(x[14], x[15]))
    }
    type Sample = fn(&Numbers, [Vec3<f32>; 4]) -> LightSample<f32>;
    let samples: [(&str, Sample); 5] = [
        ("sphere", |x, [p, a, ..]| sample(x, |lobe| Sphere::new(a, x[13]).by_reflection(p, lobe))),
        ("triangle", |x, [p, a, b, c]| sample(x, |lobe| Triangle { v0: a, e1: b, e2: c }.by_reflection(p, lobe))),
        ("parallelogram", |x, [p, a, b, c]| sample(x, |lobe| Parallelogram::new(a, b, c).by_reflection(p, lobe))),
        ("rectangle", |x, [p, a, b, c]| sample(x, |lobe| Rectangle::new(a, b, c).by_reflection(p, lobe))),
        ("polygon", |x, [p, a, b, c]| sample(x, |lobe| Polygon::new([a, a + b, a + c]).by_reflection(p, lobe))),
    ];
    let right = [0.0, 0.0, 0.0, 0.3, 2.0, 0.4, 1.0, 0.0, 0.0, 0.0, 0.1, 1.0, 1.0, 0.25, 0.3, 0.6];
    for (name, sample) in samples {
        let before = sample(&right, vectors(&right));
        let mut lost = 0;
        for number in 0..right.len() {
            let mut broken = right;
            broken[number] = f32::NAN;
            let after = sample(&broken, vectors(&broken));
            let is_ignored = (after.pdf, after.direction) == (before.pdf, before.direction);
            let nothing = after.pdf == 0.0 && after.weight() == 0.0;
            assert!(nothing || is_ignored, "{name}: number {number} is NaN, and the pdf {}", after.pdf);
            lost += u32::from(nothing);
        }
        assert!(before.pdf > 0.0 && lost >= 8, "{name}: {lost} numbers count, {before:?}");
    }
}

/// A sample that is mixed of two has each lane of the one that the mask names, whether it emits and whether it is of a delta light included.
#[test]
fn mixed_samples_have_the_lanes_of_both() {
    let (at, u) = (Vec3::lit([0.0; 3]), Vec2::lit([0.3, 0.6]));
    let ball = Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), f32x8::splat(0.5)).by_solid_angle(at).sample(u);
    let lamp = PointLight::new(Vec3::lit([1.0, 1.0, 0.0])).by_delta(at).sample(u);
    let first = f32x8::from([1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0]).gt(f32x8::splat(0.5));
    for (mask, [yes, no]) in [(first, [ball, lamp]), (first, [lamp, ball]), (!first, [ball, lamp])] {
        let mixed = LightSample::blend(mask, yes, no);
        for i in 0..8 {
            let of = if mask.lane(i) { yes } else { no };
            assert_eq!(format!("{:?}", mixed.lane(i)), format!("{:?}", of.lane(i)), "lane {i}");
        }
    }
}
