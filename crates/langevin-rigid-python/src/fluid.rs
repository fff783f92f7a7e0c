//! The fluid around bodies.

use langevin_rigid::Fluid as RunTimeFluid;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays;

/// A homogeneous fluid: density (kg/m^3), kinematic viscosity (m^2/s), and the velocity of a uniform steady stream
/// (3,), m/s, world frame.
///
/// >>> Fluid.water(velocity=[0.3, 0, 0])
/// Fluid(density=998.2, viscosity=1.004e-6, velocity=[0.3, 0.0, 0.0])
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Fluid(pub(crate) RunTimeFluid);

#[pymethods]
impl Fluid {
    #[new]
    #[pyo3(signature = (*, density, viscosity, velocity = None))]
    fn new(density: f64, viscosity: f64, velocity: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Ok(Self(RunTimeFluid {
            density,
            viscosity,
            velocity: arrays::vector_or(velocity, "velocity", [0.0; 3])?,
        }))
    }

    /// Air at 20 degrees Celsius and sea level.
    #[staticmethod]
    #[pyo3(signature = (*, velocity = None))]
    fn air(velocity: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let RunTimeFluid {
            density, viscosity, ..
        } = RunTimeFluid::AIR;
        Self::new(density, viscosity, velocity)
    }

    /// Fresh water at 20 degrees Celsius.
    #[staticmethod]
    #[pyo3(signature = (*, velocity = None))]
    fn water(velocity: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let RunTimeFluid {
            density, viscosity, ..
        } = RunTimeFluid::WATER;
        Self::new(density, viscosity, velocity)
    }

    /// Density (kg/m^3).
    #[getter]
    fn density(&self) -> f64 {
        self.0.density
    }

    /// Kinematic viscosity (m^2/s).
    #[getter]
    fn viscosity(&self) -> f64 {
        self.0.viscosity
    }

    /// Velocity of the stream, world frame (3,), m/s.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.velocity)
    }

    fn __repr__(&self) -> String {
        let RunTimeFluid {
            density,
            viscosity,
            velocity,
        } = self.0;
        format!("Fluid(density={density}, viscosity={viscosity:e}, velocity={velocity:?})")
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let RunTimeFluid {
            density,
            viscosity,
            velocity,
        } = slf.get().0;
        let unpickle = py
            .import("langevin_rigid._native")?
            .getattr("_fluid_of_parts")?;
        Ok((unpickle, (density, viscosity, velocity).into_pyobject(py)?))
    }
}

/// Unpickles a fluid.
#[pyfunction]
pub(crate) fn _fluid_of_parts(density: f64, viscosity: f64, velocity: [f64; 3]) -> Fluid {
    Fluid(RunTimeFluid {
        density,
        viscosity,
        velocity,
    })
}
