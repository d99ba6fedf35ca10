//! What a test has seen.

/// What the corridors of a test have shown.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    pub(crate) corridors: u64,
    pub(crate) lit: u64,
    pub(crate) dark: u64,
    pub(crate) blockers: u64,
    pub(crate) unknown: u64,
    pub(crate) pairs: u64,
    pub(crate) visible: u64,
    /// Occluded pairs of dark corridors.
    pub(crate) covered: u64,
    pub(crate) unclear: u64,
    /// Shadow rays in single precision that differ from a certificate.
    pub(crate) rays: u64,
    pub(crate) ray_differs: u64,
    /// Shading points, and the greatest share of its margin by which one is outside of its patch.
    pub(crate) points: u64,
    pub(crate) off: f64,
    /// Certificates that list bodies, and the pairs that were compared with those.
    pub(crate) with_bodies: u64,
    pub(crate) solid: u64,
    pub(crate) solid_met: u64,
    pub(crate) solid_unclear: u64,
    /// Points from which a body hides as much of a light as its triangles do, or not all.
    pub(crate) shadows: u64,
    pub(crate) on_surface: u64,
    pub(crate) partial: u64,
    /// Packets for which the visible part is not computed with a body, and points for which it is not with its triangles.
    pub(crate) bodies_fail: u64,
    pub(crate) triangles_fail: u64,
    /// Greatest difference between the two, relative to its bound.
    pub(crate) worst: f64,
    /// Least height of a shading point over its plane, in units of the least height that the patch allows.
    pub(crate) height: f64,
}
