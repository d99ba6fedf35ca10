//! Spot and area lights with profiles, against sums in double precision.

use etendue_render::{Sampler, Settings, Technique, World};
use exr::prelude::write_rgb_file;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

const LIMIT: f64 = 4.0;

/// A folder with profiles that is removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("etendue-profiles-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    fn ies(&self, name: &str, kind: u32, vertical: &str, horizontal: &str, values: &str) {
        let count = |list: &str| list.split_whitespace().count();
        let (rows, columns) = (count(vertical), count(horizontal));
        let text =
            format!("TILT=NONE\n1 -1 1 {rows} {columns} {kind} 2 0 0 0\n1 1 9\n{vertical}\n{horizontal}\n{values}\n");
        std::fs::write(self.0.join(name), text).unwrap();
    }
    /// A plane of albedo 0.8, of which the camera sees the origin, from beside.
    fn world(&self, lights: &str) -> World {
        let text = format!(
            "LookAt 1 .3 2 0 0 0  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n\
             Material \"diffuse\" \"rgb reflectance\" [.8 .8 .8]\n\
             Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n\
             Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n{lights}"
        );
        let path: &Path = &self.0;
        World::new(&etendue_scene::parse(&text, "test.pbrt", path).unwrap_or_else(|e| panic!("{e}\n{text}"))).unwrap()
    }
}
impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

/// Mean of the pixel in the red channel, and its standard error.
fn pixel(world: &World, technique: Technique, spp: u32) -> (f64, f64) {
    let settings =
        Settings { width: 1, height: 1, spp, technique, sampler: Sampler::Independent, seed: 3, ..Settings::DEFAULT };
    let pixel = world.render(&settings, &|_| ()).0.pixels[0];
    (f64::from(pixel.mean[0]), f64::from(pixel.variance[0]).sqrt())
}

/// Every technique gives this irradiance but for its noise; those that sample no lights, by rays that hit them.
fn nearly(world: &World, irradiance: f64, what: &str) {
    for technique in Technique::ALL {
        let (mean, error) = pixel(world, technique, 1 << 14);
        let truth = irradiance * 0.8 / PI;
        let z = (mean - truth) / (error + 2e-5 * truth);
        assert!(z.abs() < LIMIT, "{what}, {technique:?}: {mean} ± {error}, not {truth}");
        assert!(error < 0.1 * truth, "{what}, {technique:?}: {mean} ± {error}");
    }
}

/// A spot light that is aimed obliquely at the plane, and not at the origin: its profile is turned along with it.
#[test]
fn spots_with_profiles_over_a_plane() {
    let folder = Folder::new("spots");
    // 90 cd at the nadir, 30 cd at 60 degrees and azimuth 0, nothing there at 180
    folder.ies("c.ies", 1, "0 60", "0 180", "90 30 90 0");
    // along the photometric horizontal of type A, brighter above than below
    folder.ies("a.ies", 3, "-60 0 60", "-90 0 90", "30 90 60 30 90 60 30 90 60");
    let exactly = |light: &str, irradiance: f64| {
        for technique in Technique::ALL {
            let (mean, error) = pixel(&folder.world(light), technique, 24);
            let truth = irradiance * 0.8 / PI;
            assert!(
                (mean - truth).abs() <= 5e-5 * truth && error <= 1e-4 * truth,
                "{light}: {mean} ± {error}, not {truth}"
            );
        }
    };
    // the spot is at (0, 2, 0) and aimed to the side of +x, by 20 degrees; the origin is on the other side of the axis, towards −x
    let angle = 20.0_f64;
    let t = (angle.to_radians().cos() - 30_f64.to_radians().cos())
        / (10_f64.to_radians().cos() - 30_f64.to_radians().cos());
    let falloff = t * t * (3.0 - 2.0 * t);
    let spot = |name: &str, more: &str| {
        let x = 2.0 * angle.to_radians().tan();
        format!(
            "LightSource \"spot\" \"point3 from\" [0 2 0] \"point3 to\" [{x} 0 0] \"float coneangle\" 30 \
             \"float conedeltaangle\" 20 \"string profile\" \"{name}\" {more}"
        )
    };
    let at = |far: f64| falloff / 4.0 * (90.0 + (far - 90.0) * angle / 60.0);
    exactly(&spot("c.ies", ""), at(0.0));
    exactly(&spot("c.ies", "\"float scale\" 3 \"rgb I\" [2 1 1]"), 6.0 * at(0.0));
    // turned about the axis by half a turn, with +x of the light at −x of the world
    let turned = |light: &str| format!("AttributeBegin Rotate 180 0 1 0 {light} AttributeEnd");
    let x = -2.0 * angle.to_radians().tan();
    let back = turned(&spot("c.ies", "")).replace(&format!("[{} 0 0]", -x), &format!("[{x} 0 0]"));
    exactly(&back, at(30.0));
    // of type A, the horizontal is along the axis, and the zenith in the plane of the axis and of +y: the origin is below
    exactly(&spot("a.ies", ""), falloff / 4.0 * (90.0 - 60.0 * angle / 60.0));
    // outside of the cone
    exactly(
        &spot("c.ies", "").replace("coneangle\" 30", "coneangle\" 15").replace("deltaangle\" 20", "deltaangle\" 0.001"),
        0.0,
    );
    // among other lights, one of which has an area
    let ball =
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Translate 0 4 0 Shape \"sphere\" AttributeEnd";
    nearly(&folder.world(&format!("{}\n{ball}", spot("c.ies", ""))), at(0.0) + 5.0 * PI / 16.0, "a spot and a ball");
}

