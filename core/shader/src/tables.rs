//! What reads tables in memory: choices among lights, distributions, and images of the sky.

use crate::distributions::{add_line, add_square};
use crate::inputs::{Inputs, add_function, add_words};
use crate::module::{Field, Leaf, Module, Struct, Type};
use crate::number::{Number, Word, Words};
use crate::record::{drawn_struct, reflection_struct, sample_outputs, sample_struct};
use crate::wanted::{Part, Wanted};
use etendue::LightSampler;
use etendue::light::{EnvironmentMap, EnvironmentWords, ImageSampler};
use etendue::reflection::Reflection;
use etendue::select::{Choice, LightChoice, TreeWords, TreeWordsAt};

/// The names of the tables.
#[must_use]
pub fn tables() -> Vec<String> {
    let choices = ["light_tree", "piecewise_constant_1d", "piecewise_constant_2d"];
    let lights = ["equirectangular_environment", "equal_area_environment", "reflection"];
    choices.into_iter().chain(lights).map(str::to_owned).collect()
}

/// The words of a tree, the shading point and its normal, as parameters.
fn tree(module: &Module, inputs: &mut Inputs, of: usize) -> TreeWordsAt<Number, Words> {
    let [nodes, places, count] = inputs.words(module, "tree", of);
    let (p, n) = (inputs.vec3("p"), inputs.vec3("n"));
    TreeWords { memory: Words, nodes, places, count }.at(p, n)
}

fn add_light_tree(module: &mut Module, wanted: &Wanted) {
    let of = add_words(
        module,
        "light_tree",
        "A tree of lights in memory: the words of Node8::words for each node, as LightTree::build leaves them, and its places.",
        &[
            ("nodes", "Index of the first word of the nodes, of which each has 90."),
            ("places", "Index of the first of the places, which are a word for each light."),
            ("count", "Number of lights."),
        ],
    );
    let field = |name: &str, leaf, doc: &str| Field { name: name.into(), leaf, doc: doc.into() };
    let choice = Type::Struct(module.add_struct(Struct {
        name: "choice".into(),
        doc: "A light that was chosen.".into(),
        fields: vec![
            field("index", Leaf::Word, "Index of the light; 0xffffffff where no light can contribute."),
            field("pmf", Leaf::Real, "Probability with which it was chosen; 0 where there is no light."),
            field("u", Leaf::Real, "What is left of the random number: uniform in [0, 1)."),
        ],
    }));
    let ids = |choice: Choice<Number>| vec![choice.index.id(), choice.pmf.id(), choice.u.id()];
    let law = "in proportion to what the lights can contribute to the point p of a surface with the unit normal n, on the side of n.";
    if wanted.parts.contains(&Part::Sample) {
        add_function(module, "light_tree_choose", |module, inputs| {
            let at = tree(module, inputs, of);
            (format!("Chooses a light by u in [0, 1), {law}"), choice, ids(at.choose(inputs.real("u"))))
        });
        add_function(module, "light_tree_choose_by", |module, inputs| {
            let at = tree(module, inputs, of);
            let words: [Word; 2] = ["first", "second"].map(|name| inputs.word(name));
            let doc = format!(
                "Chooses a light by 64 random bits, {law} The first word decides, from its high bits down; the second one adds digits, so that \
                 there may be 2^27 lights."
            );
            (doc, choice, ids(at.choose_by(words)))
        });
    }
    if wanted.parts.contains(&Part::Pdf) {
        add_function(module, "light_tree_pmf", |module, inputs| {
            let at = tree(module, inputs, of);
            let doc = "The probability with which a light is chosen at the point p of a surface with the unit normal n, with the bits that \
                       the choice reports; 0 for an index past the last light.";
            (doc.into(), Type::Leaf(Leaf::Real), vec![at.pmf(inputs.word("index")).id()])
        });
    }
}

