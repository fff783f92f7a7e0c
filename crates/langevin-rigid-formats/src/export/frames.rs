//! The frames that a run is divided into.
//!
//! A track goes straight from pose to pose, and so do programs from frame to frame. A frame without a pose
//! next to it would only repeat the line between its neighbours and is left out: a table with a long gap
//! makes no more frames than one without.

use std::borrow::Borrow;

use super::ExportError;
use crate::track::Track;
use crate::trajectory::Trajectory;

/// Most frames and keys of an animation, over all its bodies: each takes some hundred bytes.
pub(super) const MOST: usize = 10_000_000;

/// A last frame closer than this to the one before it, in frames, is the same.
const SAME: f64 = 1e-6;

/// Frames at equal times from the first pose of any body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frames {
    /// Frames a second.
    pub(super) fps: f64,
    /// Time of frame 0 (s).
    pub(super) start: f64,
    /// Time of the last pose of any body (s).
    pub(super) end: f64,
    /// Keys that each body may have beside its frames.
    pub(super) spare: usize,
}

impl Frames {
    pub(super) fn of<T: Borrow<Trajectory>>(
        trajectories: &[T],
        fps: f64,
    ) -> Result<Self, ExportError> {
        let trajectories: Vec<&Trajectory> = trajectories.iter().map(T::borrow).collect();
        let poses = || trajectories.iter().flat_map(|t| &t.poses);
        let start = poses().map(|p| p.time).fold(f64::INFINITY, f64::min);
        let end = poses().map(|p| p.time).fold(f64::NEG_INFINITY, f64::max);
        if end < start {
            return Err(ExportError::NoBodies);
        }
        let frames = Self {
            fps,
            start,
            end,
            spare: 0,
        };
        if !(fps > 0.0 && (end - start) * fps < MOST as f64) {
            return Err(frames.too_many(MOST));
        }
        let all: f64 = trajectories.iter().map(|t| frames.count(t)).sum();
        if all > MOST as f64 {
            return Err(ExportError::TooManyFrames {
                frames: all,
                fps,
                bodies: trajectories.len(),
                most: MOST,
            });
        }
        let spare = (MOST - all as usize) / trajectories.len();
        Ok(Self { spare, ..frames })
    }

    /// The most frames of a body.
    fn count(self, trajectory: &Trajectory) -> f64 {
        let end = trajectory.poses.last().map_or(self.start, |pose| pose.time);
        let whole = ((end - self.start) * self.fps).max(0.0).floor() + 2.0;
        whole.min(2.0 * trajectory.poses.len() as f64 + 2.0)
    }

    /// The error that only so many frames are possible.
    pub(super) fn too_many(self, most: usize) -> ExportError {
        ExportError::FrameRate {
            fps: self.fps,
            duration: self.end - self.start,
            most,
        }
    }

    /// Numbers of a body's frames: the first, the whole ones next to each of its poses, and its end.
    pub(super) fn of_track(self, track: &Track<'_>) -> Vec<f64> {
        // Rounding of the end is no frame of its own.
        let end = self.number(track.end());
        let whole = end.round();
        let end = if (end - whole).abs() <= SAME {
            whole
        } else {
            end
        };
        let mut numbers = vec![0.0];
        let mut last = 0.0;
        for pose in track.poses() {
            let at = self.number(pose.time);
            for next in [at.floor(), at.ceil()] {
                if last < next && next < end {
                    numbers.push(next);
                    last = next;
                }
            }
        }
        if last < end {
            numbers.push(end);
        }
        numbers
    }

    /// The number that a frame at some time (s) has, whole or not.
    pub(super) fn number(self, time: f64) -> f64 {
        (time - self.start) * self.fps
    }

    /// The time of a frame (s).
    pub(super) fn time(self, number: f64) -> f64 {
        self.start + number / self.fps
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::State;

    use super::*;

    /// Poses at some times (s).
    fn body(number: u32, times: &[f64]) -> Trajectory {
        let at = |time: &f64| State {
            time: *time,
            ..State::default()
        };
        let states: Vec<State> = times.iter().map(at).collect();
        Trajectory::new(number, &states)
    }

    fn numbers(times: &[f64], fps: f64) -> Result<Vec<f64>, ExportError> {
        let body = [body(0, times)];
        let frames = Frames::of(&body, fps)?;
        Ok(frames.of_track(&Track::new(&body[0].poses).unwrap()))
    }

    fn frames(end: f64, fps: f64) -> Result<Vec<f64>, ExportError> {
        let times: Vec<f64> = (0..=100).map(|n| end * f64::from(n) / 100.0).collect();
        numbers(&times, fps)
    }

    #[test]
    fn the_last_frame_is_the_end() {
        assert_eq!(frames(0.1, 20.0).unwrap(), [0.0, 1.0, 2.0]);
        assert_eq!(frames(0.1 - 1e-12, 20.0).unwrap(), [0.0, 1.0, 2.0]);
        assert_eq!(frames(0.1 + 1e-12, 20.0).unwrap(), [0.0, 1.0, 2.0]);
        assert_eq!(frames(0.125, 20.0).unwrap(), [0.0, 1.0, 2.0, 2.5]);
        assert_eq!(frames(0.0, 20.0).unwrap(), [0.0]);
    }

    #[test]
    fn a_gap_makes_no_frames() {
        assert_eq!(
            numbers(&[0.0, 0.05, 3600.0, 3600.02], 60.0).unwrap(),
            [0.0, 3.0, 216_000.0, 216_001.0, 3600.02 * 60.0]
        );
        // A body that comes later waits where it starts.
        let bodies = [body(0, &[0.0]), body(1, &[10.01, 20.0])];
        let frames = Frames::of(&bodies, 60.0).unwrap();
        let track = Track::new(&bodies[1].poses).unwrap();
        assert_eq!(frames.of_track(&track), [0.0, 600.0, 601.0, 1200.0]);
    }

    #[test]
    fn frames_are_counted_over_all_bodies() {
        let steps = |count: u32| -> Vec<f64> { (0..=count).map(|n| 0.01 * f64::from(n)).collect() };
        for (count, times) in [
            (1, steps(0)),
            (3, steps(170)),
            (7, vec![0.0, 0.001, 99944.0]),
        ] {
            let bodies: Vec<Trajectory> = (0..count).map(|n| body(n, &times)).collect();
            let frames = Frames::of(&bodies, 60.0).unwrap();
            let made = frames.of_track(&Track::new(&bodies[0].poses).unwrap());
            assert!(made.len() as f64 <= frames.count(&bodies[0]));
        }
        let long = body(0, &steps(150_000));
        let bodies = vec![long; 70];
        let error = Frames::of(&bodies, 120.0).unwrap_err();
        let message = error.to_string();
        assert!(
            message.contains("1.260e7 frames") && message.contains("70 bodies"),
            "{message}"
        );
    }

    #[test]
    fn impossible_rates_are_refused() {
        for fps in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e12] {
            assert!(frames(1.0, fps).is_err(), "{fps}");
        }
        assert!(matches!(
            Frames::of::<Trajectory>(&[], 60.0),
            Err(ExportError::NoBodies)
        ));
    }
}
