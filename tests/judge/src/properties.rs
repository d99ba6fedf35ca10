//! The properties. Each is a plain function that panics when its property is broken.

mod any_bits;

pub use any_bits::*;

use crate::area_lights::AreaLight;
use crate::fixture::{Fixture, Subject, Truth, sample_at};
use crate::packets::{Coordinates, squares_of};
use crate::random::Random;
#[cfg(feature = "checks")]
use crate::stats;
#[cfg(feature = "checks")]
use crate::tolerances::SIGNIFICANCE;
use crate::tolerances::{self, ROUNDING, ULP, ULP_F64};
use etendue::{LightSampler, Real, Vec2};
#[cfg(feature = "checks")]
use etendue_oracle::tier::cases;
use etendue_oracle::{Greatest, V3, cross, integrate, length, sub, wide};

/// The point of a sample, its inverse, and its distance, for one `u`.
#[derive(Clone, Copy, Debug)]
struct Observed {
    point: V3,
    inverse: [f64; 2],
    distance: f64,
}
fn observe<R: Real>(sampler: &dyn LightSampler<R>, u: [f64; 2]) -> Observed {
    let s = sampler.sample(Vec2::new(R::lit(u[0]), R::lit(u[1])));
    let [x, y, _] = sampler.invert(s.direction).at(0);
    Observed { point: s.direction.at(0), inverse: [x, y], distance: s.distance.lane_f64(0) }
}

/// Rounding error of a point's coordinates, for rounding by `ulp`.
fn rounding(s: &Subject, ulp: f64) -> f64 {
    ulp * s.truth.granularity()
}

/// **Closed**: `sample(invert(w)) = w` and `invert(sample(u)) = u`, as far as a rounded direction allows, at both precisions.
///
/// A direction is known to `round_trip` units of its rounding, which makes an error in `u` of that times the pseudo-inverse of the map's
/// derivative. Where this exceeds 1 % of the square (the azimuth near a pole, shapes too small for a rounded direction), only the first
/// form is tested: the two points must agree to within the steps of `u` itself, 2⁻²⁴.
///
/// Returns the greatest error, in units of the rounding.
pub fn closed(s: &Subject, u: [f32; 2]) -> f64 {
    let u = u.map(f64::from);
    closed_at(s, u, observe(&*s.single, u), ROUNDING).max(closed_at(s, u, observe(&*s.double, u), ULP_F64))
}
fn closed_at(s: &Subject, u: [f64; 2], seen: Observed, ulp: f64) -> f64 {
    let (truth, map) = (&**s.truth, &*s.double);
    let known = truth.tolerance().round_trip * rounding(s, ulp);
    let mut greatest = Greatest::NONE;
    greatest.take(points_agree(s, seen.point, seen.inverse, known), ());
    let h = 1.0 / 4096.0;
    if u.iter().any(|u| !(1e-3..=0.999).contains(u)) || truth.torn(map, u, h) || truth.torn(map, seen.inverse, h) {
        // at the ends of the square, derivatives vanish or grow without bound; beside a jump, either side is right
        return greatest.error() / rounding(s, ulp);
    }
    let slope = |axis: usize| {
        let (mut low, mut high) = (u, u);
        low[axis] = (u[axis] - h).max(0.0);
        high[axis] = (u[axis] + h).min(1.0 - ULP);
        let step = high[axis] - low[axis];
        sub(truth.metric(sample_at(map, high)), truth.metric(sample_at(map, low))).map(|x| x / step)
    };
    let (a, b) = (slope(0), slope(1));
    let area = length(cross(a, b)).max(1e-300);
    let both = [(0, length(b)), (1, length(a))];
    if both.iter().any(|&(axis, across)| u[axis].min(1.0 - u[axis]) <= known * across / area) {
        // beyond the end of the square, a neighbouring triangle may begin
        return greatest.error() / rounding(s, ulp);
    }
    for (axis, across) in both {
        let allowed = known * across / area;
        let grid = truth.inverse_units(u) * ULP;
        let mut error = (seen.inverse[axis] - u[axis]).abs();
        if truth.is_periodic() && axis == 1 {
            error = error.min(1.0 - error);
        }
        assert!(
            allowed > 0.01 || error <= allowed + grid,
            "round trip: {s:?} at {u:?}: {:?}, error {error:e}, allowed {allowed:e} + {grid:e}",
            seen.inverse
        );
        // without a derivative, an error in u is no error of the point
        if allowed <= 0.01 && across > 0.0 {
            greatest.take((error - grid) * area / across, ());
        }
    }
    greatest.error() / rounding(s, ulp)
}

