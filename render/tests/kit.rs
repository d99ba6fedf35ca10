//! What several tests need: temporary folders, scenes of which a pixel is a point, and the means of pixels and images.

use etendue_oracle::{V3, along};
use etendue_render::film::Film;
use etendue_render::film::compare::LIMIT;
use etendue_render::scene::Scene;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// A temporary folder, removed when the test ends.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("etendue-render-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    pub(crate) fn root(&self) -> &Path {
        &self.0
    }
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
    /// Writes a file, and the folders above it.
    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }
    /// Writes a picture in the RGB channels of an EXR file.
    pub(crate) fn picture(
        &self,
        name: &str,
        [width, height]: [usize; 2],
        texel: impl Fn(usize, usize) -> [f32; 3] + Sync,
    ) {
        exr::prelude::write_rgb_file(self.path(name), width, height, |x, y| texel(x, y).into()).unwrap();
    }
    /// Writes an IES file.
    pub(crate) fn ies(&self, name: &str, vertical: &str, horizontal: &str, values: &str) {
        let count = |list: &str| list.split_whitespace().count();
        let sizes = format!("{} {}", count(vertical), count(horizontal));
        self.write(name, format!("TILT=NONE\n1 -1 1 {sizes} 1 2 0 0 0\n1 1 9\n{vertical}\n{horizontal}\n{values}\n"));
    }
    /// A scene whose files are in this folder.
    pub(crate) fn read(&self, text: &str) -> Scene {
        read_in(&self.0, text)
    }
    pub(crate) fn world(&self, text: &str) -> World {
        World::new(&self.read(text)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The rows of a table of faults: texts of any number of lines, each followed by a line `=> ` with what is said of it.
pub(crate) fn faults(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let mut rest = table;
    std::iter::from_fn(move || {
        let (text, after) = rest.split_once("\n=> ")?;
        let (said, more) = after.split_once('\n').unwrap();
        rest = more;
        Some((text, said))
    })
}

fn read_in(folder: &Path, text: &str) -> Scene {
    etendue_scene::parse(text, "test.pbrt", folder).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A scene without files.
pub(crate) fn read(text: &str) -> Scene {
    read_in(Path::new("no such directory"), text)
}

pub(crate) fn world(text: &str) -> World {
    World::new(&read(text)).unwrap()
}

/// A built-in scene.
pub(crate) fn builtin(name: &str) -> World {
    World::new(&etendue_scene::load(name).unwrap()).unwrap()
}

/// A camera that sees the origin from a place, with a view so narrow that a pixel is a point, and what else is in the scene.
pub(crate) fn narrow(camera: &str, scene: &str) -> String {
    format!("LookAt {camera} 0 0 0  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n{scene}")
}

/// The coordinates of points, as files list them.
pub(crate) fn list(points: &[V3]) -> String {
    points.as_flattened().iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// The parallelogram of a corner and two edges, with its normal along their cross product.
pub(crate) fn quad(corner: V3, [u, v]: [V3; 2]) -> String {
    let [a, b] = [u, v].map(|edge| along(corner, edge, 1.0));
    format!("Shape \"bilinearmesh\" \"point3 P\" [{}]\n", list(&[corner, a, b, along(a, v, 1.0)]))
}

pub(crate) const ALBEDO: V3 = [0.8, 0.5, 0.2];
pub(crate) const MATT: &str = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n";
/// The plane y = 0.
pub(crate) const PLANE: &str = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n";
pub(crate) const BLACK: &str = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n";

/// A square image of independent samples.
pub(crate) fn settings(technique: Technique, side: u32, spp: u32) -> Settings {
    Settings { width: side, height: side, spp, technique, sampler: Sampler::Independent, seed: 3, ..Settings::DEFAULT }
}

pub(crate) fn film(world: &World, settings: &Settings) -> Film {
    world.render(settings, &|_| ()).0
}

/// Mean and standard error of the only pixel.
pub(crate) fn pixel(world: &World, technique: Technique, spp: u32) -> [V3; 2] {
    let pixel = film(world, &settings(technique, 1, spp)).pixels[0];
    [pixel.mean.map(f64::from), pixel.variance.map(|v| f64::from(v).sqrt())]
}

/// Every technique gives exactly this irradiance times albedo/π, without noise.
pub(crate) fn exactly(world: &World, irradiance: V3) {
    for technique in Technique::ALL {
        let [mean, error] = pixel(world, technique, 24);
        for (k, albedo) in ALBEDO.into_iter().enumerate() {
            let truth = irradiance[k] * albedo / PI;
            assert!((mean[k] - truth).abs() <= 5e-5 * truth, "{technique:?}: {mean:?}, {truth} in channel {k}");
            assert!(error[k] <= 1e-4 * truth, "{technique:?}: {error:?} of {truth}");
        }
    }
}

/// Every technique gives this irradiance times albedo/π, but for its noise, which is small, and a part of it.
pub(crate) fn nearly(world: &World, irradiance: V3, tolerance: f64, spp: u32, what: &str) {
    for technique in Technique::ALL {
        let [mean, error] = pixel(world, technique, spp);
        for (k, albedo) in ALBEDO.into_iter().enumerate() {
            let (truth, error) = (irradiance[k] * albedo / PI, error[k]);
            let of = || format!("{what}, {technique:?}, channel {k}: {} ± {error}, not {truth}", mean[k]);
            // by chance, few rays find a small light: the variance is that of too few
            let aims = !technique.finds_lights();
            if aims || error > 0.0 && error < 0.1 * truth {
                assert!((mean[k] - truth).abs() <= LIMIT * error + tolerance * truth, "{}", of());
            }
            assert!(!aims || truth == 0.0 || error < 0.3 * truth, "{}", of());
        }
    }
}

/// The sum of the green channel of all pixels, and its variance.
pub(crate) fn sum(film: &Film) -> [f64; 2] {
    let of = |of: &dyn Fn(usize) -> f32| (0..film.pixels.len()).map(|i| f64::from(of(i))).sum();
    [of(&|i| film.pixels[i].mean[1]), of(&|i| film.pixels[i].variance[1])]
}
