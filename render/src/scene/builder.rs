//! Collects the surfaces of a scene in world space: checks and orients them, and rounds them once to f32.

use super::description::{CameraSettings, Corners, Details, FilmSettings, Scene, Shape};
use super::lights::{DeltaLight, Emission, Environment};
use super::materials::{Material, Varying};
use super::message::{Message, Notes};
use super::params::MOST_RADIANCE;
use super::spectrum::luminance;
use super::transform::{Transform, add, cross, dot, length, scaled, sub, unit};
use crate::geometry::Geometry;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// How far a bilinear patch may deviate from a parallelogram, and a quad of a mesh file from its plane, relative to its size:
/// coordinates of six digits pass, a visible bend does not.
const FLATNESS: f64 = 1e-5;
/// How far the triangles that stand for a bent patch are from it at most, relative to its size, unless it takes more than `MOST_PARTS`²
/// pairs of them.
const BEND: f64 = 1e-3;
const MOST_PARTS: usize = 16;
/// The least cosine between the normals of a mesh and those of its triangles for which these count as flat.
const FLAT: f64 = 1.0 - 1e-6;

/// The surfaces and materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub(super) materials: Vec<Material>,
    pub(super) triangles: Vec<[[f32; 3]; 3]>,
    pub(super) triangle_materials: Vec<u32>,
    pub(super) varying: Vec<Varying>,
    pub(super) details: Details,
    pub(super) shapes: Vec<Shape>,
    pub(super) notes: Notes,
    material_index: HashMap<[u32; 8], u32>,
    /// Triangles without area that were left out since the last [`Builder::left_out`].
    left_out: usize,
    is_object: bool,
}

/// What a scene has besides surfaces.
pub(super) struct Rest {
    pub(super) camera: CameraSettings,
    pub(super) film: FilmSettings,
    pub(super) pixel_samples: u32,
    pub(super) delta_lights: Vec<DeltaLight>,
    pub(super) environment: Option<Environment>,
    pub(super) inputs: Vec<PathBuf>,
}

/// What applies to all of a shape.
#[derive(Clone, Debug)]
pub(super) struct ShapeAttributes {
    /// To world space.
    pub(super) ctm: Transform,
    /// Whether the normal opposes the order of the transformed vertices.
    pub(super) flip: bool,
    pub(super) material: u32,
    pub(super) emission: Option<Emission>,
    /// If given, the power of each emitting triangle, sphere or parallelogram; only the colour of `emission` then counts.
    pub(super) power: Option<f64>,
}

/// Triangles that can be added several times.
#[derive(Debug)]
pub(super) struct Object(Builder);

/// Most triangles of a scene, since instances are copies.
const MOST_TRIANGLES: usize = 1 << 28;

/// A corner of a triangle in world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) point: [f64; 3],
    /// Normal of any length; 0 if there is none.
    pub(super) normal: [f64; 3],
    /// Texture coordinates.
    pub(super) uv: [f64; 2],
}

fn round(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| x as f32)
}

impl Builder {
    /// The index of the material, which is added if it is new.
    pub(super) fn material(&mut self, material: Material) -> u32 {
        *self.material_index.entry(material.words()).or_insert_with(|| {
            self.materials.push(material);
            (self.materials.len() - 1) as u32
        })
    }

    /// A material that varies, or a constant one if its textures do not vary.
    pub(super) fn vary(&mut self, varying: Varying) -> Material {
        varying.constant().unwrap_or_else(|| {
            self.varying.push(varying);
            Material::Varying((self.varying.len() - 1) as u32)
        })
    }

    /// Whether a material varies over its surface.
    pub(super) fn varies(&self, material: u32) -> bool {
        matches!(self.materials[material as usize], Material::Varying(_))
    }

    /// Begins an object: what is added from now on is not part of the scene. Returns what was added before.
    pub(super) fn begin_object(&mut self) -> Self {
        let inner = Self { is_object: true, ..Self::default() };
        let mut before = std::mem::replace(self, inner);
        self.share(&mut before);
        before
    }

    /// Ends an object.
    pub(super) fn end_object(&mut self, before: Self) -> Object {
        let mut object = std::mem::replace(self, before);
        self.share(&mut object);
        object.finish();
        Object(object)
    }

