//! Each warp.

use crate::driver::{HOSTILE, slots};
use crate::program::Driver;
use etendue::listed::warp::{Coordinates, ListedWarp, WarpVisitor, every_warp};
use etendue::{Vec2, Warp};
use etendue_judge::generators::{Random, unit_or_edge};
use etendue_oracle::tier::cases;
use etendue_shader::*;

/// Compares one warp after another.
struct Warps(usize);

impl WarpVisitor for Warps {
    fn visit<W: ListedWarp>(&mut self) {
        let entry = W::ENTRY;
        let mut module = Module::default();
        add_warp::<W>(&mut module, &Wanted::default());
        add_calls(&mut module);
        let mut parameters = 0;
        let _ = W::warp(&mut || {
            parameters += 1;
            0.0_f32
        });
        self.0 += 1;
        let mut random = Random::new(3700 + self.0 as u64);
        let slot = |round: usize| {
            let mut all: Vec<f32> = match round % 3 {
                0 => (0..parameters).map(|_| random.unit()).collect(),
                1 => (0..parameters).map(|_| random.magnitude(1e-12, 1e6) as f32).collect(),
                _ => (0..parameters).map(|_| random.range(-2.0, 2.0) as f32).collect(),
            };
            all.extend((0..2).map(|_| unit_or_edge(&mut random) as f32));
            all.extend(random.direction()[..entry.coordinates].iter().map(|x| *x as f32));
            if round % 4 == 3 {
                for _ in 0..1 + random.below(2) {
                    let (place, value) = (random.below(all.len()), random.below(HOSTILE.len()));
                    all[place] = HOSTILE[value];
                }
            }
            all
        };
        let inputs: Vec<_> = (0..slots()).map(slot).collect();
        let right = inputs.iter().map(|input| {
            let (numbers, rest) = input.split_at(parameters);
            let mut next = numbers.iter();
            let warp = W::warp(&mut || *next.next().unwrap());
            let (u, point) = rest.split_at(2);
            let sampled = warp.sample(Vec2::new(u[0], u[1])).coordinates();
            let mut all = sampled[..entry.coordinates].to_vec();
            let given = core::array::from_fn(|k| point.get(k).copied().unwrap_or(0.0));
            for point in [sampled, given] {
                all.push(warp.pdf(Coordinates::from_coordinates(point)));
                let Vec2 { x, y } = warp.invert(Coordinates::from_coordinates(point));
                all.extend([x, y]);
            }
            all
        });
        let right: Vec<_> = right.collect();

        let name = entry.name;
        let mut driver = Driver::new(&module);
        let prepare = format!("{name}_prepare");
        if let Some(function) = driver.function(&prepare) {
            for parameter in &function.parameters {
                driver.take(parameter.of, &parameter.name);
            }
            let names: Vec<&str> = function.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
            driver.call(&prepare, &names, "prepared");
        } else if parameters > 0 {
            let sample = driver.function(&format!("{name}_sample")).unwrap();
            driver.take(sample.parameters[0].of, "prepared");
        }
        driver.take(Type::Leaf(Leaf::Vec2), "u");
        driver.take(Type::Leaf(Leaf::of_numbers(entry.coordinates)), "point");
        driver.output(&format!("{name}_sample"), &["prepared", "u"], "sampled");
        for point in ["sampled", "point"] {
            driver.output(&format!("{name}_pdf"), &["prepared", point], &format!("{point}_pdf"));
            driver.output(&format!("{name}_invert"), &["prepared", point], &format!("{point}_invert"));
        }
        driver.same_bits(&format!("warp_{name}"), cases(&["-O0"], &["-O2"]), &inputs, &right);
    }
}

#[test]
fn warps_have_the_same_bits() {
    let mut warps = Warps(0);
    every_warp(&mut warps);
    assert!(warps.0 >= 12, "{} warps", warps.0);
}
