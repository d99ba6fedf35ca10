//! The forms of shapes that rays meet as such, and of lights.

use etendue::Vec3;
use etendue::occlusion::Convex;

/// The form of a shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A whole sphere; its normal points outwards.
    Sphere {
        /// Centre.
        center: [f32; 3],
        /// Radius, greater than 0.
        radius: f32,
    },
    /// The corners of a triangle; the normal is (v1 − v0) × (v2 − v0).
    Triangle([[f32; 3]; 3]),
    /// The parallelogram `p + s u + t v` for s, t in \[0,1\]; the normal is u × v.
    Parallelogram {
        /// One corner.
        p: [f32; 3],
        /// First edge from that corner.
        u: [f32; 3],
        /// Second edge from that corner.
        v: [f32; 3],
    },
}

impl Geometry {
    /// Two edges of a flat shape from one corner, in f64; `None` for a sphere.
    fn edges(&self) -> Option<[Vec3<f64>; 2]> {
        let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
        match *self {
            Self::Sphere { .. } => None,
            Self::Triangle([a, b, c]) => Some([wide(b) - wide(a), wide(c) - wide(a)]),
            Self::Parallelogram { u, v, .. } => Some([wide(u), wide(v)]),
        }
    }
    /// The shape as the core's closed forms take it. A parallelogram keeps its edges, as samplers and rays have them.
    pub fn convex(&self) -> Convex<f32> {
        match *self {
            Self::Sphere { center, radius } => Convex::Sphere { center: center.into(), radius },
            Self::Triangle([a, b, c]) => Convex::Polygon { corners: [a, b, c, c].map(Vec3::from), count: 3 },
            Self::Parallelogram { p, u, v } => Convex::Parallelogram { corner: p.into(), edges: [u.into(), v.into()] },
        }
    }
    /// Area of the surface, in squared scene units.
    pub fn area(&self) -> f64 {
        match (self, self.edges()) {
            (Self::Triangle(_), Some([u, v])) => 0.5 * u.cross(v).length(),
            (Self::Parallelogram { .. }, Some([u, v])) => u.cross(v).length(),
            (Self::Sphere { radius, .. }, _) => 4.0 * std::f64::consts::PI * f64::from(*radius).powi(2),
            (_, None) => unreachable!("only spheres lack edges"),
        }
    }
    /// A corner of a flat shape and its unit normal, in double precision; `None` for a sphere.
    pub fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        let corner = match *self {
            Self::Sphere { center, .. } => center,
            Self::Triangle([a, ..]) => a,
            Self::Parallelogram { p, .. } => p,
        };
        self.edges().map(|[u, v]| [corner.map(f64::from).into(), u.cross(v).normalize()])
    }
    /// The unit normal of a flat shape; 0 for a sphere.
    pub fn normal(&self) -> [f32; 3] {
        self.plane().map_or([0.0; 3], |[_, normal]| [normal.x as f32, normal.y as f32, normal.z as f32])
    }
    /// Least and greatest corner of the bounding box.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let around = |points: &[[f32; 3]]| {
            let least = std::array::from_fn(|k| points.iter().map(|p| p[k]).fold(f32::INFINITY, f32::min));
            let most = std::array::from_fn(|k| points.iter().map(|p| p[k]).fold(f32::NEG_INFINITY, f32::max));
            [least, most]
        };
        match *self {
            Self::Sphere { center, radius } => [center.map(|x| x - radius), center.map(|x| x + radius)],
            Self::Triangle(corners) => around(&corners),
            Self::Parallelogram { p, u, v } => {
                let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| a[k] + b[k]);
                around(&[p, add(p, u), add(p, v), add(add(p, u), v)])
            }
        }
    }
}
