//! A light of each kind by each technique, each warp and each sequence.

use etendue::Vec3;
use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::sequence::*;
use etendue::warp::*;
use etendue_batch::memory::{PictureMemory, PortalMemory, PortalShape, PortalSums};
use etendue_batch::technique::{self, OnPicture};
use etendue_batch::*;

/// What is done with all of them.
pub(crate) trait Visitor {
    /// A light by the technique `T`.
    fn technique<T: Technique>(&mut self, name: &str, light: T::Light<f32>, with: T::With<f32>);
    /// A warp.
    fn warp<W: BatchWarp>(&mut self, name: &str, warp: W);
    /// A sequence.
    fn sequence<S: BatchSequence>(&mut self, name: &str, sequence: S);
}

fn v(x: f32, y: f32, z: f32) -> Vec3<f32> {
    Vec3::new(x, y, z)
}

/// Passes all techniques to a visitor.
macro_rules! visit_techniques {
    ({ $visitor:ident } $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident $fields:tt by $default:literal {
            $($(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;)+
        }
    )+) => {
        $($(
            let with = visit_techniques!(with $place);
            $visitor.technique::<technique::$technique>(&stringify!($name).replace('_', " "), etendue::example!($light $fields), with);
        )+)+
    };
    (with (p, n)) => {
        v(0.0, 1.0, 0.0)
    };
    (with (p, reflection)) => {
        glossy()
    };
    (with $place:tt) => {
        ()
    };
}

/// Passes the warps without parameters to a visitor.
macro_rules! visit_fixed_warps {
    ({ $visitor:ident } $($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $name:ident: $coordinates:literal;)+) => {$(
        visit_fixed_warps!(@ $visitor, $warp, $name $(, $r)?);
    )+};
    (@ $visitor:ident, $warp:ident, $name:ident) => {
        $visitor.warp(stringify!($name), $warp);
    };
    (@ $visitor:ident, $warp:ident, $name:ident, $r:tt) => {};
}

/// A glossy floor, seen from the side.
fn glossy() -> Reflection<f32> {
    Reflection::new(0.2, v(0.0, 1.0, 0.0), v(-0.6, 0.8, 0.0))
}

/// Visits lights with pictures, and the sky through two portals.
fn visit_images(visitor: &mut impl Visitor) {
    let weights: Vec<f32> = (0..15).map(|i| [0.0, 1.0, 0.3, 1e-3, 7.0][i * 7 % 5]).collect();
    let mut buffer = [0.0; Picture::buffer(5, 3)];
    Picture::build(&weights, 5, Region::Square, &mut buffer).unwrap();
    let picture = PictureMemory::new(&buffer, [5, 3], Region::Square).unwrap();
    let light = Parallelogram::new(v(0.0, 1.0, 0.0), v(1.0, 0.2, 0.0), v(0.0, 0.0, 1.0));
    let panel = OnPicture { picture, light };
    visitor.technique::<technique::PictureByArea<'_>>("picture by area", panel, ());
    visitor.technique::<technique::PictureBySolidAngle<'_>>("picture by solid angle", panel, ());
    let (projected, up) = ("picture by projected solid angle", v(0.0, 1.0, 0.0));
    visitor.technique::<technique::PictureByProjectedSolidAngle<'_>>(projected, panel, up);
    let mut buffer = [0.0; Picture::buffer(6, 4)];
    Picture::interpolated(&weights, 5, &mut buffer).unwrap();
    let picture = PictureMemory::interpolated(&weights, 5, &buffer).unwrap();
    visitor.technique::<technique::PictureBySolidAngle<'_>>("interpolated picture", OnPicture { picture, ..panel }, ());
    let sphere = OnPicture { picture, light: Sphere::new(v(0.0, 1.0, 0.0), 0.4) };
    visitor.technique::<technique::PictureOnSphereByVisibleArea<'_>>("picture on sphere", sphere, ());

    let mut buffer = [0; PortalTable::buffer(5, 3)];
    PortalTable::build(&weights, 5, &mut buffer).unwrap();
    let tables = [PortalSums::new(&buffer, 5).unwrap(); 2];
    let shape = |corner| PortalShape { corner, edge_s: [0.0, 0.25, 1.0], edge_t: [1.0, 0.0, 0.0] };
    let portals = [[-0.5, 1.0, -0.5], [0.25, 1.5, 0.0]].map(shape);
    let sky = PortalMemory::new(&portals, &tables).unwrap();
    visitor.technique::<technique::PortalsByRadiance<'_>>("portals by radiance", sky, ());
}

/// Visits all of them.
pub(crate) fn visit(visitor: &mut impl Visitor) {
    etendue::techniques!(visit_techniques! { { visitor } });
    visit_images(visitor);
    let center = v(0.0, 1.0, 0.0);
    etendue::warps!(visit_fixed_warps! { { visitor } });
    visitor.warp("cone", Cone { one_minus_cos: 0.3 });
    visitor.warp("bilinear", Bilinear { corners: [1.0, 2.0, 0.5, 3.0] });
    visitor.warp("GGX visible normals", GgxVisibleNormals::new(0.3, 0.5, v(0.6, 0.0, 0.8)));
    visitor.warp("reflection", glossy());
    let patch =
        PatchSurface { corner: center, edge_s: v(1.0, 0.0, 0.0), edge_t: v(0.0, 0.0, 1.0), diagonal: v(0.0, 0.3, 0.0) };
    visitor.warp("patch surface", patch);
    visitor.sequence("independent", Independent::new(1));
    visitor.sequence("Owen-Sobol", OwenSobol::new(1));
    visitor.sequence("joint Sobol", JointSobol::new(1));
    visitor.sequence("stratified", Stratified::new(1, 4096));
}
