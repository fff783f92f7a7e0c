//! A path that was drawn, and how far a fall is from it.

use std::io::Read;
use std::path::PathBuf;

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, dot, norm, scale, sub};
use langevin_rigid_formats::files;

use super::glimpses::{Glimpse, position_at};
use crate::scene::Path;

/// Why a drawn path cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawnPathError {
    /// It cannot be read.
    #[error("cannot read the path `{}`: {error}", .file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// It is too long.
    #[error("the path `{}` is longer than 1 MiB: draw it with fewer points", .0.display())]
    TooLong(PathBuf),
    /// A line of it is no point.
    #[error(
        "{}:{line}: not a point of the path: give `x,y,z` (m), or `x,y,z,t` with times (s) that grow, the same for \
         all, within 1e9", .file.display()
    )]
    Point {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
    },
    /// It has no two points.
    #[error("the path `{}` has fewer than two points", .0.display())]
    TooShort(PathBuf),
}

/// A drawn path, read.
pub(super) struct DrawnPath {
    points: Vec<Vec3>,
    /// Of each point (s); none if they have none.
    times: Vec<f64>,
    within: f64,
}

/// The longest file of a path (bytes).
const LONGEST: u64 = 1 << 20;
/// Coordinates are within this.
const FARTHEST: f64 = 1e9;

impl DrawnPath {
    pub(super) fn read(path: &Path) -> Result<Self, DrawnPathError> {
        let read = || -> std::io::Result<Option<String>> {
            let mut text = String::new();
            let file = files::open(&path.file)?;
            file.take(LONGEST + 1).read_to_string(&mut text)?;
            Ok((text.len() as u64 <= LONGEST).then_some(text))
        };
        let file = || path.file.clone();
        let text = read().map_err(|error| DrawnPathError::Read {
            file: file(),
            error,
        })?;
        let text = text.ok_or_else(|| DrawnPathError::TooLong(file()))?;
        Self::parse(&text, path.within)
            .map_err(|line| DrawnPathError::Point { file: file(), line })?
            .ok_or_else(|| DrawnPathError::TooShort(file()))
    }

    /// None of fewer than two points. A first line of words is a heading.
    ///
    /// # Errors
    /// The line that is no point.
    fn parse(text: &str, within: f64) -> Result<Option<Self>, usize> {
        let mut drawn = Self {
            points: Vec::new(),
            times: Vec::new(),
            within,
        };
        for (number, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let values: Result<Vec<f64>, _> = line.split(',').map(|x| x.trim().parse()).collect();
            match values {
                Err(_) if number == 0 => {}
                Err(_) => return Err(number + 1),
                Ok(values) => drawn.push(&values).ok_or(number + 1)?,
            }
        }
        Ok((drawn.points.len() > 1).then_some(drawn))
    }

    fn push(&mut self, values: &[f64]) -> Option<()> {
        if !values.iter().all(|x| x.abs() <= FARTHEST) {
            return None;
        }
        let timed = self.times.len() == self.points.len();
        match *values {
            [x, y, z] if self.times.is_empty() => self.points.push([x, y, z]),
            [x, y, z, t] if timed && self.times.last().is_none_or(|last| *last < t) => {
                self.points.push([x, y, z]);
                self.times.push(t);
            }
            _ => return None,
        }
        Some(())
    }

    /// Root mean square distance in units of the tolerance: at the times of the points if they have times; else from each
    /// point to the path of the fall and back.
    pub(super) fn miss(&self, seen: &[Glimpse]) -> f64 {
        let path: Vec<Vec3> = seen.iter().map(|glimpse| glimpse.position).collect();
        let squares: Vec<f64> = if self.times.is_empty() {
            let there = self.points.iter().map(|point| away(*point, &path));
            let back = path.iter().map(|point| away(*point, &self.points));
            there.chain(back).map(|d| d * d).collect()
        } else {
            let timed = self.points.iter().zip(&self.times);
            let away = timed.map(|(point, time)| norm(sub(*point, position_at(seen, *time))));
            away.map(|d| d * d).collect()
        };
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / self.within
    }
}

/// Distance of a point from a line through points.
fn away(point: Vec3, line: &[Vec3]) -> f64 {
    let nearest = line.windows(2).map(|ends| {
        let (along, to) = (sub(ends[1], ends[0]), sub(point, ends[0]));
        let length = dot(along, along);
        let part = match length > 0.0 {
            true => (dot(to, along) / length).clamp(0.0, 1.0),
            false => 0.0,
        };
        norm(sub(point, add(ends[0], scale(part, along))))
    });
    let alone = line
        .first()
        .map_or(f64::INFINITY, |end| norm(sub(point, *end)));
    nearest.fold(alone, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(points: &[Vec3]) -> Vec<Glimpse> {
        let glimpse = |(number, position): (usize, &Vec3)| Glimpse {
            time: number as f64,
            position: *position,
            axis: [0.0, 1.0, 0.0],
            heading: 0.0,
        };
        points.iter().enumerate().map(glimpse).collect()
    }

    #[test]
    fn distances_are_from_the_line_or_at_the_times() {
        let fall = seen(&[[0.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]);
        let beside = DrawnPath::parse("x,y,z\n0.1,2,0\n0.1,0,0\n", 0.1)
            .unwrap()
            .unwrap();
        assert!((beside.miss(&fall) - 1.0).abs() < 1e-12);
        let timed = DrawnPath::parse("0,2,0,0\n0,1.4,0,0.5\n0,0,0,9\n", 0.1)
            .unwrap()
            .unwrap();
        // Off by 0.1 m at one point of three.
        assert!((timed.miss(&fall) - (1.0 / 3.0f64).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_path_is_told_with_its_line() {
        for (text, line) in [
            ("0,0\n", 1),
            ("0,0,0\n1,1\n", 2),
            ("0,0,0\nx,y,z\n", 2),
            ("0,0,0,1\n0,0,0,1\n", 2),
            ("0,0,0\n0,0,0,1\n", 2),
            ("0,0,nan\n", 1),
            ("\n0,0,1e10\n", 2),
        ] {
            assert_eq!(DrawnPath::parse(text, 1.0).err(), Some(line), "{text}");
        }
        assert!(DrawnPath::parse("x,y,z\n0,0,0\n", 1.0).unwrap().is_none());
    }
}
