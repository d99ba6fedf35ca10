//! The sky through portals against double precision: what is seen, the density by its definition, the map, inverses.

mod openings;

use crate::lights::stretch;
use core::f64::consts::PI;
use etendue::light::{Portal, PortalEnvironment, PortalError, PortalMap, PortalTable};
use etendue::{LightSampler, Vec2, Vec3};
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::{Coordinates, squares_of, vectors_of};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, add, cross, dot, length, sub, times, unit, wide};
use openings::{Opening, portals_of, scenes, with};

fn narrow(p: V3) -> Vec3<f32> {
    vectors_of(|_| p.map(|x| x as f32))
}

/// The pdf is the weight per steradian over the weight that is seen, with a share of 2⁻²⁴ for each column and row; 0 beside the portal.
/// A direction through two portals has the sum.
#[test]
fn pdf_by_its_definition() {
    let mut random = Random::new(1);
    for (name, openings, points) in scenes() {
        with(&openings, |sky| {
            let mut passed = [0, 0];
            for &p in &points {
                let sampler = sky.by_radiance(Vec3::<f64>::new(p[0], p[1], p[2]));
                let single = sky.by_radiance(narrow(p));
                let total: f64 = openings.iter().map(|o| o.weight(p)).sum();
                // a window within a dark texel: the density is that of its one step of u
                if total == 0.0 {
                    continue;
                }
                for i in 0..4000 {
                    let w = if i % 2 == 0 {
                        random.direction()
                    } else {
                        sampler.sample(Vec2::new(random.unit_f64(), random.unit_f64())).direction.at(0)
                    };
                    let inside =
                        |o: &&Opening| o.passed(p, w).is_some_and(|at| at.iter().all(|x| (0.0..1.0).contains(x)));
                    // where neither border nor edge is near
                    let clear = openings.iter().all(|o| {
                        let [x, y] = o.place(w);
                        let far = |x: f64, n: usize| ((x * n as f64).fract() - 0.5).abs() < 0.499;
                        let beside = |x: f64| x.abs() > 1e-3 && (x - 1.0).abs() > 1e-3;
                        far(x, o.width)
                            && far(y, o.height())
                            && o.passed(p, w).is_none_or(|at| at.iter().all(|&x| beside(x)))
                    });
                    if !clear {
                        continue;
                    }
                    let through: Vec<_> = openings.iter().filter(inside).collect();
                    let truth = through.iter().map(|o| o.density(w)).sum::<f64>() / total;
                    let wide: Vec3<f64> = Coordinates::gather(&[w]);
                    let pdf = sampler.pdf(wide);
                    passed[usize::from(through.len() > 1)] += usize::from(!through.is_empty());
                    assert_eq!(!through.is_empty(), pdf > 0.0, "{name}: {pdf} at {w:?} from {p:?}");
                    assert_eq!(sky.sees(Vec3::new(p[0], p[1], p[2]), wide), pdf > 0.0);
                    // columns and rows are drawn in 2⁻²⁴ths, and parts of rows count in 2⁻¹⁵ths
                    let floor = through.iter().map(|o| o.step(p, w)).sum::<f64>();
                    assert!(
                        (pdf - truth).abs() <= 1e-4 * truth + floor,
                        "{name}: {pdf}, expected {truth} ± {floor} at {w:?} from {p:?}"
                    );
                    let narrow = f64::from(single.pdf(narrow(w)));
                    assert!(
                        (narrow - pdf).abs() <= 1e-4 * pdf + floor,
                        "{name}: {narrow} in single precision, {pdf} in double"
                    );
                }
            }
            assert!(passed[0] > 1000, "{name}: {passed:?}");
            assert_eq!(passed[1] > 100, name == "one behind the other", "{name}: {passed:?}");
        });
    }
}

