//! The properties. Each is a plain function that panics when its property is broken.

use crate::fixture::{Fixture, Truth};
use crate::generators::Random;
use crate::packets::{Coordinates, squares_of};
#[cfg(feature = "checks")]
use crate::stats;
#[cfg(feature = "checks")]
use crate::tolerances::SIGNIFICANCE;
use crate::tolerances::{self, ROUNDING, ULP, ULP_F64};
use etendue::{Real, Vec2, Warp, f32x8};
#[cfg(feature = "checks")]
use etendue_oracle::tier::cases;
use etendue_oracle::{Greatest, V3, cross, integrate, length, sub};

/// All that a warp returns for one `u`.
#[derive(Clone, Copy, Debug)]
pub struct Observed {
    /// `sample(u)`.
    pub point: V3,
    /// `pdf(sample(u))`.
    pub pdf: f64,
    /// `invert(sample(u))`.
    pub inverse: [f64; 2],
    /// Direction and distance of `sample_direction(u)`, or zeros.
    pub sighting: [f64; 4],
}
impl Observed {
    fn figures(&self) -> [f64; 10] {
        let ([x, y, z], [u, v], [a, b, c, d]) = (self.point, self.inverse, self.sighting);
        [x, y, z, self.pdf, u, v, a, b, c, d]
    }
}

/// Evaluates a prepared warp in every lane.
// the compiler would repeat it in every property
#[inline(never)]
pub fn observe<S: Fixture, R: Real>(warp: &S::Warp<R>, u: Vec2<R>) -> Vec<Observed> {
    let point = warp.sample(u);
    let (pdf, inverse, sighting) = (warp.pdf(point), warp.invert(point), S::sample_direction(warp, u));
    (0..R::LANES)
        .map(|i| Observed {
            point: point.at(i),
            pdf: pdf.lane_f64(i),
            inverse: [inverse.x.lane_f64(i), inverse.y.lane_f64(i)],
            sighting: sighting.map_or([0.0; 4], |s| {
                let [x, y, z] = s.direction.at(i);
                [x, y, z, s.distance.lane_f64(i)]
            }),
        })
        .collect()
}

/// Samples one `u` in `R`'s first lane.
pub fn sample<S: Fixture, R: Real>(s: &S, u: [f32; 2]) -> V3 {
    S::prepare::<R>(&[*s]).sample(squares_of(&[u])).at(0)
}
fn sample_at<S: Fixture>(s: &S, u: [f64; 2]) -> V3 {
    S::prepare::<f64>(&[*s]).sample(Vec2::new(u[0], u[1])).at(0)
}

