//! In which precision the closed form of a light is accurate enough, as seen from a patch.

use crate::hull::{V64, edges, unit};
use crate::light::Light;
use crate::measure::{COMPACT, Occlusion};
use crate::patch::Patch;
use core::f64::consts::{PI, TAU};
use etendue::{Real, Vec3, f64x8};

/// Greatest error that a closed form may have, relative to the light without occluders.
pub const ALLOWED: f64 = 1e-5;
/// The light of a point that receives less than this fraction of what another point of the patch does counts as this much.
pub(crate) const FAINT: f64 = 1e-2;
/// Greatest errors of closed forms in one precision, in steradians where they are not fractions.
struct Errors {
    /// For a flat light, and for a sphere behind flat occluders, once or for each occluder: a fraction of the angle around the light, in
    /// radians.
    flat: f64,
    /// For a compact flat light, once and for each occluder: a fraction of the square of half of its perimeter over its distance.
    compact: f64,
    /// What each occluder adds to that: a fraction of its perimeter over its distance, times the cosine of its highest direction with the
    /// normal.
    outline: f64,
    /// For each sphere that blocks: what is outside of it moves to its rim, so that terms of the size of the sphere cancel, however small the
    /// light is.
    sphere: f64,
    /// For a sphere without occluders: a fraction of its solid angle.
    whole: f64,
}
/// More than the greatest errors that `cargo test -p etendue-render-tests certificates::values -- --nocapture` prints, and for compact lights
/// `cargo test -p etendue-render-tests occlusion::compact -- --nocapture`.
const SINGLE: Errors = Errors { flat: 1.2e-7, compact: 1e-7, outline: 2e-9, sphere: 4e-7, whole: 1e-7 };
/// Twice the greatest errors or more.
const DOUBLE: Errors = Errors { flat: 1e-15, compact: 1e-15, outline: 1e-15, sphere: 1e-15, whole: 1e-15 };

/// How a light that is known is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// In single precision.
    #[default]
    Single,
    /// In double precision: the light is small, or nearly below the horizon, or an occluder is flush with the patch, or an edge is seen under
    /// nearly 180°.
    Double,
    /// Not in closed form: the light is sampled.
    Neither,
}

/// What may hide a light.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Behind {
    /// Number of occluders.
    pub(crate) occluders: usize,
    /// Number of spheres among them.
    pub(crate) spheres: usize,
    /// Sum of the angles in radians by which their outlines may be displaced.
    pub(crate) displacement: f64,
    /// By how many occluders more they count where edges are seen under nearly 180°: the sum of [`Hull::stretch`](crate::hull::Hull::stretch)
    /// less 1.
    pub(crate) stretch: f64,
    /// Whether one of them is flush with the patch, so that only double precision tells on which side of it points are.
    pub(crate) flush: bool,
}

/// A light as a point of a patch sees it, without occluders.
struct Unhidden {
    /// Its projected solid angle in steradians.
    all: f64,
    /// The angle around it, in radians; of a compact light, its perimeter over its distance.
    around: f64,
    /// The greatest cosine of a direction to it with the normal.
    cosine: f64,
    /// Whether it is flat, and compact as [`COMPACT`] says.
    compact: bool,
}

