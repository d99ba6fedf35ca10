//! Choice among many lights.

use crate::arrays::{Argument, FieldKind, broadcast, columns, together, vector};
use crate::results::{Object, array, refuse, room, run, zeros};
use etendue::select::{LightBound, LightTree as Tree, Node8};
use etendue_batch::memory::TreeMemory;
use etendue_batch::{Batch, Choices};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyTuple};

/// Chooses among any number of lights by what they can contribute to a point of a surface: from their power, distance and cosines.
///
/// All arguments are broadcast to one shape (count) beside their last axis. `center` (..., 3) and `radius` (...) are of a sphere around
/// each light; `normal` (..., 3) is the unit normal of a flat light or the axis of a spot light, or 0 for a light that emits in all
/// directions; `cos_cone` is the cosine of the angle from which on a spot light is dark, 0 for others; `two_sided` lights emit from both
/// sides; `power` is that of one side, in any unit. Every light that can contribute has a positive probability; one whose power is not
/// positive and finite is never chosen.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct LightTree {
    nodes: Vec<Node8>,
    places: Vec<u32>,
}

#[pymethods]
impl LightTree {
    #[new]
    #[pyo3(signature = (center, radius, normal=None, cos_cone=None, two_sided=None, power=None))]
    fn new(
        py: Python<'_>,
        center: &Object<'_>,
        radius: &Object<'_>,
        normal: Option<&Object<'_>>,
        cos_cone: Option<&Object<'_>>,
        two_sided: Option<&Object<'_>>,
        power: Option<&Object<'_>>,
    ) -> PyResult<Self> {
        // of a light that emits in all directions, from both sides or not, with a power of 1
        let origin = PyTuple::new(py, [0.0; 3])?.into_any();
        let [zero, one] = [0.0, 1.0].map(|number| PyFloat::new(py, number).into_any());
        let (shape, columns) = together(&[
            ("center", FieldKind::Row(3), center),
            ("radius", FieldKind::Number, radius),
            ("normal", FieldKind::Normal, normal.unwrap_or(&origin)),
            ("cos_cone", FieldKind::Number, cos_cone.unwrap_or(&zero)),
            ("two_sided", FieldKind::Number, two_sided.unwrap_or(&zero)),
            ("power", FieldKind::Number, power.unwrap_or(&one)),
        ])?;
        let &[count] = &shape[..] else {
            refuse!("center must have the shape (count, 3), not (*{shape:?}, 3)");
        };
        if count > Tree::MOST {
            refuse!("a tree has at most {} lights, not {count}", Tree::MOST);
        }
        let mut lights = room(count)?;
        lights.extend((0..count).map(|i| {
            let number = |k: usize| columns[k][i];
            LightBound {
                center: [0, 1, 2].map(number),
                radius: number(3),
                normal: [4, 5, 6].map(number),
                cos_cone: number(7),
                two_sided: number(8) != 0.0,
                power: number(9),
            }
        }));
        let (mut nodes, mut places) = (zeros::<Node8>(Tree::nodes_for(count))?, zeros(count)?);
        let built = run(py, count, || Tree::build(&lights, &mut nodes, &mut places).is_ok());
        if built { Ok(Self { nodes, places }) } else { Err(PyValueError::new_err("the tree cannot be built")) }
    }
    /// Chooses a light for each point p (..., 3) of a surface with the unit normal n (..., 3), by numbers u in [0, 1) (...). Returns the
    /// indices (uint32; `NO_LIGHT` where no light can contribute), the probabilities with which they were chosen, and what is left of
    /// the numbers u: uniform in [0, 1), independent of the light.
    fn choose<'py>(
        &self,
        py: Python<'py>,
        p: &Object<'py>,
        n: &Object<'py>,
        u: &Object<'py>,
    ) -> PyResult<(Object<'py>, Object<'py>, Object<'py>)> {
        let fields = [("p", FieldKind::Row(3), p), ("n", FieldKind::Normal, n), ("u", FieldKind::Unit, u)];
        let (shape, columns) = together(&fields)?;
        let count = columns[6].len();
        let (mut light, mut pmf, mut left) = (zeros(count)?, zeros(count)?, zeros(count)?);
        run(py, count, || {
            let out = Choices { light: &mut light, pmf: &mut pmf, u: &mut left };
            Batch::new().choose(&self.tree(), vector(&columns), vector(&columns[3..]), &columns[6], out);
        });
        Ok((array(py, &shape, light)?, array(py, &shape, pmf)?, array(py, &shape, left)?))
    }
    /// The probability with which `choose` returns the lights of the indices `light` (...) for points p (..., 3) with normals n (..., 3);
    /// 0 for an index past the last light.
    fn pmf<'py>(
        &self,
        py: Python<'py>,
        p: &Object<'py>,
        n: &Object<'py>,
        light: &Object<'py>,
    ) -> PyResult<Object<'py>> {
        let fields = [("p", FieldKind::Row(3), p), ("n", FieldKind::Normal, n), ("light", FieldKind::Index, light)];
        let arguments = fields.map(|(name, kind, object)| Argument::new(name, kind, object));
        let arguments = arguments.into_iter().collect::<PyResult<Vec<_>>>()?;
        let shape = broadcast(&arguments)?;
        let (columns, light) = (columns(&arguments[..2], &shape)?, arguments[2].indices(&shape)?);
        let mut pmf = zeros(light.len())?;
        run(py, light.len(), || {
            Batch::new().pmf(&self.tree(), vector(&columns), vector(&columns[3..]), &light, &mut pmf);
        });
        array(py, &shape, pmf)
    }
    fn __len__(&self) -> usize {
        self.places.len()
    }
    fn __repr__(&self) -> String {
        format!("<etendue.LightTree of {} lights>", self.places.len())
    }
}

impl LightTree {
    fn tree(&self) -> TreeMemory<'_> {
        TreeMemory::new(&self.nodes, &self.places)
    }
}

/// Adds the tree to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<LightTree>()?;
    module.add("NO_LIGHT", Tree::NO_LIGHT)
}
