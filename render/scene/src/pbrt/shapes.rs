//! Reads shapes: transforms them to world space in f64, and gives them to the builder.

use super::generated;
use super::inputs::Files;
use super::params::{Params, shown};
use super::ply::{self, Face};
use super::subdivision::Control;
use crate::builder::{Builder, round};
use crate::list::PBRT;
use crate::nearest::did_you_mean;
use crate::shape_attributes::ShapeAttributes;
use crate::transform::Transform;
use crate::vertices::{Vertex, Vertices};
use etendue_render::geometry::{Disk, Geometry, Sphere};
use etendue_render::scene::texture::Mapping;
use etendue_render::scene::{Emission, Message};
use std::path::Path;

/// Reads a `Shape`; only a built-in scene may name `builtin:` meshes.
pub(super) fn read(
    kind: &str,
    out: &mut Builder,
    surface: &ShapeAttributes,
    params: &mut Params,
    files: &Files<'_>,
) -> Result<(), Message> {
    let first = out.shapes.len();
    match kind {
        "sphere" => sphere(out, surface, params),
        "trianglemesh" => triangle_mesh(out, surface, params),
        "bilinearmesh" => bilinear_mesh(out, surface, params),
        "loopsubdiv" => subdivided(out, surface, params),
        "disk" => disk(out, surface, params),
        "cylinder" => cylinder(out, surface, params),
        "plymesh" => {
            let Some(name) = params.text("filename")? else {
                return Err(params.error("\"string filename\" is missing"));
            };
            match name.strip_prefix("builtin:").filter(|_| files.is_builtin) {
                Some(name) => computed(out, surface, params, name),
                None => ply_mesh(out, surface, params, &files.find(&name), files),
            }
        }
        "curve" | "cone" | "paraboloid" | "hyperboloid" | "heightfield" | "nurbs" => {
            out.notes.stand_in(kind, || params.error("shapes of this type are left out"));
            Ok(())
        }
        _ => {
            let (kinds, near) = (PBRT.kinds("Shape").join(", "), did_you_mean(kind, PBRT.kinds("Shape")));
            Err(params.error(format!("shape not supported, only {kinds}{near}")))
        }
    }?;
    let shared = surface.power.map_or(Ok(()), |power| out.lamps.share(power, &mut out.shapes[first..]));
    shared.map_err(|why| params.error(why))
}

/// Warns of the triangles of a shape that were left out.
fn note_left_out(out: &mut Builder, params: &Params) {
    let count = out.left_out();
    if count > 0 {
        let what = format!("{count} triangle(s) without area are left out");
        out.notes.warn_once("without area", || params.error(what));
    }
}

/// The factor by which its transform enlarges a shape that is kept as it is: unless it is stretched, textured or in an object.
fn kept(out: &Builder, surface: &ShapeAttributes) -> Option<f64> {
    // what emits reflects by the means of its material
    let varies = surface.emission.is_none() && out.materials.varies(surface.material);
    surface.ctm.similarity().filter(|_| !varies && !out.is_object())
}

/// A radius in world space, after a transform that enlarges it by a factor.
fn in_world(radius: f64, factor: f64, params: &Params) -> Result<f32, Message> {
    let world = (radius * factor) as f32;
    (world > 0.0 && world.is_finite()).then_some(world).ok_or_else(|| {
        let shown = shown(radius);
        params.error(format!("\"radius\": must be greater than 0 and finite, not {shown} ({world:e} in world space)"))
    })
}

