//! Normals of a microsurface.

use crate::domain::Random;
use crate::laws::{Subject, lanes_of, vectors_of};
use crate::oracle::{V3, along, basis, dot, length, sub, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use etendue::{Real, Vec3, warp};

/// `warp::GgxVisibleNormals`.
#[derive(Clone, Copy, Debug)]
pub struct GgxVisibleNormals {
    /// αx, αy.
    pub alpha: [f32; 2],
    /// Direction to the viewer, of any length.
    pub wi: [f32; 3],
}
impl GgxVisibleNormals {
    /// The normal of the surface of roughness 1 that is stretched to m.
    fn relaxed(&self, m: V3) -> V3 {
        unit([m[0] / f64::from(self.alpha[0]), m[1] / f64::from(self.alpha[1]), m[2]])
    }
    /// Normals that look up and to the viewer are a lune of the relaxed surface: its axis, the horizontal direction to the viewer, and
    /// the angle between its planes.
    fn lune(&self) -> (V3, V3, f64) {
        let ([ax, ay], w) = (self.alpha.map(f64::from), unit(wide(self.wi)));
        let w = [ax * w[0], ay * w[1], w[2]];
        let across = w[0].hypot(w[1]);
        let e = if across > 0.0 { [w[0] / across, w[1] / across, 0.0] } else { [1.0, 0.0, 0.0] };
        ([-e[1], e[0], 0.0], e, w[2].atan2(across) + FRAC_PI_2)
    }
    /// D(m) over the visible area per unit of the surface: (|M·wi| + wi.z)/2, of which D_v is the cosine times.
    fn per_cosine(&self, m: V3) -> f64 {
        let ([ax, ay], w) = (self.alpha.map(f64::from), unit(wide(self.wi)));
        if m[2] < 0.0 {
            return 0.0;
        }
        let l = length([m[0] / ax, m[1] / ay, m[2]]);
        let across = (ax * w[0]).hypot(ay * w[1]);
        let visible =
            if w[2] < 0.0 { across * across / (across.hypot(w[2]) - w[2]) } else { across.hypot(w[2]) + w[2] } / 2.0;
        1.0 / (PI * ax * ay * l.powi(4) * visible)
    }
}
impl Subject for GgxVisibleNormals {
    type Warp<R: Real> = warp::GgxVisibleNormals<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        let alpha = |k: usize| lanes_of(|i| of(i).alpha[k].into());
        warp::GgxVisibleNormals::new(alpha(0), alpha(1), vectors_of(|i| of(i).wi))
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::GgxVisibleNormals::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::VISIBLE_NORMALS
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { wi: self.wi.map(|x| x * factor), ..*self }
    }
    fn density(&self, m: V3) -> f64 {
        dot(m, unit(wide(self.wi))).max(0.0) * self.per_cosine(m)
    }
    fn density_slack(&self, m: V3) -> f64 {
        self.per_cosine(m)
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (a, e, width) = self.lune();
        let ((sin, cos), (z, x)) = ((s * PI).sin_cos(), (t * width).sin_cos());
        let [ax, ay] = self.alpha.map(f64::from);
        let h = [cos * a[0] + sin * x * e[0], cos * a[1] + sin * x * e[1], sin * z];
        let m = [ax * h[0], ay * h[1], h[2]];
        (unit(m), sin * PI * width * ax * ay / length(m).powi(3))
    }
    fn locate(&self, m: V3) -> [f64; 2] {
        let (a, e, width) = self.lune();
        let h = self.relaxed(m);
        let (x, y) = (dot(h, e), dot(h, a));
        [x.hypot(h[2]).atan2(y) / PI, (h[2].atan2(x) / width).clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        if random.word().is_multiple_of(2) {
            let (s, c) = random.range(0.0, TAU).sin_cos();
            return Some(unit([c, s, -margin]));
        }
        // turned away from the view by the margin
        let w = unit(wide(self.wi));
        let (a, b) = basis(w);
        let (s, c) = random.range(0.0, TAU).sin_cos();
        Some(unit(along(along(a.map(|x| x * c), b, s), w, -margin)))
    }
    fn extent(&self) -> [f64; 2] {
        [1.0; 2]
    }
    fn metric(&self, m: V3) -> V3 {
        self.relaxed(m)
    }
    fn distance(&self, a: V3, b: V3) -> f64 {
        length(sub(self.relaxed(a), self.relaxed(b)))
    }
    // the inverse goes through c = 2(w·h)h − w, whose rounding is divided by the height of the cap; and where c + w is short, the
    // rounding of the length of c turns its direction
    fn inverse_units(&self, u: [f64; 2]) -> f64 {
        let ([ax, ay], w) = (self.alpha.map(f64::from), unit(wide(self.wi)));
        let w = unit([ax * w[0], ay * w[1], w[2]]);
        let (z, (s, c)) = (1.0 - u[0] * (1.0 + w[2]), (TAU * u[1]).sin_cos());
        let sin = (1.0 - z * z).max(0.0).sqrt();
        24.0 / (1.0 + w[2]) + 16.0 / length([sin * c + w[0], sin * s + w[1], z + w[2]])
    }
    // towards the rim normals turn fast with u: beyond a five-point formula
    fn smooth(&self, u: [f64; 2]) -> bool {
        u[0] < 0.5
    }
    // is the normal one that some view, not of measure 0, can see?
    fn reachable(&self, m: V3) -> bool {
        self.density(m) > 0.0
    }
    const PERIODIC: bool = true;
}
