//! What is raised, with the words of the libraries. The classes are those of `langevin_rigid/errors.py`, where they can
//! have `ValueError` as a second base.

use std::io::ErrorKind;

use langevin_rigid::{BakeError as BakeFileError, BatchError, BodyError, SetupError as Setup};
use langevin_rigid_bake::MeshError as NoBody;
use langevin_rigid_bake::added_mass::AddedMassError;
use langevin_rigid_bake::body::BodyBakeError;
use langevin_rigid_bake::mesh::ProxyError;
use langevin_rigid_bake::shapes::ShapeError;
use langevin_rigid_bake::turbulence::TurbulenceError;
use langevin_rigid_formats::files::WriteError;
use langevin_rigid_formats::mesh::ReadError;
use langevin_rigid_scenes::baking::SceneBakeError;
use langevin_rigid_scenes::ensemble::JournalError;
use langevin_rigid_scenes::prepared::PrepareError;
use langevin_rigid_scenes::scene::FindError;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyPermissionError, PyValueError};
use pyo3::prelude::*;

pyo3::import_exception!(langevin_rigid.errors, LangevinRigidError);
pyo3::import_exception!(langevin_rigid.errors, MeshError);
pyo3::import_exception!(langevin_rigid.errors, BakeError);
pyo3::import_exception!(langevin_rigid.errors, SceneError);
pyo3::import_exception!(langevin_rigid.errors, SetupError);
pyo3::import_exception!(langevin_rigid.errors, StepError);
pyo3::import_exception!(langevin_rigid.errors, LangevinRigidWarning);

/// What Python is to raise for an error of the libraries.
pub(crate) trait Raised {
    fn raised(self) -> PyErr;
}

/// Raises it.
pub(crate) trait OrRaise<T> {
    fn or_raise(self) -> PyResult<T>;
}

impl<T, E: Raised> OrRaise<T> for Result<T, E> {
    fn or_raise(self) -> PyResult<T> {
        self.map_err(Raised::raised)
    }
}

macro_rules! raised {
    ($($error:ty => $class:ident),* $(,)?) => {$(
        impl Raised for $error {
            fn raised(self) -> PyErr {
                $class::new_err(self.to_string())
            }
        }
    )*};
}

raised! {
    NoBody => MeshError,
    ProxyError => MeshError,
    ShapeError => MeshError,
    BodyError => SetupError,
    Setup => SetupError,
    langevin_rigid::wind::WindError => SetupError,
    langevin_rigid::wind::TableError => SetupError,
    langevin_rigid::StepError => StepError,
    AddedMassError => BakeError,
    BodyBakeError => BakeError,
    BakeFileError => BakeError,
    TurbulenceError => BakeError,
    langevin_rigid_scenes::scene::SceneError => SceneError,
    langevin_rigid_scenes::direct::DirectError => SceneError,
    langevin_rigid::UnknownName => PyValueError,
}

impl Raised for ReadError {
    fn raised(self) -> PyErr {
        let words = self.to_string();
        match self {
            ReadError::NotFound { .. } => PyFileNotFoundError::new_err(words),
            ReadError::Unreadable { source, .. } => of_system(source.kind(), words),
            _ => MeshError::new_err(words),
        }
    }
}

impl Raised for WriteError {
    fn raised(self) -> PyErr {
        of_system(self.error.kind(), self.to_string())
    }
}

impl Raised for BatchError {
    fn raised(self) -> PyErr {
        StepError::new_err((self.to_string(), self.bodies))
    }
}

/// The class of a trouble with files, with these words.
pub(crate) fn of_system(kind: ErrorKind, words: String) -> PyErr {
    match kind {
        ErrorKind::NotFound => PyFileNotFoundError::new_err(words),
        ErrorKind::PermissionDenied => PyPermissionError::new_err(words),
        _ => PyOSError::new_err(words),
    }
}

impl Raised for FindError {
    fn raised(self) -> PyErr {
        let words = self.to_string();
        match self {
            FindError::Read { error, .. } => of_system(error.kind(), words),
            _ => SceneError::new_err(words),
        }
    }
}

impl Raised for SceneBakeError {
    fn raised(self) -> PyErr {
        match self {
            SceneBakeError::Read(error) => error.raised(),
            SceneBakeError::Mesh { .. } | SceneBakeError::Shape(_) => {
                MeshError::new_err(self.to_string())
            }
            _ => BakeError::new_err(self.to_string()),
        }
    }
}

impl Raised for PrepareError {
    fn raised(self) -> PyErr {
        match self {
            PrepareError::Bake(error) => error.raised(),
            PrepareError::Setup(_) | PrepareError::Body(_) => SetupError::new_err(self.to_string()),
            _ => SceneError::new_err(self.to_string()),
        }
    }
}

impl Raised for JournalError {
    fn raised(self) -> PyErr {
        let words = self.to_string();
        match self {
            JournalError::Io { error, .. } => of_system(error.kind(), words),
            _ => SceneError::new_err(words),
        }
    }
}
