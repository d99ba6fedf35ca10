//! Adds the triangles of meshes.

use super::materials::Materials;
use super::skins::Pose;
use super::source::Source;
use crate::builder::Builder;
use crate::shape_attributes::ShapeAttributes;
use crate::transform::Transform;
use crate::vertices::{Vertex, Vertices};
use etendue_render::scene::Message;
use gltf_json::accessor::{Accessor, Type};
use gltf_json::mesh::{Mode, MorphTarget, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Index, mesh};

/// Most triangles of a scene that are no instances: meshes that emit are repeated for each node that uses them, so that a small file can ask
/// for any number.
const MOST_TRIANGLES: usize = 1 << 28;

/// Whether a part of a mesh emits light.
pub(super) fn glows(
    source: &Source<'_>,
    materials: &mut Materials,
    out: &mut Builder,
    mesh: Index<mesh::Mesh>,
    node: usize,
) -> Result<bool, Message> {
    let (index, mesh) = source.item(&source.root.meshes, mesh, "mesh", &format!("node {node}"))?;
    for (number, primitive) in mesh.primitives.iter().enumerate() {
        let item = format!("mesh {index}, primitive {number}");
        if materials.surface(source, out, (primitive.material, false), &item)?.glow.is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Adds a mesh to the scene.
pub(super) fn add(
    source: &Source<'_>,
    materials: &mut Materials,
    out: &mut Builder,
    mesh: Index<mesh::Mesh>,
    node: usize,
    transform: &Transform,
    pose: Option<&Pose>,
) -> Result<(), Message> {
    let (index, mesh) = source.item(&source.root.meshes, mesh, "mesh", &format!("node {node}"))?;
    let weights = source.root.nodes[node].weights.as_ref().or(mesh.weights.as_ref()).map_or(&[][..], Vec::as_slice);
    for (number, primitive) in mesh.primitives.iter().enumerate() {
        let item = format!("mesh {index}, primitive {number}");
        Adder { source, out, item, node, weights, pose }.primitive(materials, primitive, transform)?;
    }
    Ok(())
}

/// Makes an object of a mesh, and returns its index.
pub(super) fn object(
    source: &Source<'_>,
    materials: &mut Materials,
    out: &mut Builder,
    mesh: Index<mesh::Mesh>,
    node: usize,
) -> Result<u32, Message> {
    let before = out.begin_object();
    let added = add(source, materials, out, mesh, node, &Transform::IDENTITY, None);
    let object = out.end_object(before);
    added.map(|()| object)
}

/// Adds one primitive.
struct Adder<'r, 's> {
    source: &'r Source<'s>,
    out: &'r mut Builder,
    item: String,
    node: usize,
    /// Weights of the morph targets.
    weights: &'r [f32],
    /// Where a skin moves the vertices.
    pose: Option<&'r Pose>,
}

/// The places of the corners of a triangle among the indices.
const fn corners(mode: Mode, triangle: usize) -> [usize; 3] {
    match mode {
        Mode::TriangleStrip => [triangle, triangle + 1 + triangle % 2, triangle + 2 - triangle % 2],
        Mode::TriangleFan => [triangle + 1, triangle + 2, 0],
        _ => [3 * triangle, 3 * triangle + 1, 3 * triangle + 2],
    }
}

impl Adder<'_, '_> {
    fn error(&self, what: &str) -> Message {
        self.source.message(format!("{}: {what}", self.item))
    }

    fn stand_in(&mut self, kind: &str, what: &str) {
        let message = self.error(what);
        self.out.notes.stand_in(kind, || message);
    }

    fn primitive(
        &mut self,
        materials: &mut Materials,
        primitive: &Primitive,
        transform: &Transform,
    ) -> Result<(), Message> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err(self.error("its mode is unknown"));
        };
        if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            self.stand_in("lines", &format!("{mode:?} are ignored: only triangles are supported"));
            return Ok(());
        }
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions) else {
            self.stand_in("positions", "it has no POSITION and is ignored");
            return Ok(());
        };
        let others = primitive.extensions.iter().flat_map(|all| all.others.keys());
        if let Some(name) = others.into_iter().find(|name| name.contains("draco")) {
            let is_empty = |index: Index<Accessor>| {
                self.source.root.accessors.get(index.value()).is_some_and(|of| of.buffer_view.is_none())
            };
            if is_empty(positions) {
                return Err(self.error(&format!("its geometry is compressed by {name}, which is not supported")));
            }
        }
        let colors = self.colors(primitive)?;
        let finish = (primitive.material, !colors.is_empty());
        let surface = materials.surface(self.source, self.out, finish, &self.item)?;

        let mut positions = self.source.vectors::<3>(positions, &self.item)?;
        self.morph(primitive, |target| target.positions, &mut positions)?;
        // a skin moves the vertices itself, wherever the node is
        let moves = match self.pose {
            Some(pose) => Some(pose.of_vertices(self.source, primitive, positions.len(), &self.item)?),
            None => None,
        };
        let transform = moves.as_ref().map_or(*transform, |_| Transform::IDENTITY);
        let own = moves.as_ref().and_then(|moves| moves.first()).unwrap_or(&transform);
        let attributes = ShapeAttributes {
            ctm: transform,
            flip: own.determinant() < 0.0,
            material: surface.material,
            emission: None,
            picture: None,
            profile: None,
            power: None,
        };
        let wide = |v: &[f32; 3]| v.map(f64::from);
        let moved = |(k, p): (usize, &[f32; 3])| moves.as_ref().map_or(wide(p), |moves| moves[k].point(wide(p)));
        let points = attributes.place(positions.iter().enumerate().map(moved)).map_err(|what| self.error(&what))?;
        drop(positions);
        let count = points.len();
        let mut normals = Vec::new();
        if let Some(accessor) = attribute(Semantic::Normals) {
            let mut given = self.source.vectors::<3>(accessor, &self.item)?;
            self.same_number("NORMAL", given.len(), count)?;
            self.morph(primitive, |target| target.normals, &mut given)?;
            match &moves {
                None => normals.extend(attributes.place_normals(given.iter().map(wide))),
                Some(moves) => {
                    let turned = |(moved, normal): (&Transform, &[f32; 3])| moved.normals()(wide(normal));
                    normals.extend(moves.iter().zip(&given).map(turned));
                }
            }
        }
        let uvs = self.coordinates(primitive, surface.set, count)?;
        let uvs = uvs.iter().flatten().map(|uv| uv.map(f64::from)).collect();
        if !colors.is_empty() {
            self.same_number("COLOR_0", colors.len(), count)?;
        }
        let mut vertices = Vertices::new(points, normals, uvs);
        vertices.colors = colors;
        let glow = surface.glow.as_ref();
        let (picture, set) = glow.and_then(|glow| glow.texture.clone()).unzip();
        let glowing_uvs = self.coordinates(primitive, set, count)?;
        let glowing = glow.map(|glow| ShapeAttributes { emission: Some(glow.emission), picture, ..attributes.clone() });

        let (indices, triangles) = self.triangles(primitive, mode, count)?;
        self.out.reserve(&attributes, triangles);
        let mut add = |triangle: usize| {
            let places = corners(mode, triangle).map(|place| match &indices {
                Some(indices) => indices[place] as usize,
                None => place,
            });
            let emits = glowing.as_ref().is_some_and(|attributes| {
                let uv = |place: usize| glowing_uvs.as_ref().map_or([0.0; 2], |uvs| uvs[place].map(f64::from));
                // the order of the vertices tells which side emits
                let vertex = |place: usize| Vertex { point: vertices.points[place], normal: [0.0; 3], uv: uv(place) };
                self.out.lamp(attributes, places.map(vertex))
            });
            if !emits {
                self.out.face(&attributes, &vertices, places, &[[0.0; 2]; 3]);
            }
        };
        (0..triangles).for_each(&mut add);
        Ok(())
    }

    /// Adds the morph targets of an attribute by their weights: those of the node, or else of the mesh, or else 0.
    fn morph(
        &mut self,
        primitive: &Primitive,
        of: impl Fn(&MorphTarget) -> Option<Index<Accessor>>,
        values: &mut [[f32; 3]],
    ) -> Result<(), Message> {
        for (target, &weight) in primitive.targets.iter().flatten().zip(self.weights) {
            let Some(accessor) = of(target).filter(|_| weight != 0.0) else { continue };
            let moves = self.source.vectors::<3>(accessor, &self.item)?;
            self.same_number("a morph target", moves.len(), values.len())?;
            for (value, by) in values.iter_mut().zip(moves) {
                (0..3).for_each(|k| value[k] += weight * by[k]);
            }
        }
        Ok(())
    }

    /// The indices of a primitive, if it has some, and its number of triangles.
    fn triangles(
        &mut self,
        primitive: &Primitive,
        mode: Mode,
        count: usize,
    ) -> Result<(Option<Vec<u32>>, usize), Message> {
        let indices = match primitive.indices {
            Some(indices) => Some(self.source.integers(indices, &self.item)?),
            None => None,
        };
        if let Some(indices) = &indices
            && let Some(place) = indices.iter().position(|&index| index as usize >= count)
        {
            let index = indices[place];
            return Err(self.error(&format!("index {place} is {index}, but there are {count} vertices")));
        }
        let corners = indices.as_ref().map_or(count, Vec::len);
        if mode == Mode::Triangles && !corners.is_multiple_of(3) || (1..3).contains(&corners) {
            self.stand_in(
                "rest",
                &format!("{corners} corners make no whole number of triangles: the last are ignored"),
            );
        }
        let triangles = if mode == Mode::Triangles { corners / 3 } else { corners.saturating_sub(2) };
        if self.out.count() + triangles > MOST_TRIANGLES {
            let node = self.node;
            return Err(self.error(&format!("more than 2^28 triangles, with those that node {node} adds")));
        }
        Ok((indices, triangles))
    }

    /// The texture coordinates of a set that a material uses; those that are not finite become 0.
    fn coordinates(
        &mut self,
        primitive: &Primitive,
        set: Option<u32>,
        count: usize,
    ) -> Result<Option<Vec<[f32; 2]>>, Message> {
        let Some(set) = set else { return Ok(None) };
        let Some(&uvs) = primitive.attributes.get(&Checked::Valid(Semantic::TexCoords(set))) else {
            self.stand_in("uvs", &format!("its material uses TEXCOORD_{set}, which it does not have: 0 stands for it"));
            return Ok(None);
        };
        let mut uvs = self.source.vectors::<2>(uvs, &self.item)?;
        self.same_number("TEXCOORD", uvs.len(), count)?;
        for uv in uvs.iter_mut().filter(|uv| !uv.iter().all(|x| x.is_finite())) {
            *uv = [0.0; 2];
        }
        Ok(Some(uvs))
    }

    /// The colours of the vertices without their opacity, none if they have none.
    fn colors(&self, primitive: &Primitive) -> Result<Vec<[f32; 3]>, Message> {
        let Some(&accessor) = primitive.attributes.get(&Checked::Valid(Semantic::Colors(0))) else {
            return Ok(Vec::new());
        };
        let kind = self.source.root.accessors.get(accessor.value()).map(|accessor| accessor.type_);
        let mut colors = match kind {
            Some(Checked::Valid(Type::Vec4)) => {
                self.source.vectors::<4>(accessor, &self.item)?.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect()
            }
            _ => self.source.vectors::<3>(accessor, &self.item)?,
        };
        colors.as_flattened_mut().iter_mut().for_each(|x| *x = if *x > 0.0 { x.min(1.0) } else { 0.0 });
        Ok(colors)
    }

    fn same_number(&self, name: &str, found: usize, count: usize) -> Result<(), Message> {
        let differ = || self.error(&format!("{count} elements of POSITION, but {found} of {name}"));
        if found == count { Ok(()) } else { Err(differ()) }
    }
}
