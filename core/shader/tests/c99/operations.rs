//! Each operation by itself: its bits in C, and in Metal, which is made of WGSL.

use crate::driver::{HOSTILE, compare};
use crate::program::Driver;
use etendue::{Mask, Real, Uint};
use etendue_judge::generators::Random;
use etendue_shader::*;

/// The memory that functions read. A slice reads 0 past the end, and a source the last word: here they are the same.
const WORDS: [u32; 6] = [0x3f80_0000, 0xc049_0fdb, 4_000_000_000, 0x0000_0001, 0x7f80_0000, 0];

/// What functions take: numbers, words and truth values; and the memory.
struct Arguments<R: Real> {
    x: [R; 3],
    k: [R::Uint; 2],
    p: [R::Mask; 2],
    load: fn(R::Uint) -> R,
}
impl Arguments<f32> {
    fn of(x: &[f32]) -> Self {
        let load = |k: u32| WORDS.get(k as usize).map_or(0.0, |bits| f32::from_bits(*bits));
        let [truth, word] = [|x: f32| u32::from(x > 0.5), f32::to_bits];
        let (k, p) = ([word(x[3]), word(x[4])], [truth(x[5]) == 1, truth(x[6]) == 1]);
        Self { x: [x[0], x[1], x[2]], k, p, load }
    }
}
impl Arguments<Number> {
    fn inputs() -> Self {
        Self {
            x: [0, 1, 2].map(Number::input),
            k: [3, 4].map(Word::input),
            p: [5, 6].map(Truth::input),
            load: Number::load,
        }
    }
}
const NAMES: [(&str, Leaf); 7] = [
    ("a", Leaf::Real),
    ("b", Leaf::Real),
    ("c", Leaf::Real),
    ("k", Leaf::Word),
    ("m", Leaf::Word),
    ("p", Leaf::Truth),
    ("q", Leaf::Truth),
];

/// What a function returns.
enum Value<R: Real> {
    Real(R),
    Truth(R::Mask),
    Word(R::Uint),
    /// Up to three numbers.
    Several(Vec<R>),
}
impl Value<Number> {
    fn ids(self) -> (Leaf, Vec<Id>) {
        match self {
            Self::Real(x) => (Leaf::Real, vec![x.id()]),
            Self::Truth(x) => (Leaf::Truth, vec![x.id()]),
            Self::Word(x) => (Leaf::Word, vec![x.id()]),
            Self::Several(all) => (Leaf::of_numbers(all.len()), all.into_iter().map(Number::id).collect()),
        }
    }
}
impl Value<f32> {
    fn numbers(self) -> Vec<f32> {
        match self {
            Self::Real(x) => vec![x],
            Self::Truth(x) => vec![f32::from(u8::from(x))],
            // halves of words are numbers
            Self::Word(x) => vec![(x >> 16) as f32, (x & 0xffff) as f32],
            Self::Several(all) => all,
        }
    }
}

/// Adds one odd number after another, so that no step is like another, and returns the sum and the next one.
fn squares<R: Real>(of: &Arguments<R>, count: usize) -> [R; 2] {
    let step = |[sum, odd]: [R; 2], [p, q]: [R::Mask; 2]| {
        let going = p | q;
        let next = [sum + odd, odd + R::lit(2.0)];
        ([R::blend(going, next[0], sum), R::blend(going, next[1], odd)], [p & next[0].lt(of.x[1]), q])
    };
    R::iterate(count, [of.x[0], R::lit(1.0)], of.p, step)
}

/// The sum of the numbers of a table with the weights 1, ½, ⅓, …, each of which a loop inside of the loop makes: until the first number that
/// is 0, or one that is negative if `p` holds. Also, the number of steps.
fn table_sums<R: Real>(of: &Arguments<R>) -> [R; 2] {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let step = |[sum, all, index]: [R; 3], [going]: [R::Mask; 1]| {
        let number = (of.load)(index.to_uint());
        let going = going & !(number.le(zero) & number.ge(zero)) & !(of.p[0] & number.lt(zero));
        let weigh = |[weight, k]: [R; 2], [more]: [R::Mask; 1]| {
            let here = more & going;
            let after = k + one;
            ([R::blend(here, one / after, weight), R::blend(here, after, k)], [here & after.le(index)])
        };
        let [weight, count] = R::iterate(5, [one, zero], [going], weigh);
        let next = [number.mul_add(weight, sum), all + count, index + one];
        ([R::blend(going, next[0], sum), R::blend(going, next[1], all), R::blend(going, next[2], index)], [going])
    };
    let [sum, all, _] = R::iterate(9, [of.x[0], zero, zero], [R::Mask::splat(true)], step);
    [sum, all]
}

