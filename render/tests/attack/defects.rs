//! The scenes on which the renderer was wrong once, each with its variants.

use super::build::{axes, cube, facing, level, placed, triangles};
use super::draft::{Draft, Finish, Form, Look, Part, V3};
use super::judge::Effort;
use crate::random::Random;
use etendue_oracle::along;

/// A scene on which the renderer was wrong.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Case {
    /// The letter of its defect.
    pub(crate) letter: char,
    /// What the scene is.
    pub(crate) about: &'static str,
    /// The text of the scene, as a scene file.
    pub(crate) text: String,
}

/// `auto` decides by the size of pixels, so images are as large as they usually are.
pub(crate) const EFFORT: Effort = Effort { side: 256, block: 32, spp: 64, points: 1, seed: 7 };

fn from(eye: V3, target: V3, fov: f64) -> Look {
    Look { eye: eye.map(|x| f64::from(x as f32)), target, up: [0.0, 1.0, 0.0], fov, lens: None, frame: None }
}

/// A horizontal square light of this side, which faces downwards.
fn panel(center: V3, side: f64, radiance: f32) -> Part {
    let p = along(center, [1.0, 0.0, 1.0], -0.5 * side);
    Part::light(Form::Parallelogram(p, [side, 0.0, 0.0], [0.0, 0.0, side]), radiance, false)
}

fn ground(half: f64) -> Part {
    Part::mesh(level(0.0, half), 0.5)
}

fn draft(name: &str, look: Look, parts: Vec<Part>) -> Draft {
    Draft::new(name.to_owned(), look, parts)
}

/// A floor in a sphere of radius 1, below a light outside of it.
fn in_sphere(lamp_inside: bool, lens: bool, mirror: bool) -> Draft {
    let mut shell = Part::ball([0.0; 3], 1.0, 0.5);
    if mirror {
        shell.finish = Finish::Mirror(0.9);
    }
    let mut parts = vec![Part::mesh(level(0.0, 0.5), 0.5), shell, panel([0.0, 2.0, 0.0], 2.0, 5.0)];
    if lamp_inside {
        parts.push(panel([0.0, 0.6, 0.0], 0.1, 10.0));
    }
    let mut look = from([0.0, 0.5, 0.6], [0.0; 3], 60.0);
    look.lens = lens.then_some([0.05, 0.8]);
    draft("A", look, parts)
}

/// A light of this side above a ball.
fn tiny(side: f64) -> Draft {
    let parts = vec![
        ground(2.0),
        Part::ball([0.0, 1.0, 0.0], 0.6, 0.5),
        panel([0.0, 4.0, 0.0], side, (16.0 / (side * side)) as f32),
    ];
    draft("D", from([0.0, 2.0, 3.0], [0.0, 0.2, 0.0], 45.0), parts)
}

/// A light of 2 mm near a floor with these coordinates.
fn small_parallelogram(scale: f64) -> Draft {
    let center = [41.3, 68.7, 53.9].map(|x| x * scale);
    let light = facing(center, along(center, [0.2, -1.0, 0.1], 1.0), [0.002, 0.002], &mut Random::new(1));
    let floor = level(center[1] - 1.0, 1.0).into_iter();
    let floor = floor.map(|t| t.map(|v| [v[0] + center[0], v[1], v[2] + center[2]])).collect();
    let parts = vec![Part::mesh(floor, 0.5), Part::light(light, 250_000.0, false)];
    let look = from(along(center, [0.0, 0.5, 1.8], 1.0), along(center, [0.0, -1.0, 0.0], 1.0), 45.0);
    draft("E", look, parts)
}

/// A floor of this half size below a box and a light of size 1.
fn vast(half: f64) -> Draft {
    let body = placed(&cube(), [0.3, 0.2, 0.3], &axes(1, &mut Random::new(2)), [0.0, 0.2, 0.0]);
    let parts = vec![ground(half), Part::mesh(triangles(&body), 0.5), panel([0.5, 1.5, 0.0], 0.5, 8.0)];
    draft("F", from([0.0, 1.5, 2.0], [0.0; 3], 50.0), parts)
}

/// A sun at this distance above a unit ball on a floor, on which a smaller ball lies.
fn sun(distance: f64) -> Draft {
    let center = [0.0, 0.8 * distance, 0.6 * distance];
    let radius = distance * libm::tan(0.25_f64.to_radians());
    let light = Part::light(Form::Sphere(center, radius), 20_000.0, false);
    let small = Part::ball([0.0, 2.25, 0.0], 0.25, 0.5);
    let parts = vec![ground(5.0), Part::ball([0.0, 1.0, 0.0], 1.0, 0.5), small, light];
    draft("G", from([1.5, 5.0, -3.0], [0.0, 1.5, -0.3], 25.0), parts)
}

/// A sphere that emits on both sides, above a floor.
fn lantern() -> Draft {
    let light = Part::light(Form::Sphere([0.0, 0.8, 0.0], 0.5), 2.0, true);
    draft("K", from([0.0, 1.5, 2.0], [0.0; 3], 50.0), vec![ground(1.0), light])
}

/// A light with edges of this length, as far above a floor of this half size.
fn huge(side: f64, floor: f64, is_triangle: bool) -> Draft {
    let mut light = panel([0.0, side, 0.0], side, 2.0);
    if let (Form::Parallelogram(p, u, v), true) = (&light.form, is_triangle) {
        light.form = Form::Mesh(vec![[*p, along(*p, *u, 1.0), along(*p, *v, 1.0)]]);
    }
    let parts = vec![ground(floor), Part::ball([0.0, 0.3, 0.0], 0.3, 0.5), light];
    draft("H", from([0.0, 1.5, 2.0], [0.0; 3], 50.0), parts)
}

/// The cases in order.
pub(crate) fn all() -> Vec<Case> {
    let case =
        |about, draft: Draft| Case { letter: draft.name.chars().next().unwrap_or('?'), about, text: draft.to_string() };
    let found = |letter, about, text: &str| Case { letter, about, text: text.to_owned() };
    vec![
        case("camera in a sphere, light outside", in_sphere(false, false, false)),
        case("a second lamp inside", in_sphere(true, false, false)),
        case("through a lens", in_sphere(false, true, false)),
        case("a mirror sphere", in_sphere(true, false, true)),
        found('B', "sheet of 7e-5 at 190", include_str!("defects/sheet.pbrt")),
        found('C', "box with cut corners", include_str!("defects/corner.pbrt")),
        case("light of 1e-3 behind a ball", tiny(1e-3)),
        case("light of 1e-4 behind a ball", tiny(1e-4)),
        case("parallelogram of 2e-3 at 40 to 70", small_parallelogram(1.0)),
        case("parallelogram of 2e-3 at 400 to 700", small_parallelogram(10.0)),
        case("floor of 1e4", vast(1e4)),
        case("floor of 1e5", vast(1e5)),
        case("floor of 1e6", vast(1e6)),
        case("floor of 1e7", vast(1e7)),
        case("sun at 1e5", sun(1e5)),
        case("sun at 1e6", sun(1e6)),
        case("light with edges of 1e10", huge(1e10, 1.0, false)),
        case("triangle light with edges of 1e10", huge(1e10, 1.0, true)),
        case("floor with edges of 1e10", huge(5.0, 5e9, false)),
        case("sphere that emits on both sides", lantern()),
        found('L', "a triangle twice, its plane cuts a light", include_str!("defects/twins.pbrt")),
    ]
}
