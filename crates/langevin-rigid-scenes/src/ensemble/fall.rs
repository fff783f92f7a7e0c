//! One fall of an ensemble.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::{Hull, NoiseStream, State, StepError, Stepper};

use super::motion::MotionTracker;
use super::scatter::scattered_release;
use crate::advance::advance;
use crate::scene::{MAX_STEPS, Scene};

/// Positions are kept at whole multiples of a sixtieth of a second.
pub const SAMPLES_PER_SECOND: u32 = 60;

/// Steps between two looks at whether to go on.
const PATIENCE: u64 = 256;

/// Why a fall ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FallEnding {
    /// The body touched the ground, or the floor of the tank.
    Ground,
    /// The time was up, or the steps were: [`MAX_STEPS`](crate::scene::MAX_STEPS).
    Time,
    /// A step failed.
    Diverged(StepError),
}

impl FallEnding {
    /// Its name in tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Ground => "ground",
            Self::Time => "time",
            Self::Diverged(_) => "diverged",
        }
    }
}

/// A fall, from release to ending.
#[derive(Debug, Clone, PartialEq)]
pub struct Fall {
    /// Number of the run.
    pub run: u32,
    /// Why it ended.
    pub ending: FallEnding,
    /// Duration (s).
    pub time: f64,
    /// Where the centre of mass ended, from the scene's release point: x, depth (downwards), z (m).
    pub end: Vec3,
    /// Where the centre of mass was at 0, 1/60 s, 2/60 s, ..., in the coordinates of `end` (m).
    pub samples: Vec<Vec3>,
    /// How the body swung and turned over.
    pub motion: MotionTracker,
}

/// What all falls of an ensemble share.
pub(super) struct Setup<'a> {
    pub(super) scene: &'a Scene,
    pub(super) stepper: &'a Stepper,
    pub(super) hull: Hull,
    pub(super) thin_axis: Vec3,
}

impl Setup<'_> {
    /// The fall of one run; none if it was cancelled.
    pub(super) fn fall(&self, run: u32, cancelled: &dyn Fn() -> bool) -> Option<Fall> {
        let noise = NoiseStream {
            seed: self.scene.seed,
            body: run,
        };
        let mut state = scattered_release(self.scene, run);
        let mut motion = MotionTracker::new(self.thin_axis, &state);
        let mut samples = vec![self.relative_to_release(state.position)];
        let ending = loop {
            if let Some(ending) = self.ending(&state) {
                break ending;
            }
            if state.step.is_multiple_of(PATIENCE) && cancelled() {
                return None;
            }
            let before = state;
            match advance(self.scene, self.stepper, &mut state, &noise) {
                Ok(()) => {}
                Err(error) => break FallEnding::Diverged(error),
            }
            motion.follow(&state);
            self.sample(&before, &state, &mut samples);
        };
        Some(Fall {
            run,
            ending,
            time: state.time,
            end: self.relative_to_release(state.position),
            samples,
            motion,
        })
    }

    fn ending(&self, state: &State) -> Option<FallEnding> {
        let stop = &self.scene.stop;
        // Half a step of slack: times are sums of steps.
        let late = |end| state.time > end - 0.5 * self.scene.time_step;
        if stop.ground.is_some_and(|y| self.hull.touches(state, y)) {
            Some(FallEnding::Ground)
        } else if stop.time.is_some_and(late) || state.step >= MAX_STEPS {
            Some(FallEnding::Time)
        } else {
            None
        }
    }

    /// Adds the positions due between two states, on the line between them.
    fn sample(&self, before: &State, after: &State, samples: &mut Vec<Vec3>) {
        let (from, to) = (
            self.relative_to_release(before.position),
            self.relative_to_release(after.position),
        );
        let slack = 1e-6 * self.scene.time_step;
        loop {
            let due = samples.len() as f64 / f64::from(SAMPLES_PER_SECOND);
            if due > after.time + slack {
                return;
            }
            let part = ((due - before.time) / (after.time - before.time)).min(1.0);
            samples.push(std::array::from_fn(|i| from[i] + part * (to[i] - from[i])));
        }
    }

    /// x, depth and z from the scene's release point.
    fn relative_to_release(&self, position: Vec3) -> Vec3 {
        let origin = self.scene.release.position;
        [
            position[0] - origin[0],
            origin[1] - position[1],
            position[2] - origin[2],
        ]
    }
}
