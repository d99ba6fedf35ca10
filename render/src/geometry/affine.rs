//! Affine maps, and copies of objects that they place.

use etendue::{Real, Vec3};

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
