//! Coats over metals and over diffuse surfaces, against random walks between both layers in double precision, which share no code with the
//! renderer: light that comes from the view is followed until it leaves the coat, one random choice at each microsurface.

use crate::kit::world;
use crate::random::Random;
use etendue_oracle::direct::fresnel;
use etendue_oracle::{V3, along, cross, dot, unit};
use etendue_render::film::compare::LIMIT;
use etendue_render::{Sampler, Settings, Technique};
use etendue_scene::list::PBRT;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// What is below a coat.
#[derive(Clone, Copy, Debug)]
enum Base {
    /// A metal of a roughness.
    Metal(f64),
    Diffuse(f64),
}

/// Index of refraction of the metal per channel.
const METAL: [[f64; 2]; 3] = [[0.2, 3.9], [0.6, 2.3], [1.4, 1.8]];

#[derive(Clone, Copy, Debug)]
struct Layers {
    base: Base,
    /// Roughness of the coat along u and across, and its index of refraction.
    above: f64,
    across: f64,
    eta: f64,
    /// Angle of the view to the normal in degrees.
    view: f64,
}

/// A light: all directions, or a cone of this half angle about a direction at an angle to the normal, turned by another, in degrees.
const LIGHTS: [Option<[f64; 3]>; 4] =
    [None, Some([15.0, 0.0, 180.0]), Some([15.0, 60.0, 180.0]), Some([15.0, 60.0, 70.0])];

fn at([angle, turn]: [f64; 2]) -> V3 {
    let [angle, turn] = [angle, turn].map(f64::to_radians);
    [angle.sin() * turn.cos(), angle.sin() * turn.sin(), angle.cos()]
}

fn lambda(w: V3, [a, b]: [f64; 2]) -> f64 {
    let square = ((a * w[0]).powi(2) + (b * w[1]).powi(2)) / (w[2] * w[2]);
    0.5 * ((1.0 + square).sqrt() - 1.0)
}

/// Where light that comes from a direction goes, by a normal of a GGX microsurface that is visible from there (Heitz 2018, a disk of which the
/// half that is away is compressed), and the part that is not masked: G₂/G₁ of the height-correlated Smith function.
fn scattered(w: V3, alpha: [f64; 2], random: &mut Random, to: impl FnOnce(V3) -> V3) -> (V3, f64) {
    let side = w[2].signum();
    if alpha == [0.0; 2] {
        return (to([0.0, 0.0, side]), 1.0);
    }
    let stretched = unit([alpha[0] * w[0], alpha[1] * w[1], w[2].abs()]);
    let across = unit(if stretched[2] < 0.9999 { cross([0.0, 0.0, 1.0], stretched) } else { [1.0, 0.0, 0.0] });
    let (radius, turn) = (random.unit().sqrt(), TAU * random.unit());
    let (x, lift) = (radius * turn.cos(), 0.5 * (1.0 + stretched[2]));
    let y = (1.0 - lift) * (1.0 - x * x).sqrt() + lift * radius * turn.sin();
    let up = (1.0 - x * x - y * y).max(0.0).sqrt();
    let m = along(along(across.map(|c| c * x), cross(stretched, across), y), stretched, up);
    let m = unit([alpha[0] * m[0], alpha[1] * m[1], m[2].max(1e-12)]);
    let o = to([m[0], m[1], m[2] * side]);
    let own = 1.0 + lambda(w, alpha);
    (o, own / (own + lambda(o, alpha)))
}

fn reflected(w: V3, m: V3) -> V3 {
    along(m.map(|x| x * 2.0 * dot(w, m)), w, -1.0)
}

/// Where light that comes from `w` goes behind the microfacet of this normal, in a medium of a relative index.
fn refracted(w: V3, m: V3, eta: f64) -> V3 {
    let cos = dot(w, m);
    let below = (1.0 - (1.0 - cos * cos) / (eta * eta)).max(0.0).sqrt();
    along(m.map(|x| x * (cos / eta - below)), w, -1.0 / eta)
}

