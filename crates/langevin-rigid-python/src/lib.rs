//! The Python package `langevin_rigid`: what of it is computed.

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", langevin_rigid::VERSION)
}
