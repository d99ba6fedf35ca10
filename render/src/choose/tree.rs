//! Any number of lights are chosen by a light tree.

use super::choose_light::{ChooseLight, bounds};
use crate::bvh::BuildError;
use crate::light_tree::{OwnedTree, Threads};
use crate::lights::Candidate;
use crate::packet::{V8, X8, pick};
use etendue::select::{Choice, Gloss, LightChoice, TreeAt};
use etendue::{Real, u32x8};

/// Builds the tree.
///
/// # Errors
/// Fails if there are more lights than a tree can index.
pub(super) fn new(all: &[Candidate]) -> Result<OwnedTree, BuildError> {
    OwnedTree::new(&bounds(all), &Threads)
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
        let [high, low] = [u, second].map(|u| (u * X8::lit(16_777_216.0)).to_uint());
        // where there is no second number, the digits below are a hash of the first
        let low = (low ^ (high * u32x8::splat(0x9e37_79b9))) * u32x8::splat(0x85eb_ca6b);
        let choice = at.choose_by([high << 8 | low >> 24, low]);
        // a lane without a light has the pmf 0, but its index must be one
        Choice { index: pick(choice.pmf.gt(X8::lit(0.0)), choice.index, u32x8::splat(0)), ..choice }
    }
    #[inline]
    fn pmf(at: &TreeAt<'_, X8>, light: u32) -> X8 {
        at.pmf_of(light)
    }
}
