//! What of a sphere is within a polygon, as seen from a point.

use crate::double_double::{self as wide, Dd, Number};
use crate::outline::{angle, clipped, lambert_vector, perimeter};
use crate::vectors::{V3, length, unit};

/// Below this many radians, the rounding of the sums in double precision counts: they have terms of the size of 1.
const SMALL: f64 = 1e-2;

/// The directions to a sphere.
#[derive(Clone, Copy)]
pub(crate) struct Cap {
    center: V3,
    radius: f64,
    pub(crate) axis: V3,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Cap {
    pub(crate) fn new(center: V3, radius: f64) -> Self {
        let distance = length(center);
        let sin = (radius / distance).min(1.0);
        let cos = (((distance - radius) * (distance + radius)).max(0.0)).sqrt() / distance;
        Self { center, radius, axis: unit(center), sin, cos }
    }
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        angle(self.axis, other.axis) < self.sin.atan2(self.cos) + other.sin.atan2(other.cos)
    }
    /// Ω⊥ of the part of the cap in a polygon above the horizon of `n`: the sum of signed parts between the axis and each edge. Where an
    /// edge is within the cap, that is a triangle, and elsewhere a sector.
    pub(crate) fn within(&self, corners: &[V3], n: V3) -> f64 {
        let corners: Vec<V3> = clipped(corners, self.axis, 0.0).into_iter().map(unit).collect();
        if corners.is_empty() {
            return 0.0;
        }
        let small = self.sin < SMALL || perimeter(&corners) < SMALL;
        if small { self.part::<Dd>(&corners, n) } else { self.part::<f64>(&corners, n) }
    }
    /// The same of corners at the distance 1, before the point.
    fn part<T: Number>(&self, corners: &[V3], n: V3) -> f64 {
        use wide::{add, basis, cross, dot, length, normalized, sub, times};
        let (center, radius, half) = (self.center.map(T::from), T::from(self.radius), T::from(0.5));
        let distance = length(center);
        let axis = normalized(center);
        let sin = radius / distance;
        let cos = ((distance - radius) * (distance + radius)).sqrt() / distance;
        let (s, t) = basis(axis);
        let share = half * (sin.atan2(cos) - sin * cos);
        let tan_squared = sin / cos * (sin / cos);
        let corners: Vec<[T; 3]> = corners.iter().map(|v| normalized(v.map(T::from))).collect();
        let mut sum = [T::default(); 3];
        let mut take = |v: [T; 3], by: T| sum = add(sum, times(v, by));
        for (i, &p) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let edge = sub(next, p);
            // within the cone: |u + xv|² < tan²α (f + xg)²
            let (u, v) = (cross(axis, p), cross(axis, edge));
            let (f, g) = (dot(axis, p), dot(axis, edge));
            let a = dot(v, v) - tan_squared * g * g;
            let b = dot(u, v) - tan_squared * f * g;
            let c = dot(u, u) - tan_squared * f * f;
            let square = b * b - a * c;
            let mut cuts = vec![(0.0, p)];
            if square.to_f64() > 0.0 {
                let root = square.sqrt();
                let q = if b.to_f64() < 0.0 { root - b } else { -(b + root) };
                let at = |x: T| (x.to_f64(), add(p, times(edge, x)));
                let all = [(q, a), (c, q)].into_iter().filter(|(_, under)| under.to_f64() != 0.0);
                cuts.extend(all.map(|(over, under)| at(over / under)).filter(|cut| cut.0 > 0.0 && cut.0 < 1.0));
            }
            cuts.push((1.0, next));
            cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
            for pair in cuts.windows(2) {
                let middle = T::from(0.5 * (pair[0].0 + pair[1].0));
                let (from, to) = (pair[0].1, pair[1].1);
                if (a * middle * middle + (b + b) * middle + c).to_f64() < 0.0 {
                    take(lambert_vector(&[axis, from, to]), T::from(1.0));
                } else {
                    let around = |v: [T; 3]| {
                        let (x, y) = (dot(v, s), dot(v, t));
                        let size = (x * x + y * y).sqrt();
                        (x / size, y / size)
                    };
                    let ((x0, y0), (x1, y1)) = (around(from), around(to));
                    let turn = (x0 * y1 - y0 * x1).atan2(x0 * x1 + y0 * y1);
                    take(axis, half * sin * sin * turn);
                    take(s, share * (y1 - y0));
                    take(t, share * (x0 - x1));
                }
            }
        }
        dot(sum, n.map(T::from)).to_f64().abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vectors::dot;

    /// Both precisions agree on what is not small, and of a small polygon at the rim of a cap there is the share that a grid finds.
    #[test]
    fn caps_are_exact() {
        let mut greatest = 0.0_f64;
        for k in 0..2000 {
            let number = |i: u32| (f64::from(k * 17 + i) * 0.754_877_666_246_692_8).fract() * 2.0 - 1.0;
            let cap = Cap::new([0.3 * number(1), 0.3 * number(2), 2.0], 1.0 + 0.9 * number(3));
            let corner = |i: u32| unit([number(i), number(i + 1), 1.0 + number(i + 2).abs()]);
            let corners = [corner(4), corner(7), corner(11)];
            let n = unit([0.2 * number(14), 0.2 * number(15), 1.0]);
            greatest = greatest.max((cap.part::<f64>(&corners, n) - cap.part::<Dd>(&corners, n)).abs());
        }
        assert!(greatest < 1e-14, "{greatest:e}");
        let cap = Cap::new([0.0, 0.0, 2.0], 1.0);
        // the tangent of the rim's angle
        let rim = 1.0 / 3.0_f64.sqrt();
        for size in [1e-3, 1e-6, 1e-9] {
            let at = |x: f64, y: f64| [rim + (x - 0.25) * size, (y - 0.5) * size, 1.0].map(|x| 1e6 * x);
            let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
            let n = [0.0, 0.0, 1.0];
            let all = dot(lambert_vector(&corners), n).abs();
            let part = cap.within(&corners, n) / all;
            assert!((part - 0.25).abs() < size + 1e-16 / size, "{part} at {size}");
        }
    }
}
