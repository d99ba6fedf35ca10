//! Discrete and piecewise constant distributions, which are read from memory.

use crate::graph::Id;
use crate::inputs::{Inputs, add_function, add_words};
use crate::module::{Field, Leaf, Module, Struct, Type};
use crate::number::{Number, Word, Words};
use crate::wanted::{Part, Wanted};
use etendue::discrete::{Cell, Words1d, Words2d};

fn field(name: &str, leaf: Leaf, doc: &str) -> Field {
    Field { name: name.into(), leaf, doc: doc.into() }
}
/// The struct of a cell.
fn cell(module: &mut Module) -> Type {
    Type::Struct(module.add_struct(Struct {
        name: "cell".into(),
        doc: "A cell drawn from a table.".into(),
        fields: vec![
            field("index", Leaf::Word, "Index of the cell."),
            field("offset", Leaf::Real, "Position in the cell, in [0, 1): what is left of u, uniform."),
            field("pmf", Leaf::Real, "Probability of the cell."),
        ],
    }))
}
fn cell_ids(cell: Cell<Number>) -> Vec<Id> {
    vec![cell.index.id(), cell.offset.id(), cell.pmf.id()]
}
const REAL: Type = Type::Leaf(Leaf::Real);

pub(crate) fn add_line(module: &mut Module, wanted: &Wanted) {
    let doc = "A distribution on [0, 1) in memory whose density is constant in each of its cells, as PiecewiseConstant1d::build leaves it.";
    let fields = [("first", "Index of the first word."), ("count", "Number of cells.")];
    let of = add_words(module, "piecewise_constant_1d", doc, &fields);
    let table = |module: &Module, inputs: &mut Inputs| {
        let [first, count] = inputs.words(module, "table", of);
        Words1d { memory: Words, first, count }
    };
    let name = |part: &str| format!("piecewise_constant_1d_{part}");
    if wanted.parts.contains(&Part::Sample) {
        let result = cell(module);
        add_function(module, &name("cell"), |module, inputs| {
            let cell = table(module, inputs).cell(inputs.real("u"));
            ("Draws a cell by its weight for u in [0, 1), and a position in it.".into(), result, cell_ids(cell))
        });
    }
    if wanted.parts.contains(&Part::Pdf) {
        add_function(module, &name("pmf"), |module, inputs| {
            let pmf: Number = table(module, inputs).pmf(inputs.word("index"));
            ("The probability of a cell; 0 past the last one.".into(), REAL, vec![pmf.id()])
        });
    }
    if wanted.parts.contains(&Part::Invert) {
        add_function(module, &name("invert_cell"), |module, inputs| {
            let table = table(module, inputs);
            let u: Number = table.invert_cell(inputs.word("index"), inputs.real("offset"));
            ("The u in [0, 1) that is mapped to a position in a cell.".into(), REAL, vec![u.id()])
        });
    }
}

pub(crate) fn add_square(module: &mut Module, wanted: &Wanted) {
    let doc = "A distribution on the unit square in memory whose density is constant in each cell of an image, as PiecewiseConstant2d::build \
               leaves it.";
    let fields = [
        ("first", "Index of the first word of the buffer."),
        ("columns", "Columns of cells."),
        ("rows", "Rows of cells."),
    ];
    let of = add_words(module, "piecewise_constant_2d", doc, &fields);
    let table = |module: &Module, inputs: &mut Inputs| {
        let [first, columns, rows] = inputs.words(module, "table", of);
        Words2d { memory: Words, first, size: [columns, rows] }
    };
    let place = |inputs: &mut Inputs| -> [Word; 2] { ["x", "y"].map(|name| inputs.word(name)) };
    let name = |part: &str| format!("piecewise_constant_2d_{part}");
    if wanted.parts.contains(&Part::Sample) {
        let result = Type::Struct(module.add_struct(Struct {
            name: "image_cell".into(),
            doc: "A cell of an image drawn from a table.".into(),
            fields: vec![
                field("x", Leaf::Word, "Column."),
                field("y", Leaf::Word, "Row."),
                field("offset", Leaf::Vec2, "Position in the cell, in [0, 1)^2."),
                field("pmf", Leaf::Real, "Probability of the cell."),
            ],
        }));
        add_function(module, &name("cell"), |module, inputs| {
            let cell = table(module, inputs).cell::<Number>(inputs.vec2("u"));
            let outputs = vec![cell.x.id(), cell.y.id(), cell.offset.x.id(), cell.offset.y.id(), cell.pmf.id()];
            ("Draws a cell by its weight for u in [0, 1)^2, and a position in it.".into(), result, outputs)
        });
    }
    if wanted.parts.contains(&Part::Pdf) {
        add_function(module, &name("pmf"), |module, inputs| {
            let table = table(module, inputs);
            let [x, y] = place(inputs);
            ("The probability of a cell; 0 outside of the image.".into(), REAL, vec![table.pmf::<Number>(x, y).id()])
        });
    }
    if wanted.parts.contains(&Part::Invert) {
        add_function(module, &name("invert_cell"), |module, inputs| {
            let table = table(module, inputs);
            let [x, y] = place(inputs);
            let u = table.invert_cell::<Number>(x, y, inputs.vec2("offset"));
            let doc = "The u in [0, 1)^2 that is mapped to a position in a cell.";
            (doc.into(), Type::Leaf(Leaf::Vec2), vec![u.x.id(), u.y.id()])
        });
    }
}
