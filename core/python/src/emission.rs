//! Intensity by direction: profiles, and images that a light projects.

use crate::arrays::{Argument, FieldKind, Image, array, map, rows, run, zeros};
use crate::lights::PointLight;
use crate::samplers::{Sampler, single};
use crate::warps::{Mapping, Warp};
use etendue::light;
use etendue_batch::{Batch, DirectionOfImage, PlaceInImage};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

/// The radiant intensity of a light by direction: a table over two angles, between which it is bilinear, as photometry interpolates.
///
/// Directions are those in which light travels, in the space of the profile: the polar angle is that from +z, and the azimuth that from +x
/// towards +y. `polar` (count) ascends in [0, 180] and `azimuth` (count) from a number in (−360, 0] over at most 360, both in degrees; a single
/// azimuth stands for all. `values` (azimuths, polar angles) are from 0 to 1e37, in any unit. Below the first and above the last polar angle,
/// and outside the azimuths, the light is dark.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Profile {
    polar: Vec<f32>,
    azimuth: Vec<f32>,
    values: Vec<f32>,
}

/// A row of numbers.
fn list(name: &'static str, object: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let argument = Argument::new(name, FieldKind::Number, object)?;
    if argument.shape.len() != 1 {
        return Err(PyValueError::new_err(format!("{name} must have the shape (count), not {:?}", argument.shape)));
    }
    Ok(argument.columns(&argument.shape)?.remove(0))
}

impl Profile {
    fn with<X>(&self, f: impl FnOnce(&light::Profile<'_>) -> X) -> PyResult<X> {
        let profile = light::Profile::new(&self.polar, &self.azimuth, &self.values);
        profile.map(|profile| f(&profile)).map_err(|e| PyValueError::new_err(e.to_string()))
    }
}

#[pymethods]
impl Profile {
    #[new]
    fn new(polar: &Bound<'_, PyAny>, azimuth: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (polar, azimuth) = (list("polar", polar)?, list("azimuth", azimuth)?);
        let argument = Argument::new("values", FieldKind::Number, values)?;
        if argument.shape != [azimuth.len(), polar.len()] {
            let (wanted, found) = ((azimuth.len(), polar.len()), &argument.shape);
            return Err(PyValueError::new_err(format!("values must have the shape {wanted:?}, not {found:?}")));
        }
        let values = argument.columns(&argument.shape)?.remove(0);
        let this = Self { polar, azimuth, values };
        this.with(|_| ())?;
        Ok(this)
    }
    /// The intensity in unit directions w (..., 3), in which light travels.
    fn intensity<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let intensity = self.with(|profile| map(py, profile, &columns))??.0.remove(0);
        array(py, &w.shape, intensity)
    }
    /// The integral of the intensity over all directions: the power, for intensities per steradian. Exact to some 1e-14.
    #[getter]
    fn power(&self) -> PyResult<f64> {
        self.with(|profile| profile.power())
    }
    /// Cosine of the angle from +z from which on the light is dark, at most 1; −1 if it may shine in all directions.
    #[getter]
    fn cos_cone(&self) -> PyResult<f32> {
        self.with(|profile| profile.cos_cone())
    }
    /// The mean of the intensity over each texel of an equirectangular map, (height, width), greater than 0 where there is light:
    /// `ImageEnvironment(profile.means(height, width))` samples what the light emits.
    fn means<'py>(&self, py: Python<'py>, height: usize, width: usize) -> PyResult<Bound<'py, PyAny>> {
        let Some(count @ 1..) = height.checked_mul(width) else {
            return Err(PyValueError::new_err("height and width must be at least 1"));
        };
        let mut means = zeros(count)?;
        let filled = self.with(|profile| run(py, count, || profile.means(width, &mut means)))?;
        filled.map_err(|e| PyValueError::new_err(e.to_string()))?;
        array(py, &[height, width], means)
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Profile of {} x {} angles>", self.azimuth.len(), self.polar.len())
    }
}

/// A point light whose intensity differs by direction, prepared for the shading point p (3): `intensity` is called with the unit direction (3)
/// in which light travels, in the coordinates of the scene, and returns the intensity there, relative to the I of the estimator f · I · cosθ ·
/// weight. Where that is 0, so are pdf and weight.
#[pyfunction]
fn by_profile(light: &Bound<'_, PointLight>, p: &Bound<'_, PyAny>, intensity: &Bound<'_, PyAny>) -> PyResult<Sampler> {
    let (p, py) = (single("p", p)?, light.py());
    let mut failed = None;
    let sampler = PointLight::build(&light.get().numbers).by_profile(p, |w| {
        let ask = || intensity.call1((array(py, &[3], vec![w.x, w.y, w.z])?,))?.extract::<f32>();
        ask().unwrap_or_else(|e| {
            failed = Some(e);
            0.0
        })
    });
    match failed {
        Some(e) => Err(e),
        None => Ok(Sampler::new(Box::new(sampler), "PointLight by_profile", None)),
    }
}

