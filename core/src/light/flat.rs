//! Triangles, parallelograms and rectangles.

use super::sample::direction_to;
use super::sampler::{ByArea, ByCosineWarp, ByProjectedSolidAngle, ByReflection, BySolidAngle};
use super::surface::{PlacedParallelogram, PlacedTriangle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::spherical::{
    CosineWarped, ProjectedParallelogram, ProjectedTriangle, SphericalParallelogram, SphericalRectangle,
    SphericalTriangle,
};
use crate::vector::Vec3;

lanewise! {
    /// A triangle light that emits from the side of (v1−v0)×(v2−v0).
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle) unless the light is small for its distance, where [`by_area`](Self::by_area) is
    /// cheaper and as good; [`by_projected_solid_angle`](Self::by_projected_solid_angle) has no variance on an unoccluded diffuse
    /// surface. A point in the plane of the triangle, or a triangle without area, gives pdf 0.
    ///
    /// ```
    /// use etendue::{LightSampler, Triangle, Vec2};
    /// let light = Triangle::new([0.0, 2.0, 0.0].into(), [1.0, 2.0, 0.0].into(), [0.0, 2.0, 1.0_f32].into());
    /// let sampler = light.by_solid_angle([0.0; 3].into()); // prepare once, for one shading point
    /// let s = sampler.sample(Vec2::new(0.3, 0.6));
    /// assert!(s.valid() && s.weight() == 1.0 / s.pdf);
    /// assert_eq!(sampler.pdf(s.direction), s.pdf);
    /// ```
    ///
    /// Surface coordinates (u, v): the barycentric coordinates of `v1` and `v2`, so that vertex normals interpolate as
    /// (1−u−v)·n0 + u·n1 + v·n2.
    pub struct Triangle {
        /// First vertex v0, in the coordinates of the scene.
        pub v0: Vec3<R>,
        /// Edge v1 − v0.
        pub e1: Vec3<R>,
        /// Edge v2 − v0.
        pub e2: Vec3<R>,
    }
}

