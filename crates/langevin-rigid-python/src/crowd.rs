//! Many bodies of a scene in real time.

use langevin_rigid_scenes::real_time::{RealTime, RealTimeError, real_time};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays;
use crate::errors::{OrRaise, Raised};
use crate::interrupt::interruptible;
use crate::scene::{Cache, Scene, prepare};

impl Raised for RealTimeError {
    fn raised(self) -> PyErr {
        match self {
            RealTimeError::Step(error) => error.raised(),
            error => PyValueError::new_err(error.to_string()),
        }
    }
}

/// How many bodies of a scene kept up with 60 frames a second.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Crowd(RealTime);

#[pymethods]
impl Crowd {
    /// Name of the scene.
    #[getter]
    fn scene(&self) -> &str {
        &self.0.scene
    }

    /// Name of the model.
    #[getter]
    fn model(&self) -> &str {
        &self.0.model
    }

    /// Bodies that were stepped.
    #[getter]
    fn bodies(&self) -> u32 {
        self.0.bodies
    }

    /// Threads that shared them.
    #[getter]
    fn threads(&self) -> usize {
        self.0.threads
    }

    /// Time step (s).
    #[getter]
    fn time_step(&self) -> f64 {
        self.0.time_step
    }

    /// How long the steps of each frame took (n,), s.
    #[getter]
    fn frame_times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let times = self.0.spent.iter().map(|time| time.as_secs_f64());
        arrays::of_column(py, times.collect())
    }

    /// Frames whose steps took longer than a frame.
    #[getter]
    fn missed_frames(&self) -> usize {
        self.0.missed_frames
    }

    /// Number of frames.
    fn __len__(&self) -> usize {
        self.0.frames
    }

    fn __repr__(&self) -> String {
        format!(
            "<Crowd: {} bodies of {}, {} frames, {} missed, {:.1} ms each (median)>",
            self.0.bodies,
            self.0.scene,
            self.0.frames,
            self.0.missed_frames,
            self.0.median_frame_ms
        )
    }
}

/// Steps so many bodies of a scene on all cores in real time, `seconds` (s) long at 60 frames a second, and counts the frames
/// that are missed.
///
/// All bodies begin at the scene's release, each with noise of its own; walls, floors and other bodies do not act. `model`
/// takes the place of the scene's.
///
/// >>> coins = crowd("coin", 100, seconds=0.1)
/// >>> len(coins), coins.frame_times.shape
/// (6, (6,))
#[pyfunction]
#[pyo3(signature = (
    scene, bodies = 100_000, *, seconds = 10.0, model = None, cache = Cache::default()
))]
pub(crate) fn crowd(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    bodies: u32,
    seconds: f64,
    model: Option<&str>,
    cache: Cache,
) -> PyResult<Crowd> {
    let mut scene = Scene::of_argument(scene)?.get().scene.clone();
    if let Some(model) = model {
        scene.set_model(model.parse().or_raise()?);
    }
    let prepared = prepare(py, scene, &cache)?;
    let crowd = interruptible(py, |wanted| real_time(&prepared, bodies, seconds, wanted))?;
    Ok(Crowd(crowd.or_raise()?))
}
