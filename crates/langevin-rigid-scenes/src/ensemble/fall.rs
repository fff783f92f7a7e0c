//! The falls of an ensemble.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::{NoiseStream, State};
use serde::{Deserialize, Serialize};

use super::lying::{Lying, fall_in_world};
use super::motion_class::MotionTracker;
use super::scatter::scattered_release;
use crate::lanes::{Lanes, Task, Watch};
use crate::prepared::{Prepared, Release};
use crate::scene::Scene;

/// Positions are kept at whole multiples of a sixtieth of a second.
pub const SAMPLES_PER_SECOND: u32 = 60;

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
    /// The body came to rest without the ground: on an obstacle, or afloat.
    Rest,
    /// A step failed, for this reason.
    Diverged(String),
}

impl FallEnding {
    /// Its name in tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Ground => "ground",
            Self::Time => "time",
            Self::Rest => "rest",
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

/// The falls of some runs, in their order; without those that were under way when it was cancelled. `done` hears of each
/// that ended.
pub(super) fn falls(
    prepared: &Prepared,
    thin_axis: Vec3,
    runs: &[u32],
    cancelled: &dyn Fn() -> bool,
    done: &dyn Fn(),
) -> Vec<Fall> {
    if let Some(surroundings) = prepared.surroundings() {
        let going = runs.iter().take_while(|_| !cancelled());
        return going
            .map(|run| {
                let fall = fall_in_world(prepared, surroundings, thin_axis, *run);
                done();
                fall
            })
            .collect();
    }
    let scene = prepared.scene();
    let origin = scene.release.position;
    let tasks = runs.iter().map(|&run| {
        let release = Release {
            state: scattered_release(scene, run),
            noise: NoiseStream {
                seed: scene.seed,
                body: run,
            },
        };
        Task {
            release,
            steering: None,
            watch: Watched::new(scene, thin_axis, &release.state),
        }
    });
    let lanes = Lanes {
        prepared,
        apart: APART,
    };
    let falls = lanes.falls(tasks, cancelled, done).into_iter();
    let falls = falls.map(|fall| Fall {
        run: fall.release.noise.body,
        ending: fall.ending,
        time: fall.last.time,
        end: relative(fall.last.position, origin),
        samples: fall.watch.samples,
        motion: fall.watch.motion,
        lying: None,
    });
    falls.collect()
}

/// What is kept of a fall under way.
pub(super) struct Watched {
    pub(super) motion: MotionTracker,
    pub(super) samples: Vec<Vec3>,
    slack: f64,
    origin: Vec3,
}

impl Watch for Watched {
    fn see(&mut self, before: &State, after: &State) {
        self.motion.follow(after);
        self.sample(before, after);
    }
}

impl Watched {
    pub(super) fn new(scene: &Scene, thin_axis: Vec3, release: &State) -> Self {
        let origin = scene.release.position;
        Self {
            motion: MotionTracker::new(thin_axis, release),
            samples: vec![relative(release.position, origin)],
            slack: 1e-6 * scene.time_step,
            origin,
        }
    }

    /// Adds the positions due between two states, on the line between them.
    fn sample(&mut self, before: &State, after: &State) {
        let (from, to) = (
            relative(before.position, self.origin),
            relative(after.position, self.origin),
        );
        loop {
            let due = self.samples.len() as f64 / f64::from(SAMPLES_PER_SECOND);
            if due > after.time + self.slack {
                return;
            }
            let part = ((due - before.time) / (after.time - before.time)).min(1.0);
            let at = std::array::from_fn(|i| from[i] + part * (to[i] - from[i]));
            self.samples.push(at);
        }
    }
}

/// x, depth and z from the scene's release point.
pub(super) fn relative(position: Vec3, origin: Vec3) -> Vec3 {
    [
        position[0] - origin[0],
        origin[1] - position[1],
        position[2] - origin[2],
    ]
}
