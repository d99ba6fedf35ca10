//! Exact results for a light seen from the origin: what the judge knows of it, and the core's own map in double precision, whose directions,
//! densities and inverses the properties compare with definitions.

use crate::pose::ShapeKind;
use etendue::LightSampler;
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::{Fixture, sample_at};
use etendue_judge::lights::definition::Definition;
use etendue_oracle::{V3, dot, unit, wide};

/// The exact results for one light.
pub struct Truth {
    map: Box<dyn LightSampler<f64>>,
    /// The coordinate of the square that is an azimuth.
    periodic: Option<usize>,
    /// The light as it is seen.
    pub seen: Definition,
    /// Solid angle, or projected solid angle, in steradians.
    pub measure: f64,
    projected: bool,
    has_rounded_corners: bool,
    towards: V3,
}

impl Truth {
    /// The exact results for a kind of shape; `None` if there is no shape: rounding the corners of a polygon may leave it no longer convex as
    /// seen from the viewpoint, where that is nearer to the plane than the rounding.
    #[must_use]
    pub fn new(kind: ShapeKind, light: &AreaLight) -> Option<Self> {
        let seen = Definition::new(light).filter(Definition::is_convex)?;
        let projected = kind.projected();
        let AreaLight { shape, a, b, c, n, .. } = *light;
        let part = if shape == LightShape::Triangle { 1.0 / 3.0 } else { 0.5 };
        let middle = match shape {
            LightShape::Sphere | LightShape::Disk => wide(a),
            _ => core::array::from_fn(|i| f64::from(a[i]) + part * (f64::from(b[i]) + f64::from(c[i]))),
        };
        let towards = if middle == [0.0; 3] { unit(wide(n)) } else { unit(middle) };
        let measure = match projected {
            false => seen.solid_angle,
            // from its plane, Lambert's sum has half of the hemisphere on either side
            true if seen.solid_angle > 0.0 => seen.irradiance(seen.normal()),
            true => 0.0,
        };
        let periodic = match shape {
            LightShape::Sphere if !projected => Some(1),
            LightShape::Disk => Some(0),
            _ => None,
        };
        let (map, has_rounded_corners) = (AreaLight::prepare(&[*light]), shape == LightShape::Polygon);
        Some(Self { map, periodic, seen, measure, projected, has_rounded_corners, towards })
    }

    /// The direction for `u`.
    #[must_use]
    pub fn direction(&self, u: [f64; 2]) -> V3 {
        sample_at(&*self.map, u)
    }

    /// Normal of the receiver whose irradiance is estimated: that of projected shapes; otherwise it faces the light.
    #[must_use]
    pub fn receiver(&self) -> V3 {
        if self.projected { self.seen.normal() } else { self.towards }
    }

    /// Whether this coordinate of u is an azimuth.
    #[must_use]
    pub fn periodic(&self, axis: usize) -> bool {
        self.periodic == Some(axis)
    }

    /// The pdf at a direction of the shape, and its change per radian of error of the direction.
    #[must_use]
    pub fn pdf(&self, w: V3) -> [f64; 2] {
        if self.projected {
            [dot(w, self.seen.normal()).max(0.0) / self.measure, 1.0 / self.measure]
        } else {
            [1.0 / self.measure, 0.0]
        }
    }
    /// The same for a technique by area; zeros where nothing is known: the corners of a polygon are rounded.
    #[must_use]
    pub fn pdf_by_area(&self, w: V3) -> [f64; 2] {
        let pdf = self.seen.density(Measure::Area, w).filter(|pdf| *pdf < 1e36 && !self.has_rounded_corners);
        let pdf = pdf.unwrap_or(0.0);
        [pdf, pdf * self.seen.steepness(Measure::Area, w)]
    }
}