/// `sample(invert(w)) = w` for directions through a portal, and `invert(sample(u)) = u` where one portal shows the direction: there the density is
/// that of the map, too.
#[test]
fn inverses() {
    let mut random = Random::new(2);
    let (mut worst, mut smooth, mut lost) = ([0.0_f64; 2], 0, 0);
    for (name, openings, points) in scenes() {
        with(&openings, |sky| {
            for &p in &points {
                let sampler = sky.by_radiance(Vec3::<f64>::new(p[0], p[1], p[2]));
                for _ in 0..500 {
                    let u = [random.unit_f64(), random.unit_f64()];
                    let s = sampler.sample(Vec2::new(u[0], u[1]));
                    let back = sampler.invert(s.direction);
                    let again = sampler.sample(back).direction;
                    let off = length(sub(again.at(0), s.direction.at(0)));
                    worst[0] = worst[0].max(off);
                    assert!(off < 1e-7, "{name}: {:?} maps back to {again:?} from {p:?}", s.direction);
                    let through = |o: &Opening, w: V3| {
                        o.passed(p, w).is_some_and(|at| at.iter().all(|x| (-1e-6..1.000_001).contains(x)))
                    };
                    let all: Vec<_> = openings.iter().filter(|o| through(o, s.direction.at(0))).collect();
                    if let [only] = all[..] {
                        let off = (back.x - u[0]).abs().max((back.y - u[1]).abs());
                        worst[1] = worst[1].max(off);
                        assert!(off < 1e-7, "{name}: {back:?}, expected {u:?} from {p:?}");
                        let draw = |u: Vec2<f64>| {
                            let s = sampler.sample(u);
                            let w = s.direction.at(0);
                            (w, s.pdf, (through(only, w), only.texel(w)))
                        };
                        if let Some(stretch) = stretch(draw, u) {
                            smooth += 1;
                            let off = (stretch - 1.0).abs();
                            assert!(
                                off < 1e-3,
                                "{name}: the map stretches {stretch} times the density at {u:?} from {p:?}"
                            );
                        }
                    }
                    // single precision, to the steps of u in dim columns
                    let single = sky.by_radiance(narrow(p));
                    let s = single.sample(squares_of(&[u.map(|u| u as f32)]));
                    assert!(s.pdf > 0.0 && s.pdf == single.pdf(s.direction), "{name}: {s:?} from {p:?}");
                    assert!((length(s.direction.at(0)) - 1.0).abs() < 4e-7 && s.emits && !s.delta && s.distance > 1e38);
                    lost += u32::from(!openings.iter().any(|o| through(o, s.direction.at(0))));
                    let again = single.sample(single.invert(s.direction)).direction;
                    let cell = (2.0 * PI / openings[0].width.min(openings[0].height()) as f64).min(1.0);
                    let off = length(sub(again.at(0), s.direction.at(0)));
                    assert!(off < cell, "{name}: {off} from {p:?}");
                }
            }
        });
    }
    println!("direction {:.1e}, u {:.1e}, {smooth} smooth, {lost} beside the portals", worst[0], worst[1]);
    assert!(smooth > 4000 && lost < 20, "{smooth}, {lost}");
}

/// Above a horizon, each portal has the pdf that it has otherwise, times a factor: by the mean cosine of its corners. Below, it has none.
#[test]
fn portals_above_the_horizon() {
    let mut random = Random::new(6);
    let mut passed = [0; 2];
    for (name, openings, points) in scenes() {
        with(&openings, |sky| {
            for (&p, _) in points.iter().zip(0..3).flat_map(|point| [point; 8]) {
                let normal = random.direction();
                let mean_cos = |o: &Opening| {
                    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[a, b]| {
                        let to = sub(add(wide(o.corner), add(times(wide(o.s), a), times(wide(o.t), b))), p);
                        dot(to, normal) / length(to)
                    });
                    let is_above = corners.iter().any(|cos| *cos > -1e-3);
                    if is_above { corners.iter().map(|cos| cos.max(1e-3)).sum::<f64>() / 4.0 } else { 0.0 }
                };
                let weights: Vec<_> = openings.iter().map(|o| o.weight(p)).collect();
                let (all, above): (f64, f64) =
                    (weights.iter().sum(), openings.iter().zip(&weights).map(|(o, weight)| mean_cos(o) * weight).sum());
                let at = Vec3::<f64>::new(p[0], p[1], p[2]);
                let (plain, own) =
                    (sky.by_radiance(at), sky.by_radiance_above(at, Vec3::new(normal[0], normal[1], normal[2])));
                for i in 0..200 {
                    let u = Vec2::new(random.unit_f64(), random.unit_f64());
                    let s = own.sample(u);
                    assert_eq!((s.pdf > 0.0, own.pdf(s.direction)), (s.emits, s.pdf), "{name}");
                    assert!(above > 0.0 || s.pdf == 0.0, "{name}: {s:?} below the horizon from {p:?}");
                    let w = if i % 2 == 0 && s.pdf > 0.0 { s.direction } else { plain.sample(u).direction };
                    let inside =
                        |o: &&Opening| o.passed(p, w.at(0)).is_some_and(|at| at.iter().all(|x| (0.0..1.0).contains(x)));
                    let through: Vec<_> = openings.iter().filter(inside).collect();
                    if let [only] = through[..]
                        && all > 0.0
                    {
                        let factor = if above > 0.0 { mean_cos(only) * all / above } else { 0.0 };
                        let (truth, pdf) = (plain.pdf(w) * factor, own.pdf(w));
                        let floor = 4.0 * (1.0 + factor) * only.step(p, w.at(0));
                        passed[usize::from(truth > 0.0)] += 1;
                        assert!(
                            (pdf - truth).abs() <= 1e-4 * truth + floor && (pdf > 0.0) == (truth > 0.0),
                            "{name}: {pdf}, expected {truth} ± {floor} at {w:?} from {p:?} on {normal:?}"
                        );
                    }
                }
            }
        });
    }
    assert!(passed.iter().all(|&count| count > 1000), "{passed:?}");
}

