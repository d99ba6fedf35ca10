//! Whether points are on lights.

use crate::list::EtendueTechnique;
use crate::memory::vec3;
use core::ffi::c_void;
use etendue::{Vec3, light};
use etendue_batch::technique::OnPicture;

/// The same for any technique: those of one light agree.
macro_rules! lights {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns:ident { $($fields:tt)* } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        unsafe fn on_surface(technique: u32, light: *const c_void, p: Vec3<f32>) -> bool {
            // SAFETY: the caller's pointer is to a struct of this technique
            unsafe {
                match technique {
                    $(_ if [$(EtendueTechnique::$technique as u32),+].contains(&technique) => {
                        light.cast::<light::$light<f32 $(, $corners)?>>().read_unaligned().on_surface(p)
                    })+
                    _ => on_picture(technique, light, p),
                }
            }
        }
    };
}
etendue::techniques!(lights! {});

/// The same of a light with a picture.
unsafe fn on_picture(technique: u32, light: *const c_void, p: Vec3<f32>) -> bool {
    const FLAT: [EtendueTechnique; 3] = [
        EtendueTechnique::PictureByArea,
        EtendueTechnique::PictureBySolidAngle,
        EtendueTechnique::PictureByProjectedSolidAngle,
    ];
    // SAFETY: the caller's pointer is to a struct of this technique
    unsafe {
        if FLAT.iter().any(|flat| *flat as u32 == technique) {
            light.cast::<OnPicture<'_, light::Parallelogram<f32>>>().read_unaligned().light.on_surface(p)
        } else if technique == EtendueTechnique::PictureOnSphereByVisibleArea as u32 {
            light.cast::<OnPicture<'_, light::Sphere<f32>>>().read_unaligned().light.on_surface(p)
        } else {
            false
        }
    }
}

/// Whether a point is on a light of the list, or in the plane of a flat one, to within the rounding of its own computation: 16 units of the last
/// place of the greatest coordinate. True of every point of the light that was computed, about half of which are in front of it through rounding
/// and would be lit by it: pass over the light then. 0 for lights without a surface, and where the function cannot work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_on_surface(technique: u32, light: *const c_void, p: *const f32) -> i32 {
    if light.is_null() || p.is_null() {
        return 0;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { i32::from(on_surface(technique, light, vec3(p.cast::<[f32; 3]>().read_unaligned()))) }
}
