//! Discrete choices: of cells of tables, and of lights.

mod bounds;
mod discrete;
mod faulty;
mod fog;
mod gloss;
mod light_tree;
mod owned;
mod select;
mod trees_of_bounds;
