//! Pictures on lights.

use crate::arrays::Image;
use crate::each::{Call, Each, Given, Needs};
use crate::lights;
use crate::results::{run, zeros};
use crate::samplers::{Prepared, Sampler, pdf_of_hit, single};
use crate::samples::Wanted;
use etendue::light::{self, FlatLight, Region};
use etendue::{Vec2, Vec3};
use etendue_batch::memory::PictureMemory;
use etendue_batch::technique::{
    OnPicture, PictureByArea, PictureByProjectedSolidAngle, PictureBySolidAngle, PictureOnPatchByVisibleArea,
    PictureOnSphereByVisibleArea,
};
use etendue_batch::{Batch, Samples};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

/// The table of a picture, which samplers share.
#[derive(Clone)]
struct Table {
    table: Arc<Vec<f32>>,
    /// The radiance between which it is interpolated, if it is.
    values: Option<Arc<Vec<f32>>>,
    size: [usize; 2],
    region: Region,
}

impl Table {
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
    table: Table,
}

#[pymethods]
impl Picture {
    #[new]
    #[pyo3(signature = (weights, region="square"))]
    fn new(py: Python<'_>, weights: &Bound<'_, PyAny>, region: &str) -> PyResult<Self> {
        let region = match region {
            "square" => Region::Square,
            "triangle" => Region::Triangle,
            "disk" => Region::Disk,
            _ => {
                let message = format!("region must be \"square\", \"triangle\" or \"disk\", not \"{region}\"");
                return Err(PyValueError::new_err(message));
            }
        };
        let Image { weights, width, height } = Self::image("weights", weights)?;
        let mut table = zeros(light::Picture::buffer(width, height))?;
        let built = run(py, weights.len(), || {
            light::Picture::build(&weights, width, region, &mut table).map(|_| ()).map_err(|e| e.to_string())
        });
        built.map_err(PyValueError::new_err)?;
        Ok(Self { table: Table { table: Arc::new(table), values: None, size: [width, height], region } })
    }
    /// A picture that is interpolated bilinearly between the `values` (height, width) at the centres of its texels, and continued by its
    /// outermost ones: the pdf is in proportion to the interpolated radiance. For lights that cover the whole unit square.
    #[staticmethod]
    fn interpolated(py: Python<'_>, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Image { weights: values, width, height } = Self::image("values", values)?;
        let mut table = zeros(light::Picture::buffer(width + 1, height + 1))?;
        let built = run(py, values.len(), || {
            light::Picture::interpolated(&values, width, &mut table).map(|_| ()).map_err(|e| e.to_string())
        });
        built.map_err(PyValueError::new_err)?;
        let (table, values, size) = (Arc::new(table), Some(Arc::new(values)), [width, height]);
        Ok(Self { table: Table { table, values, size, region: Region::Square } })
    }
    /// The picture on a Rectangle, Parallelogram, Triangle, Disk, Sphere or BilinearPatch, which must cover the region for which it was built.
    fn on(&self, light: &Bound<'_, PyAny>) -> PyResult<Pictured> {
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
        } else if let Ok(light) = light.cast::<lights::BilinearPatch>() {
            (Shape::Patch(lights::BilinearPatch::build(&light.get().numbers)), Region::Square)
        } else {
            let message = "light must be a Rectangle, Parallelogram, Triangle, Disk, Sphere or BilinearPatch";
            return Err(PyTypeError::new_err(format!("{message}, not {}", light.get_type().name()?)));
        };
        if region != self.table.region {
            let name = |region| match region {
                Region::Square => "square",
                Region::Triangle => "triangle",
                Region::Disk => "disk",
            };
            let [own, wanted] = [self.table.region, region].map(name);
            let message = format!("the picture is for the region \"{own}\", and the light covers \"{wanted}\"");
            return Err(PyValueError::new_err(message));
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
    fn image(name: &'static str, object: &Bound<'_, PyAny>) -> PyResult<Image> {
        let image = Image::new(name, object)?;
        let most = 1 << 24;
        if image.width.max(image.height) >= most || (image.width + 1) * (image.height + 1) > u32::MAX as usize / 2 {
            return Err(PyValueError::new_err(format!(
                "{name} must have less than 2**24 rows and columns, and 2**31 texels"
            )));
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
    Patch(light::BilinearPatch<f32>),
}

/// What texels are drawn by, besides radiance.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Area,
    SolidAngle,
    ProjectedSolidAngle,
    VisibleArea,
}

/// A light with a picture: `Picture.on` makes it.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Pictured {
    table: Table,
    shape: Shape,
}

/// A light with a picture, prepared for a shading point.
struct Placed {
    table: Table,
    shape: Shape,
    by: By,
    p: Vec3<f32>,
    n: Vec3<f32>,
}

/// Calls `body` with the sampler.
macro_rules! with {
    ($this:ident, |$sampler:ident| $body:expr) => {{
        let Placed { table, shape, by, p, n } = $this;
        let picture = table.picture();
        match shape {
            Shape::Sphere(light) => {
                let light = OnPicture { picture, light: *light };
                let $sampler = &Batch::new().prepare::<PictureOnSphereByVisibleArea<'_>>(&light, *p, ());
                $body
            }
            Shape::Patch(light) => {
                let light = OnPicture { picture, light: *light };
                let $sampler = &Batch::new().prepare::<PictureOnPatchByVisibleArea<'_>>(&light, *p, ());
                $body
            }
            Shape::Flat(light) => match by {
                By::Area => {
                    let light = OnPicture { picture, light: *light };
                    let $sampler = &Batch::new().prepare::<PictureByArea<'_>>(&light, *p, ());
                    $body
                }
                By::ProjectedSolidAngle => {
                    let light = OnPicture { picture, light: *light };
                    let $sampler = &Batch::new().prepare::<PictureByProjectedSolidAngle<'_>>(&light, *p, *n);
                    $body
                }
                _ => {
                    let light = OnPicture { picture, light: *light };
                    let $sampler = &Batch::new().prepare::<PictureBySolidAngle<'_>>(&light, *p, ());
                    $body
                }
            },
        }
    }};
}
impl Prepared for Placed {
    fn sample(&self, u: Vec2<&[f32]>, out: Samples<'_>) {
        with!(self, |sampler| Batch::new().sample(sampler, u, out));
    }
    fn hit(&self, w: Vec3<&[f32]>, out: Samples<'_>) {
        with!(self, |sampler| Batch::new().hit(sampler, w, out));
    }
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        with!(self, |sampler| Batch::new().pdf(sampler, w, out));
    }
    fn pdf_of_hit(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        with!(self, |sampler| pdf_of_hit(sampler, w, out));
    }
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        with!(self, |sampler| Batch::new().invert(sampler, w, out));
    }
}

