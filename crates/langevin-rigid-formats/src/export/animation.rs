//! Motion at keys, and how far what programs make of it strays from the motion itself.

use std::borrow::Borrow;
use std::fmt;

use langevin_rigid::linalg::vector::{norm, sub};
use rayon::prelude::*;
use serde::Serialize;

use super::ExportError;
use super::frames::{Frames, MOST};
use super::keys::{Chosen, Keys};
use crate::track::{Pose, Track, arc, line, nearer, turn};
use crate::trajectory::Trajectory;

/// The largest distance and turn between a body of a trajectory and the same in an animation of it.
///
/// Between keys positions go on straight lines and orientations on the shorter arc (slerp), as glTF and
/// USD have it. Compared at every pose of the trajectory, the rounding of the file's numbers included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Deviation {
    /// Distance (m).
    pub position: f64,
    /// Angle (rad).
    pub rotation: f64,
}

/// Share of the body's length, and angle (rad), beyond which the motion between keys is another one.
const LARGE: Deviation = Deviation {
    position: 0.2,
    rotation: 0.35,
};

impl Deviation {
    /// Of what is shown at the time of a pose; the orientation is of unit length.
    pub(super) fn of((position, orientation): ([f64; 3], [f64; 4]), pose: &Pose) -> Self {
        Self {
            position: norm(sub(position, pose.position)),
            rotation: turn(orientation, pose.orientation),
        }
    }

    /// Whether it makes another motion of that of a body of some `length` (m).
    pub(super) fn is_large(self, length: f64) -> bool {
        self.position > LARGE.position * length || self.rotation > LARGE.rotation
    }

    fn worse(self, other: Self) -> Self {
        Self {
            position: self.position.max(other.position),
            rotation: self.rotation.max(other.rotation),
        }
    }
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (millimetres, degrees) = (1e3 * self.position, self.rotation.to_degrees());
        write!(f, "{millimetres:.2} mm and {degrees:.2} degrees")
    }
}

/// All bodies at their keys.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Animation {
    /// One for each body.
    pub(super) bodies: Vec<Keyframes>,
    /// How far it strays from the trajectories it was made of.
    pub(super) deviation: Deviation,
    /// Whether that makes another motion of a body's.
    is_another: bool,
}

/// One body at frames, and between them where it moves too much, until its own end, where it stays.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Keyframes {
    /// Number of the body.
    pub(super) body: u32,
    /// The frame at which it appears, if others are there before it.
    pub(super) appears: Option<f64>,
    /// Numbers of its frames, whole but for the last and for keys between frames.
    pub(super) numbers: Vec<f64>,
    /// Times of its keys, as the file has them (s).
    pub(super) times: Vec<f64>,
    /// Position at each key, at least one (m).
    pub(super) positions: Vec<[f64; 3]>,
    /// Orientation at each key, unit quaternions, neighbours on the same side.
    pub(super) orientations: Vec<[f64; 4]>,
}

impl Animation {
    /// The trajectories of bodies of these lengths (m) at `frames`, whose times a file rounds by `rounded_time`.
    pub(super) fn new<T: Borrow<Trajectory> + Sync>(
        trajectories: &[T],
        lengths: &[f64],
        frames: Frames,
        rounded_time: impl Fn(f64) -> f64 + Sync,
    ) -> Result<Self, ExportError> {
        let bodies: Result<Vec<Keyframes>, ExportError> = trajectories
            .par_iter()
            .zip(lengths)
            .map(|(trajectory, &length)| {
                let trajectory = trajectory.borrow();
                let track = Track::new(&trajectory.poses).map_err(|error| ExportError::Track {
                    body: trajectory.body,
                    error,
                })?;
                let keys = Keys {
                    track: &track,
                    frames,
                    rounded_time: &rounded_time,
                    length,
                };
                let keyframes = Keyframes::new(trajectory.body, &track, keys.choose());
                let first = frames.number(track.start());
                Ok(Keyframes {
                    appears: (first > 0.0).then_some(first),
                    ..keyframes
                })
            })
            .collect();
        Ok(Self {
            bodies: bodies?,
            deviation: Deviation::default(),
            is_another: false,
        })
    }

