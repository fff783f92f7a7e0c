//! Velocities on a grid, from NumPy: what a flow solver or a measurement has of a wind.

use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};

use crate::files;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::wind::{Table, TableError};
use npyz::{Deserialize, NpyFile, Order, npz::file_name_from_array_name};
use zip::CompressionMethod::Stored;
use zip::ZipArchive;
use zip::result::ZipError;

/// A file that has no wind in it.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", path.display())]
pub struct ReadTableError {
    /// Its path.
    pub path: PathBuf,
    /// Why not.
    pub fault: TableFault,
}

/// Why bytes are no table of a wind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableFault {
    /// The file cannot be read.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It is no archive of arrays.
    #[error("it is no NPZ file ({0}): write it with numpy.savez")]
    NotNpz(String),
    /// An array is compressed.
    #[error("its array `{0}` is compressed: write it with numpy.savez, not numpy.savez_compressed")]
    Compressed(&'static str),
    /// An array is not there.
    #[error("it has no array `{name}`, {what}")]
    Missing {
        /// Its name.
        name: &'static str,
        /// What it holds.
        what: &'static str,
    },
    /// An array cannot be read.
    #[error("its array `{name}` cannot be read: {reason}")]
    Array {
        /// Its name.
        name: &'static str,
        /// Why not.
        reason: String,
    },
    /// An array has another shape.
    #[error("its array `{name}` has the shape {shape:?}, and must have {wanted}")]
    Shape {
        /// Its name.
        name: &'static str,
        /// Its shape.
        shape: Vec<u64>,
        /// What it should be.
        wanted: &'static str,
    },
    /// The arrays are none of a grid.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// Reads the table of a wind from an NPZ file: see [`parse_wind_table`].
///
/// # Errors
/// [`ReadTableError`], which names the file.
pub fn read_wind_table(path: &Path) -> Result<Table, ReadTableError> {
    let read = || parse_wind_table(&files::read(path)?);
    read().map_err(|fault| ReadTableError {
        path: path.to_owned(),
        fault,
    })
}

/// Reads the table of a wind from the bytes of an NPZ file, as `numpy.savez` writes it:
///
/// - `origin` (3): the first point of the grid (m, world frame, y up);
/// - `spacing` (3): between neighbours along x, y, z (m);
/// - `velocity` (nx, ny, nz, 3), or (times, nx, ny, nz, 3): velocities (m/s, world frame);
/// - `time` (times): when (s); only where `velocity` has times.
///
/// Numbers are floats of either precision.
///
/// # Errors
/// [`TableFault`]. No more memory is taken than the bytes call for.
pub fn parse_wind_table(bytes: &[u8]) -> Result<Table, TableFault> {
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
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use std::io::Write;

    use npyz::{AutoSerialize, WriterBuilder};
    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    use super::*;

    struct Npz(ZipWriter<Cursor<Vec<u8>>>);

    impl Npz {
        fn new() -> Self {
            Self(ZipWriter::new(Cursor::new(Vec::new())))
        }

        fn with<T: AutoSerialize>(
            mut self,
            name: &str,
            shape: &[u64],
            order: Order,
            values: impl IntoIterator<Item = T>,
        ) -> Self {
            let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
            self.0
                .start_file(file_name_from_array_name(name), stored)
                .unwrap();
            let options = npyz::WriteOptions::new()
                .default_dtype()
                .shape(shape)
                .order(order);
            let mut array = options.writer(&mut self.0).begin_nd().unwrap();
            array.extend(values).unwrap();
            array.finish().unwrap();
            self
        }

        fn grid() -> Self {
            Self::new()
                .with("origin", &[3], Order::C, [0.0, 1.0, 2.0])
                .with("spacing", &[3], Order::C, [0.5, 1.0, 2.0f32])
        }

        fn bytes(self) -> Vec<u8> {
            self.0.finish().unwrap().into_inner()
        }
    }

    /// u = (x, y, z) at the points of a grid of 3 x 2 x 2.
    fn velocities() -> Vec<f64> {
        let point = |n: usize| {
            [
                0.5 * (n / 4) as f64,
                1.0 + (n / 2 % 2) as f64,
                2.0 + 2.0 * (n % 2) as f64,
            ]
        };
        (0..12).flat_map(point).collect()
    }

    const PLACE: Vec3 = [0.6, 1.3, 3.1];

    fn near(a: Vec3, b: Vec3) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12)
    }

    #[test]
    fn grids_are_read_in_either_order_and_precision() {
        let shape = [3, 2, 2, 3];
        let rows = velocities();
        let table = Npz::grid().with("velocity", &shape, Order::C, rows.clone());
        let table = parse_wind_table(&table.bytes()).unwrap();
        assert!(near(table.velocity(PLACE, 0.0), PLACE));

        // The same with the first index fastest.
        let mut columns = Vec::new();
        for component in 0..3 {
            for k in 0..2 {
                for j in 0..2 {
                    for i in 0..3 {
                        columns.push(rows[((i * 2 + j) * 2 + k) * 3 + component] as f32);
                    }
                }
            }
        }
        let fortran = Npz::grid().with("velocity", &shape, Order::Fortran, columns);
        assert_eq!(parse_wind_table(&fortran.bytes()).unwrap(), table);

        let twice = rows.iter().copied().chain(rows.iter().map(|x| 3.0 * x));
        let timed = Npz::grid()
            .with("velocity", &[2, 3, 2, 2, 3], Order::C, twice)
            .with("time", &[2], Order::C, [0.0, 2.0]);
        let timed = parse_wind_table(&timed.bytes()).unwrap();
        assert!(near(timed.velocity(PLACE, 1.0), PLACE.map(|x| 2.0 * x)));
    }

    #[test]
    fn what_is_no_table_is_told() {
        let told = |bytes: Vec<u8>| parse_wind_table(&bytes).unwrap_err().to_string();
        let shape = [3, 2, 2, 3];
        let with =
            |name, shape: &[u64], values: Vec<f64>| Npz::grid().with(name, shape, Order::C, values);
        for (bytes, words) in [
            (b"no".to_vec(), "it is no NPZ file"),
            (
                Npz::new().bytes(),
                "it has no array `origin`, the first point",
            ),
            (Npz::grid().bytes(), "it has no array `velocity`"),
            (
                with("velocity", &[36], velocities()).bytes(),
                "has the shape [36], and must have (nx, ny, nz, 3)",
            ),
            (
                with("velocity", &[1, 3, 2, 2, 3], velocities()).bytes(),
                "it has no array `time`",
            ),
            (
                with("velocity", &shape, vec![f64::NAN; 36]).bytes(),
                "velocity number 0 of the grid is not finite",
            ),
            (
                Npz::grid()
                    .with("velocity", &shape, Order::C, vec![1i32; 36])
                    .bytes(),
                "its numbers are '<i4', and must be floats",
            ),
            (
                Npz::new()
                    .with("origin", &[2], Order::C, [0.0, 1.0])
                    .bytes(),
                "must have 3 numbers",
            ),
        ] {
            let told = told(bytes);
            assert!(told.contains(words), "{told}");
        }
        // As it is marked in both headers of the first array.
        let mut compressed = Npz::grid().bytes();
        let central = compressed
            .windows(4)
            .position(|bytes| bytes == b"PK\x01\x02");
        for place in [8, central.unwrap() + 10] {
            compressed[place] = 8;
        }
        let words = "its array `origin` is compressed: write it with numpy.savez";
        assert!(told(compressed).starts_with(words));
        let path = Path::new("no/such.npz");
        assert!(
            read_wind_table(path)
                .unwrap_err()
                .to_string()
                .contains("such.npz: ")
        );
    }

    #[test]
    fn damage_at_any_byte_panics_nowhere() {
        let whole = Npz::grid()
            .with("velocity", &[3, 2, 2, 3], Order::C, velocities())
            .bytes();
        for place in 0..whole.len() {
            let _ = parse_wind_table(&whole[..place]);
            for byte in [0, 0xFF, b'9'] {
                let mut damaged = whole.clone();
                damaged[place] = byte;
                let _ = parse_wind_table(&damaged);
            }
        }
        // A shape that no file holds.
        let mut huge = Npz::grid();
        let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        huge.0.start_file("velocity.npy", stored).unwrap();
        let header =
            "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999, 99999999, 9, 3), }";
        let header = format!("{header:<117}\n");
        huge.0.write_all(b"\x93NUMPY\x01\x00").unwrap();
        huge.0
            .write_all(&(header.len() as u16).to_le_bytes())
            .unwrap();
        huge.0.write_all(header.as_bytes()).unwrap();
        let told = parse_wind_table(&huge.bytes()).unwrap_err().to_string();
        assert!(told.contains("more numbers than the file holds"), "{told}");
    }
}
