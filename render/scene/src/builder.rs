//! Collects the surfaces of a scene in world space: checks and orients them, and rounds them once to f32.

use crate::lamps::Lamps;
use crate::material_table::MaterialTable;
use crate::message::Notes;
use crate::shape_attributes::ShapeAttributes;
use crate::transform::{Transform, add, cross, dot, length, sub};
use crate::vertices::{Vertex, Vertices};
use etendue_render::geometry::{Affine, Geometry, Instance, bounds_of};
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::light_picture::affine;
use etendue_render::scene::texture::Mapping;
use etendue_render::scene::{
    CameraSettings, Corners, DeltaLight, Details, Emission, Environment, FilmSettings, Input, Message, Scene, Shape,
    coincidences,
};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// The least cosine between the normals of a mesh and those of its triangles for which these count as flat.
const FLAT: f64 = 1.0 - 1e-6;

/// The surfaces and materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub(super) materials: MaterialTable,
    pub(super) triangles: Vec<[[f32; 3]; 3]>,
    pub(super) triangle_materials: Vec<u32>,
    pub(super) details: Details,
    pub(super) shapes: Vec<Shape>,
    pub(super) lamps: Lamps,
    pub(super) notes: Notes,
    objects: Vec<Object>,
    instances: Vec<(u32, Transform)>,
    /// Number of triangles of all instances.
    instanced: usize,
    /// Triangles without area that were left out since the last [`Builder::left_out`].
    pub(super) left_out: usize,
    is_object: bool,
    /// Where in the file shapes come from: the number of shapes before, and a message about that line without its text, or with the name of
    /// what it is.
    origins: Vec<(usize, Message)>,
}

/// What a scene has besides surfaces.
pub(super) struct Rest {
    pub(super) camera: CameraSettings,
    pub(super) film: FilmSettings,
    pub(super) pixel_samples: u32,
    pub(super) delta_lights: Vec<DeltaLight>,
    pub(super) intensities: Vec<Arc<Intensity>>,
    pub(super) environment: Option<Environment>,
    pub(super) inputs: Vec<Input>,
}

/// Triangles that can be added several times.
#[derive(Debug)]
struct Object {
    parts: Builder,
    /// Least and greatest coordinates.
    bounds: [[f32; 3]; 2],
    /// Number of instances.
    uses: usize,
}

/// How the warning of a scene without lights begins.
pub(super) const DARK: &str = "nothing emits light";

/// Objects are copied, unless their copies would have more triangles than this: copies are traced faster, but take memory.
const COPIED: usize = 1 << 20;
/// Most triangles of a scene, those of all instances counted.
const MOST_TRIANGLES: usize = (1 << 31) - 1;

/// The corners of a box, moved.
fn corners(bounds: [[f32; 3]; 2], ctm: &Transform) -> [[f64; 3]; 8] {
    let corner = move |k: usize| std::array::from_fn(|axis| f64::from(bounds[k >> axis & 1][axis]));
    std::array::from_fn(|k| ctm.point(corner(k)))
}

#[inline(always)]
pub(super) fn round([x, y, z]: [f64; 3]) -> [f32; 3] {
    [x as f32, y as f32, z as f32]
}

impl Builder {
    /// Begins an object: what is added from now on is not part of the scene. Returns what was added before.
    pub(super) fn begin_object(&mut self) -> Self {
        let inner = Self { is_object: true, ..Self::default() };
        let mut before = std::mem::replace(self, inner);
        self.share(&mut before);
        before
    }

    /// Ends an object, and returns its index.
    pub(super) fn end_object(&mut self, before: Self) -> u32 {
        let mut parts = std::mem::replace(self, before);
        self.share(&mut parts);
        parts.finish();
        self.left_out += parts.left_out;
        let bounds = bounds_of(parts.triangles.as_flattened());
        self.objects.push(Object { parts, bounds, uses: 0 });
        (self.objects.len() - 1) as u32
    }

    /// Takes what objects and scenes share from another builder.
    fn share(&mut self, from: &mut Self) {
        std::mem::swap(&mut self.materials, &mut from.materials);
        std::mem::swap(&mut self.notes, &mut from.notes);
    }

    /// Whether an object is being read, which holds only triangles.
    pub(super) const fn is_object(&self) -> bool {
        self.is_object
    }

    /// Number of triangles and shapes, those of all instances counted.
    pub(super) fn count(&self) -> usize {
        self.triangles.len() + self.shapes.len() + self.instanced
    }

