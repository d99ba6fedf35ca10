//! Light from all around as an image tells it.

use crate::arrays;
use crate::results::{Object, refuse, table};
use crate::samplers::{Call, Prepared, Sampler};
use etendue::light::{self, EnvironmentMap};
use etendue_batch::Evaluations;
use etendue_batch::memory::ImageMemory;
use pyo3::prelude::*;
use std::sync::Arc;

/// The table of an image, which samplers share.
#[derive(Clone)]
struct Image {
    table: Arc<Vec<f32>>,
    width: usize,
    height: usize,
    map: EnvironmentMap,
}

impl Image {
    fn memory(&self) -> ImageMemory<'_> {
        ImageMemory::new(&self.table, self.width, self.map).expect("the table was built for this width")
    }
}

impl Prepared for Image {
    fn answer(&self, call: Call, at: &[&[f32]], out: Evaluations<'_>) {
        call.answer(&self.memory(), at, out);
    }
}

/// Light from all around as an image tells it: a texel in proportion to its weight times its solid angle, and in the texel uniform by
/// solid angle.
///
/// `weights` (height, width) are finite, not negative and not all 0, in any unit: the luminance of each texel, or the sum of its channels.
/// z is up, and the first row is the top one. `map` is "equirectangular" for longitude and latitude (columns are the azimuth from +x, rows
/// the angle from +z), or "equal-area" for the square octahedral map whose texels all have the same solid angle, as in pbrt-v4. `uv` of a
/// sample is its position in the image, by column and row.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct ImageEnvironment {
    image: Image,
}

#[pymethods]
impl ImageEnvironment {
    #[new]
    #[pyo3(signature = (weights, map="equirectangular"))]
    fn new(py: Python<'_>, weights: &Object<'_>, map: &str) -> PyResult<Self> {
        let map = match map {
            "equirectangular" => EnvironmentMap::Equirectangular,
            "equal-area" => EnvironmentMap::EqualArea,
            _ => refuse!("map must be \"equirectangular\" or \"equal-area\", not \"{map}\""),
        };
        let arrays::Image { weights, width, height } = arrays::Image::new("weights", weights)?;
        let table = table(py, light::ImageEnvironment::buffer(width, height), |table| {
            light::ImageEnvironment::build(&weights, width, map, table).map(|_| ())
        })?;
        Ok(Self { image: Image { table: Arc::new(table), width, height, map } })
    }
    /// Directions in proportion to the image, the same for all shading points.
    fn by_radiance(&self) -> Sampler {
        Sampler::new(Box::new(self.image.clone()), "ImageEnvironment by_radiance", None)
    }
    fn __repr__(&self) -> String {
        format!("<etendue.ImageEnvironment of {} x {} texels>", self.image.width, self.image.height)
    }
}

/// Adds the environment to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<ImageEnvironment>()
}
