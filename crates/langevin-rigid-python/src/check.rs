//! What is wrong with a mesh, all of it.

use langevin_rigid_bake::added_mass::Expected;
use langevin_rigid_bake::check::{Checked, check as look};
use langevin_rigid_bake::mesh::{Component, Options, Step};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::interrupt::interruptible;
use crate::mesh::Mesh;

/// What a mesh is and what is wrong with it. Lengths are in metres, counts are of what is named.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Check {
    name: String,
    checked: Checked,
}

impl Check {
    fn expected(&self) -> Option<&Expected> {
        self.checked.expected.as_ref()?.as_ref().ok()
    }
}

#[pymethods]
impl Check {
    /// Whether it is a body that can be baked.
    #[getter]
    fn ready(&self) -> bool {
        self.checked.ready()
    }

    /// Why not, at first sight; None if it is ready.
    #[getter]
    fn fault(&self) -> Option<String> {
        self.checked.fault()
    }

    /// Everything that was found wrong, a line each; empty if nothing is.
    #[getter]
    fn findings(&self) -> Vec<String> {
        let holes = self
            .checked
            .survey
            .holes
            .iter()
            .map(|hole| format!("hole: {hole}"));
        let others = self.checked.survey.findings().into_iter();
        let others = others.filter(|finding| finding.count > 0);
        holes
            .chain(others.map(|finding| format!("{}: {}", finding.name, finding.words)))
            .collect()
    }

    /// Triangles given.
    #[getter]
    fn triangles(&self) -> usize {
        self.checked.survey.triangles
    }

    /// Vertices given.
    #[getter]
    fn vertices(&self) -> usize {
        self.checked.survey.vertices
    }