/// **Total**: results are finite for any parameters; pdf ≥ 0; no point lies beyond the radius; the inverse of any finite direction is in
/// [0, 1)².
pub fn total<S: Fixture>(s: &S, u: [f32; 2]) {
    total_at::<S, f32>(s, u);
    total_at::<S, f64>(s, u);
}
fn total_at<S: Fixture, R: Real>(s: &S, u: [f32; 2]) {
    let truth = s.truth();
    let warp = S::prepare::<R>(&[*s]);
    let seen = observe::<S, R>(&warp, squares_of(&[u]))[0];
    let finite = seen.figures().iter().all(|x| x.is_finite());
    let closed = |u: [f64; 2]| u.iter().all(|x| (0.0..1.0).contains(x));
    assert!(finite && seen.pdf >= 0.0 && closed(seen.inverse), "not total: {s:?} at {u:?}: {seen:?}");
    assert!(
        // a subnormal length is rounded to its grid
        length(seen.point) <= truth.radius() * (1.0 + 8.0 * ULP) + 4e-45,
        "not a unit vector, or too far: {s:?} at {u:?}: {seen:?}"
    );
    for w in [[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [-0.6, 0.8, -0.0], [1e-30, -1e-42, 1.0]] {
        let point = S::Point::<R>::gather(&[w]);
        let (pdf, inverse) = (warp.pdf(point).lane_f64(0), warp.invert(point).at(0));
        assert!(
            pdf.is_finite() && pdf >= 0.0 && closed([inverse[0], inverse[1]]),
            "not total: {s:?} for {w:?}: pdf {pdf}, inverse {inverse:?}"
        );
    }
}

/// **Lane-identical**: f32 and f32x8 give the same bits, with other parameters in each lane; so does a splatted scalar warp.
///
/// `etendue-bits` compares all routines at every width, which takes as long to build as the rest.
pub fn lanes<S: Fixture>(subjects: &[S; 8], us: &[[f32; 2]; 8]) {
    let scalars: Vec<_> =
        (0..8).map(|i| observe::<S, f32>(&S::prepare::<f32>(&subjects[i..=i]), squares_of(&us[i..=i]))[0]).collect();
    same(subjects, us, &scalars, &observe::<S, f32x8>(&S::prepare(subjects), squares_of(us)), "f32x8");
    let splatted = S::splat::<f32x8>(S::prepare::<f32>(&subjects[..1]));
    let alone = S::prepare::<f32>(&subjects[..1]);
    let expected: Vec<_> = us.iter().map(|u| observe::<S, f32>(&alone, squares_of(&[*u]))[0]).collect();
    same(&[subjects[0]; 8], us, &expected, &observe::<S, f32x8>(&splatted, squares_of(us)), "splat");
}
fn same<S: Fixture>(subjects: &[S], us: &[[f32; 2]], expected: &[Observed], packet: &[Observed], name: &str) {
    for i in 0..expected.len() {
        let bits = |o: &Observed| o.figures().map(f64::to_bits);
        assert!(
            bits(&expected[i]) == bits(&packet[i]),
            "{name} differs in lane {i}: {:?} at {:?}:\n{:?}\n{:?}",
            subjects[i],
            us[i],
            expected[i],
            packet[i]
        );
    }
}

/// **Threshold-free**: multiplying all lengths by 2^±20 (and by powers between) changes no bit of a point or a pdf.
pub fn scale<S: Fixture>(s: &S, u: [f32; 2]) {
    let one = observe::<S, f32>(&S::prepare::<f32>(&[*s]), squares_of(&[u]))[0];
    for power in [-20, -7, 1, 20] {
        let factor = 2.0_f32.powi(power);
        let other = observe::<S, f32>(&S::prepare::<f32>(&[s.scaled(factor)]), squares_of(&[u]))[0];
        let mut expected = one;
        expected.sighting[3] = other.sighting[3];
        assert!(
            expected.figures().map(f64::to_bits) == other.figures().map(f64::to_bits),
            "scaled by 2^{power}: {s:?} at {u:?}:\n{one:?}\n{other:?}"
        );
    }
}

/// Rounding error of a point's coordinates, for rounding by `ulp`.
fn rounding<S: Fixture>(s: &S, ulp: f64) -> f64 {
    ulp * s.truth().granularity()
}

/// **Closed**: `sample(invert(w)) = w` and `invert(sample(u)) = u`, as far as a rounded direction allows, at both precisions.
///
/// A direction is known to `round_trip` units of its rounding, which makes an error in `u` of that times the pseudo-inverse of the map's
/// derivative. Where this exceeds 1 % of the square (the azimuth near a pole, shapes too small for a rounded direction), only the first
/// form is tested: the two points must agree to within the steps of `u` itself, 2⁻²⁴.
///
/// Returns the greatest error, in units of the rounding.
pub fn closed<S: Fixture>(s: &S, u: [f32; 2]) -> f64 {
    closed_at::<S, f32>(s, u, ROUNDING).max(closed_at::<S, f64>(s, u, ULP_F64))
}
fn closed_at<S: Fixture, R: Real>(s: &S, u: [f32; 2], ulp: f64) -> f64 {
    let truth = s.truth();
    let seen = observe::<S, R>(&S::prepare::<R>(&[*s]), squares_of(&[u]))[0];
    let known = s.tolerance().round_trip * rounding(s, ulp);
    let mut greatest = Greatest::NONE;
    greatest.take(points_agree(s, seen.point, seen.inverse, known), ());
    let u = [f64::from(u[0]), f64::from(u[1])];
    let h = 1.0 / 4096.0;
    if u.iter().any(|u| !(1e-3..=0.999).contains(u)) || s.torn(u, h) || s.torn(seen.inverse, h) {
        // at the ends of the square, derivatives vanish or grow without bound; beside a jump, either side is right
        return greatest.error() / rounding(s, ulp);
    }
    let slope = |axis: usize| {
        let (mut low, mut high) = (u, u);
        low[axis] = (u[axis] - h).max(0.0);
        high[axis] = (u[axis] + h).min(1.0 - ULP);
        let step = high[axis] - low[axis];
        sub(truth.metric(sample_at(s, high)), truth.metric(sample_at(s, low))).map(|x| x / step)
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
        let grid = s.inverse_units(u) * ULP;
        let mut error = (seen.inverse[axis] - u[axis]).abs();
        if S::PERIODIC && axis == 1 {
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
pub fn onto<S: Fixture>(s: &S, st: [f64; 2]) -> f64 {
    inverse(s, s.truth().chart(st[0], st[1]).0)
}
/// **Closed** at a given point: `sample(invert(w)) = w`.
pub fn inverse<S: Fixture>(s: &S, w: V3) -> f64 {
    let warp = S::prepare::<f32>(&[*s]);
    let point = S::Point::<f32>::gather(&[w]);
    let inverse = warp.invert(point).at(0);
    points_agree(s, point.at(0), [inverse[0], inverse[1]], s.tolerance().round_trip * rounding(s, ULP))
        / rounding(s, ULP)
}
fn points_agree<S: Fixture>(s: &S, point: V3, inverse: [f64; 2], known: f64) -> f64 {
    let truth = s.truth();
    if !truth.reachable(point) || s.torn(inverse, 16.0 * ULP) {
        return 0.0;
    }
    let again = sample_at(s, inverse);
    let error = truth.distance(again, point);
    let step = [[ULP, 0.0], [-ULP, 0.0], [0.0, ULP], [0.0, -ULP]]
        .map(|d| {
            // up to 1 inclusive: the last step of the grid is as long as any other
            let u = [(inverse[0] + d[0]).clamp(0.0, 1.0), (inverse[1] + d[1]).clamp(0.0, 1.0)];
            truth.distance(sample_at(s, u), again)
        })
        .into_iter()
        .collect::<Greatest>()
        .error();
    let units = s.inverse_steps();
    assert!(
        error <= known + units * step,
        "inverse: {s:?}: {point:?} inverts to {inverse:?}, which maps to a point {error:e} away; allowed {known:e} + {units}·{step:e}"
    );
    error - units * step
}

/// The pdf is the true one, at a sample and at a point of the chart.
///
/// Returns the relative error in units in the last place, divided by the condition.
pub fn pdf<S: Fixture>(s: &S, u: [f32; 2], st: [f64; 2]) -> f64 {
    // the oracles are accurate to 1e-13
    density_at::<S, f32>(s, u, st, ROUNDING).max(density_at::<S, f64>(s, u, st, 1e-13))
}
fn density_at<S: Fixture, R: Real>(s: &S, u: [f32; 2], st: [f64; 2], ulp: f64) -> f64 {
    let truth = s.truth();
    let mut greatest = Greatest::NONE;
    let warp = S::prepare::<R>(&[*s]);
    let chart = S::Point::<R>::gather(&[truth.chart(st[0], st[1]).0]);
    for point in [warp.sample(squares_of(&[u])), chart] {
        let (pdf, expected) = (warp.pdf(point).lane_f64(0), truth.pdf(point.at(0)));
        let slack = s.tolerance().pdf * ulp * (truth.gradient() + truth.pdf_slack(point.at(0)));
        // subnormal numbers have no more digits
        let slack = slack + f64::from(f32::from_bits(1));
        let allowed = s.tolerance().pdf * ulp * expected * truth.condition() + slack;
        assert!(
            (pdf - expected).abs() <= allowed && (pdf > 0.0 || expected <= slack),
            "density: {s:?} at {u:?} or {st:?}: {pdf}, truth {expected}: relative {:e}, allowed {:e}",
            pdf / expected - 1.0,
            allowed / expected
        );
        if expected > 0.0 {
            greatest.take((pdf - expected).abs() * s.tolerance().pdf / allowed, ());
        }
    }
    greatest.error()
}

/// The pdf is 0 outside the shape: 16 units in the last place beyond its boundary, and further away. Returns whether anything is outside.
pub fn outside<S: Fixture>(s: &S, random: &mut Random) -> bool {
    let truth = s.truth();
    let mut is_checked = false;
    for margin in [16.0 * ULP, 1e-3, 0.1] {
        if let Some(w) = truth.outside(margin, random) {
            let pdf = S::prepare::<f32>(&[*s]).pdf(S::Point::<f32>::gather(&[w])).lane_f64(0);
            assert!(pdf == 0.0, "pdf {pdf} outside {s:?} by {margin:e}, at {w:?}");
            is_checked = true;
        }
    }
    is_checked
}

/// The map takes an area du to du/pdf: its derivative is a five-point formula in f64.
///
/// Returns the relative error, if the map is smooth there.
pub fn jacobian<S: Fixture>(s: &S, u: [f64; 2]) -> Option<f64> {
    let h = 1e-3;
    let inner = u.map(|x| 0.05 + 0.9 * x);
    if !s.smooth(inner) {
        return None;
    }
    let slope = |axis: usize| {
        let at = |k: f64| {
            let mut u = inner;
            u[axis] += k * h;
            sample_at(s, u)
        };
        let (near, far) = (sub(at(1.0), at(-1.0)), sub(at(2.0), at(-2.0)));
        sub(near.map(|x| x * 8.0), far).map(|x| x / (12.0 * h))
    };
    let area = length(cross(slope(0), slope(1)));
    let point = sample_at(s, inner);
    let product = area * s.truth().pdf(point);
    let allowed = tolerances::JACOBIAN + 6.0 * ULP_F64 / (h * s.truth().extent()[1]);
    assert!((product - 1.0).abs() <= allowed, "area × pdf = {product}: {s:?} at {inner:?}, allowed {allowed:e}");
    Some((product - 1.0).abs())
}

/// **Accurate**: f32 agrees with f64 in the same code, for the point and, if there is one, the distance.
///
/// Returns the point's error in units of its rounding or the distance's in units in the last place, whichever is greater.
pub fn accurate<S: Fixture>(s: &S, u: [f32; 2]) -> f64 {
    let truth = s.truth();
    let narrow = observe::<S, f32>(&S::prepare::<f32>(&[*s]), squares_of(&[u]))[0];
    let warp = S::prepare::<f64>(&[*s]);
    let at = |u: [f64; 2]| observe::<S, f64>(&warp, Vec2::new(u[0], u[1]))[0];
    let u = u.map(f64::from);
    let wide = at(u);
    let at_steps = |n: f64| {
        let h = n * ULP;
        [[h, 0.0], [-h, 0.0], [0.0, h], [0.0, -h]]
            // up to 1 inclusive: rounding may go beyond the last step of the grid
            .map(|d| at([(u[0] + d[0]).clamp(0.0, 1.0), (u[1] + d[1]).clamp(0.0, 1.0)]))
    };
    let near = at_steps(1.0);
    // what an error exceeds the change over some steps by: as many times that over one, or if the map jumps between them, that over all
    let excess = |error: f64, steps: f64, change: &dyn Fn(&Observed) -> f64| {
        let greatest = |near: &[Observed; 4]| near.iter().map(change).collect::<Greatest>().error();
        let smooth = error - steps * greatest(&near);
        if smooth > 0.0 && steps > 0.0 { smooth.min(error - greatest(&at_steps(steps))) } else { smooth }
    };
    let away = |o: &Observed| truth.distance(o.point, wide.point);
    let excess_of_point = excess(away(&narrow), s.tolerance().steps, &away);
    let point = excess_of_point / rounding(s, ROUNDING);
    assert!(point <= s.tolerance().point, "point: {s:?} at {u:?}: {point:e} units\n{narrow:?}\n{wide:?}");
    let (d, e) = (narrow.sighting[3], wide.sighting[3]);
    // the distance belongs to the sampled direction, and moves by as many steps
    let farther = |o: &Observed| (o.sighting[3] - e).abs();
    let excess_of_distance = excess(farther(&narrow), s.tolerance().steps.max(4.0), &farther);
    let distance =
        if e > 0.0 { excess_of_distance / ((e * truth.slant(wide.point) + truth.reach()) * ROUNDING) } else { 0.0 };
    assert!(distance <= s.tolerance().distance, "distance: {s:?} at {u:?}: {d}, f64 {e}: {distance:e} units");
    point.max(distance)
}

/// **Within reach**: no sampled point lies farther than the farthest vertex of a flat shape, however ill-conditioned the distance at
/// grazing angles.
///
/// Returns the excess in units in the last place.
pub fn within_reach<S: Fixture>(s: &S, u: [f32; 2]) -> f64 {
    let (distance, reach) =
        (observe::<S, f32>(&S::prepare::<f32>(&[*s]), squares_of(&[u]))[0].sighting[3], s.truth().farthest());
    if reach == 0.0 {
        return 0.0;
    }
    let excess = (distance / reach - 1.0) / ULP;
    assert!(excess <= tolerances::REACH, "{excess:e} units beyond the farthest vertex: {s:?} at {u:?}");
    excess.max(0.0)
}

/// ∫ pdf = 1 over the independent parameterisation. The f64 code is used where the pdf varies over a shape too small for a rounded
/// direction.
pub fn integral<S: Fixture>(s: &S) -> f64 {
    let truth = s.truth();
    if truth.extent()[1] > tolerances::RESOLVED * truth.granularity() || truth.gradient() == 0.0 {
        integral_of::<S, f32>(s, ROUNDING)
    } else {
        integral_of::<S, f64>(s, 1e-13)
    }
}
fn integral_of<S: Fixture, R: Real>(s: &S, ulp: f64) -> f64 {
    let truth = s.truth();
    let warp = S::prepare::<R>(&[*s]);
    let mut pdf = |a: f64, b: f64| {
        let (point, measure) = truth.chart(a, b);
        measure * warp.pdf(S::Point::<R>::gather(&[point])).lane_f64(0)
    };
    let sum = integrate(&mut pdf, [0.0; 2], [1.0; 2], truth.quadrature());
    let allowed = s.tolerance().pdf * truth.condition() * ulp + truth.quadrature() * tolerances::QUADRATURE / 1e-9;
    assert!((sum - 1.0).abs() <= allowed, "∫pdf = {sum}: {s:?}, allowed error {allowed:e}");
    (sum - 1.0).abs()
}

#[cfg(feature = "checks")]
/// χ² of 2²⁰ samples against the true pdf, over 16 × 16 cells of the independent parameterisation; in the quick tier, of 2¹⁶ over 8 × 8. A
/// shape too small for a rounded direction uses 2¹⁸ (2¹⁵) samples of the f64 code instead.
///
/// Returns the p-value.
pub fn chi_square<S: Fixture>(s: &S, seed: u64) -> f64 {
    let truth = s.truth();
    if truth.extent()[1] > tolerances::RESOLVED * truth.granularity() {
        chi_square_of::<S, f32x8>(s, seed, cases(1 << 16, 1 << 20))
    } else {
        chi_square_of::<S, etendue::f64x4>(s, seed, cases(1 << 15, 1 << 18))
    }
}
#[cfg(feature = "checks")]
fn chi_square_of<S: Fixture, R: Real>(s: &S, seed: u64, n: usize) -> f64 {
    let truth = s.truth();
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
    let warp = S::prepare::<R>(&[*s]);
    let mut random = Random::new(seed);
    let mut observed = vec![0_u64; side * side];
    for _ in 0..n / R::LANES {
        let mut axis = || R::from_fn(|_| R::Scalar::lit(f64::from(random.unit())));
        let x = axis();
        let points = warp.sample(Vec2::new(x, axis()));
        for i in 0..R::LANES {
            let [a, b] = truth.locate(points.at(i)).map(|x| ((x * cells) as usize).min(side - 1));
            observed[a + b * side] += 1;
        }
    }
    let p = stats::chi_square(&observed, &expected);
    assert!(p > SIGNIFICANCE, "χ²: {s:?}: p = {p:e}");
    p
}

/// The properties that hold for any parameters whatever.
pub fn any_bits<S: Fixture>(s: &S, u: [f32; 2]) {
    total(s, u);
    lanes(&[*s; 8], &core::array::from_fn(|i| [u[0], (u[1] + i as f32 / 8.0).fract()]));
}

/// The properties that hold in the regimes of [`generators`](crate::generators), at one `u`.
pub fn pointwise<S: Fixture>(s: &S, u: [f32; 2], random: &mut Random) {
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
