//! The frames that a run is divided into.

use super::ExportError;
use crate::trajectory::Trajectory;

/// Most frames of an animation, over all its bodies: each takes some hundred bytes.
const MOST: usize = 10_000_000;

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
}

impl Frames {
    pub(super) fn of(trajectories: &[Trajectory], fps: f64) -> Result<Self, ExportError> {
        let poses = || trajectories.iter().flat_map(|t| &t.poses);
        let start = poses().map(|p| p.time).fold(f64::INFINITY, f64::min);
        let end = poses().map(|p| p.time).fold(f64::NEG_INFINITY, f64::max);
        if end < start {
            return Err(ExportError::NoBodies);
        }
        let frames = Self { fps, start, end };
        if !(fps > 0.0 && (end - start) * fps < MOST as f64) {
            return Err(frames.too_many(MOST));
        }
        let ends = trajectories.iter().filter_map(|t| t.poses.last());
        let all: f64 = ends.map(|pose| frames.count(pose.time)).sum();
        if all > MOST as f64 {
            return Err(ExportError::TooManyFrames {
                frames: all,
                fps,
                bodies: trajectories.len(),
                most: MOST,
            });
        }
        Ok(frames)
    }

    /// The most frames until a time (s).
    fn count(self, end: f64) -> f64 {
        ((end - self.start) * self.fps).max(0.0).floor() + 2.0
    }

    /// The error that only so many frames are possible.
    pub(super) fn too_many(self, most: usize) -> ExportError {
        ExportError::FrameRate {
            fps: self.fps,
            duration: self.end - self.start,
            most,
        }
    }

    /// Numbers of the frames until a time (s): whole ones before it, and its own.
    pub(super) fn until(self, end: f64) -> Vec<f64> {
        let length = (end - self.start) * self.fps;
        let mut numbers: Vec<f64> = (0..=length as u32).map(f64::from).collect();
        // Rounding of the end is no frame of its own.
        match length.fract() {
            rest if rest > 1.0 - SAME => numbers.push(length.round()),
            rest if rest > SAME => numbers.push(length),
            _ => {}
        }
        numbers
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

    fn frames(end: f64, fps: f64) -> Result<Vec<f64>, ExportError> {
        let at = |time| State {
            time,
            ..State::default()
        };
        let frames = Frames::of(&[Trajectory::new(0, &[at(0.0), at(end)])], fps)?;
        Ok(frames.until(end))
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
    fn frames_are_counted_over_all_bodies() {
        let at = |time| State {
            time,
            ..State::default()
        };
        let bodies = |count: u32, end: f64| -> Vec<Trajectory> {
            let body = |body| Trajectory::new(body, &[at(0.0), at(end)]);
            (0..count).map(body).collect()
        };
        for (count, end) in [(1, 0.0), (3, 1.7), (2, 99944.0)] {
            let bodies = bodies(count, end);
            let frames = Frames::of(&bodies, 60.0);
            let made = 60.0 * end * f64::from(count);
            if made < 1e7 {
                let frames = frames.unwrap();
                assert!(frames.until(end).len() as f64 <= frames.count(end));
            } else {
                assert!(matches!(frames, Err(ExportError::TooManyFrames { .. })));
            }
        }
        let error = Frames::of(&bodies(200, 99944.0), 60.0).unwrap_err();
        let message = error.to_string();
        assert!(
            message.contains("1.199e9 frames") && message.contains("200 bodies"),
            "{message}"
        );
    }

    #[test]
    fn impossible_rates_are_refused() {
        for fps in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e12] {
            assert!(frames(1.0, fps).is_err(), "{fps}");
        }
        assert!(matches!(Frames::of(&[], 60.0), Err(ExportError::NoBodies)));
    }
}
