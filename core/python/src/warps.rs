//! Maps of random numbers that need no shading point.

use crate::arrays::{Columns, FieldKind, numbers, three, together};
use crate::results::{Object, array, rows, run, zero_columns, zeros};
use etendue_batch::{Batch, BatchWarp};
use pyo3::prelude::*;

/// A map of any kind.
pub(crate) trait Mapping: Send + Sync {
    /// To how many coordinates it maps two random numbers.
    fn coordinates(&self) -> usize;
    fn sample(&self, u: [&[f32]; 2], out: [&mut [f32]; 3]);
    fn pdf(&self, points: [&[f32]; 3], out: &mut [f32]);
    fn invert(&self, points: [&[f32]; 3], out: [&mut [f32]; 2]);
}
impl<W: BatchWarp + Send + Sync> Mapping for W {
    fn coordinates(&self) -> usize {
        W::ENTRY.coordinates
    }
    fn sample(&self, u: [&[f32]; 2], out: [&mut [f32]; 3]) {
        Batch::new().warp(self, u, out);
    }
    fn pdf(&self, points: [&[f32]; 3], out: &mut [f32]) {
        Batch::new().warp_pdf(self, points, out);
    }
    fn invert(&self, points: [&[f32]; 3], out: [&mut [f32]; 2]) {
        Batch::new().warp_invert(self, points, out);
    }
}

/// A map of random numbers to points: each of its subclasses is one.
#[pyclass(module = "etendue", subclass, frozen)]
pub(crate) struct Warp {
    pub(crate) map: Box<dyn Mapping>,
}

/// The first K columns; those that are missing are empty.
fn slices<const K: usize>(columns: &[Vec<f32>]) -> [&[f32]; K] {
    core::array::from_fn(|k| columns.get(k).map_or(&[][..], Vec::as_slice))
}
/// The same to write to.
fn places<const K: usize>(columns: &mut [Vec<f32>]) -> [&mut [f32]; K] {
    let mut columns = columns.iter_mut();
    core::array::from_fn(|_| columns.next().map_or(&mut [][..], Vec::as_mut_slice))
}

impl Warp {
    fn points(&self, points: &Object<'_>) -> PyResult<(Vec<usize>, Columns)> {
        together(&[("x", FieldKind::Row(self.map.coordinates()), points)])
    }
}

#[pymethods]
impl Warp {
    /// Points for numbers u in [0, 1)², (..., 2).
    fn sample<'py>(&self, py: Python<'py>, u: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = together(&[("u", FieldKind::Units, u)])?;
        let n = columns[0].len();
        let mut out = zero_columns(self.map.coordinates(), n)?;
        run(py, n, || self.map.sample(slices(&columns), places(&mut out)));
        rows(py, &shape, &out)
    }
    /// The probability density of points x, in the measure of the warp.
    fn pdf<'py>(&self, py: Python<'py>, x: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = self.points(x)?;
        let mut out = zeros(columns[0].len())?;
        run(py, out.len(), || self.map.pdf(slices(&columns), &mut out));
        array(py, &shape, out)
    }
    /// The numbers that `sample` maps to points x.
    fn invert<'py>(&self, py: Python<'py>, x: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = self.points(x)?;
        let n = columns[0].len();
        let mut out = zero_columns(2, n)?;
        run(py, n, || self.map.invert(slices(&columns), places(&mut out)));
        rows(py, &shape, &out)
    }
}

/// The class of a warp, of numbers that build it.
macro_rules! class {
    ($(#[$doc:meta])* $name:ident($($field:ident: $kind:expr),*) |$x:ident| $build:expr) => {
        $(#[$doc])*
        #[pyclass(module = "etendue", extends = Warp, frozen)]
        pub(super) struct $name;
        #[pymethods]
        impl $name {
            #[new]
            fn new($($field: &Object<'_>),*) -> PyResult<PyClassInitializer<Self>> {
                let $x = &numbers(&[$((stringify!($field), $kind, $field)),*])?[..];
                Ok(PyClassInitializer::from(Warp { map: Box::new($build) }).add_subclass(Self))
            }
        }
    };
}
/// The warps of the core's list that have no parameters.
macro_rules! fixed {
    ($($(#[$doc:meta])* $name:ident $([$packets:tt] = $struct:ident)?, $module:ident: $coordinates:literal;)+) => {
        mod fixed {
            use super::*;
            $(fixed!(@ $(#[$doc])* #[doc = concat!("Points have ", $coordinates, " coordinates.")] $name $(, $packets)?);)+
        }
        fn add_fixed(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(fixed!(+ module, $name $(, $packets)?);)+
            Ok(())
        }
    };
    (@ $(#[$doc:meta])* $name:ident) => {
        class! { $(#[$doc])* $name() |_x| etendue::warp::$name }
    };
    (+ $module:ident, $name:ident) => {
        $module.add_class::<fixed::$name>()?;
    };
    (@ $(#[$doc:meta])* $name:ident, $packets:tt) => {};
    (+ $module:ident, $name:ident, $packets:tt) => {};
}
etendue::warps!(fixed! {});

macro_rules! warps {
    ($($(#[$doc:meta])* $name:ident $fields:tt |$x:ident| $build:expr;)+) => {
        mod classes {
            use super::*;
            $(class! { $(#[$doc])* $name $fields |$x| $build })+
        }
        /// Adds the warps to the module.
        pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            module.add_class::<Warp>()?;
            $(module.add_class::<classes::$name>()?;)+
            add_fixed(module)
        }
    };
}
use FieldKind::Number;
const POINT: FieldKind = FieldKind::Row(3);
warps! {
    /// Directions within an angle σ of +z, uniform in solid angle: (2) to (3), pdf 1/(2π(1 − cosσ)) per steradian. `one_minus_cos` is
    /// 1 − cosσ in [0, 2]; at 0 the pdf is 0.
    Cone(one_minus_cos: Number) |x| etendue::warp::Cone { one_minus_cos: x[0] };
    /// Points of the unit square with a density bilinear between the values `corners` (4) at (0, 0), (1, 0), (0, 1) and (1, 1): (2) to (2).
    /// Without a positive corner the pdf is 0.
    Bilinear(corners: FieldKind::Row(4)) |x| etendue::warp::Bilinear { corners: [x[0], x[1], x[2], x[3]] };
    /// GGX normals of roughness alpha_x and alpha_y that are visible from the direction wi (3, z up): (2) to (3), pdf
    /// 2 max(0, wi·m) / (π αx αy l⁴ (|M·wi| + wi.z)) per steradian of the normal. A mirror, α ≤ 1e-15, has pdf 0.
    GgxVisibleNormals(alpha_x: Number, alpha_y: Number, wi: POINT)
    |x| etendue::warp::GgxVisibleNormals::new(x[0], x[1], three(&x[2..]));
    /// Points of a bilinear patch (see `BilinearPatch`), nearly uniform in area: (2) to (3), exact pdf per unit area. Without area it is 0.
    PatchSurface(corner: POINT, edge_s: POINT, edge_t: POINT, diagonal: POINT)
    |x| etendue::warp::PatchSurface { corner: three(x), edge_s: three(&x[3..]), edge_t: three(&x[6..]), diagonal: three(&x[9..]) };
}