impl<R: Real> Triangle<R> {
    /// The triangle with these vertices. It emits from the side on which they run counterclockwise.
    #[inline(always)]
    pub fn new(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>) -> Self {
        Self { v0, e1: v1 - v0, e2: v2 - v0 }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedTriangle<R> {
        PlacedTriangle::new(self.v0 - p, self.e1, self.e2)
    }
    #[inline(always)]
    fn spherical(&self, p: Vec3<R>) -> SphericalTriangle<R> {
        let v0 = self.v0 - p;
        SphericalTriangle::with_edges(v0, v0 + self.e1, v0 + self.e2, self.e1, self.e2)
    }
    /// Uniform over the surface, seen from the point `p`: [`AreaTriangle`](crate::warp::AreaTriangle).
    ///
    /// - pdf: distance²/(|cosθ'| A) per steradian, with A the area and θ' the angle at the light.
    /// - Greatest error of the pdf that the tests allow: (48 + 24/sinα + (36 + 24/sinα)/|cosθ'|)·2⁻²⁴ relative, with α the angle
    ///   between the edges.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> TriangleByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalTriangle`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> TriangleBySolidAngle<R> {
        BySolidAngle { surface: self.placed(p), shape: self.spherical(p) }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedTriangle`]: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the triangle is above the horizon. On an unoccluded diffuse surface every sample has the
    /// same value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> TriangleByProjectedSolidAngle<R> {
        let v0 = self.v0 - p;
        let shape = ProjectedTriangle::default();
        let mut sampler = ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape };
        sampler.shape.prepare_edges([v0, v0 + self.e1, v0 + self.e2], [self.e1, self.e2], n);
        sampler
    }
    /// In proportion to the lobe of a rough surface at the point `p`: pdf π times that of the [`Reflection`], over the projected solid angle
    /// after its map, per steradian; 0 where nothing of the triangle is above the horizon.
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> TriangleByReflection<R> {
        let [v0, e1, e2] = [self.v0 - p, self.e1, self.e2].map(|v| reflection.to_cosine(v));
        let shape = ProjectedTriangle::default();
        let mut sampler = ByReflection { reflection: *reflection, surface: self.placed(p), shape };
        sampler.shape.prepare_edges([v0, v0 + e1, v0 + e2], [e1, e2], Vec3::lit([0.0, 0.0, 1.0]));
        sampler
    }
    /// By solid angle times a bilinear approximation of the cosine to the unit normal `n` at the point `p`, [`CosineWarped`]: for diffuse
    /// surfaces where the projected solid angle costs too much. The pdf is per steradian.
    #[inline(always)]
    pub fn by_cosine_warp(&self, p: Vec3<R>, n: Vec3<R>) -> TriangleByCosineWarp<R> {
        let v0 = self.v0 - p;
        let [a, b, c] = [v0, v0 + self.e1, v0 + self.e2].map(|v| direction_to(v).direction.dot(n));
        // the map sweeps about v1, from v0 to v2
        let warped = CosineWarped::with_cosines(self.spherical(p), [b, b, a, c]);
        ByCosineWarp { surface: self.placed(p), warped }
    }
}

/// A [`Triangle`] sampled by area from a point.
pub type TriangleByArea<R> = ByArea<PlacedTriangle<R>>;
/// A [`Triangle`] sampled by solid angle from a point.
pub type TriangleBySolidAngle<R> = BySolidAngle<PlacedTriangle<R>, SphericalTriangle<R>>;
/// A [`Triangle`] sampled by projected solid angle from a point on a surface.
pub type TriangleByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedTriangle<R>, ProjectedTriangle<R>>;
/// A [`Triangle`] sampled by the lobe of a rough surface.
pub type TriangleByReflection<R> = ByReflection<R, PlacedTriangle<R>, ProjectedTriangle<R>>;
/// A [`Triangle`] sampled by the cosine warp from a point on a surface.
pub type TriangleByCosineWarp<R> = ByCosineWarp<R, PlacedTriangle<R>, SphericalTriangle<R>>;

lanewise! {
    /// A parallelogram light corner + s·edge_s + t·edge_t, s and t in [0, 1], that emits from the side of edge_s × edge_t.
    ///
    /// For rectangles whose strata should follow the edges take [`Rectangle`]. A point in the plane of the parallelogram, or a
    /// parallelogram without area, gives pdf 0. Surface coordinates: (s, t).
    ///
    /// ```
    /// use etendue::{LightSampler, Parallelogram, Vec2};
    /// let panel = Parallelogram::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
    /// let sampler = panel.by_solid_angle([0.0; 3].into());
    /// let s = sampler.sample(Vec2::new(0.3, 0.6));
    /// assert!((s.direction.y * s.distance - 2.0).abs() < 1e-6 && s.pdf == 1.0 / sampler.solid_angle());
    /// ```
    pub struct Parallelogram {
        /// Corner, in the coordinates of the scene.
        pub corner: Vec3<R>,
        /// Edge along s.
        pub edge_s: Vec3<R>,
        /// Edge along t.
        pub edge_t: Vec3<R>,
    }
}

impl<R: Real> Parallelogram<R> {
    /// The parallelogram with this corner and these edges from there.
    #[inline(always)]
    pub fn new(corner: Vec3<R>, edge_s: Vec3<R>, edge_t: Vec3<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedParallelogram<R> {
        PlacedParallelogram::new(self.corner - p, self.edge_s, self.edge_t)
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, with the error of
    /// [`Triangle::by_area`].
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> ParallelogramByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalParallelogram`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> ParallelogramBySolidAngle<R> {
        let shape = SphericalParallelogram::new(self.corner - p, self.edge_s, self.edge_t);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedParallelogram`]: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the parallelogram is above the horizon. On an unoccluded diffuse surface every sample
    /// has the same value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> ParallelogramByProjectedSolidAngle<R> {
        let shape = ProjectedParallelogram::default();
        let mut sampler = ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape };
        sampler.shape.prepare_parallelogram(self.corner - p, [self.edge_s, self.edge_t], n);
        sampler
    }
    /// In proportion to the lobe of a rough surface at the point `p`: as [`Triangle::by_reflection`].
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> ParallelogramByReflection<R> {
        let [corner, s, t] = [self.corner - p, self.edge_s, self.edge_t].map(|v| reflection.to_cosine(v));
        let shape = ProjectedParallelogram::default();
        let mut sampler = ByReflection { reflection: *reflection, surface: self.placed(p), shape };
        sampler.shape.prepare_parallelogram(corner, [s, t], Vec3::lit([0.0, 0.0, 1.0]));
        sampler
    }
}

