//! Walks the node tree and composes its transforms.

use super::super::message::Message;
use super::super::transform::Transform;
use super::source::Source;
use gltf_json::scene::Node;

/// Greatest depth of the node tree.
const DEEPEST: usize = 1024;

/// A node of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) index: usize,
    /// To world space; every entry is finite.
    pub(super) transform: Transform,
}

/// All nodes of the default scene, or else of the first one, or else all nodes; parents come before their children.
pub(super) fn walk(source: &Source<'_>) -> Result<Vec<Placed>, Message> {
    let root = &source.root;
    let nodes = &root.nodes;
    let scene = match root.scene {
        Some(index) => Some(source.item(&root.scenes, index, "scene", "the default scene")?),
        None => root.scenes.first().map(|scene| (0, scene)),
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
    let shift = node.translation.unwrap_or([0.0; 3]).map(f64::from);
    let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
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
    let scale = node.scale.unwrap_or([1.0; 3]).map(f64::from);
    let linear = rows.map(|row| std::array::from_fn(|j| row[j] * scale[j]));
    Ok(Transform { linear, shift })
}
