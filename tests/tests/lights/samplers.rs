//! Every light by every technique, as an integrator uses it: one trait, one pdf.

use etendue::reflection::Reflection;
use etendue::{
    Lanewise, LightSample, LightSampler, Line, Mask, Parallelogram, Polygon, Real, Rectangle, Sphere, Triangle, Vec2,
    Vec3, f32x8,
};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::{V3, cross, dot, length, sub, unit, wide};

/// Clearly out of its plane, or not flat, so that the shape is known to more than rounding.
fn clear(light: &AreaLight) -> bool {
    let (v, b, c) = (wide(light.a), wide(light.b), wide(light.c));
    let normal = if light.shape.has_normal() { b } else { cross(b, c) };
    let flat = !matches!(light.shape, LightShape::Sphere | LightShape::Line | LightShape::Patch);
    let slim = length(cross(b, c)) < 0.05 * length(b) * length(c);
    let low = dot(v, normal).abs() < 1e-2 * length(v) * length(normal);
    !(flat && (low || slim && !light.shape.has_normal()))
}

/// A ray hits the point of the sample: distance, normal and surface coordinates agree.
#[test]
fn a_hit_is_the_point_that_was_sampled() {
    for kind in 0..AreaLight::kinds().len() {
        let (shape, by) = AreaLight::kinds()[kind];
        if shape == LightShape::Line {
            continue;
        }
        let mut random = Random::new(300 + kind as u64);
        let (mut seen, mut hidden) = (0, 0);
        for round in 0..500 {
            let light = AreaLight::any(kind, round * 20, &mut random);
            let sampler = AreaLight::prepare::<f64>(&[light]);
            let s = sampler.sample(Vec2::new(random.unit_f64(), random.unit_f64()));
            let cos = dot(s.direction.at(0), s.normal.at(0)).abs();
            if !clear(&light) || !s.valid() || cos < 0.05 {
                continue;
            }
            seen += 1;
            let hit = sampler.hit(s.direction);
            if shape == LightShape::Patch && hit.distance < 0.999 * s.distance {
                // another sheet of the patch hides it, if there is one
                let sheet = light.on_patch([hit.uv.x, hit.uv.y]);
                let ray: [f64; 3] = hit.direction.at(0).map(|x| x * hit.distance);
                assert!(length(sub(sheet, ray)) < 1e-9 * s.distance / cos, "{light:?}: {hit:?} for {s:?}");
                hidden += 1;
                continue;
            }
            let off = (hit.distance / s.distance - 1.0).abs();
            // the normal of a disk has length 1 to the rounding of single precision
            assert!(hit.valid() && off < 1e-6 / cos, "{shape:?} {by:?}: {hit:?} for {s:?}");
            assert!(length(sub(hit.normal.at(0), s.normal.at(0))) < 1e-6, "{shape:?} {by:?}: {hit:?} for {s:?}");
            let [du, dv] = [hit.uv.x - s.uv.x, hit.uv.y - s.uv.y].map(f64::abs);
            let near = |d: f64| d.min(1.0 - d) < 1e-5 / cos;
            assert!(near(du) && near(dv), "{shape:?} {by:?}: {hit:?} for {s:?}");
        }
        assert!(seen > 50 && hidden < seen / 10, "{shape:?} {by:?}: {seen}, and {hidden} hidden");
    }
}

