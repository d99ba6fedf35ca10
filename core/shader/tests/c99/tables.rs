//! What reads tables in memory.

use crate::driver::{HOSTILE, compare, slots};
use crate::lights::sample;
use crate::program::Driver;
use etendue::light::{EnvironmentMap, ImageEnvironment, TexelSample};
use etendue::reflection::{Reflection, table};
use etendue::select::{Choice, LightBound, LightChoice, LightTree, Node8};
use etendue::{LightSampler, Vec2, Vec3};
use etendue_judge::generators::{Random, unit_or_edge};
use etendue_judge::light_tree::{Lamp, Regime, place};
use etendue_oracle::tier::cases;
use etendue_shader::*;

pub(crate) fn module(name: &str) -> Module {
    Selection { tables: vec![name.into()], ..Selection::default() }.module()
}
/// Halves of a word as numbers.
pub(crate) fn halves(word: u32) -> [f32; 2] {
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
                chosen += usize::from(by_bits.index != LightTree::NO_LIGHT);
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
    driver.same_bits("table_light_tree", cases(&["-O1"], &["-O2"]), &inputs, &right);
    let found = driver.run_metal("table_light_tree_metal", &inputs);
    // what is not finite WGSL does not promise
    let finite: Vec<bool> = inputs.iter().map(|input| input[3..9].iter().all(|x| x.abs() < 1e30)).collect();
    let keep =
        |of: &[Vec<f32>]| of.iter().zip(&finite).filter(|(_, is)| **is).map(|(of, _)| of.clone()).collect::<Vec<_>>();
    compare("light_tree in Metal", &keep(&inputs), &keep(&right), &keep(&found));
}

fn one_of<const N: usize>(numbers: [f32; N], random: &mut Random) -> f32 {
    numbers[random.below(N)]
}
/// A unit direction, or next to an axis or on it, or whatever.
fn direction(slot: usize, random: &mut Random) -> [f32; 3] {
    let w = random.direction().map(|x| x as f32);
    match slot % 8 {
        3 => w.map(|x| if x.abs() < 0.5 { 0.0 } else { x.signum() }),
        4 => [one_of([0.0, 1e-6, -1e-20], random), one_of([0.0, -1e-7, 1e-30], random), w[2].signum()],
        5 => [w[0], one_of([0.0, -0.0, 1e-8, -1e-8], random), w[2]],
        7 => [HOSTILE[random.below(HOSTILE.len())], w[1], w[2]],
        _ => w,
    }
}

/// Skies of many sizes with dark texels and rows.
#[test]
fn environments_have_the_same_bits() {
    for (name, map) in [
        ("equirectangular_environment", EnvironmentMap::Equirectangular),
        ("equal_area_environment", EnvironmentMap::EqualArea),
    ] {
        let (mut random, mut memory, wanted) = (Random::new(4400), Memory::default(), Wanted::default());
        let skies = [[1, 1], [2, 1], [1, 4], [5, 3], [16, 8], [33, 21], [200, 101]].map(|[w, h]| {
            let mut weight = |k: usize| match random.word() % 4 {
                _ if k / w == 2 => 0.0,
                0 => 0.0,
                1 => random.magnitude(1e-6, 1e6) as f32,
                _ => random.unit(),
            };
            let mut weights: Vec<f32> = (0..w * h).map(&mut weight).collect();
            weights[w * h - 1] = 1.0;
            let mut buffer = vec![0.0; ImageEnvironment::buffer(w, h)];
            ImageEnvironment::build(&weights, w, map, &mut buffer).unwrap();
            let first = memory.add(buffer.iter().map(|x| x.to_bits()));
            (buffer, [first, w as u32, h as u32])
        });
        let (mut inputs, mut right) = (Vec::new(), Vec::new());
        for slot in 0..4 * slots() {
            let (buffer, words) = &skies[slot % skies.len()];
            let sky = ImageEnvironment::from_buffer(buffer, words[1] as usize, map).unwrap();
            let sampler = sky.by_radiance();
            let [u, v] = [(); 2].map(|()| (unit_or_edge(&mut random) as f32).min(1.0 - 1.0 / 16_777_216.0));
            let w = direction(slot, &mut random);
            let mut all = Vec::new();
            let TexelSample { light, x, y } = sky.draw(Vec2::new(u, v));
            sample(&light, &wanted, &mut all);
            all.extend([halves(x), halves(y)].concat());
            sample(&sampler.sample(Vec2::new(u, v)), &wanted, &mut all);
            for w in [light.direction, Vec3::from(w)] {
                let u: Vec2<f32> = sampler.invert(w);
                all.extend([sampler.pdf(w), u.x, u.y]);
                sample(&sampler.hit(w), &wanted, &mut all);
            }
            right.push(all);
            inputs.push([&words.map(f32::from_bits)[..], &[u, v], &w].concat());
        }
        let module = module(name);
        let mut driver = Driver::new(&module);
        driver.memory = memory.0;
        driver.take(driver.function(&format!("{name}_draw")).unwrap().parameters[0].of, "environment");
        driver.take(Type::Leaf(Leaf::Vec2), "u");
        driver.take(Type::Leaf(Leaf::Vec3), "w");
        driver.output(&format!("{name}_draw"), &["environment", "u"], "drawn");
        driver.output(&format!("{name}_sample"), &["environment", "u"], "sampled");
        for (k, w) in ["drawn.direction", "w"].into_iter().enumerate() {
            for part in ["pdf", "invert", "hit"] {
                driver.output(&format!("{name}_{part}"), &["environment", w], &format!("{part}_{k}"));
            }
        }
        driver.same_bits(&format!("table_{name}"), cases(&["-O1"], &["-O2"]), &inputs, &right);
    }
}

/// Reflections that a source prepares from the table have the bits of the core's, as have what spheres cover of them.
#[test]
fn reflections_have_the_same_bits() {
    let module = module("reflection");
    let mut driver = Driver::new(&module);
    driver.memory = vec![7; 3];
    driver.memory.extend(table().iter().map(|number| number.to_bits()));
    let [word, real, vector] = [Leaf::Word, Leaf::Real, Leaf::Vec3].map(Type::Leaf);
    let arguments =
        [("table", word), ("alpha", real), ("n", vector), ("view", vector), ("center", vector), ("radius", real)];
    for (name, of) in arguments {
        driver.take(of, name);
    }
    driver.output("reflection_prepare", &["table", "alpha", "n", "view"], "reflection");
    driver.output("reflection_sphere", &["reflection", "center", "radius"], "covered");
    let mut random = Random::new(4300);
    let slot = |round: usize| {
        let size = random.unit();
        let mut all = vec![f32::from_bits(3), size * size];
        all.extend([(); 3].into_iter().flat_map(|()| random.direction()).map(|x| x as f32));
        all.push(random.unit());
        if round % 4 == 1 {
            let (place, value) = (1 + random.below(all.len() - 1), random.below(HOSTILE.len()));
            all[place] = HOSTILE[value];
        }
        all
    };
    let inputs: Vec<_> = (0..slots()).map(slot).collect();
    let right = inputs.iter().map(|x| {
        let three = |k: usize| Vec3::new(x[k], x[k + 1], x[k + 2]);
        let (reflection, mut numbers) = (Reflection::new(x[1], three(2), three(5)), Vec::new());
        reflection.map(|number| numbers.push(number));
        numbers.push(reflection.sphere(three(8), x[11]));
        numbers
    });
    let right: Vec<_> = right.collect();
    driver.same_bits("table_reflection", cases(&["-O0"], &["-O2"]), &inputs, &right);
}
