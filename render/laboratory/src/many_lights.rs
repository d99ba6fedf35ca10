//! Choices among many lights: their variance, their time, and how their importance fails.
//!
//! [`published`] has the tree of the literature that the library's tree is compared with, [`stage`] the scenes and the points that their
//! cameras see, [`moments`] the variance of one sample without the noise of the choice, [`time`] the time of each part of a sample,
//! [`scaling`] sets of any number of lights, and [`nodes`] what the importance of a node is worth.

pub mod moments;
pub mod nodes;
pub mod published;
pub mod scaling;
pub mod stage;
pub mod time;

use etendue::select::{Join, LightBound, LightTree, Node8};

/// The library's tree with its memory.
#[derive(Debug)]
pub struct OwnTree {
    nodes: Vec<Node8>,
    places: Vec<u32>,
}

/// The threads of the pool.
#[derive(Clone, Copy, Debug)]
pub struct Threads;

impl Join for Threads {
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        rayon::join(a, b);
    }
}

impl OwnTree {
    /// Builds the tree on these threads.
    pub fn new(lights: &[LightBound], join: &impl Join) -> Self {
        let mut own =
            Self { nodes: vec![Node8::default(); LightTree::nodes_for(lights.len())], places: vec![0; lights.len()] };
        LightTree::build_with(lights, &mut own.nodes, &mut own.places, join).expect("the memory is large enough");
        own
    }
    /// The tree.
    #[must_use]
    pub fn get(&self) -> LightTree<'_> {
        LightTree::from_buffers(&self.nodes, &self.places)
    }
    /// Size in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.places[..])
    }
}