/// A light that projects a rectangular image through a pinhole, as a slide projector does.
///
/// Directions are those in which light travels, in the space of the projector: +z is the axis, +x the right and +y the upper edge of the image.
/// Positions in the image run from the upper left corner, in [0, 1)². `tan_half` (2) are the tangents of half the horizontal and vertical angle
/// of view, greater than 0.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Projector {
    projector: light::Projector,
}

#[pymethods]
impl Projector {
    #[new]
    fn new(tan_half: &Bound<'_, PyAny>) -> PyResult<Self> {
        let columns = Argument::single("tan_half", FieldKind::Row(2), tan_half)?.columns(&[])?;
        let tan_half = [columns[0][0], columns[1][0]];
        if !tan_half.iter().all(|&t| t > 0.0 && t < f32::INFINITY) {
            return Err(PyValueError::new_err(format!("tan_half must be finite and greater than 0, not {tan_half:?}")));
        }
        Ok(Self { projector: light::Projector { tan_half } })
    }
    /// Positions in the image of unit directions w (..., 3), (..., 2), and whether they are there, (...): where not, the position is 0.
    fn place<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let (uv, inside) = map(py, &PlaceInImage(self.projector), &w.columns(&w.shape)?)?;
        Ok((rows(py, &w.shape, &uv)?, array(py, &w.shape, inside)?))
    }
    /// The unit directions in which the light of positions uv (..., 2) in the image travels, (..., 3).
    fn direction<'py>(&self, py: Python<'py>, uv: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let uv = Argument::new("uv", FieldKind::Row(2), uv)?;
        rows(py, &uv.shape, &map(py, &DirectionOfImage(self.projector), &uv.columns(&uv.shape)?)?.0)
    }
    /// A cosine of the angle to the axis from which on the light is dark: that of the corners, less a rounding.
    #[getter]
    fn cos_cone(&self) -> f32 {
        self.projector.cos_cone()
    }
    /// The solid angles of the texels of an image, in steradians, (height, width), in double precision: exact to some 1e-16.
    fn solid_angles<'py>(&self, py: Python<'py>, height: usize, width: usize) -> PyResult<Bound<'py, PyAny>> {
        let count = height.checked_mul(width).ok_or_else(|| PyValueError::new_err("the image is too large"))?;
        let mut angles = zeros(count)?;
        for (i, angle) in angles.iter_mut().enumerate() {
            *angle = self.projector.texel_solid_angle([width, height], [i % width, i / width]);
        }
        array(py, &[height, width], angles)
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Projector {:?}>", self.projector.tan_half)
    }
}

/// What a Projector emits of an image, for light tracing: (2) to (3). A texel is drawn by its weight times its solid angle; the pdf is per
/// steradian, 0 where the weight is 0 and outside the image.
///
/// `weights` (height, width) are per steradian, finite, not negative and not all 0, in any unit, row by row from the top.
#[pyclass(module = "etendue", extends = Warp, frozen)]
pub(crate) struct ProjectedImage;

#[derive(Clone)]
struct Emission {
    projector: light::Projector,
    table: Arc<Vec<f32>>,
    width: usize,
}

impl Emission {
    fn image(&self) -> light::ProjectedImage<'_> {
        light::ProjectedImage::from_buffer(self.projector, &self.table, self.width).expect("the table was built")
    }
}
impl Mapping for Emission {
    fn sizes(&self) -> [usize; 2] {
        [2, 3]
    }
    fn sample(&self, u: [&[f32]; 2], out: [&mut [f32]; 3]) {
        Batch::new().warp(&self.image(), u, out);
    }
    fn pdf(&self, points: [&[f32]; 3], out: &mut [f32]) {
        Batch::new().warp_pdf(&self.image(), points, out);
    }
    fn invert(&self, points: [&[f32]; 3], out: [&mut [f32]; 2]) {
        Batch::new().warp_invert(&self.image(), points, out);
    }
}

#[pymethods]
impl ProjectedImage {
    #[new]
    fn new(
        py: Python<'_>,
        projector: &Bound<'_, PyAny>,
        weights: &Bound<'_, PyAny>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let Ok(projector) = projector.cast::<Projector>() else {
            let found = projector.get_type().name()?;
            return Err(PyTypeError::new_err(format!("projector must be a Projector, not {found}")));
        };
        let projector = projector.get().projector;
        let Image { weights, width, height } = Image::new("weights", weights)?;
        let mut table = zeros(light::ProjectedImage::buffer(width, height))?;
        let built = run(py, weights.len(), || {
            let image = light::ProjectedImage::build(projector, &weights, width, &mut table);
            image.map(|_| ()).map_err(|e| e.to_string())
        });
        built.map_err(PyValueError::new_err)?;
        let emission = Emission { projector, table: Arc::new(table), width };
        Ok(PyClassInitializer::from(Warp { map: Box::new(emission) }).add_subclass(Self))
    }
}

/// Adds profiles and projectors to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Profile>()?;
    module.add_class::<Projector>()?;
    module.add_class::<ProjectedImage>()?;
    module.add_function(wrap_pyfunction!(by_profile, module)?)
}
