//! Lights as proofs see them.

use crate::hull::{Hull, V64, unit};
use crate::solid::Solid;

/// A light that emits from its surface: a polygon or parallelogram from its front or from both sides, or a sphere.
#[derive(Clone, Debug)]
pub struct Light {
    pub(crate) solid: Solid,
    /// Without the rounding of points on it.
    pub(crate) hull: Hull,
    /// The unit normal of a flat light, and n·x of its plane.
    pub(crate) plane: Option<(V64, f64)>,
    pub(crate) two_sided: bool,
}

impl Light {
    /// A light of this shape; a flat one emits on the side of its normal, (b − a) × (c − a) of the first three corners, or on both.
    /// `None` for a light without area, and for a polyhedron.
    #[must_use]
    pub fn new(solid: Solid, two_sided: bool) -> Option<Self> {
        let (hull, plane) = match solid {
            Solid::Sphere { center, radius } => {
                (radius > 0.0 && radius.is_finite()).then(|| (Hull::new(&[center], radius), None))?
            }
            _ => {
                let (corners, count) = solid.outline()?;
                let corners = &corners[..count];
                let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
                let offset = normal.dot(corners[0]);
                offset.is_finite().then(|| (Hull::new(corners, 0.0), Some((normal, offset))))?
            }
        };
        Some(Self { solid, hull, plane, two_sided })
    }
    /// Its shape.
    #[must_use]
    pub const fn solid(&self) -> &Solid {
        &self.solid
    }
}
