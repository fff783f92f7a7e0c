//! The falls of an ensemble.

use langevin_rigid::linalg::{Vec3, rotate};
use langevin_rigid::{NoiseStream, State};
use serde::{Deserialize, Serialize};

use super::draw::{Change, Draw, draw};
use super::lying::{Lying, fall_in_world};
use super::motion_class::MotionTracker;
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
    /// What it began with.
    pub draw: Draw,
    /// Why it ended.
    pub ending: FallEnding,
    /// Duration (s).
    pub time: f64,
    /// Where the centre of mass ended, from the scene's release point: x, depth (downwards), z (m).
    pub end: Vec3,
    /// Velocity of the centre of mass then, world frame (m/s).
    pub velocity: Vec3,
    /// Angular velocity then, world frame (rad/s).
    pub angular_velocity: Vec3,
    /// The world's up in its thin axis then: 1 face up, -1 face down, 0 on its edge.
    pub up: f64,
    /// Where the centre of mass was at 0, 1/60 s, 2/60 s, ..., in the coordinates of `end` (m).
    pub samples: Vec<Vec3>,
    /// How the body swung and turned over.
    pub motion: MotionTracker,
    /// How it came to rest, in a scene where it can.
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
    let scene = prepared.scene();
    let draws = runs.iter().map(|&run| {
        let draw = draw(scene, prepared.body().mass, run);
        Drawn { run, draw }
    });
    let mut falls = Vec::with_capacity(runs.len());
    for (change, alike) in alike(draws) {
        if cancelled() {
            break;
        }
        let changed = change.map(|change| prepared.changed(&change)).transpose();
        let around = Around {
            thin_axis,
            cancelled,
            done,
        };
        match changed {
            Ok(changed) => falls.extend(around.alike(changed.as_ref().unwrap_or(prepared), &alike)),
            Err(error) => falls.extend(alike.iter().map(|drawn| {
                done();
                drawn.without_a_fall(scene, thin_axis, &error.to_string())
            })),
        }
    }
    falls.sort_by_key(|fall| fall.run);
    falls
}

/// A run and what it begins with.
#[derive(Clone, Copy)]
pub(super) struct Drawn {
    pub(super) run: u32,
    pub(super) draw: Draw,
}

/// Those of the same body and fluid together: they fall in lanes.
fn alike(draws: impl Iterator<Item = Drawn>) -> Vec<(Option<Change>, Vec<Drawn>)> {
    let mut groups: Vec<(Option<Change>, Vec<Drawn>)> = Vec::new();
    for drawn in draws {
        let change = drawn.draw.change;
        match groups.iter_mut().find(|(of, _)| *of == change) {
            Some((_, group)) => group.push(drawn),
            None => groups.push((change, vec![drawn])),
        }
    }
    groups
}

/// What falls of one body in one fluid share.
struct Around<'a> {
    thin_axis: Vec3,
    cancelled: &'a dyn Fn() -> bool,
    done: &'a dyn Fn(),
}

impl Around<'_> {
    fn alike(&self, prepared: &Prepared, draws: &[Drawn]) -> Vec<Fall> {
        if let Some(surroundings) = prepared.surroundings() {
            let going = draws.iter().take_while(|_| !(self.cancelled)());
            return going
                .map(|drawn| {
                    let fall = fall_in_world(prepared, surroundings, self.thin_axis, drawn);
                    (self.done)();
                    fall
                })
                .collect();
        }
        let scene = prepared.scene();
        let tasks = draws.iter().map(|drawn| {
            let release = Release {
                state: drawn.draw.release,
                noise: drawn.noise(scene),
            };
            Task {
                release,
                steering: None,
                watch: Watched::new(scene, self.thin_axis, &release.state),
            }
        });
        let lanes = Lanes {
            prepared,
            apart: APART,
        };
        let falls = lanes.falls(tasks, self.cancelled, self.done).into_iter();
        let falls = falls.map(|fall| {
            let drawn = &draws[fall.place];
            fall.watch.ended(drawn, &fall.last, fall.ending)
        });
        falls.collect()
    }
}

impl Drawn {
    pub(super) fn noise(&self, scene: &Scene) -> NoiseStream {
        NoiseStream {
            seed: scene.seed,
            body: self.run,
        }
    }

    /// For a body that cannot be.
    fn without_a_fall(&self, scene: &Scene, thin_axis: Vec3, why: &str) -> Fall {
        let release = &self.draw.release;
        let watch = Watched::new(scene, thin_axis, release);
        watch.ended(self, release, FallEnding::Diverged(why.to_owned()))
    }
}

/// What is kept of a fall under way.
pub(super) struct Watched {
    pub(super) motion: MotionTracker,
    pub(super) samples: Vec<Vec3>,
    thin_axis: Vec3,
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
            thin_axis,
            slack: 1e-6 * scene.time_step,
            origin,
        }
    }

    /// The fall, which ended in the state `last`.
    pub(super) fn ended(self, drawn: &Drawn, last: &State, ending: FallEnding) -> Fall {
        Fall {
            run: drawn.run,
            draw: drawn.draw,
            ending,
            time: last.time,
            end: relative(last.position, self.origin),
            velocity: last.world_velocity(),
            angular_velocity: last.world_angular_velocity(),
            up: rotate(last.orientation, self.thin_axis)[1],
            samples: self.samples,
            motion: self.motion,
            lying: None,
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