impl Pictured {
    fn is_for(&self, by: By) -> bool {
        matches!(self.shape, Shape::Flat(_)) == (by != By::VisibleArea)
    }
    fn sampler(
        &self,
        by: By,
        name: &'static str,
        p: &Bound<'_, PyAny>,
        n: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Sampler> {
        if !self.is_for(by) {
            let kinds = ["flat lights", "spheres and bilinear patches"];
            let [own, other] = if by == By::VisibleArea { [1, 0] } else { [0, 1] }.map(|k| kinds[k]);
            return Err(PyTypeError::new_err(format!("pictures {name} are for {own}, not for {other}")));
        }
        let n = n.map_or(Ok(Vec3::default()), |n| single("n", n))?;
        let placed = Placed { table: self.table.clone(), shape: self.shape, by, p: single("p", p)?, n };
        Ok(Sampler::new(Box::new(placed), name, None))
    }
    fn each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        (n, by): (Option<&Bound<'py, PyAny>>, Option<&str>),
        (call, wanted): (Call, Wanted<'_, 'py>),
        at: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let picture = self.table.picture();
        let given = Given { n, ..Given::default() };
        let needs = if by == Some("projected_solid_angle") { Needs::Normal } else { Needs::Nothing };
        let vector = |v: Vec3<f32>| [v.x, v.y, v.z];
        match (self.shape, by) {
            (Shape::Sphere(light), None | Some("visible_area")) => {
                let numbers = [&vector(light.center)[..], &[light.radius]].concat();
                let each = Each::of_one(py, &numbers, p, (needs, given), call, at)?;
                each.call::<PictureOnSphereByVisibleArea<'_>>(
                    py,
                    (call, wanted),
                    |x| OnPicture { picture, light: lights::Sphere::build(x) },
                    |_| (),
                )
            }
            (Shape::Patch(light), None | Some("visible_area")) => {
                let numbers = [light.corner, light.edge_s, light.edge_t, light.diagonal].map(vector).concat();
                let each = Each::of_one(py, &numbers, p, (needs, given), call, at)?;
                each.call::<PictureOnPatchByVisibleArea<'_>>(
                    py,
                    (call, wanted),
                    |x| OnPicture { picture, light: lights::BilinearPatch::build(x) },
                    |_| (),
                )
            }
            (Shape::Flat(light), None | Some("area" | "solid_angle" | "projected_solid_angle")) => {
                let numbers = [light.corner, light.edge_s, light.edge_t].map(vector).concat();
                let each = Each::of_one(py, &numbers, p, (needs, given), call, at)?;
                match by {
                    Some("area") => each.call::<PictureByArea<'_>>(
                        py,
                        (call, wanted),
                        |x| OnPicture { picture, light: lights::Parallelogram::build(x) },
                        |_| (),
                    ),
                    Some("projected_solid_angle") => each.call::<PictureByProjectedSolidAngle<'_>>(
                        py,
                        (call, wanted),
                        |x| OnPicture { picture, light: lights::Parallelogram::build(x) },
                        |x| Vec3::new(x[0], x[1], x[2]),
                    ),
                    _ => each.call::<PictureBySolidAngle<'_>>(
                        py,
                        (call, wanted),
                        |x| OnPicture { picture, light: lights::Parallelogram::build(x) },
                        |_| (),
                    ),
                }
            }
            (shape, Some(by)) => {
                let names: &[&str] = match shape {
                    Shape::Flat(_) => &["area", "solid_angle", "projected_solid_angle"],
                    _ => &["visible_area"],
                };
                Err(PyValueError::new_err(format!("by must be one of {names:?}, not {by:?}")))
            }
        }
    }
}

