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
    /// NumPy arrays, every step: `trajectory.npz`. Behind the feature `npz`.
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
        self.row().0
    }

    /// The file that it is written to.
    pub fn file_name(self) -> &'static str {
        self.row().1
    }

    /// Whether it has frames in place of every step.
    pub fn is_animation(self) -> bool {
        self.row().2
    }

    /// Name, file, whether it is an animation.
    fn row(self) -> (&'static str, &'static str, bool) {
        match self {
            Self::Csv => ("csv", "trajectory.csv", false),
            Self::Npz => ("npz", "trajectory.npz", false),
            Self::Parquet => ("parquet", "trajectory.parquet", false),
            Self::Glb => ("glb", "trajectory.glb", true),
            Self::Usd => ("usd", "trajectory.usda", true),
        }
    }

    /// Whether this build can write it.
    pub fn built(self) -> bool {
        match self {
            Self::Npz => cfg!(feature = "npz"),
            Self::Parquet => cfg!(feature = "parquet"),
            Self::Csv | Self::Glb | Self::Usd => true,
        }
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
