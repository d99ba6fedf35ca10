//! Discrete and piecewise constant distributions.

use crate::driver::slots;
use crate::program::Driver;
use crate::tables::{Memory, halves, module};
use etendue::Vec2;
use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d};
use etendue_judge::generators::{Random, unit_or_edge};
use etendue_oracle::tier::cases;
use etendue_shader::*;

fn weights(count: usize, random: &mut Random) -> Vec<f32> {
    let mut weight = || match random.word() % 4 {
        0 => 0.0,
        1 => random.magnitude(1e-6, 1e6).abs() as f32,
        _ => random.unit(),
    };
    let mut all: Vec<f32> = (0..count).map(|_| weight()).collect();
    all[count - 1] = 0.5;
    all
}
fn number(random: &mut Random) -> f32 {
    (unit_or_edge(random) as f32).min(1.0 - 1.0 / 16_777_216.0)
}
/// Runs the functions of a table with the arguments of these types, and compares what they return.
fn same(
    name: &str,
    memory: Memory,
    arguments: &[(&str, Leaf)],
    calls: &[(&str, &[&str])],
    inputs: &[Vec<f32>],
    right: &[Vec<f32>],
) {
    let module = module(name);
    let mut driver = Driver::new(&module);
    driver.memory = memory.0;
    driver.take(driver.function(&format!("{name}_cell")).unwrap().parameters[0].of, "table");
    for (argument, leaf) in arguments {
        driver.take(Type::Leaf(*leaf), argument);
    }
    for (k, (part, arguments)) in calls.iter().enumerate() {
        let arguments = [&["table"], *arguments].concat();
        driver.output(&format!("{name}_{part}"), &arguments, &format!("{part}_{k}"));
    }
    driver.same_bits(&format!("table_{name}"), cases(&["-O1"], &["-O2"]), inputs, right);
}
const COUNTS: [usize; 7] = [1, 2, 3, 8, 21, 64, 1000];

#[test]
fn cells_of_a_line_have_the_same_bits() {
    let (mut random, mut memory) = (Random::new(4700), Memory::default());
    let (mut inputs, mut right) = (Vec::new(), Vec::new());
    for count in COUNTS {
        let weights = weights(count, &mut random);
        let mut cdf = vec![0.0; count];
        PiecewiseConstant1d::build(&weights, &mut cdf).unwrap();
        let mut same = vec![0.0; count];
        let table = PiecewiseConstant1d::build(&weights, &mut same).unwrap();
        let words = [memory.add(cdf.iter().map(|x| x.to_bits())), count as u32].map(f32::from_bits);
        for _ in 0..slots() {
            let (u, index) = (number(&mut random), random.below(count + 2) as u32);
            let cell = table.cell(u);
            let [high, low] = halves(cell.index);
            let u_of = table.invert_cell(index, u);
            right.push(vec![high, low, cell.offset, cell.pmf, table.pmf(index), u_of]);
            inputs.push([&words[..], &[u, f32::from_bits(index)]].concat());
        }
    }
    let arguments = [("u", Leaf::Real), ("index", Leaf::Word)];
    let calls: [(&str, &[&str]); 3] = [("cell", &["u"]), ("pmf", &["index"]), ("invert_cell", &["index", "u"])];
    same("piecewise_constant_1d", memory, &arguments, &calls, &inputs, &right);
}

#[test]
fn cells_of_images_have_the_same_bits() {
    let (mut random, mut memory) = (Random::new(4800), Memory::default());
    let (mut inputs, mut right) = (Vec::new(), Vec::new());
    for [w, h] in [[1, 1], [2, 1], [1, 4], [5, 3], [16, 8], [33, 21]] {
        let mut buffer = vec![0.0; PiecewiseConstant2d::buffer(w, h)];
        PiecewiseConstant2d::build(&weights(w * h, &mut random), w, &mut buffer).unwrap();
        let first = memory.add(buffer.iter().map(|x| x.to_bits()));
        let table = PiecewiseConstant2d::from_buffer(&buffer, w).unwrap();
        let words = [first, w as u32, h as u32].map(f32::from_bits);
        for _ in 0..slots() {
            let u = Vec2::new(number(&mut random), number(&mut random));
            let [x, y] = [w, h].map(|n| random.below(n) as u32);
            let cell = table.cell(u);
            let inverse = table.invert_cell(x, y, u);
            let (column, row) = (halves(cell.x), halves(cell.y));
            let numbers = [cell.offset.x, cell.offset.y, cell.pmf, table.pmf(x, y), inverse.x, inverse.y];
            right.push([&column[..], &row, &numbers].concat());
            inputs.push([&words[..], &[u.x, u.y], &[x, y].map(f32::from_bits)].concat());
        }
    }
    let arguments = [("u", Leaf::Vec2), ("x", Leaf::Word), ("y", Leaf::Word)];
    let calls: [(&str, &[&str]); 3] = [("cell", &["u"]), ("pmf", &["x", "y"]), ("invert_cell", &["x", "y", "u"])];
    same("piecewise_constant_2d", memory, &arguments, &calls, &inputs, &right);
}
