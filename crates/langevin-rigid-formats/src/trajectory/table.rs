//! Trajectories as comma-separated values.

use std::fmt::Write as _;
use std::io;

use rayon::prelude::*;

use super::Trajectory;
use crate::motion::Pose;

/// The columns of a trajectory table: world frame; metres, seconds, radians.
pub const CSV_HEADER: &str = "body,t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";

const COLUMNS: usize = 15;

/// Bodies that are put into words at a time: on all cores, and never all in memory.
const BATCH: usize = 32;

/// Why a table is no trajectory.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The first line is another.
    #[error("line 1: the columns are not those of a trajectory ({CSV_HEADER})")]
    Header,
    /// A line cannot be read.
    #[error("line {line}: {reason}; the table is damaged or was edited, run the scene again")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
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
pub fn write_csv(trajectories: &[Trajectory], out: &mut dyn io::Write) -> io::Result<()> {
    writeln!(out, "{CSV_HEADER}")?;
    for batch in trajectories.chunks(BATCH) {
        let rows: Vec<String> = batch.par_iter().map(rows).collect();
        rows.iter()
            .try_for_each(|rows| out.write_all(rows.as_bytes()))?;
    }
    Ok(())
}

/// The whole table of one body, as [`write_csv`] writes it.
pub fn csv(trajectory: &Trajectory) -> String {
    format!("{CSV_HEADER}\n{}", rows(trajectory))
}

fn rows(trajectory: &Trajectory) -> String {
    let mut rows = String::with_capacity(220 * trajectory.len());
    let velocities = trajectory
        .velocities
        .iter()
        .zip(&trajectory.angular_velocities);
    for (pose, (v, w)) in trajectory.poses.iter().zip(velocities) {
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

/// Reads what [`write_csv`] wrote: the rows of a body stand together.
///
/// # Errors
/// [`TableError`] with the line.
pub fn read_csv(table: &str) -> Result<Vec<Trajectory>, TableError> {
    let (header, lines) = table.split_once('\n').unwrap_or((table, ""));
    if header.trim_end() != CSV_HEADER {
        return Err(TableError::Header);
    }
    let rows: Vec<Result<Row, String>> = lines.par_lines().map(row).collect();
    let mut trajectories: Vec<Trajectory> = Vec::new();
    for (line, row) in (2..).zip(rows) {
        row.and_then(|row| add(&mut trajectories, row))
            .map_err(|reason| TableError::Line { line, reason })?;
    }
    if trajectories.is_empty() {
        return Err(TableError::Empty);
    }
    Ok(trajectories)
}

/// A body and its numbers.
type Row = (u32, [f64; COLUMNS - 1]);

/// Adds a row to its body, which is the last or a new one.
fn add(trajectories: &mut Vec<Trajectory>, (body, numbers): Row) -> Result<(), String> {
    let known = trajectories.iter().rposition(|t| t.body == body);
    match known {
        Some(place) if place + 1 < trajectories.len() => {
            return Err(format!("body {body} comes back after another's rows"));
        }
        Some(_) => {}
        None => trajectories.push(Trajectory {
            body,
            ..Trajectory::default()
        }),
    }
    if let Some(last) = trajectories.last_mut() {
        push(last, &numbers);
    }
    Ok(())
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
            .map_err(|_| format!("`{word}` is not a number"))?;
    }
    match words.next() {
        None => Ok((body, numbers)),
        Some(_) => Err(format!("it has more than {COLUMNS} columns")),
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::State;

    use super::*;

    fn two_bodies() -> Vec<Trajectory> {
        let state = |time: f64, k: f64| State {
            time,
            position: [0.1 * k, -time / 3.0, 1e-9],
            velocity: [k, -0.3, 1.0 / 7.0],
            angular_velocity: [0.0, 1e10, k],
            ..State::default()
        };
        vec![
            Trajectory::new(0, &[state(0.0, 1.0), state(0.1, 1.0)]),
            Trajectory::new(7, &[state(0.0, 2.0)]),
        ]
    }

    fn table() -> String {
        let mut out = Vec::new();
        write_csv(&two_bodies(), &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn tables_read_back_to_the_last_bit() {
        assert_eq!(read_csv(&table()).unwrap(), two_bodies());
        assert_eq!(
            read_csv(&table().replace('\n', "\r\n")).unwrap(),
            two_bodies()
        );
    }

    #[test]
    fn damage_is_named_with_its_line() {
        let fails = |table: &str| read_csv(table).unwrap_err().to_string();
        assert!(fails("time,x\n").starts_with("line 1: the columns"));
        assert!(fails(&format!("{CSV_HEADER}\n")).contains("no rows"));
        let cut = table();
        let cut = &cut[..cut.len() - 5];
        assert!(fails(&cut[..cut.rfind(',').unwrap()]).starts_with("line 4: it has fewer"));
        let odd = table().replacen("\n0,0.1,", "\n0,zero,", 1);
        assert!(fails(&odd).starts_with("line 3: `zero` is not a number"));
        let again = table() + table().lines().nth(1).unwrap();
        assert!(fails(&again).starts_with("line 5: body 0 comes back"));
    }
}