/// Normals are unit vectors, and surface coordinates are in [0, 1], of samples at both ends of `u` too; of spheres in any unit of length.
#[test]
fn samples_know_a_normal_and_a_place() {
    for kind in 0..AreaLight::kinds().len() {
        let mut random = Random::new(700 + kind as u64);
        let powers: &[i32] = if AreaLight::kinds()[kind].0 == LightShape::Sphere { &[-90, 0, 60] } else { &[0] };
        for round in 0..400 {
            let light = AreaLight::any(kind, 20 * round, &mut random);
            let mut coordinate = || [0.0, 1.0 - f32::EPSILON / 2.0, random.unit()][random.word() as usize % 3];
            let u = Vec2::new(coordinate(), coordinate());
            for power in powers {
                let s = AreaLight::prepare::<f32>(&[light.scaled(2.0_f32.powi(*power))]).sample(u);
                let is_inside = [s.uv.x, s.uv.y].iter().all(|x| (0.0..=1.0).contains(x));
                let is_unit = (length(s.normal.at(0)) - 1.0).abs() < 1e-5;
                assert!(!s.valid() || is_inside && is_unit, "by 2^{power}: {light:?} at {u:?}: {s:?}");
            }
        }
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

/// The surface coordinates and the normal of a sample are those of the point at its distance in its direction, in double precision.
#[test]
fn samples_know_their_place() {
    let mut random = Random::new(11);
    let v = |x: [f64; 3]| Vec3::<f32>::from(x.map(|x| x as f32));
    for _ in 0..20_000 {
        let mut a = random.direction().map(|x| 3.0 * x);
        let (b, mut c) = (random.direction(), random.direction());
        // right angles, for rectangles
        let along = dot(b, c);
        c = core::array::from_fn(|k| c[k] - along * b[k]);
        a = a.map(|x| f64::from(x as f32));
        let (u, o) = (Vec2::new(random.unit(), random.unit()), Vec3::default());
        let (triangle, panel) = (Triangle { v0: v(a), e1: v(b), e2: v(c) }, Rectangle::new(v(a), v(b), v(c)));
        let samples = [
            triangle.by_solid_angle(o).sample(u),
            triangle.by_area(o).sample(u),
            Parallelogram::from(panel).by_solid_angle(o).sample(u),
            panel.by_solid_angle(o).sample(u),
            panel.by_area(o).sample(u),
        ];
        for (k, s) in samples.into_iter().enumerate() {
            let cos = dot(s.direction.at(0), s.normal.at(0)).abs();
            let [x, y, _] = s.uv.at(0);
            let (there, here) = (along_edges(a, [b, c], [x, y]), s.direction.at(0).map(|w| w * f64::from(s.distance)));
            let off = length(sub(there, here));
            assert!(s.pdf == 0.0 || off < 1e-5 / cos.max(1e-3), "{k}: {there:?} for {here:?}, off by {off:e}: {s:?}");
            assert!(k > 1 || x + y < 1.0 + 1e-5, "{s:?}");
        }
        let sphere = Sphere::new(v(a), 0.5);
        for s in [sphere.by_solid_angle(o).sample(u), sphere.by_area(o).sample(u)] {
            let normal = sub(s.direction.at(0).map(|w| w * f64::from(s.distance)), a).map(|x| 2.0 * x);
            assert!(length(sub(normal, s.normal.at(0))) < 2e-5, "{normal:?} for {s:?}");
        }
    }
}
fn along_edges(from: V3, [b, c]: [V3; 2], [x, y]: [f64; 2]) -> V3 {
    core::array::from_fn(|k| from[k] + x * b[k] + y * c[k])
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
    struct SphereInLobe {
        vectors: [Vec3<f32>; 4],
        radius: f32,
        reflection: Reflection<f32>,
        u: Vec2<f32>,
    }
    let place = |x: [f32; 16]| {
        let v = |k: usize| Vec3::new(x[k], x[k + 1], x[k + 2]);
        let reflection = Reflection::new(0.5, Vec3::new(0.0, x[12], 0.0), Vec3::new(0.0, 0.8, 0.6));
        SphereInLobe { vectors: [v(0), v(3), v(6), v(9)], radius: x[13], reflection, u: Vec2::new(x[14], x[15]) }
    };
    type Sample = fn(&SphereInLobe) -> LightSample<f32>;
    let samples: [(&str, Sample); 5] = [
        ("sphere", |s| Sphere::new(s.vectors[1], s.radius).by_reflection(s.vectors[0], &s.reflection).sample(s.u)),
        ("triangle", |s| {
            let [p, v0, e1, e2] = s.vectors;
            Triangle { v0, e1, e2 }.by_reflection(p, &s.reflection).sample(s.u)
        }),
        ("parallelogram", |s| {
            let [p, corner, e1, e2] = s.vectors;
            Parallelogram::new(corner, e1, e2).by_reflection(p, &s.reflection).sample(s.u)
        }),
        ("rectangle", |s| {
            let [p, corner, e1, e2] = s.vectors;
            Rectangle::new(corner, e1, e2).by_reflection(p, &s.reflection).sample(s.u)
        }),
        ("polygon", |s| {
            let [p, corner, e1, e2] = s.vectors;
            Polygon::new([corner, corner + e1, corner + e2]).by_reflection(p, &s.reflection).sample(s.u)
        }),
    ];
    #[rustfmt::skip]
    let right = [
        0.0, 0.0, 0.0,  0.3, 2.0, 0.4,  1.0, 0.0, 0.0,  0.0, 0.1, 1.0,
        1.0,  0.25,  0.3, 0.6,
    ];
    for (name, sample) in samples {
        let before = sample(&place(right));
        let mut lost = 0;
        for number in 0..right.len() {
            let mut broken = right;
            broken[number] = f32::NAN;
            let after = sample(&place(broken));
            let is_ignored = (after.pdf, after.direction) == (before.pdf, before.direction);
            let nothing = after.pdf == 0.0 && after.weight() == 0.0;
            assert!(nothing || is_ignored, "{name}: number {number} is NaN, and the pdf {}", after.pdf);
            lost += u32::from(nothing);
        }
        assert!(before.pdf > 0.0 && lost >= 8, "{name}: {lost} numbers count, {before:?}");
    }
}
