//! Sequences of random numbers, and weights of combined techniques.

use crate::driver::{HOSTILE, slots};
use crate::program::Driver;
use etendue::estimate::Heuristic;
use etendue::sequence::{Independent, OwenSobol, Sequence};
use etendue::{LightSample, Vec2, Vec3};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;
use etendue_shader::*;

/// A tool of Rust in scalars: words come as the bits of numbers, and truth values as 0 and 1.
fn tool(name: &str, x: &[f32]) -> Vec<f32> {
    let word = |k: usize| x[k].to_bits();
    let truth = |k: usize| x[k] > 0.5;
    let pair = |u: Vec2<f32>| vec![u.x, u.y];
    let sample =
        |pdf: f32, emits: bool, delta: bool| LightSample { pdf, emits, delta, ..LightSample::miss(Vec3::default()) };
    match name {
        "sequence_key" => {
            let key = Independent::key(word(0), word(1));
            vec![(key >> 16) as f32, (key & 0xffff) as f32]
        }
        "independent_pair" => {
            let [x, y, z, w] = Independent::numbers::<f32>(word(0), word(1), word(2) / 2, word(3));
            if word(2).is_multiple_of(2) { vec![x, y] } else { vec![z, w] }
        }
        "owen_sobol_pair" => pair(OwenSobol::pair_by(word(0), word(1), word(2), word(3))),
        "technique_pdf" => vec![Heuristic::technique_pdf(x[0], x[1], truth(2))],
        "balance_weights" => Heuristic::Balance.weights([x[0], x[1]]).to_vec(),
        "power_weights" => Heuristic::POWER.weights([x[0], x[1]]).to_vec(),
        "power_light_weight" => vec![Heuristic::POWER.light_weight(&sample(x[0], truth(1), truth(2)), x[3])],
        "power_bsdf_weight" => vec![Heuristic::POWER.bsdf_weight(x[0], &sample(x[1], truth(2), false))],
        _ => panic!("the test does not know {name}"),
    }
}

#[test]
fn tools_have_the_same_bits() {
    assert!(tools().len() >= 8, "{:?}", tools());
    for (k, name) in tools().iter().enumerate() {
        let selection = Selection { tools: vec![(*name).into()], ..Selection::default() };
        let module = selection.module();
        let mut driver = Driver::new(&module);
        let parameters = driver.function(name).unwrap().parameters.clone();
        for parameter in &parameters {
            driver.take(parameter.of, &parameter.name);
        }
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        driver.output(name, &names, "value");
        let mut random = Random::new(3800 + k as u64);
        let mut argument = |of: Type| match of {
            Type::Leaf(Leaf::Word) if random.word().is_multiple_of(3) => f32::from_bits(random.word() as u32 % 9),
            Type::Leaf(Leaf::Word) => f32::from_bits(random.word() as u32),
            Type::Leaf(Leaf::Truth) => f32::from(u8::from(random.word().is_multiple_of(2))),
            _ if random.word().is_multiple_of(3) => HOSTILE[random.below(HOSTILE.len())],
            _ => random.magnitude(1e-6, 1e6) as f32,
        };
        let kinds: Vec<Type> =
            parameters.iter().flat_map(|parameter| vec![parameter.of; module.parts(parameter.of).len()]).collect();
        let inputs: Vec<Vec<f32>> = (0..slots()).map(|_| kinds.iter().map(|&of| argument(of)).collect()).collect();
        let right: Vec<_> = inputs.iter().map(|input| tool(name, input)).collect();
        driver.same_bits(&format!("tool_{name}"), cases(&["-O0"], &["-O2"]), &inputs, &right);
    }
}

/// The keys of the functions are those of the core's sequences.
#[test]
fn sequences_are_those_of_the_core() {
    let mut random = Random::new(3900);
    for _ in 0..1000 {
        let (seed, pixel, sample, dimension) =
            (random.word(), random.word() as u32, random.word() as u32, random.word() as u32 % 50);
        let key = f32::from_bits(Independent::key(seed as u32, (seed >> 32) as u32));
        let arguments = [f32::from_bits(pixel), f32::from_bits(sample), f32::from_bits(dimension), key];
        let pair = |u: Vec2<f32>| vec![u.x, u.y];
        assert_eq!(pair(Independent::new(seed).pair(pixel, sample, dimension)), tool("independent_pair", &arguments));
        assert_eq!(pair(OwenSobol::new(seed).pair(pixel, sample, dimension)), tool("owen_sobol_pair", &arguments));
    }
}
