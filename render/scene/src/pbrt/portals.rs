//! Reads the portals of `LightSource "infinite"`.
//!
//! As in pbrt-v4, the four corners of a portal follow its outline, in world space, and the light comes from where (p3 − p0) × (p1 − p0) points
//! to. Nothing of the light is seen but through a portal: a ray that escapes elsewhere meets black. Beyond pbrt, a light may have several
//! portals, in one list or, with the same sky, in several directives, and they may be parallelograms. What two portals show counts once.

use super::params::{Params, shown};
use crate::transform::{add, cross, length, sub};
use etendue::light::{Portal, PortalEnvironment};
use etendue_render::scene::Message;

/// How far the fourth corner may be from its place, and how narrow the outline may be, relative to its edges: pbrt's tolerance.
const TOLERANCE: f64 = 1e-3;

/// Reads `portal`.
pub(super) fn read(params: &mut Params) -> Result<Vec<Portal>, Message> {
    let Some(numbers) = params.numbers("portal", "point3", 3)? else { return Ok(Vec::new()) };
    let corners: Vec<[f64; 3]> = numbers.as_chunks::<3>().0.to_vec();
    if corners.is_empty() || !corners.len().is_multiple_of(4) || corners.len() > 4 * PortalEnvironment::MOST {
        return Err(params.error(format!(
            "\"portal\": expected four corners for each of 1 to {} portals, found {} points",
            PortalEnvironment::MOST,
            corners.len()
        )));
    }
    let outlines = corners.as_chunks::<4>().0;
    outlines
        .iter()
        .map(|outline| portal(*outline).map_err(|what| params.error(format!("\"portal\": {what}"))))
        .collect()
}

/// The portal with these corners.
fn portal([p0, p1, p2, p3]: [[f64; 3]; 4]) -> Result<Portal, String> {
    let (s, t) = (sub(p3, p0), sub(p1, p0));
    let edge = length(s).max(length(t));
    let off = length(sub(sub(p2, p0), add(s, t)));
    let named =
        format!("{:?} {:?} {:?} {:?}", p0.map(shown), p1.map(shown), p2.map(shown), p3.map(shown)).replace('"', "");
    if off.is_nan() || edge.is_infinite() || off > TOLERANCE * edge {
        return Err(format!("the corners {named} are not those of a parallelogram in a plane, one after the other"));
    }
    let is_wide = length(cross(s, t)) > TOLERANCE * length(s) * length(t);
    let narrow = |v: [f64; 3]| v.map(|x| x as f32);
    let portal = Portal::new(narrow(p0), narrow(s), narrow(t)).ok().filter(|_| is_wide);
    portal.ok_or_else(|| format!("the corners {named} enclose no area"))
}