/// An operation on the arguments. The match has no other arm, so that a new operation needs its line here.
fn operation<R: Real>(op: Op, of: &Arguments<R>) -> Value<R> {
    let ([a, b, c], [k, m], [p, q]) = (of.x, of.k, of.p);
    let (real, truth, word) = (Value::Real, Value::Truth, Value::Word);
    match op {
        Op::Real(bits) => real(R::lit(f32::from_bits(bits).into())),
        Op::Truth(value) => truth(R::Mask::splat(value)),
        Op::Word(value) => word(R::Uint::splat(value)),
        Op::Input(..) => real(a),
        Op::Add => real(a + b),
        Op::Sub => real(a - b),
        Op::Mul => real(a * b),
        Op::Div => real(a / b),
        Op::Neg => real(-a),
        Op::MulAdd => real(a.mul_add(b, c)),
        Op::Sqrt => real(a.sqrt()),
        Op::Abs => real(a.abs()),
        Op::Round => real(a.round_ties_even()),
        Op::CopySign => real(a.copysign(b)),
        Op::Lesser => real(a.lesser(b)),
        Op::Greater => real(a.greater(b)),
        Op::Pow2Scale => real(a.pow2_scale()),
        Op::InverseCbrtEstimate => real(a.inverse_cbrt_estimate()),
        Op::Unit => real(R::unit(k)),
        Op::FromWord => real(R::from_uint(k)),
        Op::ToWord => word(a.to_uint()),
        Op::Less => truth(a.lt(b)),
        Op::LessEqual => truth(a.le(b)),
        Op::And => truth(p & q),
        Op::Or => truth(p | q),
        Op::Xor => truth(p ^ q),
        Op::Not => truth(!p),
        Op::Select => real(R::blend(p, a, b)),
        Op::WordAdd => word(k.wrapping_add(m)),
        Op::WordSub => word(k.wrapping_sub(m)),
        Op::WordMul => word(k.wrapping_mul(m)),
        Op::WordAnd => word(k & m),
        Op::WordOr => word(k | m),
        Op::WordXor => word(k ^ m),
        Op::WordShl(bits) => word(k.shl(bits)),
        Op::WordShr(bits) => word(k.shr(bits)),
        Op::WordReverse => word(k.reverse_bits()),
        Op::WordLess => word(Uint::lt(k, m)),
        Op::Load | Op::FromBits => real((of.load)(k)),
        Op::WordAny => truth(R::has_bits(k & m)),
        Op::Call(Call::SinCosTurns) | Op::Part(0) => real(a.sin_cos_turns().0),
        Op::Call(Call::SinCosQuarters) | Op::Part(_) => real(a.sin_cos_quarters().1),
        Op::Call(Call::Acos) => real(a.acos()),
        Op::Call(Call::Atan2) => real(a.atan2(b)),
        Op::Call(Call::AtanEighth) => real(a.atan_eighth()),
        Op::Call(Call::Cbrt) => real(a.cbrt()),
        Op::LoopVariable(..) | Op::Loop(_) | Op::LoopResult(..) => Value::Several(squares(of, 7).to_vec()),
    }
}
fn operations() -> Vec<Op> {
    let calls = [Call::SinCosTurns, Call::SinCosQuarters, Call::Acos, Call::Atan2, Call::AtanEighth, Call::Cbrt];
    let constants = [Op::Real(0.1_f32.to_bits()), Op::Truth(true), Op::Word(4_000_000_000), Op::Input(Kind::Real, 0)];
    let sums = [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Neg, Op::MulAdd, Op::Sqrt, Op::Abs, Op::Round, Op::CopySign];
    let choices = [Op::Lesser, Op::Greater, Op::Less, Op::LessEqual, Op::And, Op::Or, Op::Xor, Op::Not, Op::Select];
    let bits = [Op::Pow2Scale, Op::InverseCbrtEstimate, Op::Unit, Op::FromWord, Op::ToWord, Op::WordReverse];
    let words = [Op::WordAdd, Op::WordSub, Op::WordMul, Op::WordAnd, Op::WordOr, Op::WordXor, Op::WordLess];
    let others = [Op::Load, Op::WordShl(7), Op::WordShr(7), Op::WordAny, Op::Loop(0)];
    [&constants[..], &sums, &choices, &bits, &words, &others, &calls.map(Op::Call)].concat()
}

