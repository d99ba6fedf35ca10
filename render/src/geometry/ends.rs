//! The ends of segments: what lies at the end of one, and what hides it.
//!
//! A shadow ray leaves one primitive and reaches another: both are passed over by identity. Of all others, those hide the end that the
//! segment crosses before it, by more than the rounding of its ends, measured along the normal of what is crossed. So a sheet is opaque from
//! 16 roundings of the coordinates in front of a lamp on, at any angle, and a ceiling with which a lamp is flush does not hide it.
//!
//! The bound: a segment ends where its ray, whose origin and direction are exact, meets the primitive that it reaches; so a sampler's rounding
//! moves the end along that primitive only. With ε = 2⁻²⁴, and M the greatest of the coordinates of both ends, the corners of two flat
//! surfaces that a file puts into one plane are off that plane by at most √3 εM, and those of a parallelogram, whose edges are differences of
//! corners, by √3 εM more: 5.2 εM in all. (Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", and PBR 4th
//! ed., 6.8.6, bound points in the same way; at the other end, points are lifted.)

use etendue::Vec3;
use etendue_visible::ENDS;

type V64 = Vec3<f64>;

/// More than the error of the length of a segment, relative to it: what a sampler finds at a grazing angle.
const ROUNDED: f64 = 1.0 / 1024.0;

/// A segment, in double precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) origin: V64,
    /// Of length 1 but for rounding.
    pub(crate) direction: V64,
    /// May be infinite.
    pub(crate) length: f64,
}

/// Where the end of a segment lies, as seen from its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// Behind a surface.
    Hidden,
    /// On it, but for rounding.
    Level,
    /// Before it.
    Before,
}

impl Segment {
    /// The segment on the same ray that ends where this meets the plane through a point with this normal, if that is where it ends but for
    /// the rounding of its length.
    pub(crate) fn to_plane(self, point: V64, normal: V64) -> Self {
        self.to(normal.dot(point - self.origin) / normal.dot(self.direction))
    }
    /// The same for another length.
    pub(crate) fn to(self, length: f64) -> Self {
        let is_near = (length - self.length).abs() <= ROUNDED * self.length;
        Self { length: if is_near { length } else { self.length }, ..self }
    }
    /// Where the end lies that is this much beyond a surface, along its normal.
    pub(crate) fn end(&self, beyond: f64) -> End {
        if self.length == f64::INFINITY {
            return End::Hidden;
        }
        let end = self.direction.mul_add(self.length, self.origin);
        let bound = ENDS * self.origin.max_abs().max(end.max_abs());
        if beyond > bound {
            End::Hidden
        } else if beyond >= -bound {
            End::Level
        } else {
            End::Before
        }
    }
    /// Where the end lies, of a segment that meets the plane through a point with this unit normal.
    pub(crate) fn end_at_plane(&self, point: V64, normal: V64) -> End {
        let slope = normal.dot(self.direction);
        self.end((slope * self.length - normal.dot(point - self.origin)) * slope.signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_told_by_their_height_at_any_angle() {
        for slope in [1.0, 0.1, 1e-3] {
            let direction = V64::new(f64::sqrt(1.0 - slope * slope), 0.0, slope);
            for (roundings, expected) in
                [(-9.0, End::Before), (-7.0, End::Level), (7.0, End::Level), (9.0, End::Hidden)]
            {
                let plane = V64::new(0.0, 0.0, slope - roundings / 16_777_216.0);
                let segment = Segment { origin: V64::default(), direction, length: 1.0 };
                assert_eq!(segment.end_at_plane(plane, V64::new(0.0, 0.0, 1.0)), expected, "{slope} {roundings}");
                assert_eq!(segment.end_at_plane(plane, V64::new(0.0, 0.0, -1.0)), expected, "{slope} {roundings}");
            }
        }
    }
}
