//! The numbers of techniques, and what each takes.

use crate::memory::count_of;
use crate::picture::{
    EtenduePictureByArea, EtenduePictureByProjectedSolidAngle, EtenduePictureBySolidAngle,
    EtenduePictureOnSphereByVisibleArea,
};
use crate::portal::EtenduePortalsByRadiance;
use crate::reflection::EtendueReflectionColumns;
use core::mem::size_of;
use etendue::listed::light::{ENTRIES, With};
use etendue_batch::{Technique, technique};

/// How many of them have no memory.
pub(crate) const WITHOUT_MEMORY: usize = ENTRIES.len();

/// How many columns the light of a technique is in, and what it is prepared for beside the point; of those with memory, no columns but of the
/// light on which it is count.
pub(crate) fn columns_of(technique: usize) -> (usize, usize) {
    let Some(entry) = ENTRIES.get(technique) else {
        return (0, if technique == EtendueTechnique::PictureByProjectedSolidAngle as usize { 3 } else { 0 });
    };
    let with = match entry.with() {
        With::Nothing => 0,
        With::Normal => 3,
        With::Reflection => count_of::<EtendueReflectionColumns>(),
    };
    (entry.numbers[0], with)
}
/// The number of each technique: its place in the core's list, and those of lights with memory after that.
macro_rules! list {
    ({ $($(#[$memory_doc:meta])* $in_memory:ident: $in_memory_sampler:ty;)+ } $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns:ident { $($fields:tt)* } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        /// A light by a way to sample it. The comments say what it is uniform over, at a point p.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(C)]
        pub enum EtendueTechnique {
            $($($(#[$doc])* $technique,)+)+
            $($(#[$memory_doc])* $in_memory,)+
        }
        const _: () = {
            $($(assert!(EtendueTechnique::$technique as usize == technique::$technique::INDEX);)+)+
            $(assert!(EtendueTechnique::$in_memory as usize == <technique::$in_memory as Technique>::INDEX);)+
            $(assert!(size_of::<$in_memory_sampler>() == size_of::<<technique::$in_memory as Technique>::Prepared>());)+
        };
    };
}
etendue::techniques!(list! {
    {
        /// A flat light with a picture, by radiance times area, for lights that are small for their distance: the pdf is the pmf of the texel,
        /// over its area, times distance²/|cosθ'| per steradian, θ' at the light. 0 where the radiance is, and beyond the rim of triangles and
        /// disks.
        PictureByArea: EtenduePictureByArea;
        /// A flat light with a picture, by radiance times solid angle at the point: the pdf is the pmf of the texel over its solid angle, per
        /// steradian. 0 where the radiance is, and beyond the rim of triangles and disks.
        PictureBySolidAngle: EtenduePictureBySolidAngle;
        /// A flat light with a picture, by radiance times projected solid angle above the horizon of the unit normal n at the point: the pdf is
        /// the pmf of the texel over its projected solid angle, times cosθ, per steradian. 0 where nothing of the light is above the horizon,
        /// where the radiance is 0, and beyond the rim of triangles and disks.
        PictureByProjectedSolidAngle: EtenduePictureByProjectedSolidAngle;
        /// A sphere with a picture, by radiance times the area that is visible from the point, over the squared distance: the pdf is the pmf of
        /// the texel, over its area, times distance²/|cosθ'| per steradian, θ' at the light. From inside, texels are drawn by radiance alone.
        PictureOnSphereByVisibleArea: EtenduePictureOnSphereByVisibleArea;
        /// The sky through portals as a point sees it: from each point exactly the part is sampled that it sees, by the weights of the texels.
        /// The pdf is the probability of the cells over the solid angle that they cover there, per steradian, summed over portals; 0 where no
        /// portal is seen, and from behind. `uv` of a sample are the numbers that etendue_octahedral_sample maps to the direction.
        PortalsByRadiance: EtenduePortalsByRadiance;
        /// An image of the sky, in proportion to it, the same at every point. EtendueImageEnvironment is both the light and its sampler.
        ImageByRadiance: crate::environment::EtendueImageEnvironment;
    }
});