    /// The same with each number as a file has it.
    pub(super) fn rounded(
        mut self,
        position: impl Fn(f64) -> f64 + Sync,
        orientation: impl Fn(f64) -> f64 + Sync,
    ) -> Self {
        self.bodies.par_iter_mut().for_each(|keyframes| {
            for x in keyframes.positions.as_flattened_mut() {
                *x = position(*x);
            }
            for x in keyframes.orientations.as_flattened_mut() {
                *x = orientation(*x);
            }
        });
        self
    }

    /// The same, knowing how far it strays from the trajectories of bodies of these lengths (m).
    pub(super) fn compared<T: Borrow<Trajectory> + Sync>(
        mut self,
        trajectories: &[T],
        lengths: &[f64],
    ) -> Self {
        let deviations: Vec<Deviation> = self
            .bodies
            .par_iter()
            .zip(trajectories)
            .map(|(keyframes, trajectory)| keyframes.deviation(&trajectory.borrow().poses))
            .collect();
        let mut pairs = deviations.iter().zip(lengths);
        self.is_another = pairs.any(|(deviation, length)| deviation.is_large(*length));
        self.deviation = deviations
            .into_iter()
            .fold(Deviation::default(), Deviation::worse);
        self
    }

    /// What to do about an animation that strays too far, if it does.
    pub(super) fn warning(&self) -> Option<String> {
        self.is_another.then(|| {
            format!(
                "the animation strays up to {} from the trajectory: {MOST} keys over all bodies and the \
                 digits of its numbers allow no better; export fewer bodies, a shorter run or one nearer to \
                 the origin, or a format that has every step (csv, npz)",
                self.deviation
            )
        })
    }
}

impl Keyframes {
    fn new(body: u32, track: &Track<'_>, Chosen { numbers, times }: Chosen) -> Self {
        let poses: Vec<Pose> = times.iter().map(|time| track.at(*time)).collect();
        let mut orientations: Vec<[f64; 4]> = Vec::with_capacity(poses.len());
        for pose in &poses {
            let last = orientations.last().copied();
            orientations.push(last.map_or(pose.orientation, |q| nearer(q, pose.orientation)));
        }
        Self {
            body,
            appears: None,
            numbers,
            times,
            positions: poses.iter().map(|pose| pose.position).collect(),
            orientations,
        }
    }

    /// What a program shows at `time`, given the number of keys that are not after it.
    fn shown(&self, passed: usize, time: f64) -> ([f64; 3], [f64; 4]) {
        let last = self.times.len() - 1;
        let (a, b) = (passed.saturating_sub(1), passed.min(last));
        let part = if a < b {
            (time - self.times[a]) / (self.times[b] - self.times[a])
        } else {
            0.0
        };
        (
            line(self.positions[a], self.positions[b], part),
            arc(self.orientations[a], self.orientations[b], part),
        )
    }

