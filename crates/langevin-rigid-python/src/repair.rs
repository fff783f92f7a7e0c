//! Mending meshes.

use langevin_rigid_bake::mesh::{Options, repair as mend};
use pyo3::prelude::*;

use crate::errors::MeshError;
use crate::interrupt::interruptible;
use crate::mesh::Mesh;

/// A mesh that was mended, and how.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Repaired {
    mesh: Py<Mesh>,
    steps: Vec<(&'static str, usize, String)>,
    lost_share: f64,
    made_share: f64,
    hull_share: f64,
    warnings: Vec<String>,
}

#[pymethods]
impl Repaired {
    /// The body.
    #[getter]
    fn mesh(&self, py: Python<'_>) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// What was done, in order, a sentence each; empty if there was nothing to mend.
    #[getter]
    fn steps(&self) -> Vec<String> {
        self.steps
            .iter()
            .map(|(_, _, words)| words.clone())
            .collect()
    }

    /// The same as pairs of a name that is the same in every version and how many vertices, edges, triangles, holes or
    /// components it concerned.
    #[getter]
    fn counts(&self) -> Vec<(&'static str, usize)> {
        self.steps
            .iter()
            .map(|(name, count, _)| (*name, *count))
            .collect()
    }

    /// Share of the area given that was dropped.
    #[getter]
    fn lost_share(&self) -> f64 {
        self.lost_share
    }

    /// Share of the body's area that was not given.
    #[getter]
    fn made_share(&self) -> f64 {
        self.made_share
    }

    /// Share of its convex hull that the body fills.
    #[getter]
    fn hull_share(&self) -> f64 {
        self.hull_share
    }

    /// What the owner of the mesh should look at, a sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    fn __repr__(&self) -> String {
        let name = &self.mesh.get().name;
        match self.steps.len() {
            0 => format!("<Repaired {name}: nothing to mend>"),
            count => format!(
                "<Repaired {name}: {count} steps, {} warnings>",
                self.warnings.len()
            ),
        }
    }
}

/// Mends a mesh until it is a body: a Mesh, a path, or anything with `vertices` and `faces`.
///
/// `weld` (m) is how close vertices of open edges are joined, `fill` the most edges of a hole that is filled, `thickness`
/// (m) what an open sheet is given, `wrap` (m) the size of the gaps that a closed surface around all of it closes,
/// `triangles` what the body is simplified to, and `largest` drops all components but the one of the largest surface.
///
/// MeshError says what is left to do, if it is no body then.
///
/// >>> cube = Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=300)
/// >>> mended = repair(Mesh(cube.vertices, cube.triangles[1:]))
/// >>> mended.counts
/// [('fill', 1)]
/// >>> mended.mesh.is_body
/// True
#[pyfunction]
#[pyo3(signature = (mesh, *, weld = None, fill = None, thickness = None, wrap = None, triangles = None, largest = false))]
pub(crate) fn repair(
    mesh: &Bound<'_, PyAny>,
    weld: Option<f64>,
    fill: Option<usize>,
    thickness: Option<f64>,
    wrap: Option<f64>,
    triangles: Option<usize>,
    largest: bool,
) -> PyResult<Repaired> {
    let py = mesh.py();
    let mesh = Mesh::of_argument(mesh)?;
    let mesh = mesh.get();
    let options = Options {
        weld,
        fill,
        thickness,
        triangles,
        wrap,
        largest,
    };
    let repaired = interruptible(py, |wanted| {
        mend(&mesh.raw.vertices, &mesh.raw.triangles, &options, wanted)
    })?;
    let body = repaired
        .body
        .map_err(|error| MeshError::new_err(format!("{}: {error}", mesh.name)))?;
    let balance = repaired.balance.as_ref();
    Ok(Repaired {
        mesh: Py::new(py, Mesh::of_body(body, mesh.name.clone()))?,
        steps: repaired
            .steps
            .iter()
            .map(|step| (step.name(), step.count(), step.to_string()))
            .collect(),
        lost_share: balance.map_or(0.0, |balance| balance.lost_share()),
        made_share: balance.map_or(0.0, |balance| balance.made_share()),
        hull_share: balance.map_or(0.0, |balance| balance.hull_share()),
        warnings: balance.map_or_else(Vec::new, |balance| balance.warnings()),
    })
}