    /// Takes what objects and scenes share from another builder.
    fn share(&mut self, from: &mut Self) {
        std::mem::swap(&mut self.materials, &mut from.materials);
        std::mem::swap(&mut self.material_index, &mut from.material_index);
        std::mem::swap(&mut self.varying, &mut from.varying);
        std::mem::swap(&mut self.notes, &mut from.notes);
    }

    /// Whether an object is being read, which holds only triangles.
    pub(super) const fn is_object(&self) -> bool {
        self.is_object
    }

    /// Adds a copy of an object. Fails if there are too many triangles, or if a point is no longer finite.
    pub(super) fn instance(&mut self, object: &Object, ctm: &Transform) -> Result<(), String> {
        let Object(Self { triangles, triangle_materials, details, .. }) = object;
        let det = ctm.determinant();
        if det == 0.0 || !det.is_finite() {
            return Err("its transform is singular".to_owned());
        }
        if self.triangles.len() + triangles.len() > MOST_TRIANGLES {
            return Err(format!("instances are copies, and give more than {MOST_TRIANGLES} triangles"));
        }
        let mut surface = ShapeAttributes { ctm: *ctm, flip: det < 0.0, material: 0, emission: None, power: None };
        for (i, triangle) in triangles.iter().enumerate() {
            surface.material = triangle_materials[i];
            let corners = details.of_triangles.get(i).and_then(|&k| details.corners.get(k as usize));
            let wide = |v: [f32; 3]| v.map(f64::from);
            let points = surface.place(triangle.iter().map(|p| wide(*p)))?;
            let normals = corners.map_or([[0.0; 3]; 3], |corners| corners.normals);
            let mut normals = surface.place_normals(normals.into_iter().map(wide));
            let vertex = |k: usize| Vertex {
                point: points[k],
                normal: normals.next().unwrap_or([0.0; 3]),
                uv: corners.map_or([0.0; 2], |corners| corners.uvs[k].map(f64::from)),
            };
            let vertices = [0, 1, 2].map(vertex);
            self.triangle(&surface, vertices);
        }
        Ok(())
    }

    /// Ends the list of triangles.
    fn finish(&mut self) {
        if !self.details.of_triangles.is_empty() {
            self.details.of_triangles.resize(self.triangles.len(), Details::NONE);
        }
    }

    /// The scene of all that was added, which messages call `file`; `warning` makes a warning about the whole of it.
    pub(super) fn scene(mut self, file: &str, rest: Rest, warning: impl FnOnce(&str) -> Message) -> Scene {
        self.finish();
        let Rest { camera, film, pixel_samples, delta_lights, environment, inputs } = rest;
        let emits = self.shapes.iter().any(|shape| shape.emission.is_some());
        if !emits && delta_lights.is_empty() && environment.is_none() {
            self.notes.warn(warning("nothing emits light: the image will be black"));
        }
        let name = Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        Scene {
            name: name.unwrap_or_else(|| file.to_owned()),
            camera,
            film,
            pixel_samples,
            materials: self.materials,
            triangles: self.triangles,
            triangle_materials: self.triangle_materials,
            varying: self.varying,
            details: self.details.into(),
            shapes: self.shapes.into(),
            delta_lights,
            environment,
            warnings: self.notes.warnings,
            stand_ins: self.notes.stand_ins,
            inputs,
        }
    }

    /// Adds a shape with one material.
    pub(super) fn push(&mut self, material: u32, emission: Option<Emission>, geometry: Geometry) {
        match geometry {
            Geometry::Triangle(corners) if emission.is_none() => {
                self.triangles.push(corners);
                self.triangle_materials.push(material);
            }
            _ => self.shapes.push(Shape { geometry, material, emission }),
        }
    }

