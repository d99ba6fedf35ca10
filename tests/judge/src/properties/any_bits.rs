//! What holds for any numbers: results are finite and in range, packets have the bits of scalars, and a power of two as the unit of lengths
//! changes nothing.

use crate::fixture::{Fixture, Subject};
use crate::packets::{Coordinates, squares_of};
use core::fmt::Debug;
use etendue::{LightSample, LightSampler, Mask, Real, Vec2, f32x8};
use etendue_oracle::length;

/// All numbers of one lane of a sample.
fn figures<R: Real>(s: &LightSample<R>, i: usize) -> [f64; 12] {
    let ([x, y, z], [nx, ny, nz]) = (s.direction.at(i), s.normal.at(i));
    let truth = |m: R::Mask| f64::from(u8::from(m.lane(i)));
    let [distance, pdf, weight, u, v] = [s.distance, s.pdf, s.weight(), s.uv.x, s.uv.y].map(|x| x.lane_f64(i));
    [x, y, z, distance, pdf, truth(s.emits), truth(s.delta), weight, nx, ny, nz, u + 2.0 * v]
}
/// All numbers that a sampler returns in each lane: a sample, and the pdf, inverse and hit of its direction.
fn every_figure<R: Real>(sampler: &dyn LightSampler<R>, u: Vec2<R>) -> Vec<Vec<f64>> {
    let s = sampler.sample(u);
    let (inverse, hit) = (sampler.invert(s.direction), sampler.hit(s.direction));
    let numbers = [sampler.pdf(s.direction), inverse.x, inverse.y, sampler.pdf_of_hit(s.direction)];
    let lane = |i: usize| [&figures(&s, i)[..], &numbers.map(|x| x.lane_f64(i)), &figures(&hit, i)].concat();
    (0..R::LANES).map(lane).collect()
}
fn bits(all: &[f64]) -> Vec<u64> {
    all.iter().map(|x| x.to_bits()).collect()
}

/// **Total**: results are finite for any parameters; pdf ≥ 0; points are in the shape's reach; the pdf of a hit is that of its direction; the
/// inverse of any finite direction is in [0, 1)².
pub fn total(s: &Subject, u: [f32; 2]) {
    total_at(s, s.lengths, &*s.single, u);
    total_at(s, s.lengths, &*s.double, u);
}
/// The same of a sampler whose points have these lengths.
pub fn total_at<R: Real>(s: &dyn Debug, [least, most]: [f64; 2], sampler: &dyn LightSampler<R>, u: [f32; 2]) {
    let seen = every_figure(sampler, squares_of(&[u])).swap_remove(0);
    let closed = |u: &[f64]| u.iter().all(|x| (0.0..1.0).contains(x));
    // distances and pdfs of the sample and of the hit
    let is_positive = [3, 4, 12, 19, 20].into_iter().all(|k| seen[k] >= 0.0);
    let is_total = seen.iter().all(|x| x.is_finite()) && is_positive && closed(&seen[13..15]);
    assert!(is_total, "not total: {s:?} at {u:?}: {seen:?}");
    assert!(seen[12] == 0.0 || seen[15].to_bits() == seen[12].to_bits(), "pdf of a hit: {s:?} at {u:?}: {seen:?}");
    let long = length([seen[0], seen[1], seen[2]]);
    // a subnormal length is rounded to its grid
    let is_reached = long <= most + 4e-45 && (seen[4] == 0.0 || long >= least);
    assert!(is_reached, "not a unit vector, or too far, by {:e}: {s:?} at {u:?}: {seen:?}", long - most);
    for w in [[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [-0.6, 0.8, -0.0], [1e-30, -1e-42, 1.0]] {
        let point = Coordinates::gather(&[w]);
        let (pdf, inverse) = (sampler.pdf(point).lane_f64(0), sampler.invert(point).at(0));
        let is_total = pdf.is_finite() && pdf >= 0.0 && closed(&inverse[..2]);
        assert!(is_total, "not total: {s:?} for {w:?}: pdf {pdf}, inverse {inverse:?}");
    }
}

/// **Lane-identical**: f32 and f32x8 give the same bits, with other parameters in each lane; so does a sampler that was prepared in scalars.
///
/// `etendue-bits` compares all routines at every width, which takes as long to build as the rest.
pub fn lanes<S: Fixture>(subjects: &[S; 8], us: &[[f32; 2]; 8]) {
    let each = subjects.map(|s| S::prepare::<f32>(&[s]));
    same(subjects, us, &core::array::from_fn(|i| &*each[i]), &*S::prepare(subjects), "f32x8");
    same(subjects, us, &[&*each[0]; 8], &*subjects[0].splat::<f32x8>(), "splat");
}
/// Whether a packet has the bits of scalars, lane by lane.
pub fn same(
    subjects: &dyn Debug,
    us: &[[f32; 2]; 8],
    each: &[&dyn LightSampler<f32>; 8],
    packet: &dyn LightSampler<f32x8>,
    name: &str,
) {
    let lanes = every_figure(packet, squares_of(us));
    for (i, lane) in lanes.iter().enumerate() {
        let one = &every_figure(each[i], squares_of(&us[i..=i]))[0];
        assert!(bits(one) == bits(lane), "{name} differs in lane {i}: {subjects:?} at {us:?}:\n{one:?}\n{lane:?}");
    }
}

/// **Threshold-free**: multiplying all lengths by 2^±20 (and by powers between) changes no bit of a point, a pdf or an inverse.
pub fn scale(s: &Subject, u: [f32; 2]) {
    scales(s, u, &[0, 1, 2, 4, 12, 13, 14]);
}
/// The same of all numbers of a sample, of lights at the scale of rooms.
pub fn scale_sample(s: &Subject, u: [f32; 2]) {
    scales(s, u, &core::array::from_fn::<_, 12, _>(|k| k));
}
fn scales(s: &Subject, u: [f32; 2], which: &[usize]) {
    let at = squares_of(&[u]);
    let one = every_figure(&*s.single, at).swap_remove(0);
    for power in [-20, -7, 1, 20] {
        let factor = 2.0_f32.powi(power);
        let (sampler, pdf_factor) = (s.scaled)(factor);
        let (mut expected, other) = (one.clone(), every_figure(&*sampler, at).swap_remove(0));
        for (i, by) in [(3, factor), (4, pdf_factor), (7, 1.0 / pdf_factor), (12, pdf_factor)] {
            expected[i] *= f64::from(by);
        }
        let is_same = which.iter().all(|&k| expected[k].to_bits() == other[k].to_bits());
        assert!(is_same, "scaled by 2^{power}: {s:?} at {u:?}:\n{expected:?}\n{other:?}");
    }
}

/// The properties that hold for any parameters whatever, in packets of eight.
pub fn any_bits_of<S: Fixture>(subjects: &[S; 8], us: &[[f32; 2]; 8]) {
    for (s, u) in subjects.iter().zip(us) {
        total(&Subject::new(s), *u);
    }
    lanes(subjects, us);
}
/// The properties that hold for any parameters whatever.
pub fn any_bits<S: Fixture>(s: &S, u: [f32; 2]) {
    total(&Subject::new(s), u);
    lanes(&[*s; 8], &core::array::from_fn(|i| [u[0], (u[1] + i as f32 / 8.0).fract()]));
}
