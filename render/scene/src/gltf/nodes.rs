//! Walks the node tree and composes its transforms.

use super::source::Source;
use crate::message::shortened;
use crate::nearest::did_you_mean;
use crate::transform::Transform;
use etendue_render::scene::Message;
use gltf_json::scene::{Node, Scene};
use gltf_json::{Accessor, Index};

/// Greatest depth of the node tree.
const DEEPEST: usize = 1024;

/// The extension of nodes that place a mesh several times.
pub(super) const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Most copies whose places are in no buffer: there, a number of a few digits would take any time and memory.
const MOST_ALIKE: u64 = 1024;

/// A node of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) index: usize,
    /// To world space; every entry is finite.
    pub(super) transform: Transform,
}

/// The scene of this name or number.
fn named<'s>(source: &'s Source<'_>, name: &str) -> Result<(usize, &'s Scene), Message> {
    let scenes = &source.root.scenes;
    let by_name = scenes.iter().position(|scene| scene.name.as_deref() == Some(name));
    let index = by_name.or_else(|| name.parse().ok()).filter(|&index| index < scenes.len());
    let names = || scenes.iter().filter_map(|scene| scene.name.as_deref());
    let unknown = || {
        let (count, near) = (scenes.len(), did_you_mean(name, names()));
        source.message(format!("has no scene {:?}: there are {count}, from 0 on{near}", shortened(name)))
    };
    index.map(|index| (index, &scenes[index])).ok_or_else(unknown)
}

/// All nodes of the scene of this name or number, or else of the default scene, or else of the first one, or else all nodes; parents come
/// before their children.
pub(super) fn walk(source: &Source<'_>, asked: Option<&str>) -> Result<Vec<Placed>, Message> {
    let root = &source.root;
    let nodes = &root.nodes;
    let scene = match (asked, root.scene) {
        (Some(name), _) => Some(named(source, name)?),
        (None, Some(index)) => Some(source.item(&root.scenes, index, "scene", "the default scene")?),
        (None, None) => root.scenes.first().map(|scene| (0, scene)),
    };
    let mut starts = Vec::new();
    if let Some((number, scene)) = scene {
        for &index in &scene.nodes {
            starts.push(source.item(nodes, index, "node", &format!("scene {number}"))?.0);
        }
    } else {
        let mut is_child = vec![false; nodes.len()];
        for child in nodes.iter().flat_map(|node| node.children.iter().flatten()) {
            is_child.get_mut(child.value()).into_iter().for_each(|is_child| *is_child = true);
        }
        starts.extend((0..nodes.len()).filter(|&index| !is_child[index]));
    }

    let mut placed = Vec::new();
    // of each node that was met, which one named it: itself, if the scene did
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    let mut stack: Vec<(usize, usize, usize, Transform)> = Vec::new();
    stack.extend(starts.into_iter().rev().map(|start| (start, start, 1, Transform::IDENTITY)));
    while let Some((index, parent, depth, above)) = stack.pop() {
        let item = format!("node {index}");
        if parents[index].is_some() {
            let is_above = index == parent || ancestors(&parents, parent).any(|ancestor| ancestor == index);
            let why = if is_above && depth > 1 { "is its own descendant" } else { "appears twice in the node tree" };
            return Err(source.message(format!("{item}: {why}")));
        }
        parents[index] = Some(parent);
        if depth > DEEPEST {
            return Err(source.message(format!("{item}: is more than {DEEPEST} nodes deep")));
        }
        let node = &nodes[index];
        let transform = above.after(&local(node).map_err(|what| source.message(format!("{item}: {what}")))?);
        if !transform.is_finite() {
            return Err(source.message(format!("{item}: its transform is not finite")));
        }
        placed.push(Placed { index, transform });
        for &child in node.children.iter().flatten().rev() {
            stack.push((source.item(nodes, child, "node", &item)?.0, index, depth + 1, transform));
        }
    }
    if scene.is_none()
        && let Some(index) = parents.iter().position(Option::is_none)
    {
        return Err(source.message(format!("node {index}: it or one of those above it is its own descendant")));
    }
    Ok(placed)
}