/// Follows light, and returns the direction in which it leaves and its part per channel, if it does.
fn follow(layers: &Layers, random: &mut Random) -> Option<(V3, V3)> {
    let Layers { base, above, across, eta, view } = *layers;
    // the direction where light comes from, as seen from the interface
    let (mut w, mut part, mut index) = (at([view, 0.0]), [1.0; 3], eta);
    for _ in 0..200 {
        // one of both by Fresnel's formula
        let (chance, mut passes) = (random.unit(), false);
        let (o, weight) = scattered(w, [above, across], random, |m| {
            passes = chance >= fresnel(dot(w, m), index, 0.0);
            if passes { refracted(w, m, index) } else { reflected(w, m) }
        });
        if (o[2] * w[2] < 0.0) != passes {
            return None;
        }
        part = part.map(|x| x * weight);
        if o[2] > 0.0 {
            return Some((o, part));
        }
        // down to the base, where it comes from above
        let arrives = o.map(|x| -x);
        let up = match base {
            Base::Diffuse(albedo) => {
                part = part.map(|x| x * albedo);
                let [u, v] = [random.unit(), random.unit()];
                [u.sqrt() * (TAU * v).cos(), u.sqrt() * (TAU * v).sin(), (1.0 - u).sqrt()]
            }
            Base::Metal(alpha) => {
                let mut cos = 0.0;
                let (o, weight) = scattered(arrives, [alpha; 2], random, |m| {
                    cos = dot(arrives, m);
                    reflected(arrives, m)
                });
                part = [0, 1, 2].map(|k| part[k] * weight * fresnel(cos, METAL[k][0] / eta, METAL[k][1] / eta));
                o
            }
        };
        if up[2] <= 0.0 {
            return None;
        }
        // what is left ends at random
        let most = 5.0 * part.iter().fold(0.0, |most: f64, x| most.max(*x));
        if most < 1.0 {
            if random.unit() >= most {
                return None;
            }
            part = part.map(|x| x / most);
        }
        (w, index) = (up.map(|x| -x), 1.0 / eta);
    }
    None
}

/// The part of light from the view that goes to each light, which is the radiance of the surface under it, with standard errors.
fn walked(layers: &Layers, count: usize) -> [[V3; 2]; LIGHTS.len()] {
    const BATCHES: usize = 32;
    let batch = |seed: usize| {
        let (mut random, mut sums) = (Random::new(seed as u64), [[0.0; 3]; LIGHTS.len()]);
        for (o, part) in (0..count / BATCHES).filter_map(|_| follow(layers, &mut random)) {
            for (sum, light) in sums.iter_mut().zip(LIGHTS) {
                if light.is_none_or(|[half, angle, turn]| dot(o, at([angle, turn])) > half.to_radians().cos()) {
                    *sum = along(*sum, part, 1.0);
                }
            }
        }
        sums.map(|sum| sum.map(|x| x / (count / BATCHES) as f64))
    };
    let batches: Vec<_> = (0..BATCHES).into_par_iter().map(batch).collect();
    std::array::from_fn(|light| {
        let mean = [0, 1, 2].map(|k| batches.iter().map(|sums| sums[light][k]).sum::<f64>() / BATCHES as f64);
        let spread = |k: usize| batches.iter().map(|sums| (sums[light][k] - mean[k]).powi(2)).sum::<f64>();
        [mean, [0, 1, 2].map(|k| (spread(k) / (BATCHES * (BATCHES - 1)) as f64).sqrt())]
    })
}

/// A surface of these layers under a light of radiance 1.
fn scene(layers: &Layers, light: Option<[f64; 3]>) -> String {
    let Layers { base, above, across, eta, view } = *layers;
    let list = |k: usize| METAL.map(|x| x[k].to_string()).join(" ");
    let material = match base {
        Base::Metal(alpha) => format!(
            "\"coatedconductor\" \"rgb conductor.eta\" [{}] \"rgb conductor.k\" [{}] \"float conductor.roughness\" {alpha} \
             \"float interface.roughness\" {above} \"float interface.eta\" {eta}",
            list(0),
            list(1)
        ),
        Base::Diffuse(albedo) => format!(
            "\"coateddiffuse\" \"rgb reflectance\" [{albedo} {albedo} {albedo}] \"float uroughness\" {above} \"float vroughness\" {across} \"float eta\" {eta}"
        ),
    };
    let light = light.map_or("LightSource \"infinite\"".to_owned(), |[half, angle, turn]| {
        let [x, y, z] = at([angle, turn]).map(|x| 100.0 * x);
        let radius = 100.0 * half.to_radians().sin();
        format!(
            "AttributeBegin AreaLightSource \"diffuse\" Translate {x} {y} {z} Shape \"sphere\" \"float radius\" {radius} \
             AttributeEnd"
        )
    });
    let [x, y, z] = at([view, 0.0]);
    format!(
        "LookAt {x} {y} {z} 0 0 0 .1 .7 .3 Camera \"perspective\" \"float fov\" 1e-4\nWorldBegin\n{light}\n\
         Material {material} \"bool remaproughness\" false\n\
         Shape \"bilinearmesh\" \"point3 P\" [-9 -9 0  9 -9 0  -9 9 0  9 9 0]\n"
    )
}

