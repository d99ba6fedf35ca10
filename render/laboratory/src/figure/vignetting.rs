//! The figure of vignetting: the lens of the scene `defocus` in a barrel, its image, and the lens as seen from three points of the film.

use super::sheet::Svg;
use super::studio::{Finding, Studio};
use etendue_render::camera::{Barrel, Pupil};
use etendue_render::camera::{Camera, ThinLens};
use etendue_render::film::Film;
use etendue_render::{Sampler, Settings, Technique, World, image, scene};
use std::error::Error;

/// Size of the image in pixels; views of the lens have the same height.
const IMAGE: [u32; 2] = [288, 192];
const VIEW: u32 = IMAGE[1];
/// Half side of a view, in radii of the lens.
const EXTENT: f64 = 1.1;
const WHITE: f32 = 4.0;
/// Distance of the front rim from the lens and its radius, in radii of the lens.
const BARREL: [f64; 2] = [2.0, 1.15];
/// Points of the film in pixels of the image: the third sphere, on which the scene's camera is focused, the first lamp, and the lower
/// left corner.
const POINTS: [(&str, [f64; 2]); 3] =
    [("third sphere", [118.1, 132.7]), ("lamp", [83.8, 43.7]), ("corner", [9.0, 183.0])];
/// Distance of the lamp along the axis, in metres.
const LAMP: f64 = 1.381;

fn panel(title: &str, film: &Film) -> Svg {
    let pixels: Vec<_> = film.pixels.iter().map(|p| image::tone_map(p.mean)).collect();
    Svg::image(title, [film.width, film.height], &pixels, f64::from(film.width))
}

/// Draws a cross with an open centre around a point.
fn mark(picture: &mut Film, [x, y]: [f64; 2]) {
    for (dx, dy) in (3_i32..8).flat_map(|k| [(k, 0), (-k, 0), (0, k), (0, -k)]) {
        let (x, y) = (x as i32 + dx, y as i32 + dy);
        if (0..picture.width as i32).contains(&x) && (0..picture.height as i32).contains(&y) {
            picture.pixels[(y * picture.width as i32 + x) as usize].mean = [WHITE; 3];
        }
    }
}

impl Studio<'_> {
    pub(super) fn vignetting(&self) -> Result<Finding, Box<dyn Error>> {
        let mut scene = etendue_scene::load("defocus")?;
        let world = World::new(&scene)?;
        let own = scene.camera.lens.ok_or("the scene has no lens")?;
        let seen = |camera: &Camera, [width, height]: [u32; 2], sampler, spp| {
            let (technique, seed) = (Technique::SolidAngle, self.seed);
            let settings = Settings { width, height, spp, technique, sampler, seed, depth: 1, ..Settings::DEFAULT };
            world.view_through(camera, &settings).image(&|_| ()).0
        };
        let [width, height] = IMAGE;
        let (mut rows, mut headline) = (Vec::new(), Vec::new());
        for focus in [own.focus, LAMP] {
            let lens = scene::Lens { focus, ..own };
            scene.camera.lens = Some(lens);
            let barrel = Barrel::new(&scene.camera, &lens, BARREL.map(|x| x * lens.radius), width, height);
            let thin = ThinLens::new(&scene.camera, &lens, width, height);
            let mut picture = seen(&Camera::Barrel(thin, barrel), IMAGE, Sampler::Sobol4d, 128);
            let mut views = Vec::new();
            for (name, film) in POINTS {
                let camera = Camera::Pupil(Pupil::new(thin, Some(barrel), film, VIEW, EXTENT));
                views.push(panel(&format!("from the {name}"), &seen(&camera, [VIEW; 2], Sampler::Sobol, 16)));
                mark(&mut picture, film);
                let open = 100.0 * barrel.open_part(film[0], film[1]);
                headline.push(format!("focused at {focus} m, from the {name}: {open:.1} % of the lens is open"));
            }
            views.insert(0, panel(&format!("focused at {focus} m"), &picture));
            rows.push(Svg::row(views));
        }
        Ok(Finding { svg: Svg::column(rows).captioned(&headline), headline })
    }
}