/// **Closed** for points that did not come from `sample`: `sample(invert(w)) = w` at the point `st` of the chart.
pub fn onto(s: &Subject, st: [f64; 2]) -> f64 {
    inverse(s, s.truth.chart(st[0], st[1]).0)
}
/// **Closed** at a given point: `sample(invert(w)) = w`.
pub fn inverse(s: &Subject, w: V3) -> f64 {
    let point = Coordinates::gather(&[w]);
    let inverse = s.single.invert(point).at(0);
    let known = s.truth.tolerance().round_trip * rounding(s, ULP);
    points_agree(s, point.at(0), [inverse[0], inverse[1]], known) / rounding(s, ULP)
}
fn points_agree(s: &Subject, point: V3, inverse: [f64; 2], known: f64) -> f64 {
    let (truth, map) = (&**s.truth, &*s.double);
    if !truth.reachable(point) || truth.torn(map, inverse, 16.0 * ULP) {
        return 0.0;
    }
    let again = sample_at(map, inverse);
    let error = truth.distance(again, point);
    let step = [[ULP, 0.0], [-ULP, 0.0], [0.0, ULP], [0.0, -ULP]]
        .map(|d| {
            // up to 1 inclusive: the last step of the grid is as long as any other
            let u = [(inverse[0] + d[0]).clamp(0.0, 1.0), (inverse[1] + d[1]).clamp(0.0, 1.0)];
            truth.distance(sample_at(map, u), again)
        })
        .into_iter()
        .collect::<Greatest>()
        .error();
    let units = truth.inverse_steps();
    assert!(
        error <= known + units * step,
        "inverse: {s:?}: {point:?} inverts to {inverse:?}, which maps to a point {error:e} away; allowed {known:e} + {units}·{step:e}"
    );
    error - units * step
}

/// The pdf is the true one, at a sample and at a point of the chart.
///
/// Returns the relative error in units in the last place, divided by the condition.
pub fn pdf(s: &Subject, u: [f32; 2], st: [f64; 2]) -> f64 {
    let w = s.truth.chart(st[0], st[1]).0;
    // the oracles are accurate to 1e-13
    density_at(s, &*s.single, u, w, ROUNDING).max(density_at(s, &*s.double, u, w, 1e-13))
}
fn density_at<R: Real>(s: &Subject, sampler: &dyn LightSampler<R>, u: [f32; 2], w: V3, ulp: f64) -> f64 {
    let truth = &s.truth;
    let (mut greatest, tolerance) = (Greatest::NONE, truth.tolerance().pdf);
    for point in [sampler.sample(squares_of(&[u])).direction, Coordinates::gather(&[w])] {
        let (pdf, expected) = (sampler.pdf(point).lane_f64(0), truth.pdf(point.at(0)));
        let slack = tolerance * ulp * (truth.gradient() + truth.pdf_slack(point.at(0)));
        // subnormal numbers have no more digits
        let slack = slack + f64::from(f32::from_bits(1));
        let allowed = tolerance * ulp * expected * truth.condition() + slack;
        assert!(
            (pdf - expected).abs() <= allowed && (pdf > 0.0 || expected <= slack),
            "density: {s:?} at {u:?} or {w:?}: {pdf}, truth {expected}: relative {:e}, allowed {:e}",
            pdf / expected - 1.0,
            allowed / expected
        );
        if expected > 0.0 {
            greatest.take((pdf - expected).abs() * tolerance / allowed, ());
        }
    }
    greatest.error()
}