#[pymethods]
impl Pictured {
    /// By radiance times area, for flat lights that are small for their distance: the pdf is the pmf of the texel, over its area, times
    /// distance²/|cosθ'| per steradian, θ' at the light.
    fn by_area(&self, p: &Bound<'_, PyAny>) -> PyResult<Sampler> {
        self.sampler(By::Area, "by_area", p, None)
    }
    /// By radiance times solid angle at the point p, for flat lights: the pdf is the pmf of the texel over its solid angle, per steradian.
    fn by_solid_angle(&self, p: &Bound<'_, PyAny>) -> PyResult<Sampler> {
        self.sampler(By::SolidAngle, "by_solid_angle", p, None)
    }
    /// By radiance times projected solid angle above the horizon of the unit normal n at the point p, for flat lights: the pdf is the pmf of the
    /// texel over its projected solid angle, times cosθ, per steradian.
    fn by_projected_solid_angle(&self, p: &Bound<'_, PyAny>, n: &Bound<'_, PyAny>) -> PyResult<Sampler> {
        self.sampler(By::ProjectedSolidAngle, "by_projected_solid_angle", p, Some(n))
    }
    /// By radiance times the area that is visible from the point p, over the squared distance, for spheres and bilinear patches: the pdf is per
    /// steradian.
    fn by_visible_area(&self, p: &Bound<'_, PyAny>) -> PyResult<Sampler> {
        self.sampler(By::VisibleArea, "by_visible_area", p, None)
    }
    /// Samples from a shading point of its own for each row. All arrays are broadcast to one shape (...) beside their last axis: shading points
    /// p (..., 3), numbers u in [0, 1)² (..., 2), and unit normals n (..., 3). `by` names the technique: "area", "solid_angle" or
    /// "projected_solid_angle" for flat lights, "visible_area" for others; None is "solid_angle" or "visible_area".
    #[pyo3(signature = (*, p, u, n=None, by=None, fields=None, out=None))]
    #[allow(clippy::too_many_arguments)]
    fn sample_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        u: &Bound<'py, PyAny>,
        n: Option<&Bound<'py, PyAny>>,
        by: Option<&str>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (n, by), (Call::Sample, Wanted { fields, out }), u)
    }
    /// The points of the light that unit directions w (..., 3) hit, as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, n=None, by=None, fields=None, out=None))]
    #[allow(clippy::too_many_arguments)]
    fn hit_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        n: Option<&Bound<'py, PyAny>>,
        by: Option<&str>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (n, by), (Call::Hit, Wanted { fields, out }), w)
    }
    /// The probability densities of unit directions w (..., 3), as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, n=None, by=None, out=None))]
    #[allow(clippy::too_many_arguments)]
    fn pdf_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        n: Option<&Bound<'py, PyAny>>,
        by: Option<&str>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (n, by), (Call::Pdf, Wanted { fields: None, out }), w)
    }
    /// The numbers u in [0, 1)² that are mapped to unit directions w (..., 3), as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, n=None, by=None, out=None))]
    #[allow(clippy::too_many_arguments)]
    fn invert_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        n: Option<&Bound<'py, PyAny>>,
        by: Option<&str>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (n, by), (Call::Invert, Wanted { fields: None, out }), w)
    }
    fn __repr__(&self) -> String {
        let [width, height] = self.table.size;
        format!("<etendue.Pictured with {width} x {height} texels>")
    }
}

/// Adds pictures to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Picture>()?;
    module.add_class::<Pictured>()
}
