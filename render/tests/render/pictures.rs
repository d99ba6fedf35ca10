//! Lights that show pictures: against a double-precision quadrature, which shares no code with the renderer, and against each other by all
//! techniques.

use etendue_oracle::tier::cases;
use etendue_render::{Sampler, Settings, Technique, World};
use exr::prelude::write_rgb_file;
use std::f64::consts::PI;
use std::path::PathBuf;

const LIMIT: f64 = 4.0;
const SIZE: [usize; 2] = [16, 9];

/// A folder with the picture `p.exr`, removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("etendue-pictures-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        write_rgb_file(path.join("p.exr"), SIZE[0], SIZE[1], |x, y| texel(x as i64, y as i64)).unwrap();
        Self(path)
    }
    fn world(&self, camera: &str, text: &str) -> World {
        let text = format!("{camera}\nWorldBegin\n{text}");
        let scene = etendue_scene::parse(&text, "test.pbrt", &self.0).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        World::new(&scene).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A picture whose left part is dark, with few bright texels: red at the top, green in a corner, and blue everywhere on the right.
fn texel(x: i64, y: i64) -> (f32, f32, f32) {
    let (x, y) = (x.clamp(0, SIZE[0] as i64 - 1), y.clamp(0, SIZE[1] as i64 - 1));
    let red = if y == 1 && x >= 6 { 20.0 } else { 0.0 };
    let green = if x == 15 && y == 8 { 100.0 } else { 0.0 };
    (red, green, if x > 6 { 0.5 + (x * y % 5) as f32 } else { 0.0 })
}

/// What pbrt shows at texture coordinates: the first row at v = 1, texels interpolated, the outermost ones continued.
fn shown(u: f64, v: f64) -> [f64; 3] {
    let (x, y) = (u * SIZE[0] as f64 - 0.5, (1.0 - v) * SIZE[1] as f64 - 0.5);
    let (column, row) = (x.floor(), y.floor());
    let mut sum = [0.0; 3];
    for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let weight = |at: f64, low: f64, k: i64| if k == 0 { 1.0 - (at - low) } else { at - low };
        let (r, g, b) = texel(column as i64 + i, row as i64 + j);
        let both = weight(x, column, i) * weight(y, row, j);
        sum.iter_mut().zip([r, g, b]).for_each(|(sum, texel)| *sum += both * f64::from(texel));
    }
    sum
}

type V3 = [f64; 3];

fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A cell of a surface: a point, its area times the unit normal, and its texture coordinates.
type Cell = (V3, V3, [f64; 2]);

/// Irradiance at the origin of a plane with the normal +y, by cells of a surface.
fn irradiance(cells: impl Iterator<Item = Cell>, two_sided: bool) -> V3 {
    let mut sum = [0.0; 3];
    for (p, area, [u, v]) in cells.filter(|(p, ..)| p[1] > 0.0) {
        let facing = -dot(p, area);
        let facing = if two_sided { facing.abs() } else { facing.max(0.0) };
        let factor = p[1] * facing / dot(p, p).powi(2);
        sum.iter_mut().zip(shown(u, v)).for_each(|(sum, radiance)| *sum += factor * radiance);
    }
    sum
}

/// Cells of a parallelogram, or of the triangle that is half of it, with the normal u × v.
fn flat(p: V3, u: V3, v: V3, n: u32, is_triangle: bool) -> impl Iterator<Item = Cell> {
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    (0..n * n).map(move |k| {
        let (i, j) = (k % n, k / n);
        let [s, t] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let share = if !is_triangle || i + j + 1 < n { 1.0 } else { 0.5 * f64::from(u8::from(i + j + 1 == n)) };
        let area = cross.map(|x| x * share / f64::from(n * n));
        (std::array::from_fn(|k| p[k] + s * u[k] + t * v[k]), area, [s, t])
    })
}

