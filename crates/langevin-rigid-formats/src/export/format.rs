//! The formats by name.

use std::fmt;
use std::str::FromStr;

/// A file format of recordings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Comma-separated values, every step: `trajectory.csv`.
    Csv,
    /// NumPy arrays, every step: `trajectory.npz`.
    Npz,
    /// Apache Parquet, every step: `trajectory.parquet`. Behind the feature `parquet`.
    Parquet,
    /// glTF 2.0 as one binary file, an animation: `trajectory.glb`.
    Glb,
    /// OpenUSD as text, an animation: `trajectory.usda`.
    Usd,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Csv, Self::Npz, Self::Parquet, Self::Glb, Self::Usd];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Npz => "npz",
            Self::Parquet => "parquet",
            Self::Glb => "glb",
            Self::Usd => "usd",
        }
    }

    /// The file that it is written to.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::Csv => "trajectory.csv",
            Self::Npz => "trajectory.npz",
            Self::Parquet => "trajectory.parquet",
            Self::Glb => "trajectory.glb",
            Self::Usd => "trajectory.usda",
        }
    }

    /// Whether this build can write it.
    pub fn built(self) -> bool {
        self != Self::Parquet || cfg!(feature = "parquet")
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        let named = |format: &Self| format.name() == name;
        Self::ALL.into_iter().find(named).ok_or(UnknownFormat {
            name: name.to_owned(),
        })
    }
}

/// The name is that of no format.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` is no format of a trajectory; the formats are csv, npz, parquet, glb, usd")]
pub struct UnknownFormat {
    /// What was given.
    pub name: String,
}
