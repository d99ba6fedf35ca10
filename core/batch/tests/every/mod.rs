//! A light of each kind by each technique, each warp and each sequence.

use etendue::Vec3;
use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::sequence::*;
use etendue::warp::*;
use etendue_batch::{PortalsByRadiance, *};

/// What is done with all of them.
pub(crate) trait Visitor {
    /// A light by the technique `T`.
    fn technique<T: BatchTechnique>(&mut self, name: &str, light: T::Light<f32>);
    /// A warp.
    fn warp<W: BatchWarp>(&mut self, name: &str, warp: W);
    /// A sequence.
    fn sequence<S>(&mut self, name: &str, sequence: S)
    where
        S: Sequence + InTable<Functions = SequenceFunctions<S>>;
}

fn v(x: f32, y: f32, z: f32) -> Vec3<f32> {
    Vec3::new(x, y, z)
}

/// A light above the origin.
trait Overhead {
    fn overhead() -> Self;
}
/// Implements it by a constructor, and passes all techniques to a visitor.
macro_rules! overhead {
    ($($light:ident $(<$n:literal>)?: $value:expr;)+) => {$(
        impl Overhead for $light<f32 $(, $n)?> {
            fn overhead() -> Self {
                $value
            }
        }
    )+};
}
overhead! {
    Sphere: Self::new(v(0.0, 1.0, 0.0), 0.4);
    Triangle: Self::new(v(0.0, 1.0, 0.0), v(1.0, 1.2, 0.0), v(0.0, 1.0, 1.0));
    Parallelogram: Self::new(v(0.0, 1.0, 0.0), v(1.0, 0.2, 0.0), v(0.0, 0.0, 1.0));
    Rectangle: Self::new(v(0.0, 1.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0));
    Disk: Self::new(v(0.0, 1.5, 0.2), v(0.0, -1.0, 0.0), 0.5);
    BilinearPatch: Self::new(v(0.0, 1.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0), v(0.0, 0.3, 0.0));
    Polygon<8>: {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.5, 1.0], [1.0, 2.0], [0.0, 2.0]];
        Self::new(core::array::from_fn(|i| v(corners[i.min(4)][0], 1.0, corners[i.min(4)][1])))
    };
    Line: Self::new(v(0.0, 1.5, 0.2), v(1.0, 0.2, 0.0));
    Sun: Self::new(v(0.0, 1.0, 0.0), 1e-5);
    PointLight: Self::new(v(0.2, 1.5, 0.1));
    SpotLight: Self { position: v(0.0, 1.5, 0.2), axis: v(0.0, -1.0, 0.0), one_minus_cos_inner: 0.1, one_minus_cos_outer: 0.5 };
    DirectionalLight: Self::new(v(0.0, 1.0, 0.0));
}
macro_rules! visit_techniques {
    ({ $visitor:ident } $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } $(reflected {
            $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_c:ident, $lobe_name:ident[$lobe_size:literal])?;
        })? by $default:literal {
            $($(#[$doc:meta])* $sampler:ident $([$n:literal])? $(= $sampler_c:ident, $name:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;)+
        }
    )+) => {
        $($(visit_techniques!(@ $visitor, $sampler<f32 $(, $n)?> $(, $name)?);)+)+
        $($(visit_techniques!(# $visitor, $lobe<f32 $(, $lobe_n)?> $(, $lobe_name)?);)?)+
    };
    // the sampler of another light
    (@ $visitor:ident, $sampler:ty) => {};
    (# $visitor:ident, $sampler:ty) => {};
    (# $visitor:ident, $sampler:ty, $name:ident) => {
        let reflected = Reflected { light: Overhead::overhead(), reflection: glossy() };
        $visitor.technique::<$sampler>(&stringify!($name).replace('_', " "), reflected);
    };
    (@ $visitor:ident, $sampler:ty, $name:ident) => {
        $visitor.technique::<$sampler>(&stringify!($name).replace('_', " "), Overhead::overhead());
    };
}

/// A glossy floor, seen from the side.
fn glossy() -> Reflection<f32> {
    Reflection::new(0.2, v(0.0, 1.0, 0.0), v(-0.6, 0.8, 0.0))
}

/// Visits lights with pictures, and the sky through two portals.
fn visit_images(visitor: &mut impl Visitor) {
    let weights: Vec<f32> = (0..15).map(|i| [0.0, 1.0, 0.3, 1e-3, 7.0][i * 7 % 5]).collect();
    let mut buffer = [0.0; Picture::buffer(5, 3)];
    let picture = Picture::build(&weights, 5, Region::Square, &mut buffer).unwrap();
    visitor.technique::<PictureByArea<'_>>("picture by area", picture.on(Overhead::overhead()));
    visitor.technique::<PictureBySolidAngle<'_>>("picture by solid angle", picture.on(Overhead::overhead()));
    let projected = "picture by projected solid angle";
    visitor.technique::<PictureByProjectedSolidAngle<'_>>(projected, picture.on(Overhead::overhead()));
    let mut buffer = [0.0; Picture::buffer(6, 4)];
    let smooth = Picture::interpolated(&weights, 5, &mut buffer).unwrap();
    visitor.technique::<PictureBySolidAngle<'_>>("interpolated picture", smooth.on(Overhead::overhead()));
    visitor.technique::<PictureOnSphereByVisibleArea<'_>>("picture on sphere", smooth.on(Overhead::overhead()));
    visitor.technique::<PictureOnPatchByVisibleArea<'_>>("picture on patch", picture.on(Overhead::overhead()));

    let mut buffer = [0; PortalTable::buffer(5, 3)];
    let tables = [PortalTable::build(&weights, 5, &mut buffer).unwrap(); 2];
    let corners = [[-0.5, 1.0, -0.5], [0.25, 1.5, 0.0]];
    let portals = corners.map(|corner| Portal::new(corner, [0.0, 0.25, 1.0], [1.0, 0.0, 0.0]).unwrap());
    let sky = PortalEnvironment::new(&portals, &tables).unwrap();
    visitor.technique::<PortalsByRadiance<'_>>("portals by radiance", sky);
}

/// Visits all of them.
pub(crate) fn visit(visitor: &mut impl Visitor) {
    etendue::techniques!(visit_techniques! { { visitor } });
    visit_images(visitor);
    let center = v(0.0, 1.0, 0.0);
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
    visitor.warp("reflection", glossy());
    let patch =
        PatchSurface { corner: center, edge_s: v(1.0, 0.0, 0.0), edge_t: v(0.0, 0.0, 1.0), diagonal: v(0.0, 0.3, 0.0) };
    visitor.warp("patch surface", patch);
    visitor.warp("linear", Linear { a: 3.0, b: 1.0 });
    visitor.warp("tent", Tent { radius: 1.5 });
    visitor.sequence("independent", Independent::new(1));
    visitor.sequence("Owen-Sobol", OwenSobol::new(1));
    visitor.sequence("joint Sobol", JointSobol::new(1));
    visitor.sequence("stratified", Stratified::new(1, 4096));
}
