//! The forms of shapes that rays meet as such, and of lights.

use etendue::occlusion::Convex;
use etendue::{Real, Vec3};

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

/// Least and greatest coordinates of points.
pub fn bounds_of(points: &[[f32; 3]]) -> [[f32; 3]; 2] {
    points.iter().fold([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]], |[low, high], p| {
        [std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k]))]
    })
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
        match *self {
            Self::Sphere { center, radius } => [center.map(|x| x - radius), center.map(|x| x + radius)],
            Self::Triangle(corners) => bounds_of(&corners),
            Self::Parallelogram { p, u, v } => {
                let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| a[k] + b[k]);
                bounds_of(&[p, add(p, u), add(p, v), add(add(p, u), v)])
            }
        }
    }
}

/// An affine map in single precision: the rows of the linear part, each followed by its part of the shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine(pub [[f32; 4]; 3]);

impl Affine {
    /// The image of a point.
    #[inline(always)]
    pub fn point<R: Real<Scalar = f32>>(&self, p: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.0.map(|[a, b, c, d]| {
            p.x.mul_add(R::splat(a), p.y.mul_add(R::splat(b), p.z.mul_add(R::splat(c), R::splat(d))))
        });
        Vec3::new(x, y, z)
    }
    /// The image of a vector.
    #[inline(always)]
    pub fn vector<R: Real<Scalar = f32>>(&self, v: Vec3<R>) -> Vec3<R> {
        let [x, y, z] =
            self.0.map(|[a, b, c, _]| v.x.mul_add(R::splat(a), v.y.mul_add(R::splat(b), v.z * R::splat(c))));
        Vec3::new(x, y, z)
    }
    /// The rows of the linear part in double precision.
    fn rows(&self) -> [Vec3<f64>; 3] {
        self.0.map(|[a, b, c, _]| Vec3::new(a, b, c).map(f64::from))
    }
    /// The cofactors of the linear part: they map normals, but for their lengths.
    pub fn cofactors(&self) -> [Vec3<f64>; 3] {
        let [a, b, c] = self.rows();
        [b.cross(c), c.cross(a), a.cross(b)]
    }
    /// The determinant of the linear part.
    pub fn determinant(&self) -> f64 {
        self.rows()[0].dot(self.cofactors()[0])
    }
    /// The inverse, rounded to single precision; `None` if the map is singular, or nearly so.
    pub fn inverse(&self) -> Option<Self> {
        let (cofactors, det) = (self.cofactors(), self.determinant());
        let [x, y, z] = cofactors.map(|row| row * (1.0 / det));
        let shift = self.0.map(|row| f64::from(row[3]));
        let row =
            |[a, b, c]: [f64; 3]| [a as f32, b as f32, c as f32, -(a * shift[0] + b * shift[1] + c * shift[2]) as f32];
        let inverse = Self([row([x.x, y.x, z.x]), row([x.y, y.y, z.y]), row([x.z, y.z, z.z])]);
        inverse.0.as_flattened().iter().all(|x| x.is_finite()).then_some(inverse)
    }
    /// The greatest magnitude of a coordinate of the image of a vector of length 1.
    pub fn greatest(&self) -> f64 {
        self.rows().map(Vec3::length).into_iter().fold(0.0, f64::max)
    }
}

/// A copy of an object, which shares its triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the object.
    pub object: u32,
    /// From the space of the object to world space.
    pub to_world: Affine,
}

impl Instance {
    /// The corners in world space of a box around the object, given by its least and greatest coordinates.
    pub fn corners(&self, bounds: [[f32; 3]; 2]) -> [[f32; 3]; 8] {
        std::array::from_fn(|k| {
            let [x, y, z] = std::array::from_fn(|axis| bounds[k >> axis & 1][axis]);
            self.to_world.point(Vec3::new(x, y, z)).into()
        })
    }
}
