//! The falls of the plates, those of one point of the map side by side in lanes.

use std::sync::atomic::{AtomicUsize, Ordering};

use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::{Batch, Body, Input, SetupError, State, Stepper};
use langevin_rigid_bake::progress::Progress;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::plates::{Plate, broadside_speed, stepper};
use crate::ensemble::MotionTracker;

/// Steps in the time d/U.
const STEPS: f64 = 40.0;
/// A fall lasts so many times d/U, and the same again in units of the distance m / (rho P_yy) over
/// which a plate takes up speed: heavy ones are slow to settle.
const FALL: [f64; 2] = [400.0, 40.0];
/// Steps between two looks at whether to go on.
const PATIENCE: u64 = 4096;

/// One release.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// What falls.
    pub plate: Plate,
    /// Reynolds number on diameter or chord and the speed of a broadside fall.
    pub reynolds: f64,
    /// I*.
    pub inertia_ratio: f64,
    /// Tilt of the release from level, about the z axis, degrees.
    pub tilt: f64,
}

/// What became of a release.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The release.
    pub case: Case,
    /// How it fell over the second half of its time; where a step failed, why.
    pub motion: Result<MotionTracker, String>,
}

impl Case {
    /// The body that falls.
    pub fn body(&self) -> Body {
        let thickness = self.plate.thickness_at(self.inertia_ratio);
        self.plate.body(self.inertia_ratio, thickness)
    }

    /// The states of the second half of the fall, up to `lengths` diameters of path from the middle.
    ///
    /// # Errors
    /// [`SetupError`] for a plate that cannot fall.
    pub fn path(&self, lengths: f64) -> Result<Vec<State>, SetupError> {
        let mut states: Vec<State> = Vec::new();
        let mut travelled = 0.0;
        let follow = |_, state: &State| {
            if let Some(last) = states.last() {
                let step = |i: usize| (state.position[i] - last.position[i]).powi(2);
                travelled += (step(0) + step(1) + step(2)).sqrt();
            }
            if travelled <= lengths {
                states.push(*state);
            }
        };
        Falls::of(self)?.all(&[self.tilt], follow, &|| false);
        Ok(states)
    }

    /// Whether it differs from another release in its tilt at most.
    pub(super) fn is_of_one_point(&self, other: &Self) -> bool {
        let point = |case: &Self| (case.plate, case.reynolds, case.inertia_ratio);
        point(self) == point(other)
    }
}

/// What all falls at one point of the map share.
struct Falls {
    stepper: Stepper,
    time_step: f64,
    /// Steps in half the time.
    half: u64,
}

impl Falls {
    fn of(case: &Case) -> Result<Self, SetupError> {
        let body = case.body();
        let speed = broadside_speed(&body, case.reynolds);
        let starting = body.mass / body.separation.drag_area[1][1];
        Ok(Self {
            stepper: stepper(&body, speed / case.reynolds)?,
            time_step: 1.0 / (STEPS * speed),
            half: (0.5 * STEPS * (FALL[0] + FALL[1] * starting)) as u64,
        })
    }

