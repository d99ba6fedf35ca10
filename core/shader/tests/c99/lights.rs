//! Each light by each technique.

use crate::driver::{HOSTILE, slots};
use crate::program::Driver;
use etendue::listed::light::{Entry, Technique, TechniqueVisitor, With, every_technique};
use etendue::reflection::Reflection;
use etendue::{LightSample, LightSampler, Real, Vec2, Vec3};
use etendue_judge::area_lights::AreaLight;
use etendue_judge::generators::{Random, nasty, unit_or_edge};
use etendue_oracle::tier::{cases, is_long};
use etendue_shader::*;

pub(crate) fn vec3(x: &[f32]) -> Vec3<f32> {
    Vec3::new(x[0], x[1], x[2])
}
pub(crate) fn sample(s: &LightSample<f32>, wanted: &Wanted, all: &mut Vec<f32>) {
    let truth = |value: bool| f32::from(u8::from(value));
    for field in &wanted.fields {
        match field {
            SampleField::Direction => all.extend([s.direction.x, s.direction.y, s.direction.z]),
            SampleField::Normal => all.extend([s.normal.x, s.normal.y, s.normal.z]),
            SampleField::Uv => all.extend([s.uv.x, s.uv.y]),
            SampleField::Distance => all.push(s.distance),
            SampleField::Pdf => all.push(s.pdf),
            SampleField::Weight => all.push(s.weight()),
            SampleField::Emits => all.push(truth(s.emits)),
            SampleField::Delta => all.push(truth(s.delta)),
        }
    }
}

/// A convex octagon about `a` in the plane of `b` and `c`.
fn octagon(light: &AreaLight) -> Vec<f32> {
    let corner = |k: usize| {
        let (s, c) = Real::sin_cos_turns((k as f64 + 0.3 * (k % 3) as f64) / 8.0);
        (0..3).map(move |i| (f64::from(light.a[i]) + c * f64::from(light.b[i]) + s * f64::from(light.c[i])) as f32)
    };
    (0..8).flat_map(corner).collect()
}

/// The arguments of the technique with this number in the list: a light, a point, a normal, u and a direction. They are from the regimes of
/// the properties; in some slots a few numbers are hostile.
fn arguments(kind: usize, numbers: usize) -> Vec<Vec<f32>> {
    let mut random = Random::new(3600 + kind as u64);
    let slot = |round: usize| {
        // four lights without a surface are at the end of the list
        let with_surface = kind < AreaLight::kinds().len();
        let mut light = AreaLight::any(if with_surface { kind } else { 0 }, round as u32 / 3, &mut random);
        if round % 8 == 7 {
            match random.word() % 4 {
                0 => light.a = nasty(&mut random),
                1 => light.p = light.a,
                2 => light.radius = nasty(&mut random)[2],
                _ => (light.a, light.c) = (nasty(&mut random), nasty(&mut random)),
            }
        }
        let mut all = light.numbers();
        if !with_surface {
            // a position or a direction, and whatever more there is
            all = random.direction().iter().chain(&random.direction()).map(|x| *x as f32).collect();
            all.extend([random.unit(), 0.5 * random.unit()]);
            if numbers == 4 {
                all[3] = random.unit();
            }
            all.truncate(numbers);
        }
        if numbers == 24 && round.is_multiple_of(2) {
            all = octagon(&light);
        }
        while all.len() < numbers {
            // a polygon with fewer corners repeats its last one
            all.extend_from_within(all.len() - 3..);
        }
        all.extend(light.p);
        all.extend(light.n);
        all.extend([(); 2].map(|()| (unit_or_edge(&mut random) as f32).min(1.0 - 1.0 / 16_777_216.0)));
        all.extend(random.direction().map(|x| x as f32));
        if round % 4 == 1 {
            for _ in 0..1 + random.below(3) {
                let (place, value) = (random.below(all.len()), random.below(HOSTILE.len()));
                all[place] = HOSTILE[value];
            }
        }
        all
    };
    (0..slots()).map(slot).collect()
}

/// Compares one light by one technique after another.
struct Lights<'a> {
    wanted: Wanted,
    flags: &'a [&'a str],
    test: &'a str,
    /// Whether the test with few cases leaves a technique out, given its number in the list.
    rest: fn(&Entry, usize) -> bool,
    kind: usize,
    compared: usize,
    numbers: usize,
}

impl<'a> Lights<'a> {
    fn compare(wanted: Wanted, flags: &'a [&'a str], test: &'a str, rest: fn(&Entry, usize) -> bool) -> Self {
        let mut this = Self { wanted, flags, test, rest, kind: 0, compared: 0, numbers: 0 };
        every_technique(&mut this);
        assert!(this.kind >= 25, "{} techniques", this.kind);
        this
    }
}