/// Reads `Shape "sphere"`.
fn sphere(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let radius = params.float("radius")?.unwrap_or(1.0);
    let [low, high] = [params.float("zmin")?.unwrap_or(-radius), params.float("zmax")?.unwrap_or(radius)];
    let sweep = params.float("phimax")?.unwrap_or(360.0);
    let inwards = surface.is_reversed() && surface.emission.is_some_and(|emission| !emission.two_sided);
    let whole = low <= -radius && high >= radius && sweep >= 360.0;
    if let Some(factor) = kept(out, surface).filter(|_| whole && !inwards) {
        let center = surface.place(std::iter::once([0.0; 3])).map_err(|why| params.error(why))?;
        let (center, radius) = (center[0].map(|x| x as f32), in_world(radius, factor, params)?);
        out.add(surface, Geometry::Sphere(Sphere { center, radius }), || Mapping::IDENTITY);
        return Ok(());
    }
    params.bound("radius", radius, radius > 0.0, "greater than 0 and finite")?;
    tessellated(out, params, "a sphere that is partial, stretched, textured, in an object or emits inwards");
    let sweep = sweep.clamp(0.0, 360.0).to_radians();
    let angle = |z: f64| libm::acos((z / radius).clamp(-1.0, 1.0));
    let [from, to] = [angle(low.min(high)), angle(low.max(high))];
    swept(out, surface, params, [64, 32], |s, t| {
        let (theta, (sin, cos)) = (from + (to - from) * t, libm::sincos(sweep * s));
        let (r, z) = libm::sincos(theta);
        let n = [r * cos, r * sin, z];
        (n.map(|x| radius * x), n)
    })
}

/// Reads `Shape "disk"`. In place of a part of one, it is a regular polygon of 64 sides and the same area, with a hole if it has one.
fn disk(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let (height, radius) = (params.float("height")?.unwrap_or(0.0), params.float("radius")?.unwrap_or(1.0));
    let inner = params.float("innerradius")?.unwrap_or(0.0);
    let degrees = params.float("phimax")?.unwrap_or(360.0).clamp(0.0, 360.0);
    params.bound("radius", radius, radius > 0.0, "greater than 0 and finite")?;
    let is_whole = inner == 0.0 && degrees >= 360.0 && surface.picture.is_none();
    if let Some(factor) = kept(out, surface).filter(|_| is_whole) {
        let center = surface.place(std::iter::once([0.0, 0.0, height])).map_err(|why| params.error(why))?;
        let normal = placed_normals(surface, std::iter::once([0.0, 0.0, 1.0])).next().unwrap_or_default();
        let (center, normal, radius) = (round(center[0]), round(normal), in_world(radius, factor, params)?);
        out.add(surface, Geometry::Disk(Disk { center, normal, radius }), || Mapping::IDENTITY);
        return Ok(());
    }
    tessellated(out, params, "a disk that is partial, stretched, textured, in an object or shows a picture");
    let sweep = degrees.to_radians();
    let grown = 1.0 / polygon_share(sweep / 64.0);
    swept(out, surface, params, [64, 1], |s, t| {
        let (sin, cos) = libm::sincos(sweep * s);
        let r = grown * (radius + (inner - radius) * t);
        ([r * cos, r * sin, height], [0.0; 3])
    })
}

/// Reads `Shape "cylinder"`: a prism of 64 sides and the same area.
fn cylinder(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let radius = params.float("radius")?.unwrap_or(1.0);
    let [low, high] = [params.float("zmin")?.unwrap_or(-1.0), params.float("zmax")?.unwrap_or(1.0)];
    let sweep = params.float("phimax")?.unwrap_or(360.0).clamp(0.0, 360.0).to_radians();
    params.bound("radius", radius, radius > 0.0, "greater than 0 and finite")?;
    tessellated(out, params, "a cylinder");
    let half = sweep / 128.0;
    let grown = half / libm::sin(half).max(f64::MIN_POSITIVE);
    swept(out, surface, params, [64, 1], |s, t| {
        let (sin, cos) = libm::sincos(sweep * s);
        ([radius * grown * cos, radius * grown * sin, low + (high - low) * t], [cos, sin, 0.0])
    })
}

/// The square root of the share of a sector that the triangle of its chord covers.
fn polygon_share(angle: f64) -> f64 {
    if angle > 0.0 { (libm::sin(angle) / angle).sqrt() } else { 1.0 }
}

/// Warns of a shape that becomes triangles.
fn tessellated(out: &mut Builder, params: &Params, what: &str) {
    out.notes.stand_in(what, || params.error(format!("{what} becomes triangles")));
}