    /// Adds a shape that emits as the attributes tell.
    pub(super) fn add(&mut self, surface: &ShapeAttributes, geometry: Geometry) {
        let emission = surface.emission.map(|emission| match surface.power {
            Some(power) => {
                // a Lambertian emitter of radiance L has the power πAL on each side that emits
                let sides = if emission.two_sided { 2.0 } else { 1.0 };
                let y = luminance(emission.radiance.map(f64::from)) * PI * sides * geometry.area();
                let radiance = emission.radiance.map(|x| (f64::from(x) * power / y).min(MOST_RADIANCE.into()) as f32);
                Emission { radiance, ..emission }
            }
            None => emission,
        });
        self.push(surface.material, emission, geometry);
    }

    /// The number of triangles without area that were left out since the last call.
    pub(super) fn left_out(&mut self) -> usize {
        std::mem::take(&mut self.left_out)
    }

    /// Adds a triangle, unless it has no area. Normals tell which side of a light emits.
    pub(super) fn triangle(&mut self, surface: &ShapeAttributes, [a, b, c]: [Vertex; 3]) {
        let mut vertices = if surface.flip { [a, c, b] } else { [a, b, c] };
        let normal_of = |vertices: &[Vertex; 3]| {
            let [a, b, c] = vertices.map(|vertex| round(vertex.point).map(f64::from));
            cross(sub(b, a), sub(c, a))
        };
        let normal = normal_of(&vertices);
        if normal == [0.0; 3] {
            self.left_out += 1;
            return;
        }
        let given = vertices.iter().fold([0.0; 3], |sum, vertex| add(sum, vertex.normal));
        if surface.emission.is_some() {
            if dot(normal, given) < 0.0 {
                vertices.swap(1, 2);
            }
        } else if let Some(corners) = self.corners(surface.material, &vertices, normal) {
            self.details.of_triangles.resize(self.triangles.len(), Details::NONE);
            self.details.of_triangles.push(self.details.corners.len() as u32);
            self.details.corners.push(corners);
        } else if !self.details.of_triangles.is_empty() {
            self.details.of_triangles.push(Details::NONE);
        }
        self.add(surface, Geometry::Triangle(vertices.map(|vertex| round(vertex.point))));
    }

    /// The corners of a triangle, if anything is to be known of them.
    fn corners(&self, material: u32, vertices: &[Vertex; 3], normal: [f64; 3]) -> Option<Corners> {
        let has_normals = vertices.iter().all(|vertex| vertex.normal != [0.0; 3]);
        if !has_normals && !self.varies(material) {
            return None;
        }
        let flat = unit(normal)?;
        let normals = vertices.map(|vertex| unit(vertex.normal));
        let smooth = match normals {
            [Some(a), Some(b), Some(c)] if [a, b, c].iter().any(|n| dot(*n, flat).abs() < FLAT) => {
                // on the side of the first one
                Some([a, b, c].map(|n| if dot(n, a) < 0.0 { scaled(n, -1.0) } else { n }))
            }
            _ => None,
        };
        (smooth.is_some() || self.varies(material)).then(|| Corners {
            normals: smooth.map_or([[0.0; 3]; 3], |normals| normals.map(round)),
            uvs: vertices.map(|vertex| vertex.uv.map(|x| x as f32)),
        })
    }

