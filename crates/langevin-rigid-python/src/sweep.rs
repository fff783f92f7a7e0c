//! Parts of sweeps: ensembles of many scenes as one table.

use std::path::PathBuf;

use langevin_rigid_formats::files::write_with;
use langevin_rigid_scenes::ensemble::LANDINGS_ABOUT;
use langevin_rigid_scenes::sweep::{Parameter, Piece, SweepError, part};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::errors::{OrRaise, Raised, SceneError};
use crate::interrupt::interruptible;
use crate::scene::{Cache, Scene};

impl Raised for SweepError {
    fn raised(self) -> PyErr {
        match self {
            SweepError::Prepare(error) => error.raised(),
            error => SceneError::new_err(error.to_string()),
        }
    }
}

/// Some runs of a point: its number, its scene, its parameters, and the first run and the one after the last.
type Given<'py> = (u32, Bound<'py, PyAny>, Bound<'py, PyDict>, u32, u32);

/// Computes a part of a sweep and writes it to a Parquet file, whole or not at all; on one thread, as there are many parts.
#[pyfunction]
pub(crate) fn _sweep_part(
    py: Python<'_>,
    pieces: Vec<Given<'_>>,
    path: PathBuf,
    cache: Cache,
) -> PyResult<()> {
    let pieces = pieces
        .into_iter()
        .map(|(point, scene, parameters, from, to)| {
            Ok(Piece {
                point,
                scene: Scene::of_argument(&scene)?.get().scene.clone(),
                parameters: parameters
                    .iter()
                    .map(|(name, value)| Ok((name.extract()?, parameter(&value)?)))
                    .collect::<PyResult<_>>()?,
                runs: from..to,
            })
        });
    let pieces: Vec<Piece> = pieces.collect::<PyResult<_>>()?;
    let table = interruptible(py, |wanted| {
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let alone = alone.map_err(|error| {
            pyo3::exceptions::PyRuntimeError::new_err(format!("cannot start a thread: {error}"))
        })?;
        alone
            .install(|| part(&pieces, cache.folder().as_deref(), wanted))
            .or_raise()
    })??;
    // Cancelled work ended by its signal.
    let Some(table) = table else { return Ok(()) };
    py.detach(|| write_with(&path, |out| table.write_parquet(LANDINGS_ABOUT, out)))
        .or_raise()
}

/// A number, a list of numbers, or a word.
fn parameter(value: &Bound<'_, PyAny>) -> PyResult<Parameter> {
    if let Ok(word) = value.cast::<PyString>() {
        return Ok(Parameter::Word(word.extract()?));
    }
    match value.extract::<f64>() {
        Ok(number) => Ok(Parameter::Number(number)),
        Err(_) => Ok(Parameter::List(value.extract()?)),
    }
}