/// Cells of a sphere whose pole is its own +z, in these axes.
fn ball(center: V3, radius: f64, [x, y, z]: [V3; 3], n: u32) -> impl Iterator<Item = Cell> {
    (0..n * n).map(move |k| {
        let [u, v] = [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let ((sin, cos), (slope, height)) = ((2.0 * PI * u).sin_cos(), (PI * (1.0 - v)).sin_cos());
        let normal: V3 = std::array::from_fn(|k| slope * (cos * x[k] + sin * y[k]) + height * z[k]);
        let area = radius * radius * slope * 2.0 * PI * PI / f64::from(n * n);
        (std::array::from_fn(|k| center[k] + radius * normal[k]), normal.map(|x| x * area), [u, v])
    })
}

const LIGHT: &str = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n\
    AreaLightSource \"diffuse\" \"string filename\" \"p.exr\"";
/// A narrow camera that sees the origin of a plane; a pixel of it is a point.
const NARROW: &str = "LookAt 1 5 2  0 0 0  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-3";
const PLANE: &str = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n";

fn settings(technique: Technique, spp: u32, side: u32, sampler: Sampler) -> Settings {
    Settings { width: side, height: side, spp, technique, sampler, seed: 5, ..Settings::DEFAULT }
}

/// The pixel of a narrow camera by each technique is the irradiance by quadrature, times albedo/π.
fn agrees(name: &str, light: &str, truth: V3) {
    let folder = Folder::new(name);
    let world = folder.world(NARROW, &format!("{PLANE}{light}"));
    for technique in Technique::ALL {
        let spp = cases(1 << 14, 1 << 17);
        let (film, _) = world.render(&settings(technique, spp, 1, Sampler::Independent), &|_| ());
        let pixel = film.pixels[0];
        for (k, albedo) in [0.8, 0.5, 0.2].into_iter().enumerate() {
            let truth = truth[k] * albedo / PI;
            let error = f64::from(pixel.variance[k]).sqrt();
            // what faces away, is hidden or is below the horizon adds nothing; behind a blocker, a guess may have to be taken back
            if truth == 0.0 {
                let most = LIMIT * error;
                assert!(
                    f64::from(pixel.mean[k]).abs() <= most,
                    "{name}, {technique:?}, channel {k}: {}",
                    pixel.mean[k]
                );
                continue;
            }
            // by chance, few rays find a small light: the variance is that of too few
            let aims = !technique.finds_lights();
            if aims || error > 0.0 && error < 0.1 * truth {
                let z = (f64::from(pixel.mean[k]) - truth) / error.max(1e-4 * truth);
                assert!(
                    z.abs() < LIMIT,
                    "{name}, {technique:?}, channel {k}: {} ± {error}, {truth}: {z}",
                    pixel.mean[k]
                );
            }
            assert!(!aims || error < 0.3 * truth, "{name}, {technique:?}, channel {k}: ± {error} of {truth}");
        }
    }
}

/// `Shape "bilinearmesh"` with these corner and edges.
fn mesh(p: V3, u: V3, v: V3) -> String {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let points = corners.map(|[s, t]| std::array::from_fn::<f64, 3, _>(|k| p[k] + s * u[k] + t * v[k]));
    let numbers: Vec<_> = points.as_flattened().iter().map(f64::to_string).collect();
    format!("Shape \"bilinearmesh\" \"point3 P\" [{}]", numbers.join(" "))
}

#[test]
fn near_quads_have_the_irradiance_of_a_quadrature() {
    // nearly as near as it is large
    let (p, u, v) = ([-1.6, 0.5, -0.7], [1.5, 0.1, 0.0], [0.1, 0.3, 1.25]);
    agrees("near", &format!("{LIGHT}\n{}", mesh(p, u, v)), irradiance(flat(p, u, v, 900, false), false));
}

#[test]
fn far_quads_have_the_irradiance_of_a_quadrature() {
    let (p, u, v) = ([30.0, 50.0, 20.0], [1.0, 0.25, 0.0], [0.0, -0.5, 1.0]);
    let light = format!("{LIGHT} \"bool twosided\" true\n{}", mesh(p, u, v));
    agrees("far", &light, irradiance(flat(p, u, v, 300, false), true));
}

/// Seen at a grazing angle, and partly below the horizon.
#[test]
fn grazing_quads_have_the_irradiance_of_a_quadrature() {
    let (p, u, v) = ([-2.0, -0.7, 1.0], [2.0, 0.0, -1.8], [0.0, 1.5, 0.2]);
    let light = format!("{LIGHT} \"bool twosided\" true\n{}", mesh(p, u, v));
    agrees("grazing", &light, irradiance(flat(p, u, v, 1200, false), true));
}

#[test]
fn triangles_have_the_irradiance_of_a_quadrature() {
    let (p, u, v) = ([-1.5, 1.5, -1.0], [1.2, 0.0, 0.2], [0.0, 0.3, 1.5]);
    // the second of two triangles is dark: it shows the left part of the picture
    let points: Vec<_> = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
        .iter()
        .flat_map(|[s, t]| (0..3).map(move |k| p[k] + s * u[k] + t * v[k]))
        .map(|x: f64| x.to_string())
        .collect();
    let points = format!("\"point3 P\" [{} -4 1 -4  -4 1 -5  -5 1 -4]", points.join(" "));
    let uvs = "\"point2 uv\" [.3 .2  1.1 .1  .5 1  0 0  .2 0  .2 1]";
    let mesh = format!("Shape \"trianglemesh\" {points} {uvs} \"integer indices\" [0 1 2 3 4 5]");
    let uv = |[s, t]: [f64; 2]| [0.3 + 0.8 * s + 0.2 * t, 0.2 - 0.1 * s + 0.8 * t];
    let cells = flat(p, u, v, 900, true).map(|(p, area, st)| (p, area, uv(st)));
    agrees("triangle", &format!("{LIGHT}\n{mesh}"), irradiance(cells, false));
}

#[test]
fn spheres_have_the_irradiance_of_a_quadrature() {
    let (center, x) = ([-1.2, 1.4, 0.3], [1.0, 0.0, 0.0]);
    // with its lower or its upper pole down
    for (name, turn, axes) in
        [("south", -90, [x, [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), ("north", 90, [x, [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])]
    {
        let place = format!("Translate -1.2 1.4 .3 Rotate {turn} 1 0 0");
        let light = format!("AttributeBegin {place}\n{LIGHT}\nShape \"sphere\" \"float radius\" .7\nAttributeEnd");
        agrees(name, &light, irradiance(ball(center, 0.7, axes, 1500), false));
    }
}

/// Behind a blocker that hides more of the picture's light than of its area, or less: what is visible of the area is only a guess.
#[test]
fn half_hidden_quads_have_the_irradiance_of_a_quadrature() {
    // the camera's ray passes behind the blocker
    let (p, u, v) = ([-1.5, 7.5, -1.8], [3.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    for (name, [from, to]) in [("left hidden", [-4.0, 0.03]), ("right hidden", [0.03, 4.0])] {
        let blocker = mesh([from, 1.0, -3.0], [to - from, 0.0, 0.0], [0.0, 0.0, 3.2]);
        let light = format!("{blocker} {LIGHT} \"bool twosided\" true {}", mesh(p, u, v));
        let visible = flat(p, u, v, 900, false).filter(|([x, y, _], ..)| !(from..to).contains(&(x / y)));
        agrees(name, &light, irradiance(visible, true));
    }
}

/// Among plain lights and others with pictures.
#[test]
fn several_lights_have_the_irradiance_of_a_quadrature() {
    let (p, u, v) = ([-1.6, 1.5, -0.7], [1.5, 0.1, 0.0], [0.1, 0.3, 1.25]);
    let (q, a, b) = ([1.0, 2.0, -2.0], [1.0, 0.5, 0.0], [0.0, 0.0, 1.0]);
    let plain = "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]";
    let lights = format!("{LIGHT} {}\n{} {plain} {}", mesh(p, u, v), mesh(q, a, b), mesh([-1.0, 3.0, 1.0], u, v));
    let mut truth = irradiance(flat(p, u, v, 900, false), false);
    let one = irradiance(flat(q, a, b, 600, false), false);
    let even: f64 = flat([-1.0, 3.0, 1.0], u, v, 300, false)
        .map(|(p, area, _)| p[1] * (-dot(p, area)).max(0.0) / dot(p, p).powi(2))
        .sum();
    (0..3).for_each(|k| truth[k] += one[k] + even * (k as f64 + 1.0));
    agrees("several", &lights, truth);
}

/// What the camera sees of a picture, directly and in a mirror.
#[test]
fn cameras_see_pictures() {
    let folder = Folder::new("seen");
    let (p, u, v) = ([1.0, 2.0, 3.0], [2.0, 0.5, 0.0], [0.0, 1.0, 1.5]);
    let quad = mesh(p, u, v);
    let mirror = "Material \"conductor\" \"float roughness\" 0 \"rgb reflectance\" [1 1 1]\n\
        Shape \"bilinearmesh\" \"point3 P\" [-9 -5 -9  9 -5 -9  -9 -5 9  9 -5 9]\n";
    for [s, t] in [[0.1, 0.1], [0.52, 0.81], [0.97, 0.04], [0.99, 0.99], [0.6, 0.83]] {
        let at: V3 = std::array::from_fn(|k| p[k] + s * u[k] + t * v[k]);
        // by its mirror image below the plane y = −5
        let below = [at[0], -10.0 - at[1], at[2]];
        for target in [at, below] {
            let [x, y, z] = target;
            let camera = format!("LookAt 3 -2 8  {x} {y} {z}  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-4");
            let world = folder.world(&camera, &format!("{mirror}{LIGHT} \"bool twosided\" true {quad}"));
            let (film, _) = world.render(&settings(Technique::Auto, 8, 1, Sampler::Sobol), &|_| ());
            let (found, wanted) = (film.pixels[0].mean, shown(s, t));
            for k in 0..3 {
                assert!((f64::from(found[k]) - wanted[k]).abs() < 1e-3 * (wanted[k] + 0.1), "{found:?}, {wanted:?}");
            }
        }
    }
}

/// Parts of an image are of the same scene only if its pictures are the same.
#[test]
fn digests_cover_pictures() {
    let folder = Folder::new("digest");
    let text = format!("Camera \"perspective\"\nWorldBegin\n{LIGHT}\nShape \"sphere\"");
    let digest = || etendue_scene::parse(&text, "test.pbrt", &folder.0).unwrap().digest();
    let before = digest();
    assert_eq!(before, digest());
    write_rgb_file(folder.0.join("p.exr"), SIZE[0], SIZE[1], |_, _| (1.0, 1.0, 1.0_f32)).unwrap();
    assert_ne!(before, digest());
}

/// All techniques have the same means in all parts of an image with walls, shadows, a mirror and a rough metal.
#[test]
fn techniques_agree_in_a_room() {
    let folder = Folder::new("room");
    let metal = "Material \"conductor\" \"float roughness\" .2 \"rgb reflectance\" [.9 .8 .7]";
    let mirror = "Material \"conductor\" \"float roughness\" 0 \"rgb reflectance\" [.9 .9 .9]";
    let ball = |x: f64, z: f64| {
        format!("AttributeBegin Translate {x} .5 {z} Shape \"sphere\" \"float radius\" .5 AttributeEnd")
    };
    let diffuse = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]";
    let wall = "Shape \"bilinearmesh\" \"point3 P\" [-3 0 -2  3 0 -2  -3 4 -2  3 4 -2]";
    let text = format!(
        "{PLANE}{wall} {diffuse} {} {metal} {} {mirror} {} {LIGHT} {} {LIGHT} \"bool twosided\" true {}\n\
         AttributeBegin Translate 2 1.5 .5 Rotate 40 1 0 1 {LIGHT} Shape \"sphere\" \"float radius\" .3 AttributeEnd",
        ball(-0.2, 0.2),
        ball(-1.5, 0.4),
        ball(1.1, -0.6),
        mesh([-2.0, 3.0, -1.0], [1.5, 0.0, 0.0], [0.0, 0.0, 1.0]),
        mesh([-2.2, -0.2, 1.5], [0.0, 0.0, -1.5], [0.3, 1.0, 0.0])
    );
    let camera = "LookAt 0 2.5 6  0 .8 0  0 1 0\nCamera \"perspective\" \"float fov\" 45";
    let world = folder.world(camera, &text);
    const SIDE: u32 = 16;
    // means and variances of the quarters of the image
    let quarters = |technique, sampler| {
        let spp = cases(1024, 8192);
        let (film, _) = world.render(&settings(technique, spp, SIDE, sampler), &|_| ());
        let mut sums = [[[0.0; 3]; 2]; 4];
        for (i, pixel) in (0..).zip(&film.pixels) {
            let quarter = usize::from(i % SIDE >= SIDE / 2) + 2 * usize::from(i / SIDE >= SIDE / 2);
            for (sum, rgb) in sums[quarter].iter_mut().zip([pixel.mean, pixel.variance]) {
                sum.iter_mut().zip(rgb).for_each(|(sum, x)| *sum += f64::from(x));
            }
        }
        sums
    };
    let reference = quarters(Technique::MisBalance, Sampler::Independent);
    let mut compared = 0;
    let all = Technique::ALL.into_iter().map(|technique| (technique, Sampler::Independent));
    for (technique, sampler) in
        all.chain([(Technique::Auto, Sampler::Adaptive), (Technique::Analytic, Sampler::Adaptive)])
    {
        let own = quarters(technique, sampler);
        for (quarter, ([mean, variance], [other, doubt])) in own.iter().zip(&reference).enumerate() {
            for k in 0..3 {
                let error = (variance[k] + doubt[k]).sqrt();
                // by chance, few rays find a small light: the variance is that of too few
                let is_known = !technique.finds_lights() || variance[k] > 0.0 && error < 0.1 * other[k];
                let z = (mean[k] - other[k]) / error;
                let of = format!("{technique:?}, {sampler:?}, quarter {quarter}, channel {k}");
                assert!(!is_known || mean[k] == other[k] || z.abs() < LIMIT, "{of}: {mean:?}, {other:?}: {z}");
                compared += u32::from(is_known);
            }
        }
    }
    assert!(compared > 100, "only {compared}");
}