/// Numbers that one function returns together: operations that are alike but not the same, what a simplification must keep, and
/// expressions inside of expressions.
fn together<R: Real>(of: &Arguments<R>) -> Vec<Vec<R>> {
    let ([a, b, c], [k, m], [p, q]) = (of.x, of.k, of.p);
    let (zero, one, same) = (R::lit(0.0), R::lit(1.0), a);
    let truth = |mask: R::Mask| R::blend(mask, one, zero);
    let mut all = vec![
        // operands in the other order
        vec![a.lesser(b), b.lesser(a)],
        vec![a.greater(b), b.greater(a)],
        vec![a - b, b - a],
        vec![a / b, b / a],
        vec![a.copysign(b), b.copysign(a)],
        vec![a.atan2(b), b.atan2(a)],
        vec![truth(a.lt(b)), truth(b.lt(a))],
        vec![truth(a.le(b)), truth(b.le(a))],
        vec![R::blend(p, a, b), R::blend(p, b, a), R::blend(!p, a, b)],
        vec![R::unit(k.wrapping_sub(m)), R::unit(m.wrapping_sub(k))],
        vec![a.mul_add(b, c), a.mul_add(c, b), b.mul_add(a, c)],
        // the sign of 0, and what is no number
        vec![a + zero, zero + a, a - zero],
        vec![zero - a, -zero - a, a + -zero],
        vec![-zero + a, a - -zero, a * zero],
        vec![a * one, a * -one, -one * a],
        vec![a / one, a / -one, one / a],
        vec![a.mul_add(one, c), a.mul_add(b, -zero), a.mul_add(b, zero)],
        vec![one.mul_add(b, c), -(-a), (-a).abs()],
        vec![a + -b, -a + b, -a + -b],
        vec![a - -b, -(a - b), b - a],
        vec![a - same, a / same, -a - b],
        vec![a.lesser(a), a.greater(zero), zero.greater(a)],
        vec![a.lesser(zero), zero.lesser(a), a.copysign(-zero)],
        // parts of expressions
        vec![a - (b - c), a - (b + c), a - b - c],
        vec![a / (b * c), a / (b / c), a * (b / c)],
        vec![(a + b) * c, a * (b - c), -(a + b) * c],
        vec![R::blend(p, a, b) * c, a - R::blend(q, b, c), R::blend(a.lt(b), a - b, b - c)],
        vec![truth(p & (q | a.lt(b))), truth((p & q) | b.lt(c)), truth(!(p | q) & a.le(c))],
        vec![truth(p ^ (q & a.lt(b))), truth(!(p ^ q)), truth((p | q) & (a.lt(c) | b.lt(c)))],
        // one mask twice, the other side of a mask, and a guard against 0
        vec![R::blend(p, R::blend(p, a, b), c), R::blend(p, a, R::blend(p, b, c)), R::blend(!p, R::blend(p, a, b), c)],
        vec![R::blend(p, a / R::blend(p, b, one), c), R::blend(p, c, a / R::blend(p, one, b)), (a / b).keep(q)],
        vec![a.negate_where(p), R::from_uint(R::blend_uint(p, k, m).shr(9)), (-a).keep(p)],
        // branches
        vec![R::where_any(p, a, || (a + b).sqrt() / c)],
        vec![R::where_any(!q, b, || R::where_any(p, a * b, || (a + b).sqrt() / c)) * a],
        R::where_any(p & q, [a, b], || [(a * b).sqrt() + c, (a * b).sqrt() - c]).to_vec(),
        squares(of, 1).to_vec(),
        table_sums(of).to_vec(),
    ];
    // constants with many digits, and the largest and smallest
    let constants = [1.0 / 3.0, 16_777_215.0, 1.000_000_1, 8.589_973e9, 1e-45, 1.175_494_2e-38, 3.402_823_3e38, -0.1];
    all.extend(constants.map(|value: f32| vec![R::lit(value.into()), R::lit(value.into()) * a]));
    all
}

