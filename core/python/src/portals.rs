//! The sky through portals.

use crate::arrays::{Argument, FieldKind, Image, broadcast};
use crate::each::{Call, Each, Given, Needs};
use crate::results::{array, map, rows, run, zeros};
use crate::samplers::{Prepared, Sampler, pdf_of_hit, single};
use crate::samples::Wanted;
use etendue::light::{MOST_PORTALS, PortalTable};
use etendue::{Vec2, Vec3};
use etendue_batch::memory::{PortalMemory, PortalShape, PortalSums};
use etendue_batch::technique::{Placed as Prepares, PortalsByRadiance};
use etendue_batch::{Batch, PortalDirection, Samples, SeenThroughPortals};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// A parallelogram through which the sky is seen, from the side that its normal edge_s × edge_t points away from. Its corner and its edges
/// from there are (3) each; parallel edges, and numbers that are not finite, raise ValueError.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Portal {
    shape: PortalShape,
}

#[pymethods]
impl Portal {
    #[new]
    fn new(corner: &Bound<'_, PyAny>, edge_s: &Bound<'_, PyAny>, edge_t: &Bound<'_, PyAny>) -> PyResult<Self> {
        let numbers = [single("corner", corner)?, single("edge_s", edge_s)?, single("edge_t", edge_t)?];
        let [corner, s, t] = numbers.map(|v| [v.x, v.y, v.z]);
        let message = "the edges of a portal must not be parallel, and its numbers finite";
        let shape = PortalShape { corner, edge_s: s, edge_t: t };
        shape.view().ok_or_else(|| PyValueError::new_err(message))?;
        Ok(Self { shape })
    }
    /// The unit directions at positions uv (..., 2) in [0, 1]² of the image of the sky for this portal, (..., 3), and the solid angles there per
    /// unit of the image's area, in steradians, (...).
    ///
    /// A direction x s + y t + z n, by the unit edges s and t and the normal n, has the position (atan(x/z)/π + ½, atan(y/z)/π + ½). The image is
    /// the same for parallel portals with parallel edges.
    fn direction<'py>(
        &self,
        py: Python<'py>,
        uv: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let uv = Argument::new("uv", FieldKind::Row(2), uv)?;
        let direction = PortalDirection::new(self.shape.edge_s, self.shape.edge_t).expect("its edges are not parallel");
        let (mut out, _) = map(py, &direction, &uv.columns(&uv.shape)?)?;
        let solid_angle = out.remove(3);
        Ok((rows(py, &uv.shape, &out)?, array(py, &uv.shape, solid_angle)?))
    }
    fn __repr__(&self) -> String {
        let PortalShape { corner, edge_s, edge_t } = self.shape;
        format!("<etendue.Portal {:?}>", [corner, edge_s, edge_t])
    }
}

/// The portals and the tables of their images, which samplers share.
#[derive(Clone)]
struct Sky {
    portals: Arc<Vec<PortalShape>>,
    tables: Arc<Vec<(Vec<u64>, usize)>>,
}

impl Sky {
    fn with<X>(&self, f: impl FnOnce(PortalMemory<'_>) -> X) -> X {
        let tables = self.tables.iter().map(|(sums, width)| PortalSums::new(sums, *width));
        let tables: Vec<_> = tables.collect::<Result<_, _>>().expect("the tables were built");
        f(PortalMemory::new(&self.portals, &tables).expect("as many tables as portals"))
    }
}

/// The part of an image of the sky that is seen through 1 to 8 portals; walls hide the rest of the sky. From each point exactly the part is
/// sampled that the point sees.
///
/// `weights` holds the image of each portal, of the shape (height, width) with at most 4096 rows and columns: the light that comes through each
/// texel, so radiance times solid angle, at the directions that `Portal.direction` gives for ((column + ½)/width, (row + ½)/height). Values are
/// finite, not negative and not all 0. `uv` of a sample are the numbers that `Octahedral` maps to the direction.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct PortalEnvironment {
    sky: Sky,
}

/// The sky through portals as a point sees it.
struct Placed {
    sky: Sky,
    p: Vec3<f32>,
}

