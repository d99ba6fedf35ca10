//! Uniform solid angle sampling by the plainest form of textbooks' formulas, without guards and without care for accuracy: what a renderer writes
//! first. Vectors are arrays, angles are arc cosines, and a sphere is a cone that returns a direction alone.
//!
//! Triangles are after Arvo (1995), "Stratified Sampling of Spherical Triangles"; rectangles after Ureña, Fajardo and King (2013), "An
//! Area-Preserving Parametrization for Spherical Rectangles"; spheres after Pharr, Jakob and Humphreys (2023), "Physically Based Rendering",
//! section 6.2.4.

/// The routines over a number type.
macro_rules! textbook {
    ($name:ident, $number:ident) => {
        pub mod $name {
            use std::$number::consts::{PI, TAU};

            pub type Vector = [$number; 3];

            fn dot(a: Vector, b: Vector) -> $number {
                a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            }
            fn cross(a: Vector, b: Vector) -> Vector {
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            }
            fn add(a: Vector, b: Vector) -> Vector {
                [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
            }
            fn sub(a: Vector, b: Vector) -> Vector {
                [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
            }
            fn mul(a: Vector, s: $number) -> Vector {
                [a[0] * s, a[1] * s, a[2] * s]
            }
            fn unit(a: Vector) -> Vector {
                mul(a, 1.0 / dot(a, a).sqrt())
            }
            fn perpendicular(a: Vector, b: Vector) -> Vector {
                unit(sub(a, mul(b, dot(a, b))))
            }

            /// A direction from `p` to a triangle, and its pdf per steradian.
            pub fn triangle(corners: &[Vector; 3], p: Vector, u: [$number; 2]) -> (Vector, $number) {
                let (a, b, c) = (unit(sub(corners[0], p)), unit(sub(corners[1], p)), unit(sub(corners[2], p)));
                let (ab, bc, ca) = (unit(cross(a, b)), unit(cross(b, c)), unit(cross(c, a)));
                let cos_alpha = -dot(ab, ca);
                let alpha = cos_alpha.acos();
                let area = alpha + (-dot(bc, ab)).acos() + (-dot(ca, bc)).acos() - PI;
                let (sin, cos) = (u[0] * area - alpha).sin_cos();
                let sin_alpha = (1.0 - cos_alpha * cos_alpha).sqrt();
                let (k1, k2) = (cos - cos_alpha, sin + sin_alpha * dot(a, b));
                let q = ((k2 * cos - k1 * sin) * cos_alpha - k2) / ((k2 * sin + k1 * cos) * sin_alpha);
                let moved = add(mul(a, q), mul(perpendicular(c, a), (1.0 - q * q).max(0.0).sqrt()));
                let z = 1.0 - u[1] * (1.0 - dot(moved, b));
                let direction = add(mul(b, z), mul(perpendicular(moved, b), (1.0 - z * z).max(0.0).sqrt()));
                (direction, 1.0 / area)
            }

            /// A direction from `p` to a rectangle of a corner and two perpendicular edges, and its pdf per steradian.
            pub fn rectangle(corner: Vector, edges: [Vector; 2], p: Vector, u: [$number; 2]) -> (Vector, $number) {
                let (width, height) = (dot(edges[0], edges[0]).sqrt(), dot(edges[1], edges[1]).sqrt());
                let (x, y) = (mul(edges[0], 1.0 / width), mul(edges[1], 1.0 / height));
                let mut z = cross(x, y);
                let from = sub(corner, p);
                let mut z0 = dot(from, z);
                if z0 > 0.0 {
                    z = mul(z, -1.0);
                    z0 = -z0;
                }
                let (x0, y0) = (dot(from, x), dot(from, y));
                let (x1, y1) = (x0 + width, y0 + height);
                // the normals have one coordinate besides z, and the angles are between these
                let zz = z0 * z0;
                let [n0, n1, n2, n3] = [-y0, x1, y1, -x0].map(|e| e / (e * e + zz).sqrt());
                let (g0, g1) = ((-n0 * n1).acos(), (-n1 * n2).acos());
                let (g2, g3) = ((-n2 * n3).acos(), (-n3 * n0).acos());
                let k = TAU - g2 - g3;
                let area = g0 + g1 - k;
                let (sin, cos) = (u[0] * area + k).sin_cos();
                let f = (cos * n0 - n2) / sin;
                let c = (1.0 as $number).copysign(f) / (f * f + n0 * n0).sqrt();
                let at_x = (-(c * z0) / (1.0 - c * c).max(0.0).sqrt()).clamp(x0, x1);
                let d2 = at_x * at_x + zz;
                let (h0, h1) = (y0 / (d2 + y0 * y0).sqrt(), y1 / (d2 + y1 * y1).sqrt());
                let h = h0 + u[1] * (h1 - h0);
                let at_y = h * (d2 / (1.0 - h * h)).sqrt();
                (unit(add(mul(x, at_x), add(mul(y, at_y), mul(z, z0)))), 1.0 / area)
            }

            /// A direction from a point `p` outside of a sphere to it, and its pdf per steradian.
            pub fn sphere(center: Vector, radius: $number, p: Vector, u: [$number; 2]) -> (Vector, $number) {
                let to_center = sub(center, p);
                let squared = dot(to_center, to_center);
                let one_minus_cos_max = 1.0 - (1.0 - radius * radius / squared).max(0.0).sqrt();
                let cos = 1.0 - one_minus_cos_max * u[0];
                let sin = (1.0 - cos * cos).max(0.0).sqrt();
                let w = mul(to_center, 1.0 / squared.sqrt());
                // Duff and others (2017), "Building an Orthonormal Basis, Revisited"
                let sign = (1.0 as $number).copysign(w[2]);
                let a = -1.0 / (sign + w[2]);
                let b = w[0] * w[1] * a;
                let s = [1.0 + sign * w[0] * w[0] * a, sign * b, -sign * w[0]];
                let t = [b, sign + w[1] * w[1] * a, -w[1]];
                let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
                let direction = add(add(mul(s, sin * cos_phi), mul(t, sin * sin_phi)), mul(w, cos));
                (direction, 1.0 / (TAU * one_minus_cos_max))
            }
        }
    };
}
textbook!(single, f32);
textbook!(double, f64);
