//! Choice among many lights.

use crate::arrays::{Argument, FieldKind, broadcast};
use crate::results::{array, room, run, zeros};
use etendue::Vec3;
use etendue::select::{LightBound, LightTree as Tree, NO_LIGHT, Node8};
use etendue_batch::memory::TreeMemory;
use etendue_batch::{Batch, Choices};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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

fn vector(columns: &[Vec<f32>]) -> Vec3<&[f32]> {
    Vec3::new(&columns[0], &columns[1], &columns[2])
}

#[pymethods]
impl LightTree {
    #[new]
    #[pyo3(signature = (center, radius, normal=None, cos_cone=None, two_sided=None, power=None))]
    fn new(
        py: Python<'_>,
        center: &Bound<'_, PyAny>,
        radius: &Bound<'_, PyAny>,
        normal: Option<&Bound<'_, PyAny>>,
        cos_cone: Option<&Bound<'_, PyAny>>,
        two_sided: Option<&Bound<'_, PyAny>>,
        power: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let arguments = [
            ("center", FieldKind::Row(3), Some(center)),
            ("radius", FieldKind::Number, Some(radius)),
            ("normal", FieldKind::Normal, normal),
            ("cos_cone", FieldKind::Number, cos_cone),
            ("two_sided", FieldKind::Number, two_sided),
            ("power", FieldKind::Number, power),
        ];
        let mut given = Vec::new();
        for (name, kind, object) in arguments {
            given.push(object.map(|object| Argument::new(name, kind, object)).transpose()?);
        }
        let shape = broadcast(py, &given.iter().flatten().collect::<Vec<_>>())?;
        let &[count] = &shape[..] else {
            return Err(PyValueError::new_err(format!("center must have the shape (count, 3), not (*{shape:?}, 3)")));
        };
        if count > Tree::MOST {
            return Err(PyValueError::new_err(format!("a tree has at most {} lights, not {count}", Tree::MOST)));
        }
        let mut columns = Vec::new();
        for argument in &given {
            columns.push(argument.as_ref().map(|argument| argument.columns(&shape)).transpose()?);
        }
        let mut lights = room(count)?;
        lights.extend((0..count).map(|i| {
            let number = |which: usize, k: usize, default: f32| {
                columns[which].as_ref().map_or(default, |columns: &Vec<Vec<f32>>| columns[k][i])
            };
            LightBound {
                center: [0, 1, 2].map(|k| number(0, k, 0.0)),
                radius: number(1, 0, 0.0),
                normal: [0, 1, 2].map(|k| number(2, k, 0.0)),
                cos_cone: number(3, 0, 0.0),
                two_sided: number(4, 0, 0.0) != 0.0,
                power: number(5, 0, 1.0),
            }
        }));
        let (mut nodes, mut places) = (zeros::<Node8>(Tree::nodes_for(count))?, zeros(count)?);
        let built = run(py, count, || Tree::build(&lights, &mut nodes, &mut places).is_ok());
        if built { Ok(Self { nodes, places }) } else { Err(PyValueError::new_err("the tree cannot be built")) }
    }
    /// Chooses a light for each point p (..., 3) of a surface with the unit normal n (..., 3), by numbers u in [0, 1) (...). Returns the
    /// indices (uint32; `NO_LIGHT` where no light can contribute), the probabilities with which they were chosen, and what is left of
    /// the numbers u: uniform in [0, 1), independent of the light.
    #[allow(clippy::type_complexity)]
    fn choose<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        n: &Bound<'py, PyAny>,
        u: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (p, n) = (Argument::new("p", FieldKind::Row(3), p)?, Argument::new("n", FieldKind::Normal, n)?);
        let u = Argument::new("u", FieldKind::Unit, u)?;
        let shape = broadcast(py, &[&p, &n, &u])?;
        let (p, n, u) = (p.columns(&shape)?, n.columns(&shape)?, u.columns(&shape)?);
        let count = u[0].len();
        let (mut light, mut pmf, mut left) = (zeros(count)?, zeros(count)?, zeros(count)?);
        run(py, count, || {
            let out = Choices { light: &mut light, pmf: &mut pmf, u: &mut left };
            Batch::new().choose(&self.tree(), vector(&p), vector(&n), &u[0], out);
        });
        Ok((array(py, &shape, light)?, array(py, &shape, pmf)?, array(py, &shape, left)?))
    }
    /// The probability with which `choose` returns the lights of the indices `light` (...) for points p (..., 3) with normals n (..., 3);
    /// 0 for an index past the last light.
    fn pmf<'py>(
        &self,
        py: Python<'py>,
        p: &Bound<'py, PyAny>,
        n: &Bound<'py, PyAny>,
        light: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (p, n) = (Argument::new("p", FieldKind::Row(3), p)?, Argument::new("n", FieldKind::Normal, n)?);
        let light = Argument::new("light", FieldKind::Index, light)?;
        let shape = broadcast(py, &[&p, &n, &light])?;
        let (p, n, light) = (p.columns(&shape)?, n.columns(&shape)?, light.indices(&shape)?);
        let mut pmf = zeros(light.len())?;
        run(py, light.len(), || Batch::new().pmf(&self.tree(), vector(&p), vector(&n), &light, &mut pmf));
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
    module.add("NO_LIGHT", NO_LIGHT)
}
