//! Many falls of a scene.

use std::path::PathBuf;
use std::sync::Arc;

use langevin_rigid_scenes::ensemble::{
    Fall, Journal, LANDINGS_ABOUT, Statistics, landings, run as run_all, run_with,
};
use langevin_rigid_scenes::prepared::Prepared;
use numpy::PyArray2;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::errors::{OrRaise, SceneError};
use crate::interrupt::interruptible;
use crate::run::to_python;
use crate::scene::{Cache, Scene, prepare};
use crate::table::Table;

/// Many falls of one scene.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Ensemble {
    prepared: Arc<Prepared>,
    falls: Vec<Fall>,
}

#[pymethods]
impl Ensemble {
    /// How each run began and ended, a row each: see docs/scenes.md#ensembles for the columns.
    #[getter]
    fn landings(&self) -> Table {
        Table {
            columns: landings(&self.prepared, &self.falls),
            about: LANDINGS_ABOUT,
        }
    }

    /// What the falls have in common, as the command writes it into `statistics.json`.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &Statistics::new(&self.falls))
    }

    /// Where the centre of mass of a fall was at 0, 1/60 s, 2/60 s, ...: x, depth and z from the scene's release point
    /// (n, 3), m. `index` counts the rows of `landings`.
    fn path<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        match self.falls.get(index) {
            Some(fall) => arrays::of_rows(py, &fall.samples),
            None => Err(PyIndexError::new_err(format!(
                "there is no fall {index}; there are {}",
                self.falls.len()
            ))),
        }
    }

    /// A pandas.DataFrame of `landings`. Needs pandas.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.landings().to_pandas(py)
    }

    fn __len__(&self) -> usize {
        self.falls.len()
    }

    fn __repr__(&self) -> String {
        let (name, falls) = (&self.prepared.scene().name, self.falls.len());
        format!("<Ensemble of {name}: {falls} falls>")
    }
}

/// Drops the body of a scene `runs` times, each with its own noise and draw, on all cores.
///
/// `scatter` says what is drawn, by the keys of `[scatter]` (docs/scenes.md#ensembles): a standard deviation, a list of
/// values, `uniform(least, most)` or `normal(mean, deviation)`. It is added to what the scene scatters. The runs are numbered
/// from `first` on, and a run is decided by the seed and its number.
///
/// `journal` names a file where falls are kept as they end. If it is there, its falls are not made again; it is removed when
/// all have ended.
///
/// >>> from langevin_rigid import uniform
/// >>> ball = {
/// ...     "fluid": {"preset": "water"},
/// ...     "body": {"shape": "ellipsoid", "semi_axes": [0.01, 0.01, 0.01], "density": 2000.0, "triangles": 80},
/// ...     "release": {"position": [0.0, 1.0, 0.0]},
/// ...     "run": {"time_step": 0.002, "ground": 0.0},
/// ... }
/// >>> fall = ensemble(ball, 100, scatter={"height": uniform(0.5, 1.0)})
/// >>> bool((fall.landings["height"] < 1.0).all())
/// True
#[pyfunction]
#[pyo3(signature = (
    scene, runs, *, scatter = None, seed = None, model = None, first = 0, journal = None,
    cache = Cache::default()
))]
#[expect(clippy::too_many_arguments, reason = "they have names")]
pub(crate) fn ensemble(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    runs: u32,
    scatter: Option<&Bound<'_, PyDict>>,
    seed: Option<u64>,
    model: Option<&str>,
    first: u32,
    journal: Option<PathBuf>,
    cache: Cache,
) -> PyResult<Ensemble> {
    let given = Scene::of_argument(scene)?;
    let mut scene = match scatter {
        Some(scatter) => given.get().scattered(py, scatter)?.scene,
        None => given.get().scene.clone(),
    };
    let last = first
        .checked_add(runs)
        .filter(|_| runs > 0)
        .ok_or_else(|| {
            PyValueError::new_err(format!(
                "runs is {runs} and first {first}; at least one falls, and the last number is {}",
                u32::MAX
            ))
        })?;
    scene.seed = seed.unwrap_or(scene.seed);
    if let Some(model) = model {
        scene.set_model(model.parse().or_raise()?);
    }
    let prepared = prepare(py, scene, &cache)?;
    prepared
        .check_release()
        .map_err(|error| SceneError::new_err(error.to_string()))?;
    let falls = match journal {
        None => interruptible(py, |wanted| run_all(&prepared, first..last, wanted))?,
        Some(path) => {
            let journal = Journal::open(&path, &prepared).or_raise()?;
            let falls = interruptible(py, |wanted| {
                run_with(&prepared, first..last, &journal, wanted)
            })?;
            let falls = falls.or_raise()?;
            journal.remove().or_raise()?;
            falls
        }
    };
    Ok(Ensemble { prepared, falls })
}
