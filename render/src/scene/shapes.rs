//! Reads shapes: transforms them to world space in f64, checks and orients them, and rounds once to f32.

use super::description::{Emission, Shape};
use super::generated;
use super::materials::Material;
use super::message::Message;
use super::params::{Params, shown};
use super::ply;
use super::transform::{Transform, add, cross, dot, length, sub};
use crate::files::read_file;
use crate::geometry::Geometry;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// How far a bilinear patch may deviate from a parallelogram, and a quad of a mesh file from its plane, relative to its size:
/// coordinates of six digits pass, a visible bend does not.
const FLATNESS: f64 = 1e-5;

/// The geometry and materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Output {
    pub(super) materials: Vec<Material>,
    pub(super) triangles: Vec<[[f32; 3]; 3]>,
    pub(super) triangle_materials: Vec<u32>,
    pub(super) shapes: Vec<Shape>,
    pub(super) warnings: Vec<Message>,
    material_index: HashMap<[u32; 8], u32>,
    warned: HashSet<&'static str>,
}

/// The part of the graphics state that applies to a shape.
#[derive(Clone, Debug)]
pub(super) struct ShapeAttributes {
    pub(super) ctm: Transform,
    /// Whether the normal opposes the order of the transformed vertices.
    pub(super) flip: bool,
    pub(super) material: u32,
    pub(super) emission: Option<Emission>,
}

impl Output {
    /// The index of the material, which is added if it is new.
    pub(super) fn material(&mut self, material: Material) -> u32 {
        *self.material_index.entry(material.words()).or_insert_with(|| {
            self.materials.push(material);
            (self.materials.len() - 1) as u32
        })
    }

    /// Warns about a parameter without effect, once per scene.
    fn warn_once(&mut self, params: &Params, name: &'static str, why: &str) {
        if self.warned.insert(name) {
            self.warnings.push(params.error(format!("{name:?}: {why} (reported once)")));
        }
    }

    fn push(&mut self, material: u32, emission: Option<Emission>, geometry: Geometry) {
        match geometry {
            Geometry::Triangle(corners) if emission.is_none() => {
                self.triangles.push(corners);
                self.triangle_materials.push(material);
            }
            _ => self.shapes.push(Shape { geometry, material, emission }),
        }
    }

    /// Adds a triangle of world points, which errors call `name`.
    fn triangle(
        &mut self,
        surface: &ShapeAttributes,
        [a, b, c]: [[f64; 3]; 3],
        name: &dyn Fn() -> String,
    ) -> Result<(), String> {
        let corners = (if surface.flip { [a, c, b] } else { [a, b, c] }).map(round);
        let [a, b, c] = corners.map(|p| p.map(f64::from));
        if cross(sub(b, a), sub(c, a)) == [0.0; 3] {
            return Err(format!("{} has no area: {:?}", name(), corners));
        }
        self.push(surface.material, surface.emission, Geometry::Triangle(corners));
        Ok(())
    }

    /// Adds a parallelogram with corners p00, p10, p01, p11; fails if the last corner is off.
    fn parallelogram(
        &mut self,
        surface: &ShapeAttributes,
        p: [[f64; 3]; 4],
        name: &dyn Fn() -> String,
    ) -> Result<(), String> {
        let [p00, p10, p01, p11] = p;
        let (u, v) = (sub(p10, p00), sub(p01, p00));
        let off = length(sub(p11, add(p10, v))) / length(u).max(length(v));
        if off > FLATNESS {
            return Err(format!("{} is not a parallelogram: its last corner is off by {off:.1e} of its size", name()));
        }
        if surface.emission.is_none() {
            self.triangle(surface, [p00, p10, p11], name)?;
            return self.triangle(surface, [p00, p11, p01], name);
        }
        let (u, v) = if surface.flip { (v, u) } else { (u, v) };
        let (p, u, v) = (round(p00), round(u), round(v));
        if cross(u.map(f64::from), v.map(f64::from)) == [0.0; 3] {
            return Err(format!("{} has no area: {:?}", name(), [p, u, v]));
        }
        self.push(surface.material, surface.emission, Geometry::Parallelogram { p, u, v });
        Ok(())
    }

