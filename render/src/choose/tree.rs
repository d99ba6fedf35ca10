//! Any number of lights are chosen by a light tree.

use super::choose_light::{ChooseLight, bounds};
use super::light_tree::{Threads, build_error};
use crate::bvh::BuildError;
use crate::lights::LightRecord;
use crate::packet::{V8, X8};
use etendue::owned::OwnedTree;
use etendue::select::{Choice, Gloss, LightChoice, TreeAt};

/// Builds the tree.
///
/// # Errors
/// Fails if there are more lights than a tree can index.
pub(super) fn new(all: &[LightRecord]) -> Result<OwnedTree, BuildError> {
    OwnedTree::new(&bounds(all), &Threads).map_err(|_| build_error(all.len()))
}

impl ChooseLight for OwnedTree {
    type At<'a> = TreeAt<'a, X8>;
    #[inline]
    fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> TreeAt<'_, X8> {
        let tree = self.get();
        gloss.map_or_else(|| tree.at(p, normal), |gloss| tree.at_glossy(p, normal, gloss))
    }
    #[inline]
    fn choose(at: &TreeAt<'_, X8>, [u, second]: [X8; 2]) -> Choice<X8> {
        at.choose_with(u, second)
    }
    #[inline]
    fn pmf(at: &TreeAt<'_, X8>, light: u32) -> X8 {
        at.pmf_of(light)
    }
}
