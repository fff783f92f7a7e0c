//! Arrays of NumPy in and out: whatever NumPy makes an array of, checked, as plain arrays of numbers.

use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// What an array must be, in messages.
fn shape_of(rows: &str, columns: usize) -> String {
    match rows {
        "" => format!("({columns},)"),
        rows => format!("({rows}, {columns})"),
    }
}

/// The array that NumPy makes of `given`; `kinds` are the kinds of its numbers that are welcome.
fn array<'py>(
    given: &Bound<'py, PyAny>,
    name: &str,
    kinds: &str,
    wanted: &str,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given,)).map_err(|error| {
        let error = error.value(given.py());
        PyValueError::new_err(format!("{name} is no array of shape {wanted}: {error}"))
    })?;
    let array = array.cast_into::<PyUntypedArray>()?;
    let kind: String = array.dtype().getattr("kind")?.extract()?;
    // An empty list is an array of floats.
    if !kinds.contains(&kind) && !array.is_empty() {
        let numbers = if kinds.contains('f') {
            "numbers"
        } else {
            "integers"
        };
        return Err(PyTypeError::new_err(format!(
            "{name} is an array of {}; it must be one of {numbers}",
            array.dtype()
        )));
    }
    Ok(array)
}

fn wrong_shape(name: &str, array: &Bound<'_, PyUntypedArray>, wanted: &str) -> PyErr {
    let found: Vec<String> = array.shape().iter().map(ToString::to_string).collect();
    let found = match found.as_slice() {
        [one] => format!("({one},)"),
        more => format!("({})", more.join(", ")),
    };
    PyValueError::new_err(format!("{name} has shape {found}; it must be {wanted}"))
}

/// The numbers of an array, row by row.
fn numbers(array: &Bound<'_, PyUntypedArray>) -> PyResult<Vec<f64>> {
    let as_doubles = array.call_method1("astype", ("float64",))?;
    Ok(as_doubles
        .call_method0("ravel")?
        .cast_into::<PyArray1<f64>>()?
        .to_vec()?)
}

/// An array of shape (rows, N); `rows` is what messages call their number.
pub(crate) fn rows<const N: usize>(
    given: &Bound<'_, PyAny>,
    name: &str,
    rows: &str,
) -> PyResult<Vec<[f64; N]>> {
    let wanted = shape_of(rows, N);
    let array = array(given, name, "fiu", &wanted)?;
    match *array.shape() {
        [_, columns] if columns == N => {}
        [0] => return Ok(Vec::new()),
        _ => return Err(wrong_shape(name, &array, &wanted)),
    }
    Ok(numbers(&array)?.as_chunks().0.to_vec())
}

/// The same with a number of rows that is known, all of it finite.
pub(crate) fn rows_of<const N: usize>(
    given: &Bound<'_, PyAny>,
    name: &str,
    count: usize,
) -> PyResult<Vec<[f64; N]>> {
    let rows = rows(given, name, &count.to_string())?;
    if rows.len() != count {
        return Err(PyValueError::new_err(format!(
            "{name} has {} rows; it must have {count}, one for each body",
            rows.len()
        )));
    }
    finite(name, &rows)?;
    Ok(rows)
}

/// Refuses numbers that are not finite.
pub(crate) fn finite<const N: usize>(name: &str, rows: &[[f64; N]]) -> PyResult<()> {
    not_finite(name, rows).map_or(Ok(()), |words| Err(PyValueError::new_err(words)))
}

/// Where the first number is that is not finite, if there is one.
pub(crate) fn not_finite<const N: usize>(name: &str, rows: &[[f64; N]]) -> Option<String> {
    let bad = |row: &[f64; N]| row.iter().any(|x| !x.is_finite());
    let row = rows.iter().position(bad)?;
    Some(format!(
        "row {row} of {name} is {:?}; it must be finite",
        rows[row]
    ))
}

/// Three or some other number of finite numbers.
pub(crate) fn vector<const N: usize>(given: &Bound<'_, PyAny>, name: &str) -> PyResult<[f64; N]> {
    let wanted = shape_of("", N);
    let array = array(given, name, "fiu", &wanted)?;
    if array.shape() != [N] {
        return Err(wrong_shape(name, &array, &wanted));
    }
    let vector: [f64; N] = std::array::from_fn({
        let numbers = numbers(&array)?;
        move |i| numbers[i]
    });
    if vector.iter().any(|x| !x.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "{name} is {vector:?}; it must be finite"
        )));
    }
    Ok(vector)
}

