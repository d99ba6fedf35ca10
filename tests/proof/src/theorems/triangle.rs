//! Directions to a triangle.

use super::{Quantity, direction, length, limit, outputs, pair, relative};
use crate::search::{Range, Statement, Theorem};
use crate::traced::Traced;
use etendue::light::TriangleBySolidAngle;
use etendue::{LightSampler, Real, Vec3};
use etendue_oracle::double_double::Dd;
use etendue_oracle::{V3, cross, dot, triangle_solid_angle, unit};

/// Triangles whose corners are near these.
pub(super) struct Triangle {
    pub(super) corners: [[f32; 3]; 3],
    /// How far each coordinate may be from that of the corner.
    pub(super) by: f32,
    pub(super) quantity: Quantity,
}
impl Triangle {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let sample = Self::prepare(x).sample(pair(x));
        direction(sample.direction).into_iter().chain([sample.pdf]).collect()
    }
    fn prepare<R: Real>(x: &[R]) -> TriangleBySolidAngle<R> {
        let v = |i: usize| Vec3::new(x[i], x[i + 1], x[i + 2]);
        etendue::Triangle::new(v(2), v(5), v(8)).by_solid_angle(Vec3::default())
    }
}
impl Theorem for Triangle {
    outputs!();
    fn statement(&self) -> Statement {
        let u = if self.quantity == Quantity::Pdf { Range::Steps(0, 0) } else { Range::UNIT };
        let corners = self.corners.iter().flatten().map(|c| Range::Linear(c - self.by, c + self.by));
        Statement {
            name: "Triangle::by_solid_angle",
            domain: format!(
                "all 2⁴⁸ pairs u, triangles whose corners are within {} of {:?} in each coordinate (and these lengths times any power of two)",
                self.by, self.corners
            ),
            ranges: [u, u].into_iter().chain(corners).collect(),
            limits: if self.quantity == Quantity::Pdf {
                vec![limit("relative error of the pdf", 4e-6)]
            } else {
                vec![limit("error of the direction, in radians", 5e-6)]
            },
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let triangle = Self::prepare(x);
        if self.quantity == Quantity::Pdf {
            return vec![relative(triangle.sample(pair(x)).pdf)];
        }
        let w = triangle.sample(pair(x)).direction;
        vec![length(&[w.x, w.y, w.z])]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let triangle = Self::prepare(x);
        let [v0, v1, v2] = [2, 5, 8].map(|i| unit([values[i], values[i + 1], values[i + 2]]));
        let total = solid_angle([v0, v1, v2]);
        let mut pairs = vec![[triangle.sample(pair(x)).pdf.exact() * total, 1.0, 1.0]];
        if self.quantity == Quantity::Direction {
            let w = triangle.sample(pair(x)).direction;
            let w = [w.x.exact(), w.y.exact(), w.z.exact()];
            // the arc from v1 through w ends on the edge from v0 to v2 at P
            let p = unit(cross(cross(v1, w), cross(v0, v2)));
            let p = if dot(p, v0) + dot(p, v2) < 0.0 { p.map(|x| -x) } else { p };
            let apart = |a: [f64; 3]| 0.5 * (0..3).map(|i| (a[i] - v1[i]).powi(2)).sum::<f64>();
            // next to v1 the direction of the arc is lost
            let near = apart(w).sqrt().max(1e-9);
            pairs.push([solid_angle([v0, v1, p]) / total, values[0], 1e-3 / near.min(1e-3)]);
            pairs.push([apart(w) / apart(p), values[1], 1.0]);
            pairs.push([dot(w, w), 1.0, 1.0]);
        }
        pairs
    }
}
fn solid_angle(corners: [V3; 3]) -> f64 {
    triangle_solid_angle(corners.map(|corner| corner.map(Dd::from)))
}
