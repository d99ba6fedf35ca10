//! What reads a table in memory.

use crate::inputs::add_function;
use crate::module::{Leaf, Module, Type};
use crate::number::Number;
use crate::record::reflection_struct;
use etendue::Uint;
use etendue::reflection::Reflection;

/// The names of the tables.
#[must_use]
pub const fn tables() -> [&'static str; 1] {
    ["reflection"]
}

/// Adds the functions that read the only one of the [`tables`].
pub fn add_reflection(module: &mut Module) {
    let of = module.add_struct(reflection_struct());
    add_function(module, "reflection_prepare", |_, inputs| {
        let table = inputs.word("table");
        let (alpha, n, view) = (inputs.real("alpha"), inputs.vec3("n"), inputs.vec3("view"));
        let mut outputs = Vec::new();
        Reflection::with_table(|index| Number::load(index.wrapping_add(table)), alpha, n, view)
            .map(|number: Number| outputs.push(number.id()));
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
