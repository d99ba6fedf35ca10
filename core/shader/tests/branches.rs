//! Branches and loops of a routine become branches and loops of a source, and what cannot be recorded says so.

use etendue::real::Blend;
use etendue::{Mask, Real, Uint};
use etendue_shader::*;

/// A function of one number.
fn function(routine: impl Fn(Number) -> Number) -> Module {
    let (output, graph) = record(|| routine(Number::input(0)).id());
    let real = Type::Leaf(Leaf::Real);
    let function = Function {
        name: "f".into(),
        doc: "A function.".into(),
        parameters: vec![Parameter { name: "x".into(), of: real }],
        inputs: vec![Access { parameter: 0, field: None, axis: None }],
        result: real,
        outputs: vec![output],
        graph,
    };
    Module { functions: vec![function], ..Module::default() }
}
/// Its statements in C.
fn body(module: &Module) -> String {
    let text = print(module, &C, "Written by a test.");
    let (_, body) = text.split_once("float etendue_shader_f(float x) {\n").unwrap();
    let body = body.split_once("}\n\n#endif").unwrap().0;
    body.lines().map(|line| format!("{}\n", line.strip_prefix("    ").unwrap())).collect()
}

fn slow(x: Number) -> Number {
    let y = (x + Number::lit(1.0)).sqrt();
    y / (y + x.sqrt())
}

#[test]
fn where_any_is_a_branch() {
    let module = function(|x| {
        let zero = Number::lit(0.0);
        Number::where_any(x.lt(zero), x * x, || slow(-x))
    });
    assert_eq!(
        body(&module),
        "const bool b1 = x < 0.0f;\n\
         float x2 = x * x;\n\
         if (b1) {\n    const float x3 = sqrtf(1.0f - x);\n    x2 = x3 / (x3 + sqrtf(-x));\n}\n\
         return x2;\n"
    );
}
/// Without a name for the branch the core means a selection.
#[test]
fn a_blend_alone_is_a_selection() {
    let module = function(|x| Number::blend(x.lt(Number::lit(0.0)), -x, x * x));
    assert_eq!(body(&module), "const float x1 = (x < 0.0f) ? -x : x * x;\nreturn x1;\n");
}
/// A value that something else needs, too, is not in the branch; one that the branch alone uses is, wherever it was computed.
#[test]
fn only_what_the_branch_alone_needs_is_in_it() {
    let module = function(|x| {
        let (negative, large) = (x.lt(Number::lit(0.0)), x.gt(Number::lit(9.0)));
        let (shared, own) = (x.sqrt(), slow(x));
        Number::where_any(negative & !large, shared, || shared / own)
    });
    let text = body(&module);
    let (before, inside) = text.split_once("if (b").unwrap();
    assert!(before.contains("sqrtf(x)") && !before.contains('/'), "{text}");
    assert!(inside.contains('/'), "{text}");
}
/// The opposite of a mask, and a number that changes in place.
#[test]
fn the_other_side_is_a_branch() {
    let module = function(|x| {
        let small = x.lt(Number::lit(1.0));
        let mut y = Number::lit(0.0);
        Number::take_any(!small, &mut y, |_| slow(x), Blend::take);
        y
    });
    assert!(body(&module).contains("if (!b1) {"), "{}", body(&module));
}
#[test]
fn an_iteration_is_a_loop() {
    let module = function(|x| {
        let one = Number::lit(1.0);
        let step = |[y]: [Number; 1], [going]: [Truth; 1]| {
            let next = (y + x / y) * Number::lit(0.5);
            ([Number::blend(going, next, y)], [going & (next - y).abs().gt(Number::lit(1e-6))])
        };
        let [root] = Number::iterate(20, [one], [x.gt(Number::lit(0.0))], step);
        root
    });
    let text = body(&module);
    assert_eq!(
        text,
        "float x1 = 1.0f;\n\
         bool b2 = 0.0f < x;\n\
         for (int i = 0; i < 20 && b2; ++i) {\n    \
             const float x3 = (x1 + x / x1) * 0.5f;\n    \
             const bool b4 = 1e-6f < fabsf(x3 - x1);\n    \
             x1 = x3;\n    b2 = b4;\n}\n\
         const float x5 = x1;\nreturn x5;\n"
    );
}
/// Variables of a loop that change places do so together.
#[test]
fn variables_of_a_loop_change_together() {
    let module = function(|x| {
        let step = |[a, b]: [Number; 2], [going]: [Truth; 1]| ([b, a + b], [going & b.lt(x)]);
        let [a, b] = Number::iterate(9, [Number::lit(0.0), Number::lit(1.0)], [Truth::splat(true)], step);
        a / b
    });
    let text = body(&module);
    let copied = text.find("const float x2_").unwrap();
    assert!(copied < text.find("    x1 = x2_").unwrap(), "{text}");
}
/// Equal operations, what is exact, and constants.
#[test]
fn the_same_bits_are_computed_once() {
    let module = function(|x| {
        let y = x * Number::lit(1.0) + Number::lit(2.0) * Number::lit(3.0);
        let z = Number::lit(6.0) + x;
        // 0 is added to nothing: −0 + 0 is 0
        y * z - (x + Number::lit(0.0))
    });
    assert_eq!(body(&module), "const float x1 = x + 6.0f;\nconst float x2 = x1 * x1 - (0.0f + x);\nreturn x2;\n");
    assert_eq!(module.functions[0].operations(), 4);
}