    /// Adds an instance of an object. Fails if there are too many triangles, or if a point is no longer finite.
    pub(super) fn instance(&mut self, index: u32, ctm: &Transform) -> Result<(), String> {
        let det = ctm.determinant();
        if det == 0.0 || !det.is_finite() {
            return Err("its transform is singular".to_owned());
        }
        let object = &self.objects[index as usize];
        if object.parts.triangles.is_empty() {
            return Ok(());
        }
        let added = object.parts.triangles.len();
        if self.count() + added > MOST_TRIANGLES {
            return Err(format!("more than {MOST_TRIANGLES} triangles, those of all instances counted"));
        }
        if let Some(corner) = corners(object.bounds, ctm).iter().find(|p| !round(**p).iter().all(|x| x.is_finite())) {
            return Err(format!("a corner of its box is at {corner:?}, which is not finite in f32"));
        }
        self.instanced += added;
        self.objects[index as usize].uses += 1;
        self.instances.push((index, *ctm));
        Ok(())
    }

    /// Least and greatest coordinates of all surfaces.
    pub(super) fn bounds(&self) -> [[f32; 3]; 2] {
        let of = |(index, ctm): &(u32, Transform)| corners(self.objects[*index as usize].bounds, ctm).map(round);
        let shapes = self.shapes.iter().flat_map(|shape| shape.geometry.bounds());
        let instances = self.instances.iter().flat_map(of);
        let points: Vec<_> = shapes.chain(instances).collect();
        let ([low, high], own) = (bounds_of(&points), bounds_of(self.triangles.as_flattened()));
        [std::array::from_fn(|k| low[k].min(own[0][k])), std::array::from_fn(|k| high[k].max(own[1][k]))]
    }

    /// Copies instances into the scene, or adds the objects that they share; returns the triangles of each object.
    fn place_objects(&mut self) -> (Vec<Range<usize>>, Vec<Instance>) {
        let objects = std::mem::take(&mut self.objects);
        let places = std::mem::take(&mut self.instances);
        let copies = objects.iter().filter(|object| object.uses > 1);
        let copied = copies.map(|object| object.uses * object.parts.triangles.len()).sum::<usize>() <= COPIED;
        // what single precision cannot invert is copied, too
        let shared = |&(index, ctm): &(u32, Transform)| {
            let Object { uses, .. } = objects[index as usize];
            let [a, b, c] = std::array::from_fn(|k| {
                let [x, y, z] = ctm.linear[k];
                [x, y, z, ctm.shift[k]].map(|x| x as f32)
            });
            let instance = Instance { object: index, to_world: Affine([a, b, c]) };
            let is_shared = !copied && uses > 1 && instance.to_world.inverse().is_some();
            is_shared.then_some(instance)
        };
        let mut instances = Vec::new();
        for place in &places {
            match shared(place) {
                Some(instance) => instances.push(instance),
                None => self.copy(&objects[place.0 as usize].parts, &place.1),
            }
        }
        let mut is_shared = vec![false; objects.len()];
        instances.iter().for_each(|instance| is_shared[instance.object as usize] = true);
        let mut ranges = Vec::new();
        for (Object { parts, .. }, is_shared) in objects.into_iter().zip(is_shared) {
            let start = self.triangles.len();
            if is_shared {
                self.append(parts);
            }
            ranges.push(start..self.triangles.len());
        }
        (ranges, instances)
    }

    /// Adds the triangles of an object as they are.
    fn append(&mut self, parts: Self) {
        let before = self.details.corners.len() as u32;
        let is_detailed = !(self.details.of_triangles.is_empty() && parts.details.of_triangles.is_empty());
        if is_detailed {
            self.details.of_triangles.resize(self.triangles.len(), Details::NONE);
            let of = parts.details.of_triangles.iter();
            self.details.of_triangles.extend(of.map(|&k| if k == Details::NONE { k } else { k + before }));
        }
        if !parts.details.colors.is_empty() {
            self.details.colors.resize(before as usize, [[1.0; 3]; 3]);
            self.details.colors.extend(parts.details.colors);
        }
        self.details.corners.extend(parts.details.corners);
        self.triangles.extend(parts.triangles);
        self.triangle_materials.extend(parts.triangle_materials);
        self.finish();
    }