    fn deviation(&self, poses: &[Pose]) -> Deviation {
        let mut worst = Deviation::default();
        let mut passed = 0;
        for pose in poses {
            while passed < self.times.len() && self.times[passed] <= pose.time {
                passed += 1;
            }
            worst = worst.worse(Deviation::of(self.shown(passed, pose.time), pose));
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::State;
    use langevin_rigid::linalg::quat_from_rotation_vector;

    use super::*;

    /// A throw upwards and an even turn about z, at a thousand steps a second.
    fn thrown(spin: f64) -> Vec<Trajectory> {
        let state = |step: u32| {
            let time = 1e-3 * f64::from(step);
            State {
                time,
                position: [2.0 * time, 3.0 * time - 4.905 * time * time, 0.0],
                orientation: quat_from_rotation_vector([0.0, 0.0, spin * time]),
                ..State::default()
            }
        };
        let states: Vec<State> = (0..=1000).map(state).collect();
        vec![Trajectory::new(0, &states)]
    }

    fn animation(trajectories: &[Trajectory], fps: f64) -> Animation {
        let frames = Frames::of(trajectories, fps).unwrap();
        let lengths = vec![1.0; trajectories.len()];
        Animation::new(trajectories, &lengths, frames, |t| t)
            .unwrap()
            .compared(trajectories, &lengths)
    }

    fn deviation(spin: f64, fps: u32) -> Deviation {
        let trajectories = thrown(spin);
        animation(&trajectories, f64::from(fps)).deviation
    }

    #[test]
    fn a_parabola_strays_by_its_sagitta_and_an_even_turn_not_at_all() {
        for fps in [10, 20, 50] {
            let Deviation { position, rotation } = deviation(7.0, fps);
            // The chord of g t^2 / 2 over h is g h^2 / 8 away.
            let sagitta = 9.81 / f64::from(8 * fps * fps);
            assert!((position / sagitta - 1.0).abs() < 1e-9, "{position}");
            assert!(rotation < 1e-14, "{rotation}");
        }
    }

    #[test]
    fn a_body_that_turns_far_from_frame_to_frame_has_keys_between() {
        // 200 rad/s at 60 frames a second: without them 3.33 rad a frame would go the other way round.
        let fast = thrown(200.0);
        let animation = animation(&fast, 60.0);
        let Keyframes {
            numbers,
            orientations,
            ..
        } = &animation.bodies[0];
        assert!(animation.deviation.rotation < 1e-12);
        assert!((0..=60).all(|frame| numbers.contains(&f64::from(frame))));
        // 3.33 rad are halved three times.
        assert!((420..=540).contains(&numbers.len()), "{}", numbers.len());
        assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
        let turns = orientations.windows(2).map(|q| turn(q[0], q[1]));
        assert!(turns.fold(0.0, f64::max) < 0.8);
    }

    #[test]
    fn a_body_that_turns_little_has_its_frames_only() {
        for spin in [7.0, 46.0] {
            let animation = animation(&thrown(spin), 60.0);
            assert_eq!(animation.bodies[0].numbers.len(), 61, "{spin}");
        }
    }

    #[test]
    fn a_jolt_between_frames_has_a_key() {
        let mut jolted = thrown(0.0);
        jolted[0].poses[505].position[2] = 0.5;
        let animation = animation(&jolted, 60.0);
        assert!(animation.bodies[0].times.contains(&0.505));
        assert!(animation.deviation.position < 0.01);
    }

    #[test]
    fn a_body_that_ends_sooner_has_its_own_last_frame() {
        let mut trajectories = thrown(1.0);
        let mut short = trajectories[0].clone();
        short.poses.truncate(251);
        trajectories.push(short);
        let animation = animation(&trajectories, 10.0);
        assert_eq!(animation.bodies[0].numbers.len(), 11);
        let keyframes = &animation.bodies[1];
        assert_eq!(keyframes.numbers, [0.0, 1.0, 2.0, 2.5]);
        assert_eq!(keyframes.positions[3], trajectories[1].poses[250].position);
        let whole = animation.deviation.position;
        assert!((whole / 0.012_262_5 - 1.0).abs() < 1e-9, "{whole}");
    }

    #[test]
    fn where_keys_run_out_there_is_a_warning() {
        let fast = thrown(200.0);
        let frames = Frames::of(&fast, 60.0).unwrap();
        let warning = |spare| {
            let frames = Frames { spare, ..frames };
            Animation::new(&fast, &[1.0], frames, |t| t)
                .unwrap()
                .compared(&fast, &[1.0])
                .warning()
        };
        assert_eq!(warning(frames.spare), None);
        assert!(warning(40).is_some_and(|w| w.contains("export fewer bodies")));
    }

    #[test]
    fn rounding_is_part_of_it() {
        let trajectories = thrown(1.0);
        let animation = animation(&trajectories, 1000.0);
        assert!(animation.deviation.position < 1e-14);
        let coarse = animation
            .rounded(|x| (100.0 * x).round() / 100.0, |q| q)
            .compared(&trajectories, &[1.0]);
        let position = coarse.deviation.position;
        assert!((0.004..0.0071).contains(&position), "{position}");
    }
}
