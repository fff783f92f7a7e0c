//! Trajectories as comma-separated values.

use std::borrow::Borrow;
use std::collections::HashSet;
use std::fmt::Write as _;
use std::io;
use std::ops::Range;

use rayon::prelude::*;

use super::Trajectory;
use crate::track::{FARTHEST, Pose};

/// The columns of a trajectory table: world frame; metres, seconds, radians.
pub const CSV_HEADER: &str = "body,t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";

const COLUMNS: usize = 15;

/// Rows that are written or read at a time: on all cores, and never all in memory.
const BATCH: usize = 1 << 16;

/// Rows that one core writes at a time.
const CHUNK: usize = 1 << 11;

/// How far the length of a quaternion may be from one.
const UNIT: f64 = 1e-6;

/// Why a table is no trajectory.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The first line is another.
    #[error("line 1: the columns are not those of a trajectory ({CSV_HEADER})")]
    Header,
    /// The first line of another table is another.
    #[error("line 1: the columns are not those of this table ({columns})")]
    Columns {
        /// What they should be.
        columns: &'static str,
    },
    /// A line cannot be read.
    #[error("line {line}: {reason}; the table is damaged or was edited, run the scene again")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// The table does not end with a line end, as whole ones do.
    #[error("line {line}: the table is cut short here, it has no line end; run the scene again")]
    Cut {
        /// Number of the last line, from 1.
        line: usize,
    },
    /// There are no rows.
    #[error("there are no rows in it: run the scene again")]
    Empty,
}

/// Writes the rows of all bodies, in order, under [`CSV_HEADER`].
///
/// Numbers are written with as many digits as it takes to read back the same bits.
///
/// ```
/// use langevin_rigid::State;
/// use langevin_rigid_formats::trajectory::{Trajectory, read_csv, write_csv};
/// let still = Trajectory::new(0, &[State::default()]);
/// let mut table = Vec::new();
/// write_csv(&[still.clone()], &mut table)?;
/// let table = String::from_utf8(table)?;
/// assert_eq!(table.lines().nth(1), Some("0,0,0,0,0,0,0,0,1,0,0,0,0,0,0"));
/// assert_eq!(read_csv(&table)?, [still]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of `out`.
pub fn write_csv<T: Borrow<Trajectory>>(
    trajectories: &[T],
    out: &mut dyn io::Write,
) -> io::Result<()> {
    writeln!(out, "{CSV_HEADER}")?;
    let trajectories = trajectories.iter().map(T::borrow);
    let chunks: Vec<(&Trajectory, Range<usize>)> = trajectories.flat_map(chunks).collect();
    for batch in chunks.chunks(BATCH / CHUNK) {
        let rows: Vec<String> = batch
            .par_iter()
            .map(|(trajectory, range)| rows(trajectory, range.clone()))
            .collect();
        rows.iter()
            .try_for_each(|rows| out.write_all(rows.as_bytes()))?;
    }
    Ok(())
}

fn chunks(trajectory: &Trajectory) -> impl Iterator<Item = (&Trajectory, Range<usize>)> {
    let length = trajectory.len();
    let starts = (0..length).step_by(CHUNK);
    starts.map(move |start| (trajectory, start..(start + CHUNK).min(length)))
}

/// The whole table of one body, as [`write_csv`] writes it.
pub fn csv(trajectory: &Trajectory) -> String {
    format!("{CSV_HEADER}\n{}", rows(trajectory, 0..trajectory.len()))
}

fn rows(trajectory: &Trajectory, range: Range<usize>) -> String {
    let mut rows = String::with_capacity(220 * range.len());
    let velocities = trajectory.velocities[range.clone()]
        .iter()
        .zip(&trajectory.angular_velocities[range.clone()]);
    for (pose, (v, w)) in trajectory.poses[range].iter().zip(velocities) {
        // Writing to a string cannot fail.
        let _ = write!(rows, "{},{}", trajectory.body, pose.time);
        for x in pose
            .position
            .iter()
            .chain(&pose.orientation)
            .chain(v)
            .chain(w)
        {
            let _ = write!(rows, ",{x}");
        }
        rows.push('\n');
    }
    rows
}

