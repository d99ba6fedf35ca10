//! The C sources return the bits of the Rust routines, compiled by the C compiler of the machine.

use core::fmt::Write;
use etendue::estimate::{Heuristic, technique_pdf};
use etendue::sequence::{Independent, OwenSobol, Sequence};
use etendue::{LightSample, LightSampler, Vec2, Vec3};
use etendue_properties::generators::{Random, nasty, unit_or_edge};
use etendue_properties::techniques::AreaLight;
use etendue_shader::*;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// How many arguments each routine gets.
const SLOTS: usize = 1600;

/// What floating-point numbers have to offer against routines.
const HOSTILE: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-45,
    -1e-45,
    1e-40,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-30,
    1e30,
    f32::MAX,
    -f32::MAX,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];

/// A folder of its own for each test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A C function in the making that takes numbers and returns numbers.
struct Driver<'a> {
    module: &'a Module,
    text: String,
    inputs: usize,
    outputs: usize,
}

impl<'a> Driver<'a> {
    fn new(module: &'a Module) -> Self {
        Self { module, text: String::new(), inputs: 0, outputs: 0 }
    }
    fn type_name(&self, of: Type) -> String {
        match of {
            Type::Leaf(leaf) => C.leaf(leaf).to_owned(),
            Type::Struct(index) => struct_name(&self.module.structs[index].name),
        }
    }
    /// The numbers of a variable.
    fn places(&self, of: Type, name: &str) -> Vec<String> {
        let place = |(field, axis): (Option<usize>, Option<usize>)| {
            let mut place = name.to_owned();
            if let (Type::Struct(of), Some(field)) = (of, field) {
                place = format!("{place}.{}", self.module.structs[of].fields[field].name);
            }
            axis.map_or(place.clone(), |axis| format!("{place}.{}", ["x", "y", "z"][axis]))
        };
        self.module.parts(of).into_iter().map(place).collect()
    }
    /// A variable from the next inputs.
    fn take(&mut self, of: Type, name: &str) {
        let _ = writeln!(self.text, "    {} {name};", self.type_name(of));
        for place in self.places(of, name) {
            let number = format!("in[{}]", self.inputs);
            let value = match of {
                Type::Leaf(Leaf::Word) => format!("etendue_bits({number})"),
                Type::Leaf(Leaf::Truth) => format!("{number} > 0.5f"),
                _ => number,
            };
            let _ = writeln!(self.text, "    {place} = {value};");
            self.inputs += 1;
        }
    }
    fn function(&self, name: &str) -> Option<&'a Function> {
        self.module.functions.iter().find(|function| function.name == name)
    }
    /// Calls a function with these arguments, of which the first is left out where it takes nothing prepared, and puts all that it returns
    /// into a variable.
    fn call(&mut self, name: &str, arguments: &[&str], result: &str) {
        let function = self.function(name).unwrap_or_else(|| panic!("there is no {name}"));
        let arguments = &arguments[arguments.len() - function.parameters.len()..];
        let of = self.type_name(function.result);
        let _ = writeln!(self.text, "    {of} {result} = {}({});", function_name(name), arguments.join(", "));
    }
    /// The same, and returns it.
    fn output(&mut self, name: &str, arguments: &[&str], result: &str) {
        self.call(name, arguments, result);
        let function = self.function(name).unwrap();
        let mut places = self.places(function.result, result);
        if function.result == Type::Leaf(Leaf::Word) {
            // halves of words are numbers
            places = vec![format!("({result} >> 16)"), format!("({result} & 0xffffu)")];
        }
        for place in places {
            let _ = writeln!(self.text, "    out[{}] = (float){place};", self.outputs);
            self.outputs += 1;
        }
    }
    /// Compiles the source with a program that maps the numbers of its input to those of its output, and runs it.
    fn run(&self, name: &str, flags: &[&str], inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let folder = folder(name);
        fs::write(folder.join("etendue.h"), print(self.module, &C, "Made by a test.")).unwrap();
        let program = format!(
            "#include \"etendue.h\"\n#include <stdio.h>\nstatic void run(const float *in, float *out) {{\n{}}}\nint main(void) {{\n    \
             static float in[{}], out[{}];\n    while (fread(in, sizeof in, 1, stdin) == 1) {{\n        run(in, out);\n        \
             fwrite(out, sizeof out, 1, stdout);\n    }}\n    return 0;\n}}\n",
            self.text, self.inputs, self.outputs
        );
        let [source, binary] = ["main.c", "main"].map(|file| folder.join(file));
        fs::write(&source, program).unwrap();
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
        let mut compile = Command::new(&compiler);
        compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"]).args(flags);
        let compiled = compile.arg("-o").arg(&binary).arg(&source).arg("-lm").output().expect("a C compiler");
        assert!(compiled.status.success(), "{name}: {}", String::from_utf8_lossy(&compiled.stderr));
        let mut child = Command::new(&binary).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let bytes: Vec<u8> = inputs.iter().flatten().flat_map(|x| x.to_ne_bytes()).collect();
        assert!(inputs.iter().all(|input| input.len() == self.inputs), "{name}: {} inputs", self.inputs);
        let mut stdin = child.stdin.take().unwrap();
        let writer = std::thread::spawn(move || stdin.write_all(&bytes).unwrap());
        let output = child.wait_with_output().unwrap();
        writer.join().unwrap();
        assert!(output.status.success(), "{name}: {}", output.status);
        let numbers: Vec<f32> =
            output.stdout.chunks_exact(4).map(|word| f32::from_ne_bytes(word.try_into().unwrap())).collect();
        numbers.chunks_exact(self.outputs).map(<[f32]>::to_vec).collect()
    }
}

