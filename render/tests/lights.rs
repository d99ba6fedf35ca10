//! Laws of the choice and the sampling of lights, which an image cannot show: a wrong weight of two percent hides in its noise.

use crate::kit::Folder;
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Uint, Vec2, Vec3, u32x8};
use etendue_oracle::tier::cases;
use etendue_render::choose::{ChoiceBy, Chooser, Choosers};
use etendue_render::geometry::{Geometry, Parallelogram, Sphere};
use etendue_render::lights::sky::Sky;
use etendue_render::lights::{Drawn, Lights};
use etendue_render::packet::{V8, X8};
use etendue_render::scene::{self, DeltaLight, Scene};
use etendue_render::technique::Measure;
use std::sync::Arc;

/// Points about the lights of a scene, each with a unit normal, and four random numbers.
fn packet(scene: &Scene, number: u32) -> (V8, V8, [X8; 4]) {
    let lanes = u32x8::from_fn(|k| number * 8 + k as u32);
    let pairs: [Vec2<X8>; 5] =
        core::array::from_fn(|dimension| Independent::new(7).pair(u32x8::splat(0), lanes, dimension as u32));
    let shape = &scene.shapes[number as usize * 7919 % scene.shapes.len()];
    let [low, high] = shape.geometry.bounds();
    let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max).max(1e-3);
    // up to ten sizes away
    let [x, y, z] = [pairs[0].x, pairs[0].y, pairs[1].x];
    let away = |u: X8, k: usize| X8::splat(low[k]) + (u - X8::lit(0.5)) * X8::splat(20.0 * size);
    let p = V8::new(away(x, 0), away(y, 1), away(z, 2));
    let normal = V8::new(pairs[1].y - X8::lit(0.5), pairs[2].x - X8::lit(0.5), pairs[2].y - X8::lit(0.4)).normalize();
    (p, normal, [pairs[3].x, pairs[3].y, pairs[4].x, pairs[4].y])
}

/// The ways to choose among lights that are possible.
fn choosers<'a>(choosers: &'a Choosers, lights: &Lights) -> Vec<(ChoiceBy, &'a Chooser)> {
    let by = |by| Some((by, choosers.by(lights, by).ok()?));
    ChoiceBy::ALL.into_iter().filter_map(by).collect()
}

/// The pdf of a direction, with which MIS weights it, is bit for bit the product of the probability with which its light was chosen, in
/// whatever way, and the pdf with which the light was sampled.
#[test]
fn the_pdf_of_a_direction_is_that_with_which_it_was_drawn() {
    let mut kinds = [0_u32; 3];
    for (name, _) in etendue_scene::builtin() {
        let mut scene = etendue_scene::load(name).unwrap();
        // trees of all lights of a city take the time of all others
        scene.shapes = scene.shapes.iter().take(cases(1000, usize::MAX)).cloned().collect();
        let lights = Lights::new(&scene, None);
        if scene.shapes.is_empty() || lights.is_empty() || lights.only_deltas() {
            continue;
        }
        let all = Choosers::new(&lights, 1.0).unwrap();
        let choosers = choosers(&all, &lights);
        let mut compared = 0;
        for number in 0..cases(16, 200) * choosers.len() as u32 {
            let (by, chooser) = choosers[number as usize % choosers.len()];
            let (p, normal, [u, second, x, y]) = packet(&scene, number);
            let choice = chooser.choose(p, normal, None, [u, second]);
            let chosen = lights.chosen(choice.index);
            let Drawn { to: drawn, primitives, .. } =
                lights.sample(&chosen, Measure::SolidAngle, p, normal, Vec2::new(x, y));
            let pmf = |light| chooser.pmf(p, normal, None, |pmf| pmf(light));
            let sampled = choice.pmf.gt(X8::lit(0.0)) & drawn.pdf.gt(X8::lit(0.0)) & !drawn.delta;
            for lane in (0..8).filter(|&lane| sampled.lane(lane)) {
                let index = primitives.lane(lane).shape().unwrap();
                let geometry = &scene.shapes[index].geometry;
                let pmf = pmf(lights.of_shape(index));
                let pdf = (lights.shape_pdf(index, geometry, p, drawn.direction) * pmf).lane(lane);
                let own = drawn.pdf.lane(lane) * choice.pmf.lane(lane);
                assert_eq!(pdf.to_bits(), own.to_bits(), "{name} by {by:?}, shape {index}: {pdf} and {own}");
                compared += 1;
            }
        }
        assert!(compared > cases(8, 100), "{name}: only {compared} directions");
        kinds[if lights.len() == 1 {
            0
        } else if choosers[0].1.few().is_some() {
            1
        } else {
            2
        }] += 1;
    }
    println!("scenes with one light, few and many: {kinds:?}");
    assert!(kinds.iter().all(|&scenes| scenes > 0), "{kinds:?}");
}