/// From behind, and in the plane of a portal, nothing is seen.
#[test]
fn nothing_is_seen_from_behind() {
    let openings = vec![scenes()[0].1[0].clone()];
    with(&openings, |sky| {
        for p in [[3.0, 0.0, 1.0], [3.5, 0.0, 1.0], [1e9, 0.0, 0.0], [3.0, 50.0, 1.0]] {
            let sampler = sky.by_radiance(narrow(p));
            let s = sampler.sample(Vec2::new(0.3, 0.7));
            assert_eq!((s.pdf, s.emits), (0.0, false), "{p:?}");
            let ahead = Vec3::new(1.0, 0.0, 0.0);
            assert_eq!((sampler.pdf(ahead), sky.sees(narrow(p), ahead)), (0.0, false), "{p:?}");
        }
        let through: Vec3<f32> = Vec3::new(1.0, 0.0, 0.0);
        assert!(sky.sees(narrow([2.999, 0.0, 1.0]), through) && !sky.sees(narrow([2.999, 0.0, 1.0]), -through));
    });
}

/// A portal of any size at any distance: scaled with the point, it gives the same bits; far away, samples stay within it to rounding.
#[test]
fn portals_of_any_size() {
    let base = scenes()[0].1[0].clone();
    let us: Vec<[f32; 2]> = (0..64).map(|i| [i as f32 / 64.0, (i * 37 % 64) as f32 / 64.0]).collect();
    let directions = |factor: f32| {
        let by = |v: [f32; 3]| v.map(|x| x * factor);
        let scaled = Opening { corner: by(base.corner), s: by(base.s), t: by(base.t), ..base.clone() };
        with(&[scaled], |sky| {
            let sampler = sky.by_radiance(Vec3::new(0.25 * factor, 0.5 * factor, factor));
            us.iter()
                .map(|u| sampler.sample(squares_of::<f32>(&[*u])))
                .map(|s| [s.pdf, s.direction.x])
                .collect::<Vec<_>>()
        })
    };
    let one = directions(1.0);
    for power in [-60, -20, 3, 40] {
        assert_eq!(one, directions(2.0_f32.powi(power)), "2^{power}");
    }
    for distance in [10.0, 1e3, 1e5] {
        let far = Opening { corner: [distance, -1.0, -0.75], ..base.clone() };
        with(core::slice::from_ref(&far), |sky| {
            let sampler = sky.by_radiance(Vec3::<f32>::default());
            for u in &us {
                let s = sampler.sample(squares_of(&[*u]));
                let at = far.passed([0.0; 3], s.direction.at(0)).unwrap();
                let slack = 3e-7 * f64::from(distance);
                assert!(at.iter().all(|x| (-slack..1.0 + slack).contains(x)), "{distance}: {at:?}");
                // its window is within one texel or two rows of it
                let ratio = f64::from(s.pdf) * 3.0 / f64::from(distance).powi(2);
                assert!(distance < 100.0 || s.pdf > 0.0 && ratio < 60.0, "{distance}: {ratio}");
            }
        });
    }
}

