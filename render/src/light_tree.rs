//! The memory of a light tree, and threads to build it.

use crate::bvh::BuildError;
use crate::packet::X8;
use etendue::select::{Join, LightBound, LightTree, Node8, TreeAt};

/// Builds the halves of a tree on the threads of rayon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads;

impl Join for Threads {
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        rayon::join(a, b);
    }
}

/// A light tree with its memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct OwnedTree {
    nodes: Vec<Node8>,
    places: Vec<u32>,
    /// The greatest finite power of a light.
    strongest: f32,
}

impl OwnedTree {
    /// Builds the tree on these threads.
    ///
    /// # Errors
    /// Fails if there are more lights than a tree can index.
    pub(crate) fn new(lights: &[LightBound], join: &impl Join) -> Result<Self, BuildError> {
        let count = lights.len();
        let powers = lights.iter().map(|light| light.power).filter(|power| power.is_finite());
        let strongest = powers.fold(0.0, f32::max);
        let nodes = vec![Node8::default(); LightTree::nodes_for(count)];
        let mut own = Self { nodes, places: vec![0; count], strongest };
        LightTree::build_with(lights, &mut own.nodes, &mut own.places, join)
            .map_err(|_| BuildError { count, most: LightTree::MOST })?;
        Ok(own)
    }
    /// The tree.
    #[inline]
    pub(crate) fn get(&self) -> LightTree<'_> {
        LightTree::from_buffers(&self.nodes, &self.places)
    }
    /// An estimate of the irradiance that all lights cause where a choice among them has been prepared, see [`TreeAt::irradiance`].
    #[inline]
    pub(crate) fn irradiance(&self, at: &TreeAt<'_, X8>) -> X8 {
        at.irradiance(self.strongest)
    }
}
