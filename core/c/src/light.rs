//! Lights.

use crate::{EtendueStatus, columns, each, each_mut, outputs, refuse_null};
use core::mem::{align_of, size_of};
use etendue::light;
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, SampleColumns, Technique};

/// One sample of a light as seen from a shading point, or the point of a light that a ray hits.
///
/// The estimator of reflected radiance is f L cos(theta) weight, once a shadow ray along `direction` has reached `distance`.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct EtendueLightSample {
    /// Unit direction from the shading point to the light.
    pub direction: [f32; 3],
    /// Distance to the light along it, in the unit of the coordinates; FLT_MAX for lights at infinity.
    pub distance: f32,
    /// Probability density of the direction, per steradian (lines: per unit of their measure); 0 where there is no sample.
    pub pdf: f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: f32,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: [f32; 3],
    /// Surface coordinates of the sampled point in [0, 1]^2, for textures: of a triangle, the barycentric coordinates of its second and
    /// third vertex. Not meaningful where the pdf is 0.
    pub uv: [f32; 2],
    /// 1 where the shading point is on the side of the light that emits, which is the side of the normal, else 0.
    pub emits: u8,
}

/// Columns of samples, each NULL or of as many elements as the batch has. The fields are those of [`EtendueLightSample`].
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSampleColumns {
    /// Unit direction from the shading point to the light.
    pub direction: [*mut f32; 3],
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: *mut f32,
    /// Probability density of the direction, per steradian; 0 where there is no sample.
    pub pdf: *mut f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: *mut f32,
    /// Unit normal of the light at the sampled point.
    pub normal: [*mut f32; 3],
    /// Surface coordinates of the sampled point.
    pub uv: [*mut f32; 2],
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: *mut u8,
}

impl EtendueSampleColumns {
    fn columns(&self) -> SampleColumns {
        let Self { direction, distance, pdf, weight, normal, uv, emits } = *self;
        SampleColumns { direction, distance, pdf, weight, normal, uv, emits }
    }
}

impl EtendueLightSample {
    /// The fields of one sample as columns of one element.
    unsafe fn columns(this: *mut Self) -> SampleColumns {
        // SAFETY: the caller's memory has room for a sample
        unsafe {
            SampleColumns {
                direction: each_mut((&raw mut (*this).direction).cast()),
                distance: &raw mut (*this).distance,
                pdf: &raw mut (*this).pdf,
                weight: &raw mut (*this).weight,
                normal: each_mut((&raw mut (*this).normal).cast()),
                uv: each_mut((&raw mut (*this).uv).cast()),
                emits: &raw mut (*this).emits,
            }
        }
    }
}

pub(crate) fn vec3<T>([x, y, z]: [T; 3]) -> Vec3<T> {
    Vec3::new(x, y, z)
}
fn vec2<T>([x, y]: [T; 2]) -> Vec2<T> {
    Vec2::new(x, y)
}