/// The same of the sky, among other lights.
#[test]
fn the_pdf_of_the_sky_is_that_with_which_it_was_drawn() {
    let mut compared = 0;
    for (name, _) in etendue_scene::builtin() {
        let mut scene = etendue_scene::load(name).unwrap();
        let Some(environment) = scene.environment.take() else { continue };
        let sky = Arc::new(Sky::new(&environment));
        // as bright as the sky, or nearly so
        let intensity = [0.1 * sky.flux() as f32; 3];
        scene.delta_lights.push(DeltaLight::Point { position: [0.0, 3.0, 0.0], intensity });
        let lights = Lights::new(&scene, Some(sky));
        let choosers = Choosers::new(&lights, 1.0).unwrap();
        let chooser = choosers.by(&lights, ChoiceBy::Auto).unwrap();
        for number in 0..50 {
            let lanes = u32x8::from_fn(|k| number * 8 + k as u32);
            let pair = |dimension| -> Vec2<X8> { Independent::new(9).pair(u32x8::splat(0), lanes, dimension) };
            let away = |x: X8| (x - X8::lit(0.5)) * X8::lit(10.0);
            let (p, normal) = (V8::new(away(pair(0).x), away(pair(0).y), away(pair(1).x)), V8::lit([0.0, 0.6, 0.8]));
            let (Vec2 { x: u, y: second }, Vec2 { x, y }) = (pair(2), pair(3));
            let choice = chooser.choose(p, normal, None, [u, second]);
            let chosen = lights.chosen(choice.index);
            let drawn = lights.sample(&chosen, Measure::SolidAngle, p, normal, Vec2::new(x, y)).to;
            let pmf = chooser.pmf(p, normal, None, |pmf| pmf(lights.of_sky()));
            let pdf = lights.sky_pdf(p, normal, drawn.direction) * pmf;
            for lane in (0..8).filter(|&lane| choice.index.lane(lane) + 1 == lights.len() as u32) {
                let above = normal.dot(V8::lit([0.0, 3.0, 0.0]) - p).lane(lane);
                let shared = choice.pmf.lane(lane) < 1.0;
                assert!(
                    shared == (above > 0.0) || above.abs() < 1e-3,
                    "{name}: the lamp has a share where it is above"
                );
                let own = drawn.pdf.lane(lane) * choice.pmf.lane(lane);
                let pdf = pdf.lane(lane);
                assert!((pdf - own).abs() <= 1e-5 * own, "{name}: {pdf} and {own}");
                compared += u32::from(own > 0.0);
            }
        }
    }
    assert!(compared > 50, "{compared}");
}

