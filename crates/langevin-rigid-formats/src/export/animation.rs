//! Motion at frames, and how far what programs make of it strays from the motion itself.

use std::borrow::Borrow;
use std::fmt;

use langevin_rigid::linalg::vector::{norm, sub};
use rayon::prelude::*;
use serde::Serialize;

use super::ExportError;
use super::frames::Frames;
use crate::track::{Pose, Track, arc, half_angle, line, nearer};
use crate::trajectory::Trajectory;

/// The largest distance and turn between a body of a trajectory and the same in an animation of it.
///
/// Between frames positions go on straight lines and orientations on the shorter arc (slerp), as glTF and
/// USD have it. Compared at every pose of the trajectory, the rounding of the file's numbers included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Deviation {
    /// Distance (m).
    pub position: f64,
    /// Angle (rad).
    pub rotation: f64,
}

/// Share of the body's length, and angle (rad), beyond which the motion between frames is another one:
/// most often the body turns by more than a right angle from frame to frame.
const LARGE: Deviation = Deviation {
    position: 0.2,
    rotation: 0.35,
};

impl Deviation {
    /// Times that it is what makes the motion of a body of some `length` (m) another one.
    fn excess(self, length: f64) -> f64 {
        (self.position / (LARGE.position * length)).max(self.rotation / LARGE.rotation)
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

/// All bodies at frames.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Animation {
    /// One for each body.
    pub(super) bodies: Vec<Keyframes>,
    /// How far it strays from the trajectories it was made of.
    pub(super) deviation: Deviation,
    /// The largest [`Deviation::excess`] of a body.
    excess: f64,
}

/// One body at the frames until its own end, where it stays.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Keyframes {
    /// Number of the body.
    pub(super) body: u32,
    /// Numbers of its frames, whole but for the last.
    pub(super) numbers: Vec<f64>,
    /// Times of its frames, as the file has them (s).
    pub(super) times: Vec<f64>,
    /// Position at each frame, at least one (m).
    pub(super) positions: Vec<[f64; 3]>,
    /// Orientation at each frame, unit quaternions, neighbours on the same side.
    pub(super) orientations: Vec<[f64; 4]>,
}

impl Animation {
    /// The trajectories at `frames`, whose times a file rounds by `rounded_time`.
    pub(super) fn new<T: Borrow<Trajectory> + Sync>(
        trajectories: &[T],
        frames: Frames,
        rounded_time: impl Fn(f64) -> f64 + Sync,
    ) -> Result<Self, ExportError> {
        let bodies: Result<Vec<Keyframes>, ExportError> = trajectories
            .par_iter()
            .map(|trajectory| {
                let trajectory = trajectory.borrow();
                let track = Track::new(&trajectory.poses).map_err(|error| ExportError::Track {
                    body: trajectory.body,
                    error,
                })?;
                let mut numbers = frames.of_track(&track);
                let time = |number: &f64| rounded_time(frames.time(*number));
                let mut times: Vec<f64> = numbers.iter().map(time).collect();
                if let [.., before, end] = times[..]
                    && before == end
                {
                    // Rounding leaves no time between them: the end is the frame.
                    numbers.remove(numbers.len() - 2);
                    times.pop();
                }
                Ok(Keyframes::new(trajectory.body, &track, numbers, times))
            })
            .collect();
        Ok(Self {
            bodies: bodies?,
            deviation: Deviation::default(),
            excess: 0.0,
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
        let excess = deviations.iter().zip(lengths).map(|(d, l)| d.excess(*l));
        self.excess = excess.fold(0.0, f64::max);
        self.deviation = deviations
            .into_iter()
            .fold(Deviation::default(), Deviation::worse);
        self
    }

    /// What to do about an animation of `fps` frames a second that strays too far, if it does.
    pub(super) fn warning(&self, fps: f64) -> Option<String> {
        // Both errors go with the square of the time between frames.
        let enough = fps * self.excess.sqrt().ceil();
        (self.excess > 1.0).then(|| {
            format!(
                "at {fps} frames a second the animation strays up to {} from the trajectory \
                 between frames: use --fps {enough} or more",
                self.deviation
            )
        })
    }
}

impl Keyframes {
    fn new(body: u32, track: &Track<'_>, numbers: Vec<f64>, times: Vec<f64>) -> Self {
        let poses: Vec<Pose> = times.iter().map(|time| track.at(*time)).collect();
        let mut orientations: Vec<[f64; 4]> = Vec::with_capacity(poses.len());
        for pose in &poses {
            let last = orientations.last().copied();
            orientations.push(last.map_or(pose.orientation, |q| nearer(q, pose.orientation)));
        }
        Self {
            body,
            numbers,
            times,
            positions: poses.iter().map(|pose| pose.position).collect(),
            orientations,
        }
    }

    /// What a program shows at `time`, given the number of frames that are not after it.
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
            let (position, orientation) = self.shown(passed, pose.time);
            worst = worst.worse(Deviation {
                position: norm(sub(position, pose.position)),
                rotation: angle(orientation, pose.orientation),
            });
        }
        worst
    }
}

/// Angle of the turn from one orientation to another, the first of unit length (rad).
fn angle(a: [f64; 4], b: [f64; 4]) -> f64 {
    let length = b.iter().map(|x| x * x).sum::<f64>().sqrt();
    2.0 * half_angle(a, nearer(a, b.map(|x| x / length)))
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
        Animation::new(trajectories, frames, |t| t)
            .unwrap()
            .compared(trajectories, &vec![1.0; trajectories.len()])
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
    fn turns_of_more_than_half_a_revolution_a_frame_show() {
        // 200 rad/s at 60 frames a second: 3.33 rad a frame go the other way round.
        assert!(deviation(200.0, 60).rotation > 1.5);
        assert!(deviation(200.0, 125).rotation < 1e-12);
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
    fn a_motion_that_looks_like_another_asks_for_more_frames() {
        let warning = |position, rotation| {
            let deviation = Deviation { position, rotation };
            let animation = Animation {
                bodies: Vec::new(),
                deviation,
                excess: deviation.excess(0.1),
            };
            animation.warning(24.0)
        };
        assert_eq!(warning(0.019, 0.34), None);
        assert!(warning(0.0, 3.1).is_some_and(|w| w.contains("use --fps 72 or more")));
        assert!(warning(0.021, 0.0).is_some_and(|w| w.contains("use --fps 48 or more")));
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
