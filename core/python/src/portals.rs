//! The sky through portals.

use crate::arrays::{FieldKind, Image, numbers, point, together};
use crate::each::{Given, Rows, with_each};
use crate::results::{Object, array, map, refuse, rows, table};
use crate::samplers::{Call, Prepared, Sampler};
use crate::samples::Wanted;
use etendue::Vec3;
use etendue::light::{self, PortalTable};
use etendue_batch::memory::{PortalMemory, PortalShape, PortalSums};
use etendue_batch::technique::PortalsByRadiance;
use etendue_batch::{Batch, Evaluations, PortalDirection, SeenThroughPortals};
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
    fn new(corner: &Object<'_>, edge_s: &Object<'_>, edge_t: &Object<'_>) -> PyResult<Self> {
        let fields = [("corner", corner), ("edge_s", edge_s), ("edge_t", edge_t)];
        let numbers = numbers(&fields.map(|(name, object)| (name, FieldKind::Row(3), object)))?;
        let [corner, edge_s, edge_t] = [0, 3, 6].map(|k| [numbers[k], numbers[k + 1], numbers[k + 2]]);
        let message = "the edges of a portal must not be parallel, and its numbers finite";
        let shape = PortalShape { corner, edge_s, edge_t };
        shape.view().ok_or_else(|| PyValueError::new_err(message))?;
        Ok(Self { shape })
    }
    /// The unit directions at positions uv (..., 2) in [0, 1]² of the image of the sky for this portal, (..., 3), and the solid angles there per
    /// unit of the image's area, in steradians, (...).
    ///
    /// A direction x s + y t + z n, by the unit edges s and t and the normal n, has the position (atan(x/z)/π + ½, atan(y/z)/π + ½). The image is
    /// the same for parallel portals with parallel edges.
    fn direction<'py>(&self, py: Python<'py>, uv: &Object<'py>) -> PyResult<(Object<'py>, Object<'py>)> {
        let (shape, uv) = together(&[("uv", FieldKind::Row(2), uv)])?;
        let direction = PortalDirection::new(self.shape.edge_s, self.shape.edge_t).expect("its edges are not parallel");
        let (mut out, _) = map(py, &direction, &uv)?;
        let solid_angle = out.remove(3);
        Ok((rows(py, &shape, &out)?, array(py, &shape, solid_angle)?))
    }
    fn __repr__(&self) -> String {
        let PortalShape { corner, edge_s, edge_t } = self.shape;
        format!("<etendue.Portal {:?}>", [corner, edge_s, edge_t])
    }
}

const MOST: usize = light::PortalEnvironment::MOST;

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

impl Prepared for Placed {
    fn answer(&self, call: Call, at: &[&[f32]], out: Evaluations<'_>) {
        self.sky.with(|sky| {
            let sampler = Batch::new().prepare::<PortalsByRadiance<'_>>(&sky, self.p, ());
            call.answer(&sampler, at, out);
        });
    }
}

with_each! { PortalEnvironment {
    #[new]
    fn new(py: Python<'_>, portals: Vec<Bound<'_, Portal>>, weights: Vec<Object<'_>>) -> PyResult<Self> {
        if !(1..=MOST).contains(&portals.len()) || portals.len() != weights.len() {
            let (count, images) = (portals.len(), weights.len());
            refuse!("portals must be 1 to {MOST} with an image in weights each, not {count} with {images}");
        }
        let mut tables = Vec::new();
        for image in &weights {
            let Image { weights, width, height } = Image::new("weights", image)?;
            if width.max(height) > 4096 {
                refuse!("weights must have at most 4096 rows and columns, not {height} and {width}");
            }
            let sums = table(py, PortalTable::buffer(width, height), |sums| {
                PortalTable::build(&weights, width, sums).map(|_| ())
            })?;
            tables.push((sums, width));
        }
        let portals = portals.iter().map(|portal| portal.get().shape).collect();
        Ok(Self { sky: Sky { portals: Arc::new(portals), tables: Arc::new(tables) } })
    }
    /// Directions from the point p (3) in proportion to the weights of what it sees. The pdf is 0 where it sees no portal.
    fn by_radiance(&self, p: &Object<'_>) -> PyResult<Sampler> {
        let placed = Placed { sky: self.sky.clone(), p: point(p)? };
        Ok(Sampler::new(Box::new(placed), "PortalEnvironment by_radiance", None))
    }
    /// Whether rays from points p (..., 3) in unit directions w (..., 3) pass a portal towards the sky.
    fn sees<'py>(&self, py: Python<'py>, p: &Object<'py>, w: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = together(&[("p", FieldKind::Row(3), p), ("w", FieldKind::Direction, w)])?;
        let (_, sees) = self.sky.with(|sky| map(py, &SeenThroughPortals(sky), &columns))?;
        array(py, &shape, sees)
    }
    fn __repr__(&self) -> String {
        format!("<etendue.PortalEnvironment of {} portals>", self.sky.portals.len())
    }
}
/// Samples from a point of its own for each row: points p (..., 3) and numbers u in [0, 1)² (..., 2) are broadcast to one shape (...)
/// beside their last axis.
(&self,) [] () () () |rows| self.sky.with(|sky| rows.by::<PortalsByRadiance<'_>>(sky, &[])) }

/// Adds portals to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Portal>()?;
    module.add_class::<PortalEnvironment>()
}