/// Adds a surface over (s, t) in [0, 1]² as a grid of quads; `at` returns points and outward normals, or 0 for flat ones.
fn swept(
    out: &mut Builder,
    surface: &ShapeAttributes,
    params: &Params,
    [columns, rows]: [usize; 2],
    at: impl Fn(f64, f64) -> ([f64; 3], [f64; 3]),
) -> Result<(), Message> {
    let mut grid = Vec::with_capacity((columns + 1) * (rows + 1));
    for (i, j) in (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j))) {
        let uv = [i as f64 / columns as f64, j as f64 / rows as f64];
        let (point, normal) = at(uv[0], uv[1]);
        let point = surface.place(std::iter::once(point)).map_err(|why| params.error(why))?[0];
        let normal = surface.place_normals(std::iter::once(normal)).next().unwrap_or([0.0; 3]);
        // the grid's own order, but for a flip, tells which side is outside
        let normal = if surface.is_reversed() { normal.map(|x| -x) } else { normal };
        grid.push(Vertex { point, normal, uv });
    }
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let vertex = |i: usize, j: usize| grid[j * (columns + 1) + i];
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        out.triangle(surface, [a, b, c]);
        out.triangle(surface, [a, c, d]);
    }
    // at the poles of a sphere and in the middle of a disk every second triangle has no area
    out.left_out();
    Ok(())
}

/// A mesh in world space.
struct Mesh<const N: usize> {
    vertices: Vertices,
    faces: Vec<[usize; N]>,
}

/// Points, and faces by their indices.
type Faces<const N: usize> = (Vec<[f64; 3]>, Vec<[usize; N]>);

/// Reads points from "P" and groups of `N` indices from "indices"; `N` points need no indices.
fn points_and_faces<const N: usize>(params: &mut Params) -> Result<Faces<N>, Message> {
    let Some(numbers) = params.numbers("P", "point3", 3)? else {
        return Err(params.error("\"point3 P\" is missing"));
    };
    let points: Vec<_> = numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    let count = points.len();
    let Some(indices) = params.numbers("indices", "integer", N)? else {
        params.require(count == N, || format!("\"indices\" is missing: it is optional only for {N} points"))?;
        return Ok((points, vec![std::array::from_fn(|i| i)]));
    };
    if let Some(i) = indices.iter().find(|&&i| i < 0.0 || i as usize >= count) {
        return Err(params.error(format!("index {i} is out of range: there are {count} points")));
    }
    let groups = indices.chunks_exact(N).map(|group| std::array::from_fn(|i| group[i] as usize));
    Ok((points, groups.collect()))
}

/// Reads a mesh, with the normals and texture coordinates of its vertices from "N" and "uv".
fn indexed<const N: usize>(surface: &ShapeAttributes, params: &mut Params) -> Result<Mesh<N>, Message> {
    let (points, faces) = points_and_faces(params)?;
    let points = surface.place(points.into_iter()).map_err(|why| params.error(why))?;
    let normals = params.numbers("N", "normal", 3)?.unwrap_or_default();
    let normals: Vec<_> = normals.chunks_exact(3).map(|n| [n[0], n[1], n[2]]).collect();
    // older files have other names and types
    params.rename("st", "uv");
    let uvs = params.numbers_of("uv", &["point2", "vector2", "float"], 2)?.unwrap_or_default();
    let uvs: Vec<_> = uvs.chunks_exact(2).map(|uv| [uv[0], uv[1]]).collect();
    for (name, count) in [("N", normals.len()), ("uv", uvs.len())] {
        params.require(count == 0 || count == points.len(), || {
            format!("{name:?} has {count} values for {} points", points.len())
        })?;
    }
    let vertices = Vertices::new(points, placed_normals(surface, normals.into_iter()).collect(), uvs);
    Ok(Mesh { vertices, faces })
}

/// Normals in world space, on the side that the file means.
fn placed_normals(
    surface: &ShapeAttributes,
    normals: impl Iterator<Item = [f64; 3]>,
) -> impl Iterator<Item = [f64; 3]> {
    // pbrt's ReverseOrientation also reverses normals
    let reversed = surface.is_reversed();
    surface.place_normals(normals).map(move |n| if reversed { n.map(|x| -x) } else { n })
}

