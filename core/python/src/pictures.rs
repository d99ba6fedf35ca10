//! Pictures on lights.

use crate::arrays::{Image, point};
use crate::each::{Beside, Given, Rows, with_each};
use crate::lights;
use crate::results::{Object, refuse, table};
use crate::samplers::{Call, Prepared, Sampler};
use crate::samples::Wanted;
use etendue::Vec3;
use etendue::light::{self, FlatLight, Region};
use etendue_batch::memory::PictureMemory;
use etendue_batch::technique::{
    OnPicture, PictureByArea, PictureByProjectedSolidAngle, PictureBySolidAngle, PictureOnSphereByVisibleArea,
};
use etendue_batch::{Batch, Evaluations, Technique};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::sync::Arc;

/// The table of a picture, which samplers share.
#[derive(Clone)]
struct PictureTable {
    table: Arc<Vec<f32>>,
    /// The radiance between which it is interpolated, if it is.
    values: Option<Arc<Vec<f32>>>,
    size: [usize; 2],
    region: Region,
}

impl PictureTable {
    fn picture(&self) -> PictureMemory<'_> {
        let picture = match &self.values {
            Some(values) => PictureMemory::interpolated(values, self.size[0], &self.table),
            None => PictureMemory::new(&self.table, self.size, self.region),
        };
        picture.expect("the table was built for this size")
    }
}

/// A picture for lights: texels are drawn in proportion to their radiance times their area, solid angle or projected solid angle as seen from
/// a shading point.
///
/// `weights` (height, width) are finite, not negative and not all 0, in any unit: the mean radiance of each texel, its luminance or the sum of
/// its channels. Columns are u, rows v, of the surface coordinates of the light; of a sphere, columns are heights from −1 to 1, and rows
/// azimuths. `region` is the part of the unit square that the light covers: "square", "triangle" (u + v < 1) or "disk" (the inscribed one).
/// `Picture.interpolated` makes one that is interpolated between the centres of its texels.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Picture {
    table: PictureTable,
}

#[pymethods]
impl Picture {
    #[new]
    #[pyo3(signature = (weights, region="square"))]
    fn new(py: Python<'_>, weights: &Object<'_>, region: &str) -> PyResult<Self> {
        let region = match region {
            "square" => Region::Square,
            "triangle" => Region::Triangle,
            "disk" => Region::Disk,
            _ => refuse!("region must be \"square\", \"triangle\" or \"disk\", not \"{region}\""),
        };
        let Image { weights, width, height } = Self::image("weights", weights)?;
        let table = table(py, light::Picture::buffer(width, height), |table| {
            light::Picture::build(&weights, width, region, table).map(|_| ())
        })?;
        Ok(Self { table: PictureTable { table: Arc::new(table), values: None, size: [width, height], region } })
    }
    /// A picture that is interpolated bilinearly between the `values` (height, width) at the centres of its texels, and continued by its
    /// outermost ones: the pdf is in proportion to the interpolated radiance. For lights that cover the whole unit square.
    #[staticmethod]
    fn interpolated(py: Python<'_>, values: &Object<'_>) -> PyResult<Self> {
        let Image { weights: values, width, height } = Self::image("values", values)?;
        let table = table(py, light::Picture::buffer(width + 1, height + 1), |table| {
            light::Picture::interpolated(&values, width, table).map(|_| ())
        })?;
        let (table, values, size) = (Arc::new(table), Some(Arc::new(values)), [width, height]);
        Ok(Self { table: PictureTable { table, values, size, region: Region::Square } })
    }
    /// The picture on a Rectangle, Parallelogram, Triangle, Disk or Sphere, which must cover the region for which it was built.
    fn on(&self, light: &Object<'_>) -> PyResult<Pictured> {
        let (shape, region) = if let Ok(light) = light.cast::<lights::Parallelogram>() {
            (Shape::Flat(lights::Parallelogram::build(&light.get().numbers)), Region::Square)
        } else if let Ok(light) = light.cast::<lights::Rectangle>() {
            (Shape::Flat(lights::Rectangle::build(&light.get().numbers).coordinates()), Region::Square)
        } else if let Ok(light) = light.cast::<lights::Triangle>() {
            (Shape::Flat(lights::Triangle::build(&light.get().numbers).coordinates()), Region::Triangle)
        } else if let Ok(light) = light.cast::<lights::Disk>() {
            (Shape::Flat(lights::Disk::build(&light.get().numbers).coordinates()), Region::Disk)
        } else if let Ok(light) = light.cast::<lights::Sphere>() {
            (Shape::Sphere(lights::Sphere::build(&light.get().numbers)), Region::Square)
        } else {
            let message = "light must be a Rectangle, Parallelogram, Triangle, Disk or Sphere";
            return Err(PyTypeError::new_err(format!("{message}, not {}", light.get_type().name()?)));
        };
        if region != self.table.region {
            let name = |region| match region {
                Region::Square => "square",
                Region::Triangle => "triangle",
                Region::Disk => "disk",
            };
            let [own, wanted] = [self.table.region, region].map(name);
            refuse!("the picture is for the region \"{own}\", and the light covers \"{wanted}\"");
        }
        Ok(Pictured { table: self.table.clone(), shape })
    }
    fn __repr__(&self) -> String {
        let [width, height] = self.table.size;
        format!("<etendue.Picture of {width} x {height} texels>")
    }
}

