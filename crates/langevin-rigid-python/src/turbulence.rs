//! Turbulence at the body, precomputed on a grid.

use langevin_rigid::{Turbulence, TurbulenceHistory as History};
use langevin_rigid_bake::turbulence::{FlowOptions, Sampling, turbulence_history};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays;
use crate::errors::{BakeError, OrRaise};
use crate::interrupt::interruptible;

/// Turbulent kinetic energy and its dissipation rate at the body, at equal intervals from release.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct TurbulenceHistory(pub(crate) History);

#[pymethods]
impl TurbulenceHistory {
    /// From numbers of your own: the interval between two of them (s), the speed (m/s) and the length (m) that they were
    /// computed for, k (n,), m^2/s^2, and epsilon (n,), m^2/s^3.
    #[new]
    #[pyo3(signature = (*, interval, inflow_speed, length, k, epsilon))]
    fn new(
        interval: f64,
        inflow_speed: f64,
        length: f64,
        k: &Bound<'_, PyAny>,
        epsilon: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let history = History {
            interval,
            inflow_speed,
            length,
            k: arrays::column(k, "k")?,
            epsilon: arrays::column(epsilon, "epsilon")?,
        };
        history
            .check()
            .map_err(|error| BakeError::new_err(error.to_string()))?;
        Ok(Self(history))
    }

    /// Times since release (n,), s.
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let times = (0..self.0.k.len()).map(|i| i as f64 * self.0.interval);
        arrays::of_column(py, times.collect())
    }

    /// Turbulent kinetic energy (n,), m^2/s^2.
    #[getter]
    fn k<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_column(py, self.0.k.clone())
    }

    /// Dissipation rate (n,), m^2/s^3.
    #[getter]
    fn epsilon<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_column(py, self.0.epsilon.clone())
    }

    /// Turbulence frequency epsilon / k (n,), 1/s.
    #[getter]
    fn chi<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let both = self.0.k.iter().zip(&self.0.epsilon);
        let chi = both.map(|(&k, &epsilon)| Turbulence { k, epsilon }.frequency());
        arrays::of_column(py, chi.collect())
    }

    /// Time between two entries (s).
    #[getter]
    fn interval(&self) -> f64 {
        self.0.interval
    }

    /// Speed of the stream (m/s).
    #[getter]
    fn inflow_speed(&self) -> f64 {
        self.0.inflow_speed
    }

    /// Length l of Eq. (18), the edge of a cell (m).
    #[getter]
    fn length(&self) -> f64 {
        self.0.length
    }

    fn __len__(&self) -> usize {
        self.0.k.len()
    }

    fn __repr__(&self) -> String {
        format!(
            "<TurbulenceHistory: {} entries of {:.4e} s, stream of {} m/s>",
            self.0.k.len(),
            self.0.interval,
            self.0.inflow_speed
        )
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, history) = (slf.py(), slf.get());
        let unpickle = py
            .import("langevin_rigid._native")?
            .getattr("_history_of_parts")?;
        let numbers = (history.0.interval, history.0.inflow_speed, history.0.length);
        let parts = (numbers, history.k(py), history.epsilon(py));
        Ok((unpickle, parts.into_pyobject(py)?))
    }
}

/// Unpickles a history.
#[pyfunction]
pub(crate) fn _history_of_parts(
    numbers: (f64, f64, f64),
    k: &Bound<'_, PyAny>,
    epsilon: &Bound<'_, PyAny>,
) -> PyResult<TurbulenceHistory> {
    TurbulenceHistory::new(numbers.0, numbers.1, numbers.2, k, epsilon)
}

/// The turbulence at a body in a stream of `inflow_speed` (m/s), by the k-epsilon model on a grid of `cells` along
/// x, y and z, (32, 32, 16) by default, of edge `cell` (m): Algorithm 1 of the paper.
///
/// `time_step` (s) is by default that in which the stream crosses a cell, `duration` (s) that in which it crosses the grid.
/// `drifting` reads at a passive particle that drifts along in place of the body.
///
/// >>> history = turbulence(inflow_speed=0.81, cell=0.01)
/// >>> len(history), round(float(history.k[0]), 6)
/// (33, 0.98415)
#[pyfunction]
#[pyo3(signature = (
    *, inflow_speed, cell, cells = None, time_step = None, duration = None, drifting = false
))]
pub(crate) fn turbulence(
    py: Python<'_>,
    inflow_speed: f64,
    cell: f64,
    cells: Option<[usize; 3]>,
    time_step: Option<f64>,
    duration: Option<f64>,
    drifting: bool,
) -> PyResult<TurbulenceHistory> {
    let cells = cells.unwrap_or(FlowOptions::PAPER_CELLS);
    let usual = FlowOptions::new(cells, cell, inflow_speed);
    let options = FlowOptions {
        time_step: time_step.unwrap_or(usual.time_step),
        duration: duration.unwrap_or(usual.duration),
        sampling: match drifting {
            true => Sampling::PassiveParticle,
            false => Sampling::Fixed,
        },
        ..usual
    };
    let history = interruptible(py, |wanted| turbulence_history(&options, wanted))?;
    Ok(TurbulenceHistory(history.or_raise()?))
}
