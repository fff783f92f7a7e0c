//! Apache Parquet: typed columns.

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
    tables: impl Iterator<Item = Table>,
    about: &str,
    out: impl Write + Send,
) -> io::Result<()> {
    write_file(tables, about, out).map_err(io::Error::other)
}

fn write_file(
    tables: impl Iterator<Item = Table>,
    about: &str,
    out: impl Write + Send,
) -> Result<()> {
    let mut tables = tables.peekable();
    let none = Table::default();
    let first = tables.peek().unwrap_or(&none);
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
        let path = ColumnPath::from(column.name.as_ref());
        properties = properties.set_column_dictionary_enabled(path, true);
    }
    let schema = schema(first)?;
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties.build()))?;
    for table in tables {
        let mut group = file.next_row_group()?;
        for column in table.columns() {
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
        _ => false,
    }
}

fn schema(table: &Table) -> Result<TypePtr> {
    let columns: Result<Vec<TypePtr>> = table.columns().iter().map(column_type).collect();
    let schema = Type::group_type_builder("table").with_fields(columns?);
    Ok(Arc::new(schema.build()?))
}

fn column_type(column: &Column) -> Result<TypePtr> {
    let (physical, logical) = match column.values {
        Values::Numbers(_) | Values::Optional(_) => (Physical::DOUBLE, None),
        Values::Counts(_) => (Physical::INT32, Some(LogicalType::integer(32, false))),
        Values::Large(_) => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Values::Words(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
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

fn rows<W: Write + Send>(
    values: &Values,
    group: &mut SerializedRowGroupWriter<'_, W>,
) -> Result<()> {
    match values {
        Values::Numbers(values) => column::<DoubleType, W>(group, values, None),
        Values::Optional(values) => {
            let given: Vec<f64> = values.iter().copied().flatten().collect();
            let levels: Vec<i16> = values.iter().map(|x| i16::from(x.is_some())).collect();
            column::<DoubleType, W>(group, &given, Some(&levels))
        }
        Values::Counts(values) => {
            let values: Vec<i32> = values.iter().map(|n| n.cast_signed()).collect();
            column::<Int32Type, W>(group, &values, None)
        }
        Values::Large(values) => {
            let values: Vec<i64> = values.iter().map(|n| n.cast_signed()).collect();
            column::<Int64Type, W>(group, &values, None)
        }
        Values::Words(values) => {
            let values: Vec<ByteArray> = values
                .iter()
                .map(|word| ByteArray::from(word.as_ref()))
                .collect();
            column::<ByteArrayType, W>(group, &values, None)
        }
    }
}

/// `levels` are 1 where there is a value, of a column that may have none.
fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<()> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, levels, None)?;
        column.close()?;
    }
    Ok(())
}
