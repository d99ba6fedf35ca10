//! What a scene file says of all of a shape, and how that moves it to world space.

use crate::distribution::Distribution;
use crate::transform::Transform;
use etendue_render::scene::Emission;
use etendue_render::scene::texture::Picture;
use std::sync::Arc;

/// What applies to all of a shape.
#[derive(Clone, Debug)]
pub(super) struct ShapeAttributes {
    /// To world space.
    pub(super) ctm: Transform,
    /// Whether the normal opposes the order of the transformed vertices.
    pub(super) flip: bool,
    pub(super) material: u32,
    pub(super) emission: Option<Emission>,
    /// What the shape emits, relative to the radiance of `emission`, by its texture coordinates. It is empty where that radiance is the same
    /// everywhere.
    pub(super) picture: Option<Picture>,
    /// How a flat shape distributes what it emits.
    pub(super) profile: Option<Arc<Distribution>>,
    /// If given, the power of all of the shape, in watts; only the colour of `emission` then counts.
    pub(super) power: Option<f64>,
}

impl ShapeAttributes {
    /// Whether the file reverses the side of the normal; what a mirroring transform does to the order of vertices is no part of it.
    pub(super) fn is_reversed(&self) -> bool {
        self.flip != (self.ctm.determinant() < 0.0)
    }

    /// Whether the shape lights the scene, and no ray meets it.
    pub(super) fn is_unseen(&self) -> bool {
        self.emission.is_some_and(|emission| emission.is_unseen)
    }

    /// Transforms points to world space; fails if one is not finite in f32.
    pub(super) fn place(&self, points: impl Iterator<Item = [f64; 3]>) -> Result<Vec<[f64; 3]>, String> {
        let place = |(i, p): (usize, [f64; 3])| {
            let world = self.ctm.point(p);
            let finite = world.map(|x| x as f32).iter().all(|x| x.is_finite());
            let shown = if p.iter().all(|x| x.is_finite()) { world } else { p };
            finite.then_some(world).ok_or_else(|| format!("vertex {i} is at {shown:?}, which is not finite in f32"))
        };
        let mut placed = Vec::with_capacity(points.size_hint().0);
        for point in points.enumerate().map(place) {
            placed.push(point?);
        }
        Ok(placed)
    }

    /// Transforms normals to world space, where they are on the side that the transformed surface has; those that are not finite become 0.
    pub(super) fn place_normals(&self, normals: impl Iterator<Item = [f64; 3]>) -> impl Iterator<Item = [f64; 3]> {
        normals.map(self.ctm.normals())
    }
}