/// At each point that a light can reach, the probabilities of all lights sum to 1, in whatever way they are chosen; to less in a tree, which may
/// find none.
#[test]
fn the_pmf_of_all_lights_sums_to_one() {
    let mut exact = [0; 6];
    for (name, _) in etendue_scene::builtin_of_few_lights() {
        let scene = etendue_scene::load(name).unwrap();
        let lights = Lights::new(&scene, None);
        if scene.shapes.is_empty() || lights.is_empty() {
            continue;
        }
        let all = Choosers::new(&lights, 1.0).unwrap();
        let choosers = choosers(&all, &lights);
        for number in 0..200 * choosers.len() as u32 {
            let (by, chooser) = choosers[number as usize % choosers.len()];
            let (p, normal, [u, second, ..]) = packet(&scene, number);
            let chosen = chooser.choose(p, normal, None, [u, second]).pmf.gt(X8::lit(0.0));
            let pmf = |light| chooser.pmf(p, normal, None, |pmf| pmf(light));
            for lane in (0..8).filter(|&lane| chosen.lane(lane)) {
                let sum: f64 = (0..lights.len() as u32).map(|light| pmf(light).lane_f64(lane)).sum();
                assert!(sum < 1.0 + 2e-6, "{name} by {by:?}: {sum}");
                let is_tree = matches!(by, ChoiceBy::Tree | ChoiceBy::Kinds) || !lights.only_few_areas();
                if !is_tree || matches!(by, ChoiceBy::Uniform | ChoiceBy::Power) {
                    assert!(sum > 1.0 - 2e-6, "{name} by {by:?}: {sum}");
                    exact[by as usize] += 1;
                }
            }
        }
    }
    assert!(
        [ChoiceBy::Auto, ChoiceBy::Uniform, ChoiceBy::Power, ChoiceBy::Spatial]
            .iter()
            .all(|&by| exact[by as usize] > 1000),
        "{exact:?}"
    );
}

/// The bound of a light with an area is the least sphere about its centre that holds it, with the power of one side in units of π.
#[test]
fn bounds_are_those_of_the_shapes() {
    let mut kinds = [0; 3];
    for (name, _) in etendue_scene::builtin_of_few_lights() {
        let scene = etendue_scene::load(name).unwrap();
        let shapes = scene.shapes.iter().filter(|shape| shape.emission.is_some());
        let bounds = Lights::bounds(&scene);
        assert_eq!(bounds.len(), shapes.clone().count(), "{name}");
        for (shape, bound) in shapes.zip(bounds).step_by(7) {
            let emission = shape.emission.unwrap();
            let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
            let (corners, center, normal) = match shape.geometry {
                Geometry::Sphere(Sphere { center, .. }) => (vec![], wide(center), Vec3::default()),
                Geometry::Triangle(corners) => {
                    let [a, b, c] = corners.map(wide);
                    (vec![a, b, c], (a + b + c) * (1.0 / 3.0), (b - a).cross(c - a))
                }
                Geometry::Parallelogram(Parallelogram { p, u, v }) => {
                    let [p, u, v] = [p, u, v].map(wide);
                    (vec![p, p + u, p + v, p + u + v], p + (u + v) * 0.5, u.cross(v))
                }
                ref other => panic!("{name}: no built-in scene has {other:?}"),
            };
            kinds[[0, 3, 4].iter().position(|&n| n == corners.len()).unwrap()] += 1;
            let radius = match shape.geometry {
                Geometry::Sphere(Sphere { radius, .. }) => f64::from(radius),
                _ => corners.iter().map(|&corner| (corner - center).length()).fold(0.0, f64::max),
            };
            let reach = wide(bound.center).length() + radius;
            assert!((wide(bound.center) - center).length() < 1e-6 * reach, "{name}: {bound:?}");
            let off = f64::from(bound.radius) - radius;
            assert!(off >= 0.0 && off < 2e-6 * radius, "{name}: {bound:?} for the radius {radius}");
            let unit = normal * (1.0 / normal.length().max(f64::MIN_POSITIVE));
            assert!((wide(bound.normal) - unit).length() < 1e-6, "{name}: {bound:?}");
            assert_eq!((bound.two_sided, bound.cos_cone), (emission.two_sided && !corners.is_empty(), 0.0), "{name}");
            let sum: f64 = emission.radiance.iter().map(|&x| f64::from(x)).sum();
            assert!((f64::from(bound.power) / (sum * shape.geometry.area()) - 1.0).abs() < 1e-6, "{name}: {bound:?}");
        }
    }
    assert!(kinds.iter().all(|&kind| kind > 0), "spheres, triangles, parallelograms: {kinds:?}");
}