impl Unhidden {
    fn new(p: V64, normal: V64, all: f64, lamp: &Light) -> Self {
        let (hull, corners) = (&lamp.hull, lamp.hull.corners());
        let middle = corners.iter().fold(V64::default(), |sum, &x| sum + x) * (1.0 / corners.len() as f64);
        let distance = (middle - p).length();
        // as the core decides, with a reserve for rounding
        let is_near = |&x: &V64| (x - middle).length_squared() < 0.99 * COMPACT * distance * distance;
        let is_ball = lamp.plane.is_none();
        let compact = !is_ball && corners.iter().all(is_near);
        let around = if is_ball {
            TAU * hull.radius / (distance - hull.extent).max(0.0)
        } else if compact {
            edges(corners).map(|(a, b)| (b - a).length()).sum::<f64>() / distance
        } else {
            edges(corners).map(|(a, b)| 2.0 * arc_sine((0.5 * (unit(b - p) - unit(a - p)).length()).min(1.0))).sum()
        };
        let cosine = |&x: &V64| (unit(x - p).dot(normal) + hull.radius / (x - p).length()).min(1.0);
        Self { all, around: around.min(TAU), cosine: corners.iter().map(cosine).fold(0.0, f64::max), compact }
    }
    /// The error of a closed form.
    fn error(&self, errors: &Errors, is_ball: bool, stretch: f64, behind: &Behind) -> f64 {
        let (around, count) = (self.around, behind.occluders as f64);
        let rounding = if is_ball && behind.occluders == 0 {
            // a whole sphere has no cancellation, but the rounding of the normal counts where it is seen at a small angle
            errors.whole * around * around / (4.0 * PI)
        } else if self.compact {
            let outlines = errors.outline * around * self.cosine * (count + behind.stretch);
            errors.compact * around * around / 4.0 * (1.0 + count) + outlines
        } else {
            errors.flat * around * (count.max(1.0) * stretch + behind.stretch)
        };
        rounding + behind.displacement * around * self.cosine + errors.sphere * behind.spheres as f64
    }
}

/// arcsin x for x in [0, 1].
fn arc_sine(x: f64) -> f64 {
    Real::atan2(x, Real::sqrt((1.0 - x) * (1.0 + x)))
}

impl Precision {
    /// The least precision whose error is at most [`ALLOWED`] of the light without occluders, at the corners and the centre of a patch, and the
    /// greatest projected solid angle of the light there.
    pub(crate) fn of(patch: &Patch, lamp: &Light, behind: &Behind, occlusion: &mut Occlusion<f64x8>) -> (Self, f64) {
        let is_ball = lamp.plane.is_none();
        let normal = |p: V64| match (patch.ground, patch.ball) {
            (Some(ground), _) => ground.normal,
            (None, Some((middle, _))) if (p - middle).length() > 0.0 => unit(p - middle),
            (None, _) => unit(lamp.hull.center - p),
        };
        // the centre, and seven corners or fewer
        let corners = patch.hull.corners();
        let point = |lane: usize| if lane == 0 { patch.hull.center } else { corners[(lane - 1) % corners.len()] };
        let points: [V64; 8] = core::array::from_fn(point);
        let normals = points.map(normal);
        let packet = |of: [V64; 8]| {
            let axis = |k: fn(V64) -> f64| f64x8::new(of.map(k));
            Vec3::new(axis(|v| v.x), axis(|v| v.y), axis(|v| v.z))
        };
        let visible = occlusion.visible(packet(points), packet(normals), &lamp.solid, &[]);
        let all = visible.map_or([0.0; 8], f64x8::to_array);
        let seen: [Unhidden; 8] =
            core::array::from_fn(|lane| Unhidden::new(points[lane], normals[lane], all[lane], lamp));
        let most = seen.iter().fold(0.0, |most: f64, seen| most.max(seen.all));
        let least = seen.iter().fold(most, |least, seen| least.min(seen.all));
        // where the horizon turns within a patch of a sphere, points between these see less of the light than they do
        let turns = patch.ground.is_none() && least < 0.5 * most;
        let stretch = patch.hull.stretch(edges(lamp.hull.corners()));
        let suffices = |errors: &Errors| {
            let allowed = |seen: &Unhidden| ALLOWED * if turns { FAINT * most } else { seen.all.max(FAINT * most) };
            seen.iter().all(|seen| seen.error(errors, is_ball, stretch, behind) <= allowed(seen))
        };
        let precision = if !behind.flush && suffices(&SINGLE) {
            Self::Single
        } else if suffices(&DOUBLE) {
            Self::Double
        } else {
            Self::Neither
        };
        (precision, most)
    }
}