/// The struct of a light, and that of columns of lights; the core's struct has the same fields.
macro_rules! light {
    ($(#[$doc:meta])* $name:ident, $columns:ident = $light:ident { $($(#[$field_doc:meta])* $field:ident: $kind:tt,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: light!(@ $kind f32),)+
        }
        /// Columns of lights: the fields are those of the light.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $columns {
            $($(#[$field_doc])* pub $field: light!(@ $kind *const f32),)+
        }
        impl $columns {
            fn all_there(&self) -> bool {
                // SAFETY: the struct consists of pointers
                let pointers = unsafe {
                    core::slice::from_raw_parts((&raw const *self).cast::<*const f32>(), size_of::<Self>() / size_of::<*const f32>())
                };
                !pointers.iter().any(|column| column.is_null())
            }
        }
        const _: () = assert!(size_of::<$name>() == size_of::<light::$light<f32>>());
        const _: () = assert!(size_of::<$columns>() == size_of::<light::$light<*const f32>>());
    };
    (@ [3] $type:ty) => { [$type; 3] };
    (@ one $type:ty) => { $type };
}
light! {
    /// A sphere that emits outwards.
    EtendueSphere, EtendueSphereColumns = Sphere {
        /// Centre, in the coordinates of the scene.
        center: [3],
        /// Radius, in the unit of the coordinates.
        radius: one,
    }
}
light! {
    /// A triangle that emits from the side of e1 x e2.
    EtendueTriangle, EtendueTriangleColumns = Triangle {
        /// First vertex, in the coordinates of the scene.
        v0: [3],
        /// Edge from the first to the second vertex.
        e1: [3],
        /// Edge from the first to the third vertex.
        e2: [3],
    }
}
light! {
    /// A parallelogram p + s u + t v, s and t in [0, 1], that emits from the side of u x v.
    EtendueParallelogram, EtendueParallelogramColumns = Parallelogram {
        /// Corner, in the coordinates of the scene.
        p: [3],
        /// Edge along s.
        u: [3],
        /// Edge along t.
        v: [3],
    }
}
light! {
    /// A rectangle p + s u + t v, s and t in [0, 1], u perpendicular to v, that emits from the side of u x v. By area, it is an
    /// [`EtendueParallelogram`].
    EtendueRectangle, EtendueRectangleColumns = Rectangle {
        /// Corner, in the coordinates of the scene.
        p: [3],
        /// Edge along s.
        u: [3],
        /// Edge along t, perpendicular to `u`.
        v: [3],
    }
}
light! {
    /// A disk that emits from the side of its normal.
    EtendueDisk, EtendueDiskColumns = Disk {
        /// Centre, in the coordinates of the scene.
        center: [3],
        /// Unit normal.
        normal: [3],
        /// Radius, in the unit of the coordinates.
        radius: one,
    }
}
light! {
    /// The side of a cylinder, which emits outwards.
    EtendueCylinder, EtendueCylinderColumns = Cylinder {
        /// Centre of one end, in the coordinates of the scene.
        p: [3],
        /// From there to the centre of the other end.
        axis: [3],
        /// Radius, in the unit of the coordinates.
        radius: one,
    }
}
light! {
    /// A bilinear patch with the corners p, p + u, p + v and p + w, the last opposite to the first.
    EtendueBilinearPatch, EtendueBilinearPatchColumns = BilinearPatch {
        /// Corner, in the coordinates of the scene.
        p: [3],
        /// From there to the next corner, s = 1.
        u: [3],
        /// From there to the other next corner, t = 1.
        v: [3],
        /// From there to the opposite corner.
        w: [3],
    }
}
light! {
    /// A line: a cylinder so thin that only its width times its radiance counts, which emits in all directions. Its samplers use the
    /// first random number alone; their pdf is per unit of sin(gamma) ds/r^2 (gamma from the line, s along it). No ray hits a line.
    EtendueLine, EtendueLineColumns = Line {
        /// One end, in the coordinates of the scene.
        p: [3],
        /// From there to the other end.
        edge: [3],
    }
}
light! {
    /// A sun: all directions within an angle of one direction.
    EtendueSun, EtendueSunColumns = Sun {
        /// Unit vector towards the centre of the sun.
        direction: [3],
        /// 1 - cos of the angle between the centre and the rim, in [0, 2]: 1.09e-5 for the sun from the earth.
        one_minus_cos: one,
    }
}

/// A convex polygon of 3 to 8 corners that emits from the side on which they run counterclockwise.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePolygon {
    /// Corners in order, in one plane, in the coordinates of the scene. A polygon with fewer than 8 corners repeats its last one.
    pub corners: [[f32; 3]; 8],
}
/// Columns of polygons: a column for each coordinate of each corner.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePolygonColumns {
    /// Corners in order. Polygons with fewer than 8 corners repeat the columns of the last one.
    pub corners: [[*const f32; 3]; 8],
}
impl EtenduePolygonColumns {
    fn all_there(&self) -> bool {
        !self.corners.iter().flatten().any(|column| column.is_null())
    }
}
const _: () = assert!(size_of::<EtenduePolygon>() == size_of::<light::Polygon<f32, 8>>());
const _: () = assert!(size_of::<EtenduePolygonColumns>() == size_of::<light::Polygon<*const f32, 8>>());