/// A quaternion made a unit.
pub(crate) fn unit(quaternion: [f64; 4], name: &str) -> PyResult<[f64; 4]> {
    let squares: f64 = quaternion.iter().map(|x| x * x).sum();
    // What is one already keeps its bits.
    if (squares - 1.0).abs() < 1e-14 {
        return Ok(quaternion);
    }
    if !(squares > 0.0 && squares.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "{name} is {quaternion:?}, which is no direction: give a quaternion x, y, z, w that is not zero"
        )));
    }
    Ok(quaternion.map(|x| x / squares.sqrt()))
}

/// A vector that may be left out.
pub(crate) fn vector_or<const N: usize>(
    given: Option<&Bound<'_, PyAny>>,
    name: &str,
    default: [f64; N],
) -> PyResult<[f64; N]> {
    given.map_or(Ok(default), |given| vector(given, name))
}

/// A square matrix of finite numbers.
pub(crate) fn matrix<const N: usize>(
    given: &Bound<'_, PyAny>,
    name: &str,
) -> PyResult<[[f64; N]; N]> {
    let wanted = shape_of(&N.to_string(), N);
    let array = array(given, name, "fiu", &wanted)?;
    if array.shape() != [N, N] {
        return Err(wrong_shape(name, &array, &wanted));
    }
    let rows: Vec<[f64; N]> = numbers(&array)?.as_chunks().0.to_vec();
    finite(name, &rows)?;
    Ok(std::array::from_fn(|i| rows[i]))
}

/// Numbers one after the other, as many as they are.
pub(crate) fn column(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let array = array(given, name, "fiu", "(n,)")?;
    if array.ndim() != 1 {
        return Err(wrong_shape(name, &array, "(n,)"));
    }
    numbers(&array)
}

/// Vectors on a grid: its points along x, y and z, and the vectors, z fastest, then y, x and, if there are any, times.
pub(crate) fn grid(
    given: &Bound<'_, PyAny>,
    name: &str,
    with_times: bool,
) -> PyResult<([usize; 3], Vec<[f64; 3]>)> {
    let wanted = match with_times {
        true => "(times, nx, ny, nz, 3)",
        false => "(nx, ny, nz, 3)",
    };
    let array = array(given, name, "fiu", wanted)?;
    let counts = match (with_times, array.shape()) {
        (true, &[_, x, y, z, 3]) | (false, &[x, y, z, 3]) => [x, y, z],
        _ => return Err(wrong_shape(name, &array, wanted)),
    };
    Ok((counts, numbers(&array)?.as_chunks().0.to_vec()))
}

/// Integers of any type.
pub(crate) fn integers(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<i64>> {
    let array = array(given, name, "iu", "(n,)")?;
    if array.ndim() != 1 {
        return Err(wrong_shape(name, &array, "(n,)"));
    }
    whole(&array)
}

/// Rows of three integers of any type.
pub(crate) fn triples(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[i64; 3]>> {
    let array = array(given, name, "iu", "(m, 3)")?;
    match *array.shape() {
        [_, 3] => {}
        [0] => return Ok(Vec::new()),
        _ => return Err(wrong_shape(name, &array, "(m, 3)")),
    }
    Ok(whole(&array)?.as_chunks().0.to_vec())
}

fn whole(array: &Bound<'_, PyUntypedArray>) -> PyResult<Vec<i64>> {
    let as_integers = array.call_method1("astype", ("int64",))?;
    Ok(as_integers
        .call_method0("ravel")?
        .cast_into::<PyArray1<i64>>()?
        .to_vec()?)
}

/// An array of shape (N,).
pub(crate) fn of_vector<'py, const N: usize>(
    py: Python<'py>,
    vector: &[f64; N],
) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, vector)
}

/// An array of shape (rows, N).
pub(crate) fn of_rows<'py, T: numpy::Element + Copy, const N: usize>(
    py: Python<'py>,
    rows: &[[T; N]],
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let flat = PyArray1::from_slice(py, rows.as_flattened());
    flat.reshape([rows.len(), N])
}

/// An array of shape (rows,).
pub(crate) fn of_column<T: numpy::Element>(
    py: Python<'_>,
    column: Vec<T>,
) -> Bound<'_, PyArray1<T>> {
    column.into_pyarray(py)
}