/// Where a node places its mesh, relative to itself: several times, if it says so by `EXT_mesh_gpu_instancing`.
pub(super) fn copies(source: &Source<'_>, index: usize) -> Result<Vec<Transform>, Message> {
    let extensions = source.root.nodes[index].extensions.as_ref();
    let Some(described) = extensions.and_then(|all| all.others.get(INSTANCING)) else {
        return Ok(vec![Transform::IDENTITY]);
    };
    let item = format!("node {index}, {INSTANCING}");
    let accessor = |name: &str| match described.get("attributes").and_then(|all| all.get(name)) {
        None => Ok(None),
        Some(value) => {
            let number = value.as_u64().and_then(|number| u32::try_from(number).ok());
            let wrong = || source.message(format!("{item}: {name:?} is no index of an accessor: {value}"));
            Ok(Some(Index::new(number.ok_or_else(wrong)?)))
        }
    };
    let attributes = [accessor("TRANSLATION")?, accessor("ROTATION")?, accessor("SCALE")?];
    let has_data = |at: &Index<Accessor>| {
        let accessor = source.root.accessors.get(at.value());
        accessor.is_some_and(|a| a.buffer_view.is_some() || a.sparse.is_some() || a.count.0 <= MOST_ALIKE)
    };
    if attributes.iter().flatten().any(|at| !has_data(at)) {
        return Err(
            source.message(format!("{item}: more than {MOST_ALIKE} copies by an accessor without a bufferView"))
        );
    }
    let [shifts, rotations, scales] = attributes;
    let shifts = shifts.map(|at| source.vectors::<3>(at, &item)).transpose()?;
    let rotations = rotations.map(|at| source.vectors::<4>(at, &item)).transpose()?;
    let scales = scales.map(|at| source.vectors::<3>(at, &item)).transpose()?;
    let counts = [shifts.as_ref().map(Vec::len), rotations.as_ref().map(Vec::len), scales.as_ref().map(Vec::len)];
    let count = counts.into_iter().flatten().max().unwrap_or(0);
    if counts.into_iter().flatten().any(|other| other != count) {
        return Err(source.message(format!("{item}: its attributes are of different lengths")));
    }
    let copy = |k: usize| {
        let [shift, scale] = [(&shifts, 0.0), (&scales, 1.0)].map(|(all, x)| all.as_ref().map_or([x; 3], |all| all[k]));
        let rotation = rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |all| all[k]);
        let copy = moved(shift, rotation, scale).map_err(|what| source.message(format!("{item}, {k}: {what}")))?;
        let finite = copy.is_finite().then_some(copy);
        finite.ok_or_else(|| source.message(format!("{item}, {k}: its transform is not finite")))
    };
    (0..count).map(copy).collect()
}

/// A node and those above it.
fn ancestors(parents: &[Option<usize>], from: usize) -> impl Iterator<Item = usize> + '_ {
    std::iter::successors(Some(from), |&node| parents[node].filter(|&above| above != node))
}

/// The transform of a node relative to its parent.
fn local(node: &Node) -> Result<Transform, String> {
    if let Some(matrix) = node.matrix {
        let matrix = matrix.map(f64::from);
        return Transform::from_columns(&matrix).ok_or_else(|| {
            let last = [3, 7, 11, 15].map(|k| matrix[k]);
            format!("its matrix is not affine: the last row is {last:?}")
        });
    }
    let rotation = node.rotation.unwrap_or_default().0;
    moved(node.translation.unwrap_or([0.0; 3]), rotation, node.scale.unwrap_or([1.0; 3]))
}

/// A scale, then a rotation by a quaternion, then a translation.
fn moved(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> Result<Transform, String> {
    let shift = translation.map(f64::from);
    let [x, y, z, w] = rotation.map(f64::from);
    let square = x * x + y * y + z * z + w * w;
    if !(square.is_finite() && square > 0.0) {
        return Err(format!("its rotation {:?} is no quaternion", [x, y, z, w]));
    }
    // quaternions in files are rounded
    let s = 2.0 / square;
    let rows = [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ];
    let linear = rows.map(|row| std::array::from_fn(|j| row[j] * f64::from(scale[j])));
    Ok(Transform { linear, shift })
}