/// The functions of one technique.
macro_rules! technique {
    ($(#[$doc:meta])* $sampler:ident [$size:literal] = $type:ty, $light:ident, $columns:ident, ($($n:ident, $n_type:ty, $n_columns:ident)?),
     $prepare:ident $sample:ident $pdf:ident $invert:ident $hit:ident $once:ident
     $sample_batch:ident $pdf_batch:ident $invert_batch:ident $hit_batch:ident $each:ident) => {
        $(#[$doc])*
        ///
        /// What is inside does not concern callers: it may be copied, and used by any thread.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $sampler {
            data: [f32; $size],
        }
        const _: () = assert!(size_of::<$type>() == size_of::<$sampler>() && align_of::<$type>() <= align_of::<$sampler>());

        /// Prepares the light for a shading point.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $prepare(light: *const $light, p: *const f32, $($n: $n_type,)? out: *mut $sampler) -> EtendueStatus {
            refuse_null!(light, p, $($n,)? out);
            #[allow(unused_mut, unused_assignments)]
            let mut normal = Vec3::new(0.0, 0.0, 0.0);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                $(normal = vec3($n.cast::<[f32; 3]>().read_unaligned());)?
                let p = vec3(p.cast::<[f32; 3]>().read_unaligned());
                out.cast::<$type>().write(Batch::new().prepare::<$type>(&*light.cast(), p, normal));
            }
            EtendueStatus::Ok
        }
        /// Draws a direction for u.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $sample(sampler: *const $sampler, u: *const f32, out: *mut EtendueLightSample) -> EtendueStatus {
            refuse_null!(sampler, u, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let out = EtendueLightSample::columns(out);
                (Batch::new().functions::<$type>().sample)(&*sampler.cast(), 1, vec2(each(u)), &out);
            }
            EtendueStatus::Ok
        }
        /// The pdf with which a unit direction `w` is drawn; 0 where it misses the light, and if a pointer is NULL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pdf(sampler: *const $sampler, w: *const f32) -> f32 {
            let mut pdf = 0.0;
            if !sampler.is_null() && !w.is_null() {
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { (Batch::new().functions::<$type>().pdf)(&*sampler.cast(), 1, vec3(each(w)), &mut pdf) };
            }
            pdf
        }
        /// The random numbers `u` that are mapped to a unit direction `w`; any in [0, 1)^2 where it misses the light.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $invert(sampler: *const $sampler, w: *const f32, u: *mut f32) -> EtendueStatus {
            refuse_null!(sampler, w, u);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe { (Batch::new().functions::<$type>().invert)(&*sampler.cast(), 1, vec3(each(w)), vec2(each_mut(u))) };
            EtendueStatus::Ok
        }
        /// The nearest point of the light in a unit direction `w`, with the pdf of that direction; pdf 0 where it misses the light.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $hit(sampler: *const $sampler, w: *const f32, out: *mut EtendueLightSample) -> EtendueStatus {
            refuse_null!(sampler, w, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let out = EtendueLightSample::columns(out);
                (Batch::new().functions::<$type>().hit)(&*sampler.cast(), 1, vec3(each(w)), &out);
            }
            EtendueStatus::Ok
        }
        /// Prepares the light for a shading point and draws one direction.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $once(
            light: *const $light, p: *const f32, $($n: $n_type,)? u: *const f32, out: *mut EtendueLightSample,
        ) -> EtendueStatus {
            refuse_null!(light, p, $($n,)? u, out);
            let mut sampler = core::mem::MaybeUninit::<$sampler>::uninit();
            // SAFETY: the pointers are not null, and point to what the header says; `prepare` writes the sampler
            unsafe {
                $prepare(light, p, $($n,)? sampler.as_mut_ptr());
                $sample(sampler.as_ptr(), u, out)
            }
        }
        /// Draws a direction for each u: two columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $sample_batch(
            sampler: *const $sampler, n: usize, u: *const *const f32, out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(sampler, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some(u) = columns(u) else { return EtendueStatus::NullPointer };
                (Batch::new().functions::<$type>().sample)(&*sampler.cast(), n, vec2(u), &(*out).columns());
            }
            EtendueStatus::Ok
        }
        /// The pdf of each unit direction: three columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pdf_batch(
            sampler: *const $sampler, n: usize, w: *const *const f32, out: *mut f32,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(sampler, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some(w) = columns(w) else { return EtendueStatus::NullPointer };
                (Batch::new().functions::<$type>().pdf)(&*sampler.cast(), n, vec3(w), out);
            }
            EtendueStatus::Ok
        }
        /// The random numbers of each unit direction: three columns in, two out.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $invert_batch(
            sampler: *const $sampler, n: usize, w: *const *const f32, u: *const *mut f32,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(sampler);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let (Some(w), Some(u)) = (columns(w), outputs(u)) else { return EtendueStatus::NullPointer };
                (Batch::new().functions::<$type>().invert)(&*sampler.cast(), n, vec3(w), vec2(u));
            }
            EtendueStatus::Ok
        }
        /// The nearest point of the light in each unit direction: three columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $hit_batch(
            sampler: *const $sampler, n: usize, w: *const *const f32, out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(sampler, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some(w) = columns(w) else { return EtendueStatus::NullPointer };
                (Batch::new().functions::<$type>().hit)(&*sampler.cast(), n, vec3(w), &(*out).columns());
            }
            EtendueStatus::Ok
        }
        /// Prepares a light of its own for each shading point, and draws a direction for each u: all in columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $each(
            lights: *const $columns, n: usize, p: *const *const f32, $($n_columns: *const *const f32,)? u: *const *const f32,
            out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(lights, out);
            #[allow(unused_mut, unused_assignments)]
            let mut normals = [core::ptr::null(); 3];
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let (Some(p), Some(u), true) = (columns(p), columns(u), (*lights).all_there()) else {
                    return EtendueStatus::NullPointer;
                };
                $(
                    let Some(given) = columns($n_columns) else { return EtendueStatus::NullPointer };
                    normals = given;
                )?
                let lights = &*lights.cast::<<$type as Technique>::Light<*const f32>>();
                let each = Batch::new().functions::<$type>().sample_each;
                each(lights, n, vec3(p), vec3(normals), vec2(u), &(*out).columns());
            }
            EtendueStatus::Ok
        }
    };
}
technique!(
    /// An [`EtendueSphere`] prepared for a shading point, uniform over its surface: pdf distance^2/(|cos'| A). Wastes the samples of the far side.
    EtendueSphereByArea [7] = light::SphereByArea<f32>, EtendueSphere, EtendueSphereColumns, (),
    etendue_sphere_by_area_prepare etendue_sphere_by_area_sample etendue_sphere_by_area_pdf etendue_sphere_by_area_invert etendue_sphere_by_area_hit etendue_sphere_by_area_sample_once etendue_sphere_by_area_sample_batch etendue_sphere_by_area_pdf_batch etendue_sphere_by_area_invert_batch etendue_sphere_by_area_hit_batch etendue_sphere_by_area_sample_each
);
technique!(
    /// An [`EtendueSphere`] prepared for a shading point, uniform over the solid angle at the point: pdf 1/Omega. From inside, every direction.
    EtendueSphereBySolidAngle [20] = light::SphereBySolidAngle<f32>, EtendueSphere, EtendueSphereColumns, (),
    etendue_sphere_by_solid_angle_prepare etendue_sphere_by_solid_angle_sample etendue_sphere_by_solid_angle_pdf etendue_sphere_by_solid_angle_invert etendue_sphere_by_solid_angle_hit etendue_sphere_by_solid_angle_sample_once etendue_sphere_by_solid_angle_sample_batch etendue_sphere_by_solid_angle_pdf_batch etendue_sphere_by_solid_angle_invert_batch etendue_sphere_by_solid_angle_hit_batch etendue_sphere_by_solid_angle_sample_each
);
technique!(
    /// An [`EtendueSphere`] prepared for a shading point, uniform over the projected solid angle above the horizon of n: pdf cos(theta)/Omega'.
    EtendueSphereByProjectedSolidAngle [39] = light::SphereByProjectedSolidAngle<f32>, EtendueSphere, EtendueSphereColumns, (n, *const f32, normals),
    etendue_sphere_by_projected_solid_angle_prepare etendue_sphere_by_projected_solid_angle_sample etendue_sphere_by_projected_solid_angle_pdf etendue_sphere_by_projected_solid_angle_invert etendue_sphere_by_projected_solid_angle_hit etendue_sphere_by_projected_solid_angle_sample_once etendue_sphere_by_projected_solid_angle_sample_batch etendue_sphere_by_projected_solid_angle_pdf_batch etendue_sphere_by_projected_solid_angle_invert_batch etendue_sphere_by_projected_solid_angle_hit_batch etendue_sphere_by_projected_solid_angle_sample_each
);
technique!(
    /// An [`EtendueTriangle`] prepared for a shading point, uniform over its surface: pdf distance^2/(|cos'| A). For small, far and facing triangles.
    EtendueTriangleByArea [36] = light::TriangleByArea<f32>, EtendueTriangle, EtendueTriangleColumns, (),
    etendue_triangle_by_area_prepare etendue_triangle_by_area_sample etendue_triangle_by_area_pdf etendue_triangle_by_area_invert etendue_triangle_by_area_hit etendue_triangle_by_area_sample_once etendue_triangle_by_area_sample_batch etendue_triangle_by_area_pdf_batch etendue_triangle_by_area_invert_batch etendue_triangle_by_area_hit_batch etendue_triangle_by_area_sample_each
);
technique!(
    /// An [`EtendueTriangle`] prepared for a shading point, uniform over the solid angle at the point: pdf 1/Omega.
    EtendueTriangleBySolidAngle [84] = light::TriangleBySolidAngle<f32>, EtendueTriangle, EtendueTriangleColumns, (),
    etendue_triangle_by_solid_angle_prepare etendue_triangle_by_solid_angle_sample etendue_triangle_by_solid_angle_pdf etendue_triangle_by_solid_angle_invert etendue_triangle_by_solid_angle_hit etendue_triangle_by_solid_angle_sample_once etendue_triangle_by_solid_angle_sample_batch etendue_triangle_by_solid_angle_pdf_batch etendue_triangle_by_solid_angle_invert_batch etendue_triangle_by_solid_angle_hit_batch etendue_triangle_by_solid_angle_sample_each
);
technique!(
    /// An [`EtendueTriangle`] prepared for a shading point, uniform over the projected solid angle above the horizon of n: pdf cos(theta)/Omega'. No variance on an unoccluded diffuse surface.
    EtendueTriangleByProjectedSolidAngle [165] = light::TriangleByProjectedSolidAngle<f32>, EtendueTriangle, EtendueTriangleColumns, (n, *const f32, normals),
    etendue_triangle_by_projected_solid_angle_prepare etendue_triangle_by_projected_solid_angle_sample etendue_triangle_by_projected_solid_angle_pdf etendue_triangle_by_projected_solid_angle_invert etendue_triangle_by_projected_solid_angle_hit etendue_triangle_by_projected_solid_angle_sample_once etendue_triangle_by_projected_solid_angle_sample_batch etendue_triangle_by_projected_solid_angle_pdf_batch etendue_triangle_by_projected_solid_angle_invert_batch etendue_triangle_by_projected_solid_angle_hit_batch etendue_triangle_by_projected_solid_angle_sample_each
);
technique!(
    /// An [`EtendueTriangle`] prepared for a shading point, by solid angle times a bilinear approximation of the cosine to n.
    EtendueTriangleByCosineWarp [88] = light::TriangleByCosineWarp<f32>, EtendueTriangle, EtendueTriangleColumns, (n, *const f32, normals),
    etendue_triangle_by_cosine_warp_prepare etendue_triangle_by_cosine_warp_sample etendue_triangle_by_cosine_warp_pdf etendue_triangle_by_cosine_warp_invert etendue_triangle_by_cosine_warp_hit etendue_triangle_by_cosine_warp_sample_once etendue_triangle_by_cosine_warp_sample_batch etendue_triangle_by_cosine_warp_pdf_batch etendue_triangle_by_cosine_warp_invert_batch etendue_triangle_by_cosine_warp_hit_batch etendue_triangle_by_cosine_warp_sample_each
);
technique!(
    /// An [`EtendueParallelogram`] prepared for a shading point, uniform over its surface: pdf distance^2/(|cos'| A).
    EtendueParallelogramByArea [36] = light::ParallelogramByArea<f32>, EtendueParallelogram, EtendueParallelogramColumns, (),
    etendue_parallelogram_by_area_prepare etendue_parallelogram_by_area_sample etendue_parallelogram_by_area_pdf etendue_parallelogram_by_area_invert etendue_parallelogram_by_area_hit etendue_parallelogram_by_area_sample_once etendue_parallelogram_by_area_sample_batch etendue_parallelogram_by_area_pdf_batch etendue_parallelogram_by_area_invert_batch etendue_parallelogram_by_area_hit_batch etendue_parallelogram_by_area_sample_each
);
technique!(
    /// An [`EtendueParallelogram`] prepared for a shading point, uniform over the solid angle at the point: pdf 1/Omega.
    EtendueParallelogramBySolidAngle [132] = light::ParallelogramBySolidAngle<f32>, EtendueParallelogram, EtendueParallelogramColumns, (),
    etendue_parallelogram_by_solid_angle_prepare etendue_parallelogram_by_solid_angle_sample etendue_parallelogram_by_solid_angle_pdf etendue_parallelogram_by_solid_angle_invert etendue_parallelogram_by_solid_angle_hit etendue_parallelogram_by_solid_angle_sample_once etendue_parallelogram_by_solid_angle_sample_batch etendue_parallelogram_by_solid_angle_pdf_batch etendue_parallelogram_by_solid_angle_invert_batch etendue_parallelogram_by_solid_angle_hit_batch etendue_parallelogram_by_solid_angle_sample_each
);
technique!(
    /// An [`EtendueParallelogram`] prepared for a shading point, uniform over the projected solid angle above the horizon of n: pdf cos(theta)/Omega'.
    EtendueParallelogramByProjectedSolidAngle [549] = light::ParallelogramByProjectedSolidAngle<f32>, EtendueParallelogram, EtendueParallelogramColumns, (n, *const f32, normals),
    etendue_parallelogram_by_projected_solid_angle_prepare etendue_parallelogram_by_projected_solid_angle_sample etendue_parallelogram_by_projected_solid_angle_pdf etendue_parallelogram_by_projected_solid_angle_invert etendue_parallelogram_by_projected_solid_angle_hit etendue_parallelogram_by_projected_solid_angle_sample_once etendue_parallelogram_by_projected_solid_angle_sample_batch etendue_parallelogram_by_projected_solid_angle_pdf_batch etendue_parallelogram_by_projected_solid_angle_invert_batch etendue_parallelogram_by_projected_solid_angle_hit_batch etendue_parallelogram_by_projected_solid_angle_sample_each
);
technique!(
    /// An [`EtendueRectangle`] prepared for a shading point, uniform over the solid angle at the point, in strata that follow its edges: pdf 1/Omega.
    EtendueRectangleBySolidAngle [88] = light::RectangleBySolidAngle<f32>, EtendueRectangle, EtendueRectangleColumns, (),
    etendue_rectangle_by_solid_angle_prepare etendue_rectangle_by_solid_angle_sample etendue_rectangle_by_solid_angle_pdf etendue_rectangle_by_solid_angle_invert etendue_rectangle_by_solid_angle_hit etendue_rectangle_by_solid_angle_sample_once etendue_rectangle_by_solid_angle_sample_batch etendue_rectangle_by_solid_angle_pdf_batch etendue_rectangle_by_solid_angle_invert_batch etendue_rectangle_by_solid_angle_hit_batch etendue_rectangle_by_solid_angle_sample_each
);
technique!(
    /// An [`EtendueRectangle`] prepared for a shading point, by solid angle times a bilinear approximation of the cosine to n.
    EtendueRectangleByCosineWarp [92] = light::RectangleByCosineWarp<f32>, EtendueRectangle, EtendueRectangleColumns, (n, *const f32, normals),
    etendue_rectangle_by_cosine_warp_prepare etendue_rectangle_by_cosine_warp_sample etendue_rectangle_by_cosine_warp_pdf etendue_rectangle_by_cosine_warp_invert etendue_rectangle_by_cosine_warp_hit etendue_rectangle_by_cosine_warp_sample_once etendue_rectangle_by_cosine_warp_sample_batch etendue_rectangle_by_cosine_warp_pdf_batch etendue_rectangle_by_cosine_warp_invert_batch etendue_rectangle_by_cosine_warp_hit_batch etendue_rectangle_by_cosine_warp_sample_each
);
technique!(
    /// An [`EtendueDisk`] prepared for a shading point, uniform over its surface: pdf distance^2/(|cos'| A).
    EtendueDiskByArea [17] = light::DiskByArea<f32>, EtendueDisk, EtendueDiskColumns, (),
    etendue_disk_by_area_prepare etendue_disk_by_area_sample etendue_disk_by_area_pdf etendue_disk_by_area_invert etendue_disk_by_area_hit etendue_disk_by_area_sample_once etendue_disk_by_area_sample_batch etendue_disk_by_area_pdf_batch etendue_disk_by_area_invert_batch etendue_disk_by_area_hit_batch etendue_disk_by_area_sample_each
);
technique!(
    /// An [`EtendueDisk`] prepared for a shading point, uniform over the solid angle at the point: pdf 1/Omega.
    EtendueDiskBySolidAngle [42] = light::DiskBySolidAngle<f32>, EtendueDisk, EtendueDiskColumns, (),
    etendue_disk_by_solid_angle_prepare etendue_disk_by_solid_angle_sample etendue_disk_by_solid_angle_pdf etendue_disk_by_solid_angle_invert etendue_disk_by_solid_angle_hit etendue_disk_by_solid_angle_sample_once etendue_disk_by_solid_angle_sample_batch etendue_disk_by_solid_angle_pdf_batch etendue_disk_by_solid_angle_invert_batch etendue_disk_by_solid_angle_hit_batch etendue_disk_by_solid_angle_sample_each
);
technique!(
    /// An [`EtendueCylinder`] prepared for a shading point, uniform over its side: pdf distance^2/(|cos'| A).
    EtendueCylinderByArea [20] = light::CylinderByArea<f32>, EtendueCylinder, EtendueCylinderColumns, (),
    etendue_cylinder_by_area_prepare etendue_cylinder_by_area_sample etendue_cylinder_by_area_pdf etendue_cylinder_by_area_invert etendue_cylinder_by_area_hit etendue_cylinder_by_area_sample_once etendue_cylinder_by_area_sample_batch etendue_cylinder_by_area_pdf_batch etendue_cylinder_by_area_invert_batch etendue_cylinder_by_area_hit_batch etendue_cylinder_by_area_sample_each
);
technique!(
    /// An [`EtendueBilinearPatch`] prepared for a shading point, nearly uniform over its surface.
    EtenduePatchByArea [28] = light::PatchByArea<f32>, EtendueBilinearPatch, EtendueBilinearPatchColumns, (),
    etendue_patch_by_area_prepare etendue_patch_by_area_sample etendue_patch_by_area_pdf etendue_patch_by_area_invert etendue_patch_by_area_hit etendue_patch_by_area_sample_once etendue_patch_by_area_sample_batch etendue_patch_by_area_pdf_batch etendue_patch_by_area_invert_batch etendue_patch_by_area_hit_batch etendue_patch_by_area_sample_each
);
technique!(
    /// An [`EtenduePolygon`] prepared for a shading point, uniform over its surface: pdf distance^2/(|cos'| A).
    EtenduePolygonByArea [67] = light::PolygonByArea<f32, 8>, EtenduePolygon, EtenduePolygonColumns, (),
    etendue_polygon_by_area_prepare etendue_polygon_by_area_sample etendue_polygon_by_area_pdf etendue_polygon_by_area_invert etendue_polygon_by_area_hit etendue_polygon_by_area_sample_once etendue_polygon_by_area_sample_batch etendue_polygon_by_area_pdf_batch etendue_polygon_by_area_invert_batch etendue_polygon_by_area_hit_batch etendue_polygon_by_area_sample_each
);
technique!(
    /// An [`EtenduePolygon`] prepared for a shading point, uniform over the solid angle at the point: pdf 1/Omega.
    EtenduePolygonBySolidAngle [452] = light::PolygonBySolidAngle<f32, 8>, EtenduePolygon, EtenduePolygonColumns, (),
    etendue_polygon_by_solid_angle_prepare etendue_polygon_by_solid_angle_sample etendue_polygon_by_solid_angle_pdf etendue_polygon_by_solid_angle_invert etendue_polygon_by_solid_angle_hit etendue_polygon_by_solid_angle_sample_once etendue_polygon_by_solid_angle_sample_batch etendue_polygon_by_solid_angle_pdf_batch etendue_polygon_by_solid_angle_invert_batch etendue_polygon_by_solid_angle_hit_batch etendue_polygon_by_solid_angle_sample_each
);
technique!(
    /// An [`EtenduePolygon`] prepared for a shading point, uniform over the projected solid angle above the horizon of n: pdf cos(theta)/Omega'.
    EtenduePolygonByProjectedSolidAngle [1084] = light::PolygonByProjectedSolidAngle<f32, 8>, EtenduePolygon, EtenduePolygonColumns, (n, *const f32, normals),
    etendue_polygon_by_projected_solid_angle_prepare etendue_polygon_by_projected_solid_angle_sample etendue_polygon_by_projected_solid_angle_pdf etendue_polygon_by_projected_solid_angle_invert etendue_polygon_by_projected_solid_angle_hit etendue_polygon_by_projected_solid_angle_sample_once etendue_polygon_by_projected_solid_angle_sample_batch etendue_polygon_by_projected_solid_angle_pdf_batch etendue_polygon_by_projected_solid_angle_invert_batch etendue_polygon_by_projected_solid_angle_hit_batch etendue_polygon_by_projected_solid_angle_sample_each
);
technique!(
    /// An [`EtendueLine`] prepared for a shading point, uniform over its length.
    EtendueLineByLength [14] = light::LineByLength<f32>, EtendueLine, EtendueLineColumns, (),
    etendue_line_by_length_prepare etendue_line_by_length_sample etendue_line_by_length_pdf etendue_line_by_length_invert etendue_line_by_length_hit etendue_line_by_length_sample_once etendue_line_by_length_sample_batch etendue_line_by_length_pdf_batch etendue_line_by_length_invert_batch etendue_line_by_length_hit_batch etendue_line_by_length_sample_each
);
technique!(
    /// An [`EtendueLine`] prepared for a shading point, uniform over the angle that it subtends at the point.
    EtendueLineByAngle [31] = light::LineByAngle<f32>, EtendueLine, EtendueLineColumns, (),
    etendue_line_by_angle_prepare etendue_line_by_angle_sample etendue_line_by_angle_pdf etendue_line_by_angle_invert etendue_line_by_angle_hit etendue_line_by_angle_sample_once etendue_line_by_angle_sample_batch etendue_line_by_angle_pdf_batch etendue_line_by_angle_invert_batch etendue_line_by_angle_hit_batch etendue_line_by_angle_sample_each
);
technique!(
    /// An [`EtendueLine`] prepared for a shading point, by projected solid angle above the horizon of n.
    EtendueLineByProjectedSolidAngle [46] = light::LineByProjectedSolidAngle<f32>, EtendueLine, EtendueLineColumns, (n, *const f32, normals),
    etendue_line_by_projected_solid_angle_prepare etendue_line_by_projected_solid_angle_sample etendue_line_by_projected_solid_angle_pdf etendue_line_by_projected_solid_angle_invert etendue_line_by_projected_solid_angle_hit etendue_line_by_projected_solid_angle_sample_once etendue_line_by_projected_solid_angle_sample_batch etendue_line_by_projected_solid_angle_pdf_batch etendue_line_by_projected_solid_angle_invert_batch etendue_line_by_projected_solid_angle_hit_batch etendue_line_by_projected_solid_angle_sample_each
);
technique!(
    /// An [`EtendueSun`] prepared for a shading point, uniform over its solid angle: pdf 1/Omega, the same at every point.
    EtendueSunBySolidAngle [10] = light::SunBySolidAngle<f32>, EtendueSun, EtendueSunColumns, (),
    etendue_sun_by_solid_angle_prepare etendue_sun_by_solid_angle_sample etendue_sun_by_solid_angle_pdf etendue_sun_by_solid_angle_invert etendue_sun_by_solid_angle_hit etendue_sun_by_solid_angle_sample_once etendue_sun_by_solid_angle_sample_batch etendue_sun_by_solid_angle_pdf_batch etendue_sun_by_solid_angle_invert_batch etendue_sun_by_solid_angle_hit_batch etendue_sun_by_solid_angle_sample_each
);
