//! Added mass of a mesh, and its files for other programs.

use std::path::PathBuf;
use std::time::Instant;

use langevin_rigid::choose;
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{AddedMass as Solution, Options, added_mass as solve};
use langevin_rigid_formats::added_mass::{
    Proxy, Report, capytaine, csv, json, mujoco, sdf, table, uuv,
};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::OrRaise;
use crate::interrupt::interruptible;
use crate::mesh::Mesh;
use crate::{arrays, files};

/// The added mass of a body in unbounded fluid, about its centroid unless it is moved.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct AddedMass {
    report: Report,
}

#[pymethods]
impl AddedMass {
    /// The tensor (6, 6): kg, kg m and kg m^2 in the blocks, translations along x, y, z first, in the axes of the mesh.
    ///
    /// Positive where the fluid resists acceleration, symmetric.
    #[getter]
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.report.added_mass)
    }

    /// The point that the matrix refers to, in the coordinates of the mesh (3,), m.
    #[getter]
    fn reference<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.report.reference)
    }

    /// Centroid of the volume, in the coordinates of the mesh (3,), m.
    #[getter]
    fn centroid<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.report.centroid)
    }

    /// Volume of the fluid displaced (m^3).
    #[getter]
    fn volume(&self) -> f64 {
        self.report.volume
    }

    /// Density of the fluid (kg/m^3).
    #[getter]
    fn density(&self) -> f64 {
        self.report.fluid_density
    }

    /// Estimated relative error of the matrix, that of a proxy included: beside the largest entry of each block. Entries far
    /// smaller than that may be off by more.
    #[getter]
    fn error_estimate(&self) -> f64 {
        self.report.error_estimate
    }

    /// What makes the result doubtful, a sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.report.warnings.clone()
    }

    /// Name of the mesh.
    #[getter]
    fn mesh(&self) -> &str {
        &self.report.mesh
    }

    /// Triangles of the mesh.
    #[getter]
    fn triangles(&self) -> usize {
        self.report.triangles
    }

    /// Triangles of the refined mesh that was solved on.
    #[getter]
    fn triangles_solved(&self) -> usize {
        self.report.triangles_solved
    }

    /// How long it took (s).
    #[getter]
    fn seconds(&self) -> f64 {
        self.report.seconds
    }

    /// The same about another point in the coordinates of the mesh (3,), m.
    ///
    /// >>> ball = added_mass(Mesh.shape("ellipsoid", semi_axes=[0.1, 0.1, 0.1], triangles=320))
    /// >>> moved = ball.about([1.0, 0.0, 0.0])
    /// >>> bool(abs(moved.matrix[2, 4] / ball.matrix[2, 2] - 1.0) < 1e-6)
    /// True
    fn about(&self, point: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self {
            report: self.report.about(arrays::vector(point, "point")?),
        })
    }

    /// The text that the command's `added-mass --format` writes: "table", "json", "csv", "sdf" (Gazebo), "uuv" (UUV
    /// Simulator), "mujoco" or "capytaine".
    ///
    /// What the format wants about a certain point is about that point, whatever `reference` is.
    fn text(&self, format: &str) -> PyResult<String> {
        type Writer = fn(&Report) -> PyResult<String>;
        let writers: [(&'static str, Writer); 7] = [
            ("table", |report| Ok(table(report))),
            ("json", |report| {
                json(report).map_err(|error| PyValueError::new_err(error.to_string()))
            }),
            ("csv", |report| Ok(csv(report))),
            ("sdf", |report| Ok(sdf(report))),
            ("uuv", |report| Ok(uuv(report))),
            ("mujoco", |report| Ok(mujoco(report))),
            ("capytaine", |report| Ok(capytaine(report))),
        ];
        choose("format of added mass", format, writers).or_raise()?(&self.report)
    }

    /// Writes that text to a file, whole or not at all.
    #[pyo3(signature = (path, *, format))]
    fn save(&self, py: Python<'_>, path: PathBuf, format: &str) -> PyResult<()> {
        files::write(py, &path, self.text(format)?.as_bytes())
    }

    fn __repr__(&self) -> String {
        let Report {
            mesh,
            triangles_solved,
            fluid_density,
            error_estimate,
            ..
        } = &self.report;
        format!(
            "<AddedMass of {mesh}: {triangles_solved} triangles solved, density {fluid_density} kg/m^3, error about {:.2} %, {} warnings>",
            100.0 * error_estimate,
            self.report.warnings.len()
        )
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let report = &slf.get().report;
        let proxy = report.proxy.as_ref();
        let parts = (
            (&report.mesh, report.triangles, report.triangles_solved),
            (report.volume, report.centroid, report.fluid_density),
            (report.reference, report.added_mass, report.error_estimate),
            proxy.map(|p| (p.triangles, p.deviation, p.error_estimate)),
            report.warnings.clone(),
            report.seconds,
        );
        let unpickle = py
            .import("langevin_rigid._native")?
            .getattr("_added_mass_of_parts")?;
        Ok((unpickle, parts.into_pyobject(py)?))
    }
}