    /// Adds a copy of an object.
    fn copy(&mut self, parts: &Self, ctm: &Transform) {
        let flip = ctm.determinant() < 0.0;
        let mut surface =
            ShapeAttributes { ctm: *ctm, flip, material: 0, emission: None, picture: None, profile: None, power: None };
        for (i, triangle) in (0..).zip(&parts.triangles) {
            surface.material = parts.triangle_materials[i as usize];
            let corners = parts.details.of(i);
            let wide = |v: [f32; 3]| v.map(f64::from);
            let normals = corners.map_or([[0.0; 3]; 3], |corners| corners.normals);
            let mut normals = surface.place_normals(normals.into_iter().map(wide));
            let vertex = |k: usize| Vertex {
                point: ctm.point(wide(triangle[k])),
                normal: normals.next().unwrap_or([0.0; 3]),
                uv: corners.map_or([0.0; 2], |corners| corners.uvs[k].map(f64::from)),
            };
            let (vertices, colors) = ([0, 1, 2].map(vertex), parts.details.colors_of(i));
            self.add_triangle(
                &surface,
                |k| vertices[k].point,
                |k| vertices[k].normal,
                |k| vertices[k].uv,
                |k| colors[k],
            );
        }
        // edges that a transform flattens are no fault of the file
        self.left_out();
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
        let (objects, instances) = self.place_objects();
        let Rest { camera, film, pixel_samples, delta_lights, intensities, environment, inputs } = rest;
        self.warn_of_coincidences();
        let emits = self.shapes.iter().any(|shape| shape.emission.is_some());
        if !emits && delta_lights.is_empty() && environment.is_none() {
            self.notes.warn(warning(&format!("{DARK}: the image will be black; --environment FILE adds a sky")));
        }
        let materials = self.materials;
        let name = Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        Scene {
            name: name.unwrap_or_else(|| file.to_owned()),
            camera,
            film,
            pixel_samples,
            materials: materials.all,
            triangles: self.triangles,
            triangle_materials: self.triangle_materials,
            objects,
            instances,
            masks: materials.masks.into_iter().map(|(material, (_, mask))| (material, mask)).collect(),
            varying: materials.varying,
            single_sided: materials.single_sided.into_iter().collect(),
            details: self.details.into(),
            shapes: self.shapes.into(),
            pictures: self.lamps.pictures.into(),
            profiles: self.lamps.profiles.into(),
            delta_lights,
            intensities,
            environment,
            warnings: self.notes.warnings,
            stand_ins: self.notes.stand_ins,
            inputs,
        }
    }

    /// Notes where in the file the shapes that follow come from: the line of a message, or what its text names.
    pub(super) fn begin(&mut self, origin: Message) {
        let before = self.shapes.len();
        self.origins.retain(|(other, _)| *other < before);
        self.origins.push((before, origin));
    }

