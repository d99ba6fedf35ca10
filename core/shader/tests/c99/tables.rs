//! What reads tables in memory.

use crate::driver::{Driver, HOSTILE, compare, slots};
use etendue::Vec3;
use etendue::select::{Choice, LightBound, LightChoice, LightTree, NO_LIGHT, Node8};
use etendue_oracle::tier::cases;
use etendue_properties::generators::{Random, unit_or_edge};
use etendue_properties::light_tree::{Lamp, Regime, place};
use etendue_shader::*;

pub(crate) fn module(name: &str) -> Module {
    Selection { tables: vec![name.into()], ..Selection::default() }.module()
}
/// Halves of a word as numbers.
fn halves(word: u32) -> [f32; 2] {
    [(word >> 16) as f32, (word & 0xffff) as f32]
}

/// Words of one table after another.
#[derive(Default)]
pub(crate) struct Memory(pub(crate) Vec<u32>);
impl Memory {
    /// Adds words, and returns where they begin.
    pub(crate) fn add(&mut self, words: impl IntoIterator<Item = u32>) -> u32 {
        let first = self.0.len() as u32;
        self.0.extend(words);
        first
    }
}

/// A tree in the memory of Rust, and where it is in that of a source.
struct Tree {
    nodes: Vec<Node8>,
    places: Vec<u32>,
    words: [u32; 3],
}

impl Tree {
    fn new(lamps: &[Lamp], memory: &mut Memory) -> Self {
        let bounds: Vec<LightBound> = lamps.iter().map(Lamp::bound).collect();
        let (mut nodes, mut places) = (vec![Node8::default(); LightTree::nodes_for(lamps.len())], vec![0; lamps.len()]);
        LightTree::build(&bounds, &mut nodes, &mut places).unwrap();
        let words = [memory.add(nodes.iter().flat_map(Node8::words)), memory.add(places.clone()), lamps.len() as u32];
        Self { nodes, places, words }
    }
}

/// Choices have the bits of the tree itself, in all regimes of lights, and pmfs those of the choices.
#[test]
fn choices_of_trees_have_the_same_bits() {
    let module = module("light_tree");
    let mut memory = Memory::default();
    let (mut inputs, mut right, mut chosen) = (Vec::new(), Vec::new(), 0);
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(4200 + seed);
        for count in [1, 8, 9, 65, cases(130, 1000)] {
            let lamps = regime.lamps(count, &mut random);
            let tree = Tree::new(&lamps, &mut memory);
            for slot in 0..slots() / 32 {
                let ((mut p, mut n), aim) = place(regime, &lamps, &mut random);
                if slot % 4 == 3 {
                    let hostile = HOSTILE[random.below(HOSTILE.len())];
                    if random.word().is_multiple_of(2) {
                        p[random.below(3)] = hostile
                    } else {
                        n[random.below(3)] = hostile
                    }
                }
                let u = (unit_or_edge(&mut random) as f32).min(1.0 - 1.0 / 16_777_216.0);
                let bits = [(); 2].map(|()| random.word() as u32);
                let at = LightTree::from_buffers(&tree.nodes, &tree.places).at(Vec3::from(p), Vec3::from(n));
                let (by_u, by_bits) = (at.choose(u), at.choose_by(bits));
                // some of them are past the last light
                let light = if slot % 3 == 0 { random.below(2 * count) } else { aim } as u32;
                chosen += usize::from(by_bits.index != NO_LIGHT);
                let numbers = |choice: Choice<f32>| {
                    let [high, low] = halves(choice.index);
                    [high, low, choice.pmf, choice.u]
                };
                let pmfs = [at.pmf(by_bits.index), at.pmf(light)];
                right.push([&numbers(by_u)[..], &numbers(by_bits), &pmfs].concat());
                let words = [bits[0], bits[1], light].map(f32::from_bits);
                inputs.push([&tree.words.map(f32::from_bits)[..], &p, &n, &[u], &words].concat());
            }
        }
    }
    assert!(chosen > inputs.len() / 4, "{chosen} of {} chose a light", inputs.len());

    let mut driver = Driver::new(&module);
    driver.memory = memory.0;
    let choose = driver.function("light_tree_choose").unwrap();
    driver.take(choose.parameters[0].of, "tree");
    let leaves = [Leaf::Vec3, Leaf::Vec3, Leaf::Real, Leaf::Word, Leaf::Word, Leaf::Word];
    for (name, leaf) in ["p", "n", "u", "first", "second", "light"].into_iter().zip(leaves) {
        driver.take(Type::Leaf(leaf), name);
    }
    driver.output("light_tree_choose", &["tree", "p", "n", "u"], "by_u");
    driver.output("light_tree_choose_by", &["tree", "p", "n", "first", "second"], "by_bits");
    driver.output("light_tree_pmf", &["tree", "p", "n", "by_bits.index"], "pmf");
    driver.output("light_tree_pmf", &["tree", "p", "n", "light"], "other");
    let found = driver.run("table_light_tree", cases(&["-O1"], &["-O2"]), &inputs);
    compare("light_tree", &inputs, &right, &found);
    let found = driver.run_metal("table_light_tree_metal", &inputs);
    // what is not finite WGSL does not promise
    let finite: Vec<bool> = inputs.iter().map(|input| input[3..9].iter().all(|x| x.abs() < 1e30)).collect();
    let keep =
        |of: &[Vec<f32>]| of.iter().zip(&finite).filter(|(_, is)| **is).map(|(of, _)| of.clone()).collect::<Vec<_>>();
    compare("light_tree in Metal", &keep(&inputs), &keep(&right), &keep(&found));
}
