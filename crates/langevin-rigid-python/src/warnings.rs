//! What is told and does not end a call: what the command prints as notes and warnings.

use std::ffi::CString;

use langevin_rigid_scenes::baking::{Baked, CACHE_VARIABLE};
use pyo3::prelude::*;

use crate::errors::LangevinRigidWarning;

/// Warns. It is an error where the caller's filters make one of warnings.
pub(crate) fn warn(py: Python<'_>, words: &str) -> PyResult<()> {
    let class = py.get_type::<LangevinRigidWarning>();
    let words = CString::new(words.replace('\0', "\u{fffd}"))?;
    PyErr::warn(py, &class, &words, 1)
}

/// Warns of what the reader of a body's mesh passed over, and of a bake that was damaged or not kept.
pub(crate) fn warn_of_bake(py: Python<'_>, baked: &Baked) -> PyResult<()> {
    for notice in &baked.notices {
        warn(py, notice)?;
    }
    match &baked.cache_trouble {
        Some(trouble) => warn(
            py,
            &format!(
                "{trouble} (give a writable folder as `cache`, or set {CACHE_VARIABLE} to one)"
            ),
        ),
        None => Ok(()),
    }
}
