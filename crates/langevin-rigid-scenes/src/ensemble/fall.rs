//! The falls of an ensemble, in lanes.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::{Batch, NoiseStream, State};
use serde::{Deserialize, Serialize};

use super::lying::Lying;
use super::motion_class::MotionTracker;
use super::scatter::scattered_release;
use crate::advance::{advance, blown, is_carried};
use crate::prepared::{Prepared, Release};
use crate::scene::MAX_STEPS;

/// Positions are kept at whole multiples of a sixtieth of a second.
pub const SAMPLES_PER_SECOND: u32 = 60;

/// Steps of a batch between two looks at whether to go on.
const PATIENCE: u32 = 16;

/// Time between two runs in the wind of the scene (s): each meets other gusts.
pub(super) const APART: f64 = 3600.0;

/// Why a fall ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum FallEnding {
    /// The body touched the ground, or the floor of the tank.
    Ground,
    /// The time was up, or the steps were: [`MAX_STEPS`](crate::scene::MAX_STEPS).
    Time,
    /// A step failed, for this reason.
    Diverged(String),
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// How it came to rest, in a scene where it can.
    #[serde(default)]
    pub lying: Option<Lying>,
}

/// What all falls of an ensemble share.
pub(super) struct Setup<'a> {
    pub(super) prepared: &'a Prepared,
    pub(super) thin_axis: Vec3,
}

/// A fall under way.
pub(super) struct Falling {
    release: Release,
    motion: MotionTracker,
    samples: Vec<Vec3>,
}

impl Falling {
    pub(super) fn new(setup: &Setup<'_>, release: Release) -> Self {
        Self {
            motion: MotionTracker::new(setup.thin_axis, &release.state),
            samples: vec![setup.relative_to_release(release.state.position)],
            release,
        }
    }
}

/// What becomes of a run while it is carried.
enum Start {
    /// It is let go in this state.
    Free(Box<Falling>, State),
    /// It ended before.
    Over(Fall),
}

impl Setup<'_> {
    /// The falls of some runs, in their order; without those that were under way when it was cancelled. `done` hears of
    /// each that ended.
    pub(super) fn falls(
        &self,
        runs: &[u32],
        cancelled: &dyn Fn() -> bool,
        done: &dyn Fn(),
    ) -> Vec<Fall> {
        if let Some(surroundings) = self.prepared.surroundings() {
            let going = runs.iter().take_while(|_| !cancelled());
            return going
                .map(|run| {
                    let fall = self.fall_in_world(surroundings, *run);
                    done();
                    fall
                })
                .collect();
        }
        let mut ended = Vec::new();
        let mut end = |fall: Fall| {
            ended.push(fall);
            done();
        };
        let mut batch = Batch::<f64>::new(self.prepared.scene().seed);
        let mut falling = Vec::new();
        for &run in runs {
            match self.let_go(run) {
                Start::Free(fall, state) => {
                    batch.push_numbered(run, &state);
                    falling.push(*fall);
                }
                Start::Over(fall) => end(fall),
            }
        }
        let mut before = Vec::with_capacity(falling.len());
        let mut steps = 0u32;
        while !falling.is_empty() {
            if steps.is_multiple_of(PATIENCE) && cancelled() {
                break;
            }
            steps = steps.wrapping_add(1);
            before.clear();
            before.extend((0..falling.len()).filter_map(|place| batch.state(place)));
            self.step(&mut batch, &before, &mut falling, &mut end);
        }
        ended.sort_by_key(|fall| fall.run);
        ended
    }

    /// One step of all that fall from the states `before`, and the end of those whose last it is.
    fn step(
        &self,
        batch: &mut Batch,
        before: &[State],
        falling: &mut Vec<Falling>,
        end: &mut impl FnMut(Fall),
    ) {
        let (scene, stepper) = (self.prepared.scene(), self.prepared.stepper());
        let wind = self.prepared.wind();
        let stopped = stepper
            .step_batch_in(batch, scene.time_step, wind, APART)
            .err();
        let stopped = stopped.map_or_else(Vec::new, |error| error.bodies);
        // Backwards, as the last takes the place of one that leaves.
        for place in (0..falling.len()).rev() {
            let Some(mut state) = batch.state(place) else {
                continue;
            };
            let fall = &mut falling[place];
            let mut ending = None;
            if stopped.contains(&fall.release.noise.body) {
                let mut again = state;
                let later = APART * f64::from(fall.release.noise.body);
                let input = blown(self.prepared, &fall.release, &state, later);
                let error = stepper.step(&mut again, scene.time_step, &input).err();
                let words = error.map_or_else(String::new, |error| error.to_string());
                ending = Some(FallEnding::Diverged(words));
            } else {
                if let Some(tank) = &scene.tank {
                    tank.hold(fall.release.state.position, &mut state);
                    batch.set(place, &state);
                }
                self.follow(fall, &before[place], &state);
            }
            if let Some(ending) = ending.or_else(|| self.ending(&state)) {
                batch.swap_remove(place);
                end(self.ended(falling.swap_remove(place), &state, ending));
            }
        }
    }

    /// A run until it is let go: while it is carried it is in no batch.
    fn let_go(&self, run: u32) -> Start {
        let scene = self.prepared.scene();
        let release = Release {
            state: scattered_release(scene, run),
            noise: NoiseStream {
                seed: scene.seed,
                body: run,
            },
        };
        let mut state = release.state;
        let mut fall = Falling::new(self, release);
        loop {
            if let Some(ending) = self.ending(&state) {
                return Start::Over(self.ended(fall, &state, ending));
            }
            if !is_carried(scene, &state) {
                return Start::Free(Box::new(fall), state);
            }
            let before = state;
            if let Err(error) = advance(self.prepared, &release, &mut state) {
                let ending = FallEnding::Diverged(error.to_string());
                return Start::Over(self.ended(fall, &state, ending));
            }
            self.follow(&mut fall, &before, &state);
        }
    }

    pub(super) fn follow(&self, fall: &mut Falling, before: &State, after: &State) {
        fall.motion.follow(after);
        self.sample(before, after, &mut fall.samples);
    }

    pub(super) fn ended(&self, fall: Falling, state: &State, ending: FallEnding) -> Fall {
        Fall {
            run: fall.release.noise.body,
            ending,
            time: state.time,
            end: self.relative_to_release(state.position),
            samples: fall.samples,
            motion: fall.motion,
            lying: None,
        }
    }

    fn ending(&self, state: &State) -> Option<FallEnding> {
        let scene = self.prepared.scene();
        let stop = &scene.stop;
        // Half a step of slack: times are sums of steps.
        let late = |end| state.time > end - 0.5 * scene.time_step;
        let hull = self.prepared.hull();
        if stop.ground.is_some_and(|y| hull.touches(state, y)) {
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
        let slack = 1e-6 * self.prepared.scene().time_step;
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
    pub(super) fn relative_to_release(&self, position: Vec3) -> Vec3 {
        let origin = self.prepared.scene().release.position;
        [
            position[0] - origin[0],
            origin[1] - position[1],
            position[2] - origin[2],
        ]
    }
}
