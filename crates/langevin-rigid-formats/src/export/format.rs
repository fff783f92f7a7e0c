//! The formats by name.

use std::fmt;
use std::str::FromStr;

use langevin_rigid::{UnknownName, choose};

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

    /// Whether it has frames in place of every step.
    pub fn is_animation(self) -> bool {
        match self {
            Self::Glb | Self::Usd => true,
            Self::Csv | Self::Npz | Self::Parquet => false,
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
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let choices = Self::ALL.map(|format| (format.name(), format));
        choose("format of a trajectory", name, choices)
    }
}
