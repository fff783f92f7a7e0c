//! Tables of named columns, as CSV and Parquet.

#[cfg(feature = "parquet")]
mod parquet;

use std::borrow::Cow;
use std::fmt::Write as _;
#[cfg(feature = "parquet")]
use std::io;

/// Columns of equal length.
///
/// ```
/// use langevin_rigid_formats::table::{Column, Table, Values};
/// let table = Table::new(vec![
///     Column { name: "run".into(), values: Values::Counts(vec![0, 1]) },
///     Column { name: "t".into(), values: Values::Optional(vec![Some(0.25), None]) },
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
    pub name: Cow<'static, str>,
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
    Words(Vec<Cow<'static, str>>),
    /// Lists of numbers, each of any length.
    Lists(Vec<Vec<f64>>),
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
            Self::Lists(values) => values.len(),
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
            Self::Words(values) => write!(line, "{}", word(&values[row])),
            Self::Lists(values) => write!(line, "{}", word(&format!("{:?}", values[row]))),
        };
    }
}

/// A word as CSV has it: in quotes where it has a comma, a quote or a line end.
fn word(word: &str) -> Cow<'_, str> {
    match word.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", word.replace('"', "\"\"")).into(),
        false => word.into(),
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

    /// Adds the rows of another table.
    ///
    /// # Panics
    /// If it has other columns.
    pub fn append(&mut self, other: Self) {
        if self.columns.is_empty() {
            *self = other;
            return;
        }
        let kinds = |table: &Self| -> Vec<_> {
            let columns = table.columns.iter();
            columns
                .map(|c| (c.name.clone(), std::mem::discriminant(&c.values)))
                .collect()
        };
        assert!(
            kinds(self) == kinds(&other),
            "the tables have other columns"
        );
        for (column, other) in self.columns.iter_mut().zip(other.columns) {
            match (&mut column.values, other.values) {
                (Values::Numbers(values), Values::Numbers(more)) => values.extend(more),
                (Values::Optional(values), Values::Optional(more)) => values.extend(more),
                (Values::Counts(values), Values::Counts(more)) => values.extend(more),
                (Values::Large(values), Values::Large(more)) => values.extend(more),
                (Values::Words(values), Values::Words(more)) => values.extend(more),
                (Values::Lists(values), Values::Lists(more)) => values.extend(more),
                // Kinds were compared.
                _ => {}
            }
        }
    }

    /// Comma-separated values under the names. Numbers have as many digits as it takes to read back the same bits; a missing
    /// one is empty, and a list is in brackets within quotes.
    pub fn csv(&self) -> String {
        let names = self.columns.iter().map(|column| word(&column.name));
        let names: Vec<Cow<'_, str>> = names.collect();
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
        parquet::write(std::iter::once(self), about, out)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn table(name: &'static str, words: &[&'static str]) -> Table {
        Table::new(vec![Column {
            name: name.into(),
            values: Values::Words(words.iter().map(|word| (*word).into()).collect()),
        }])
    }

    #[test]
    fn words_that_csv_would_split_are_quoted() {
        let csv = table("a,b", &["plain", "say \"no\"", "two\nlines"]).csv();
        assert_eq!(csv, "\"a,b\"\nplain\n\"say \"\"no\"\"\"\n\"two\nlines\"\n");
    }

    #[test]
    fn lists_are_one_value_of_csv() {
        let table = Table::new(vec![Column {
            name: "a".into(),
            values: Values::Lists(vec![vec![0.1, -2.0], vec![], vec![3.0]]),
        }]);
        assert_eq!(table.csv(), "a\n\"[0.1, -2.0]\"\n[]\n[3.0]\n");
    }

    #[test]
    fn tables_grow_by_each_other() {
        let mut all = Table::default();
        all.append(table("a", &["one"]));
        all.append(table("a", &["two", "three"]));
        assert_eq!(all, table("a", &["one", "two", "three"]));
    }

    #[test]
    #[should_panic(expected = "other columns")]
    fn tables_of_other_columns_do_not_mix() {
        table("a", &["one"]).append(table("b", &["two"]));
    }
}