/// Reads what [`write_csv`] wrote: the rows of a body stand together and in order of time.
///
/// # Errors
/// [`TableError`] with the line.
pub fn read_csv(table: &str) -> Result<Vec<Trajectory>, TableError> {
    let (header, mut rest) = table.split_once('\n').unwrap_or((table, ""));
    if header.trim_end() != CSV_HEADER {
        return Err(TableError::Header);
    }
    let mut bodies = Bodies::default();
    let mut line = 2;
    while !rest.is_empty() {
        let mut batch = Vec::with_capacity(BATCH);
        while let Some((row, after)) = rest.split_once('\n').filter(|_| batch.len() < BATCH) {
            batch.push(row);
            rest = after;
        }
        let whole = batch.len();
        let rows: Vec<Result<Row, String>> = batch.into_par_iter().map(row).collect();
        for (line, row) in (line..).zip(rows) {
            row.and_then(|row| bodies.add(row))
                .map_err(|reason| TableError::Line { line, reason })?;
        }
        line += whole;
        if whole == 0 {
            return Err(TableError::Cut { line });
        }
    }
    match bodies.trajectories.is_empty() {
        true => Err(TableError::Empty),
        false => Ok(bodies.trajectories),
    }
}

/// A body and its numbers.
type Row = (u32, [f64; COLUMNS - 1]);

/// The bodies so far, of which the last gets more rows.
#[derive(Default)]
struct Bodies {
    trajectories: Vec<Trajectory>,
    numbers: HashSet<u32>,
}

impl Bodies {
    /// Adds a row to its body, which is the last or a new one.
    fn add(&mut self, (body, numbers): Row) -> Result<(), String> {
        match self.trajectories.last_mut() {
            Some(last) if last.body == body => {
                let before = last.poses.last().map_or(f64::NEG_INFINITY, |p| p.time);
                if numbers[0] <= before {
                    let time = numbers[0];
                    return Err(format!("its time, {time} s, is not after the row before"));
                }
                push(last, &numbers);
            }
            _ if !self.numbers.insert(body) => {
                return Err(format!("body {body} comes back after another's rows"));
            }
            _ => {
                let mut new = Trajectory {
                    body,
                    ..Trajectory::default()
                };
                push(&mut new, &numbers);
                self.trajectories.push(new);
            }
        }
        Ok(())
    }
}

fn push(trajectory: &mut Trajectory, numbers: &[f64; COLUMNS - 1]) {
    let [t, x, y, z, qx, qy, qz, qw, vx, vy, vz, wx, wy, wz] = *numbers;
    trajectory.poses.push(Pose {
        time: t,
        position: [x, y, z],
        orientation: [qx, qy, qz, qw],
    });
    trajectory.velocities.push([vx, vy, vz]);
    trajectory.angular_velocities.push([wx, wy, wz]);
}

fn row(line: &str) -> Result<Row, String> {
    let mut words = line.trim_end().split(',');
    let body = words.next().unwrap_or_default();
    let body = body
        .parse()
        .map_err(|_| format!("`{body}` is no number of a body"))?;
    let mut numbers = [0.0; COLUMNS - 1];
    for x in &mut numbers {
        let word = words
            .next()
            .ok_or_else(|| format!("it has fewer than {COLUMNS} columns"))?;
        *x = word
            .parse()
            .ok()
            .filter(|x: &f64| x.abs() <= FARTHEST)
            .ok_or_else(|| {
                format!("`{word}` is not a number between -{FARTHEST:e} and {FARTHEST:e}")
            })?;
    }
    if words.next().is_some() {
        return Err(format!("it has more than {COLUMNS} columns"));
    }
    let length = numbers[4..8].iter().map(|q| q * q).sum::<f64>().sqrt();
    if (length - 1.0).abs() > UNIT {
        return Err(format!(
            "its quaternion is {length} long and must be of unit length"
        ));
    }
    Ok((body, numbers))
}

#[cfg(test)]
mod tests;
