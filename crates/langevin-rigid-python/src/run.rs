//! Runs of a scene.

use std::path::PathBuf;
use std::sync::Arc;

use langevin_rigid::choose;
use langevin_rigid_formats::export::{self, Format, Options, RecordedBody, Recording};
use langevin_rigid_formats::files::Claim;
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_pictures::View;
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::prepared::{Fall, Prepared};
use langevin_rigid_scenes::shot::{FilmError, Shot, Shown};
use langevin_rigid_scenes::summary::Summary;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::body::Body;
use crate::errors::{OrRaise, Raised, SceneError};
use crate::files;
use crate::interrupt::interruptible;
use crate::scene::{Cache, Scene, prepare};
use crate::state::States;

/// What the bodies of a scene did.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Run {
    prepared: Arc<Prepared>,
    falls: Vec<Fall>,
}

#[pymethods]
impl Run {
    /// The states of the first body, from its release on.
    #[getter]
    fn states(&self) -> States {
        States(self.falls[0].states.clone())
    }

    /// The states of each body.
    #[getter]
    fn bodies(&self) -> Vec<States> {
        let states = self.falls.iter().map(|fall| fall.states.clone());
        states.map(States).collect()
    }

    /// How each body ended: ground, time, rest, memory or diverged.
    #[getter]
    fn endings(&self) -> Vec<&'static str> {
        self.falls.iter().map(Fall::ending).collect()
    }

    /// The body that fell, as it was baked.
    #[getter]
    fn body(&self) -> Body {
        Body::of(self.prepared.baked().bake.clone())
    }

    /// What the run comes to, in numbers: what the command writes into `summary.json`.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let summary = Summary::new(&self.prepared, &self.falls);
        to_python(py, &summary)
    }

    /// A pandas.DataFrame of the first body: see `States.to_pandas`.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Bound::new(py, self.states())?.call_method0("to_pandas")
    }

    /// Writes the run into a folder as `simulate` of the command does: in `formats` of `csv`, `npz`, `parquet`, `glb` and
    /// `usd`, with scene.toml and summary.json. Gives the names of the files.
    #[pyo3(signature = (folder, *, formats = vec!["csv".to_owned(), "glb".to_owned()], fps = 60.0))]
    fn save(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        formats: Vec<String>,
        fps: f64,
    ) -> PyResult<Vec<String>> {
        let formats = formats.iter().map(|name| name.parse::<Format>().or_raise());
        let formats: Vec<Format> = formats.collect::<PyResult<_>>()?;
        let mut summary = Summary::new(&self.prepared, &self.falls);
        let mut scene = self.prepared.scene().clone();
        scene.relocate(|path| std::path::absolute(path))?;
        let text = scene
            .to_toml()
            .map_err(|error| SceneError::new_err(error.to_string()))?;
        py.detach(|| -> PyResult<()> {
            let cast = Cast::new(&self.prepared)
                .map_err(|error| SceneError::new_err(error.to_string()))?;
            let trajectories = self.trajectories();
            let bodies = self.recorded(&trajectories);
            let kinds = cast.kinds();
            let run = Recording {
                conditions: self.prepared.scene().conditions(),
                kinds: &kinds,
                bodies: &bodies,
            };
            let options = Options {
                fps,
                ..Options::default()
            };
            for format in formats {
                let written = export::write(&run, format, &folder, &options);
                summary.wrote(
                    format,
                    written.map_err(|error| PyValueError::new_err(error.to_string()))?,
                );
            }
            Ok(())
        })?;
        files::write(py, &folder.join("scene.toml"), text.as_bytes())?;
        let json = serde_json::to_string_pretty(&summary)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        files::write(py, &folder.join("summary.json"), (json + "\n").as_bytes())?;
        let names = ["scene.toml", "summary.json"].map(str::to_owned);
        Ok(summary.files.into_iter().chain(names).collect())
    }

    /// Writes a picture of the motion as a PNG file: `shown` is `strobe` for the bodies at equal times, `path` for their
    /// paths, or `both`; `view` is `front`, `side`, `top`, `iso`, or `None` for front and side next to each other.
    ///
    /// >>> run = simulate("paper-75", seed=1, duration=0.5)
    /// >>> run.picture("fall.png", view="iso")
    #[pyo3(signature = (path, *, shown = "both", view = None))]
    fn picture(
        &self,
        py: Python<'_>,
        path: PathBuf,
        shown: &str,
        view: Option<&str>,
    ) -> PyResult<()> {
        let (shown, view) = (shown_as(shown)?, seen_from(view)?);
        let png = interruptible(py, |_| {
            let trajectories = self.trajectories();
            let bodies = self.recorded(&trajectories);
            let shot = Shot::new(shown, view, &self.prepared, &bodies);
            shot.picture().and_then(|picture| picture.png())
        })?;
        let png = png.map_err(|error| PyValueError::new_err(error.to_string()))?;
        files::write(py, &path, &png)
    }

    /// Writes a film of `fps` frames a second into a folder as frame-00001.png, frame-00002.png and so on; gives their
    /// number. `shown` and `view` are those of `picture`.
    #[pyo3(signature = (folder, *, fps = 60.0, shown = "both", view = None))]
    fn film(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        fps: f64,
        shown: &str,
        view: Option<&str>,
    ) -> PyResult<usize> {
        let (shown, view) = (shown_as(shown)?, seen_from(view)?);
        let _claim = Claim::folder(&folder).or_raise()?;
        let frames = interruptible(py, |wanted| {
            let trajectories = self.trajectories();
            let bodies = self.recorded(&trajectories);
            Shot::new(shown, view, &self.prepared, &bodies).film(&folder, fps, wanted)
        })?;
        match frames {
            Ok(frames) => Ok(frames.written),
            Err(FilmError::Write(error)) => Err(error.raised()),
            Err(error) => Err(PyValueError::new_err(error.to_string())),
        }
    }

    fn __len__(&self) -> usize {
        self.falls.len()
    }

    fn __repr__(&self) -> String {
        let first = &self.falls[0];
        format!(
            "<Run of {}: {} bodies, the first {} states, ended by {}>",
            self.prepared.scene().name,
            self.falls.len(),
            first.states.len(),
            first.ending()
        )
    }
}

