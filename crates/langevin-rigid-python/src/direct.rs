//! Releases whose fall does what is asked.

use std::sync::Arc;

use langevin_rigid_scenes::direct::{Directed as Found, search};
use langevin_rigid_scenes::prepared::Prepared;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{OrRaise, SceneError};
use crate::interrupt::interruptible;
use crate::scene::{Cache, Scene, prepare};
use crate::state::State;

/// A fall that was found.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Directed {
    prepared: Arc<Prepared>,
    found: Found,
    asks: Arc<Vec<String>>,
}

#[pymethods]
impl Directed {
    /// By how much it misses what is asked: zero for a fall that does it.
    #[getter]
    fn score(&self) -> f64 {
        self.found.score()
    }

    /// How far it is from each thing asked, in units of the tolerance.
    #[getter]
    fn misses(&self) -> Vec<(String, f64)> {
        let misses = self.found.misses.iter().copied();
        self.asks.iter().cloned().zip(misses).collect()
    }

    /// Where it begins.
    #[getter]
    fn release(&self) -> State {
        State(self.found.release.state)
    }

    /// Its last state.
    #[getter]
    fn end(&self) -> State {
        State(self.found.last)
    }

    /// The scene of this fall alone, which `simulate` runs to the same bits.
    #[getter]
    fn scene(&self) -> PyResult<Scene> {
        let scene = self.found.scene(&self.prepared);
        let name = scene.name.clone();
        let text = scene
            .to_toml()
            .map_err(|error| SceneError::new_err(error.to_string()))?;
        Scene::parse(text, &name)
    }

    fn __repr__(&self) -> String {
        let [x, y, z] = self.found.last.position;
        format!(
            "<Directed: misses by {:.3}, ends at ({x:.3}, {y:.3}, {z:.3}) m after {:.3} s>",
            self.found.score(),
            self.found.last.time
        )
    }
}

/// Finds falls that do what the `[direct]` of a scene asks (docs/directing.md), the best first, different from each other.
///
/// `falls` is how many are tried at most and `best` how many are wanted, in place of the scene's.
///
/// >>> found = direct("direct-leaf", falls=2000, best=1)
/// >>> len(found)
/// 1
#[pyfunction]
#[pyo3(signature = (scene, *, falls = None, best = None, seed = None, cache = Cache::default()))]
pub(crate) fn direct(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    falls: Option<u32>,
    best: Option<u32>,
    seed: Option<u64>,
    cache: Cache,
) -> PyResult<Vec<Directed>> {
    let mut scene = Scene::of_argument(scene)?.get().scene.clone();
    scene.seed = seed.unwrap_or(scene.seed);
    for (name, number) in [("falls", falls), ("best", best)] {
        if number == Some(0) {
            return Err(PyValueError::new_err(format!(
                "{name} is 0; it must be at least 1"
            )));
        }
    }
    if let Some(asked) = &mut scene.direct {
        asked.falls = falls.unwrap_or(asked.falls);
        asked.best = best.unwrap_or(asked.best);
    }
    let prepared = prepare(py, scene, &cache)?;
    let found = interruptible(py, |wanted| search(&prepared, wanted))?.or_raise()?;
    let asks = Arc::new(found.asks);
    let each = found.best.into_iter().map(|found| Directed {
        prepared: Arc::clone(&prepared),
        found,
        asks: Arc::clone(&asks),
    });
    Ok(each.collect())
}
