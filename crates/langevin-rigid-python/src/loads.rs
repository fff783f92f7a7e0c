//! What acts on a body, by cause.

use langevin_rigid::{Loads as RunTimeLoads, Wrench as RunTimeWrench};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays;

/// What acts on a body, a `Wrench` for each cause: a mapping with the keys "weight", "buoyancy", "added_mass", "drag",
/// "normal_force", "rotational_lift", "damping", "lost_couple", "friction", "turbulence", "fluid_acceleration", "outside".
#[pyclass(frozen, mapping, module = "langevin_rigid")]
pub(crate) struct Loads(pub(crate) RunTimeLoads);

#[pymethods]
impl Loads {
    /// All together.
    #[getter]
    fn sum(&self) -> Wrench {
        Wrench(self.0.sum())
    }

    /// The causes.
    fn keys(&self) -> Vec<&'static str> {
        self.0.causes().map(|(cause, _)| cause).to_vec()
    }

    /// What each gives.
    fn values(&self) -> Vec<Wrench> {
        self.0.causes().map(|(_, wrench)| Wrench(wrench)).into()
    }

    /// Both.
    fn items(&self) -> Vec<(&'static str, Wrench)> {
        self.0
            .causes()
            .map(|(cause, wrench)| (cause, Wrench(wrench)))
            .into()
    }

    fn __getitem__(&self, cause: &str) -> PyResult<Wrench> {
        let causes = self.0.causes();
        let found = causes.iter().find(|(name, _)| *name == cause);
        found.map(|(_, wrench)| Wrench(*wrench)).ok_or_else(|| {
            let known = causes.map(|(name, _)| name).join(", ");
            PyKeyError::new_err(format!("`{cause}` is no cause of loads; there are {known}"))
        })
    }

    fn __contains__(&self, cause: &str) -> bool {
        self.0.causes().iter().any(|(name, _)| *name == cause)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyList::new(py, self.keys())?.call_method0("__iter__")
    }

    fn __len__(&self) -> usize {
        self.0.causes().len()
    }

    fn __repr__(&self) -> String {
        let acts = |wrench: &RunTimeWrench| *wrench != RunTimeWrench::default();
        let causes = self.0.causes();
        let acting = causes.iter().filter(|(_, wrench)| acts(wrench));
        let acting: Vec<&str> = acting.map(|(cause, _)| *cause).collect();
        format!("<Loads: {}>", acting.join(", "))
    }
}

/// A force and a torque about the centre of mass, world frame.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Wrench(RunTimeWrench);

#[pymethods]
impl Wrench {
    /// Force (3,), N.
    #[getter]
    fn force<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.force)
    }

    /// Torque (3,), N m.
    #[getter]
    fn torque<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.torque)
    }

    fn __repr__(&self) -> String {
        let RunTimeWrench { force, torque } = self.0;
        format!("Wrench(force={force:?}, torque={torque:?})")
    }
}