fn is_total(sky: &PortalEnvironment<'_>, p: Vec3<f32>, u: Vec2<f32>, w: Vec3<f32>) {
    let sampler = sky.by_radiance(p);
    let s = sampler.sample(u);
    let ([x, y, z], back, again) = (s.direction.at(0), sampler.invert(w).at(0), sampler.invert(s.direction).at(0));
    let [drawn, pdf] = [s.pdf, sampler.pdf(w)].map(f64::from);
    let all = [x, y, z, drawn, pdf, back[0], back[1], again[0], again[1], s.uv.at(0)[0]];
    assert!(all.iter().all(|x| x.is_finite()) && drawn >= 0.0 && pdf >= 0.0, "{all:?} from {p:?} along {w:?}");
    assert!(all[5..9].iter().all(|u| (0.0..1.0).contains(u)), "{all:?} from {p:?} along {w:?}");
    assert_eq!(s.pdf.to_bits(), sampler.pdf(s.direction).to_bits());
    assert_eq!(s.emits, s.pdf > 0.0);
    assert!(pdf == 0.0 || sky.sees(p, w), "{pdf} where nothing is seen from {p:?} along {w:?}");
}

/// Any point and direction gives finite numbers; also with tables of any contents.
#[test]
fn any_bits() {
    let mut random = Random::new(4);
    for (_, openings, points) in scenes() {
        let mut garbage: Vec<_> = openings.iter().map(|o| vec![0; PortalTable::buffer(o.width, o.height())]).collect();
        garbage.iter_mut().flatten().for_each(|x| *x = random.word());
        let both = openings.iter().zip(&garbage);
        let tables: Vec<_> = both.map(|(o, buffer)| PortalTable::from_buffer(buffer, o.width).unwrap()).collect();
        let portals = portals_of(&openings);
        let broken = PortalEnvironment::new(&portals, &tables).unwrap();
        with(&openings, |sky| {
            for round in 0..cases(1600, 16_000) {
                let p = match round % 3 {
                    0 => generators::nasty(&mut random).into(),
                    _ => narrow(points[round / 3 % points.len()]),
                };
                let w = match round % 4 {
                    0 => generators::nasty(&mut random).into(),
                    _ => narrow(random.direction()),
                };
                let u = Vec2::new(random.unit(), random.unit());
                is_total(sky, p, u, w);
                is_total(&broken, p, u, w);
            }
        });
    }
}

/// The map covers the directions in front of a portal once: their vectors add up to π along the normal. The sum over middles of cells errs by
/// the square of their width, up to 1.5e−4 here; a solid angle that is wrong by a thousandth moves it by 3e−3.
#[test]
fn the_map_covers_the_hemisphere() {
    const SIDE: usize = 512;
    let right = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    for (s, t) in [right, ([0.0, 2.0, 0.0], [1.0, 0.0, 3.0]), ([1.0, 0.2, -0.4], [-0.9, 0.5, 0.3])] {
        let map = PortalMap::new(s, t).unwrap();
        let mut sum = [0.0; 3];
        for i in 0..SIDE * SIDE {
            let middle = |k: usize| (k as f64 + 0.5) / SIDE as f64;
            let (w, solid_angle) = map.direction(Vec2::new(middle(i % SIDE), middle(i / SIDE)));
            sum = add(sum, times(w.at(0), solid_angle / (SIDE * SIDE) as f64));
        }
        let off = length(sub(sum, times(unit(cross(wide(s), wide(t))), PI)));
        println!("off by {off:e}");
        assert!(off < 3e-4, "{s:?} {t:?}: {sum:?}");
    }
}

#[test]
fn invalid_input_is_an_error() {
    let (s, t) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    for (s, t) in [(s, s), (s, [0.0; 3]), (s, [f32::NAN; 3]), ([f32::INFINITY, 0.0, 0.0], t)] {
        assert_eq!(PortalMap::new(s, t), Err(PortalError::Edges));
    }
    let mut buffer = [0; PortalTable::buffer(2, 2)];
    let table = PortalTable::build(&[1.0; 4], 2, &mut buffer).unwrap();
    assert_eq!(Portal::new([f32::NAN, 0.0, 0.0], s, t), Err(PortalError::Corner));
    let portals = [Portal::new([0.0; 3], s, t).unwrap(); PortalEnvironment::MOST + 1];
    let tables = [table; PortalEnvironment::MOST + 1];
    let error = |portals, tables| PortalEnvironment::new(portals, tables).unwrap_err();
    assert_eq!([error(&portals, &tables), error(&[], &[])], [PortalError::Count; 2]);
    assert_eq!(error(&portals[1..], &tables), PortalError::Tables);
    assert!(PortalEnvironment::new(&portals[1..], &tables[1..]).is_ok());
}
