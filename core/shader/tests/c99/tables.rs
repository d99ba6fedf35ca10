//! What reads a table in memory.

use crate::driver::{HOSTILE, slots};
use crate::program::Driver;
use etendue::Vec3;
use etendue::reflection::{Reflection, table};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;
use etendue_shader::*;

/// Reflections that a source prepares from the table have the bits of the core's, as have what spheres cover of them.
#[test]
fn reflections_have_the_same_bits() {
    let module = Selection { tables: vec!["reflection".into()], ..Selection::default() }.module();
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