/// A [`Parallelogram`] or a [`Rectangle`] sampled by the lobe of a rough surface.
pub type ParallelogramByReflection<R> = ByReflection<R, PlacedParallelogram<R>, ProjectedParallelogram<R>>;
/// A [`Parallelogram`] or a [`Rectangle`] sampled by area from a point.
pub type ParallelogramByArea<R> = ByArea<PlacedParallelogram<R>>;
/// A [`Parallelogram`] sampled by solid angle from a point.
pub type ParallelogramBySolidAngle<R> = BySolidAngle<PlacedParallelogram<R>, SphericalParallelogram<R>>;
/// A [`Parallelogram`] or a [`Rectangle`] sampled by projected solid angle from a point on a surface.
pub type ParallelogramByProjectedSolidAngle<R> =
    ByProjectedSolidAngle<R, PlacedParallelogram<R>, ProjectedParallelogram<R>>;

lanewise! {
    /// A rectangle light corner + s·edge_s + t·edge_t, s and t in [0, 1], with perpendicular edges, that emits from the side of
    /// edge_s × edge_t.
    ///
    /// Its map by solid angle keeps the sides of strata along the edges, for 1.7 times the cost of the [`Parallelogram`]'s. A point in
    /// the plane of the rectangle, or a rectangle without area, gives pdf 0. Surface coordinates: (s, t).
    pub struct Rectangle {
        /// Corner, in the coordinates of the scene.
        pub corner: Vec3<R>,
        /// Edge along s.
        pub edge_s: Vec3<R>,
        /// Edge along t, perpendicular to `edge_s`.
        pub edge_t: Vec3<R>,
    }
}

impl<R: Real> Rectangle<R> {
    /// The rectangle with this corner and these edges from there, which must be perpendicular.
    #[inline(always)]
    pub fn new(corner: Vec3<R>, edge_s: Vec3<R>, edge_t: Vec3<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedParallelogram<R> {
        PlacedParallelogram::new(self.corner - p, self.edge_s, self.edge_t)
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, with the error of
    /// [`Triangle::by_area`].
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> ParallelogramByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalRectangle`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> RectangleBySolidAngle<R> {
        let shape = SphericalRectangle::new(self.corner - p, self.edge_s, self.edge_t);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, as a parallelogram:
    /// [`Parallelogram::by_projected_solid_angle`].
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> ParallelogramByProjectedSolidAngle<R> {
        Parallelogram::from(*self).by_projected_solid_angle(p, n)
    }
    /// In proportion to the lobe of a rough surface at the point `p`, as a parallelogram: [`Triangle::by_reflection`].
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> ParallelogramByReflection<R> {
        Parallelogram::from(*self).by_reflection(p, reflection)
    }
    /// By solid angle times a bilinear approximation of the cosine to the unit normal `n` at the point `p`, [`CosineWarped`]: for diffuse
    /// surfaces. The pdf is per steradian.
    #[inline(always)]
    pub fn by_cosine_warp(&self, p: Vec3<R>, n: Vec3<R>) -> RectangleByCosineWarp<R> {
        let corner = self.corner - p;
        let corners = [corner, corner + self.edge_s, corner + self.edge_t, corner + self.edge_s + self.edge_t];
        let shape = SphericalRectangle::new(corner, self.edge_s, self.edge_t);
        let warped = CosineWarped::with_cosines(shape, corners.map(|v| direction_to(v).direction.dot(n)));
        ByCosineWarp { surface: self.placed(p), warped }
    }
}

impl<R> From<Rectangle<R>> for Parallelogram<R> {
    #[inline(always)]
    fn from(Rectangle { corner, edge_s, edge_t }: Rectangle<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
}

/// A [`Rectangle`] sampled by solid angle from a point.
pub type RectangleBySolidAngle<R> = BySolidAngle<PlacedParallelogram<R>, SphericalRectangle<R>>;
/// A [`Rectangle`] sampled by the cosine warp from a point on a surface.
pub type RectangleByCosineWarp<R> = ByCosineWarp<R, PlacedParallelogram<R>, SphericalRectangle<R>>;
