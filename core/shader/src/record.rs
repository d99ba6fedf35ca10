//! Lights and warps become functions.

use crate::graph::{Call, Graph, Id};
use crate::layout::{Slot, slots};
use crate::module::{Access, Field, Function, Leaf, Module, Parameter, Struct, Type};
use crate::names::snake;
use crate::number::{Inner, Number, Truth, record};
use crate::wanted::{Part, SampleField, Wanted};
use etendue::listed::light::{self as listed, ListedSampler, Technique, With};
use etendue::listed::warp::{Coordinates, ListedWarp};
use etendue::reflection::Reflection;
use etendue::warp::Warp;
use etendue::{LightSample, LightSampler, Real, Vec2, Vec3};
use std::collections::{BTreeMap, BTreeSet};

fn text(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

/// Numbers one after another.
struct Next(u32);
impl Next {
    fn number(&mut self) -> Number {
        self.0 += 1;
        Number::input(self.0 - 1)
    }
    fn point<P: Coordinates<Number>>(&mut self, coordinates: usize) -> P {
        let number = |k| if k < coordinates { self.number() } else { Number::default() };
        P::from_coordinates([0, 1, 2].map(number))
    }
    fn vec2(&mut self) -> Vec2<Number> {
        let (x, y) = (self.number(), self.number());
        Vec2::new(x, y)
    }
    fn vec3(&mut self) -> Vec3<Number> {
        let (x, y, z) = (self.number(), self.number(), self.number());
        Vec3::new(x, y, z)
    }
}

/// A function whose first inputs are numbers that were prepared, and whose others are those of one parameter. Where they are is not known
/// before all functions of the prepared struct are.
struct Recorded {
    function: Function,
    /// The nodes of the preparation.
    prepared: Vec<Id>,
    parameter: Option<(&'static str, Leaf)>,
}

impl Recorded {
    /// Records a function of something prepared: `map` replaces its numbers, and the function gets the source of its other inputs.
    fn new<S>(
        (name, doc): (&'static str, String),
        preparation: &Graph,
        map: impl FnOnce(&mut dyn FnMut(Number) -> Number) -> S,
        parameter: Option<(&'static str, Leaf)>,
        result: Type,
        function: impl FnOnce(&S, &mut Next) -> Vec<Id>,
    ) -> Self {
        let mut prepared = Vec::new();
        let (outputs, graph) = record(|| {
            let mut indices: BTreeMap<Id, u32> = BTreeMap::new();
            let sampler = map(&mut |number| {
                if let Some(constant) = preparation.constant(number.id()) {
                    return <Number as etendue::Real>::lit(f64::from(constant));
                }
                let index = *indices.entry(number.id()).or_insert_with(|| {
                    prepared.push(number.id());
                    prepared.len() as u32 - 1
                });
                Number::input(index)
            });
            function(&sampler, &mut Next(prepared.len() as u32))
        });
        let (name, parameters, inputs) = (name.to_owned(), Vec::new(), Vec::new());
        let function = Function { name, doc, parameters, inputs, result, outputs, graph };
        Self { function, prepared, parameter }
    }
    /// Those of the prepared numbers that it uses.
    fn used(&self) -> BTreeSet<Id> {
        let used = self.function.used_inputs().into_iter();
        used.filter_map(|index| self.prepared.get(index as usize).copied()).collect()
    }
}

/// A field by its index, and the coordinate if that is a vector.
type FieldPlace = (usize, Option<usize>);

/// The fields for the numbers that are used, the nodes of their values, and where each number is.
fn fields(slots: &[Slot], used: &BTreeSet<Id>) -> (Vec<Field>, Vec<Id>, BTreeMap<Id, FieldPlace>) {
    let (mut fields, mut outputs, mut places) = (Vec::new(), Vec::new(), BTreeMap::new());
    let mut add = |name: String, parts: &[Id], places: &mut BTreeMap<Id, FieldPlace>| {
        for (axis, &id) in parts.iter().enumerate() {
            places.entry(id).or_insert((fields.len(), (parts.len() > 1).then_some(axis)));
        }
        outputs.extend(parts);
        fields.push(Field { name, leaf: Leaf::of_numbers(parts.len()), doc: String::new() });
    };
    for Slot { name, parts } in slots {
        let is_new = |id: &Id, places: &BTreeMap<Id, _>| used.contains(id) && !places.contains_key(id);
        let distinct = parts.iter().collect::<BTreeSet<_>>().len() == parts.len();
        if distinct && parts.iter().all(|id| is_new(id, &places)) {
            add(name.clone(), parts, &mut places);
        } else {
            for (id, axis) in parts.iter().zip(["x", "y", "z"]) {
                if is_new(id, &places) {
                    let separator = if name.is_empty() { "" } else { "_" };
                    add(format!("{name}{separator}{axis}"), &[*id], &mut places);
                }
            }
        }
    }
    (fields, outputs, places)
}

fn all_of(slots: &[Slot]) -> BTreeSet<Id> {
    slots.iter().flat_map(|slot| slot.parts.iter().copied()).collect()
}

/// The struct of reflections, for which lights are prepared.
pub(crate) fn reflection_struct() -> Struct {
    type Of = Reflection<f32>;
    let (warp, _) = record(|| {
        let mut next = Next(0);
        Of::warp(&mut || next.number())
    });
    let slots = slots(&warp);
    let (fields, ..) = fields(&slots, &all_of(&slots));
    Struct { name: Of::ENTRY.name.into(), doc: text(Of::ENTRY.doc), fields }
}

/// Adds the struct of what was prepared, with the fields that the functions use or with all, and these functions. Returns the struct, if it has any
/// fields, and the nodes of their values.
fn add_functions(
    module: &mut Module,
    name: &str,
    doc: String,
    (slots, whole): (&[Slot], bool),
    functions: Vec<Recorded>,
) -> (Option<usize>, Vec<Id>) {
    let used = if whole { all_of(slots) } else { functions.iter().flat_map(Recorded::used).collect() };
    let (fields, outputs, places) = fields(slots, &used);
    let prepared = (!fields.is_empty()).then(|| module.add_struct(Struct { name: name.to_owned(), doc, fields }));
    for Recorded { mut function, prepared: numbers, parameter } in functions {
        if let Some(prepared) = prepared {
            function.parameters.push(Parameter { name: "prepared".into(), of: Type::Struct(prepared) });
        }
        for id in &numbers {
            // what no function uses has no field, and no access either
            let (field, axis) = places.get(id).copied().unwrap_or((usize::MAX, None));
            function.inputs.push(Access { parameter: 0, field: Some(field), axis });
        }
        if let Some((name, leaf)) = parameter {
            let parameter = function.parameters.len();
            function.parameters.push(Parameter { name: name.into(), of: Type::Leaf(leaf) });
            let parts = module.parts(Type::Leaf(leaf)).into_iter();
            function.inputs.extend(parts.map(|(field, axis)| Access { parameter, field, axis }));
        }
        function.name = format!("{name}_{}", function.name);
        module.functions.push(function);
    }
    (prepared, outputs)
}

/// The inputs of parameters.
pub(crate) fn inputs_of(module: &Module, parameters: &[Parameter]) -> Vec<Access> {
    let each = |(parameter, of): (usize, &Parameter)| {
        module.parts(of.of).into_iter().map(move |(field, axis)| Access { parameter, field, axis })
    };
    parameters.iter().enumerate().flat_map(each).collect()
}

/// The values of a sample in the order of its fields.
pub(crate) fn sample_outputs(s: &LightSample<Number>, wanted: &Wanted) -> Vec<Id> {
    let vec3 = |v: Vec3<Number>| vec![v.x.id(), v.y.id(), v.z.id()];
    let truth = |mask: Truth| vec![mask.id()];
    let of = |field: &SampleField| match field {
        SampleField::Direction => vec3(s.direction),
        SampleField::Normal => vec3(s.normal),
        SampleField::Uv => vec![s.uv.x.id(), s.uv.y.id()],
        SampleField::Distance => vec![s.distance.id()],
        SampleField::Pdf => vec![s.pdf.id()],
        SampleField::Weight => vec![s.weight().id()],
        SampleField::Emits => truth(s.emits),
        SampleField::Delta => truth(s.delta),
    };
    wanted.fields.iter().flat_map(of).collect()
}

/// The struct of a sample.
pub(crate) fn sample_struct(wanted: &Wanted) -> Struct {
    let field = |f: &SampleField| Field { name: f.name().into(), leaf: f.leaf(), doc: f.doc().into() };
    Struct {
        name: "light_sample".into(),
        doc: "A sample of a light as seen from a shading point, or the point of a light that a ray hits.".into(),
        fields: wanted.fields.iter().map(field).collect(),
    }
}
/// The struct of a light.
fn light_struct<T: Technique>() -> Struct {
    let (entry, mut numbers) = (T::ENTRY, 0);
    let _ = T::light(&mut || numbers += 1);
    let fields = |of: &listed::Field| {
        let names = match of.kind {
            "corners" => (0..numbers / 3).map(|k| format!("{}_{k}", of.name)).collect(),
            _ => vec![of.name.to_owned()],
        };
        let (leaf, doc) = (if of.kind == "number" { Leaf::Real } else { Leaf::Vec3 }, text(of.doc));
        names.into_iter().map(|name| Field { name, leaf, doc: doc.clone() }).collect::<Vec<_>>()
    };
    let fields = entry.fields.iter().flat_map(fields).collect();
    Struct { name: snake(entry.light), doc: text(entry.light_doc), fields }
}
/// Adds a light by a technique.
pub fn add_technique<T: Technique>(module: &mut Module, wanted: &Wanted) {
    let entry = T::ENTRY;
    let light_name = snake(entry.light);
    let name = format!("{light_name}_{}", entry.by);
    let at_point = entry.place.first() == Some(&"p");
    let structure = match entry.with() {
        With::Reflection => Some(("reflection", " and what a surface reflects", reflection_struct())),
        With::Nothing | With::Normal => None,
    };
    let (sampler, preparation) = record(|| {
        let mut next = Next(0);
        let light = T::light(&mut || next.number());
        // in the order of the parameters: structs come before vectors
        let of_struct = structure.is_some().then(|| T::with(&mut || next.number()));
        let p = if at_point { next.vec3() } else { Vec3::default() };
        let with = of_struct.unwrap_or_else(|| T::with(&mut || next.number()));
        T::prepare(light, p, with)
    });

    let sample = sample_struct(wanted);
    let technique_doc = text(entry.doc);
    let mut functions = Vec::new();
    for part in &wanted.parts {
        let map = |f: &mut dyn FnMut(Number) -> Number| <T::Sampler as ListedSampler>::map_over(sampler, f);
        let w = Some(("w", Leaf::Vec3));
        let doc = |what: &str| (part.name(), format!("{what} {technique_doc}"));
        let real = Type::Leaf(Leaf::Real);
        functions.push(match part {
            Part::Sample => {
                let result = Type::Struct(module.add_struct(sample.clone()));
                let doc = doc("Draws a direction to the light for u in [0, 1)^2.");
                Recorded::new(doc, &preparation, map, Some(("u", Leaf::Vec2)), result, |sampler, next| {
                    sample_outputs(&sampler.sample(next.vec2()), wanted)
                })
            }
            Part::Hit => {
                let result = Type::Struct(module.add_struct(sample.clone()));
                let doc = doc("The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses.");
                Recorded::new(doc, &preparation, map, w, result, |sampler, next| {
                    sample_outputs(&sampler.hit(next.vec3()), wanted)
                })
            }
            Part::Pdf => {
                let doc = doc("The density with which the unit direction w is drawn; 0 where it misses the light.");
                Recorded::new(doc, &preparation, map, w, real, |sampler, next| vec![sampler.pdf(next.vec3()).id()])
            }
            Part::Invert => {
                let doc = doc("The u in [0, 1)^2 that is mapped to the unit direction w; any where it misses the light.");
                Recorded::new(doc, &preparation, map, w, Type::Leaf(Leaf::Vec2), |sampler, next| {
                    let u = sampler.invert(next.vec3());
                    vec![u.x.id(), u.y.id()]
                })
            }
            Part::Measure => {
                let Some(measure) = entry.measure else { continue };
                let doc = format!("The {} that samples are uniform over. {technique_doc}", measure.replace('_', " "));
                Recorded::new((measure, doc), &preparation, map, None, real, |sampler, _| {
                    vec![T::measure(sampler).expect("the list has a measure").id()]
                })
            }
        });
    }
    let prepared_doc = format!("A {} prepared for a shading point. {technique_doc}", light_name.replace('_', " "));
    let prepared_at = module.functions.len();
    let (prepared, outputs) = add_functions(module, &name, prepared_doc, (&slots(&sampler), false), functions);
    let Some(prepared) = prepared else { return };

    let light = module.add_struct(light_struct::<T>());
    let mut parameters = vec![Parameter { name: "light".into(), of: Type::Struct(light) }];
    let mut doc = "Prepares a light".to_owned();
    if let Some((name, what, structure)) = structure {
        let structure = module.add_struct(structure);
        parameters.push(Parameter { name: name.into(), of: Type::Struct(structure) });
        doc += what;
    }
    if at_point {
        parameters.push(Parameter { name: "p".into(), of: Type::Leaf(Leaf::Vec3) });
        doc += " for the shading point p";
    }
    if entry.with() == With::Normal {
        parameters.push(Parameter { name: "n".into(), of: Type::Leaf(Leaf::Vec3) });
        doc += " of a surface with the unit normal n";
    }
    let prepare = Function {
        name: format!("{name}_prepare"),
        doc: format!("{doc}. {technique_doc}"),
        inputs: inputs_of(module, &parameters),
        parameters,
        result: Type::Struct(prepared),
        outputs,
        graph: preparation,
    };
    module.functions.insert(prepared_at, prepare);
}

/// Adds a warp.
pub fn add_warp<W: ListedWarp>(module: &mut Module, wanted: &Wanted) {
    let entry = W::ENTRY;
    let name = entry.name;
    let (warp, preparation) = record(|| {
        let mut next = Next(0);
        W::warp(&mut || next.number())
    });
    let doc = text(entry.doc);
    let (coordinates, point) = (entry.coordinates, Leaf::of_numbers(entry.coordinates));
    let mut functions = Vec::new();
    for part in &wanted.parts {
        let map = |f: &mut dyn FnMut(Number) -> Number| W::map(warp, f);
        let told = |what: &str| (part.name(), format!("{what} {doc}"));
        functions.push(match part {
            Part::Sample => {
                let doc = told("Maps u, of which each number is in [0, 1), to a point.");
                Recorded::new(doc, &preparation, map, Some(("u", Leaf::Vec2)), Type::Leaf(point), |warp, next| {
                    warp.sample(next.vec2()).coordinates()[..coordinates].iter().map(|x| x.id()).collect()
                })
            }
            Part::Pdf => {
                let doc = told("The density of a point; 0 outside of the range.");
                Recorded::new(doc, &preparation, map, Some(("point", point)), Type::Leaf(Leaf::Real), |warp, next| {
                    vec![warp.pdf(next.point(coordinates)).id()]
                })
            }
            Part::Invert => {
                let doc = told("The u that is mapped to a point; any in [0, 1) for a point outside of the range.");
                Recorded::new(doc, &preparation, map, Some(("point", point)), Type::Leaf(Leaf::Vec2), |warp, next| {
                    let u = warp.invert(next.point(coordinates));
                    vec![u.x.id(), u.y.id()]
                })
            }
            Part::Hit | Part::Measure => continue,
        });
    }
    let prepared_at = module.functions.len();
    // lights are prepared for a whole reflection
    let is_whole = name == Reflection::<f32>::ENTRY.name;
    // the only one with private fields
    let prepared_from: &[(&str, usize)] =
        if name == "ggx_visible_normals" { &[("alpha_x", 1), ("alpha_y", 1), ("wi", 3)] } else { &[] };
    let (prepared, outputs) = add_functions(module, name, doc.clone(), (&slots(&warp), is_whole), functions);
    let (Some(prepared), false) = (prepared, prepared_from.is_empty()) else { return };
    let parameter =
        |&(name, count): &(&str, usize)| Parameter { name: name.into(), of: Type::Leaf(Leaf::of_numbers(count)) };
    let parameters: Vec<_> = prepared_from.iter().map(parameter).collect();
    let prepare = Function {
        name: format!("{name}_prepare"),
        doc: format!("Prepares the map. {doc}"),
        inputs: inputs_of(module, &parameters),
        parameters,
        result: Type::Struct(prepared),
        outputs,
        graph: preparation,
    };
    module.functions.insert(prepared_at, prepare);
}

/// What a function of the core computes, with its greatest error.
fn call_doc(call: Call) -> &'static str {
    match call {
        Call::SinCosTurns => "(sin 2πx, cos 2πx) within 8.5e-8, for |x| < 2^126.",
        Call::SinCosQuarters => "(sin πx/2, cos πx/2) within 8.5e-8, for x in [-0.5, 0.5].",
        Call::Acos => "Arc cosine of x clamped to [-1, 1], in radians, within 2.3e-7 of itself.",
        Call::Atan2 => "Angle of (x, y) in radians, in [-π, π], within 2.1e-7 of itself; 0 at the origin.",
        Call::AtanEighth => "Arc tangent of x in [-tan π/8, tan π/8], in radians, within 2.1e-7 of itself.",
        Call::Cbrt => "Cube root of x >= 0 within 7.9e-8 of itself; 0 of subnormal numbers.",
    }
}

/// Adds the functions of the core that the other functions call, before these.
pub fn add_calls(module: &mut Module) {
    let functions = module.calls().into_iter().map(|call| {
        let names: &[&str] = if call == Call::Atan2 { &["y", "x"] } else { &["x"] };
        let (outputs, graph) = record(|| {
            let x = Inner::input(0);
            let pair = |(sin, cos): (Inner, Inner)| vec![sin.id(), cos.id()];
            match call {
                Call::SinCosTurns => pair(x.sin_cos_turns()),
                Call::SinCosQuarters => pair(x.sin_cos_quarters()),
                Call::Acos => vec![x.acos().id()],
                Call::Atan2 => vec![x.atan2(Inner::input(1)).id()],
                Call::AtanEighth => vec![x.atan_eighth().id()],
                Call::Cbrt => vec![x.cbrt().id()],
            }
        });
        let parameters = names.iter().map(|&name| Parameter { name: name.into(), of: Type::Leaf(Leaf::Real) });
        let parameters: Vec<_> = parameters.collect();
        Function {
            name: call.name().into(),
            doc: call_doc(call).into(),
            inputs: inputs_of(module, &parameters),
            parameters,
            result: Type::Leaf(Leaf::of_numbers(outputs.len())),
            outputs,
            graph,
        }
    });
    let functions: Vec<_> = functions.collect();
    module.functions.splice(0..0, functions);
}
