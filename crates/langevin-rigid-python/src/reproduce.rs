//! The paper's results, computed again.

use std::path::PathBuf;

use langevin_rigid_formats::files::Claim;
use langevin_rigid_report::{Options, OptionsError, Part, ReportError, reproduce as report};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{LangevinRigidError, OrRaise, Raised};
use crate::interrupt::interruptible;
use crate::scene::Cache;

impl Raised for ReportError {
    fn raised(self) -> PyErr {
        match self {
            ReportError::Write(error) => error.raised(),
            error => LangevinRigidError::new_err(error.to_string()),
        }
    }
}

impl Raised for OptionsError {
    fn raised(self) -> PyErr {
        PyValueError::new_err(self.to_string())
    }
}

/// Computes the paper's results again, beside what the paper states: writes `report.html` and a folder of data for each part
/// into `folder`, and gives the path of the page.
///
/// `parts` are of fig2, fig3, fig4, fig5, table2, departures, regimes, coin, showcase, closure and validation; `None` is all of
/// them, in minutes. Ensembles have `seeds` seeds from `seed` on. Parts finished before Ctrl-C are kept.
///
/// >>> reproduce("report", parts=["fig2"], seeds=1).name
/// 'report.html'
#[pyfunction]
#[pyo3(signature = (folder, *, parts = None, seeds = 100, seed = 1, cache = Cache::default()))]
pub(crate) fn reproduce(
    py: Python<'_>,
    folder: PathBuf,
    parts: Option<Vec<String>>,
    seeds: u32,
    seed: u64,
    cache: Cache,
) -> PyResult<PathBuf> {
    let parts = parts.map(|names| {
        let named = names.iter().map(|name| Part::named(name).or_raise());
        named.collect::<PyResult<Vec<Part>>>()
    });
    let parts = parts.transpose()?;
    let options = Options::new(parts.as_deref(), seeds, seed, cache.folder()).or_raise()?;
    let _claim = Claim::folder(&folder).or_raise()?;
    let made = interruptible(py, |wanted| report(&options, &folder, wanted))?;
    Ok(made.or_raise()?.page)
}
