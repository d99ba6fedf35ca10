//! Tables, choices of lights, masks and counters.

use super::Input;
use crate::packets::{squares_of, twice, vectors_of};
use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d, TableError};
use etendue::light::{EnvironmentMap, ImageEnvironment};
use etendue::select::{Choice, LightBound, LightChoice, SpatialLights, UniformLights};
use etendue::{Mask, Real, Uint, Vec2, Vec3, Warp, f32x4, f32x8, f32x16};
use etendue_oracle::{dot, length, sub};

/// Weights, some of them 0 and rarely one invalid, with the error that an invalid one must give.
fn weights(input: &mut Input<'_>, most: u8) -> (Vec<f32>, Option<TableError>) {
    let mut weights = input.weights(most);
    if input.below(16) == 0 {
        let at = input.below(weights.len() as u8) as usize;
        weights[at] = [-1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-45][input.below(5) as usize];
    }
    let error = if weights.iter().any(|w| !(0.0..=f32::MAX).contains(w)) {
        Some(TableError::Weight)
    } else if weights.iter().all(|w| *w == 0.0) {
        Some(TableError::Empty)
    } else {
        None
    };
    (weights, error)
}
const STEP: f64 = 1.0 / 16_777_216.0;

/// Tables of one and two dimensions: a cell's pmf is the reported one, and a cell without weight is never drawn.
pub(super) fn piecewise_constant(input: &mut Input<'_>) {
    let (weights, error) = weights(input, 40);
    let n = weights.len();
    let mut cdf = vec![0.0; n];
    let table = PiecewiseConstant1d::build(&weights, &mut cdf);
    assert_eq!(table.as_ref().err(), error.as_ref(), "{weights:?}");
    let Ok(table) = table else { return };
    let sum: f64 = (0..n as u32).map(|i| f64::from(table.pmf::<f32>(i))).sum();
    assert!(sum == 1.0, "probabilities sum to {sum}: {weights:?}");
    for _ in 0..8 {
        let u = input.unit();
        let cell = table.cell(u);
        let i = cell.index as usize;
        assert!(weights[i] > 0.0 && cell.pmf > 0.0, "{weights:?} at {u}: {cell:?}");
        assert_eq!(cell.pmf, table.pmf::<f32>(cell.index), "{weights:?} at {u}");
        assert!((0.0..1.0).contains(&cell.offset), "{weights:?} at {u}: {cell:?}");
        let back = f64::from(table.invert_cell(cell.index, cell.offset));
        assert!((back - f64::from(u)).abs() <= STEP, "{weights:?}: {u} to {back}");
        let x = table.sample(u);
        assert_eq!(table.pdf(x), cell.pmf * n as f32, "{weights:?} at {u}: {x}");
        let packet = table.cell(f32x8::splat(u));
        assert_eq!((packet.index.lane(5), packet.offset.lane(5)), (cell.index, cell.offset));
    }
    let width = 1 + input.below(n as u8) as usize;
    let mut buffer = vec![0.0; PiecewiseConstant2d::buffer(width, n / width)];
    let image = PiecewiseConstant2d::build(&weights[..width * (n / width)], width, &mut buffer);
    let Ok(image) = image else {
        assert!(weights[..width * (n / width)].iter().all(|w| *w == 0.0), "{weights:?} of {width}");
        return;
    };
    for _ in 0..4 {
        let u: Vec2<f32> = squares_of(&[input.square()]);
        let (cell, p) = (image.cell(u), image.sample(u));
        let weight = weights[cell.x as usize + cell.y as usize * width];
        assert!(weight > 0.0 && cell.pmf > 0.0, "{weights:?} of {width} at {u:?}: {cell:?}");
        assert_eq!(cell.pmf, image.pmf::<f32>(cell.x, cell.y));
        let expected = cell.pmf * (image.size()[0] * image.size()[1]) as f32;
        let off = (image.pdf(p) / expected - 1.0).abs();
        assert!(off < 3e-7, "{weights:?} of {width} at {u:?}: pmf off by {off:e}");
        let back = image.invert_cell(cell.x, cell.y, cell.offset);
        let off = (back.x - u.x).abs().max((back.y - u.y).abs());
        assert!(f64::from(off) <= STEP, "{weights:?} of {width} at {u:?}: {back:?}");
    }
}

