//! The grid of plates, and what the falls at each of its points have in common.

use std::fmt::Write;

use serde::Serialize;

use super::fall::{Case, Run};
use super::plates::Plate;
use super::published::Published;
use crate::ensemble::{MotionClass, MotionTracker};

/// Tilts of the release from level, degrees.
pub const TILTS: [f64; 3] = [5.0, 15.0, 40.0];
/// Range of Re.
pub const REYNOLDS: [f64; 2] = [30.0, 30_000.0];

/// Range of I* in the map: from little heavier than water to well into tumbling.
pub fn inertia_ratios(plate: Plate) -> [f64; 2] {
    match plate {
        Plate::Disc => [0.002, 1.0],
        Plate::Strip => [0.05, 20.0],
    }
}

/// `count` values from the first to the second, each the same factor above the one before.
fn spaced([low, high]: [f64; 2], count: u32) -> impl Iterator<Item = f64> {
    let step = libm::log(high / low) / f64::from(count - 1);
    (0..count).map(move |k| low * libm::exp(step * f64::from(k)))
}

/// Every release of a grid of so many values of I* and Re, both at least two.
pub fn cases(inertia_ratio_count: u32, reynolds_count: u32) -> Vec<Case> {
    let mut cases = Vec::new();
    for plate in Plate::ALL {
        for reynolds in spaced(REYNOLDS, reynolds_count.max(2)) {
            for inertia_ratio in spaced(inertia_ratios(plate), inertia_ratio_count.max(2)) {
                cases.extend(TILTS.map(|tilt| Case {
                    plate,
                    reynolds,
                    inertia_ratio,
                    tilt,
                }));
            }
        }
    }
    cases
}

/// The runs as a table, a row a run.
pub fn csv(runs: &[Run]) -> String {
    let mut table = String::from("plate,re,inertia_ratio,tilt,motion,turnovers,swings\n");
    for Run { case, motion } in runs {
        let (plate, re, ratio, tilt) = (
            case.plate.name(),
            case.reynolds,
            case.inertia_ratio,
            case.tilt,
        );
        // Writing to a string cannot fail.
        let _ = match motion {
            Ok(m) => writeln!(
                table,
                "{plate},{re},{ratio},{tilt},{},{},{}",
                m.motion().name(),
                m.turnovers(),
                m.swings()
            ),
            Err(_) => writeln!(table, "{plate},{re},{ratio},{tilt},diverged,,"),
        };
    }
    table
}

/// A point of the grid: what its releases did, and what was published.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// What falls.
    pub plate: Plate,
    /// Reynolds number.
    pub re: f64,
    /// I*.
    pub inertia_ratio: f64,
    /// The motion from each tilt of [`TILTS`].
    pub motions: [MotionClass; TILTS.len()],
    /// What most of them are; where no two agree, the most disordered.
    pub regime: MotionClass,
    /// What experiments found.
    pub published: MotionClass,
    /// Whether the point is far enough from the published boundaries to be compared.
    pub compared: bool,
    /// Whether both regimes are the same.
    pub agrees: bool,
}

impl Point {
    fn new(case: &Case, motions: [MotionClass; TILTS.len()]) -> Self {
        let published = Published::of(case.plate);
        let expected = published.regime(case.reynolds, case.inertia_ratio);
        let regime = majority(&motions);
        Self {
            plate: case.plate,
            re: case.reynolds,
            inertia_ratio: case.inertia_ratio,
            motions,
            regime,
            published: expected,
            compared: published.certain(case.reynolds, case.inertia_ratio),
            agrees: regime == expected,
        }
    }
}

/// The most frequent motion; of equally frequent ones the most disordered, which `MotionClass` sorts last.
fn majority(motions: &[MotionClass]) -> MotionClass {
    let count = |m: &MotionClass| motions.iter().filter(|n| *n == m).count();
    let best = MotionClass::ALL.into_iter().max_by_key(|m| (count(m), *m));
    best.unwrap_or(MotionClass::Chaotic)
}

/// The points of the grid all of whose releases came to an end.
pub fn points(runs: &[Run]) -> Vec<Point> {
    let point = |runs: &[Run]| {
        let motions: Vec<MotionClass> = runs
            .iter()
            .filter_map(|r| r.motion.as_ref().ok().map(MotionTracker::motion))
            .collect();
        let motions = <[MotionClass; TILTS.len()]>::try_from(motions).ok()?;
        Some(Point::new(&runs[0].case, motions))
    };
    runs.chunk_by(|a, b| a.case.is_of_one_point(&b.case))
        .filter_map(point)
        .collect()
}

/// How many of the compared points have the published regime.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Agreement {
    /// Points far enough from a published boundary.
    pub compared: usize,
    /// Those among them that agree.
    pub agreeing: usize,
    /// Their share; none where nothing is compared.
    pub agreement: Option<f64>,
}

impl Agreement {
    /// Over these points.
    pub fn of<'a>(points: impl Iterator<Item = &'a Point>) -> Self {
        let (mut compared, mut agreeing) = (0, 0);
        for point in points.filter(|p| p.compared) {
            compared += 1;
            agreeing += usize::from(point.agrees);
        }
        Self {
            compared,
            agreeing,
            agreement: (compared > 0).then(|| agreeing as f64 / compared as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::State;

    use super::*;

    #[test]
    fn the_majority_decides_and_disorder_where_there_is_none() {
        use MotionClass::{Chaotic, Flutter, Steady, Tumble};
        assert_eq!(majority(&[Steady, Tumble, Steady]), Steady);
        assert_eq!(majority(&[Steady, Tumble, Flutter]), Tumble);
        assert_eq!(majority(&[Chaotic, Steady, Flutter]), Chaotic);
    }

    #[test]
    fn the_grid_reaches_from_end_to_end() {
        let cases = cases(10, 6);
        assert_eq!(cases.len(), 2 * 10 * 6 * TILTS.len());
        let last = cases[cases.len() - 1];
        assert!((last.reynolds / 30_000.0 - 1.0).abs() < 1e-12);
        assert!((last.inertia_ratio / 20.0 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_point_without_all_its_runs_is_none() {
        let case = cases(2, 2)[0];
        let run = |tilt: f64| Run {
            case: Case { tilt, ..case },
            motion: Ok(MotionTracker::new([0.0, 1.0, 0.0], &State::default())),
        };
        let runs: Vec<Run> = TILTS.into_iter().map(run).collect();
        assert_eq!(points(&runs).len(), 1);
        assert!(points(&runs[..2]).is_empty());
    }
}