/// Compares a surface with walks of so many paths and images of so many samples: for each light a line for each technique, and the greatest
/// difference beyond the noise, as a fraction.
fn compare(layers: &Layers, paths: usize, spp: u32, techniques: &[Technique]) -> Vec<(Vec<String>, f64)> {
    let of_light = |(light, [right, noise]): (Option<[f64; 3]>, [V3; 2])| {
        let (world, mut lines, mut worst) = (world(&scene(layers, light)), Vec::new(), 0.0_f64);
        for &technique in techniques {
            let sampler = Sampler::Independent;
            let settings = Settings { width: 1, height: 1, spp, technique, sampler, seed: 5, ..Settings::DEFAULT };
            let pixel = world.render(&settings, &|_| ()).0.pixels[0];
            let mut line = format!("{layers:?} | {light:?} | {technique:?} |");
            for k in 0..3 {
                let (seen, error) = (f64::from(pixel.mean[k]), f64::from(pixel.variance[k]).sqrt());
                let [off, error] = [seen - right[k], noise[k].hypot(error)].map(|x| x / right[k]);
                line += &format!(" {:.5} {:+.2}% ± {:.2}", right[k], 100.0 * off, 100.0 * error);
                worst = worst.max(off.abs() - LIMIT * error);
            }
            lines.push(line);
        }
        (lines, worst)
    };
    LIGHTS.into_iter().zip(walked(layers, paths)).map(of_light).collect()
}

const SOME: [Technique; 5] =
    [Technique::Auto, Technique::Analytic, Technique::SolidAngle, Technique::Brdf, Technique::MisPower];

/// Coats of a few kinds agree with walks to 1 %, by every kind of technique.
#[test]
fn coated_surfaces_are_what_random_walks_say() {
    let metal = |alpha, above, eta, view| Layers { base: Base::Metal(alpha), above, across: above, eta, view };
    for layers in [
        metal(0.3, 0.0, 1.5, 30.0),
        metal(0.0, 0.3, 1.5, 60.0),
        metal(0.2, 0.1, 2.0, 60.0),
        metal(0.6, 0.6, 1.5, 30.0),
        metal(1.0, 0.05, 1.1, 75.0),
        Layers { base: Base::Diffuse(0.8), above: 0.6, across: 0.6, eta: 1.5, view: 60.0 },
        Layers { base: Base::Diffuse(0.5), above: 1.0, across: 1.0, eta: 1.1, view: 80.0 },
    ] {
        for (lines, worst) in compare(&layers, 1 << 21, 1 << 15, &SOME) {
            lines.iter().for_each(|line| println!("{line}"));
            assert!(worst < 0.01, "{worst}: {lines:#?}");
        }
    }
}

/// What passes a coat that is rougher in one direction than in the other is that of a mean: how far that is off, the list says.
#[test]
fn coats_that_differ_by_direction_pass_what_their_mean_does() {
    let mut worst = 0.0_f64;
    for (above, across, view) in [(0.1, 0.4, 10.0), (0.1, 0.4, 60.0), (0.4, 0.1, 60.0)] {
        let layers = Layers { base: Base::Diffuse(0.8), above, across, eta: 1.5, view };
        for (lines, most) in compare(&layers, 1 << 21, 1 << 15, &[Technique::Auto]) {
            lines.iter().for_each(|line| println!("{line}"));
            worst = worst.max(most);
        }
    }
    let listed = PBRT.entry("Material", "coateddiffuse").unwrap().parameter("uroughness").unwrap().note;
    println!("at most {worst}, listed as {listed:?}");
    assert!(worst < 0.02 && listed.contains("2 % off"), "{worst}: {listed}");
}
