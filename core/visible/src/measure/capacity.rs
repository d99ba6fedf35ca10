//! How much the memory of a computation holds.

/// Greatest number of occluders that [`Occlusion::visible`](super::Occlusion::visible) accepts.
pub const OCCLUDERS: usize = 16;
/// Greatest number of occluders in a row that overlap as seen from the point.
pub(super) const DEPTH: usize = 6;
/// Greatest number of planes through a point and an edge of an occluder's outline.
pub(super) const EDGES: usize = 12;
/// Greatest number of corners of an intersection.
pub(super) const MOST: usize = 12;
/// Greatest number of intersections.
pub(super) const TERMS: u32 = 48;

/// Why the intersections do not suffice.
pub(super) struct TooMany;
