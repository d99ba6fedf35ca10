//! Bounds of lights: against 106-bit arithmetic, at all sizes and distances.

use core::f64::consts::PI;
use etendue::light::Polygon;
use etendue::select::LightBound;
use etendue::{BilinearPatch, Disk, Line, Parallelogram, PointLight, Rectangle, Sphere, SpotLight, Triangle, Vec3};
use etendue_judge::generators::Random;
use etendue_oracle::double_double::{Dd, dd};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, cross, dot, gauss_legendre, length, narrow, unit, wide};

/// Three vectors of a size, the first of which is up to 10⁶ times as long as the others.
fn vectors(random: &mut Random) -> [[f32; 3]; 3] {
    let size = random.magnitude(1e-20, 1e20);
    let far = random.magnitude(1e-2, 1e6);
    let slim = random.magnitude(1e-3, 1.0);
    [size * far, size, size * slim].map(|length| narrow(random.direction().map(|x| x * length)))
}

/// The distance of corner + offset from the centre of a bound.
fn distance(bound: &LightBound, corner: [f32; 3], offset: [Dd; 3]) -> Dd {
    let (corner, center) = (dd(wide(corner)), dd(wide(bound.center)));
    let square = (0..3).map(|k| corner[k] + offset[k] - center[k]).map(|x| x * x);
    square.fold(Dd::default(), |sum, x| sum + x).sqrt()
}

/// The sphere holds all points, and is no larger than the farthest one asks for; the power is that of the light.
fn check(bound: LightBound, corner: [f32; 3], offsets: &[V3], flux: f64) {
    // no corner is rounded
    let reaches = offsets.iter().map(|&offset| distance(&bound, corner, dd(offset)));
    let radius = Dd::from(f64::from(bound.radius));
    let mut most = 0.0_f64;
    for reach in reaches {
        assert!((radius - reach).to_f64() >= 0.0, "{bound:?} {corner:?} {offsets:?}");
        most = most.max(reach.to_f64());
    }
    assert!(f64::from(bound.radius) <= most * (1.0 + 2.0 * f64::from(f32::EPSILON)), "{bound:?} {most:e}");
    let wanted = flux.clamp(f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX));
    assert!((f64::from(bound.power) / wanted - 1.0).abs() < 2e-7, "{bound:?}, {flux:e}");
}

#[test]
fn bounds_hold_lights_of_all_sizes() {
    let mut random = Random::new(1);
    for _ in 0..cases(20_000, 400_000) {
        let [a, b, c] = vectors(&mut random);
        let radiance = random.magnitude(1e-3, 1e3) as f32;
        let (s, t, zero) = (wide(b), wide(c), [0.0; 3]);
        let [p, u, v] = [a, b, c].map(Vec3::from);
        let both: V3 = core::array::from_fn(|k| s[k] + t[k]);
        let (area, normal) = (length(cross(s, t)), unit(cross(s, t)));
        let faces = |bound: LightBound| {
            let off: V3 = core::array::from_fn(|k| f64::from(bound.normal[k]) - normal[k]);
            assert!(length(off) < 2e-7, "{bound:?} {normal:?}");
            bound
        };
        let flux = PI * f64::from(radiance);
        check(faces(Triangle { v0: p, e1: u, e2: v }.bound(radiance)), a, &[zero, s, t], 0.5 * area * flux);
        let panel = Parallelogram::new(p, u, v);
        check(faces(panel.bound(radiance)), a, &[zero, s, both, t], area * flux);
        assert_eq!(Rectangle::new(p, u, v).bound(radiance), panel.bound(radiance));
        let patch = BilinearPatch::new(p, u, v, u + v).bound(radiance);
        let opposite = wide((u + v).to_array());
        check(patch, a, &[zero, s, opposite, t], f64::from(patch.power));
        assert!(patch.normal == [0.0; 3]);
        // corners in the coordinates of the scene, and the last one twice
        let corners = [p, p + u, p + v, p + v];
        let offset = |k: usize| core::array::from_fn(|i| f64::from(corners[k][i]) - f64::from(p[i]));
        let offsets: [V3; 4] = core::array::from_fn(offset);
        let area = 0.5 * length(cross(offsets[1], offsets[2]));
        if area > 1e-12 * dot(offsets[1], offsets[1]) {
            check(Polygon::new(corners).bound(radiance), a, &offsets, area * flux);
        }
        let line = Line::new(p, u).bound(radiance);
        check(line, a, &[zero, s], PI * length(s) * flux);
        let r = length(t) as f32;
        let (area, sphere) = (f64::from(r) * f64::from(r) * PI, Sphere::new(p, r).bound(radiance));
        check(sphere, a, &[[f64::from(r), 0.0, 0.0]], 4.0 * area * flux);
        let disk = faces(Disk::new(p, Vec3::from(narrow(normal)), r).bound(radiance));
        check(disk, a, &[[f64::from(r), 0.0, 0.0]], area * flux);
        check(PointLight::new(p).bound(radiance), a, &[zero], 4.0 * flux);
    }
}