impl Picture {
    /// An image whose table the core can build.
    fn image(name: &'static str, object: &Object<'_>) -> PyResult<Image> {
        let image = Image::new(name, object)?;
        let most = 1 << 24;
        if image.width.max(image.height) >= most || (image.width + 1) * (image.height + 1) > u32::MAX as usize / 2 {
            refuse!("{name} must have less than 2**24 rows and columns, and 2**31 texels");
        }
        Ok(image)
    }
}

/// A light that a picture is on.
#[derive(Clone, Copy)]
enum Shape {
    /// A flat one, by its surface coordinates.
    Flat(light::Parallelogram<f32>),
    Sphere(light::Sphere<f32>),
}

/// What texels are drawn by, besides radiance.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Area,
    SolidAngle,
    ProjectedSolidAngle,
    VisibleArea,
}
const NAMES: [(&str, By); 4] = [
    ("area", By::Area),
    ("solid_angle", By::SolidAngle),
    ("projected_solid_angle", By::ProjectedSolidAngle),
    ("visible_area", By::VisibleArea),
];

/// A light with a picture: `Picture.on` makes it.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Pictured {
    table: PictureTable,
    shape: Shape,
}

/// A light with a picture, prepared for a shading point.
struct Placed {
    table: PictureTable,
    shape: Shape,
    by: By,
    p: Vec3<f32>,
    n: Vec3<f32>,
}

/// What is done with a light with a picture by the technique `T`.
trait Work {
    type Result;
    fn by<T>(self, light: T::Light<f32>) -> Self::Result
    where
        T: Technique<Light<f32>: Send + Sync, With<f32>: Beside>;
}
/// The answer for a shading point and a normal there.
struct Answer<'a> {
    p: Vec3<f32>,
    n: Vec3<f32>,
    call: Call,
    at: &'a [&'a [f32]],
    out: Evaluations<'a>,
}
impl Work for Answer<'_> {
    type Result = ();
    fn by<T>(self, light: T::Light<f32>)
    where
        T: Technique<Light<f32>: Send + Sync, With<f32>: Beside>,
    {
        let mut normal = [self.n.x, self.n.y, self.n.z].into_iter();
        let with = T::map_with(T::With::<f32>::default(), |_| normal.next().expect("a picture needs no more"));
        self.call.answer(&Batch::new().prepare::<T>(&light, self.p, with), self.at, self.out);
    }
}
impl<'py> Work for Rows<'_, 'py> {
    type Result = PyResult<Object<'py>>;
    fn by<T>(self, light: T::Light<f32>) -> Self::Result
    where
        T: Technique<Light<f32>: Send + Sync, With<f32>: Beside>,
    {
        Rows::by::<T>(self, light, &[])
    }
}
impl Shape {
    /// Does the work by the technique that is for this light.
    fn by<W: Work>(self, by: By, picture: PictureMemory<'_>, work: W) -> W::Result {
        match (self, by) {
            (Self::Sphere(light), _) => work.by::<PictureOnSphereByVisibleArea<'_>>(OnPicture { picture, light }),
            (Self::Flat(light), By::Area) => work.by::<PictureByArea<'_>>(OnPicture { picture, light }),
            (Self::Flat(light), By::ProjectedSolidAngle) => {
                work.by::<PictureByProjectedSolidAngle<'_>>(OnPicture { picture, light })
            }
            (Self::Flat(light), _) => work.by::<PictureBySolidAngle<'_>>(OnPicture { picture, light }),
        }
    }
    fn is_for(self, by: By) -> bool {
        matches!(self, Self::Flat(_)) == (by != By::VisibleArea)
    }
}