    /// Adds a quad with corners in cyclic order: a parallelogram, or two triangles if it is planar and convex.
    fn quad(
        &mut self,
        surface: &ShapeAttributes,
        [a, b, c, d]: [[f64; 3]; 4],
        name: &dyn Fn() -> String,
    ) -> Result<(), String> {
        let off = length(sub(add(a, c), add(b, d)));
        let size = length(sub(c, a)).max(length(sub(d, b)));
        if off <= FLATNESS * length(sub(b, a)).max(length(sub(d, a))) {
            return self.parallelogram(surface, [a, b, d, c], name);
        }
        let normal = cross(sub(c, a), sub(d, b));
        let convex = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]]
            .iter()
            .all(|[before, at, after]| dot(cross(sub(*after, *at), sub(*before, *at)), normal) > 0.0);
        let bend = dot(sub(b, a), normal).abs() / length(normal);
        if !(convex && bend <= FLATNESS * size) {
            return Err(format!("{} is a quad that is not planar and convex: split it into triangles", name()));
        }
        self.triangle(surface, [a, b, c], name)?;
        self.triangle(surface, [a, c, d], name)
    }
}

fn round(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| x as f32)
}

impl ShapeAttributes {
    /// Transforms points to world space; fails if one is not finite in f32.
    fn place(&self, points: impl Iterator<Item = [f64; 3]>) -> Result<Vec<[f64; 3]>, String> {
        let place = |(i, p): (usize, [f64; 3])| {
            let world = self.ctm.point(p);
            let finite = round(world).iter().all(|x| x.is_finite());
            let shown = if p.iter().all(|x| x.is_finite()) { world } else { p };
            finite.then_some(world).ok_or_else(|| format!("vertex {i} is at {shown:?}, which is not finite in f32"))
        };
        points.enumerate().map(place).collect()
    }
}

/// Reads `Shape "sphere"`.
pub(super) fn sphere(out: &mut Output, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    params.reject(&["zmin", "zmax", "phimax"])?;
    let radius = params.float("radius")?.unwrap_or(1.0);
    let Some(factor) = surface.ctm.similarity() else {
        return Err(params.error("its transform stretches it into an ellipsoid, which is not supported"));
    };
    if surface.flip && surface.emission.is_some_and(|emission| !emission.two_sided) {
        return Err(params
            .error("it would emit inwards (ReverseOrientation, or a mirroring transform), which is not supported"));
    }
    let center = surface.place(std::iter::once([0.0; 3])).map_err(|why| params.error(why))?;
    let world_radius = (radius * factor) as f32;
    if !(world_radius > 0.0 && world_radius.is_finite()) {
        return Err(params.error(format!(
            "\"radius\": must be greater than 0 and finite, not {} ({world_radius:e} in world space)",
            shown(radius)
        )));
    }
    out.push(surface.material, surface.emission, Geometry::Sphere { center: round(center[0]), radius: world_radius });
    Ok(())
}

/// Reads world points from "P" and groups of `N` indices from "indices"; `N` points need no indices.
#[allow(clippy::type_complexity)] // a pair that only two callers see
fn indexed<const N: usize>(
    surface: &ShapeAttributes,
    params: &mut Params,
) -> Result<(Vec<[f64; 3]>, Vec<[usize; N]>), Message> {
    let Some(numbers) = params.numbers("P", "point3", 3)? else {
        return Err(params.error("\"point3 P\" is missing"));
    };
    let points = numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]);
    let points = surface.place(points).map_err(|why| params.error(why))?;
    let Some(indices) = params.numbers("indices", "integer", N)? else {
        if points.len() != N {
            return Err(params.error(format!("\"indices\" is missing: it is optional only for {N} points")));
        }
        return Ok((points, vec![std::array::from_fn(|i| i)]));
    };
    if let Some(i) = indices.iter().find(|&&i| i < 0.0 || i as usize >= points.len()) {
        return Err(params.error(format!("index {i} is out of range: there are {} points", points.len())));
    }
    let groups = indices.chunks_exact(N).map(|group| std::array::from_fn(|i| group[i] as usize));
    Ok((points, groups.collect()))
}