/// The power of a spot light is what its profile and its falloff emit together.
#[test]
fn spots_with_profiles_have_the_power_that_they_are_given() {
    let folder = Folder::new("power");
    folder.ies("c.ies", 1, "0 60", "0", "1 0");
    let light = "LightSource \"spot\" \"point3 from\" [0 2 0] \"point3 to\" [0 0 0] \"float coneangle\" 40 \
                 \"float conedeltaangle\" 40 \"string profile\" \"c.ies\" \"float power\" 50 \"rgb I\" [7 7 7]";
    let n = 100_000;
    let most = 40_f64.to_radians();
    let flux: f64 = (0..n)
        .map(|i| {
            let theta = (f64::from(i) + 0.5) / f64::from(n) * most;
            let t = (theta.cos() - most.cos()) / (1.0 - most.cos());
            2.0 * PI * theta.sin() * t * t * (3.0 - 2.0 * t) * (1.0 - theta.to_degrees() / 60.0) * most / f64::from(n)
        })
        .sum();
    let (mean, _) = pixel(&folder.world(light), Technique::SolidAngle, 24);
    let truth = 50.0 / flux / 4.0 * 0.8 / PI;
    assert!((mean / truth - 1.0).abs() < 5e-5, "{mean}, not {truth}");
}

/// Where a panel is, and how its luminaire lies: the intensity by the angle from the nadir, which is along the normal of the panel, and by
/// the turn from the photometric horizontal, which is at the panel's +x.
struct Panel<'a> {
    shape: &'a str,
    corner: [f64; 2],
    edges: [f64; 2],
    height: f64,
}

impl Panel<'_> {
    fn pbrt(&self, light: &str) -> String {
        let Self { shape, corner: [x, z], edges: [a, b], height } = *self;
        let indices = if shape == "trianglemesh" { "\"integer indices\" [0 1 2  1 3 2]" } else { "" };
        format!(
            "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] {light} Shape \"{shape}\" {indices} \"point3 P\" \
             [{x} {height} {z}  {} {height} {z}  {x} {height} {}  {} {height} {}] AttributeEnd\n",
            x + a,
            z + b,
            x + a,
            z + b
        )
    }
    /// Irradiance of the origin, for factors of the radiance by the unit direction of the light.
    fn irradiance(&self, factor: impl Fn([f64; 3]) -> f64) -> f64 {
        let n = 600;
        let mut sum = 0.0;
        for i in 0..n * n {
            let [s, t] = [i % n, i / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            let to = [self.corner[0] + s * self.edges[0], self.height, self.corner[1] + t * self.edges[1]];
            let squared = to.iter().map(|x| x * x).sum::<f64>();
            let w = to.map(|x| -x / squared.sqrt());
            sum += 2.0 * factor(w) * (w[1] * w[1]) / squared;
        }
        sum * self.edges[0] * self.edges[1] / f64::from(n * n)
    }
}

/// Cosine of the angle to the normal from which on intensities fall.
fn least() -> f64 {
    85_f64.to_radians().cos()
}

/// π over the sum of the intensity by the polar angle and the turn, over the hemisphere, with the fall next to its plane.
fn gain(intensity: impl Fn(f64, f64) -> f64) -> f64 {
    let (rows, columns) = (3000, 720);
    let mut flux = 0.0;
    for i in 0..rows {
        let theta = (f64::from(i) + 0.5) / f64::from(rows) * PI / 2.0;
        for j in 0..columns {
            let turn = (f64::from(j) + 0.5) / f64::from(columns) * 360.0;
            flux += intensity(theta.to_degrees(), turn) * (theta.cos() / least()).min(1.0) * theta.sin();
        }
    }
    // steps of ½π/rows and 2π/columns
    f64::from(rows * columns) / (flux * PI)
}

