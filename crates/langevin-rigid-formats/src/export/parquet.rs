//! Apache Parquet: the columns of the CSV table, typed.

use std::borrow::Borrow;
use std::io::{self, Write};

use langevin_rigid::linalg::Vec3;

use crate::table::{Column, Table, Values, write_parquet};
use crate::track::Pose;
use crate::trajectory::{CSV_HEADER, Trajectory};

const ABOUT: &str = "world frame; SI units; quaternions x, y, z, w from body to world";

/// One row for each pose of each body, one row group a body; `body` is an unsigned integer, the others are
/// doubles.
pub(super) fn write<T: Borrow<Trajectory>>(
    trajectories: &[T],
    out: impl Write + Send,
) -> io::Result<()> {
    let tables = trajectories
        .iter()
        .map(|trajectory| table(trajectory.borrow()));
    write_parquet(tables, ABOUT, out)
}

fn table(trajectory: &Trajectory) -> Table {
    let bodies = Values::Counts(vec![trajectory.body; trajectory.len()]);
    let of_poses = |f: &dyn Fn(&Pose) -> f64| trajectory.poses.iter().map(f).collect::<Vec<f64>>();
    let mut numbers = vec![of_poses(&|p| p.time)];
    numbers.extend((0..3).map(|i| of_poses(&|p| p.position[i])));
    numbers.extend((0..4).map(|i| of_poses(&|p| p.orientation[i])));
    let vectors: [&[Vec3]; 2] = [&trajectory.velocities, &trajectory.angular_velocities];
    for vectors in vectors {
        numbers.extend((0..3).map(|i| vectors.iter().map(|v| v[i]).collect()));
    }
    let values = std::iter::once(bodies).chain(numbers.into_iter().map(Values::Numbers));
    let columns = CSV_HEADER.split(',').zip(values);
    Table::new(
        columns
            .map(|(name, values)| Column {
                name: name.into(),
                values,
            })
            .collect(),
    )
}
