//! Parametric bodies by the names and dimensions that scenes give them.

use langevin_rigid::choose;
use langevin_rigid_bake::for_shapes;
use langevin_rigid_bake::shapes::Shape;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::errors::OrRaise;

/// A dimension, which has one number or several.
trait Dimension: Sized {
    fn of(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Self>;
}

impl Dimension for f64 {
    fn of(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        given
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("{name} must be a number (m)")))
    }
}

impl<const N: usize> Dimension for [f64; N] {
    fn of(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        arrays::vector(given, name)
    }
}

struct Entry {
    name: &'static str,
    keys: &'static [&'static str],
    read: fn(&Bound<'_, PyDict>) -> PyResult<Shape>,
}

macro_rules! shapes {
    ($($name:literal: $shape:ident { $($key:ident),* },)*) => {
        const SHAPES: &[Entry] = &[$(Entry {
            name: $name,
            keys: &[$(stringify!($key)),*],
            read: |given| Ok(Shape::$shape { $($key: dimension(given, $name, stringify!($key))?),* }),
        }),*];
    };
}

for_shapes!(shapes);

fn dimension<T: Dimension>(given: &Bound<'_, PyDict>, shape: &str, key: &str) -> PyResult<T> {
    match given.get_item(key)? {
        Some(value) => T::of(&value, key),
        None => Err(PyTypeError::new_err(format!(
            "the shape `{shape}` needs `{key}` (m)"
        ))),
    }
}

/// The shape of this name with these dimensions.
pub(crate) fn named(name: &str, dimensions: &Bound<'_, PyDict>) -> PyResult<Shape> {
    let choices = SHAPES.iter().map(|entry| (entry.name, entry));
    let entry = choose("shape", name, choices).or_raise()?;
    for key in dimensions.keys() {
        let key: String = key.extract()?;
        if !entry.keys.contains(&key.as_str()) {
            return Err(PyTypeError::new_err(format!(
                "the shape `{name}` has no `{key}`; it has {}",
                entry.keys.join(", ")
            )));
        }
    }
    (entry.read)(dimensions)
}