/// A distant light and a lamp share a part of the chance equally, and the rest by the irradiance that each causes, however large the scene is.
#[test]
fn lights_far_away_have_their_share_of_the_irradiance() {
    let mut scene = etendue_scene::load("sphere-light").unwrap();
    let (intensity, axis) = ([1.0, 2.0, 4.0], [0.0, -1.0, 0.0]);
    let irradiance = [0.5, 0.25, 2.0];
    let (one_minus_cos_inner, one_minus_cos_outer) = (0.1, 0.25);
    let position = [0.1, 20.0, 0.2];
    let spot = DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity };
    let point = DeltaLight::Point { position, intensity };
    let distant = DeltaLight::Distant { direction: [0.0, 1.0, 0.0], irradiance };
    let p = V8::splat(Vec3::from([0.0, 0.5, 0.0]));
    // a third of the chance is each one's, the rest goes by irradiance, which for the spot is that of a mean over its cone
    let far = 2.75;
    for (near, irradiance) in [(point, 7.0), (spot, 7.0 * 0.35 / 0.5)].map(|(near, sum)| (near, sum / 19.5_f64.powi(2)))
    {
        scene.delta_lights = vec![near, distant];
        let lights = Lights::unhit(&scene);
        let choosers = Choosers::new(&lights, 1.0).unwrap();
        let chooser = choosers.by(&lights, ChoiceBy::Auto).unwrap();
        let shares = chooser.pmf(p, V8::lit([0.0, 1.0, 0.0]), None, |pmf| [0, 1].map(|light| pmf(light).lane_f64(3)));
        let truth = (1.0 + far / (far + irradiance)) / 3.0;
        assert!((shares[1] - truth).abs() < 2e-3, "{shares:?}, not {truth}");
        assert!((shares[0] + shares[1] - 1.0).abs() < 1e-6, "{shares:?}");
    }
}

/// A hundred and sixty lights that differ by direction, each turned in its own way: lamps of IES files and of images, panels with a spread,
/// and spots and panels with profiles.
fn directed_and_spread() -> Scene {
    let folder = Folder::new();
    folder.ies("narrow.ies", "0 5 10", "0", "9 1 0");
    folder.ies("wide.ies", "0 60 90", "0", "1 2 3");
    folder.ies("up.ies", "90 120 180", "0", "1 2 3");
    folder.picture("around.exr", [4, 4], |x, y| if (x + y).is_multiple_of(2) { [1.0, 0.0, 2.0] } else { [0.0; 3] });
    let corners = "\"point3 P\" [0 0 0 .3 0 0 0 .2 0 .3 .2 0]";
    let area = "AreaLightSource \"diffuse\"";
    let quad = format!("Shape \"bilinearmesh\" {corners}");
    let kinds = [
        "LightSource \"goniometric\" \"string filename\" \"narrow.ies\"".to_owned(),
        "LightSource \"goniometric\" \"string filename\" \"wide.ies\"".to_owned(),
        "LightSource \"goniometric\" \"string filename\" \"up.ies\"".to_owned(),
        "LightSource \"goniometric\" \"string filename\" \"around.exr\"".to_owned(),
        format!("{area} \"float spread\" ANGLE {quad}"),
        format!("{area} \"float spread\" ANGLE Shape \"trianglemesh\" \"integer indices\" [0 1 2 1 3 2] {corners}"),
        "LightSource \"spot\" \"float coneangle\" ANGLE \"float conedeltaangle\" 2 \"string profile\" \"wide.ies\""
            .to_owned(),
        format!("{area} \"string profile\" \"narrow.ies\" {quad}"),
        format!("{area} \"string profile\" \"up.ies\" \"bool twosided\" true {quad}"),
        "LightSource \"spot\" \"float coneangle\" ANGLE \"float conedeltaangle\" 2 \"string profile\" \"narrow.ies\""
            .to_owned(),
    ];
    let mut text = "Camera \"perspective\"\nWorldBegin\n".to_owned();
    for i in 0..160 {
        let [x, y, z] = [37, 61, 89].map(|k| i * k % 101).map(|k| 0.02 * f64::from(k) - 1.0);
        let light = kinds[i as usize % kinds.len()].replace("ANGLE", &(5 + i).to_string());
        text += &format!("AttributeBegin Translate {x} {y} {z} Rotate {} {y} {z} {x} {light} AttributeEnd\n", i * 47);
    }
    folder.read(&text)
}

