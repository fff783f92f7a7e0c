//! One run, as poses at common times.

use langevin_rigid::State;
use langevin_rigid_formats::export::{BodyRow, RecordedBody};
use langevin_rigid_formats::track::{Track, TrackError};
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_scenes::prepared::Fall;
use serde::Serialize;

/// Frames of a single body at most; it has one for each state, or for every so many.
const MOST_FRAMES: usize = 6000;

/// Frames a second of many bodies.
const FRAMES_PER_SECOND: f64 = 60.0;

/// Poses of many bodies at most, of all frames together: some hundred megabytes.
const MOST_POSES: usize = 4_000_000;

/// What bodies did.
#[derive(Debug, Clone)]
pub struct Run {
    bodies: Vec<Body>,
    trajectories: Vec<Trajectory>,
    /// States of the only body at the frames.
    states: Vec<State>,
    frames: Frames,
}

/// A body of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Body {
    /// Its number.
    pub number: u32,
    /// Place of its kind among those of the scene.
    pub kind: usize,
    /// Its lengths over those of its kind.
    pub scale: f64,
    /// How its run ended, in a word.
    pub ending: String,
    /// Why a step failed, if one did.
    pub trouble: Option<String>,
    /// Frame at which it is let go.
    pub from: usize,
}

/// Poses at common times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frames {
    /// Time of each frame (s).
    pub times: Vec<f64>,
    /// For each body, from [`Body::from`] on: position (m) and orientation (x, y, z, w) of each frame, world frame.
    pub poses: Vec<Vec<[f32; 7]>>,
}

/// Why tables cannot be shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// There is no body in them.
    #[error("the table has no body: simulate the scene again")]
    Nobody,
    /// A body has no kind, or one that the scene does not have.
    #[error(
        "the kind of body {0} is not told, or the scene has none of this name: simulate the scene again"
    )]
    Kind(u32),
    /// Its poses are none.
    #[error("body {0}: {1}")]
    Track(u32, TrackError),
}

impl Run {
    pub(crate) fn of_falls(falls: &[Fall]) -> Self {
        let bodies = falls.iter().map(|fall| Body {
            number: fall.body,
            kind: fall.kind,
            scale: fall.scale,
            ending: fall.ending().to_owned(),
            trouble: fall.ended.as_ref().err().map(ToString::to_string),
            from: 0,
        });
        let trajectories = falls.iter().map(Fall::trajectory);
        let states = match falls {
            [fall] => thinned(&fall.states),
            _ => Vec::new(),
        };
        Self::new(bodies.collect(), trajectories.collect(), states)
    }

    pub(crate) fn of_tables(
        trajectories: Vec<Trajectory>,
        rows: &[BodyRow],
        kinds: &[&str],
    ) -> Result<Self, ReplayError> {
        if trajectories.is_empty() {
            return Err(ReplayError::Nobody);
        }
        let body = |trajectory: &Trajectory| {
            let number = trajectory.body;
            Track::new(&trajectory.poses).map_err(|error| ReplayError::Track(number, error))?;
            let row = rows.iter().find(|row| row.body == number);
            let kind = match row {
                Some(row) => kinds.iter().position(|kind| *kind == row.kind),
                None => rows.is_empty().then_some(0),
            };
            Ok(Body {
                number,
                kind: kind.ok_or(ReplayError::Kind(number))?,
                scale: row.map_or(1.0, |row| row.scale),
                ending: "recorded".to_owned(),
                trouble: None,
                from: 0,
            })
        };
        let bodies = trajectories.iter().map(body).collect::<Result<_, _>>()?;
        let states = match &trajectories[..] {
            [trajectory] => thinned(&states(trajectory)),
            _ => Vec::new(),
        };
        Ok(Self::new(bodies, trajectories, states))
    }

    fn new(mut bodies: Vec<Body>, trajectories: Vec<Trajectory>, states: Vec<State>) -> Self {
        let frames = if states.is_empty() {
            sampled(&mut bodies, &trajectories)
        } else {
            Frames {
                times: states.iter().map(|state| state.time).collect(),
                poses: vec![
                    states
                        .iter()
                        .map(|s| pose(s.position, s.orientation))
                        .collect(),
                ],
            }
        };
        Self {
            bodies,
            trajectories,
            states,
            frames,
        }
    }

    /// Its bodies.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Where they are, frame by frame.
    pub fn frames(&self) -> &Frames {
        &self.frames
    }

    /// The state of its only body at each frame; none of several. From tables it is without the turbulence that the body
    /// sees, which they do not keep.
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// Every pose and velocity that was kept.
    pub fn trajectories(&self) -> &[Trajectory] {
        &self.trajectories
    }

    /// Its bodies for exports.
    pub fn recorded(&self) -> Vec<RecordedBody<'_>> {
        let bodies = self.bodies.iter().zip(&self.trajectories);
        bodies
            .map(|(body, trajectory)| RecordedBody {
                kind: body.kind,
                scale: body.scale,
                trajectory,
            })
            .collect()
    }
}

