//! A light of each kind by each technique, each warp and each sequence.

use etendue::Vec3;
use etendue::light::*;
use etendue::sequence::*;
use etendue::warp::*;
use etendue_batch::*;

/// What is done with all of them.
pub(crate) trait Visitor {
    /// A light by the technique `T`.
    fn technique<T>(&mut self, name: &str, light: T::Light<f32>)
    where
        T: Technique + InTable<Functions = LightFunctions<T>>;
    /// A warp.
    fn warp<W>(&mut self, name: &str, warp: W)
    where
        W: BatchWarp + InTable<Functions = WarpFunctions<W>>;
    /// A sequence.
    fn sequence<S>(&mut self, name: &str, sequence: S)
    where
        S: Sequence + InTable<Functions = SequenceFunctions<S>>;
}

/// Visits all of them.
pub(crate) fn visit(visitor: &mut impl Visitor) {
    let v = Vec3::new;
    let triangle = Triangle::new(v(0.0, 1.0, 0.0), v(1.0, 1.2, 0.0), v(0.0, 1.0, 1.0));
    let panel = Parallelogram::new(v(0.0, 1.0, 0.0), v(1.0, 0.2, 0.0), v(0.0, 0.0, 1.0));
    let rectangle = Rectangle::new(v(0.0, 1.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0));
    let sphere = Sphere::new(v(0.0, 1.0, 0.0), 0.4);
    let disk = Disk::new(v(0.0, 1.5, 0.2), v(0.0, -1.0, 0.0), 0.5);
    let line = Line::new(v(0.0, 1.5, 0.2), v(1.0, 0.2, 0.0));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.5, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let polygon = Polygon::<f32, 8>::new(core::array::from_fn(|i| v(corners[i.min(4)][0], 1.0, corners[i.min(4)][1])));
    visitor.technique::<SphereByArea<f32>>("sphere by area", sphere);
    visitor.technique::<SphereBySolidAngle<f32>>("sphere by solid angle", sphere);
    visitor.technique::<SphereByProjectedSolidAngle<f32>>("sphere by projected solid angle", sphere);
    visitor.technique::<TriangleByArea<f32>>("triangle by area", triangle);
    visitor.technique::<TriangleBySolidAngle<f32>>("triangle by solid angle", triangle);
    visitor.technique::<TriangleByProjectedSolidAngle<f32>>("triangle by projected solid angle", triangle);
    visitor.technique::<TriangleByCosineWarp<f32>>("triangle by cosine warp", triangle);
    visitor.technique::<ParallelogramByArea<f32>>("parallelogram by area", panel);
    visitor.technique::<ParallelogramBySolidAngle<f32>>("parallelogram by solid angle", panel);
    visitor.technique::<ParallelogramByProjectedSolidAngle<f32>>("parallelogram by projected solid angle", panel);
    visitor.technique::<RectangleBySolidAngle<f32>>("rectangle by solid angle", rectangle);
    visitor.technique::<RectangleByCosineWarp<f32>>("rectangle by cosine warp", rectangle);
    visitor.technique::<DiskByArea<f32>>("disk by area", disk);
    visitor.technique::<DiskBySolidAngle<f32>>("disk by solid angle", disk);
    visitor.technique::<CylinderByArea<f32>>("cylinder by area", Cylinder::new(line.p, line.edge, 0.1));
    let patch = BilinearPatch::new(v(0.0, 1.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0), v(0.0, 0.3, 0.0));
    visitor.technique::<PatchByArea<f32>>("bilinear patch by area", patch);
    visitor.technique::<PolygonByArea<f32, 8>>("polygon by area", polygon);
    visitor.technique::<PolygonBySolidAngle<f32, 8>>("polygon by solid angle", polygon);
    visitor.technique::<PolygonByProjectedSolidAngle<f32, 8>>("polygon by projected solid angle", polygon);
    visitor.technique::<LineByLength<f32>>("line by length", line);
    visitor.technique::<LineByAngle<f32>>("line by angle", line);
    visitor.technique::<LineByProjectedSolidAngle<f32>>("line by projected solid angle", line);
    visitor.technique::<SunBySolidAngle<f32>>("sun by solid angle", Sun::new(v(0.0, 1.0, 0.0), 1e-5));
    visitor.warp("concentric disk", ConcentricDisk);
    visitor.warp("polar disk", PolarDisk);
    visitor.warp("uniform hemisphere", UniformHemisphere);
    visitor.warp("uniform sphere", UniformSphere);
    visitor.warp("cosine hemisphere", CosineHemisphere);
    visitor.warp("octahedral", Octahedral);
    visitor.warp("area triangle", AreaTriangle);
    visitor.warp("low-distortion triangle", LowDistortionTriangle);
    visitor.warp("cone", Cone { one_minus_cos: 0.3 });
    visitor.warp("bilinear", Bilinear { corners: [1.0, 2.0, 0.5, 3.0] });
    visitor.warp("GGX visible normals", GgxVisibleNormals::new(0.3, 0.5, v(0.6, 0.0, 0.8)));
    visitor.warp("disk surface", DiskSurface { center: sphere.center, normal: v(0.0, 0.0, 1.0), radius: 0.5 });
    visitor.warp("cylinder side", CylinderSide { p: line.p, axis: line.edge, radius: 0.1 });
    visitor.warp("sphere surface", SphereSurface { center: sphere.center, radius: 0.4 });
    let patch = PatchSurface { p: patch.p, u: v(1.0, 0.0, 0.0), v: v(0.0, 0.0, 1.0), w: v(0.0, 0.3, 0.0) };
    visitor.warp("patch surface", patch);
    visitor.warp("linear", Linear { a: 3.0, b: 1.0 });
    visitor.warp("tent", Tent { radius: 1.5 });
    visitor.warp("exponential", Exponential { rate: 2.0 });
    visitor.warp("normal", Normal { mean: 0.5, sigma: 2.0 });
    visitor.sequence("independent", Independent::new(1));
    visitor.sequence("Owen-Sobol", OwenSobol::new(1));
    visitor.sequence("joint Sobol", JointSobol::new(1));
    visitor.sequence("stratified", Stratified::new(1, 4096));
    visitor.sequence("Latin hypercube", LatinHypercube::new(1, 4096));
    visitor.sequence("lattice R2", Lattice::r2(1));
}