/// The functions of a module with their results: each operation, and what stands together.
fn module() -> Module {
    let parameters = || NAMES.map(|(name, leaf)| Parameter { name: name.into(), of: Type::Leaf(leaf) }).to_vec();
    let function = |name: String, value: &dyn Fn(&Arguments<Number>) -> Value<Number>| {
        let ((result, outputs), graph) = record(|| value(&Arguments::inputs()).ids());
        let inputs = (0..NAMES.len()).map(|parameter| Access { parameter, field: None, axis: None }).collect();
        let (doc, parameters, result) = ("A function of a test.".into(), parameters(), Type::Leaf(result));
        Function { name, doc, parameters, inputs, result, outputs, graph }
    };
    let mut functions = Vec::new();
    for (k, op) in operations().into_iter().enumerate() {
        functions.push(function(format!("operation_{k}_of"), &|of| operation(op, of)));
    }
    let (count, _) = record(|| together(&Arguments::inputs()).len());
    for k in 0..count {
        functions.push(function(format!("together_{k}_of"), &|of| Value::Several(together(of).swap_remove(k))));
    }
    let mut module = Module { functions, ..Module::default() };
    add_calls(&mut module);
    module
}

/// Programs that call each function of the module, the arguments, and the right numbers.
fn prepared(module: &Module) -> (Driver<'_>, Vec<Vec<f32>>, Vec<Vec<f32>>) {
    let mut driver = Driver::new(module);
    driver.memory = WORDS.to_vec();
    for (name, leaf) in NAMES {
        driver.take(Type::Leaf(leaf), name);
    }
    let names: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
    for function in module.functions.iter().filter(|function| function.name.ends_with("_of")) {
        driver.output(&function.name, &names, &function.name);
    }
    let mut random = Random::new(4000);
    let mut number = |leaf| match leaf {
        Leaf::Truth => f32::from(u8::from(random.word().is_multiple_of(2))),
        Leaf::Word if random.word().is_multiple_of(3) => f32::from_bits(random.word() as u32 % 9),
        // numbers below 2^31, as words are that become numbers
        Leaf::Word => f32::from_bits(random.word() as u32 >> 1),
        _ if random.word().is_multiple_of(3) => HOSTILE[random.below(HOSTILE.len())],
        // between two integers, for what rounds
        _ if random.word().is_multiple_of(8) => random.below(24) as f32 / 2.0 - 3.0,
        _ if random.word().is_multiple_of(2) => random.range(-3.0, 9.0) as f32,
        _ => random.magnitude(1e-6, 1e6) as f32,
    };
    let inputs: Vec<Vec<f32>> = (0..3000).map(|_| NAMES.iter().map(|(_, leaf)| number(*leaf)).collect()).collect();
    let right = inputs.iter().map(|input| {
        let of = Arguments::of(input);
        let each = operations().into_iter().flat_map(|op| operation(op, &of).numbers());
        each.chain(together(&of).into_iter().flatten()).collect()
    });
    let right = right.collect();
    (driver, inputs, right)
}

#[test]
fn operations_have_the_same_bits() {
    let module = module();
    let (driver, inputs, right) = prepared(&module);
    driver.same_bits("operations", &["-O1"], &inputs, &right);
}

/// WGSL promises the conversion to words in [0, 2²⁴] alone, so that what converts is compared for normal numbers of this range.
#[test]
fn operations_have_the_same_bits_in_metal() {
    let module = module();
    let (driver, inputs, mut right) = prepared(&module);
    let mut found = driver.run_metal("operations_metal", &inputs);
    let converts = |op: &Op| matches!(op, Op::ToWord | Op::InverseCbrtEstimate | Op::Call(Call::Cbrt));
    let defined = operations().into_iter().flat_map(|op| {
        let count = operation(op, &Arguments::of(&[0.0; 7])).numbers().len();
        vec![!converts(&op); count]
    });
    let defined: Vec<bool> = defined.collect();
    let in_domain = |input: &[f32]| (f32::MIN_POSITIVE..16_777_216.0).contains(&input[0]);
    for k in (0..inputs.len()).filter(|&k| !in_domain(&inputs[k])) {
        for place in (0..defined.len()).filter(|&place| !defined[place]) {
            (right[k][place], found[k][place]) = (0.0, 0.0);
        }
    }
    assert!(inputs.iter().filter(|input| in_domain(input)).count() > 1000);
    compare("operations in Metal", &inputs, &right, &found);
}