/// Compares all bits; those of NaN say nothing, so that all are one.
fn compare(name: &str, inputs: &[Vec<f32>], right: &[Vec<f32>], found: &[Vec<f32>]) {
    let bits = |x: f32| if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() };
    assert_eq!(right.len(), found.len(), "{name}");
    for ((input, right), found) in inputs.iter().zip(right).zip(found) {
        assert_eq!(right.len(), found.len(), "{name}");
        for (k, (x, y)) in right.iter().zip(found).enumerate() {
            assert!(
                bits(*x) == bits(*y),
                "{name}: output {k} is {y:e} in C and {x:e} in Rust, for {input:?}\n{right:?}\n{found:?}"
            );
        }
    }
    println!("{name:50} {:3} numbers, {} times: the same bits", right[0].len(), right.len());
}

fn vec3(x: &[f32]) -> Vec3<f32> {
    Vec3::new(x[0], x[1], x[2])
}
fn sample(s: &LightSample<f32>, wanted: &Wanted, all: &mut Vec<f32>) {
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
        let turn = std::f64::consts::TAU * (k as f64 + 0.3 * (k % 3) as f64) / 8.0;
        let (s, c) = turn.sin_cos();
        (0..3).map(move |i| (f64::from(light.a[i]) + c * f64::from(light.b[i]) + s * f64::from(light.c[i])) as f32)
    };
    (0..8).flat_map(corner).collect()
}

/// The arguments of the technique with this number in the list: a light, a point, a normal, u and a direction. They are from the regimes of
/// the properties; in some slots a few numbers are hostile.
fn arguments(kind: usize, numbers: usize) -> Vec<Vec<f32>> {
    let mut random = Random::new(3600 + kind as u64);
    let slot = |round: usize| {
        let with_surface = kind < AreaLight::KINDS.len();
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
    (0..SLOTS).map(slot).collect()
}

/// Compares one light by one technique after another.
struct Lights<'a> {
    wanted: Wanted,
    flags: &'a [&'a str],
    test: &'a str,
    kind: usize,
    numbers: usize,
}

