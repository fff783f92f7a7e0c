//! How plates fall over Reynolds number and inertia.

use std::path::PathBuf;

use langevin_rigid_formats::table::{Column, Table as Columns, Values};
use langevin_rigid_scenes::ensemble::MotionClass;
use langevin_rigid_scenes::regimes::{self as map, Agreement, Plate, Point};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::OrRaise;
use crate::files;
use crate::interrupt::interruptible;
use crate::run::to_python;
use crate::table::Table;

/// How discs and strips fall over Reynolds number and inertia ratio, against experiments.
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Regimes(Vec<Point>);

#[pymethods]
impl Regimes {
    /// A row for each point of the grid: `plate` (disc or strip), `reynolds`, `inertia_ratio` I*, the `regime` that most
    /// releases show, what was `published`, whether the point is far enough from a published boundary to be compared, and
    /// whether both agree (1 or 0).
    #[getter]
    fn points(&self) -> Table {
        let column = |name: &'static str, values| Column {
            name: name.into(),
            values,
        };
        let numbers = |of: fn(&Point) -> f64| Values::Numbers(self.0.iter().map(of).collect());
        let flags = |of: fn(&Point) -> bool| {
            Values::Counts(self.0.iter().map(|point| u32::from(of(point))).collect())
        };
        let words = |of: fn(&Point) -> &'static str| {
            Values::Words(self.0.iter().map(|point| of(point).into()).collect())
        };
        Table {
            columns: Columns::new(vec![
                column("plate", words(|p| p.plate.name())),
                column("reynolds", numbers(|p| p.re)),
                column("inertia_ratio", numbers(|p| p.inertia_ratio)),
                column("regime", words(|p| MotionClass::name(p.regime))),
                column("published", words(|p| MotionClass::name(p.published))),
                column("compared", flags(|p| p.compared)),
                column("agrees", flags(|p| p.agrees)),
            ]),
            about: "how discs and strips fall, without dimensions",
        }
    }

    /// How many of the compared points agree with experiments, for each plate: a dict of dicts.
    #[getter]
    fn agreement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let of = |plate: Plate| Agreement::of(self.0.iter().filter(|p| p.plate == plate));
        let each = Plate::ALL.map(|plate| (plate.name(), of(plate)));
        to_python(py, &std::collections::BTreeMap::from(each))
    }

    /// Writes the map as a PNG.
    fn picture(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let png =
            py.detach(|| map::regime_map(&self.0, "Marks: the model. Colour: experiments.")?.png());
        let png = png.map_err(|error| PyValueError::new_err(error.to_string()))?;
        files::write(py, &path, &png)
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        let Agreement {
            compared, agreeing, ..
        } = Agreement::of(self.0.iter());
        format!(
            "<Regimes: {} points, {agreeing} of {compared} compared ones agree with experiments>",
            self.0.len()
        )
    }
}

/// Drops discs and strips from several tilts at each point of a grid of so many inertia ratios and Reynolds numbers, under the
/// model `separated`.
///
/// >>> falls = regimes((3, 3))
/// >>> len(falls)
/// 18
#[pyfunction]
#[pyo3(signature = (grid = (10, 6)))]
pub(crate) fn regimes(py: Python<'_>, grid: (u32, u32)) -> PyResult<Regimes> {
    let (inertia_ratios, reynolds) = grid;
    if !(2..=100).contains(&inertia_ratios) || !(2..=100).contains(&reynolds) {
        return Err(PyValueError::new_err(format!(
            "grid is {grid:?}; it must be two whole numbers between 2 and 100"
        )));
    }
    let cases = map::cases(inertia_ratios, reynolds);
    let runs = interruptible(py, |wanted| map::run(&cases, wanted))?.or_raise()?;
    Ok(Regimes(map::points(&runs)))
}