/// Environment images: the evaluated pdf and the inverse agree with the sample.
pub(super) fn environment(input: &mut Input<'_>) {
    let map = if input.below(2) == 0 { EnvironmentMap::EqualArea } else { EnvironmentMap::Equirectangular };
    let (weights, error) = weights(input, 40);
    let width = 1 + input.below(weights.len() as u8) as usize;
    let height = weights.len() / width;
    let weights = &weights[..width * height];
    let mut buffer = vec![0.0; ImageEnvironment::buffer(width, height)];
    let built = ImageEnvironment::build(weights, width, map, &mut buffer);
    let Ok(image) = built else {
        assert!(error.is_some() || weights.iter().all(|w| *w == 0.0), "{weights:?} of {width}");
        return;
    };
    for _ in 0..4 {
        let square = input.square();
        let s = image.draw::<f32>(squares_of(&[square]));
        let w = s.light.direction;
        let off = (f64::from(w.length_squared()) - 1.0).abs();
        assert!(off < 2e-6 && s.light.pdf > 0.0 && s.light.pdf.is_finite(), "{weights:?} of {width}: {s:?}");
        assert!(weights[s.x as usize + s.y as usize * width] > 0.0, "{weights:?} of {width} at {square:?}: {s:?}");
        let eight = image.draw::<f32x8>(squares_of(&[square]));
        assert_eq!((eight.x.lane(3), eight.light.pdf.lane(3)), (s.x, s.light.pdf));
        // the inverse finds the same texel, unless the direction is next to its edge
        let texel = image.texel(w);
        let inner = |x: f32| (1e-3..0.999).contains(&x);
        if inner(texel.offset.x) && inner(texel.offset.y) {
            assert_eq!((texel.x, texel.y), (s.x, s.y), "{map:?} {weights:?} of {width} at {square:?}");
            let off = (image.pdf(w) / s.light.pdf - 1.0).abs();
            assert!(off < 1e-6, "evaluated pdf off by {off:e}: {map:?} {weights:?} of {width} at {square:?}");
        }
    }
    let any = input.direction();
    let any: Vec3<f32> = vectors_of(|_| any);
    assert!(image.pdf(any) >= 0.0 && image.pdf(any).is_finite());
    let back = image.invert(any);
    assert!((0.0..1.0).contains(&back.x) && (0.0..1.0).contains(&back.y));
}

fn chosen(choice: Choice<f32>, pmf: impl Fn(u32) -> f32, packet: Choice<f32x8>, powers: &[f32]) {
    assert_eq!(choice.pmf, pmf(choice.index), "{powers:?}: {choice:?}");
    assert!((0.0..1.0).contains(&choice.u), "{powers:?}: {choice:?}");
    assert_eq!(
        (packet.index.lane(6), packet.pmf.lane(6), packet.u.lane(6)),
        (choice.index, choice.pmf, choice.u),
        "{powers:?}"
    );
    let some = powers.iter().any(|p| *p > 0.0 && *p < f32::INFINITY);
    assert_eq!(some, choice.pmf > 0.0, "{powers:?}: {choice:?}");
    if some {
        assert!(powers[choice.index as usize] > 0.0, "a light without power: {powers:?}: {choice:?}");
    }
    let sum: f64 = (0..powers.len() as u32).map(|k| f64::from(pmf(k))).sum();
    assert!((sum - f64::from(u8::from(some))).abs() < 1e-5, "Σpmf = {sum}: {powers:?}");
    assert_eq!([pmf(powers.len() as u32), pmf(u32::MAX)], [0.0; 2]);
}

