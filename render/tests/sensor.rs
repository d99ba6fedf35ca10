//! Compares irradiance and power of the film under uniform radiance with the closed form.

use crate::kit::{film, read};
use etendue_oracle::facing_disk;
use etendue_oracle::tier::cases;
use etendue_render::film::compare::{Comparison, LIMIT, differs};
use etendue_render::film::image::Picture;
use etendue_render::{Sampler, Sensor, Settings, Technique, World, scene};
use std::f64::consts::PI;

/// A camera inside a sphere of radiance 1. With fov 2·atan(½) and a 4:3 film of 50 mm diagonal, the film is 40 × 30 mm, 30 mm behind the
/// lens.
fn inside(radius: f64, scale: f64) -> scene::Scene {
    let fov = 2.0 * 0.5_f64.atan().to_degrees();
    let text = format!(
        "Scale {s} {s} {s} LookAt 1 2 3 3 2 1 0 1 0\n\
         Film \"rgb\" \"float diagonal\" 50 \"integer xresolution\" 40 \"integer yresolution\" 30\n\
         Camera \"perspective\" \"float fov\" {fov} \"float lensradius\" {radius} \"float focaldistance\" 0.7\n\
         WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n\
         AreaLightSource \"diffuse\" \"rgb L\" [1 2 4] \"bool twosided\" true Shape \"sphere\" \"float radius\" 1000",
        s = 1.0 / scale
    );
    read(&text)
}

const SIZE: [u32; 2] = [40, 30];
const DISTANCE: f64 = 0.03;

fn render(scene: &scene::Scene, sensor: Sensor, sampler: Sampler, spp: u32) -> Picture {
    let [width, height] = SIZE;
    let settings =
        Settings { width, height, spp, technique: Technique::SolidAngle, sampler, seed: 11, ..Settings::DEFAULT };
    Picture::from(&film(&World::new(scene).unwrap().with_sensor(sensor), &settings))
}

/// Mean irradiance of the pixel (x, y) for radiance 1, of a disk of radius k in units of its distance: π times the form factor.
fn expected(k: f64, x: usize, y: usize) -> f64 {
    // three Gauss points per dimension, as the field is smooth over a thirtieth of the film
    let node = [0.5 - 0.15_f64.sqrt(), 0.5, 0.5 + 0.15_f64.sqrt()];
    let weight = [5.0, 8.0, 5.0].map(|w| w / 18.0);
    let at = |i: usize, j: usize| {
        // millimetres from the middle, over 30 mm
        let a = [x as f64 + node[i] - 20.0, y as f64 + node[j] - 15.0].map(|mm| mm * 1e-3 / DISTANCE);
        weight[i] * weight[j] * PI * facing_disk(k, 1.0, a[0].hypot(a[1]))
    };
    (0..9).map(|n| at(n / 3, n % 3)).sum()
}

/// Checks every pixel, for lenses from f/500 to wider than their distance from the film.
#[test]
fn irradiance_of_a_uniform_field() {
    for (k, scale) in [(1e-3, 1.0), (0.05, 1.0), (0.5, 1.0), (0.5, 64.0), (1.0, 1.0), (3.0, 1.0)] {
        let scene = inside(k * DISTANCE, scale);
        for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d]
            .into_iter()
            .step_by(cases(3, 1))
        {
            let image = render(&scene, Sensor::Irradiance, sampler, 256);
            let truth = |i: usize| [1.0, 2.0, 4.0].map(|l| l * expected(k, i % 40, i / 40));
            let mut squares = 0.0;
            let mut relative = [0.0_f64; 2];
            for (i, p) in image.radiance.iter().enumerate() {
                let (t, v) = (truth(i), image.variance.as_ref().unwrap()[i]);
                assert!((0..3).all(|c| (f64::from(p[c]) / f64::from(p[0]) - t[c] / t[0]).abs() < 1e-5));
                let error = f64::from(p[0]) - t[0];
                relative[0] += error / t[0] / image.radiance.len() as f64;
                relative[1] += f64::from(v[0]) / (t[0] * image.radiance.len() as f64).powi(2);
                squares += error * error / t[0] / t[0];
            }
            // sums in single precision are accurate to 1e−6
            let bound = LIMIT * relative[1].sqrt() + 1e-6;
            println!(
                "{sampler:?} k = {k}: mean {:+.2e} ± {:.1e}, rms {:.1e}",
                relative[0],
                relative[1].sqrt(),
                (squares / 1200.0).sqrt()
            );
            assert!(relative[0].abs() < bound, "{sampler:?}, k = {k}: {:e} ± {:e}", relative[0], relative[1].sqrt());
            assert!(relative[1].sqrt() < 5e-3, "the test would not detect an error of two per cent");
            if k >= 0.5 {
                let reference = Picture {
                    radiance: (0..1200).map(|i| truth(i).map(|x| x as f32)).collect(),
                    variance: None,
                    second: None,
                    ..image.clone()
                };
                let p = Comparison::new(&reference, &image, 0.0).unwrap().predicted.unwrap();
                assert!(!differs(p.z_mse), "{sampler:?}, k = {k}: {p:?}");
            }
        }
    }
}

#[test]
fn power_is_irradiance_times_the_area_of_a_pixel() {
    let scene = inside(0.015, 1.0);
    let [irradiance, power] =
        [Sensor::Irradiance, Sensor::Power].map(|sensor| render(&scene, sensor, Sampler::Sobol4d, 64));
    for (e, w) in irradiance.radiance.iter().zip(&power.radiance) {
        // a pixel is a square of 1 mm
        assert!((0..3).all(|c| (f64::from(w[c]) / (1e-6 * f64::from(e[c])) - 1.0).abs() < 1e-5), "{e:?} {w:?}");
    }
    for (e, w) in irradiance.variance.unwrap().iter().zip(&power.variance.unwrap()) {
        assert!((0..3).all(|c| (f64::from(w[c]) / (1e-12 * f64::from(e[c])) - 1.0).abs() < 1e-3), "{e:?} {w:?}");
    }
    // radiance does not fall off towards the corners
    let radiance = render(&scene, Sensor::Radiance, Sampler::Independent, 16);
    assert!(radiance.radiance.iter().all(|p| *p == [1.0, 2.0, 4.0]));
    let corner = f64::from(irradiance.radiance[0][0] / irradiance.radiance[15 * 40 + 20][0]);
    let truth = expected(0.5, 0, 0) / expected(0.5, 20, 15);
    assert!((corner / truth - 1.0).abs() < 0.05 && truth < 0.5, "{corner} {truth}");
}

/// The exposure on the axis, which is 0 for a pinhole.
#[test]
fn the_measure_on_the_axis() {
    let world = |radius, sensor| World::new(&inside(radius, 1.0)).unwrap().with_sensor(sensor);
    let on_axis = |radius, sensor| world(radius, sensor).exposure(40, 30).unwrap().on_axis();
    assert!((on_axis(DISTANCE, Sensor::Irradiance) - PI / 2.0).abs() < 1e-12);
    assert!((on_axis(DISTANCE, Sensor::Power) - PI / 2.0 * 1e-6).abs() < 1e-18);
    assert!(world(DISTANCE, Sensor::Radiance).exposure(40, 30).is_none());
    // more pixels on the same film receive less power each
    let fine = world(DISTANCE, Sensor::Power).exposure(400, 300).unwrap().on_axis();
    assert!((fine - PI / 2.0 * 1e-8).abs() < 1e-20);
    let dark = render(&inside(0.0, 1.0), Sensor::Irradiance, Sampler::Independent, 4);
    assert!(dark.radiance.iter().all(|p| *p == [0.0; 3]));
}
