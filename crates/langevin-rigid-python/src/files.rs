//! Files by their paths.

use std::path::{Path, PathBuf};

use langevin_rigid_formats::files;
use pyo3::prelude::*;

use crate::errors::{OrRaise, of_system};

pub(crate) fn read(py: Python<'_>, path: &Path) -> PyResult<Vec<u8>> {
    py.detach(|| files::read(path)).map_err(|error| {
        let words = format!("cannot read `{}`: {error}", path.display());
        of_system(error.kind(), words)
    })
}

/// Writes all of it or nothing.
pub(crate) fn write(py: Python<'_>, path: &Path, bytes: &[u8]) -> PyResult<()> {
    py.detach(|| files::write(path, bytes)).or_raise()
}

/// The last part of a path, for comments and messages.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name()
        .map_or_else(PathBuf::new, PathBuf::from)
        .display()
        .to_string()
}
