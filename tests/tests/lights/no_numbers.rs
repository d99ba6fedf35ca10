//! Lights, shading points and random numbers that are none: what is computed from NaN has the pdf 0.

use etendue::light::{self, Spread};
use etendue::reflection::Reflection;
use etendue::{LightSample, LightSampler, Vec2, Vec3};

/// Numbers in the order in which they are asked for, of which one is NaN.
struct Numbers {
    asked: usize,
    none: usize,
}
impl Numbers {
    fn next(&mut self, value: f32) -> f32 {
        self.asked += 1;
        if self.asked == self.none { f32::NAN } else { value }
    }
    fn vector(&mut self, value: [f32; 3]) -> Vec3<f32> {
        Vec3::from(value.map(|x| self.next(x)))
    }
}

/// A value for a field of a light, given how many edges come before.
macro_rules! value {
    (point, $numbers:expr, $edges:expr) => {
        $numbers.vector([0.3, 2.0, 0.4])
    };
    (direction, $numbers:expr, $edges:expr) => {
        $numbers.vector([-0.6, -0.8, 0.0])
    };
    (number, $numbers:expr, $edges:expr) => {
        $numbers.next(0.25)
    };
    (corners, $numbers:expr, $edges:expr) => {
        core::array::from_fn(|i| {
            let (sin, cos) = (core::f32::consts::FRAC_PI_4 * i as f32).sin_cos();
            $numbers.vector([cos, 2.0, sin])
        })
    };
    // edges, of which the first two are perpendicular
    ($edge:ident, $numbers:expr, $edges:expr) => {{
        $edges += 1;
        $numbers.vector([[1.0, 0.0, 0.0], [0.0, 0.1, 1.0], [1.0, 0.2, 1.1]][$edges - 1])
    }};
}

macro_rules! check {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        /// Samples of all techniques from the numbers, each with the technique's name.
        #[allow(unused, reason = "not all techniques take everything, nor do all lights have edges")]
        fn samples(numbers: impl Fn() -> Numbers) -> Vec<(&'static str, usize, LightSample<f32>)> {
            let mut all = Vec::new();
            $({
                let light = |numbers: &mut Numbers| -> light::$light<f32 $(, $corners)?> {
                    let mut edges = 0;
                    light::$light { $($field: value!($kind, numbers, edges)),+ }
                };
                $({
                    let mut numbers = numbers();
                    let light = light(&mut numbers);
                    let (p, n) = (numbers.vector([0.0; 3]), Vec3::new(0.0, 1.0, 0.0));
                    let u = Vec2::new(numbers.next(0.3), numbers.next(0.6));
                    let reflection = Reflection::new(0.5, n, Vec3::new(0.0, 0.8, 0.6));
                    let spread = Spread::<f32>::new(2.0);
                    let sampler = etendue::prepared!(light, $by $place, p: p, n: n, reflection: &reflection, spread: &spread);
                    all.push((stringify!($technique), numbers.asked, sampler.sample(u)));
                })+
            })+
            all
        }
    };
}
etendue::techniques!(check! {});

#[test]
fn samples_from_nan_have_the_pdf_zero() {
    let right = samples(|| Numbers { asked: 0, none: 0 });
    for (name, _, sample) in &right {
        assert!(sample.pdf > 0.0, "{name} has no sample");
    }
    let most = right.iter().map(|(_, asked, _)| *asked).max().unwrap();
    let mut ignored = 0;
    for none in 1..=most {
        for ((name, asked, right), (_, _, sample)) in right.iter().zip(samples(|| Numbers { asked: 0, none })) {
            // what a technique does not use may be anything
            let is_ignored = sample.pdf == right.pdf && sample.direction == right.direction;
            ignored += usize::from(is_ignored && none <= *asked);
            assert!(
                sample.pdf == 0.0 && sample.weight() == 0.0 || is_ignored,
                "{name}: number {none} of {asked} is NaN, and the pdf {}",
                sample.pdf
            );
        }
    }
    // what suns and lights of one direction do not ask for
    println!("{ignored} of the numbers are not used");
}