    /// Warns of the first lights that are in the same place.
    fn warn_of_coincidences(&mut self) {
        let pairs = coincidences(&self.shapes);
        let Some(first) = pairs.iter().find(|pair| pair.hides).or(pairs.first()) else { return };
        let origin = |light: u32| {
            let after = self.origins.partition_point(|(before, _)| *before <= light as usize);
            after.checked_sub(1).map(|index| &self.origins[index].1)
        };
        let [Some(one), Some(other)] = first.lights.map(origin) else { return };
        let name = match one.line {
            0 => one.text.clone(),
            _ if one.file == other.file => format!("line {}", one.line),
            line => format!("{}:{line}", one.file),
        };
        let own = if other.line == 0 { format!("{}: ", other.text) } else { String::new() };
        let what = if first.hides {
            "where both shine to the same side, the one that comes first in the file is seen, and the other is dark"
        } else {
            "each is seen from the side to which it shines"
        };
        let more = if pairs.len() > 1 { format!(" ({} such pairs)", pairs.len()) } else { String::new() };
        let text = format!("{own}the light is in the same place as that of {name}{more}: {what}");
        self.notes.warn(Message { text, ..other.clone() });
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

    /// Adds a shape that emits as the attributes tell. `mapping` takes its coordinates to texture coordinates.
    pub(super) fn add(&mut self, surface: &ShapeAttributes, geometry: Geometry, mapping: impl FnOnce() -> Mapping) {
        let emission = self.lamps.emission(surface, &geometry, mapping);
        if emission.is_some() || !surface.is_unseen() {
            self.push(surface.material, emission, geometry);
        }
    }

    /// Adds a triangle that emits, unless it has no area or is dark; returns whether it did. Normals tell which side emits.
    pub(super) fn lamp(&mut self, surface: &ShapeAttributes, corners: [Vertex; 3]) -> bool {
        let turned = |[first, second, third]: [Vertex; 3]| [first, third, second];
        let corners = if surface.flip { turned(corners) } else { corners };
        let [a, b, c] = corners.map(|vertex| round(vertex.point).map(f64::from));
        let flat = cross(sub(b, a), sub(c, a));
        if flat == [0.0; 3] {
            return false;
        }
        let given = corners.iter().fold([0.0; 3], |sum, vertex| add(sum, vertex.normal));
        let corners = if dot(flat, given) < 0.0 { turned(corners) } else { corners };
        let geometry = Geometry::Triangle(corners.map(|vertex| round(vertex.point)));
        let emission = self.lamps.emission(surface, &geometry, || affine(corners.map(|vertex| vertex.uv)));
        if emission.is_some() {
            self.push(surface.material, emission, geometry);
        }
        emission.is_some()
    }

    /// Makes room for the triangles of a mesh.
    pub(super) fn reserve(&mut self, surface: &ShapeAttributes, count: usize) {
        if surface.emission.is_none() {
            self.triangles.reserve(count);
            self.triangle_materials.reserve(count);
        }
    }

    /// The number of triangles without area that were left out since the last call.
    pub(super) fn left_out(&mut self) -> usize {
        std::mem::take(&mut self.left_out)
    }

    /// Adds a triangle, unless it has no area. Normals tell which side of a light emits.
    pub(super) fn triangle(&mut self, surface: &ShapeAttributes, corners: [Vertex; 3]) {
        self.add_triangle(surface, |k| corners[k].point, |k| corners[k].normal, |k| corners[k].uv, |_| [1.0; 3]);
    }

    /// Adds a triangle of a mesh, like [`Builder::triangle`], with these texture coordinates if the mesh has none.
    #[inline]
    pub(super) fn face(
        &mut self,
        surface: &ShapeAttributes,
        mesh: &Vertices,
        face: [usize; 3],
        without: &[[f64; 2]; 3],
    ) {
        let uv = |k: usize| mesh.uv(face[k], without[k]);
        let color = |k: usize| mesh.colors.get(face[k]).copied().unwrap_or([1.0; 3]);
        self.add_triangle(surface, |k| mesh.points[face[k]], |k| mesh.normal(face[k]), uv, color);
    }

    /// Adds a triangle whose corners 0, 1 and 2 have these points, normals, texture coordinates and colours.
    #[inline(always)]
    fn add_triangle(
        &mut self,
        surface: &ShapeAttributes,
        point: impl Fn(usize) -> [f64; 3],
        normal: impl Fn(usize) -> [f64; 3],
        uv: impl Fn(usize) -> [f64; 2],
        color: impl Fn(usize) -> [f32; 3],
    ) {
        if surface.emission.is_some() {
            let vertex = |k: usize| Vertex { point: point(k), normal: normal(k), uv: uv(k) };
            if self.lamp(surface, [vertex(0), vertex(1), vertex(2)]) || surface.is_unseen() {
                return;
            }
        }
        // spelt out, since the compiler calls the closures of arrays' `map` one by one
        let [j, k] = if surface.flip { [2, 1] } else { [1, 2] };
        let corners = [round(point(0)), round(point(j)), round(point(k))];
        let wide = |[x, y, z]: [f32; 3]| [f64::from(x), f64::from(y), f64::from(z)];
        let [a, b, c] = [wide(corners[0]), wide(corners[1]), wide(corners[2])];
        let flat = cross(sub(b, a), sub(c, a));
        if flat == [0.0; 3] {
            self.left_out += 1;
            return;
        }
        let normals = [normal(0), normal(j), normal(k)];
        let has_normals = normals.iter().all(|n| *n != [0.0; 3]);
        let least = FLAT * length(flat);
        let is_smooth = has_normals && normals.iter().any(|n| dot(*n, flat).abs() < least);
        if is_smooth || self.materials.varies(surface.material) {
            let smooth = [round(normals[0]), round(normals[1]), round(normals[2])];
            let single = |[u, v]: [f64; 2]| [u as f32, v as f32];
            self.details.of_triangles.resize(self.triangles.len(), Details::NONE);
            self.details.of_triangles.push(self.details.corners.len() as u32);
            let colors = [color(0), color(j), color(k)];
            if colors != [[1.0; 3]; 3] {
                self.details.colors.resize(self.details.corners.len(), [[1.0; 3]; 3]);
                self.details.colors.push(colors);
            }
            self.details.corners.push(Corners {
                normals: if is_smooth { smooth } else { [[0.0; 3]; 3] },
                uvs: [single(uv(0)), single(uv(j)), single(uv(k))],
            });
        } else if !self.details.of_triangles.is_empty() {
            self.details.of_triangles.push(Details::NONE);
        }
        self.triangles.push(corners);
        self.triangle_materials.push(surface.material);
    }
}