/// A guard against 0 is of no use where the quotient counts alone if there is none.
#[test]
fn a_guarded_quotient_has_one_selection() {
    let module = function(|x| {
        let some = x.gt(Number::lit(0.0));
        (Number::lit(1.0) / Number::blend(some, x, Number::lit(1.0))).keep(some)
    });
    assert_eq!(body(&module), "const float x1 = (0.0f < x) ? 1.0f / x : 0.0f;\nreturn x1;\n");
}

fn panics(routine: impl Fn(Number) -> Number + std::panic::RefUnwindSafe) -> String {
    let error = std::panic::catch_unwind(|| drop(function(&routine))).unwrap_err();
    error.downcast::<String>().map_or_else(|error| (*error.downcast::<&str>().unwrap()).to_owned(), |text| *text)
}
#[test]
fn what_cannot_be_recorded_says_so() {
    let zero = || Number::lit(0.0);
    for message in [
        panics(|x| if x < Number::lit(0.0) { -x } else { x }),
        panics(|x| Number::lit(x.lane_f64(0))),
        panics(move |x| if x.lt(zero()).lane(0) { -x } else { x }),
        panics(move |x| Number::lit(f64::from(x.lt(zero()).bits()))),
        panics(move |x| if x.lt(zero()).any() { -x } else { x }),
        panics(|x| Number::lit(f64::from(x.to_uint().lane(0)))),
    ] {
        assert!(message.contains("cannot be recorded"), "{message}");
    }
    // of constants all is known
    let module = function(|x| if Number::lit(1.0) < Number::lit(2.0) && Word::splat(3).lane(0) == 3 { x } else { -x });
    assert_eq!(body(&module), "return x;\n");
}

/// The light whose preparation has most rare paths, and the ones whose samples are iterated, as inverses are in narrow sectors.
#[test]
fn lights_have_branches_and_loops() {
    let text = |light: &str| {
        let selection = Selection { lights: vec![light.into()], ..Selection::default() };
        print(&selection.module(), &C, "Written by a test.")
    };
    for light in ["triangle", "sphere", "parallelogram", "polygon"] {
        let text = text(&format!("{light}_by_projected_solid_angle"));
        let count = |what: &str| text.matches(what).count();
        let (branches, loops) = (count(" if ("), count(" for ("));
        println!("{light}: {branches} branches, {loops} loops");
        assert!(branches >= 8 && (1..=2).contains(&loops), "{light}: {branches} branches, {loops} loops");
    }
}

/// The core branches by name; what asks `any` itself cannot be recorded: loops over tables, choices among lights, and sequences of words.
#[test]
fn the_core_branches_by_name() {
    fn look(folder: &std::path::Path, found: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                look(&entry, found);
            } else if std::fs::read_to_string(&entry).unwrap().contains("any()") {
                found.push(entry.to_str().unwrap().rsplit_once("core/src/").unwrap().1.to_owned());
            }
        }
    }
    let mut found = Vec::new();
    look(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("src"), &mut found);
    let may = |file: &String| {
        [
            "lights/",
            "select/",
            "sequence/",
            "real.rs",
            "real/mask.rs",
            "real/uint.rs",
            "light/cells.rs",
            "light/portal.rs",
        ]
        .iter()
        .any(|start| file.starts_with(start))
    };
    found.retain(|file| !may(file));
    assert!(found.is_empty(), "branch by where_any or take_any in {found:?}");
}