impl Run {
    fn trajectories(&self) -> Vec<Trajectory> {
        self.falls.iter().map(Fall::trajectory).collect()
    }

    fn recorded<'a>(&self, trajectories: &'a [Trajectory]) -> Vec<RecordedBody<'a>> {
        let bodies = self.falls.iter().zip(trajectories);
        bodies
            .map(|(fall, trajectory)| fall.recorded(trajectory))
            .collect()
    }
}

fn shown_as(name: &str) -> PyResult<Shown> {
    let choices = [
        ("strobe", Shown::Strobe),
        ("path", Shown::Path),
        ("both", Shown::Both),
    ];
    choose("way to show a motion", name, choices).or_raise()
}

fn seen_from(name: Option<&str>) -> PyResult<View> {
    let choices = [
        ("front", View::Front),
        ("side", View::Side),
        ("top", View::Top),
        ("iso", View::Iso),
    ];
    name.map_or(Ok(View::default()), |name| {
        choose("view", name, choices).or_raise()
    })
}

/// Drops the body of a scene, or so many side by side, until they end.
///
/// `scene` is a `Scene`, the name of a built-in one, the path of a file, or a dict. `seed`, `duration` (s), `dt` (s), `model`
/// and `turbulence` take the place of the scene's. Bakes are taken from the folder `cache` and kept there: `True` for that of
/// the command, `False` for none.
///
/// >>> run = simulate("paper-75", seed=1)
/// >>> run.endings
/// ['ground']
/// >>> run.states.positions.shape[1]
/// 3
#[pyfunction]
#[pyo3(signature = (
    scene, *, seed = None, duration = None, dt = None, model = None, turbulence = None, bodies = 1,
    cache = Cache::default()
))]
#[expect(clippy::too_many_arguments, reason = "they have names")]
pub(crate) fn simulate(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    seed: Option<u64>,
    duration: Option<f64>,
    dt: Option<f64>,
    model: Option<&str>,
    turbulence: Option<&str>,
    bodies: u32,
    cache: Cache,
) -> PyResult<Run> {
    let mut scene = Scene::of_argument(scene)?.get().scene.clone();
    if bodies == 0 {
        return Err(PyValueError::new_err("bodies is 0; at least one falls"));
    }
    for (name, value) in [("duration", duration), ("dt", dt)] {
        if value.is_some_and(|x| !(x > 0.0 && x.is_finite())) {
            return Err(PyValueError::new_err(format!(
                "{name} is {value:?}; it must be positive (s)"
            )));
        }
    }
    scene.seed = seed.unwrap_or(scene.seed);
    scene.time_step = dt.unwrap_or(scene.time_step);
    scene.stop.time = duration.or(scene.stop.time);
    if let Some(source) = turbulence {
        scene.settings.turbulence = source.parse().or_raise()?;
    }
    if let Some(model) = model {
        scene.set_model(model.parse().or_raise()?);
    }
    if let Some(crowd) = &mut scene.crowd
        && bodies > 1
    {
        crowd.count = bodies;
    }
    scene
        .steps()
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let prepared = prepare(py, scene, &cache)?;
    prepared
        .check_release()
        .map_err(|error| SceneError::new_err(error.to_string()))?;
    let falls = interruptible(py, |wanted| prepared.drop_bodies(bodies, wanted))?
        .map_err(|error| SceneError::new_err(error.to_string()))?;
    Ok(Run { prepared, falls })
}

/// What serde makes of a value, as Python's json reads it.
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    value: &impl serde::Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    let json =
        serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))?;
    py.import("json")?.call_method1("loads", (json,))
}