/// An intensity by the angle to the normal and the turn about it, in degrees.
type Intensity = dyn Fn(f64, f64) -> f64;

/// Panels over a plane: a wide profile, one that differs around the axis, a beam so narrow that points see a part of the panel, of one
/// parallelogram and of two triangles, alone, among other lights, and of many.
#[test]
fn panels_with_profiles_over_a_plane() {
    let folder = Folder::new("panels");
    folder.ies("wide.ies", 1, "0 90", "0", "1 3");
    folder.ies("skew.ies", 1, "0 90", "0 180", "2 1 2 5");
    folder.ies("beam.ies", 1, "0 15 30", "0", "4 1 0");
    let wide = |theta: f64, _: f64| 1.0 + 2.0 * theta / 90.0;
    let skew = |theta: f64, turn: f64| {
        let around = if turn > 180.0 { 360.0 - turn } else { turn };
        let side = 1.0 + 4.0 * around / 180.0;
        2.0 + (side - 2.0) * theta / 90.0
    };
    let beam = |theta: f64, _: f64| if theta < 15.0 { 4.0 - 0.2 * theta } else { (2.0 - theta / 15.0).max(0.0) };
    let profiles: [(&str, &Intensity); 3] = [("wide", &wide), ("skew", &skew), ("beam", &beam)];
    let panels = [
        Panel { shape: "bilinearmesh", corner: [-0.4, -0.2], edges: [1.0, 0.7], height: 0.8 },
        Panel { shape: "trianglemesh", corner: [0.0, -0.5], edges: [0.5, 0.6], height: 0.9 },
        Panel { shape: "bilinearmesh", corner: [-2.0, -1.5], edges: [4.0, 3.0], height: 1.0 },
    ];
    for (name, intensity) in profiles {
        let gain = gain(intensity);
        let factor = |w: [f64; 3]| {
            let theta = (-w[1]).acos().to_degrees();
            // the luminaire hangs with its horizontal at +x, and angles run from there to +z, as in a goniometric light
            let turn = w[2].atan2(w[0]).to_degrees().rem_euclid(360.0);
            gain * intensity(theta, turn) / (-w[1]).max(least())
        };
        for panel in &panels {
            let light = panel.pbrt(&format!("\"string profile\" \"{name}.ies\""));
            nearly(&folder.world(&light), panel.irradiance(factor), name);
        }
        let light = panels[0].pbrt(&format!("\"string profile\" \"{name}.ies\""));
        let lamp = "LightSource \"point\" \"point3 from\" [0 .5 0] \"float scale\" .25";
        nearly(&folder.world(&format!("{light} {lamp}")), panels[0].irradiance(factor) + 1.0, name);
        let (mut many, mut sum) = (String::new(), 0.0);
        for i in 0..40 {
            let corner = [f64::from(i % 8) * 0.2 - 0.9, f64::from(i / 8) * 0.2 - 0.4];
            let panel = Panel { shape: "bilinearmesh", corner, edges: [0.1, 0.15], height: 1.0 };
            many += &panel.pbrt(&format!("\"string profile\" \"{name}.ies\""));
            sum += panel.irradiance(factor);
        }
        nearly(&folder.world(&many), sum, name);
    }
}

/// An image of the directions of a panel, and a panel that emits on both sides by what the file has for each.
#[test]
fn panels_with_images_and_two_sides() {
    let folder = Folder::new("images");
    let panel = Panel { shape: "bilinearmesh", corner: [-0.4, -0.2], edges: [1.0, 0.7], height: 0.8 };
    // longitude and latitude, of which the lower row is towards the nadir: dark at half of the azimuths, from +x over +z
    write_rgb_file(folder.0.join("half.exr"), 4, 2, |x, y| {
        let value: f32 = if y == 1 && x < 2 { 3.0 } else { 0.0 };
        (value, value, value)
    })
    .unwrap();
    let found = gain(|_, turn| if turn < 180.0 { 1.0 } else { 0.0 });
    let irradiance = panel.irradiance(|w| if w[2] > 0.0 { found / (-w[1]).max(least()) } else { 0.0 });
    nearly(&folder.world(&panel.pbrt("\"string profile\" \"half.exr\"")), irradiance, "an image");
    // three quarters of the intensity go up, to where the normal is not
    folder.ies("both.ies", 1, "0 89.999 90.001 180", "0", "1 1 3 3");
    let light = "\"string profile\" \"both.ies\" \"bool twosided\" true";
    let one = gain(|_, _| 1.0);
    let irradiance = panel.irradiance(|w| one / (-w[1]).max(least()));
    nearly(&folder.world(&panel.pbrt(light)), 0.5 * irradiance, "two sides");
}