/// The power of a patch that is flat is that of the parallelogram, however far away it is; that of a saddle is by its area.
#[test]
fn patches_have_the_power_of_their_area() {
    // z = st over a square, whose area nine Gauss points measure
    let [o, x, y] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vec3::from);
    let nodes = gauss_legendre::<20>();
    let by_s = |s: f64| nodes.iter().map(|(t, weight)| weight * (1.0 + s * s + t * t).sqrt()).sum::<f64>();
    let area: f64 = nodes.iter().map(|&(s, weight)| weight * by_s(s)).sum();
    let saddle = BilinearPatch::new(o, x, y, Vec3::new(1.0, 1.0, 1.0_f32)).bound(1.0);
    assert!((f64::from(saddle.power) / (PI * area) - 1.0).abs() < 2e-5, "{saddle:?}, {area}");
    let (s, t) = (Vec3::new(2.0, 1.0, 0.0), Vec3::new(0.0, 3.0, 4.0_f32));
    for far in [0.0, 1.0, 1e6] {
        let p = Vec3::new(far, -far, far);
        let [patch, panel] = [BilinearPatch::new(p, s, t, s + t).bound(1.0), Parallelogram::new(p, s, t).bound(1.0)];
        assert!((patch.power / panel.power - 1.0).abs() < 1e-6, "{patch:?} {panel:?}");
    }
}

/// Where a spot light leaves something, the direction is within the cone of the bound; beyond a hemisphere it has none.
#[test]
fn cones_hold_all_that_is_lit() {
    let mut random = Random::new(2);
    for _ in 0..cases(20_000, 400_000) {
        let axis = narrow(random.direction());
        let outer = random.magnitude(1e-7, 2.0) as f32;
        let inner = outer * random.unit();
        let spot = SpotLight::new(Vec3::default(), axis.into(), [inner, outer]);
        let bound = spot.bound(1.0);
        assert!(bound.power > 0.0 && bound.radius == 0.0);
        if outer >= 1.0 {
            assert_eq!((bound.normal, bound.cos_cone), ([0.0; 3], 0.0));
        }
        for _ in 0..8 {
            // next to the ends
            let angle = (1.0 - f64::from(outer)).acos() * (1.0 + random.range(-1e-3, 1e-6));
            let w = turned(wide(axis), angle, &mut random);
            if spot.falloff(narrow(w).into()) > 0.0 && bound.normal != [0.0; 3] {
                assert!(dot(w, wide(bound.normal)) >= f64::from(bound.cos_cone) - 1e-7, "{bound:?} {w:?}");
            }
        }
    }
}

/// A unit vector at an angle from another one.
fn turned(axis: V3, angle: f64, random: &mut Random) -> V3 {
    let across = unit(cross(axis, random.direction()));
    unit(core::array::from_fn(|k| axis[k] * angle.cos() + across[k] * angle.sin()))
}

#[test]
fn lights_without_extent_or_radiance_are_dark() {
    let (zero, x) = (Vec3::default(), Vec3::new(1.0, 0.0, 0.0_f32));
    for radiance in [0.0, -1.0, f32::NAN] {
        assert_eq!(Triangle::new(zero, x, Vec3::new(0.0, 1.0, 0.0)).bound(radiance).power, 0.0);
        assert_eq!(PointLight::new(x).bound(radiance).power, 0.0);
    }
    assert_eq!(Triangle::new(zero, x, x).bound(1.0).power, 0.0);
    assert_eq!(Sphere::new(x, -1.0).bound(1.0), LightBound { center: [1.0, 0.0, 0.0], ..LightBound::default() });
    assert_eq!(Line::new(x, zero).bound(1.0).power, 0.0);
}
