//! Velocities on a grid, from NumPy: what a flow solver or a measurement has of a wind.

#[cfg(feature = "npz")]
mod arrays;

use std::io;
use std::path::{Path, PathBuf};

use langevin_rigid::wind::{Table, TableError};

use crate::files;
#[cfg(feature = "npz")]
pub use arrays::parse_wind_table;

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
    #[error("this build cannot read NPZ files: it is without the feature `npz`")]
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

/// Refuses the table of a wind, which this build cannot read.
///
/// # Errors
/// [`TableFault::NotBuilt`].
#[cfg(not(feature = "npz"))]
pub fn parse_wind_table(_: &[u8]) -> Result<Table, TableFault> {
    Err(TableFault::NotBuilt)
}