/// The pdf is 0 outside the shape, and rays miss it: 16 units in the last place beyond its boundary, and further away. Returns whether anything is
/// outside.
pub fn outside(s: &Subject, random: &mut Random) -> bool {
    let mut is_checked = false;
    for margin in [16.0 * ROUNDING, 1e-3, 0.1] {
        if let Some(w) = s.truth.outside(margin, random) {
            let w = Coordinates::gather(&[w]);
            let (pdf, hit) = (s.single.pdf(w), s.single.hit(w));
            assert!(pdf == 0.0, "pdf {pdf} outside {s:?} by {margin:e}, at {w:?}");
            assert!(!hit.valid() && hit.weight() == 0.0, "a ray hits {s:?} outside by {margin:e}: {hit:?}");
            is_checked = true;
        }
    }
    is_checked
}

/// The map takes an area du to du/pdf: its derivative is a five-point formula in f64.
///
/// Returns the relative error, if the map is smooth there.
pub fn jacobian(s: &Subject, u: [f64; 2]) -> Option<f64> {
    let h = 1e-3;
    let inner = u.map(|x| 0.05 + 0.9 * x);
    if !s.truth.smooth(&*s.double, inner) {
        return None;
    }
    let slope = |axis: usize| {
        let at = |k: f64| {
            let mut u = inner;
            u[axis] += k * h;
            sample_at(&*s.double, u)
        };
        let (near, far) = (sub(at(1.0), at(-1.0)), sub(at(2.0), at(-2.0)));
        sub(near.map(|x| x * 8.0), far).map(|x| x / (12.0 * h))
    };
    let area = length(cross(slope(0), slope(1)));
    let product = area * s.truth.pdf(sample_at(&*s.double, inner));
    let allowed = tolerances::JACOBIAN + 6.0 * ULP_F64 / (h * s.truth.extent()[1]);
    assert!((product - 1.0).abs() <= allowed, "area × pdf = {product}: {s:?} at {inner:?}, allowed {allowed:e}");
    Some((product - 1.0).abs())
}

/// **Accurate**: f32 agrees with f64 in the same code, for the point and, if there is one, the distance.
///
/// Returns the point's error in units of its rounding or the distance's in units in the last place, whichever is greater.
pub fn accurate(s: &Subject, u: [f32; 2]) -> f64 {
    let (truth, tolerance) = (&s.truth, s.truth.tolerance());
    let u = u.map(f64::from);
    let (narrow, wide) = (observe(&*s.single, u), observe(&*s.double, u));
    let moved = |n: f64, most: f64| {
        let within = |x: f64| x.clamp(0.0, most);
        [[n, 0.0], [-n, 0.0], [0.0, n], [0.0, -n]].map(|d| [within(u[0] + d[0] * ULP), within(u[1] + d[1] * ULP)])
    };
    // up to 1 inclusive: rounding may go beyond the last step of the grid
    let wide_at = |n: f64| moved(n, 1.0).map(|u| observe(&*s.double, u));
    let near = wide_at(1.0);
    // what an error exceeds the change over some steps by: as many times that over one, or if the maps jump between them, those over all
    let excess = |error: f64, steps: f64, change: &dyn Fn(&Observed, &Observed) -> f64| {
        let greatest =
            |near: &[Observed; 4], from: &Observed| near.iter().map(|o| change(o, from)).collect::<Greatest>().error();
        let smooth = error - steps * greatest(&near, &wide);
        if smooth <= 0.0 || steps <= 0.0 {
            return smooth;
        }
        let narrow_at = moved(steps, 1.0 - ULP).map(|u| observe(&*s.single, u));
        smooth.min(error - greatest(&wide_at(steps), &wide) - greatest(&narrow_at, &narrow))
    };
    let away = |o: &Observed, from: &Observed| truth.distance(o.point, from.point);
    let point = excess(away(&narrow, &wide), tolerance.steps, &away) / rounding(s, ROUNDING);
    assert!(point <= tolerance.point, "point: {s:?} at {u:?}: {point:e} units\n{narrow:?}\n{wide:?}");
    let (d, e) = (narrow.distance, wide.distance);
    // the distance belongs to the sampled direction, and moves by as many steps
    let farther = |o: &Observed, from: &Observed| (o.distance - from.distance).abs();
    let beyond = excess(farther(&narrow, &wide), tolerance.steps.max(4.0), &farther);
    let distance = if e > 0.0 { beyond / ((e * truth.slant(wide.point) + truth.reach()) * ROUNDING) } else { 0.0 };
    assert!(distance <= tolerance.distance, "distance: {s:?} at {u:?}: {d}, f64 {e}: {distance:e} units");
    point.max(distance)
}

