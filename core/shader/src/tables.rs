//! What reads tables in memory: choices among lights, and lights with pictures.

use crate::inputs::{Inputs, add_function, add_words};
use crate::module::{Field, Leaf, Module, Struct, Type};
use crate::number::{Number, Word, Words};
use crate::pictures::{add_pictured, pictured};
use crate::wanted::{Part, Wanted};
use etendue::select::{Choice, LightChoice, TreeWords, TreeWordsAt};

/// The names of the tables.
#[must_use]
pub fn tables() -> Vec<String> {
    ["light_tree".to_owned()].into_iter().chain(pictured()).collect()
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

/// Adds the functions of one of the [`tables`].
///
/// # Panics
/// If it is none of them.
pub fn add_table(module: &mut Module, name: &str, wanted: &Wanted) {
    match name {
        "light_tree" => add_light_tree(module, wanted),
        _ => add_pictured(module, name, wanted),
    }
}