impl TechniqueVisitor for Lights<'_> {
    fn visit<T: Technique>(&mut self) {
        let entry = T::ENTRY;
        let name = format!("{}_{}", snake(entry.light), entry.by);
        let mut module = Module::default();
        add_technique::<T>(&mut module, &self.wanted);
        add_calls(&mut module);
        let mut light_numbers = 0;
        let _ = T::light(&mut || {
            light_numbers += 1;
            0.0_f32
        });
        let inputs = arguments(self.kind, light_numbers);
        self.kind += 1;

        let right = inputs.iter().map(|input| {
            let (light, rest) = input.split_at(light_numbers);
            let mut next = light.iter();
            let light = T::light(&mut || *next.next().unwrap());
            let (p, n, u, w) = (vec3(&rest[..3]), vec3(&rest[3..6]), Vec2::new(rest[6], rest[7]), vec3(&rest[8..]));
            let sampler = T::prepare(&light, p, n);
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
            Some(prepare) => driver.take(prepare.parameters[0].of, "light"),
            None => driver.inputs += light_numbers,
        }
        driver.take(vec3, "p");
        driver.take(vec3, "n");
        driver.take(Type::Leaf(Leaf::Vec2), "u");
        driver.take(vec3, "w");
        driver.text += "    (void)p, (void)n, (void)u, (void)w;\n";
        if driver.function(&format!("{name}_prepare")).is_some() {
            let all = ["light", "p", "n"];
            let count = 1 + usize::from(entry.at_point) + usize::from(entry.on_surface);
            driver.call(&format!("{name}_prepare"), &all[..count], "prepared");
        }
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
        let found = driver.run(&format!("{}_{name}", self.test), self.flags, &inputs);
        compare(&name, &inputs, &right, &found);
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

#[test]
fn lights_have_the_same_bits() {
    let mut lights = Lights { wanted: Wanted::default(), flags: &["-O2"], test: "lights", kind: 0, numbers: 0 };
    every_technique(&mut lights);
    assert!(lights.kind >= 29 && lights.numbers > 29 * 20, "{} lights, {} numbers", lights.kind, lights.numbers);
}

/// A sampler of which only direction and pdf are used carries no more.
#[test]
fn fewer_fields_have_the_same_bits() {
    let wanted =
        Wanted { parts: [Part::Sample, Part::Pdf].into(), fields: [SampleField::Direction, SampleField::Pdf].into() };
    let mut lights = Lights { wanted, flags: &["-O1"], test: "fewer", kind: 0, numbers: 0 };
    every_technique(&mut lights);
    assert_eq!(lights.numbers, lights.kind * 6);
}

/// The committed header is C++, too, and its example in the documentation is right.
#[test]
fn the_committed_header_serves_cpp() {
    let lines = include_str!("../src/lib.rs").lines().skip_while(|line| *line != "//! ```c").skip(1);
    let example: Vec<_> =
        lines.take_while(|line| *line != "//! ```").map(|line| line.trim_start_matches("//! ")).collect();
    assert!(example.len() > 4, "{example:?}");
    let header = concat!(env!("CARGO_MANIFEST_DIR"), "/sources/etendue.h");
    let text = format!(
        "#include \"{header}\"\nint main(void) {{\n{}\nreturn irradiance > 0.0f && irradiance < 1.0f ? 0 : 1;\n}}\n",
        example.join("\n")
    );
    let folder = folder("cpp");
    for (compiler, standard, ending) in [("cc", "-std=c99", "c"), ("c++", "-std=c++11", "cpp")] {
        let [source, binary] = [format!("example.{ending}"), format!("example_{ending}")].map(|file| folder.join(file));
        fs::write(&source, &text).unwrap();
        let mut compile = Command::new(compiler);
        compile.args([standard, "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off", "-o"]).arg(&binary);
        let compiled = compile.arg(&source).arg("-lm").output().expect("a C and a C++ compiler");
        assert!(compiled.status.success(), "{compiler}: {}", String::from_utf8_lossy(&compiled.stderr));
        assert!(Command::new(&binary).status().unwrap().success(), "{compiler}");
    }
}

/// Compares one warp after another.
struct Warps(usize);

impl WarpVisitor for Warps {
    fn visit<W: WarpTechnique>(&mut self) {
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
            all.extend((0..entry.numbers).map(|_| unit_or_edge(&mut random) as f32));
            all.extend(random.direction()[..entry.coordinates].iter().map(|x| *x as f32));
            if round % 4 == 3 {
                for _ in 0..1 + random.below(2) {
                    let (place, value) = (random.below(all.len()), random.below(HOSTILE.len()));
                    all[place] = HOSTILE[value];
                }
            }
            all
        };
        let inputs: Vec<_> = (0..SLOTS).map(slot).collect();
        let right = inputs.iter().map(|input| {
            let (numbers, rest) = input.split_at(parameters);
            let mut next = numbers.iter();
            let warp = W::warp(&mut || *next.next().unwrap());
            let (u, point) = rest.split_at(entry.numbers);
            let sampled = W::sample(&warp, u);
            let mut all = sampled.clone();
            for point in [&sampled, point] {
                all.push(W::pdf(&warp, point));
                all.extend(W::invert(&warp, point));
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
        driver.take(Type::Leaf(Leaf::of_numbers(entry.numbers)), "u");
        driver.take(Type::Leaf(Leaf::of_numbers(entry.coordinates)), "point");
        driver.output(&format!("{name}_sample"), &["prepared", "u"], "sampled");
        for point in ["sampled", "point"] {
            driver.output(&format!("{name}_pdf"), &["prepared", point], &format!("{point}_pdf"));
            driver.output(&format!("{name}_invert"), &["prepared", point], &format!("{point}_invert"));
        }
        let found = driver.run(&format!("warp_{name}"), &["-O2"], &inputs);
        compare(name, &inputs, &right, &found);
    }
}

#[test]
fn warps_have_the_same_bits() {
    let mut warps = Warps(0);
    every_warp(&mut warps);
    assert!(warps.0 >= 14, "{} warps", warps.0);
}

/// A tool of Rust in scalars: words come as the bits of numbers, and truth values as 0 and 1.
fn tool(name: &str, x: &[f32]) -> Vec<f32> {
    let word = |k: usize| x[k].to_bits();
    let truth = |k: usize| x[k] > 0.5;
    let pair = |u: Vec2<f32>| vec![u.x, u.y];
    let sample =
        |pdf: f32, emits: bool, delta: bool| LightSample { pdf, emits, delta, ..LightSample::miss(Vec3::default()) };
    match name {
        "sequence_key" => {
            let key = Independent::key(word(0), word(1));
            vec![(key >> 16) as f32, (key & 0xffff) as f32]
        }
        "independent_pair" => {
            let [x, y, z, w] = Independent::numbers::<f32>(word(0), word(1), word(2) / 2, word(3));
            if word(2).is_multiple_of(2) { vec![x, y] } else { vec![z, w] }
        }
        "owen_sobol_pair" => pair(OwenSobol::pair_by(word(0), word(1), word(2), word(3))),
        "technique_pdf" => vec![technique_pdf(x[0], x[1], truth(2))],
        "balance_weights" => Heuristic::Balance.weights([x[0], x[1]]).to_vec(),
        "power_weights" => Heuristic::POWER.weights([x[0], x[1]]).to_vec(),
        "power_light_weight" => vec![Heuristic::POWER.light_weight(&sample(x[0], truth(1), truth(2)), x[3])],
        "power_bsdf_weight" => vec![Heuristic::POWER.bsdf_weight(x[0], &sample(x[1], truth(2), false))],
        _ => panic!("the test does not know {name}"),
    }
}

#[test]
fn tools_have_the_same_bits() {
    assert!(tools().len() >= 8, "{:?}", tools());
    for (k, name) in tools().iter().enumerate() {
        let selection = Selection { tools: vec![(*name).into()], ..Selection::default() };
        let module = selection.module();
        let mut driver = Driver::new(&module);
        let parameters = driver.function(name).unwrap().parameters.clone();
        for parameter in &parameters {
            driver.take(parameter.of, &parameter.name);
        }
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        driver.output(name, &names, "value");
        let mut random = Random::new(3800 + k as u64);
        let mut argument = |of: Type| match of {
            Type::Leaf(Leaf::Word) if random.word().is_multiple_of(3) => f32::from_bits(random.word() as u32 % 9),
            Type::Leaf(Leaf::Word) => f32::from_bits(random.word() as u32),
            Type::Leaf(Leaf::Truth) => f32::from(u8::from(random.word().is_multiple_of(2))),
            _ if random.word().is_multiple_of(3) => HOSTILE[random.below(HOSTILE.len())],
            _ => random.magnitude(1e-6, 1e6) as f32,
        };
        let inputs: Vec<Vec<f32>> =
            (0..SLOTS).map(|_| parameters.iter().map(|parameter| argument(parameter.of)).collect()).collect();
        let right: Vec<_> = inputs.iter().map(|input| tool(name, input)).collect();
        let found = driver.run(&format!("tool_{name}"), &["-O2"], &inputs);
        compare(name, &inputs, &right, &found);
    }
}

/// The keys of the functions are those of the core's sequences.
#[test]
fn sequences_are_those_of_the_core() {
    let mut random = Random::new(3900);
    for _ in 0..1000 {
        let (seed, pixel, sample, dimension) =
            (random.word(), random.word() as u32, random.word() as u32, random.word() as u32 % 50);
        let key = f32::from_bits(Independent::key(seed as u32, (seed >> 32) as u32));
        let arguments = [f32::from_bits(pixel), f32::from_bits(sample), f32::from_bits(dimension), key];
        let pair = |u: Vec2<f32>| vec![u.x, u.y];
        assert_eq!(pair(Independent::new(seed).pair(pixel, sample, dimension)), tool("independent_pair", &arguments));
        assert_eq!(pair(OwenSobol::new(seed).pair(pixel, sample, dimension)), tool("owen_sobol_pair", &arguments));
    }
}