impl TechniqueVisitor for Lights<'_> {
    fn visit<T: Technique>(&mut self) {
        let entry = T::ENTRY;
        // by reflection, the light is that of the technique before
        let is_own = matches!(entry.with(), With::Nothing | With::Normal);
        self.kind += usize::from(is_own);
        let kind = self.kind - 1;
        if !is_long() && (self.rest)(&entry, kind) {
            return;
        }
        self.compared += 1;
        let name = technique_name::<T>();
        let mut module = Module::default();
        add_technique::<T>(&mut module, &self.wanted);
        add_calls(&mut module);
        let mut own_numbers = 0;
        let _ = T::light(&mut || {
            own_numbers += 1;
            0.0_f32
        });
        let mut inputs = arguments(kind, own_numbers);
        let mut random = Random::new(4100 + kind as u64);
        for input in &mut inputs {
            if entry.with() == With::Reflection {
                let [normal, view] = [(); 2].map(|()| vec3(&random.direction().map(|x| x as f32)));
                let size = random.unit();
                let lobe = Reflection::new(size * size, normal, view);
                let mut numbers = Vec::new();
                lobe.map(|number| numbers.push(number));
                input.splice(own_numbers..own_numbers, numbers);
            }
        }

        let right = inputs.iter().map(|input| {
            let mut next = input.iter();
            let light = T::light(&mut || *next.next().unwrap());
            let of_struct = (!is_own).then(|| T::with(&mut || *next.next().unwrap()));
            let rest = next.as_slice();
            let (p, u, w) = (vec3(&rest[..3]), Vec2::new(rest[6], rest[7]), vec3(&rest[8..]));
            let mut normal = rest[3..6].iter();
            let with = of_struct.unwrap_or_else(|| T::with(&mut || *normal.next().unwrap()));
            let sampler = T::prepare(light, p, with);
            let s = sampler.sample(u);
            let mut all = Vec::new();
            sample(&s, &self.wanted, &mut all);
            for w in [s.direction, w] {
                for part in &self.wanted.parts {
                    match part {
                        Part::Pdf => all.push(sampler.pdf(w)),
                        Part::Hit => sample(&sampler.hit(w), &self.wanted, &mut all),
                        Part::Invert => {
                            let u = sampler.invert(w);
                            all.extend([u.x, u.y]);
                        }
                        Part::Measure => all.extend(T::measure(&sampler)),
                        Part::Sample => {}
                    }
                }
            }
            all
        });
        let right: Vec<_> = right.collect();

        let mut driver = Driver::new(&module);
        let vec3 = Type::Leaf(Leaf::Vec3);
        match driver.function(&format!("{name}_prepare")) {
            Some(prepare) => {
                driver.take(prepare.parameters[0].of, "light");
                if !is_own {
                    driver.take(prepare.parameters[1].of, "with");
                }
            }
            None => driver.inputs += own_numbers,
        }
        driver.take(vec3, "p");
        driver.take(vec3, "n");
        driver.take(Type::Leaf(Leaf::Vec2), "u");
        driver.take(vec3, "w");
        if driver.function(&format!("{name}_prepare")).is_some() {
            let all = [
                ("light", true),
                ("with", !is_own),
                ("p", !entry.place.is_empty()),
                ("n", entry.with() == With::Normal),
            ];
            let arguments: Vec<&str> = all.into_iter().filter(|(_, takes)| *takes).map(|(name, _)| name).collect();
            driver.call(&format!("{name}_prepare"), &arguments, "prepared");
        }
        driver.time_next();
        driver.output(&format!("{name}_sample"), &["prepared", "u"], "s");
        for (k, w) in ["s.direction", "w"].into_iter().enumerate() {
            for part in &self.wanted.parts {
                let (part, arguments) = match part {
                    Part::Sample => continue,
                    Part::Measure => match entry.measure {
                        Some(measure) => (measure, vec!["prepared"]),
                        None => continue,
                    },
                    part => (part.name(), vec!["prepared", w]),
                };
                driver.output(&format!("{name}_{part}"), &arguments, &format!("{part}_{k}"));
            }
        }
        driver.same_bits(&format!("{}_{name}", self.test), self.flags, &inputs, &right);
        if self.wanted.fields == [SampleField::Direction, SampleField::Pdf].into() {
            // of finite numbers, however hostile, no density is negative or no number
            let finite = |input: &[f32]| input.iter().all(|x| x.is_finite());
            for (input, right) in inputs.iter().zip(&right).filter(|(input, _)| finite(input)) {
                assert!(right[3..].iter().all(|pdf| *pdf >= 0.0), "{name}: {right:?} for {input:?}");
            }
        }
        self.numbers += right[0].len();
    }
}

/// With few cases, all but those that are several triangles written out: their C takes seconds to compile.
#[test]
fn lights_have_the_same_bits() {
    let is_large = |entry: &Entry, _| {
        let several = ["Parallelogram", "Rectangle"].contains(&entry.light);
        entry.light == "Polygon" || several && ["by_projected_solid_angle", "by_reflection"].contains(&entry.by)
    };
    let lights = Lights::compare(Wanted::default(), cases(&["-O0"], &["-O1"]), "lights", is_large);
    assert!(lights.compared >= cases(22, 30) && lights.numbers > lights.compared * 20, "{} numbers", lights.numbers);
}

/// A sampler of which only direction and pdf are used carries no more.
#[test]
fn fewer_fields_have_the_same_bits() {
    let wanted =
        Wanted { parts: [Part::Sample, Part::Pdf].into(), fields: [SampleField::Direction, SampleField::Pdf].into() };
    let lights = Lights::compare(wanted, cases(&["-O0"], &["-O1"]), "fewer", |_, kind| kind % 5 != 1);
    assert!(lights.compared >= cases(6, 30));
    assert_eq!(lights.numbers, lights.compared * 6);
}
