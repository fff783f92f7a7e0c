//! Scenes: what to simulate.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use langevin_rigid_scenes::baking::{bake_scene, cache_folder};
use langevin_rigid_scenes::prepared::{PrepareError, Prepared};
use langevin_rigid_scenes::scene::{BUILT_IN, Scene as Described, Source};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::body::Body;
use crate::errors::{OrRaise, SceneError};
use crate::interrupt::{Wanted, interruptible};
use crate::warnings::warn_of_bake;

/// What to simulate: a body, a fluid, a release and a run, checked and complete. See docs/scenes.md for all that it may say.
///
/// >>> leaf = Scene.find("leaf")
/// >>> flat = leaf.changed({"release.tilt": 0.0, "run.seed": 7})
/// >>> flat.seed
/// 7
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Scene {
    source: Source,
    pub(crate) scene: Described,
}

impl Scene {
    fn of_source(source: Source) -> PyResult<Self> {
        let scene = source.scene().or_raise()?;
        Ok(Self { source, scene })
    }

    /// The same with more in its `[scatter]`.
    pub(crate) fn scattered(&self, py: Python<'_>, scatter: &Bound<'_, PyDict>) -> PyResult<Self> {
        let changes = PyDict::new(py);
        for (key, value) in scatter {
            changes.set_item(format!("scatter.{key}"), value)?;
        }
        self.changed(&changes)
    }

    /// A scene, the name or the path of one, or one as a dict.
    pub(crate) fn of_argument<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Scene>> {
        let py = given.py();
        if let Ok(scene) = given.cast::<Scene>() {
            return Ok(scene.clone());
        }
        if let Ok(dict) = given.cast::<PyDict>() {
            return Bound::new(py, Self::of(dict, "scene")?);
        }
        match given.extract::<PathBuf>() {
            Ok(name) => Bound::new(py, Self::find(name)?),
            Err(_) => Err(PyTypeError::new_err(format!(
                "a scene is a Scene, the name or the path of one, or a dict, not {}",
                given.get_type()
            ))),
        }
    }
}

#[pymethods]
impl Scene {
    /// The built-in scene of a name, or the scene file at a path.
    #[staticmethod]
    fn find(name: PathBuf) -> PyResult<Self> {
        Self::of_source(Source::find(&name.display().to_string()).or_raise()?)
    }

    /// From the text of a scene file. Paths in it start from the current folder.
    #[staticmethod]
    #[pyo3(signature = (text, *, name = "scene"))]
    pub(crate) fn parse(text: String, name: &str) -> PyResult<Self> {
        Self::of_source(Source {
            name: name.to_owned(),
            file: format!("{name}.toml"),
            text,
            folder: None,
        })
    }

    /// From a dict of what a scene file says.
    ///
    /// >>> ball = Scene.of({
    /// ...     "fluid": {"preset": "water"},
    /// ...     "body": {"shape": "ellipsoid", "semi_axes": [0.01, 0.01, 0.01], "density": 2000.0},
    /// ...     "run": {"time_step": 0.002, "duration": 1.0},
    /// ... }, name="ball")
    /// >>> ball
    /// <Scene: ball>
    #[staticmethod]
    #[pyo3(signature = (scene, *, name = "scene"))]
    fn of(scene: &Bound<'_, PyDict>, name: &str) -> PyResult<Self> {
        Self::parse(written(&table(scene)?)?, name)
    }