    /// Drops the plate from every tilt; `follow` gets the place of the tilt and every state of the second half of its
    /// fall. For each tilt why its fall ended early, if it did; none if cancelled.
    fn all(
        &self,
        tilts: &[f64],
        mut follow: impl FnMut(usize, &State),
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<Result<(), String>>> {
        let mut batch = Batch::<f64>::new(0);
        for tilt in tilts {
            batch.push(&State {
                orientation: quat_from_rotation_vector([0.0, 0.0, tilt.to_radians()]),
                ..State::default()
            });
        }
        let mut ended = vec![Ok(()); tilts.len()];
        let mut falling: Vec<usize> = (0..tilts.len()).collect();
        for step in 0..2 * self.half {
            if step % PATIENCE == 0 && cancelled() {
                return None;
            }
            if let Err(error) = self.stepper.step_batch(&mut batch, self.time_step) {
                // Backwards, as the last takes the place of one that leaves.
                for place in (0..falling.len()).rev() {
                    if error.bodies.contains(&(falling[place] as u32)) {
                        ended[falling.swap_remove(place)] = self.why_not(batch.swap_remove(place));
                    }
                }
            }
            if step >= self.half {
                for (place, &tilt) in falling.iter().enumerate() {
                    batch.state(place).iter().for_each(|s| follow(tilt, s));
                }
            }
        }
        Some(ended)
    }

    /// Why the step from this state failed.
    fn why_not(&self, state: Option<State>) -> Result<(), String> {
        let step = |mut state| {
            self.stepper
                .step(&mut state, self.time_step, &Input::default())
        };
        state
            .map_or(Ok(()), step)
            .map_err(|error| error.to_string())
    }

    /// The runs of cases of this point, in their order; none if cancelled.
    fn runs(&self, cases: &[Case], cancelled: &dyn Fn() -> bool) -> Vec<Run> {
        let tilts: Vec<f64> = cases.iter().map(|case| case.tilt).collect();
        let mut trackers: Vec<Option<MotionTracker>> = vec![None; cases.len()];
        let follow = |tilt: usize, state: &State| match &mut trackers[tilt] {
            Some(tracker) => tracker.follow(state),
            none => *none = Some(MotionTracker::new([0.0, 1.0, 0.0], state)),
        };
        let Some(ended) = self.all(&tilts, follow, cancelled) else {
            return Vec::new();
        };
        let runs = cases.iter().zip(ended).zip(trackers);
        let run = |((case, ended), tracker): ((&Case, Result<(), String>), _)| {
            let motion = match ended {
                Ok(()) => Ok(tracker?),
                Err(words) => Err(words),
            };
            Some(Run {
                case: *case,
                motion,
            })
        };
        runs.filter_map(run).collect()
    }
}

/// Runs every case, on all cores and in lanes, with the model `separated` and no turbulence.
///
/// The runs come in the order of the cases, with the same bits on any number of threads and however the cases are shared
/// among processes: each may run a part of the slice, and hand on its runs by `serde`. It takes least time where the
/// cases of one point are together. Of work that `progress` cancels, the runs that are complete are given.
///
/// ```
/// use langevin_rigid_scenes::regimes::{TILTS, cases, points, run};
/// let cases = cases(2, 2);
/// let last = cases.len() - TILTS.len();
/// let runs = run(&cases[last..], &())?; // the strip of largest I* and Re
/// assert_eq!(points(&runs).len(), 1);
/// # Ok::<(), langevin_rigid::SetupError>(())
/// ```
///
/// # Errors
/// [`SetupError`] of the first plate that cannot fall.
pub fn run(cases: &[Case], progress: &dyn Progress) -> Result<Vec<Run>, SetupError> {
    let done = AtomicUsize::new(0);
    let points: Vec<&[Case]> = cases.chunk_by(Case::is_of_one_point).collect();
    let runs: Vec<Vec<Run>> = points
        .into_par_iter()
        .with_max_len(1)
        .map(|point| {
            let runs = Falls::of(&point[0])?.runs(point, &|| progress.cancelled());
            let done = done.fetch_add(point.len(), Ordering::Relaxed) + point.len();
            progress.report("dropping", done as f64 / cases.len() as f64);
            Ok(runs)
        })
        .collect::<Result<_, SetupError>>()?;
    Ok(runs.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::super::survey::{TILTS, cases};
    use super::*;

    /// The fall of one body by itself.
    fn alone(case: &Case) -> MotionTracker {
        let falls = Falls::of(case).unwrap();
        let mut state = State {
            orientation: quat_from_rotation_vector([0.0, 0.0, case.tilt.to_radians()]),
            ..State::default()
        };
        let mut tracker: Option<MotionTracker> = None;
        for step in 0..2 * falls.half {
            let input = Input::default();
            falls
                .stepper
                .step(&mut state, falls.time_step, &input)
                .unwrap();
            if step >= falls.half {
                match &mut tracker {
                    Some(tracker) => tracker.follow(&state),
                    None => tracker = Some(MotionTracker::new([0.0, 1.0, 0.0], &state)),
                }
            }
        }
        tracker.unwrap()
    }

    #[test]
    fn plates_fall_side_by_side_as_they_do_alone() {
        let cases = cases(2, 2);
        let runs = run(&cases, &()).unwrap();
        assert_eq!(runs.len(), cases.len());
        for (run, case) in runs.iter().zip(&cases) {
            assert_eq!(run.case, *case);
            assert_eq!(run.motion, Ok(alone(case)));
        }
        // Shared out, through the middle of a point.
        let (one, other) = cases.split_at(TILTS.len() + 1);
        let shared = [one, other].map(|part| run(part, &()).unwrap());
        assert_eq!(shared.concat(), runs);
    }

    #[test]
    fn a_fall_that_fails_leaves_the_others_as_they_are() {
        let case = cases(2, 2)[0];
        let falls = Falls::of(&case).unwrap();
        let wrong = Case {
            tilt: f64::NAN,
            ..case
        };
        let alone = falls.runs(&[case], &|| false);
        let beside = falls.runs(&[wrong, case], &|| false);
        assert!(
            beside[0]
                .motion
                .as_ref()
                .is_err_and(|words| !words.is_empty())
        );
        assert_eq!(beside[1..], alone);
    }
}
