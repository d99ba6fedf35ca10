//! A glossy surface and one square light, in double precision, by the textbook's formulas and independent of the core.

use etendue_oracle::{V3, along, cross, dot, unit};
use std::f64::consts::PI;

/// Roughness α of the surfaces.
pub const ROUGHNESSES: [f64; 6] = [0.01, 0.05, 0.1, 0.2, 0.4, 0.8];
/// Cosines of the angle between the view and the normal.
pub const COSINES: [f64; 4] = [0.95, 0.7, 0.3, 0.1];
/// Angles that the lights' sides subtend, in degrees.
pub const SIZES: [f64; 4] = [1.0, 4.0, 16.0, 64.0];

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Its middle is in the mirror direction of the view.
    Mirror,
    /// Its middle is atan(6α) beside the mirror direction, across the plane of incidence: three widths of the lobe of a view from above.
    Beside,
    /// Its middle is on the horizon, below the mirror direction: its lower half illuminates nothing.
    Horizon,
}

/// The places, each with its name.
pub const PLACES: [(Place, &str); 3] =
    [(Place::Mirror, "mirror"), (Place::Beside, "beside"), (Place::Horizon, "horizon")];

/// A surface at the origin whose normal is +z, its view, and a light of radiance 1.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Roughness α of GGX.
    pub alpha: f64,
    /// Cosine of the view's angle to the normal.
    pub cos: f64,
    /// Angle that the light's sides subtend, in degrees.
    pub size: f64,
    /// Where the light is.
    pub place: Place,
    /// Unit vector towards the viewer.
    pub view: V3,
    /// Unit vector towards the middle of the light, which is 1 unit away.
    pub middle: V3,
    /// Unit vectors along the light's sides: the first is horizontal, the second points up. Both are perpendicular to `middle`.
    pub sides: [V3; 2],
    /// Half of a side.
    pub half: f64,
}

impl Cell {
    /// A cell of the atlas.
    #[must_use]
    pub fn new(alpha: f64, cos: f64, size: f64, place: Place) -> Self {
        let sine = (1.0 - cos * cos).sqrt();
        let (view, mirror) = ([sine, 0.0, cos], [-sine, 0.0, cos]);
        let middle = match place {
            Place::Mirror => mirror,
            Place::Beside => unit(along(mirror, [0.0, 1.0, 0.0], 6.0 * alpha)),
            Place::Horizon => [-1.0, 0.0, 0.0],
        };
        let across = unit(cross([0.0, 0.0, 1.0], middle));
        let half = libm::tan(size.to_radians() / 2.0);
        Self { alpha, cos, size, place, view, middle, sides: [across, cross(middle, across)], half }
    }
    /// All cells, by roughness, then by cosine, place and size.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for (alpha, cos) in ROUGHNESSES.iter().flat_map(|&alpha| COSINES.map(|cos| (alpha, cos))) {
            for (place, _) in PLACES {
                all.extend(SIZES.map(|size| Self::new(alpha, cos, size, place)));
            }
        }
        all
    }
    /// Unit vector to the point (x, y) of the light's plane along its sides, and the solid angle there per area, in steradians.
    #[must_use]
    pub fn direction(&self, x: f64, y: f64) -> (V3, f64) {
        let square = 1.0 + x * x + y * y;
        let v = along(along(self.middle, self.sides[0], x), self.sides[1], y);
        let inverse = 1.0 / square.sqrt();
        (v.map(|c| c * inverse), inverse / square)
    }
    /// The light's least and greatest (x, y) above the horizon, which is parallel to its first side.
    #[must_use]
    pub fn above_horizon(&self) -> [[f64; 2]; 2] {
        let least = (-self.middle[2] / self.sides[1][2]).clamp(-self.half, self.half);
        [[-self.half, least], [self.half; 2]]
    }
    /// Where a mirror shows the viewer in the light's plane, if it does.
    #[must_use]
    pub fn mirrored(&self) -> Option<[f64; 2]> {
        let mirror = [-self.view[0], 0.0, self.view[2]];
        let [x, y, z] = [self.sides[0], self.sides[1], self.middle].map(|axis| dot(mirror, axis));
        (z > 0.0).then(|| [x / z, y / z])
    }
    /// The half vector of the view and `w`.
    #[must_use]
    pub fn half_vector(&self, w: V3) -> V3 {
        unit(along(self.view, w, 1.0))
    }
    /// f cosθ towards the viewer for light from `w`, per steradian: GGX with correlated masking and shadowing (Heitz 2014, equations 72 and
    /// 99), and a Fresnel factor of 1.
    #[must_use]
    pub fn reflected(&self, w: V3) -> f64 {
        let (square, half) = (self.alpha * self.alpha, self.half_vector(w));
        let [i, o] = [self.cos, w[2]];
        if o <= 0.0 {
            return 0.0;
        }
        // 1 − cos² of the half vector, without the difference
        let flat = half[0] * half[0] + half[1] * half[1];
        let density = square / (PI * (flat + square * half[2] * half[2]).powi(2));
        let root = |cos: f64| (square + (1.0 - square) * cos * cos).sqrt();
        o * density / (2.0 * (o * root(i) + i * root(o)))
    }
}