fn add_environment(module: &mut Module, name: &str, map: EnvironmentMap, wanted: &Wanted) {
    let of = add_words(
        module,
        "image_environment",
        "An image of the sphere of directions in memory, as ImageEnvironment::build builds it for one of the maps. In both z is up.",
        &[
            ("first", "Index of the first word of the buffer."),
            ("columns", "Columns of texels."),
            ("rows", "Rows of texels."),
        ],
    );
    let kind = match map {
        EnvironmentMap::EqualArea => {
            "The image covers the sphere as the octahedral map does: it is a square, and all texels are equal in size."
        }
        EnvironmentMap::Equirectangular => "Columns of the image are the azimuth from +x, and rows the angle from +z.",
    };
    let law = format!(
        "In proportion to the weight of the texel times its solid angle, and uniform by that within it. {kind}"
    );
    let environment = |module: &Module, inputs: &mut Inputs| {
        let [first, columns, rows] = inputs.words(module, "environment", of);
        EnvironmentWords { memory: Words, first, size: [columns, rows], map }
    };
    let sampler = |module: &Module, inputs: &mut Inputs| -> ImageSampler<EnvironmentWords<Words, Word>> {
        environment(module, inputs).by_radiance()
    };
    for part in &wanted.parts {
        match part {
            Part::Sample => {
                let drawn = drawn_struct("environment_sample", "A sample of an image of the sky.", wanted);
                let result = Type::Struct(module.add_struct(drawn));
                add_function(module, &format!("{name}_draw"), |module, inputs| {
                    let s = environment(module, inputs).draw(inputs.vec2("u"));
                    let outputs = [sample_outputs(&s.light, wanted), vec![s.x.id(), s.y.id()]].concat();
                    (format!("Draws a direction for u in [0, 1)^2, with its texel. {law}"), result, outputs)
                });
                let result = Type::Struct(module.add_struct(sample_struct(wanted)));
                add_function(module, &format!("{name}_sample"), |module, inputs| {
                    let s = sampler(module, inputs).sample(inputs.vec2("u"));
                    let doc = "Draws a direction for u in [0, 1)^2, with the density that the function for a direction reports.";
                    (format!("{doc} {law}"), result, sample_outputs(&s, wanted))
                });
            }
            Part::Hit => {
                let result = Type::Struct(module.add_struct(sample_struct(wanted)));
                add_function(module, &format!("{name}_hit"), |module, inputs| {
                    let s = sampler(module, inputs).hit(inputs.vec3("w"));
                    let doc = "What is seen in the unit direction w, with the density of that; uv is the position in the image.";
                    (format!("{doc} {law}"), result, sample_outputs(&s, wanted))
                });
            }
            Part::Pdf => add_function(module, &format!("{name}_pdf"), |module, inputs| {
                let pdf = sampler(module, inputs).pdf(inputs.vec3("w"));
                let doc = format!("The density with which the unit direction w is drawn, per steradian. {law}");
                (doc, Type::Leaf(Leaf::Real), vec![pdf.id()])
            }),
            Part::Invert => add_function(module, &format!("{name}_invert"), |module, inputs| {
                let u = sampler(module, inputs).invert(inputs.vec3("w"));
                let doc = format!("The u in [0, 1)^2 that is mapped to the unit direction w. {law}");
                (doc, Type::Leaf(Leaf::Vec2), vec![u.x.id(), u.y.id()])
            }),
            Part::Measure => {}
        }
    }
}

fn add_reflection(module: &mut Module) {
    let of = module.add_struct(reflection_struct());
    add_function(module, "reflection_prepare", |_, inputs| {
        let table = inputs.word("table");
        let (alpha, n, view) = (inputs.real("alpha"), inputs.vec3("n"), inputs.vec3("view"));
        let mut outputs = Vec::new();
        Reflection::with_table(&Words, table, alpha, n, view).map(|number: Number| outputs.push(number.id()));
        let doc = "Prepares the reflection of a surface of the roughness alpha, from 3e-4 to 1, with the unit normal n, towards the viewer in the \
                   unit direction view. The numbers of etendue::reflection::table are in memory from the word table on. A view below the \
                   horizon counts as one on the horizon, and has albedo 0.";
        (doc.into(), Type::Struct(of), outputs)
    });
    add_function(module, "reflection_sphere", |module, inputs| {
        let mut numbers = inputs.numbers(module, "reflection", of).into_iter();
        let reflection = Reflection::<f32>::default().map(|_| numbers.next().expect("the struct has all numbers"));
        let covered = reflection.sphere(inputs.vec3("center"), inputs.real("radius"));
        let doc = "The projected solid angle after the map of a sphere with this center relative to the point, in [0, pi]: about pi times the \
                   part of the lobe that it covers. A radius <= 0 gives 0, and a point inside pi.";
        (doc.into(), Type::Leaf(Leaf::Real), vec![covered.id()])
    });
}

/// Adds the functions of one of the [`tables`].
///
/// # Panics
/// If it is none of them.
pub fn add_table(module: &mut Module, name: &str, wanted: &Wanted) {
    match name {
        "light_tree" => add_light_tree(module, wanted),
        "equirectangular_environment" => add_environment(module, name, EnvironmentMap::Equirectangular, wanted),
        "equal_area_environment" => add_environment(module, name, EnvironmentMap::EqualArea, wanted),
        "reflection" => add_reflection(module),
        "piecewise_constant_1d" => add_line(module, wanted),
        "piecewise_constant_2d" => add_square(module, wanted),
        _ => panic!("there is no table {name}"),
    }
}