/// Choices of lights of any power and place.
pub(super) fn light_choice(input: &mut Input<'_>) {
    let u = input.unit();
    let count = input.word() >> 10;
    let uniform = UniformLights { count };
    let choice: Choice<f32> = uniform.choose(u);
    assert!(count == 0 || choice.index < count && choice.pmf > 0.0 && (0.0..1.0).contains(&choice.u));
    let mut powers = input.weights(20);
    let mut sums = vec![0.0; powers.len()];
    if let Ok(lights) = PiecewiseConstant1d::build(&powers, &mut sums) {
        chosen(lights.choose(u), |k| lights.pmf(k), lights.choose(f32x8::splat(u)), &powers);
    }
    // the documented domain: powers from 1e−20 to 1e20
    powers.iter_mut().for_each(|p| *p = if *p > 0.0 { p.clamp(1e-20, 1e20) } else { 0.0 });
    let mut before = vec![[0.0; 3]];
    let bounds: Vec<_> = powers
        .iter()
        .map(|&power| {
            let center = input.vector(&before);
            before.push(center);
            let normal = if input.word().is_multiple_of(2) { [0.0; 3] } else { input.direction() };
            LightBound {
                center,
                radius: input.weight(),
                normal,
                cos_cone: 0.0,
                two_sided: input.word().is_multiple_of(2),
                power,
            }
        })
        .collect();
    let (p, n) = (input.vector(&before), input.direction());
    let lights = SpatialLights::new(&bounds).expect("few lights");
    let (one, eight) = (lights.at::<f32>(p.into(), n.into()), lights.at::<f32x8>(p.into(), n.into()));
    // what cannot contribute counts as without power; lengths below 2⁻⁵⁰ of the extent of the lights do not count, nor subnormal ones
    let reach = |bound: &LightBound| bound.center.iter().fold(bound.radius, |m, x| m.max(x.abs()));
    let extent = bounds.iter().map(reach).fold(0.0, f32::max);
    let able: Vec<f32> = one.weights().collect();
    for ((bound, able), power) in bounds.iter().zip(&able).zip(&powers) {
        let wide = |v: [f32; 3]| v.map(f64::from);
        let to = sub(wide(bound.center), wide(p));
        let room = 1e-5 * (length(to) + length(wide(bound.center)) + length(wide(p)) + f64::from(bound.radius));
        let room = room + 1e-14 * f64::from(extent) + f64::from(f32::MIN_POSITIVE);
        let facing = bound.normal == [0.0; 3] || bound.two_sided || -dot(to, wide(bound.normal)) > room;
        let away = dot(to, wide(bound.normal)).abs() > room || bound.normal == [0.0; 3];
        let above = dot(to, wide(n)) + f64::from(bound.radius) > room;
        assert!(*able >= 0.0 && (*power > 0.0 || *able == 0.0), "{bound:?} {able:e}");
        assert!(!(facing && away && above && *power > 0.0) || *able > 0.0, "{bound:?} from {p:?} over {n:?} is lost");
    }
    chosen(one.choose(u), |k| one.pmf(k), eight.choose(f32x8::splat(u)), &able);
}

/// Masks and counters: every lane equals the scalar result.
pub(super) fn bits(input: &mut Input<'_>) {
    let words: [u32; 8] = core::array::from_fn(|_| input.word());
    let others: [u32; 8] = core::array::from_fn(|_| input.word());
    let shift = u32::from(input.below(32));
    let numbers: [f32; 8] = core::array::from_fn(|_| input.number());
    let (words, others, numbers) = (twice(&words), twice(&others), twice(&numbers));
    bits_of::<f32x4>(&words, &others, shift, &numbers);
    bits_of::<f32x8>(&words, &others, shift, &numbers);
    bits_of::<f32x16>(&words, &others, shift, &numbers);
}

