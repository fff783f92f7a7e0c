//! Velocities on a grid, from NumPy: what a flow solver or a measurement has of a wind.

#[cfg(feature = "npz")]
mod npz;

use std::io;
use std::path::{Path, PathBuf};

use crate::files;
use langevin_rigid::wind::{Table, TableError};

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
    /// The reader was left out of this build.
    #[error(
        "this build cannot read NPZ files: build it with the feature `npz`, or describe the wind by other fields"
    )]
    NotBuilt,
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
    parse(bytes)
}

#[cfg(feature = "npz")]
use npz::parse;

#[cfg(not(feature = "npz"))]
fn parse(_: &[u8]) -> Result<Table, TableFault> {
    Err(TableFault::NotBuilt)
}

#[cfg(all(test, not(feature = "npz")))]
mod tests {
    use super::*;

    #[test]
    fn without_its_reader_npz_is_refused_by_name() {
        let told = parse_wind_table(b"PK").map_err(|fault| fault.to_string());
        assert!(told.is_err_and(|told| told.contains("the feature `npz`")));
    }
}