/// Unpickles an added mass.
#[pyfunction]
pub(crate) fn _added_mass_of_parts(
    mesh: (String, usize, usize),
    body: (f64, [f64; 3], f64),
    tensor: ([f64; 3], [[f64; 6]; 6], f64),
    proxy: Option<(usize, f64, f64)>,
    warnings: Vec<String>,
    seconds: f64,
) -> AddedMass {
    let (mesh, triangles, triangles_solved) = mesh;
    let (volume, centroid, fluid_density) = body;
    let (reference, added_mass, error_estimate) = tensor;
    AddedMass {
        report: Report {
            mesh,
            triangles,
            triangles_solved,
            volume,
            centroid,
            fluid_density,
            reference,
            added_mass,
            error_estimate,
            proxy: proxy.map(|(triangles, deviation, error_estimate)| Proxy {
                triangles,
                deviation,
                error_estimate,
            }),
            warnings,
            seconds,
        },
    }
}

/// Added mass of a closed body in unbounded fluid of this density (kg/m^3), by boundary elements, about its centroid.
///
/// `mesh` is a Mesh, a path of a mesh file in metres, or anything with `vertices` and `faces`. `proxy` solves on a mesh
/// simplified to about so many triangles, whose part of the error is estimated and added. A mesh of fewer than
/// `target_triangles` is refined to about as many first; one that takes more than `max_triangles` is refused.
///
/// MeshError if it is no body, BakeError if there is no tensor.
///
/// >>> ball = Mesh.shape("ellipsoid", semi_axes=[0.1, 0.1, 0.1], triangles=1280)
/// >>> result = added_mass(ball, density=1000.0)
/// >>> bool(abs(result.matrix[0, 0] / (0.5 * 1000.0 * ball.volume) - 1.0) < 0.002)
/// True
/// >>> result.warnings
/// []
#[pyfunction]
#[pyo3(signature = (mesh, *, density = 1.0, proxy = None, target_triangles = None, max_triangles = None))]
pub(crate) fn added_mass(
    mesh: &Bound<'_, PyAny>,
    density: f64,
    proxy: Option<usize>,
    target_triangles: Option<usize>,
    max_triangles: Option<usize>,
) -> PyResult<AddedMass> {
    if !(density > 0.0 && density.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "density is {density}; it must be a positive number (kg/m^3)"
        )));
    }
    let started = Instant::now();
    let py = mesh.py();
    let mesh = Mesh::of_argument(mesh)?;
    let mesh = mesh.get();
    let body = mesh.body(py)?;
    let usual = Options::default();
    let options = Options {
        target_triangles: target_triangles.unwrap_or(usual.target_triangles),
        max_triangles: max_triangles.unwrap_or(usual.max_triangles),
    };
    let (solution, proxy) = interruptible(py, |wanted| {
        let Some(triangles) = proxy else {
            return solve(&body, &options, wanted).or_raise().map(|s| (s, None));
        };
        let simplified = body.proxy(triangles).or_raise()?;
        let solution = solve(&simplified, &options, wanted).or_raise()?;
        let error = solution.shape_error(&body);
        let proxy = Proxy {
            triangles: simplified.triangles().len(),
            deviation: error.deviation,
            error_estimate: error.estimate,
        };
        Ok::<_, PyErr>((solution, Some(proxy)))
    })??;
    let mut report = report(&body, &solution, proxy, density);
    report.mesh.clone_from(&mesh.name);
    report.seconds = started.elapsed().as_secs_f64();
    Ok(AddedMass { report })
}

/// The report about the centroid.
fn report(body: &TriMesh, solution: &Solution, proxy: Option<Proxy>, density: f64) -> Report {
    let mut warnings: Vec<String> = solution.warnings.iter().map(ToString::to_string).collect();
    if body.was_turned() {
        warnings.push("the mesh was inside out; its triangles were turned".into());
    }
    Report {
        mesh: String::new(),
        triangles: body.triangles().len(),
        triangles_solved: solution.surface.triangles.len(),
        volume: body.volume(),
        centroid: solution.reference,
        fluid_density: density,
        reference: solution.reference,
        added_mass: solution.tensor.map(|row| row.map(|a| density * a)),
        error_estimate: solution.error_estimate
            + proxy.as_ref().map_or(0.0, |proxy| proxy.error_estimate),
        proxy,
        warnings,
        seconds: 0.0,
    }
}