    /// Lowest and highest corner of the box around it (2, 3), m.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.checked.survey.bounds)
    }

    /// Area of all sound triangles (m^2).
    #[getter]
    fn area(&self) -> f64 {
        self.checked.survey.area
    }

    /// Volume of the solid without its cavities (m^3); None while the surface is not closed or meets itself.
    #[getter]
    fn volume(&self) -> Option<f64> {
        self.checked.survey.closed_volume()
    }

    /// Edges around each hole, the longest perimeter first.
    #[getter]
    fn holes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let edges = self
            .checked
            .survey
            .holes
            .iter()
            .map(|hole| hole.edges as u64);
        arrays::of_column(py, edges.collect())
    }

    /// Middle of each hole (k, 3), m.
    #[getter]
    fn hole_centres<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centres: Vec<[f64; 3]> = self
            .checked
            .survey
            .holes
            .iter()
            .map(|hole| hole.centre)
            .collect();
        arrays::of_rows(py, &centres)
    }

    /// Triangles without area.
    #[getter]
    fn degenerate(&self) -> usize {
        self.checked.survey.degenerate
    }

    /// Triangles that repeat another.
    #[getter]
    fn duplicates(&self) -> usize {
        self.checked.survey.duplicates
    }

    /// Vertices of no triangle.
    #[getter]
    fn unused_vertices(&self) -> usize {
        self.checked.survey.unused_vertices
    }

    /// Open vertices at or near the place of another.
    #[getter]
    fn unwelded(&self) -> usize {
        self.checked.survey.seams.vertices
    }

    /// Triangles that wind unlike their neighbours.
    #[getter]
    fn flipped(&self) -> usize {
        self.checked.survey.flipped
    }

    /// Whether normals of a component point into the solid, which is mended on the way.
    #[getter]
    fn inside_out(&self) -> bool {
        self.checked
            .survey
            .components
            .iter()
            .any(Component::is_inside_out)
    }

    /// Edges of more than two triangles.
    #[getter]
    fn non_manifold_edges(&self) -> usize {
        self.checked.survey.non_manifold_edges.count
    }

    /// Vertices where parts touch in a point.
    #[getter]
    fn non_manifold_vertices(&self) -> usize {
        self.checked.survey.non_manifold_vertices.count
    }

    /// Triangles that pass through others or lie on them.
    #[getter]
    fn intersections(&self) -> usize {
        self.checked.survey.meeting.count
    }

    /// Parts that hang together.
    #[getter]
    fn components(&self) -> usize {
        self.checked.survey.components.len()
    }

    /// The error that the added mass may have, relative: the mesh's, or that of what `repair` makes of it; None where there
    /// is no body to tell it of.
    #[getter]
    fn expected_error(&self) -> Option<f64> {
        self.expected().map(|expected| expected.error_estimate)
    }

    /// How long that added mass may take on as many idle cores as there are threads (s).
    #[getter]
    fn expected_seconds(&self) -> Option<f64> {
        self.expected().map(|expected| expected.seconds)
    }

    /// What `repair` is to be told to make it ready, the mildest that does: `repair(mesh, **check.repair)`, where `{}` is
    /// nothing special. None if it is ready, or if nothing helps.
    ///
    /// A `thickness` in it was only tried: put that of your sheet in its place.
    ///
    /// >>> cube = Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=12)
    /// >>> opened = Mesh(cube.vertices, cube.triangles[1:])
    /// >>> check(opened).repair
    /// {}
    /// >>> repair(opened, **check(opened).repair).mesh.is_body
    /// True
    #[getter]
    fn repair<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let options = self.checked.repair();
        options.map(|options| keywords(py, &options)).transpose()
    }

    /// The same for a mesh whose hole may be the rim of a sheet; None if it is none.
    #[getter]
    fn repair_of_sheet<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let options = self.checked.remedy.sheet;
        options.map(|options| keywords(py, &options)).transpose()
    }

    /// What `repair` would do then, in order, a sentence each.
    #[getter]
    fn repair_steps(&self) -> Vec<String> {
        let steps = self.checked.remedy.steps.iter();
        steps.map(Step::to_string).collect()
    }

    /// What its owner should look at then, a sentence each.
    #[getter]
    fn repair_warnings(&self) -> Vec<String> {
        let balance = self.checked.remedy.balance.as_ref();
        balance.map_or_else(Vec::new, |balance| balance.warnings())
    }

    /// What is left to do by hand where no repair helps; None where one does, or none is needed.
    #[getter]
    fn left(&self) -> Option<String> {
        let remedy = &self.checked.remedy;
        let left = remedy.left.as_ref().filter(|_| remedy.options.is_none());
        left.map(ToString::to_string)
    }

    fn __bool__(&self) -> bool {
        self.ready()
    }

    fn __repr__(&self) -> String {
        match self.fault() {
            None => format!("<Check of {}: ready>", self.name),
            Some(fault) => format!("<Check of {}: not ready: {fault}>", self.name),
        }
    }
}

/// Looks for everything that is wrong with a mesh, and for the repair that mends it: a Mesh, a path, or anything with
/// `vertices` and `faces`.
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
    let checked = interruptible(py, |wanted| {
        look(&mesh.raw.vertices, &mesh.raw.triangles, wanted)
    })?;
    let Some(checked) = checked else {
        return Err(PyKeyboardInterrupt::new_err("the check was interrupted"));
    };
    Ok(Check {
        name: mesh.name.clone(),
        checked,
    })
}

/// Options of `repair` as it takes them, without those that are as usual.
fn keywords<'py>(py: Python<'py>, options: &Options) -> PyResult<Bound<'py, PyDict>> {
    let Options {
        weld,
        fill,
        thickness,
        triangles,
        wrap,
        largest,
    } = *options;
    let keywords = PyDict::new(py);
    for (name, length) in [("weld", weld), ("thickness", thickness), ("wrap", wrap)] {
        if let Some(length) = length {
            keywords.set_item(name, length)?;
        }
    }
    for (name, count) in [("fill", fill), ("triangles", triangles)] {
        if let Some(count) = count {
            keywords.set_item(name, count)?;
        }
    }
    if largest {
        keywords.set_item("largest", true)?;
    }
    Ok(keywords)
}
