//! How luminaires lie, and how flat ones distribute what they emit.

use crate::transform::{Transform, cross, dot, scaled, sub, unit};
use etendue_render::geometry::spread::Spread;
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::light_profile::LuminousOpening;
use std::sync::Arc;

/// A signed axis of light space: x, y or z, and its sign.
pub(super) type Axis = (usize, f64);

/// How a luminaire lies in light space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// The axes of the space of its intensity.
    pub(super) axes: [Axis; 3],
}

/// The nadir, along which luminaires are aimed, and the photometric horizontal, which is at their side, in light space.
const NADIR: [f64; 3] = [0.0, -1.0, 0.0];
const HORIZONTAL: [f64; 3] = [1.0, 0.0, 0.0];

/// A profile of flat lights, which each has along its normal.
#[derive(Debug)]
pub(super) struct Distribution {
    pub(super) intensity: Arc<Intensity>,
    pub(super) aim: Aim,
    pub(super) opening: LuminousOpening,
    /// The cone about the normal beyond which it is dark.
    pub(super) cone: Spread<f32>,
}

impl Aim {
    /// The unit direction in which the luminaire is aimed, in the space of the intensity.
    pub(super) fn ahead(&self) -> [f64; 3] {
        self.axes.map(|(axis, sign)| sign * NADIR[axis])
    }
    /// Rows of the orthogonal matrix from world space to that of the intensity, when the luminaire is aimed along the unit vector `axis`. It
    /// is turned about that so that what is at its side stays in the plane of the axis and of where the transform of the light would put
    /// it: photometric horizontals are at +x, and at −y where +x is along the axis.
    pub(super) fn aimed(&self, axis: [f64; 3], ctm: &Transform) -> [[f32; 3]; 3] {
        let across = |direction: [f64; 3]| {
            let v = unit(ctm.vector(direction))?;
            let v = sub(v, scaled(axis, dot(v, axis)));
            (dot(v, v) > 1e-6).then(|| unit(v))?
        };
        let any = || unit(cross(axis, if axis[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
        let side = across(HORIZONTAL).or_else(|| across(NADIR)).or_else(any).unwrap_or([0.0; 3]);
        let up = scaled(axis, -1.0);
        // as left- or right-handed as the transform
        let sign = if ctm.determinant() < 0.0 { -1.0 } else { 1.0 };
        let axes = [side, up, scaled(cross(side, up), sign)];
        self.axes.map(|(k, sign)| axes[k].map(|x| (x * sign) as f32))
    }
}
