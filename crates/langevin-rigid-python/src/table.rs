//! Tables of named columns.

use std::path::PathBuf;

use langevin_rigid_formats::files::write_with;
use langevin_rigid_formats::table::{Column, Table as Columns, Values};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::OrRaise;
use crate::files;

/// Named columns of equal length, each an array (n,): `dict(table)` and `pandas.DataFrame(dict(table))` take it as it is. What
/// is missing is NaN, and of a column of lists each value is an array.
#[pyclass(frozen, module = "langevin_rigid", mapping)]
pub(crate) struct Table {
    pub(crate) columns: Columns,
    /// What a Parquet file says of it.
    pub(crate) about: &'static str,
}

#[pymethods]
impl Table {
    /// The names of the columns.
    fn keys(&self) -> Vec<&str> {
        let columns = self.columns.columns().iter();
        columns.map(|column| column.name.as_ref()).collect()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let column = self
            .columns
            .columns()
            .iter()
            .find(|column| column.name == name);
        match column {
            Some(column) => array(py, column),
            None => Err(PyKeyError::new_err(format!(
                "there is no column `{name}`; there are {}",
                self.keys().join(", ")
            ))),
        }
    }

    fn __contains__(&self, name: &str) -> bool {
        self.keys().contains(&name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.keys().into_pyobject(py)?.try_iter()?.into_any())
    }

    /// Number of rows.
    fn __len__(&self) -> usize {
        self.columns.rows()
    }

    /// A pandas.DataFrame. Needs pandas.
    pub(crate) fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = PyDict::new(py);
        for column in self.columns.columns() {
            columns.set_item(column.name.as_ref(), array(py, column)?)?;
        }
        py.import("pandas")?.call_method1("DataFrame", (columns,))
    }

    /// Writes it as comma-separated values, whole or not at all.
    fn to_csv(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let text = py.detach(|| self.columns.csv());
        files::write(py, &path, text.as_bytes())
    }

    /// Writes it as Apache Parquet, whole or not at all.
    fn to_parquet(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| write_with(&path, |out| self.columns.write_parquet(self.about, out)))
            .or_raise()
    }

    fn __repr__(&self) -> String {
        format!(
            "<Table: {} rows of {}>",
            self.columns.rows(),
            self.keys().join(", ")
        )
    }
}

fn array<'py>(py: Python<'py>, column: &Column) -> PyResult<Bound<'py, PyAny>> {
    Ok(match &column.values {
        Values::Numbers(values) => PyArray1::from_slice(py, values).into_any(),
        Values::Optional(values) => {
            let numbers = values.iter().map(|x| x.unwrap_or(f64::NAN));
            PyArray1::from_iter(py, numbers).into_any()
        }
        Values::Counts(values) => PyArray1::from_slice(py, values).into_any(),
        Values::Large(values) => PyArray1::from_slice(py, values).into_any(),
        Values::Words(values) => {
            let words: Vec<&str> = values.iter().map(AsRef::as_ref).collect();
            py.import("numpy")?.call_method1("array", (words,))?
        }
        Values::Lists(lists) => {
            // NumPy would make one array of lists of one length.
            let objects = py
                .import("numpy")?
                .call_method1("empty", (lists.len(), "O"))?;
            for (row, list) in lists.iter().enumerate() {
                objects.set_item(row, PyArray1::from_slice(py, list))?;
            }
            objects
        }
        _ => py.None().into_bound(py),
    })
}