/// The texture coordinates of a face's corners where a mesh has none.
const TRIANGLE_UVS: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
/// In cyclic order.
const QUAD_UVS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
const PATCH_UVS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

/// Reads `Shape "trianglemesh"`.
fn triangle_mesh(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let mesh = indexed::<3>(surface, params)?;
    for face in mesh.faces {
        out.face(surface, &mesh.vertices, face, &TRIANGLE_UVS);
    }
    note_left_out(out, params);
    Ok(())
}

/// Reads `Shape "loopsubdiv"`: triangles whose corners and normals are those of the limit surface.
fn subdivided(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let (points, faces) = points_and_faces(params)?;
    let levels = [params.integer("levels")?, params.integer("nlevels")?];
    let levels = levels.into_iter().flatten().next().unwrap_or(3);
    let count = u32::try_from(levels).ok().and_then(|levels| 4_usize.checked_pow(levels)?.checked_mul(faces.len()));
    if count.is_none_or(|count| count > MOST_DIVIDED) {
        let count = faces.len();
        return Err(
            params.error(format!("\"levels\": {levels} of {count} triangles: more than {MOST_DIVIDED} of them"))
        );
    }
    let wrong = |why: String| params.error(why);
    let mut mesh = Control { points, faces };
    for _ in 0..levels {
        mesh = mesh.divided().map_err(wrong)?;
    }
    let normals = placed_normals(surface, mesh.limit().map_err(wrong)?.into_iter()).collect();
    let points = surface.place(mesh.points.into_iter()).map_err(wrong)?;
    let vertices = Vertices::new(points, normals, Vec::new());
    mesh.faces.into_iter().for_each(|face| out.face(surface, &vertices, face, &TRIANGLE_UVS));
    note_left_out(out, params);
    Ok(())
}

/// Most triangles of a subdivided mesh.
const MOST_DIVIDED: usize = 1 << 24;

/// Reads `Shape "bilinearmesh"`.
fn bilinear_mesh(out: &mut Builder, surface: &ShapeAttributes, params: &mut Params) -> Result<(), Message> {
    let mesh = indexed::<4>(surface, params)?;
    for face in mesh.faces {
        out.patch(surface, mesh.vertices.corners(face, &PATCH_UVS));
    }
    note_left_out(out, params);
    Ok(())
}

/// Reads `Shape "plymesh"` from a file.
fn ply_mesh(
    out: &mut Builder,
    surface: &ShapeAttributes,
    params: &mut Params,
    path: &Path,
    files: &Files<'_>,
) -> Result<(), Message> {
    let shown = path.display().to_string();
    let bytes = files.read_unpacked(path).map_err(|error| params.error(format!("cannot read {shown:?}: {error}")))?;
    let mesh = ply::read(&shown, &bytes).map_err(|why| params.error(why))?;
    mesh.warnings.iter().for_each(|text| out.notes.warn(params.error(text)));

    let placed = surface.place(mesh.points.into_iter());
    let points = placed.map_err(|why| params.error(format!("{shown}: {why}")))?;
    // warnings from here on name the mesh
    params.owner.push_str(&format!(" {shown:?}"));
    let vertices = Vertices::new(points, placed_normals(surface, mesh.normals.into_iter()).collect(), mesh.uvs);
    out.reserve(surface, mesh.faces.len());
    for face in mesh.faces {
        match face {
            Face::Triangle(indices) => {
                out.face(surface, &vertices, indices.map(|index| index as usize), &TRIANGLE_UVS);
            }
            Face::Quad(indices) => {
                out.quad(surface, vertices.corners(indices.map(|index| index as usize), &QUAD_UVS));
            }
        }
    }
    note_left_out(out, params);
    Ok(())
}

/// Adds shapes of a built-in scene that are computed, which need no checks. Each light has its own radiance, times that of the surface.
fn computed(out: &mut Builder, surface: &ShapeAttributes, params: &Params, name: &str) -> Result<(), Message> {
    params.require(surface.ctm == Transform::IDENTITY && !surface.flip, || {
        format!("builtin:{name} takes no transform")
    })?;
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
