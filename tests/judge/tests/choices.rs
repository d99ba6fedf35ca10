//! Choosers, judged: the core's is right, a light that is lost among ten thousand is found.

use etendue::discrete::PiecewiseConstant1d;
use etendue_judge::choices::{Chooser, choices};
use etendue_judge::generators::Random;
use std::time::Instant;

const LIGHTS: usize = 10_000;
const DRAWS: usize = 100 * LIGHTS;

struct ByTable<'a> {
    table: PiecewiseConstant1d<'a>,
    /// A light that is replaced by its neighbour when it is drawn.
    lost: Option<usize>,
    /// What all probabilities are multiplied by.
    factor: f32,
}
impl Chooser for ByTable<'_> {
    fn choose(&self, u: f32) -> Option<(usize, f32)> {
        let cell = self.table.cell::<f32>(u);
        let light = cell.index as usize;
        let light = if self.lost == Some(light) { light + 1 } else { light };
        Some((light, self.pmf(light)))
    }
    fn pmf(&self, light: usize) -> f32 {
        self.table.pmf::<f32>(light as u32) * self.factor
    }
}

fn powers() -> Vec<f32> {
    let mut random = Random::new(3);
    (0..LIGHTS).map(|_| random.range(0.5, 2.0) as f32).collect()
}

#[test]
fn a_light_lost_among_ten_thousand_is_found() {
    let powers = powers();
    let all: Vec<f64> = powers.iter().copied().map(f64::from).collect();
    let mut cdf = vec![0.0; LIGHTS];
    let table = PiecewiseConstant1d::build(&powers, &mut cdf).expect("powers are positive");
    let of = |lost, factor| {
        let start = Instant::now();
        let said = choices(&ByTable { table, lost, factor }, &all, DRAWS, 1);
        println!("{said:?}, {:.2} s", start.elapsed().as_secs_f64());
        said
    };
    assert_eq!(of(None, 1.0).findings, [""; 0]);
    assert_eq!(of(Some(4321), 1.0).lost, [4321]);
    assert!(of(None, 1.01).findings.iter().any(|f| f.starts_with("Σ pmf")));
}

#[test]
fn the_variance_of_a_choice_is_that_of_its_probabilities() {
    struct Uniform;
    impl Chooser for Uniform {
        fn choose(&self, u: f32) -> Option<(usize, f32)> {
            Some(((u * 4.0) as usize, 0.25))
        }
        fn pmf(&self, _: usize) -> f32 {
            0.25
        }
    }
    let said = choices(&Uniform, &[1.0, 0.0, 0.0, 1.0], 1000, 1);
    assert!(said.findings.is_empty() && (said.variance - 1.0).abs() < 1e-12, "{said:?}");
    let none = choices(&Uniform, &[1.0; 3], 1000, 1);
    assert!(none.findings[0].contains("light 3 of 3"), "{none:?}");
}