    /// Adds a bilinear patch with corners p00, p10, p01, p11: a parallelogram, or triangles that are near to it.
    pub(super) fn patch(&mut self, surface: &ShapeAttributes, corners: [Vertex; 4]) {
        let [p00, p10, p01, p11] = corners.map(|vertex| vertex.point);
        let (u, v) = (sub(p10, p00), sub(p01, p00));
        let size = length(u).max(length(v)).max(length(sub(p11, p01))).max(length(sub(p11, p10)));
        let off = length(sub(p11, add(p10, v))) / size;
        let [a, b, c, d] = corners;
        // a patch without extent is flat
        if off.is_nan() || off <= FLATNESS {
            if surface.emission.is_none() {
                self.triangle(surface, [a, b, d]);
                return self.triangle(surface, [a, d, c]);
            }
            let given = corners.iter().fold([0.0; 3], |sum, vertex| add(sum, vertex.normal));
            let side = dot(cross(u, v), given);
            let flip = if side == 0.0 { surface.flip } else { side < 0.0 };
            let (u, v) = if flip { (v, u) } else { (u, v) };
            let (p, u, v) = (round(p00), round(u), round(v));
            if cross(u.map(f64::from), v.map(f64::from)) == [0.0; 3] {
                self.left_out += 1;
            } else {
                self.add(surface, Geometry::Parallelogram { p, u, v });
            }
            return;
        }
        // a patch is off its n² pairs of triangles by a quarter of its bend over n²
        let parts = ((off / (4.0 * BEND)).sqrt().ceil() as usize).clamp(2, MOST_PARTS);
        let at = |i: usize, j: usize| {
            let [s, t] = [i, j].map(|k| k as f64 / parts as f64);
            let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
            let mix = |of: &dyn Fn(&Vertex) -> [f64; 3]| {
                let terms = corners.iter().zip(weights).map(|(vertex, weight)| scaled(of(vertex), weight));
                terms.fold([0.0; 3], add)
            };
            let given = mix(&|vertex| vertex.normal);
            let along = |p: [f64; 3], q: [f64; 3], r: [f64; 3], s: [f64; 3], t: f64| {
                add(scaled(sub(q, p), 1.0 - t), scaled(sub(s, r), t))
            };
            // the patch's own normal, on the side of the order of the vertices
            let own = cross(along(p00, p10, p01, p11, t), along(p00, p01, p10, p11, s));
            let own = if surface.flip { scaled(own, -1.0) } else { own };
            let uv = mix(&|vertex| [vertex.uv[0], vertex.uv[1], 0.0]);
            Vertex {
                point: mix(&|vertex| vertex.point),
                normal: if given == [0.0; 3] { own } else { given },
                uv: [uv[0], uv[1]],
            }
        };
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            self.triangle(surface, [a, b, d]);
            self.triangle(surface, [a, d, c]);
        }
    }

    /// Adds a quad with corners in cyclic order: a parallelogram, two triangles if it is planar and convex, or else a patch.
    pub(super) fn quad(&mut self, surface: &ShapeAttributes, vertices: [Vertex; 4]) {
        let [a, b, c, d] = vertices.map(|vertex| vertex.point);
        let off = length(sub(add(a, c), add(b, d)));
        let size = length(sub(c, a)).max(length(sub(d, b)));
        let [va, vb, vc, vd] = vertices;
        if off > FLATNESS * length(sub(b, a)).max(length(sub(d, a))) {
            let normal = cross(sub(c, a), sub(d, b));
            let convex = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]]
                .iter()
                .all(|[before, at, after]| dot(cross(sub(*after, *at), sub(*before, *at)), normal) > 0.0);
            let bend = dot(sub(b, a), normal).abs() / length(normal);
            if convex && bend <= FLATNESS * size {
                self.triangle(surface, [va, vb, vc]);
                return self.triangle(surface, [va, vc, vd]);
            }
        }
        self.patch(surface, [va, vb, vd, vc]);
    }
}

impl ShapeAttributes {
    /// Transforms points to world space; fails if one is not finite in f32.
    pub(super) fn place(&self, points: impl Iterator<Item = [f64; 3]>) -> Result<Vec<[f64; 3]>, String> {
        let place = |(i, p): (usize, [f64; 3])| {
            let world = self.ctm.point(p);
            let finite = round(world).iter().all(|x| x.is_finite());
            let shown = if p.iter().all(|x| x.is_finite()) { world } else { p };
            finite.then_some(world).ok_or_else(|| format!("vertex {i} is at {shown:?}, which is not finite in f32"))
        };
        points.enumerate().map(place).collect()
    }

    /// Transforms normals to world space, where they are on the side that the transformed surface has; those that are not finite become 0.
    pub(super) fn place_normals<'a>(
        &self,
        normals: impl Iterator<Item = [f64; 3]> + 'a,
    ) -> impl Iterator<Item = [f64; 3]> + 'a {
        // the inverse transpose, but for its length: the rows are cross products of the others
        let [a, b, c] = self.ctm.linear;
        let sign = if self.ctm.determinant() < 0.0 { -1.0 } else { 1.0 };
        let rows = [cross(b, c), cross(c, a), cross(a, b)].map(|row| scaled(row, sign));
        normals.map(move |n| unit(rows.map(|row| dot(row, n))).unwrap_or([0.0; 3]))
    }
}
