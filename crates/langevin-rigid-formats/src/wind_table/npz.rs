//! Arrays of NumPy, out of an archive without compression.

use std::io::{self, Cursor, Read};

use langevin_rigid::linalg::Vec3;
use langevin_rigid::wind::Table;
use npyz::{Deserialize, NpyFile, Order, npz::file_name_from_array_name};
use zip::CompressionMethod::Stored;
use zip::ZipArchive;
use zip::result::ZipError;

use super::TableFault;

/// The table in an archive of arrays.
pub(super) fn parse(bytes: &[u8]) -> Result<Table, TableFault> {
    let archive = ZipArchive::new(Cursor::new(bytes));
    let mut archive = archive.map_err(|error| TableFault::NotNpz(error.to_string()))?;
    let mut array = |name: &'static str, what: &'static str| {
        let found = array(&mut archive, name, bytes.len())?;
        found.ok_or(TableFault::Missing { name, what })
    };
    let three = |name: &'static str, array: Array| -> Result<Vec3, TableFault> {
        let shape = array.shape.clone();
        array.values.try_into().map_err(|_| TableFault::Shape {
            name,
            shape,
            wanted: "3 numbers",
        })
    };
    let origin = three(
        "origin",
        array("origin", "the first point of the grid (m)")?,
    )?;
    let spacing = three(
        "spacing",
        array("spacing", "how far its points are apart (m)")?,
    )?;
    let velocity = array("velocity", "the velocities (m/s)")?;
    let (times, [nx, ny, nz]) = match velocity.shape[..] {
        [nx, ny, nz, 3] => (vec![0.0], [nx, ny, nz]),
        [_, nx, ny, nz, 3] => {
            let when = array("time", "the times of the velocities (s)")?;
            (when.values, [nx, ny, nz])
        }
        _ => {
            return Err(TableFault::Shape {
                name: "velocity",
                shape: velocity.shape,
                wanted: "(nx, ny, nz, 3) or (times, nx, ny, nz, 3)",
            });
        }
    };
    // Whole numbers of points: they were read.
    let counts = [nx, ny, nz].map(|n| n as usize);
    let (vectors, _) = velocity.values.as_chunks::<3>();
    Ok(Table::new(
        origin,
        spacing,
        counts,
        &times,
        vectors.to_vec(),
    )?)
}

/// Numbers in C order.
struct Array {
    shape: Vec<u64>,
    values: Vec<f64>,
}

type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// The array of that name, if there is one, out of an archive of so many bytes.
fn array(
    archive: &mut Archive<'_>,
    name: &'static str,
    bytes: usize,
) -> Result<Option<Array>, TableFault> {
    let fault = |reason: String| TableFault::Array { name, reason };
    let entry = match archive.by_name(&file_name_from_array_name(name)) {
        Err(ZipError::FileNotFound) => return Ok(None),
        Err(error) => return Err(fault(error.to_string())),
        Ok(entry) if entry.compression() != Stored => return Err(TableFault::Compressed(name)),
        Ok(entry) => entry,
    };
    let file = NpyFile::new(entry).map_err(|error| fault(error.to_string()))?;
    let shape = file.shape().to_vec();
    let count = shape.iter().try_fold(1u64, |n, &x| n.checked_mul(x));
    if count.is_none_or(|n| n > bytes as u64 / 4) {
        return Err(fault(format!(
            "its shape {shape:?} has more numbers than the file holds"
        )));
    }
    let fortran = file.order() == Order::Fortran;
    let values = match file.try_data::<f64>() {
        Ok(values) => numbers(values),
        Err(file) => match file.try_data::<f32>() {
            Ok(values) => numbers(values),
            Err(file) => {
                let kind = file.dtype().descr();
                return Err(fault(format!("its numbers are {kind}, and must be floats")));
            }
        },
    };
    let values = values.map_err(|error| fault(error.to_string()))?;
    let values = if fortran {
        in_rows(&shape, &values)
    } else {
        values
    };
    Ok(Some(Array { shape, values }))
}

fn numbers<T: Deserialize + Into<f64>, R: Read>(
    values: npyz::NpyReader<T, R>,
) -> io::Result<Vec<f64>> {
    values.map(|x| x.map(Into::into)).collect()
}

/// What runs fastest in its first index, so that it does in its last.
fn in_rows(shape: &[u64], values: &[f64]) -> Vec<f64> {
    let mut sorted = Vec::with_capacity(values.len());
    for place in 0..values.len() {
        let (mut rest, mut stride, mut from) = (place, values.len(), 0);
        for &count in shape.iter().rev() {
            let count = count as usize;
            stride /= count;
            from += (rest % count) * stride;
            rest /= count;
        }
        sorted.push(values[from]);
    }
    sorted
}

#[cfg(test)]
mod tests;
