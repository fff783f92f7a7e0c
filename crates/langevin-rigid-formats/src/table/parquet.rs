//! Apache Parquet: typed columns.

use std::borrow::Borrow;
use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type, TypePtr};

use super::{Column, Table, Values};

/// One row group a table. The columns are those of the first.
pub(super) fn write(
    tables: impl Iterator<Item: Borrow<Table>>,
    about: &str,
    out: impl Write + Send,
) -> io::Result<()> {
    write_file(tables, about, out).map_err(io::Error::other)
}

fn write_file(
    tables: impl Iterator<Item: Borrow<Table>>,
    about: &str,
    out: impl Write + Send,
) -> Result<()> {
    let mut tables = tables.peekable();
    let none = Table::default();
    let first = tables.peek().map_or(&none, Borrow::borrow);
    let about = KeyValue::new("langevin_rigid".to_owned(), about.to_owned());
    let mut properties = WriterProperties::builder()
        .set_writer_version(WriterVersion::PARQUET_1_0)
        .set_compression(Compression::UNCOMPRESSED)
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(vec![about]));
    for column in first
        .columns()
        .iter()
        .filter(|column| repeats(&column.values))
    {
        properties = properties.set_column_dictionary_enabled(path(column), true);
    }
    let schema = schema(first)?;
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties.build()))?;
    for table in tables {
        let mut group = file.next_row_group()?;
        for column in table.borrow().columns() {
            rows(&column.values, &mut group)?;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

/// Whether there are few different values, which take hardly any room in a dictionary.
fn repeats(values: &Values) -> bool {
    match values {
        Values::Words(_) => true,
        Values::Numbers(values) => values.windows(2).all(|two| two[0] == two[1]),
        Values::Large(values) => values.windows(2).all(|two| two[0] == two[1]),
        Values::Lists(values) => values.windows(2).all(|two| two[0] == two[1]),
        _ => false,
    }
}

fn schema(table: &Table) -> Result<TypePtr> {
    let columns: Result<Vec<TypePtr>> = table.columns().iter().map(column_type).collect();
    let schema = Type::group_type_builder("table").with_fields(columns?);
    Ok(Arc::new(schema.build()?))
}

/// Where the numbers of a list are, by the rules of the format.
const LIST: [&str; 2] = ["list", "element"];

/// Where the values of a column are.
fn path(column: &Column) -> ColumnPath {
    let within: &[&str] = match column.values {
        Values::Lists(_) => &LIST,
        _ => &[],
    };
    let parts = std::iter::once(column.name.as_ref()).chain(within.iter().copied());
    ColumnPath::new(parts.map(str::to_owned).collect())
}

fn column_type(column: &Column) -> Result<TypePtr> {
    let (physical, logical) = match column.values {
        Values::Numbers(_) | Values::Optional(_) => (Physical::DOUBLE, None),
        Values::Counts(_) => (Physical::INT32, Some(LogicalType::integer(32, false))),
        Values::Large(_) => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Values::Words(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Values::Lists(_) => return list_type(&column.name),
    };
    let repetition = match column.values {
        Values::Optional(_) => Repetition::OPTIONAL,
        _ => Repetition::REQUIRED,
    };
    let column = Type::primitive_type_builder(&column.name, physical)
        .with_logical_type(logical)
        .with_repetition(repetition);
    Ok(Arc::new(column.build()?))
}

fn list_type(name: &str) -> Result<TypePtr> {
    let [list, element] = LIST;
    let element = Type::primitive_type_builder(element, Physical::DOUBLE)
        .with_repetition(Repetition::REQUIRED);
    let list = Type::group_type_builder(list)
        .with_repetition(Repetition::REPEATED)
        .with_fields(vec![Arc::new(element.build()?)]);
    let column = Type::group_type_builder(name)
        .with_repetition(Repetition::REQUIRED)
        .with_logical_type(Some(LogicalType::List))
        .with_fields(vec![Arc::new(list.build()?)]);
    Ok(Arc::new(column.build()?))
}

fn rows<W: Write + Send>(
    values: &Values,
    group: &mut SerializedRowGroupWriter<'_, W>,
) -> Result<()> {
    match values {
        Values::Numbers(values) => column::<DoubleType, W>(group, values, None, None),
        Values::Optional(values) => {
            let given: Vec<f64> = values.iter().copied().flatten().collect();
            let levels: Vec<i16> = values.iter().map(|x| i16::from(x.is_some())).collect();
            column::<DoubleType, W>(group, &given, Some(&levels), None)
        }
        Values::Counts(values) => {
            let values: Vec<i32> = values.iter().map(|n| n.cast_signed()).collect();
            column::<Int32Type, W>(group, &values, None, None)
        }
        Values::Large(values) => {
            let values: Vec<i64> = values.iter().map(|n| n.cast_signed()).collect();
            column::<Int64Type, W>(group, &values, None, None)
        }
        Values::Words(values) => {
            let values: Vec<ByteArray> = values
                .iter()
                .map(|word| ByteArray::from(word.as_ref()))
                .collect();
            column::<ByteArrayType, W>(group, &values, None, None)
        }
        Values::Lists(lists) => {
            // A list without a number has a level and no value; each but the first number of a list goes on with it.
            let levels = lists.iter().flat_map(|list| match list.len() {
                0 => vec![0],
                count => vec![1; count],
            });
            let repeated = lists
                .iter()
                .flat_map(|list| (0..list.len().max(1)).map(|place| i16::from(place > 0)));
            let levels: Vec<i16> = levels.collect();
            let repeated: Vec<i16> = repeated.collect();
            column::<DoubleType, W>(group, &lists.concat(), Some(&levels), Some(&repeated))
        }
    }
}

/// `levels` are 1 where there is a value, of a column that may have none; `repeated` are 1 where a value is of the list of the
/// one before.
fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    levels: Option<&[i16]>,
    repeated: Option<&[i16]>,
) -> Result<()> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, levels, repeated)?;
        column.close()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};

    use super::*;

    /// The rows of tables as the library reads them, in words.
    fn rows_of(tables: &[Table]) -> Vec<String> {
        let file = tempfile::tempfile().unwrap();
        super::write(tables.iter(), "a test", &file).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let rows = reader.get_row_iter(None).unwrap();
        rows.map(|row| row.unwrap().to_string()).collect()
    }

    #[test]
    fn lists_of_any_length_are_read_back() {
        let table = |lists: Vec<Vec<f64>>| {
            let numbers = (0..lists.len()).map(|row| (row + 1) as f64).collect();
            Table::new(vec![
                Column {
                    name: "row".into(),
                    values: Values::Numbers(numbers),
                },
                Column {
                    name: "list".into(),
                    values: Values::Lists(lists),
                },
            ])
        };
        let various = table(vec![vec![], vec![0.1, 2.5, 3.5], vec![7.0], vec![]]);
        let equal = table(vec![vec![0.25, 0.5]; 2]);
        assert_eq!(
            rows_of(&[various, equal]),
            [
                "{row: 1.0, list: []}",
                "{row: 2.0, list: [0.1, 2.5, 3.5]}",
                "{row: 3.0, list: [7.0]}",
                "{row: 4.0, list: []}",
                "{row: 1.0, list: [0.25, 0.5]}",
                "{row: 2.0, list: [0.25, 0.5]}",
            ]
        );
    }
}
