//! Flat lights with pictures, which are read from memory.

use crate::graph::Id;
use crate::inputs::{Inputs, add_function, add_words};
use crate::list::{Technique, TechniqueVisitor, every_technique};
use crate::module::{Leaf, Module, Struct, Type};
use crate::names::snake;
use crate::number::{Number, Word, Words, record};
use crate::record::{drawn_struct, light_struct, sample_outputs, sample_struct};
use crate::wanted::{Part, Wanted};
use etendue::light::{PictureWords, PicturedLight, Region, TexelSample};
use etendue::{Disk, LightSampler, Parallelogram, Triangle, Vec3};

/// A light with a picture by a technique.
#[derive(Clone, Copy)]
struct Kind {
    interpolated: bool,
    light: &'static str,
    by: &'static str,
}

/// All of them.
fn kinds() -> Vec<Kind> {
    let lights = [(false, "parallelogram"), (false, "triangle"), (false, "disk"), (true, "parallelogram")];
    let kinds = |(interpolated, light)| {
        ["area", "solid_angle", "projected_solid_angle"].map(|by| Kind { interpolated, light, by })
    };
    lights.into_iter().flat_map(kinds).collect()
}

impl Kind {
    fn name(self) -> String {
        let Self { interpolated, light, by } = self;
        format!("{}_{light}_by_{by}", if interpolated { "interpolated" } else { "pictured" })
    }
    fn region(self) -> Region {
        match self.light {
            "triangle" => Region::Triangle,
            "disk" => Region::Disk,
            _ => Region::Square,
        }
    }
    fn doc(self) -> String {
        let picture = if self.interpolated { "interpolated radiance" } else { "radiance of the texel" };
        let by = match self.by {
            "area" => "area: for lights that are small for their distance.",
            "solid_angle" => "solid angle.",
            _ => "projected solid angle above the horizon of the unit normal n.",
        };
        format!("In proportion to the {picture} times {by} The picture is in the surface coordinates of the light.")
    }
    /// Adds the struct of the picture.
    fn add_picture(self, module: &mut Module) -> usize {
        let shares = ("shares", "Index of the first word of the buffer that Picture::build has filled.");
        let counts = [("columns", "Columns of texels."), ("rows", "Rows of texels.")];
        if self.interpolated {
            let doc = "A picture in memory that is interpolated between the centres of its texels, as Picture::interpolated builds it.";
            let values = ("values", "Index of the first of the radiances at the centres, row by row.");
            add_words(module, "interpolated_picture", doc, &[shares, values, counts[0], counts[1]])
        } else {
            let doc = "A picture in memory, as Picture::build builds it for the part of the surface coordinates that its light covers.";
            add_words(module, "picture", doc, &[shares, counts[0], counts[1]])
        }
    }
    /// The picture of a parameter.
    fn picture(self, module: &Module, inputs: &mut Inputs, of: usize) -> PictureWords<Words, Word> {
        let ([shares, columns, rows], values) = if self.interpolated {
            let [shares, values, columns, rows] = inputs.words(module, "picture", of);
            ([shares, columns, rows], Some(values))
        } else {
            (inputs.words(module, "picture", of), None)
        };
        PictureWords { memory: Words, shares, values, size: [columns, rows], region: self.region() }
    }
}

/// The names of lights with pictures by their techniques.
pub(crate) fn pictured() -> Vec<String> {
    kinds().into_iter().map(Kind::name).collect()
}

/// The struct of a light of the list.
struct Find(&'static str, Option<Struct>);
impl TechniqueVisitor for Find {
    fn visit<T: Technique>(&mut self) {
        if self.1.is_none() && snake(T::ENTRY.light) == self.0 {
            let make = || {
                let mut next = 0;
                let light = T::light(&mut || {
                    next += 1;
                    Number::input(next - 1)
                });
                light_struct::<T>(&light)
            };
            self.1 = Some(record(make).0);
        }
    }
}

/// What a function of a kind is given.
struct Given<'a> {
    kind: Kind,
    module: &'a Module,
    inputs: &'a mut Inputs,
    picture: usize,
    light: usize,
}

impl Given<'_> {
    fn picture(&mut self) -> PictureWords<Words, Word> {
        self.kind.picture(self.module, self.inputs, self.picture)
    }
    fn numbers(&mut self) -> Vec<Number> {
        self.inputs.numbers(self.module, "light", self.light)
    }
    fn point(&mut self) -> Vec3<Number> {
        self.inputs.vec3("p")
    }
}

type On<L> = PicturedLight<PictureWords<Words, Word>, L>;
fn vec3(x: &[Number]) -> Vec3<Number> {
    Vec3::new(x[0], x[1], x[2])
}
fn parallelogram(given: &mut Given<'_>) -> On<Parallelogram<Number>> {
    let (picture, x) = (given.picture(), given.numbers());
    picture.on(Parallelogram { corner: vec3(&x), edge_s: vec3(&x[3..]), edge_t: vec3(&x[6..]) })
}
fn triangle(given: &mut Given<'_>) -> On<Triangle<Number>> {
    let (picture, x) = (given.picture(), given.numbers());
    picture.on(Triangle { v0: vec3(&x), e1: vec3(&x[3..]), e2: vec3(&x[6..]) })
}
fn disk(given: &mut Given<'_>) -> On<Disk<Number>> {
    let (picture, x) = (given.picture(), given.numbers());
    picture.on(Disk { center: vec3(&x), normal: vec3(&x[3..]), radius: x[6] })
}

