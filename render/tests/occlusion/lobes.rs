//! What is left of lights by the lobes of rough surfaces.

use etendue::reflection::Reflection;
use etendue::{Parallelogram, Real, Vec2, Vec3, Warp};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};
use etendue_visible::{Occlusion, Solid};
use std::f64::consts::{PI, TAU};

fn vector<R: Real>(v: V3) -> Vec3<R> {
    Coordinates::gather(&[v])
}

/// A rough surface at the origin, and a flat light around a direction that it reflects.
#[derive(Clone, Copy, Debug)]
struct GlossySurface {
    alpha: f64,
    normal: V3,
    view: V3,
    corner: V3,
    edges: [V3; 2],
}

impl GlossySurface {
    fn new(random: &mut Random) -> Self {
        let normal = random.direction();
        let (s, t) = basis(normal);
        let cos = random.magnitude(1e-3, 1.0);
        let turn = TAU * random.unit_f64();
        let flat = along(s.map(|x| x * turn.cos()), t, turn.sin());
        let view = unit(along(normal.map(|x| x * cos), flat, (1.0 - cos * cos).sqrt()));
        let mut place = Self { alpha: random.magnitude(0.03, 1.0), normal, view, corner: normal, edges: [s, t] };
        let u = Vec2::new(random.unit_f64(), random.unit_f64());
        let w: Vec3<f64> = place.reflection().sample(u);
        let distance = random.magnitude(0.5, 20.0);
        let edges = [(); 2].map(|()| random.direction().map(|x| x * random.magnitude(0.02, 2.0)));
        let middle = [w.x, w.y, w.z].map(|x| x * distance);
        place.corner = wide(narrow(along(along(middle, edges[0], -0.5), edges[1], -0.5)));
        place.edges = edges.map(|edge| wide(narrow(edge)));
        place
    }
    fn reflection<R: Real>(&self) -> Reflection<R> {
        Reflection::new(R::lit(self.alpha), vector(self.normal), vector(self.view))
    }
    fn light(&self) -> Solid {
        Solid::Parallelogram { corner: vector(self.corner), edges: self.edges.map(vector) }
    }
}

/// Without occluders, the part of the lobe that a light covers is that of the sampler, and nearly so in single precision.
#[test]
fn whole_lights_have_their_part_of_the_lobe() {
    let mut random = Random::new(4);
    let (mut occlusion, mut wide_occlusion) = (Occlusion::<f32>::new(), Occlusion::<f64>::new());
    let mut worst = 0.0_f64;
    for _ in 0..cases(1000, 10_000) {
        let place = GlossySurface::new(&mut random);
        let (lobe, light, up) = (place.reflection::<f64>(), place.light(), vector(place.normal));
        let [c, u, v] = [place.corner, place.edges[0], place.edges[1]].map(vector::<f64>);
        let wanted = Parallelogram::new(c, u, v).by_reflection(Vec3::default(), &lobe).projected_solid_angle();
        let exact = wide_occlusion.reflected(Vec3::default(), up, &lobe, &light, &[]).expect("one light");
        assert!((exact - wanted).abs() < 1e-7 + 1e-6 * exact, "{place:?}: {exact}, not {wanted}");
        let (lobe, up) = (place.reflection::<f32>(), vector(place.normal));
        let closed = occlusion.reflected(Vec3::default(), up, &lobe, &light, &[]).expect("one light");
        let off = (f64::from(closed) - exact).abs();
        worst = worst.max(off / (exact + 1e-2));
        assert!(off < 3e-5 + 1e-4 * exact, "{place:?}: {closed}, not {exact}");
    }
    println!("greatest error of Occlusion::reflected in single precision {worst:.1e}, of what lights cover and 0.01");
}

/// Behind an occluder, what is left of a light is the quadrature over the points that a ray reaches.
#[test]
fn occluders_hide_their_part_of_the_lobe() {
    let mut random = Random::new(5);
    let mut occlusion = Occlusion::<f64>::new();
    let (mut part, steps) = (0, 300);
    for _ in 0..cases(100, 1_000) {
        let place = GlossySurface::new(&mut random);
        let (corner, [s, t]) = (place.corner, place.edges);
        // a square that covers some of the way to the light
        let middle = along(along(corner, s, random.unit_f64()), t, random.unit_f64()).map(|x| 0.5 * x);
        let (a, b) = basis(unit(middle));
        let half = 0.25 * (length(s) + length(t)) * random.unit_f64();
        let (a, b) = (a.map(|x| x * half), b.map(|x| x * half));
        let from = along(along(middle, a, -1.0), b, -1.0);
        let (lobe, normal) = (place.reflection::<f64>(), cross(s, t));
        let mut truth = 0.0;
        for k in 0..steps * steps {
            let [x, y] = [k / steps, k % steps].map(|i| (f64::from(i) + 0.5) / f64::from(steps));
            let v = along(along(corner, s, x), t, y);
            // where the ray meets the plane of the square, if before the light
            let reach = dot(middle, middle) / dot(v, middle);
            let at = sub(v.map(|c| c * reach), middle);
            let hidden = reach > 0.0 && reach < 1.0 && dot(at, a).abs() < half * half && dot(at, b).abs() < half * half;
            if !hidden {
                truth += lobe.pdf(vector(unit(v))) * dot(v, normal).abs() / length(v).powi(3);
            }
        }
        truth *= PI / f64::from(steps * steps);
        let light = place.light();
        let occluder = Solid::Parallelogram { corner: vector(from), edges: [a, b].map(|e| vector(e.map(|x| 2.0 * x))) };
        let up = vector(place.normal);
        let all = occlusion.reflected(Vec3::default(), up, &lobe, &light, &[]).expect("one light");
        let left = occlusion.reflected(Vec3::default(), up, &lobe, &light, &[occluder]).expect("one occluder");
        part += u32::from(left > 0.02 * all && left < 0.98 * all);
        assert!((left - truth).abs() < 2e-2 * all + 1e-6, "{place:?}: {left}, not {truth}, of {all}");
    }
    assert!(part > 20, "{part} are partly hidden");
    // a sphere before a light, or as a light behind something, has no closed form
    let place = GlossySurface::new(&mut random);
    let lobe = place.reflection::<f64>();
    let ball = |x: f64| Solid::Sphere { center: vector(place.normal.map(|n| n * x)), radius: 0.1 };
    let panel = Solid::Parallelogram {
        corner: vector(along(
            along(place.normal.map(|x| 4.0 * x), basis(place.normal).0, -0.5),
            basis(place.normal).1,
            -0.5,
        )),
        edges: [vector(basis(place.normal).0), vector(basis(place.normal).1)],
    };
    let up = vector(place.normal);
    assert!(occlusion.reflected(Vec3::default(), up, &lobe, &panel, &[ball(2.0)]).is_none());
    assert!(occlusion.visible(Vec3::default(), up, &panel, &[ball(2.0)]).is_some());
}
