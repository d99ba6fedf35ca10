//! Daylight: the sky by CIE's formula, and where the sun is.

use crate::arrays::{Argument, FieldKind, array, map};
use etendue::light::{self, Moment};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The sky by CIE's standard general sky (ISO 15469:2004): how bright it is in each direction, relative to the zenith. z is up.
///
/// `kind` is the type of the sky, from 1 to 15: 1 is overcast, 5 uniform, 12 clear, 15 turbid with a wide corona. `sun` (3) is the direction
/// to the sun, of any length. An image of it is sampled by `ImageEnvironment`; the sun itself is a `Sun`.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct GeneralSky {
    sky: light::GeneralSky,
    kind: u32,
}

#[pymethods]
impl GeneralSky {
    #[new]
    fn new(kind: u32, sun: [f64; 3]) -> PyResult<Self> {
        if !(1..=15).contains(&kind) {
            return Err(PyValueError::new_err(format!("kind must be in [1, 15], not {kind}")));
        }
        let sky = light::GeneralSky::new(kind, sun);
        let message = || PyValueError::new_err(format!("sun must be a direction, not {sun:?}"));
        Ok(Self { sky: sky.ok_or_else(message)?, kind })
    }
    /// The luminance in unit directions w (..., 3) over that of the zenith; 0 below the horizon. To 1e-6 relative.
    fn luminance<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let luminance = map(py, &self.sky, &w.columns(&w.shape)?)?.0.remove(0);
        array(py, &w.shape, luminance)
    }
    /// Illuminance of the horizontal plane over the luminance of the zenith, in steradians, without the sun's disk: to 2e-5.
    fn horizontal(&self, py: Python<'_>) -> f64 {
        py.detach(|| self.sky.horizontal())
    }
    fn __repr__(&self) -> String {
        format!("<etendue.GeneralSky of type {}>", self.kind)
    }
}

/// Where the sun stands at a time, as seen from a place, without refraction: to 0.01° from 1950 to 2050 (Michalsky 1988).
///
/// The time is in the Gregorian calendar and universal time; `hours` may be any number. `latitude` (north is positive) and `longitude` (east is
/// positive) are in degrees. A day that the calendar does not have, and a place that is not on the earth, raise ValueError.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct SunPosition {
    position: light::SunPosition,
}

#[pymethods]
impl SunPosition {
    #[new]
    fn new(year: i32, month: u32, day: u32, hours: f64, latitude: f64, longitude: f64) -> PyResult<Self> {
        let time = Moment { year, month, day, hours };
        if !time.is_valid() {
            let message = format!("the calendar has no {year}-{month}-{day} with {hours} hours");
            return Err(PyValueError::new_err(message));
        }
        let message =
            || format!("latitude must be in [-90, 90] and longitude in [-180, 180], not {latitude} and {longitude}");
        let position = light::SunPosition::new(time, latitude, longitude);
        Ok(Self { position: position.ok_or_else(|| PyValueError::new_err(message()))? })
    }
    /// Angle above the horizon in radians.
    #[getter]
    fn elevation(&self) -> f64 {
        self.position.elevation
    }
    /// Angle from north over east in radians, in [0, 2π).
    #[getter]
    fn azimuth(&self) -> f64 {
        self.position.azimuth
    }
    /// The unit direction to the sun (3), in double precision: +x is east, +y north and +z up.
    #[getter]
    fn direction<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, &[3], self.position.direction().to_vec())
    }
    fn __repr__(&self) -> String {
        let light::SunPosition { elevation, azimuth } = self.position;
        format!("<etendue.SunPosition: elevation {elevation}, azimuth {azimuth}>")
    }
}

/// Adds daylight to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<GeneralSky>()?;
    module.add_class::<SunPosition>()
}
