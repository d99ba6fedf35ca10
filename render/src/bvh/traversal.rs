//! The ways to traverse a tree.

/// How groups of packets traverse the tree of triangles. The hits do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Traversal {
    /// As one frustum if the group fits into a narrow one, otherwise as a stream.
    #[default]
    Choose,
    /// As a stream: the group visits each node once, with the rays that enter it. Below 5 active rays, each finishes
    /// alone.
    Stream,
    /// Ray by ray.
    Single,
    /// Every leaf, regardless of other hits and without the tree above it: the oracle for the other traversals.
    Exhaustive,
}