/// Every so many of the states, and the last.
fn thinned(states: &[State]) -> Vec<State> {
    let stride = states.len().div_ceil(MOST_FRAMES).max(1);
    let last = states.len() - 1;
    let kept = states.iter().enumerate();
    kept.filter(|(place, _)| place % stride == 0 || *place == last)
        .map(|(_, state)| *state)
        .collect()
}

fn states(trajectory: &Trajectory) -> Vec<State> {
    let velocities = trajectory
        .velocities
        .iter()
        .zip(&trajectory.angular_velocities);
    let rows = trajectory.poses.iter().zip(velocities).enumerate();
    rows.map(|(step, (pose, (velocity, angular_velocity)))| {
        let mut state = State {
            time: pose.time,
            step: step as u64,
            position: pose.position,
            orientation: pose.orientation,
            ..State::default()
        };
        state.set_world_velocities(*velocity, *angular_velocity);
        state
    })
    .collect()
}

/// All bodies at the same times; each from when it is let go.
fn sampled(bodies: &mut [Body], trajectories: &[Trajectory]) -> Frames {
    let tracks = trajectories
        .iter()
        .map(|trajectory| Track::new(&trajectory.poses).ok());
    let tracks: Vec<Option<Track<'_>>> = tracks.collect();
    let known = || tracks.iter().flatten();
    let start = known().map(Track::start).fold(f64::INFINITY, f64::min);
    let end = known().map(Track::end).fold(start, f64::max);
    let most = (MOST_POSES / bodies.len().max(1)).max(2) as f64;
    let rate = FRAMES_PER_SECOND.min(most / (end - start));
    let count = ((end - start) * rate).ceil() as usize + 1;
    // The last frame is the end.
    let time = |frame: usize| (start + frame as f64 / rate).min(end);
    let times: Vec<f64> = (0..count).map(time).collect();
    let mut poses = Vec::new();
    for (body, track) in bodies.iter_mut().zip(tracks) {
        let first = track.as_ref().map_or(f64::INFINITY, Track::start);
        body.from = times.partition_point(|time| *time < first);
        let at = |time: &f64| {
            let pose_then = track.as_ref().map(|track| track.at(*time))?;
            Some(pose(pose_then.position, pose_then.orientation))
        };
        poses.push(times[body.from..].iter().filter_map(at).collect());
    }
    Frames { times, poses }
}

fn pose([x, y, z]: [f64; 3], q: [f64; 4]) -> [f32; 7] {
    [x, y, z, q[0], q[1], q[2], q[3]].map(|number| number as f32)
}

#[cfg(test)]
mod tests {
    use langevin_rigid_formats::trajectory::{csv, read_csv};

    use super::*;
    use crate::session::Session;

    #[test]
    fn a_run_from_its_table_is_the_run() {
        let text = r#"
            fluid.preset = "air"
            body = { shape = "box", size = [0.05, 0.001, 0.05], triangles = 80, density = 500.0 }
            release = { position = [0.0, 1.0, 0.0], tilt = 30.0 }
            run = { time_step = 0.002, duration = 5.0, ground = 0.0 }
        "#;
        let session = Session::open("card", text, None, &()).unwrap();
        let run = session.drop(&()).unwrap();
        assert_eq!(run.bodies()[0].ending, "ground");
        let table = csv(&run.trajectories()[0]);
        let again = session.replay(read_csv(&table).unwrap(), &[]).unwrap();
        assert_eq!(again.frames(), run.frames());
        assert_eq!(again.bodies()[0].ending, "recorded");
        let [body] = run.recorded()[..] else {
            panic!("there is one body");
        };
        assert_eq!((body.kind, body.scale), (0, 1.0));
        assert_eq!(csv(body.trajectory), table);
        assert!(matches!(
            session.replay(Vec::new(), &[]),
            Err(ReplayError::Nobody)
        ));
    }

    #[test]
    fn bodies_of_a_crowd_come_when_they_are_let_go() {
        let text = r#"
            fluid.preset = "air"
            body = { shape = "box", size = [0.05, 0.001, 0.05], triangles = 80, density = 500.0 }
            release = { position = [0.0, 1.0, 0.0] }
            run = { time_step = 0.004, duration = 1.0, ground = 0.0 }
            contact = {}
            crowd = { count = 4, over = [1.0, 0.2, 1.0], during = 0.4 }
        "#;
        let session = Session::open("cards", text, None, &()).unwrap();
        let run = session.drop(&()).unwrap();
        let frames = run.frames();
        assert_eq!(run.bodies().len(), 4);
        assert!(run.states().is_empty());
        assert!(
            run.bodies()
                .windows(2)
                .all(|pair| pair[0].from < pair[1].from)
        );
        for (body, poses) in run.bodies().iter().zip(&frames.poses) {
            assert_eq!(body.from + poses.len(), frames.times.len());
            // It falls from where it begins.
            assert!(poses[0][1] > poses[poses.len() - 1][1]);
        }
        let step = frames.times[1] - frames.times[0];
        assert!((step - 1.0 / 60.0).abs() < 1e-12);
    }
}
