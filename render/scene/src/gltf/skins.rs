//! Skins: meshes whose vertices follow joints, in the pose of the file.

use super::nodes::Placed;
use super::source::Source;
use crate::transform::Transform;
use etendue_render::scene::Message;
use gltf_json::Index;
use gltf_json::accessor::Accessor;
use gltf_json::mesh::{Primitive, Semantic};
use gltf_json::validation::Checked;
use std::collections::HashMap;

/// Where the joints of a skin move what is bound to them, in world space.
#[derive(Debug)]
pub(super) struct Pose(Vec<Transform>);

impl Pose {
    /// The pose of a node's skin; `None` if a joint is not in the scene.
    pub(super) fn new(
        source: &Source<'_>,
        skin: Index<gltf_json::skin::Skin>,
        node: usize,
        placed: &[Placed],
    ) -> Result<Option<Self>, Message> {
        let (index, skin) = source.item(&source.root.skins, skin, "skin", &format!("node {node}"))?;
        let item = format!("skin {index}");
        let bound = skin.inverse_bind_matrices.map(|accessor| source.matrices(accessor, &item)).transpose()?;
        if bound.as_ref().is_some_and(|bound| bound.len() < skin.joints.len()) {
            return Err(source.message(format!("{item}: fewer inverseBindMatrices than joints")));
        }
        let worlds: HashMap<usize, &Transform> = placed.iter().map(|node| (node.index, &node.transform)).collect();
        let joint = |(k, joint): (usize, &Index<gltf_json::Node>)| {
            let world = worlds.get(&joint.value())?;
            let bound = match &bound {
                None => Transform::IDENTITY,
                Some(all) => Transform::from_columns(&all[k].map(f64::from))?,
            };
            Some(world.after(&bound)).filter(Transform::is_finite)
        };
        Ok(skin.joints.iter().enumerate().map(joint).collect::<Option<Vec<_>>>().map(Self))
    }

    /// The transform of each vertex of a primitive: the weighted sum of those of its joints.
    pub(super) fn of_vertices(
        &self,
        source: &Source<'_>,
        primitive: &Primitive,
        count: usize,
        item: &str,
    ) -> Result<Vec<Transform>, Message> {
        let zero = Transform { linear: [[0.0; 3]; 3], shift: [0.0; 3] };
        let (mut sums, mut totals) = (vec![zero; count], vec![0.0; count]);
        let attribute =
            |semantic| -> Option<Index<Accessor>> { primitive.attributes.get(&Checked::Valid(semantic)).copied() };
        for set in 0.. {
            let pair = attribute(Semantic::Joints(set)).zip(attribute(Semantic::Weights(set)));
            let Some((joints, weights)) = pair else { break };
            let joints = source.vectors::<4>(joints, item)?;
            let weights = source.vectors::<4>(weights, item)?;
            if joints.len() != count || weights.len() != count {
                return Err(source.message(format!("{item}: not as many joints and weights as vertices")));
            }
            for (k, (joints, weights)) in joints.iter().zip(&weights).enumerate() {
                for (joint, weight) in joints.iter().zip(weights).filter(|(_, weight)| **weight > 0.0) {
                    let Some(of) = self.0.get(*joint as usize) else {
                        let (count, joint) = (self.0.len(), *joint);
                        return Err(source.message(format!("{item}: joint {joint} of a vertex: there are {count}")));
                    };
                    let weight = f64::from(*weight);
                    totals[k] += weight;
                    (0..3).for_each(|i| {
                        (0..3).for_each(|j| sums[k].linear[i][j] += weight * of.linear[i][j]);
                        sums[k].shift[i] += weight * of.shift[i];
                    });
                }
            }
        }
        // weights are rounded
        let normed = |(sum, total): (Transform, f64)| match total {
            0.0 => self.0.first().copied().unwrap_or(Transform::IDENTITY),
            _ => {
                Transform { linear: sum.linear.map(|row| row.map(|x| x / total)), shift: sum.shift.map(|x| x / total) }
            }
        };
        Ok(sums.into_iter().zip(totals).map(normed).collect())
    }
}