/// A sample with its texel.
fn drawn_outputs(s: &TexelSample<Number>, wanted: &Wanted) -> Vec<Id> {
    [sample_outputs(&s.light, wanted), vec![s.x.id(), s.y.id()]].concat()
}

/// Adds the functions of a kind, given a function that prepares it from what it is given.
macro_rules! functions {
    ($module:ident, $wanted:ident, $kind:ident, $picture:ident, $light:ident, $prepare:expr) => {{
        let name = $kind.name();
        let sample = sample_struct($wanted);
        let drawn = drawn_struct("picture_sample", "A sample of a light with a picture.", $wanted);
        let add = |module: &mut Module, part: &str, doc: &str, result: Type, body: &dyn Fn(&mut Given<'_>) -> Vec<Id>| {
            add_function(module, &format!("{name}_{part}"), |module, inputs| {
                let mut given = Given { kind: $kind, module, inputs, picture: $picture, light: $light };
                let outputs = body(&mut given);
                (format!("{doc} {}", $kind.doc()), result, outputs)
            });
        };
        for part in &$wanted.parts {
            match part {
                Part::Sample => {
                    let result = Type::Struct($module.add_struct(drawn.clone()));
                    let doc = "Draws a direction to the light for u in [0, 1)^2, with its texel: what an estimator takes.";
                    add($module, "draw", doc, result, &|given| {
                        let sampler = $prepare(given);
                        drawn_outputs(&sampler.draw(given.inputs.vec2("u")), $wanted)
                    });
                    let result = Type::Struct($module.add_struct(sample.clone()));
                    let doc = "Draws a direction to the light for u in [0, 1)^2, with the density that the function for a direction reports.";
                    add($module, "sample", doc, result, &|given| {
                        let sampler = $prepare(given);
                        sample_outputs(&sampler.sample(given.inputs.vec2("u")), $wanted)
                    });
                }
                Part::Hit => {
                    let result = Type::Struct($module.add_struct(sample.clone()));
                    let doc = "The point of the light in the unit direction w, with the density of that; pdf 0 where it misses.";
                    add($module, "hit", doc, result, &|given| {
                        let sampler = $prepare(given);
                        sample_outputs(&sampler.hit(given.inputs.vec3("w")), $wanted)
                    });
                }
                Part::Pdf => {
                    let doc = "The density with which the unit direction w is drawn; 0 where it misses the light.";
                    add($module, "pdf", doc, Type::Leaf(Leaf::Real), &|given| {
                        let sampler = $prepare(given);
                        vec![sampler.pdf(given.inputs.vec3("w")).id()]
                    });
                }
                Part::Invert => {
                    let doc = "The u in [0, 1)^2 that is mapped to the unit direction w; any where it misses the light.";
                    add($module, "invert", doc, Type::Leaf(Leaf::Vec2), &|given| {
                        let sampler = $prepare(given);
                        let u = sampler.invert(given.inputs.vec3("w"));
                        vec![u.x.id(), u.y.id()]
                    });
                }
                Part::Measure => {}
            }
        }
    }};
}
/// The same for a light by each technique.
macro_rules! techniques {
    ($module:ident, $wanted:ident, $kind:ident, $picture:ident, $light:ident, $on:ident) => {
        match $kind.by {
            "area" => functions!($module, $wanted, $kind, $picture, $light, |given: &mut Given<'_>| {
                let on = $on(given);
                on.by_area(given.point())
            }),
            "solid_angle" => functions!($module, $wanted, $kind, $picture, $light, |given: &mut Given<'_>| {
                let on = $on(given);
                on.by_solid_angle(given.point())
            }),
            _ => functions!($module, $wanted, $kind, $picture, $light, |given: &mut Given<'_>| {
                let on = $on(given);
                let p = given.point();
                on.by_projected_solid_angle(p, given.inputs.vec3("n"))
            }),
        }
    };
}

/// Adds a light with a picture.
///
/// # Panics
/// If none has this name.
pub(crate) fn add_pictured(module: &mut Module, name: &str, wanted: &Wanted) {
    let kind = kinds().into_iter().find(|kind| kind.name() == name);
    let kind = kind.unwrap_or_else(|| panic!("there is no table {name}"));
    let mut find = Find(kind.light, None);
    every_technique(&mut find);
    let light = module.add_struct(find.1.expect("the list has the light"));
    let picture = kind.add_picture(module);
    match kind.light {
        "triangle" => techniques!(module, wanted, kind, picture, light, triangle),
        "disk" => techniques!(module, wanted, kind, picture, light, disk),
        _ => techniques!(module, wanted, kind, picture, light, parallelogram),
    }
}
