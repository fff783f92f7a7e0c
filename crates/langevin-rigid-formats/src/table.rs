//! Tables of named columns, as CSV and Parquet.

#[cfg(feature = "parquet")]
mod parquet;

use std::fmt::Write as _;
#[cfg(feature = "parquet")]
use std::io;

/// Columns of equal length.
///
/// ```
/// use langevin_rigid_formats::table::{Column, Table, Values};
/// let table = Table::new(vec![
///     Column { name: "run", values: Values::Counts(vec![0, 1]) },
///     Column { name: "t", values: Values::Optional(vec![Some(0.25), None]) },
/// ]);
/// assert_eq!(table.csv(), "run,t\n0,0.25\n1,\n");
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    columns: Vec<Column>,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its values, one a row.
    pub values: Values,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Values {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Numbers, some of which are missing.
    Optional(Vec<Option<f64>>),
    /// Whole numbers.
    Counts(Vec<u32>),
    /// Whole numbers that may be large.
    Large(Vec<u64>),
    /// Words.
    Words(Vec<&'static str>),
}

impl Values {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Optional(values) => values.len(),
            Self::Counts(values) => values.len(),
            Self::Large(values) => values.len(),
            Self::Words(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn write(&self, row: usize, line: &mut String) {
        // Writing to a string cannot fail.
        let _ = match self {
            Self::Numbers(values) => write!(line, "{}", values[row]),
            Self::Optional(values) => values[row].map_or(Ok(()), |x| write!(line, "{x}")),
            Self::Counts(values) => write!(line, "{}", values[row]),
            Self::Large(values) => write!(line, "{}", values[row]),
            Self::Words(values) => write!(line, "{}", values[row]),
        };
    }
}

impl Table {
    /// Of these columns.
    ///
    /// # Panics
    /// If they are not of equal length.
    pub fn new(columns: Vec<Column>) -> Self {
        let rows = columns.first().map_or(0, |column| column.values.len());
        for Column { name, values } in &columns {
            assert!(
                values.len() == rows,
                "column `{name}` has {} of {rows} rows",
                values.len()
            );
        }
        Self { columns }
    }

    /// Its columns, in their order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The same, taken apart.
    pub fn into_columns(self) -> Vec<Column> {
        self.columns
    }

    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Comma-separated values under the names. Numbers have as many digits as it takes to read back the same bits; a missing
    /// one is empty.
    pub fn csv(&self) -> String {
        let names: Vec<&str> = self.columns.iter().map(|column| column.name).collect();
        let mut table = names.join(",") + "\n";
        for row in 0..self.rows() {
            for (number, column) in self.columns.iter().enumerate() {
                if number > 0 {
                    table.push(',');
                }
                column.values.write(row, &mut table);
            }
            table.push('\n');
        }
        table
    }

    /// Apache Parquet, one row group. Behind the feature `parquet`.
    ///
    /// `about` is kept in the metadata of the file, under `langevin_rigid`.
    ///
    /// # Errors
    /// Those of `out`.
    #[cfg(feature = "parquet")]
    pub fn write_parquet(&self, about: &str, out: impl io::Write + Send) -> io::Result<()> {
        parquet::write(std::iter::once(self.clone()), about, out)
    }
}

/// Apache Parquet, one row group a table; all have the same columns.
#[cfg(feature = "parquet")]
pub(crate) fn write_parquet(
    tables: impl Iterator<Item = Table>,
    about: &str,
    out: impl io::Write + Send,
) -> io::Result<()> {
    parquet::write(tables, about, out)
}
