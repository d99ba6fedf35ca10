//! Operations and elementary functions, and what estimators compute of them.

use crate::figures::{Figures, Lanes, List, Routine};
use etendue::estimate::{Heuristic, Welford};
use etendue::math::{atan2_turns, difference_of_products, one_minus_cos, rsqrt};
use etendue::{Frame, Real, Uint, Vec3};
use etendue_judge::generators::{NASTY, Random};

/// A function of five numbers.
struct Function<F>(Domain, F);

/// Where arguments come from. All are of double precision, and are rounded for single.
#[derive(Clone, Copy)]
enum Domain {
    /// Multiples of 2⁻²⁴ in [0, 1), and numbers between.
    Unit,
    /// [−1, 1].
    Signed,
    /// Positive, of any magnitude between 1e−30 and 1e30.
    Positive,
    /// Any magnitude between 1e−30 and 1e30, and either sign.
    Wide,
    /// Anything that is finite in single precision: subnormal numbers, signed zeros and the greatest.
    Any,
}

impl Domain {
    fn draw(self, random: &mut Random) -> f64 {
        let word = random.word();
        let sign = if word & 1 == 0 { 1.0 } else { -1.0 };
        match self {
            Self::Unit if word & 6 == 0 => f64::from(random.unit()),
            Self::Unit if word & 6 == 2 => 1.0 - random.magnitude(1e-7, 1.0),
            Self::Unit => random.unit_f64(),
            Self::Signed if word & 6 == 0 => sign * (1.0 - random.magnitude(1e-12, 1.0)),
            Self::Signed if word & 6 == 2 => sign * random.magnitude(1e-30, 1.0),
            Self::Signed => sign * random.unit_f64(),
            Self::Positive => random.magnitude(1e-30, 1e30),
            Self::Wide if word & 6 == 0 => f64::from(NASTY[(word >> 40) as usize % 12]),
            Self::Wide => sign * random.magnitude(1e-30, 1e30),
            Self::Any if word & 6 == 0 => f64::from(NASTY[(word >> 40) as usize % NASTY.len()]),
            Self::Any => f64::from(random.any_f32()),
        }
    }
}

/// What a [`Function`] evaluates.
trait Body {
    fn call<R: Real>(&self, x: [R; 5], lanes: &mut Lanes<'_>);
}

impl<F: Body> Routine for Function<F> {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(1000);
        figures.packets::<R>(250 * Figures::MOST, |_, lanes| {
            let all: Vec<[f64; 5]> =
                (0..R::LANES).map(|_| core::array::from_fn(|_| self.0.draw(&mut random))).collect();
            self.1.call(core::array::from_fn(|k| R::from_fn(|i| R::Scalar::lit(all[i][k]))), lanes);
        });
    }
}

