//! Units of length of mesh files.

use std::str::FromStr;

use langevin_rigid::{UnknownName, choose};

/// The unit of length of a mesh file, by its symbol "m", "cm", "mm", "um", "in" or "ft"; "inch" is "in".
///
/// ```
/// use langevin_rigid_formats::mesh::LengthUnit;
///
/// let unit: LengthUnit = "mm".parse()?;
/// assert_eq!(unit.to_metres(8.3), 0.0083);
/// assert_eq!("inch".parse::<LengthUnit>()?.to_metres(1.0), 0.0254);
/// assert!("parsec".parse::<LengthUnit>().is_err());
/// # Ok::<(), langevin_rigid::UnknownName>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum LengthUnit {
    /// Metres.
    #[default]
    M,
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
    /// Micrometres.
    Um,
    /// International inches, 25.4 mm.
    In,
    /// International feet, 12 inches.
    Ft,
}

/// All of them by their symbols.
const UNITS: [(&str, LengthUnit); 6] = [
    ("m", LengthUnit::M),
    ("cm", LengthUnit::Cm),
    ("mm", LengthUnit::Mm),
    ("um", LengthUnit::Um),
    ("in", LengthUnit::In),
    ("ft", LengthUnit::Ft),
];

impl LengthUnit {
    /// A length in this unit, in metres.
    pub fn to_metres(self, length: f64) -> f64 {
        // Dividing rounds once; a hundredth has been rounded before. So do 127 and 381 times a number in
        // single precision, which is exact.
        match self {
            LengthUnit::M => length,
            LengthUnit::Cm => length / 100.0,
            LengthUnit::Mm => length / 1000.0,
            LengthUnit::Um => length / 1e6,
            LengthUnit::In => length * 127.0 / 5000.0,
            LengthUnit::Ft => length * 381.0 / 1250.0,
        }
    }
}

impl FromStr for LengthUnit {
    type Err = UnknownName;

    fn from_str(symbol: &str) -> Result<LengthUnit, UnknownName> {
        let symbol = if symbol == "inch" { "in" } else { symbol };
        choose("unit of length", symbol, UNITS)
    }
}

impl std::fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            LengthUnit::M => "m",
            LengthUnit::Cm => "cm",
            LengthUnit::Mm => "mm",
            LengthUnit::Um => "um",
            LengthUnit::In => "in",
            LengthUnit::Ft => "ft",
        })
    }
}

/// The unit of length that a file was read in, which need not have a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FileUnit {
    /// A unit with a symbol.
    Known(LengthUnit),
    /// So many metres, which no known unit has.
    Metres(f64),
}

impl Default for FileUnit {
    fn default() -> FileUnit {
        FileUnit::Known(LengthUnit::M)
    }
}

impl FileUnit {
    /// A unit of so many metres.
    #[cfg(feature = "collada")]
    pub(super) fn of_metres(metres: f64) -> FileUnit {
        let mut all = UNITS.into_iter().map(|(_, unit)| unit);
        // Programs write six or seven digits.
        let is = |unit: &LengthUnit| (metres / unit.to_metres(1.0) - 1.0).abs() < 1e-6;
        match all.find(is) {
            Some(unit) => FileUnit::Known(unit),
            None => FileUnit::Metres(metres),
        }
    }

    /// A length in this unit, in metres.
    pub fn to_metres(self, length: f64) -> f64 {
        match self {
            FileUnit::Known(unit) => unit.to_metres(length),
            FileUnit::Metres(metres) => length * metres,
        }
    }
}

impl std::fmt::Display for FileUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            FileUnit::Known(unit) => unit.fmt(f),
            FileUnit::Metres(metres) => write!(f, "units of {metres} m"),
        }
    }
}
