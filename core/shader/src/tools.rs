//! What is neither a light nor a warp: sequences of random numbers, weights that combine techniques, and what lights look up.

use crate::graph::Id;
use crate::inputs::{Inputs, add_function, pair};
use crate::module::{Leaf, Module, Type};
use crate::number::{Number, Truth, Word};
use etendue::estimate::Heuristic;
use etendue::sequence::{Independent, OwenSobol};
use etendue::{LightSample, Mask, Real, Uint, Vec2, Vec3};

/// The names of the functions.
#[must_use]
pub fn tools() -> &'static [&'static str] {
    &[
        "sequence_key",
        "independent_pair",
        "owen_sobol_pair",
        "technique_pdf",
        "balance_weights",
        "power_weights",
        "power_light_weight",
        "power_bsdf_weight",
    ]
}

fn weights(heuristic: Heuristic, inputs: &mut Inputs) -> Vec<Id> {
    heuristic.weights([inputs.real("first"), inputs.real("second")]).map(Number::id).to_vec()
}
/// A sample of which a weight needs only these fields.
fn sample(pdf: Number, emits: Truth, delta: Truth) -> LightSample<Number> {
    LightSample { pdf, emits, delta, ..LightSample::miss(Vec3::default()) }
}

/// Records a function, and says what it does and what its result is.
fn body(name: &str, inputs: &mut Inputs) -> (&'static str, Leaf, Vec<Id>) {
    match name {
        "sequence_key" => {
            let key = Independent::key(inputs.word("low"), inputs.word("high"));
            (
                "The key of a seed of 64 bits, in two halves, which the sequences take; all bits count.",
                Leaf::Word,
                vec![key.id()],
            )
        }
        "independent_pair" => {
            let [pixel, sample, dimension, key] =
                ["pixel", "sample_index", "dimension", "key"].map(|name| inputs.word(name));
            let [x, y, z, w] = Independent::numbers::<Number>(pixel, sample, dimension.shr(1), key);
            // of each block, the even dimension is the first pair
            let odd = Number::from_uint(dimension & Word::splat(1)).gt(Number::lit(0.0));
            let u = Vec2::blend(odd, Vec2::new(z, w), Vec2::new(x, y));
            (
                "Independent random numbers, multiples of 2^-24 in [0, 1), for any counters and the key of a seed.",
                Leaf::Vec2,
                pair(u),
            )
        }
        "owen_sobol_pair" => {
            let [pixel, sample, dimension, key] =
                ["pixel", "sample_index", "dimension", "key"].map(|name| inputs.word(name));
            let u = OwenSobol::pair_by::<Number>(pixel, sample, dimension, key);
            (
                "Owen-scrambled Sobol pairs: in every dimension a (0, 2)-sequence in base 2. Best for counts that are a power of two.",
                Leaf::Vec2,
                pair(u),
            )
        }
        "technique_pdf" => {
            let pdf = Heuristic::technique_pdf(inputs.real("samples"), inputs.real("pdf"), inputs.truth("delta"));
            (
                "What the weights take for a technique with this number of samples and this density; infinite where delta holds.",
                Leaf::Real,
                vec![pdf.id()],
            )
        }
        "balance_weights" => {
            let weights = weights(Heuristic::Balance, inputs);
            (
                "The weights of two techniques by the balance heuristic, given the number of samples times the density of each; their sum is 1 within 2^-23, or 0 where both densities are.",
                Leaf::Vec2,
                weights,
            )
        }
        "power_weights" => {
            let weights = weights(Heuristic::POWER, inputs);
            (
                "The weights of two techniques by the power heuristic with exponent 2, given the number of samples times the density of each; their sum is 1 within 2^-23, or 0 where both densities are.",
                Leaf::Vec2,
                weights,
            )
        }
        "power_light_weight" => {
            let (pdf, emits, delta) = (inputs.real("pdf"), inputs.truth("emits"), inputs.truth("delta"));
            let weight = Heuristic::POWER.light_weight(&sample(pdf, emits, delta), inputs.real("bsdf_pdf"));
            (
                "The weight, over its density, of a sample of a light with these fields, where the surface draws the same direction with the density bsdf_pdf: by the power heuristic, one sample each. 0 where there is no sample.",
                Leaf::Real,
                vec![weight.id()],
            )
        }
        "power_bsdf_weight" => {
            let bsdf_pdf = inputs.real("bsdf_pdf");
            let hit = sample(inputs.real("pdf"), inputs.truth("emits"), Truth::splat(false));
            let weight = Heuristic::POWER.bsdf_weight(bsdf_pdf, &hit);
            (
                "The weight, over its density, of a direction that the surface drew with the density bsdf_pdf, where it hits a light with these fields: by the power heuristic, one sample each. 0 where the light is missed.",
                Leaf::Real,
                vec![weight.id()],
            )
        }
        _ => panic!("there is no function {name}"),
    }
}

/// Adds one of the [`tools`].
///
/// # Panics
/// If it is none of them.
pub fn add_tool(module: &mut Module, name: &str) {
    add_function(module, name, |_, inputs| {
        let (doc, result, outputs) = body(name, inputs);
        (doc.into(), Type::Leaf(result), outputs)
    });
}