    /// The names of the built-in scenes.
    #[staticmethod]
    fn built_in() -> Vec<&'static str> {
        BUILT_IN.iter().map(|scene| scene.name).collect()
    }

    /// The same with other values, by their names in the scene file: `{"body.mass": 0.002, "scatter.tilt": [0, 45]}`. None
    /// takes a value away; a name without a dot is that of a whole section.
    fn changed(&self, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut text: Table = self
            .source
            .text
            .parse()
            .map_err(|error: toml::de::Error| SceneError::new_err(error.to_string()))?;
        for (name, value) in changes {
            let name: String = name.extract()?;
            let value = (!value.is_none())
                .then(|| toml_of(&value, &name))
                .transpose()?;
            set(&mut text, &name, value)?;
        }
        Self::of_source(Source {
            file: format!("{} with changes", self.source.name),
            text: written(&text)?,
            ..self.source.clone()
        })
    }

    /// The scene as a TOML file, every choice spelled out.
    fn to_toml(&self) -> PyResult<String> {
        let text = self.scene.to_toml();
        text.map_err(|error| SceneError::new_err(error.to_string()))
    }

    /// Its text as it was given.
    #[getter]
    fn text(&self) -> &str {
        &self.source.text
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.scene.name
    }

    /// What it shows, in a line.
    #[getter]
    fn description(&self) -> &str {
        &self.scene.description
    }

    /// Seed of its noise and draws.
    #[getter]
    fn seed(&self) -> u64 {
        self.scene.seed
    }

    /// Time step (s).
    #[getter]
    fn time_step(&self) -> f64 {
        self.scene.time_step
    }

    /// Its body, baked or taken from the folder `cache`: see `simulate`.
    #[pyo3(signature = (*, cache = Cache::default()))]
    fn bake(&self, py: Python<'_>, cache: Cache) -> PyResult<Body> {
        let baked = interruptible(py, |wanted| {
            bake_scene(&self.scene, cache.folder().as_deref(), wanted)
        })?;
        let baked = baked.or_raise()?;
        warn_of_bake(py, &baked)?;
        Ok(Body::of(baked.bake))
    }

    fn __repr__(&self) -> String {
        format!("<Scene: {}>", self.scene.name)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.scene == other.scene
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let Source {
            name,
            file,
            text,
            folder,
        } = &slf.get().source;
        let unpickle = py
            .import("langevin_rigid._native")?
            .getattr("_scene_of_parts")?;
        // Elsewhere the current folder may be another.
        let here = std::path::absolute(folder.as_deref().unwrap_or(Path::new(".")))?;
        let parts = (name, file, text, here).into_pyobject(py)?;
        Ok((unpickle, parts))
    }
}

/// Unpickles a scene.
#[pyfunction]
pub(crate) fn _scene_of_parts(
    name: String,
    file: String,
    text: String,
    folder: PathBuf,
) -> PyResult<Scene> {
    Scene::of_source(Source {
        name,
        file,
        text,
        folder: Some(folder),
    })
}

/// Where bakes are kept: `True` for the folder of the command, `False` for none, or a folder.
#[derive(FromPyObject)]
pub(crate) enum Cache {
    Usual(bool),
    Folder(PathBuf),
}

impl Default for Cache {
    fn default() -> Self {
        Self::Usual(true)
    }
}

impl Cache {
    pub(crate) fn folder(&self) -> Option<PathBuf> {
        match self {
            Self::Usual(true) => cache_folder(),
            Self::Usual(false) => None,
            Self::Folder(folder) => Some(folder.clone()),
        }
    }
}

/// A scene made ready, with warnings of what happened to its bakes.
pub(crate) fn prepare(py: Python<'_>, scene: Described, cache: &Cache) -> PyResult<Arc<Prepared>> {
    let prepared = interruptible(py, |wanted: &Wanted| -> Result<Prepared, PrepareError> {
        Prepared::new(scene, cache.folder().as_deref(), wanted)
    })?;
    let prepared = prepared.or_raise()?;
    for (_, baked) in prepared.kinds() {
        warn_of_bake(py, baked)?;
    }
    Ok(Arc::new(prepared))
}

/// Sets a value by its name with dots, or takes it away.
fn set(table: &mut Table, name: &str, value: Option<Value>) -> PyResult<()> {
    let Some((section, rest)) = name.split_once('.') else {
        match value {
            Some(value) => table.insert(name.to_owned(), value),
            None => table.remove(name),
        };
        return Ok(());
    };
    let section = table
        .entry(section)
        .or_insert_with(|| Value::Table(Table::new()));
    match section {
        Value::Table(table) => set(table, rest, value),
        _ => Err(PyValueError::new_err(format!(
            "`{name}` names a part of something that has no parts"
        ))),
    }
}

fn written(table: &Table) -> PyResult<String> {
    toml::to_string(table).map_err(|error| SceneError::new_err(error.to_string()))
}

fn table(dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    let entries = dict.iter().filter(|(_, value)| !value.is_none());
    entries
        .map(|(key, value)| {
            let key: String = key.extract()?;
            let value = toml_of(&value, &key)?;
            Ok((key, value))
        })
        .collect()
}

/// A value of Python as TOML has it; arrays of NumPy are lists.
pub(crate) fn toml_of(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(Value::String(value.extract()?));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(table(dict)?));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let values = value.try_iter()?.map(|value| toml_of(&value?, name));
        return Ok(Value::Array(values.collect::<PyResult<_>>()?));
    }
    if value.hasattr("tolist")? {
        return toml_of(&value.call_method0("tolist")?, name);
    }
    match value.extract::<PathBuf>() {
        Ok(path) => Ok(Value::String(path.display().to_string())),
        Err(_) => Err(PyTypeError::new_err(format!(
            "`{name}` is of {}; a scene has numbers, words, lists and dicts",
            value.get_type()
        ))),
    }
}