/// **Within reach**: no sampled point lies farther than the farthest vertex of a flat shape, however ill-conditioned the distance at
/// grazing angles.
///
/// Returns the excess in units in the last place.
pub fn within_reach(s: &Subject, u: [f32; 2]) -> f64 {
    let (distance, reach) = (observe(&*s.single, u.map(f64::from)).distance, s.truth.farthest());
    if reach == 0.0 {
        return 0.0;
    }
    let excess = (distance / reach - 1.0) / ULP;
    assert!(excess <= tolerances::REACH, "{excess:e} units beyond the farthest vertex: {s:?} at {u:?}");
    excess.max(0.0)
}

/// Whether a rounded direction resolves the shape.
fn is_resolved(truth: &dyn Truth) -> bool {
    truth.extent()[1] > tolerances::RESOLVED * truth.granularity()
}

/// ∫ pdf = 1 over the independent parameterisation. The f64 code is used where the pdf varies over a shape too small for a rounded
/// direction.
pub fn integral(s: &Subject) -> f64 {
    let truth = &s.truth;
    let is_single = is_resolved(&***truth) || truth.gradient() == 0.0;
    let mut pdf = |a: f64, b: f64| {
        let (point, measure) = truth.chart(a, b);
        let single = || f64::from(s.single.pdf(Coordinates::gather(&[point])));
        measure * if is_single { single() } else { s.double.pdf(Coordinates::gather(&[point])) }
    };
    let sum = integrate(&mut pdf, [0.0; 2], [1.0; 2], truth.quadrature()) / truth.whole();
    let ulp = if is_single { ROUNDING } else { 1e-13 };
    let allowed = truth.tolerance().pdf * truth.condition() * ulp + truth.quadrature() * tolerances::QUADRATURE / 1e-9;
    assert!((sum - 1.0).abs() <= allowed, "∫pdf = {sum}: {s:?}, allowed error {allowed:e}");
    (sum - 1.0).abs()
}

#[cfg(feature = "checks")]
/// χ² of 2²⁰ samples against the true pdf, over 16 × 16 cells of the independent parameterisation; in the quick tier, of 2¹⁶ over 8 × 8. A
/// shape too small for a rounded direction uses 2¹⁸ (2¹⁵) samples of the f64 code instead.
///
/// Returns the p-value.
pub fn chi_square(s: &Subject, seed: u64) -> f64 {
    if is_resolved(&**s.truth) {
        chi_square_of(s, &*(s.eight)(), seed, cases(1 << 16, 1 << 20))
    } else {
        chi_square_of(s, &*s.double, seed, cases(1 << 15, 1 << 18))
    }
}
#[cfg(feature = "checks")]
fn chi_square_of<R: Real>(s: &Subject, sampler: &dyn LightSampler<R>, seed: u64, n: usize) -> f64 {
    let truth = &s.truth;
    let side = cases(8, 16);
    let cells = side as f64;
    let expected: Vec<f64> = (0..side * side)
        .map(|i| {
            let (x, y) = ((i % side) as f64 / cells, (i / side) as f64 / cells);
            let mut f = |a, b| {
                let (w, measure) = truth.chart(a, b);
                measure * truth.pdf(w)
            };
            integrate(&mut f, [x, y], [x + 1.0 / cells, y + 1.0 / cells], 1e-6) * n as f64
        })
        .collect();
    let mut random = Random::new(seed);
    let mut observed = vec![0_u64; side * side];
    for _ in 0..n / R::LANES {
        let mut axis = || R::from_fn(|_| R::Scalar::lit(f64::from(random.unit())));
        let x = axis();
        let points = sampler.sample(Vec2::new(x, axis())).direction;
        for i in 0..R::LANES {
            let [a, b] = truth.locate(points.at(i)).map(|x| ((x * cells) as usize).min(side - 1));
            observed[a + b * side] += 1;
        }
    }
    let p = stats::chi_square(&observed, &expected);
    assert!(p > SIGNIFICANCE, "χ²: {s:?}: p = {p:e}");
    p
}

