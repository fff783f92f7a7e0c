//! Apache Parquet: the columns of the CSV table, typed.

use std::borrow::Borrow;
use std::io::{self, Write};
use std::sync::Arc;

use langevin_rigid::linalg::Vec3;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{DataType, DoubleType, Int32Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::track::Pose;
use crate::trajectory::{CSV_HEADER, Trajectory};

/// One row for each pose of each body, one row group a body; `body` is an unsigned integer, the others are
/// doubles.
pub(super) fn write<T: Borrow<Trajectory>>(
    trajectories: &[T],
    out: impl Write + Send,
) -> io::Result<()> {
    write_file(trajectories, out).map_err(io::Error::other)
}

fn write_file<T: Borrow<Trajectory>>(trajectories: &[T], out: impl Write + Send) -> Result<()> {
    let units = KeyValue::new(
        "langevin_rigid".to_owned(),
        "world frame; SI units; quaternions x, y, z, w from body to world".to_owned(),
    );
    let properties = WriterProperties::builder()
        .set_writer_version(WriterVersion::PARQUET_1_0)
        .set_compression(Compression::UNCOMPRESSED)
        // Hardly a number of a trajectory comes twice.
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(vec![units]))
        .build();
    let mut file = SerializedFileWriter::new(out, schema()?, Arc::new(properties))?;
    for trajectory in trajectories {
        let mut group = file.next_row_group()?;
        body_rows(trajectory.borrow(), &mut group)?;
        group.close()?;
    }
    file.close()?;
    Ok(())
}

fn schema() -> Result<TypePtr> {
    let columns: Result<Vec<TypePtr>> = CSV_HEADER.split(',').map(column_type).collect();
    let schema = Type::group_type_builder("trajectory").with_fields(columns?);
    Ok(Arc::new(schema.build()?))
}

fn column_type(name: &str) -> Result<TypePtr> {
    let unsigned = LogicalType::integer(32, false);
    let column = match name {
        "body" => {
            Type::primitive_type_builder(name, Physical::INT32).with_logical_type(Some(unsigned))
        }
        _ => Type::primitive_type_builder(name, Physical::DOUBLE),
    };
    Ok(Arc::new(
        column.with_repetition(Repetition::REQUIRED).build()?,
    ))
}

fn body_rows<W: Write + Send>(
    trajectory: &Trajectory,
    group: &mut SerializedRowGroupWriter<'_, W>,
) -> Result<()> {
    let numbers = vec![trajectory.body as i32; trajectory.len()];
    column::<Int32Type, W>(group, &numbers)?;
    let of_poses = |f: &dyn Fn(&Pose) -> f64| trajectory.poses.iter().map(f).collect::<Vec<f64>>();
    column::<DoubleType, W>(group, &of_poses(&|p| p.time))?;
    for i in 0..3 {
        column::<DoubleType, W>(group, &of_poses(&|p| p.position[i]))?;
    }
    for i in 0..4 {
        column::<DoubleType, W>(group, &of_poses(&|p| p.orientation[i]))?;
    }
    let vectors: [&[Vec3]; 2] = [&trajectory.velocities, &trajectory.angular_velocities];
    for vectors in vectors {
        for i in 0..3 {
            let component: Vec<f64> = vectors.iter().map(|v| v[i]).collect();
            column::<DoubleType, W>(group, &component)?;
        }
    }
    Ok(())
}

fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
) -> Result<()> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, None, None)?;
        column.close()?;
    }
    Ok(())
}