/// In pbrt normals decide the emitting side, so they are an error on one-sided lights; elsewhere all is flat shaded.
fn shading(out: &mut Output, surface: &ShapeAttributes, params: &mut Params, has_normals: bool) -> Result<(), Message> {
    let given = params.given("N") | has_normals;
    if given && surface.emission.is_some_and(|emission| !emission.two_sided) {
        return Err(
            params.error("\"N\" on a light is not supported: its emitting side follows the order of its vertices")
        );
    }
    if given {
        out.warn_once(params, "N", "ignored: surfaces are flat shaded");
    }
    for name in ["uv", "S"] {
        if params.given(name) {
            out.warn_once(params, name, "ignored: no material uses it");
        }
    }
    Ok(())
}

/// Reads `Shape "trianglemesh"`.
pub(super) fn triangle_mesh(out: &mut Output, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    shading(out, surface, params, false)?;
    let (points, indices) = indexed::<3>(surface, params)?;
    for (i, corners) in indices.iter().enumerate() {
        let done = out.triangle(surface, corners.map(|k| points[k]), &|| format!("triangle {i}"));
        done.map_err(|why| params.error(why))?;
    }
    Ok(())
}

/// Reads `Shape "bilinearmesh"`.
pub(super) fn bilinear_mesh(out: &mut Output, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    shading(out, surface, params, false)?;
    let (points, indices) = indexed::<4>(surface, params)?;
    for (i, corners) in indices.iter().enumerate() {
        let done = out.parallelogram(surface, corners.map(|k| points[k]), &|| format!("patch {i}"));
        done.map_err(|why| params.error(why))?;
    }
    Ok(())
}

/// Reads `Shape "plymesh"` from a file.
pub(super) fn ply_mesh(
    out: &mut Output,
    surface: &ShapeAttributes,
    params: &mut Params,
    path: &Path,
) -> Result<(), Message> {
    let shown = path.display().to_string();
    let bytes = read_file(path).map_err(|error| params.error(format!("cannot read {shown:?}: {error}")))?;
    let mesh = ply::read(&shown, &bytes).map_err(|why| params.error(why))?;
    drop(bytes);
    shading(out, surface, params, mesh.has_normals)?;
    out.warnings.extend(mesh.warnings.iter().map(|text| params.error(text)));

    let in_file = |why: String| params.error(format!("{shown}: {why}"));
    let points = surface.place(mesh.points.iter().copied()).map_err(in_file)?;
    for (i, face) in mesh.faces.iter().enumerate() {
        let name = || format!("face {i}");
        let corner = |k: usize| {
            let outside = || {
                in_file(format!(
                    "face {i}: index {} is out of range: there are {} vertices",
                    face.indices[k],
                    points.len()
                ))
            };
            let index = usize::try_from(face.indices[k]).map_err(|_| outside())?;
            points.get(index).copied().ok_or_else(outside)
        };
        let [a, b, c] = [corner(0)?, corner(1)?, corner(2)?];
        let done = match face.corners {
            3 => out.triangle(surface, [a, b, c], &name),
            _ => out.quad(surface, [a, b, c, corner(3)?], &name),
        };
        done.map_err(in_file)?;
    }
    Ok(())
}

/// Adds shapes of a built-in scene that are computed, which need no checks. Each light has its own radiance, times that of the surface.
pub(super) fn computed(
    out: &mut Output,
    surface: &ShapeAttributes,
    params: &Params,
    name: &str,
) -> Result<(), Message> {
    if surface.ctm != Transform::IDENTITY || surface.flip {
        return Err(params.error(format!("builtin:{name} takes no transform")));
    }
    let mut add = |geometry: Geometry, radiance: [f64; 3]| {
        let emission = surface.emission.map(|emission| Emission {
            radiance: std::array::from_fn(|k| (f64::from(emission.radiance[k]) * radiance[k]) as f32),
            ..emission
        });
        out.push(surface.material, emission, geometry);
    };
    let is_known = generated::add(name, &mut add);
    is_known.then_some(()).ok_or_else(|| params.error(format!("no shapes are called builtin:{name}")))
}