/// The properties that hold in the regimes of [`generators`](crate::generators), at one `u`.
pub fn pointwise(s: &Subject, u: [f32; 2], random: &mut Random) {
    total(s, u);
    scale(s, u);
    accurate(s, u);
    closed(s, u);
    let st = [random.unit_f64(), random.unit_f64()];
    pdf(s, u, st);
    onto(s, st);
    outside(s, random);
    jacobian(s, [random.unit_f64(), random.unit_f64()]);
}

/// **One pdf**: that of a sample is the one that is evaluated for its direction, to the bit where the direction determines it; and a ray in
/// that direction hits the light with it.
pub fn one_pdf(light: &AreaLight, sampler: &dyn LightSampler<f32>, u: [f32; 2]) {
    let s = sampler.sample(squares_of(&[u]));
    let Some(allowed) = light.evaluated_to(&s) else { return };
    if s.pdf > 0.0 {
        let evaluated = sampler.pdf(s.direction);
        let hit = sampler.hit(s.direction);
        let aside = (hit.uv.x - s.uv.x).abs().max((hit.uv.y - s.uv.y).abs());
        if allowed > 0.0 && hit.distance < s.distance && (hit.distance < 0.999 * s.distance || aside > 0.01) {
            // another sheet of a twisted patch hides the sample, if there is one
            assert!(light.has(&hit), "no such point: {hit:?} for {s:?}: {light:?} at {u:?}");
            return;
        }
        let off = (f64::from(evaluated) / f64::from(s.pdf) - 1.0).abs();
        let same = if allowed == 0.0 { evaluated.to_bits() == s.pdf.to_bits() } else { off <= allowed };
        assert!(same, "two pdfs: {evaluated} evaluated, {} sampled, allowed {allowed:e}: {light:?} at {u:?}", s.pdf);
        let reached = hit.pdf.to_bits() == evaluated.to_bits() && hit.emits == s.emits;
        assert!(s.delta || reached, "not hit: {hit:?} for {s:?}: {light:?} at {u:?}");
    }
}

/// The density by area is the truth for the point that was drawn.
pub fn measure(light: &AreaLight, sampler: &dyn LightSampler<f32>, u: [f32; 2]) {
    let s = sampler.sample(squares_of(&[u]));
    let Some((truth, known)) = light.density(s.direction.at(0), f64::from(s.distance)) else { return };
    // what is next to a number's end, or known to less than a tenth, tells nothing
    let fair = (1e-15..1e15).contains(&s.distance) && (1e-30..1e30).contains(&truth);
    if s.pdf > 0.0 && known < 0.1 && fair {
        let off = (f64::from(s.pdf) / truth - 1.0).abs();
        assert!(off <= known, "pdf {} for {truth}: off by {off:e}, allowed {known:e}: {light:?} at {u:?}", s.pdf);
    }
}

/// **Nearest hit**: the point of a sample lies on the sphere, and from outside on its near side, no farther than the tangent length √(d²−R²).
/// Only this tells the two roots apart, since both lie on the sphere.
pub fn nearest_hit(sphere: &AreaLight, u: [f32; 2]) {
    let s = AreaLight::prepare::<f64>(&[*sphere]).sample(squares_of(&[u]));
    let (center, radius) = (wide(sphere.a), f64::from(sphere.radius));
    let d = length(center);
    let off = length(sub(s.direction.at(0).map(|x| x * s.distance), center)) - radius;
    // a dozen roundings of coordinates as large as d + R
    let allowed = 12.0 * ULP_F64 * (d + radius);
    assert!(off.abs() <= allowed, "off the sphere by {off:e}, allowed {allowed:e}: {sphere:?} at {u:?}");
    if d > radius {
        let tangent = ((d - radius) * (d + radius)).sqrt();
        // near the limb the two roots meet, and differ by the square root of a rounding
        let allowed = tangent + 1e-7 * radius;
        assert!(s.distance <= allowed, "far side: {} beyond {tangent}: {sphere:?} at {u:?}", s.distance);
    }
}