impl Placed {
    fn with<X>(&self, f: impl FnOnce(&Prepares<PortalsByRadiance<'_>>) -> X) -> X {
        self.sky.with(|sky| f(&Batch::new().prepare::<PortalsByRadiance<'_>>(&sky, self.p, ())))
    }
}
impl Prepared for Placed {
    fn sample(&self, u: Vec2<&[f32]>, out: Samples<'_>) {
        self.with(|sampler| Batch::new().sample(sampler, u, out));
    }
    fn hit(&self, w: Vec3<&[f32]>, out: Samples<'_>) {
        self.with(|sampler| Batch::new().hit(sampler, w, out));
    }
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        self.with(|sampler| Batch::new().pdf(sampler, w, out));
    }
    fn pdf_of_hit(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        self.with(|sampler| pdf_of_hit(sampler, w, out));
    }
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        self.with(|sampler| Batch::new().invert(sampler, w, out));
    }
}

impl PortalEnvironment {
    fn each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        (call, wanted): (Call, Wanted<'_, 'py>),
        at: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let each = Each::of_one(py, &[], p, (Needs::Nothing, Given::default()), call, at)?;
        self.sky.with(|sky| each.call::<PortalsByRadiance<'_>>(py, (call, wanted), |_| sky, |_| ()))
    }
}

#[pymethods]
impl PortalEnvironment {
    #[new]
    fn new(py: Python<'_>, portals: Vec<Bound<'_, Portal>>, weights: Vec<Bound<'_, PyAny>>) -> PyResult<Self> {
        if !(1..=MOST_PORTALS).contains(&portals.len()) || portals.len() != weights.len() {
            let (count, images) = (portals.len(), weights.len());
            let message =
                format!("portals must be 1 to {MOST_PORTALS} with an image in weights each, not {count} with {images}");
            return Err(PyValueError::new_err(message));
        }
        let mut tables = Vec::new();
        for image in &weights {
            let Image { weights, width, height } = Image::new("weights", image)?;
            if width.max(height) > 4096 {
                let message = format!("weights must have at most 4096 rows and columns, not {height} and {width}");
                return Err(PyValueError::new_err(message));
            }
            let mut sums = zeros(PortalTable::buffer(width, height))?;
            let built = run(py, weights.len(), || {
                PortalTable::build(&weights, width, &mut sums).map(|_| ()).map_err(|e| e.to_string())
            });
            built.map_err(PyValueError::new_err)?;
            tables.push((sums, width));
        }
        let portals = portals.iter().map(|portal| portal.get().shape).collect();
        Ok(Self { sky: Sky { portals: Arc::new(portals), tables: Arc::new(tables) } })
    }
    /// Directions from the point p (3) in proportion to the weights of what it sees. The pdf is 0 where it sees no portal.
    fn by_radiance(&self, p: &Bound<'_, PyAny>) -> PyResult<Sampler> {
        let placed = Placed { sky: self.sky.clone(), p: single("p", p)? };
        Ok(Sampler::new(Box::new(placed), "PortalEnvironment by_radiance", None))
    }
    /// Samples from a point of its own for each row: points p (..., 3) and numbers u in [0, 1)² (..., 2) are broadcast to one shape (...)
    /// beside their last axis.
    #[pyo3(signature = (*, p, u, fields=None, out=None))]
    fn sample_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        u: &Bound<'py, PyAny>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (Call::Sample, Wanted { fields, out }), u)
    }
    /// What unit directions w (..., 3) see of the sky, as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, fields=None, out=None))]
    fn hit_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (Call::Hit, Wanted { fields, out }), w)
    }
    /// The probability densities of unit directions w (..., 3), as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, out=None))]
    fn pdf_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (Call::Pdf, Wanted { fields: None, out }), w)
    }
    /// The numbers u in [0, 1)² that are mapped to unit directions w (..., 3), as `sample_each` takes points.
    #[pyo3(signature = (*, p, w, out=None))]
    fn invert_each<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        w: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.each(py, p, (Call::Invert, Wanted { fields: None, out }), w)
    }
    /// Whether rays from points p (..., 3) in unit directions w (..., 3) pass a portal towards the sky.
    fn sees<'py>(&self, py: Python<'py>, p: &Bound<'py, PyAny>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (p, w) = (Argument::new("p", FieldKind::Row(3), p)?, Argument::new("w", FieldKind::Direction, w)?);
        let shape = broadcast(py, &[&p, &w])?;
        let mut columns = p.columns(&shape)?;
        columns.extend(w.columns(&shape)?);
        let (_, sees) = self.sky.with(|sky| map(py, &SeenThroughPortals(sky), &columns))?;
        array(py, &shape, sees)
    }
    fn __repr__(&self) -> String {
        format!("<etendue.PortalEnvironment of {} portals>", self.sky.portals.len())
    }
}

/// Adds portals to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Portal>()?;
    module.add_class::<PortalEnvironment>()
}