fn bits_of<R: Real<Scalar = f32>>(words: &[u32; 16], others: &[u32; 16], shift: u32, numbers: &[f32; 16]) {
    let (a, b) = (R::Uint::from_fn(|k| words[k]), R::Uint::from_fn(|k| others[k]));
    let x = R::from_fn(|k| numbers[k]);
    let all = u32::MAX >> (32 - R::LANES);
    // the bits past the last lane count for nothing
    let (mask, other) = (R::Mask::from_bits(words[0]), R::Mask::from_bits(others[0]));
    let set = words[0] & all;
    assert_eq!((mask.bits(), mask.any(), mask.all()), (set, set != 0, set == all));
    assert_eq!([mask & other, mask | other, mask ^ other, !mask].map(Mask::bits), {
        let (p, q) = (words[0], others[0]);
        [p & q, p | q, p ^ q, !p].map(|bits| bits & all)
    });
    for value in [false, true] {
        let mask = R::Mask::splat(value);
        assert_eq!((mask.bits(), mask.any(), mask.all()), (if value { all } else { 0 }, value, value));
    }
    assert_eq!((a.any(), R::Uint::splat(0).any()), (words[..R::LANES].iter().any(|w| *w != 0), false));
    assert!((R::LANES..40).all(|k| !mask.lane(k)));
    for k in 0..R::LANES {
        let (p, q) = (words[k], others[k]);
        assert_eq!(mask.lane(k), words[0] >> k & 1 == 1);
        assert_eq!([a & b, a | b, a ^ b].map(|x| x.lane(k)), [p & q, p | q, p ^ q]);
        assert_eq!(Uint::wrapping_add(a, b).lane(k), p.wrapping_add(q));
        assert_eq!(Uint::wrapping_sub(a, b).lane(k), p.wrapping_sub(q));
        assert_eq!(Uint::wrapping_mul(a, b).lane(k), p.wrapping_mul(q));
        assert_eq!((Uint::shl(a, shift).lane(k), Uint::shr(a, shift).lane(k)), (p << shift, p >> shift));
        assert_eq!(Uint::reverse_bits(a).lane(k), p.reverse_bits());
        assert_eq!(Uint::lt(a, b).lane(k), if p < q { u32::MAX } else { 0 });
        assert_eq!(R::blend_uint(mask, a, b).lane(k), if mask.lane(k) { p } else { q });
        assert_eq!(R::unit(a).lane(k), (p >> 8) as f32 / 16_777_216.0);
        assert_eq!(R::from_uint(Uint::shr(a, 8)).lane(k), (p >> 8) as f32);
        assert_eq!(R::from_uint(Uint::shr(a, 8)).to_uint().lane(k), p >> 8);
        let y = numbers[(k + 3) % R::LANES];
        let lane = numbers[k];
        let ys = R::splat(y);
        assert_eq!((x.lt(ys).lane(k), x.gt(ys).lane(k)), (lane < y, lane > y));
        assert_eq!((x.le(ys).lane(k), x.ge(ys).lane(k)), (lane <= y, lane >= y));
        let pairs = [
            (x.lesser(ys), Real::lesser(lane, y)),
            (x.greater(ys), Real::greater(lane, y)),
            (x.abs(), lane.abs()),
            (x.copysign(ys), lane.copysign(y)),
            (x.sqrt(), lane.sqrt()),
            (x / ys, lane / y),
            (x.round_ties_even(), lane.round_ties_even()),
            (x.pow2_scale(), lane.pow2_scale()),
            (x.mul_add(ys, x), Real::mul_add(lane, y, lane)),
            (R::two_prod_error(x, ys, x * ys), Real::two_prod_error(lane, y, lane * y)),
            (x.keep(mask), if mask.lane(k) { lane } else { 0.0 }),
            (R::blend(mask, x, ys), if mask.lane(k) { lane } else { y }),
            (x.negate_where(mask), if mask.lane(k) { -lane } else { lane }),
        ];
        for (i, (packet, one)) in pairs.into_iter().enumerate() {
            let packet = packet.lane(k);
            assert!(
                packet.to_bits() == one.to_bits() || packet.is_nan() && one.is_nan(),
                "{i}, {} lanes: {lane:e} {y:e}: {packet:e} is not {one:e}",
                R::LANES
            );
        }
    }
}
