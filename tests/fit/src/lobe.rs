//! The reflection of a GGX surface in double precision, by the textbook's formulas and independent of the core.

use std::f64::consts::PI;

/// A vector in the frame of the surface: z is its normal, and the view lies in the half plane x > 0, y = 0.
pub(crate) type Vector = [f64; 3];

/// A GGX surface of the same roughness in all directions, seen from one direction.
#[derive(Clone, Copy)]
pub(crate) struct Ggx {
    /// Roughness α, above 0.
    pub(crate) alpha: f64,
    /// Unit vector towards the viewer, above the horizon.
    pub(crate) view: Vector,
}

/// A direction of a quadrature, with the part of the hemisphere for which it stands.
pub(crate) struct Node {
    /// Unit vector.
    pub(crate) direction: Vector,
    /// Solid angle in steradians, for both signs of y.
    pub(crate) solid_angle: f64,
    /// f cosθ of the direction with a Fresnel factor of 1, per steradian.
    pub(crate) reflected: f64,
    /// Schlick's weight (1 − v·m)⁵ for the half vector m.
    pub(crate) schlick: f64,
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

impl Ggx {
    /// The surface seen from a direction with this cosine to the normal.
    pub(crate) fn new(alpha: f64, cos: f64) -> Self {
        Self { alpha, view: [(1.0 - cos * cos).sqrt(), 0.0, cos] }
    }
    /// Smith's Λ (Heitz 2014, equation 72).
    fn lambda(&self, w: Vector) -> f64 {
        let tan = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2]);
        ((1.0 + self.alpha * self.alpha * tan).sqrt() - 1.0) / 2.0
    }
    /// f cosθ with a Fresnel factor of 1 and correlated masking and shadowing, and the pdf of a reflection about visible normals, both
    /// per steradian; and the half vector's cosine.
    pub(crate) fn evaluate(&self, w: Vector) -> [f64; 3] {
        let m = unit([0, 1, 2].map(|k| w[k] + self.view[k]));
        let square = self.alpha * self.alpha;
        let slope = (m[0] * m[0] + m[1] * m[1]) / square + m[2] * m[2];
        let normals = 1.0 / (PI * square * slope * slope);
        let (from, to) = (self.lambda(self.view), self.lambda(w));
        let all = normals / (4.0 * self.view[2]);
        [all / (1.0 + from + to), all / (1.0 + from), dot(m, self.view)]
    }
    /// The direction of a number pair reflected about a visible normal (Dupuy and Benyoub 2023), for y ≥ 0.
    fn reflect(&self, u: [f64; 2]) -> Vector {
        let stretched = unit([self.alpha * self.view[0], 0.0, self.view[2]]);
        let z = 1.0 - u[0] * (1.0 + stretched[2]);
        let (radius, azimuth) = ((1.0 - z * z).max(0.0).sqrt(), PI * u[1]);
        let cap = [radius * azimuth.cos(), radius * azimuth.sin(), z];
        let m = unit([self.alpha * (cap[0] + stretched[0]), self.alpha * cap[1], cap[2] + stretched[2]]);
        let cos = dot(m, self.view);
        [0, 1, 2].map(|k| 2.0 * cos * m[k] - self.view[k])
    }
    /// A quadrature over the hemisphere: `count`² directions by visible normals and as many by the cosine, each weighted by the sum of both
    /// densities. The pattern is shifted by `shift`, in cells.
    pub(crate) fn quadrature(&self, count: usize, shift: f64) -> Vec<Node> {
        let place = |k: usize| ((k as f64 + shift) / count as f64).fract();
        let each = (count * count) as f64;
        let mut nodes = Vec::with_capacity(2 * count * count);
        for k in 0..count * count {
            let u = [place(k / count), place(k % count)];
            let (radius, azimuth) = (u[0].sqrt(), PI * u[1]);
            let cosine = [radius * azimuth.cos(), radius * azimuth.sin(), (1.0 - u[0]).sqrt()];
            for direction in [self.reflect(u), cosine] {
                if direction[2] <= 0.0 {
                    continue;
                }
                let [reflected, pdf, cos] = self.evaluate(direction);
                let solid_angle = 1.0 / (each * (pdf + direction[2] / PI));
                nodes.push(Node { direction, solid_angle, reflected, schlick: (1.0 - cos).powi(5) });
            }
        }
        nodes
    }
}
