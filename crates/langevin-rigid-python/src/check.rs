//! What is wrong with a mesh, all of it.

use langevin_rigid_bake::added_mass::{Expected, Options, expected};
use langevin_rigid_bake::mesh::{Component, Survey, survey};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::arrays;
use crate::interrupt::interruptible;
use crate::mesh::Mesh;

/// What a mesh is and what is wrong with it. Lengths are in metres, counts are of what is named.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Check {
    name: String,
    survey: Survey,
    fault: Option<String>,
    expected: Option<Expected>,
}

#[pymethods]
impl Check {
    /// Whether it is a body that can be baked.
    #[getter]
    fn ready(&self) -> bool {
        self.fault.is_none()
    }

    /// Why not, at first sight; None if it is ready.
    #[getter]
    fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }

    /// Everything that was found wrong, a line each; empty if nothing is.
    #[getter]
    fn findings(&self) -> Vec<String> {
        let holes = self.survey.holes.iter().map(|hole| format!("hole: {hole}"));
        let others = self
            .survey
            .findings()
            .into_iter()
            .filter(|finding| finding.count > 0);
        holes
            .chain(others.map(|finding| format!("{}: {}", finding.name, finding.words)))
            .collect()
    }

    /// Triangles given.
    #[getter]
    fn triangles(&self) -> usize {
        self.survey.triangles
    }

    /// Vertices given.
    #[getter]
    fn vertices(&self) -> usize {
        self.survey.vertices
    }

    /// Lowest and highest corner of the box around it (2, 3), m.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.survey.bounds)
    }

    /// Area of all sound triangles (m^2).
    #[getter]
    fn area(&self) -> f64 {
        self.survey.area
    }

    /// Volume of the solid without its cavities (m^3); None while the surface is not closed or meets itself.
    #[getter]
    fn volume(&self) -> Option<f64> {
        let survey = &self.survey;
        let faults = [&survey.non_manifold_edges, &survey.meeting];
        let closed = survey.holes.is_empty() && faults.iter().all(|faults| faults.count == 0);
        closed.then_some(survey.volume)
    }

    /// Edges around each hole, the longest perimeter first.
    #[getter]
    fn holes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let edges = self.survey.holes.iter().map(|hole| hole.edges as u64);
        arrays::of_column(py, edges.collect())
    }

    /// Middle of each hole (k, 3), m.
    #[getter]
    fn hole_centres<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centres: Vec<[f64; 3]> = self.survey.holes.iter().map(|hole| hole.centre).collect();
        arrays::of_rows(py, &centres)
    }

    /// Triangles without area.
    #[getter]
    fn degenerate(&self) -> usize {
        self.survey.degenerate
    }

    /// Triangles that repeat another.
    #[getter]
    fn duplicates(&self) -> usize {
        self.survey.duplicates
    }

    /// Vertices of no triangle.
    #[getter]
    fn unused_vertices(&self) -> usize {
        self.survey.unused_vertices
    }

    /// Open vertices at or near the place of another.
    #[getter]
    fn unwelded(&self) -> usize {
        self.survey.seams.vertices
    }

    /// Triangles that wind unlike their neighbours.
    #[getter]
    fn flipped(&self) -> usize {
        self.survey.flipped
    }

    /// Whether normals of a component point into the solid, which is mended on the way.
    #[getter]
    fn inside_out(&self) -> bool {
        self.survey.components.iter().any(Component::is_inside_out)
    }

    /// Edges of more than two triangles.
    #[getter]
    fn non_manifold_edges(&self) -> usize {
        self.survey.non_manifold_edges.count
    }

    /// Vertices where parts touch in a point.
    #[getter]
    fn non_manifold_vertices(&self) -> usize {
        self.survey.non_manifold_vertices.count
    }

    /// Triangles that pass through others or lie on them.
    #[getter]
    fn intersections(&self) -> usize {
        self.survey.meeting.count
    }

    /// Parts that hang together.
    #[getter]
    fn components(&self) -> usize {
        self.survey.components.len()
    }

    /// The error that the added mass may have, relative; None if the mesh is not ready.
    #[getter]
    fn expected_error(&self) -> Option<f64> {
        self.expected.map(|expected| expected.error_estimate)
    }

    /// How long the added mass may take on two cores (s); None if the mesh is not ready.
    #[getter]
    fn expected_seconds(&self) -> Option<f64> {
        self.expected.map(|expected| expected.seconds)
    }

    fn __bool__(&self) -> bool {
        self.ready()
    }

    fn __repr__(&self) -> String {
        match &self.fault {
            None => format!("<Check of {}: ready>", self.name),
            Some(fault) => format!("<Check of {}: not ready: {fault}>", self.name),
        }
    }
}

/// Looks for everything that is wrong with a mesh: a Mesh, a path, or anything with `vertices` and `faces`.
///
/// >>> cube = Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=12)
/// >>> result = check(Mesh(cube.vertices, cube.triangles[1:]))
/// >>> result.ready, result.holes.tolist()
/// (False, [3])
#[pyfunction]
pub(crate) fn check(mesh: &Bound<'_, PyAny>) -> PyResult<Check> {
    let py = mesh.py();
    let mesh = Mesh::of_argument(mesh)?;
    let mesh = mesh.get();
    let found = interruptible(py, |wanted| {
        let survey = survey(&mesh.raw.vertices, &mesh.raw.triangles, wanted)?;
        let foretold = survey
            .body
            .as_ref()
            .ok()
            .map(|body| expected(body, &Options::default()));
        Some((survey, foretold))
    })?;
    let Some((survey, foretold)) = found else {
        return Err(PyKeyboardInterrupt::new_err("the check was interrupted"));
    };
    let of_body = survey.body.as_ref().err().map(ToString::to_string);
    let of_size = foretold.as_ref().and_then(|f| f.as_ref().err());
    Ok(Check {
        name: mesh.name.clone(),
        fault: of_body.or(of_size.map(ToString::to_string)),
        expected: foretold.and_then(Result::ok),
        survey,
    })
}
