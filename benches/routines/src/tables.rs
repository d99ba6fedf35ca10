//! The tables of costs and errors in the documentation: written between markers by one run, and checked against the routines.

use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// A cell of a table.
#[derive(Clone, Copy)]
enum Cell {
    /// The same in every run.
    Text(&'static str),
    /// Nanoseconds per sample of a routine of the benches, in f32 (0), f32x4 (1) or f32x8 (2); empty without a name.
    Time(&'static str, usize),
    /// Greatest error of a sample (0) or a pdf (1) in units of 2⁻²⁴ that the property tests measure for a warp; empty without a name.
    Error(&'static str, usize),
}
use Cell::{Error, Text, Time};

/// A table between `<!-- table: NAME -->` and `<!-- end of table -->`.
struct MarkdownTable {
    file: &'static str,
    name: &'static str,
    header: &'static [&'static str],
    rows: Vec<Vec<Cell>>,
}

/// What one run measured.
pub struct Measured {
    /// Nanoseconds per sample in f32, f32x4 and f32x8.
    pub times: HashMap<String, [f64; 3]>,
    /// Greatest errors of a sample and a pdf.
    errors: HashMap<String, [f64; 2]>,
}

impl Measured {
    /// Takes the times, and runs the property tests for the errors that they print, if a table shows any.
    ///
    /// # Errors
    /// If the tests cannot be run, or fail.
    pub fn new(times: HashMap<String, [f64; 3]>) -> Result<Self, String> {
        let needed = |cell: &Cell| matches!(cell, Error(name, _) if !name.is_empty());
        if !tables().iter().flat_map(|table| table.rows.iter().flatten()).any(needed) {
            return Ok(Self { times, errors: HashMap::new() });
        }
        let output = Command::new(env!("CARGO"))
            .args(["test", "--locked", "-p", "etendue-tests", "--test", "all", "warps::", "--", "--show-output"])
            .current_dir(root())
            .output()
            .map_err(|e| format!("cargo test: {e}"))?;
        let text = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            return Err(format!("the property tests fail:\n{text}"));
        }
        // lines such as `cone    5 regimes   20 cases  sample   3.0  pdf   1.0`
        let line = |line: &str| {
            let (name, rest) = line.split_once(' ')?;
            let (_, figures) = rest.split_once(" cases  sample ")?;
            let (sample, pdf) = figures.split_once(" pdf ")?;
            Some((name.to_owned(), [sample.trim().parse().ok()?, pdf.trim().parse().ok()?]))
        };
        Ok(Self { times, errors: text.lines().filter_map(line).collect() })
    }
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Columns, and the warp in f32, f32x8 and with its preparation, and its measured error.
fn warp(
    shape: &'static str,
    pdf: &'static str,
    link: &'static str,
    [sample, new]: [&'static str; 2],
    error: &'static str,
    rest: [&'static str; 3],
) -> Vec<Cell> {
    let [documented, source, when] = rest;
    vec![
        Text(shape),
        Text(pdf),
        Text(link),
        Time(sample, 0),
        Time(sample, 2),
        Time(new, 2),
        Error(error, 0),
        Text(documented),
        Text(source),
        Text(when),
    ]
}

#[rustfmt::skip]
fn warps() -> MarkdownTable {
    let rows = vec![
        warp("disk, in the plane", "area", "[`ConcentricDisk`](crate::warp::ConcentricDisk)", ["concentric disk sample", ""], "concentric_disk", ["1.5e−7", "Shirley and Chiu 1997", "keeps strata compact"]),
        warp("", "solid angle", "[`Disk::by_solid_angle`](crate::Disk::by_solid_angle)", ["light disk by solid angle, prepared", "light disk by solid angle"], "spherical_disk", ["1.8e−7 and 4 steps of u", "derived there", "disks; far ones by area"]),
        warp("sphere, directions", "solid angle", "[`UniformSphere`](crate::warp::UniformSphere)", ["uniform sphere sample", ""], "uniform_sphere", ["1.5e−7", "inverse distribution", "constant environments"]),
        warp("hemisphere", "solid angle", "[`UniformHemisphere`](crate::warp::UniformHemisphere)", ["uniform hemisphere sample", ""], "uniform_hemisphere", ["1.5e−7", "inverse distribution", "a baseline"]),
        warp("", "projected", "[`CosineHemisphere`](crate::warp::CosineHemisphere)", ["cosine hemisphere sample", ""], "cosine_hemisphere", ["1.5e−7", "Malley; Shirley and Chiu 1997", "diffuse surfaces, ambient occlusion"]),
        warp("cone", "solid angle", "[`Cone`](crate::warp::Cone)", ["cone sample", ""], "cone", ["1.8e−7 of its width", "inverse distribution", "suns, spheres"]),
        warp("sphere, as seen", "solid angle", "[`Sphere::by_solid_angle`](crate::Sphere::by_solid_angle)", ["light sphere by solid angle, prepared", "light sphere by solid angle"], "spherical_cap", ["4.8e−7", "PBR 6.2.4, without its series", "all spheres"]),
        warp("", "projected", "[`Sphere::by_projected_solid_angle`](crate::Sphere::by_projected_solid_angle)", ["light sphere by projected solid angle, prepared", "light sphere by projected solid angle"], "projected_cap", ["4e−7 and 4 steps of u", "Ureña and Georgiev 2018; derived there", "diffuse surfaces: no variance"]),
        warp("", "cut by the horizon", "[`Sphere::by_projected_solid_angle`](crate::Sphere::by_projected_solid_angle)", ["projected cap, cut sample", ""], "", ["the same", "the same", "the same"]),
        warp("", "centre below the horizon", "[`Sphere::by_projected_solid_angle`](crate::Sphere::by_projected_solid_angle)", ["projected cap, lune sample", ""], "", ["the same", "the same", "the same"]),
        warp("triangle", "area", "[`AreaTriangle`](crate::warp::AreaTriangle)", ["area triangle sample", ""], "area_triangle", ["1.2e−7", "Turk 1990", "far and facing triangles"]),
        warp("", "area", "[`LowDistortionTriangle`](crate::warp::LowDistortionTriangle)", ["low-distortion triangle sample", ""], "low_distortion_triangle", ["6e−8", "Heitz 2019", "strata on triangles"]),
        warp("", "solid angle", "[`Triangle::by_solid_angle`](crate::Triangle::by_solid_angle)", ["light triangle by solid angle, prepared", "light triangle by solid angle"], "spherical_triangle", ["5.4e−7", "Arvo 1995; Peters 2021", "triangles; far ones by area"]),
        warp("", "projected", "[`Triangle::by_projected_solid_angle`](crate::Triangle::by_projected_solid_angle)", ["light triangle by projected solid angle, prepared", "light triangle by projected solid angle"], "projected_triangle", ["6e−7 and 8 steps of u", "Peters 2021; derived there", "diffuse surfaces where a ray costs more than this"]),
        warp("parallelogram", "solid angle", "[`Parallelogram::by_solid_angle`](crate::Parallelogram::by_solid_angle)", ["light parallelogram by solid angle, prepared", "light parallelogram by solid angle"], "spherical_parallelogram", ["5.4e−7", "two triangles", "quads"]),
        warp("", "projected", "[`Parallelogram::by_projected_solid_angle`](crate::Parallelogram::by_projected_solid_angle)", ["light parallelogram by projected solid angle, prepared", "light parallelogram by projected solid angle"], "projected_parallelogram", ["as the triangle", "as the triangle", "as the triangle"]),
        warp("rectangle", "solid angle", "[`Rectangle::by_solid_angle`](crate::Rectangle::by_solid_angle)", ["light rectangle by solid angle, prepared", "light rectangle by solid angle"], "spherical_rectangle", ["6e−7 and 8 steps of u", "Ureña et al. 2013; derived there", "strata that follow the edges"]),
        warp("convex polygon, 5 corners", "solid angle", "[`Polygon::by_solid_angle`](crate::Polygon::by_solid_angle)", ["light pentagon by solid angle, prepared", "light pentagon by solid angle"], "spherical_polygon", ["as the triangle", "a fan", "polygons"]),
        warp("bilinear patch", "area", "[`PatchSurface`](crate::warp::PatchSurface)", ["patch surface sample", ""], "patch_surface", ["6 steps of u", "PBR 6.6", "twisted quads"]),
        warp("line", "angle", "[`Line::by_angle`](crate::Line::by_angle)", ["light line by angle, prepared", "light line by angle"], "spherical_segment", ["3e−7", "Kulla and Fajardo 2012", "thin tubes"]),
        warp("", "projected", "[`Line::by_projected_solid_angle`](crate::Line::by_projected_solid_angle)", ["light line by projected solid angle, prepared", "light line by projected solid angle"], "projected_segment", ["4e−7 and 4 steps of u", "Peters 2021; derived there", "thin tubes over diffuse surfaces"]),
        warp("image of the sky", "its radiance", "[`ImageEnvironment`](crate::light::ImageEnvironment)", ["image environment 64x32 sample", ""], "", ["5.3e−7", "PBR 12.5.2, without the sine", "environments"]),
        warp("square onto sphere", "solid angle", "[`Octahedral`](crate::warp::Octahedral)", ["octahedral sample", ""], "octahedral", ["2.4e−7", "Clarberg 2008", "equal-area maps"]),
        warp("microfacet normals", "D_v", "[`GgxVisibleNormals`](crate::warp::GgxVisibleNormals)", ["GGX visible normals sample", ""], "ggx_visible_normals", ["5e−7 in the stretched normal", "Dupuy and Benyoub 2023", "rough reflection"]),
        warp("unit square", "bilinear", "[`Bilinear`](crate::warp::Bilinear)", ["bilinear sample", ""], "bilinear", ["6 steps of u", "PBR A.5.5", "tilted or textured quads"]),
        warp("", "a table", "[`PiecewiseConstant2d`](crate::discrete::PiecewiseConstant2d)", ["table 64x32 sample", ""], "", ["1 step of u in the cell", "PBR A.4", "images"]),
    ];
    let header = &["shape", "uniform by", "routine", "x1", "x8", "new, x8", "measured", "greatest error", "source", "for"];
    MarkdownTable { file: "core/src/index.md", name: "warps", header, rows }
}

/// Names of lights by technique: for the reader, and the routine's with what comes after it.
macro_rules! lights {
    ($($light:literal, $technique:literal, $routine:literal;)+) => {
        vec![$(vec![
            Text($light), Text($technique),
            Time(concat!("light ", $routine), 0), Time(concat!("light ", $routine), 2),
            Time(concat!("light ", $routine, ", prepared"), 0), Time(concat!("light ", $routine, ", prepared"), 2),
            Time(concat!("light ", $routine, ", prepared, pdf"), 2), Time(concat!("light ", $routine, ", prepared, invert"), 2),
            Time(concat!("light ", $routine, ", with normal and uv"), 2),
        ]),+]
    };
}

fn lights() -> Vec<Vec<Cell>> {
    lights![
        "sphere", "area", "sphere by area";
        "", "solid angle", "sphere by solid angle";
        "", "projected solid angle", "sphere by projected solid angle";
        "", "reflection", "sphere by reflection";
        "triangle", "area", "triangle by area";
        "", "solid angle", "triangle by solid angle";
        "", "projected solid angle", "triangle by projected solid angle";
        "", "reflection", "triangle by reflection";
        "parallelogram", "area", "parallelogram by area";
        "", "solid angle", "parallelogram by solid angle";
        "", "projected solid angle", "parallelogram by projected solid angle";
        "", "reflection", "parallelogram by reflection";
        "rectangle", "area", "rectangle by area";
        "", "solid angle", "rectangle by solid angle";
        "", "projected solid angle", "rectangle by projected solid angle";
        "", "reflection", "rectangle by reflection";
        "polygon, 5 corners", "area", "pentagon by area";
        "", "solid angle", "pentagon by solid angle";
        "", "projected solid angle", "pentagon by projected solid angle";
        "", "reflection", "pentagon by reflection";
        "disk", "area", "disk by area";
        "", "solid angle", "disk by solid angle";
        "bilinear patch", "area", "bilinear patch by area";
        "line", "length", "line by length";
        "", "angle", "line by angle";
        "", "projected solid angle", "line by projected solid angle";
        "sun", "solid angle", "sun by solid angle";
        "point light", "delta", "point light by delta";
        "spot light", "delta", "spot light by delta";
        "directional light", "delta", "directional light by delta";
    ]
}

/// Sequences: name, variance, gains and the time of a pair at each width.
#[rustfmt::skip]
fn sequences() -> MarkdownTable {
    let row = |[link, variance, few, many, when]: [&'static str; 5], name: &'static str| {
        vec![Text(link), Text(variance), Text(few), Text(many), Time(name, 0), Time(name, 1), Time(name, 2), Text(when)]
    };
    let rows = vec![
        row(["[`Independent`]", "N⁻¹", "1", "1", "the baseline; the spread of samples gives the variance"], "sequence independent pair"),
        row(["[`Stratified`]", "N⁻², N^(−3/2)", "14, 4.2", "56, 8.5", "any count"], "sequence stratified pair"),
        row(["[`OwenSobol`]", "about N^(−2.9), N^(−3/2)", "125, 6.0", "1630, 12.0", "the choice wherever the count is a power of two"], "sequence owen sobol pair"),
        row(["[`JointSobol`]", "pair 0 as [`OwenSobol`]", "", "", "integrands that depend on two or more pairs together"], "sequence joint sobol pair"),
        row(["[`ZOrder`]", "within a pixel as [`OwenSobol`]", "", "", "few samples per pixel, images for human viewers: blue noise"], "sequence z-order pair"),
    ];
    let header = &["sequence", "variance: smooth, edge", "gain at 16", "gain at 64", "f32", "f32x4", "f32x8", "when"];
    MarkdownTable { file: "core/src/sequence.rs", name: "sequences", header, rows }
}

/// The README's: which technique for my light.
#[rustfmt::skip]
fn choice() -> MarkdownTable {
    let row = |[light, technique, why]: [&'static str; 3], prepared: &'static str, new: &'static str, error: &'static str| {
        vec![Text(light), Text(technique), Text(why), Time(prepared, 2), Time(new, 2), Error(error, 0)]
    };
    let rows = vec![
        row(["`Sphere`", "`by_solid_angle`", "always; `by_projected_solid_angle` on diffuse surfaces"], "light sphere by solid angle, prepared", "light sphere by solid angle", "spherical_cap"),
        row(["`Triangle`", "`by_solid_angle`", "the default; for tiny, distant triangles see the next row"], "light triangle by solid angle, prepared", "light triangle by solid angle", "spherical_triangle"),
        row(["", "`by_area`", "small, far and facing"], "light triangle by area, prepared", "light triangle by area", "area_triangle"),
        row(["", "`by_projected_solid_angle`", "diffuse, where a shadow ray costs more than 80 ns"], "light triangle by projected solid angle, prepared", "light triangle by projected solid angle", "projected_triangle"),
        row(["`Parallelogram`", "`by_solid_angle`", "all quads that are flat"], "light parallelogram by solid angle, prepared", "light parallelogram by solid angle", "spherical_parallelogram"),
        row(["`Rectangle`", "`by_solid_angle`", "where strata should follow the edges"], "light rectangle by solid angle, prepared", "light rectangle by solid angle", "spherical_rectangle"),
        row(["`Polygon`", "`by_solid_angle`", "three to eight corners"], "light pentagon by solid angle, prepared", "light pentagon by solid angle", "spherical_polygon"),
        row(["`Disk`", "`by_solid_angle`", "the default; `by_area` for tiny, distant disks"], "light disk by solid angle, prepared", "light disk by solid angle", "spherical_disk"),
        row(["`Line`", "`by_angle`", "tubes so thin that their width does not matter"], "light line by angle, prepared", "light line by angle", "spherical_segment"),
        row(["`BilinearPatch`", "`by_area`", "twisted quads"], "light bilinear patch by area, prepared", "light bilinear patch by area", "patch_surface"),
    ];
    let header = &["light", "technique", "when", "prepared", "with preparation", "error"];
    MarkdownTable { file: "README.md", name: "choice", header, rows }
}

/// Visible parts: the light, its occluders, and the time of a point at each width.
fn visible() -> MarkdownTable {
    let row = |light: &'static str, occluders: &'static str, name: &'static str| {
        vec![Text(light), Text(occluders), Time(name, 0), Time(name, 2)]
    };
    let rows = vec![
        row("polygon", "none", "visible polygon"),
        row("", "a polygon before it", "visible polygon, 1 occluder"),
        row("", "4 polygons, 1 before it", "visible polygon, 4 occluders, 1 before it"),
        row("", "a sphere before it", "visible polygon, 1 sphere"),
        row("sphere", "none", "visible sphere"),
        row("", "a polygon before it", "visible sphere, 1 occluder"),
    ];
    MarkdownTable {
        file: "core/visible/src/measure.rs",
        name: "visible",
        header: &["light", "occluders", "x1", "x8"],
        rows,
    }
}

const LIGHTS: &[&str] =
    &["light", "by", "x1", "x8", "prepared, x1", "prepared, x8", "pdf, x8", "invert, x8", "all fields, x8"];

fn tables() -> Vec<MarkdownTable> {
    let lights = MarkdownTable { file: "core/src/light.rs", name: "lights", header: LIGHTS, rows: lights() };
    vec![warps(), lights, sequences(), visible(), choice()]
}

fn processor() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or("an unnamed processor", |(_, name)| name.trim()).to_owned()
}

/// Year, month and day of the present, by the proleptic Gregorian calendar (Hinnant, "chrono-compatible low-level date algorithms").
fn date() -> String {
    let seconds = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let days = seconds / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let (day, month) = (of_year - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    format!("{}-{month:02}-{day:02}", era * 400 + year + u64::from(month < 3))
}

impl MarkdownTable {
    fn markers(&self) -> [String; 2] {
        [format!("<!-- table: {} -->", self.name), "<!-- end of table -->".to_owned()]
    }
    /// The file, the part between the markers, and the prefix of its lines.
    fn place(&self) -> Result<(String, std::ops::Range<usize>, String), String> {
        let path = root().join(self.file);
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", self.file))?;
        let [begin, end] = self.markers();
        let missing = |marker: &str| format!("{}: no `{marker}`", self.file);
        let at = text.find(&begin).ok_or_else(|| missing(&begin))?;
        let line = text[..at].rfind('\n').map_or(0, |i| i + 1);
        let prefix = text[line..at].to_owned();
        let first = at + begin.len() + 1;
        let length = text[first..].find(&format!("{prefix}{end}")).ok_or_else(|| missing(&end))?;
        Ok((text, first..first + length, prefix))
    }
    fn text(&self, measured: &Measured, prefix: &str) -> Result<String, String> {
        let mut out = String::new();
        let flags = if cfg!(target_feature = "fma") { "x86-64-v3" } else { "x86-64 without flags" };
        let _ = writeln!(out, "{prefix}{}, {flags}, {}.\n{}", processor(), date(), prefix.trim_end());
        let _ = writeln!(out, "{prefix}| {} |\n{prefix}|{}", self.header.join(" | "), "---|".repeat(self.header.len()));
        for row in &self.rows {
            let cells: Result<Vec<_>, String> = row.iter().map(|cell| cell.text(measured)).collect();
            let _ = writeln!(out, "{prefix}| {} |", cells?.join(" | "));
        }
        Ok(out)
    }
    fn write(&self, measured: &Measured) -> Result<(), String> {
        let (mut text, range, prefix) = self.place()?;
        text.replace_range(range, &self.text(measured, &prefix)?);
        fs::write(root().join(self.file), text).map_err(|e| format!("{}: {e}", self.file))
    }
    /// Compares header, rows and fixed cells with the file, and asks that all others hold a number.
    fn check(&self) -> Result<(), String> {
        let (text, range, prefix) = self.place()?;
        let lines: Vec<&str> =
            text[range].lines().filter_map(|line| line.strip_prefix(&format!("{prefix}|"))).collect();
        let cells = |line: &str| -> Vec<String> {
            line.trim_end_matches('|').split(" | ").map(|cell| cell.trim().to_owned()).collect()
        };
        let fault = |what: String| Err(format!("{}, table `{}`: {what}", self.file, self.name));
        if lines.len() != self.rows.len() + 2 || cells(lines[0]) != self.header {
            return fault(format!("it should have the columns {:?} and {} rows", self.header, self.rows.len()));
        }
        for (line, row) in lines[2..].iter().zip(&self.rows) {
            let found = cells(line);
            let same = found.len() == row.len()
                && row.iter().zip(&found).all(|(cell, found)| match *cell {
                    Text(text) => found == text,
                    Time("", _) | Error("", _) => found.is_empty(),
                    Time(..) | Error(..) => found.parse::<f64>().is_ok(),
                });
            if !same {
                return fault(format!("the row `{line}` is not that of the routines"));
            }
        }
        Ok(())
    }
}

impl Cell {
    fn text(self, measured: &Measured) -> Result<String, String> {
        Ok(match self {
            Text(text) => text.to_owned(),
            Time("", _) | Error("", _) => String::new(),
            Time(name, width) => {
                let time = measured.times.get(name).ok_or_else(|| format!("no routine is called `{name}`"))?[width];
                if time < 10.0 { format!("{time:.2}") } else { format!("{time:.1}") }
            }
            Error(name, which) => {
                let error = measured.errors.get(name).ok_or_else(|| format!("no tested warp is called `{name}`"))?;
                format!("{:.1}", error[which])
            }
        })
    }
}

/// Writes all tables.
///
/// # Errors
/// If a file or its markers are missing, or a row names a routine that was not measured.
pub fn write(measured: &Measured) -> Result<(), String> {
    tables().iter().try_for_each(|table| table.write(measured))
}

/// Checks that the tables in the documentation have the rows of the routines, and that the routines exist.
///
/// # Errors
/// What differs, and in which file.
pub fn check(routines: &[String]) -> Result<(), String> {
    for table in tables() {
        table.check()?;
        for cell in table.rows.iter().flatten() {
            if let Time(name, _) = *cell
                && !name.is_empty()
                && !routines.iter().any(|r| r == name)
            {
                return Err(format!("{}, table `{}`: no routine is called `{name}`", table.file, table.name));
            }
        }
    }
    let shown = |routine: &&String| {
        tables()
            .iter()
            .flat_map(|t| t.rows.iter().flatten())
            .any(|cell| matches!(cell, Time(name, _) if name == routine))
    };
    // latencies are in no table
    let is_light = |routine: &&String| routine.starts_with("light ") && !routine.ends_with("in a chain");
    match routines.iter().filter(is_light).find(|r| !shown(r)) {
        Some(missing) => Err(format!("`{missing}` is measured, but in no table")),
        None => Ok(()),
    }
}
