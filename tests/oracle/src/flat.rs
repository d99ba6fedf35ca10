//! Solid angles of triangles, and their map by definition, in 106 bits.

use crate::double_double::{Dd, Dd3, add, cross, determinant, dot, length, narrow, normalized, times};
use crate::vectors::V3;

/// Solid angle of a triangle from its vertices: accurate to 1e−13 for shapes down to 1e−9 of the distance.
#[must_use]
pub fn triangle_solid_angle([a, b, c]: [Dd3; 3]) -> f64 {
    solid_angle(a, b, c, determinant(a, b, c)).to_f64()
}

/// Solid angle of a triangle with corners a, b, c and a·(b×c) = `volume`, by Van Oosterom and Strackee.
fn solid_angle(a: Dd3, b: Dd3, c: Dd3, volume: Dd) -> Dd {
    let [la, lb, lc] = [a, b, c].map(length);
    let under = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    Dd::from(2.0) * volume.abs().atan2(under)
}

/// A triangle and Arvo's map about its vertex `v1`: the area swept from `v0` is u₀Ω, and 1−cos of the angle from `v1` is the fraction u₁
/// of its greatest value.
#[derive(Clone, Debug)]
pub struct Fan {
    units: [Dd3; 3],
    /// tan(Ω/2) = g0/(g1+g2)
    g: [Dd; 3],
    /// Solid angle in steradians, unrounded.
    pub solid_angle: Dd,
}
impl Fan {
    /// The triangle of a vertex and the edges to the other two.
    #[must_use]
    pub fn new(v0: Dd3, e1: Dd3, e2: Dd3) -> Self {
        let (v1, v2) = (add(v0, e1), add(v0, e2));
        // from edges: the volume of a small triangle is a product, not a difference
        let volume = dot(v0, cross(e1, e2));
        let units = [v0, v1, v2].map(normalized);
        let lengths = length(v0) * length(v1) * length(v2);
        let one = Dd::from(1.0);
        let g0 = if lengths.to_f64() > 0.0 { volume.abs() / lengths } else { Dd::default() };
        let g = [g0, dot(add(units[0], units[1]), units[2]), one + dot(units[0], units[1])];
        let touches = g0.to_f64() <= 0.0;
        let omega = if touches { Dd::default() } else { solid_angle(v0, v1, v2, volume) };
        Self { units, g, solid_angle: omega }
    }
    /// Solid angle in steradians.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle.to_f64()
    }
    /// Unit vector to the point of the edge `v0 v2` for `u₀`.
    #[must_use]
    pub fn swept(&self, u0: Dd) -> Dd3 {
        // near v2 the remaining angle is small
        let (s, c) = (Dd::from(0.5) * u0 * self.solid_angle).sin_cos();
        let [a, _, b] = self.units;
        let alpha = self.g[0] * c - self.g[1] * s;
        let beta = self.g[2] * s;
        let both = beta * (alpha + beta * dot(a, b));
        normalized(add(times(a, (alpha - beta) * (alpha + beta)), times(b, both + both)))
    }
    /// The direction for `u`.
    #[must_use]
    pub fn at(&self, u: (Dd, f64)) -> V3 {
        let (p, apex) = (self.swept(u.0), self.units[1]);
        let (normal, cos) = (cross(apex, p), dot(apex, p));
        let one = Dd::from(1.0);
        let versine = if cos.to_f64() > 0.0 { dot(normal, normal) / (one + cos) } else { one - cos };
        let k = Dd::from(u.1) * versine;
        let tangent = normalized(cross(normal, apex));
        let sin = (k * (Dd::from(2.0) - k)).sqrt();
        narrow(add(times(apex, one - k), times(tangent, sin)))
    }
    /// Solid angle up to the point [`swept`](Self::swept) for `u₀`, which is u₀Ω if the map is correct.
    #[must_use]
    pub fn area_swept(&self, u0: f64) -> f64 {
        let p = self.swept(Dd::from(u0));
        let [a, b, _] = self.units;
        solid_angle(a, b, p, dot(p, cross(a, b))).to_f64()
    }
}