/// None of them is lost: where a sample of a light contributes, its pmf is positive, and the pdf of its direction is, bit for bit, that with which
/// it was drawn.
#[test]
fn directed_and_spread_lights_are_never_lost() {
    let scene = directed_and_spread();
    let lights = Lights::new(&scene, None);
    let choosers = Choosers::new(&lights, 1.0).unwrap();
    let chooser = choosers.by(&lights, ChoiceBy::Auto).unwrap();
    let (areas, all) = (scene.shapes.len() as u32, lights.len() as u32);
    assert!(areas == 80 && all == 176, "{areas} and {all}");
    let mut found = [0_u32; 2];
    for number in 0..cases(300, 10_000) {
        let lanes = u32x8::from_fn(|k| number * 8 + k as u32);
        let pairs: [Vec2<X8>; 4] =
            core::array::from_fn(|dimension| Independent::new(9).pair(u32x8::splat(0), lanes, dimension as u32));
        let centered = |u: X8| u * X8::lit(4.0) - X8::lit(2.0);
        let p = V8::new(centered(pairs[0].x), centered(pairs[0].y), centered(pairs[1].x));
        let normal = V8::new(centered(pairs[1].y), centered(pairs[2].x), centered(pairs[2].y)).normalize();
        let pmf = |light| chooser.pmf(p, normal, None, |pmf| pmf(light));
        for light in (0..all).filter(|light| (light + number).is_multiple_of(3)) {
            let chosen = lights.chosen(u32x8::splat(light));
            let Drawn { to: drawn, radiance, primitives } =
                lights.sample(&chosen, Measure::SolidAngle, p, normal, pairs[3]);
            let bright = (radiance.x + radiance.y + radiance.z).gt(X8::lit(0.0));
            let lit = drawn.emits & bright & drawn.pdf.gt(X8::lit(0.0)) & drawn.direction.dot(normal).gt(X8::lit(0.0));
            let pmf = pmf(light);
            let index = primitives.lane(0).shape().unwrap();
            let pdf = |shape: &scene::Shape| lights.shape_pdf(index, &shape.geometry, p, drawn.direction) * pmf;
            let pdf = scene.shapes.get(index).map(pdf);
            for lane in (0..8).filter(|&lane| lit.lane(lane)) {
                let own = (drawn.pdf * pmf).lane(lane);
                assert!(pdf.is_none_or(|pdf| pdf.lane(lane).to_bits() == own.to_bits()), "{pdf:?} and {own}");
                let at = [p, normal].map(|v| <[f32; 3]>::from(v.lane(lane)));
                assert!(pmf.lane(lane) > 0.0, "light {light} is lost at {at:?}");
                found[usize::from(light >= areas)] += 1;
            }
        }
    }
    println!("samples of panels and of other lights: {found:?}");
    assert!(found.iter().all(|&n| n > cases(1000, 33_000)), "{found:?}");
}