impl Prepared for Placed {
    fn answer(&self, call: Call, at: &[&[f32]], out: Evaluations<'_>) {
        let Self { table, shape, by, p, n } = self;
        shape.by(*by, table.picture(), Answer { p: *p, n: *n, call, at, out });
    }
}

impl Pictured {
    fn sampler(&self, by: By, name: &'static str, p: &Object<'_>, n: Option<&Object<'_>>) -> PyResult<Sampler> {
        if !self.shape.is_for(by) {
            let kinds = ["flat lights", "spheres"];
            let [own, other] = if by == By::VisibleArea { [1, 0] } else { [0, 1] }.map(|k| kinds[k]);
            return Err(PyTypeError::new_err(format!("pictures {name} are for {own}, not for {other}")));
        }
        let n = n.map_or(Ok(Vec3::default()), Beside::one)?;
        let placed = Placed { table: self.table.clone(), shape: self.shape, by, p: point(p)?, n };
        Ok(Sampler::new(Box::new(placed), name, None))
    }
    fn each<'py>(&self, by: Option<&str>, rows: Rows<'_, 'py>) -> PyResult<Object<'py>> {
        let own: Vec<_> = NAMES.into_iter().filter(|(_, by)| self.shape.is_for(*by)).collect();
        let by = by.unwrap_or(if own.len() > 1 { "solid_angle" } else { "visible_area" });
        let Some((_, by)) = own.iter().find(|(name, _)| *name == by) else {
            let names: Vec<_> = own.iter().map(|(name, _)| name).collect();
            refuse!("by must be one of {names:?}, not {by:?}");
        };
        self.shape.by(*by, self.table.picture(), rows)
    }
}

with_each! { Pictured {
    /// By radiance times area, for flat lights that are small for their distance: the pdf is the pmf of the texel, over its area, times
    /// distance²/|cosθ'| per steradian, θ' at the light.
    fn by_area(&self, p: &Object<'_>) -> PyResult<Sampler> {
        self.sampler(By::Area, "by_area", p, None)
    }
    /// By radiance times solid angle at the point p, for flat lights: the pdf is the pmf of the texel over its solid angle, per steradian.
    fn by_solid_angle(&self, p: &Object<'_>) -> PyResult<Sampler> {
        self.sampler(By::SolidAngle, "by_solid_angle", p, None)
    }
    /// By radiance times projected solid angle above the horizon of the unit normal n at the point p, for flat lights: the pdf is the pmf of the
    /// texel over its projected solid angle, times cosθ, per steradian.
    fn by_projected_solid_angle(&self, p: &Object<'_>, n: &Object<'_>) -> PyResult<Sampler> {
        self.sampler(By::ProjectedSolidAngle, "by_projected_solid_angle", p, Some(n))
    }
    /// By radiance times the area that is visible from the point p, over the squared distance, for spheres: the pdf is per steradian.
    fn by_visible_area(&self, p: &Object<'_>) -> PyResult<Sampler> {
        self.sampler(By::VisibleArea, "by_visible_area", p, None)
    }
    fn __repr__(&self) -> String {
        let [width, height] = self.table.size;
        format!("<etendue.Pictured with {width} x {height} texels>")
    }
}
/// Samples from a shading point of its own for each row. All arrays are broadcast to one shape (...) beside their last axis: shading points
/// p (..., 3), numbers u in [0, 1)² (..., 2), and unit normals n (..., 3). `by` names the technique: "area", "solid_angle" or
/// "projected_solid_angle" for flat lights, "visible_area" for spheres; None is "solid_angle" or "visible_area".
(&self,) [] () (n) (by: Option<&str> = None) |rows| self.each(by, rows) }

/// Adds pictures to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Picture>()?;
    module.add_class::<Pictured>()
}