macro_rules! functions {
    ($list:ident: $($name:literal, $domain:ident, |$x:pat_param, $lanes:ident: $real:ident| $body:block;)+) => {$({
        struct This;
        impl Body for This {
            fn call<$real: Real>(&self, $x: [$real; 5], $lanes: &mut Lanes<'_>) $body
        }
        $list.add(concat!("function/", $name), &Function(Domain::$domain, This));
    })+};
}

pub(crate) fn add(list: &mut List<'_>) {
    functions! { list:
        "mul_add", Any, |[a, b, c, d, e], lanes: R| {
            // sums near halfway between two numbers, and those that cancel
            lanes.reals([a.mul_add(b, c), d.mul_add(R::lit(1.0), e), d.mul_add(R::lit(3.0), e)].map(finite));
        };
        "mul_add_that_cancels", Wide, |[a, b, ..], lanes: R| {
            let some = (a * b).abs().lt(R::lit(1e30));
            let product = (a * b).keep(some);
            let error = R::two_prod_error(a.keep(some), b.keep(some), product);
            lanes.reals([error, a.keep(some).mul_add(b.keep(some), product), difference_of_products(a.keep(some), b.keep(some), b.keep(some), a.keep(some))]);
        };
        "mul_add_of_fractions", Signed, |[a, b, c, d, e], lanes: R| {
            lanes.reals([a.mul_add(b, c), d.mul_add(e, -(d * e)), difference_of_products(a, b, c, d)]);
        };
        "comparisons", Any, |[a, b, c, ..], lanes: R| {
            lanes.reals([a.lesser(b), a.greater(b), a.clamped(R::lit(-1.0), R::lit(1.0)), a.abs(), a.copysign(b), -a, a.keep(b.lt(c))]);
            lanes.reals([a.lesser(-a), (-a).greater(a), R::blend(a.gt(b), b, c), a.negate_where(b.ge(c))]);
            for mask in [a.lt(b), a.le(b), a.gt(b), a.ge(b), a.lt(b) ^ b.lt(c), !a.lt(b) & b.le(c) | c.lt(a)] {
                lanes.truth::<R>(mask);
            }
        };
        "sqrt", Positive, |[a, b, c, ..], lanes: R| {
            lanes.reals([a.sqrt(), rsqrt(b), R::lit(0.0).sqrt(), (a * R::lit(1e-10)).sqrt(), a / b, c / a]);
        };
        "round_ties_even", Wide, |[a, b, ..], lanes: R| {
            let small = b.clamped(R::lit(-1e6), R::lit(1e6));
            lanes.reals([a.round_ties_even(), small.round_ties_even(), (small.round_ties_even() * R::lit(0.5)).round_ties_even()]);
        };
        "pow2_scale", Any, |[a, b, ..], lanes: R| {
            lanes.reals([a.pow2_scale(), b.pow2_scale(), a * a.pow2_scale()]);
        };
        "counters", Unit, |[a, b, c, ..], lanes: R| {
            let integer = (a * R::lit(16_777_216.0)).to_uint();
            let other = (b * R::lit(1000.0)).to_uint();
            lanes.reals([R::from_uint(integer), R::unit(integer.shl(8)), R::from_uint(other.wrapping_mul(other))]);
            lanes.words(R::blend_uint(a.lt(c), integer, other));
            lanes.words(integer.reverse_bits().wrapping_sub(other).shr(3));
            lanes.words(integer.lt(other));
        };
        "sin_cos_turns", Unit, |[a, b, ..], lanes: R| {
            let ((s, c), (t, d)) = (a.sin_cos_turns(), (b * R::lit(40.0) - R::lit(20.0)).sin_cos_turns());
            lanes.reals([s, c, t, d]);
        };
        "acos", Signed, |[a, b, ..], lanes: R| { lanes.reals([a.acos(), (b + b).acos()]); };
        "atan2", Wide, |[a, b, c, d, _], lanes: R| { lanes.reals([a.atan2(b), atan2_turns(c, d)]); };
        "atan2_of_fractions", Signed, |[a, b, c, d, _], lanes: R| { lanes.reals([a.atan2(b), atan2_turns(c, d)]); };
        "cbrt", Positive, |[a, b, ..], lanes: R| { lanes.reals([a.cbrt(), b.cbrt()]); };
        "one_minus_cos", Unit, |[a, ..], lanes: R| { lanes.real(one_minus_cos(a)); };
        "two_sum", Wide, |[a, b, ..], lanes: R| {
            let (sum, error) = a.two_sum(b);
            lanes.reals([sum, error]);
        };
        "vectors", Signed, |[a, b, c, d, e], lanes: R| {
            let (v, w) = (Vec3::new(a, b, c), Vec3::new(c, d, e));
            let n = v.normalize();
            let frame = Frame::new(n);
            lanes.vector(n);
            lanes.vector(v.cross(w));
            lanes.vector(frame.to_world(w));
            lanes.vector(frame.to_local(w));
            lanes.reals([v.dot(w), v.length(), v.length_squared_minus_square(d), w.max_abs()]);
        };
        "weights", Positive, |[a, b, c, d, _], lanes: R| {
            for heuristic in [Heuristic::Balance, Heuristic::POWER, Heuristic::Power(5), Heuristic::Maximum] {
                lanes.reals(heuristic.weights([a, b]));
                lanes.reals(heuristic.weights([b, c, d]));
            }
            lanes.real(Heuristic::technique_pdf(R::lit(4.0), a, b.lt(c)));
        };
        "Welford", Signed, |[a, b, c, d, e], lanes: R| {
            let (mut one, mut other) = (Welford::default(), Welford::default());
            [a, b].into_iter().for_each(|x| one.push(x));
            [c, d, e].into_iter().for_each(|x| other.push(x));
            let both = one.merge(other);
            lanes.reals([both.mean(), both.m2(), both.variance(), both.count()]);
        };
    }
}

/// Sums of the greatest numbers overflow to an infinity, which is no argument of any routine.
fn finite<R: Real>(x: R) -> R {
    x.keep(x.abs().lt(R::lit(f64::INFINITY)))
}
