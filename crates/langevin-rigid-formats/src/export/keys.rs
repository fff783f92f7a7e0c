//! Keys between frames, for bodies that move too much from frame to frame.
//!
//! Programs turn from key to key on the shorter arc: a body that turns by more than half a revolution between two
//! frames would seem to turn the other way, as wheels do in films. Where a body turns or strays far between two
//! frames it gets keys at some of its own poses there; elsewhere its frames are its keys.

use std::f64::consts::FRAC_PI_4;

use super::animation::Deviation;
use super::frames::Frames;
use crate::track::{Pose, Track, arc, line, turn, unit};

/// Largest turn on the way from key to key (rad).
const MOST_TURN: f64 = FRAC_PI_4;

/// What a body's keys are chosen from.
pub(super) struct Keys<'a, F> {
    pub(super) track: &'a Track<'a>,
    pub(super) frames: Frames,
    /// A time as the file has it (s).
    pub(super) rounded_time: F,
    /// Length of the body (m).
    pub(super) length: f64,
}

/// Numbers of frames, whole and broken, with their times (s).
#[derive(Default)]
pub(super) struct Chosen {
    pub(super) numbers: Vec<f64>,
    pub(super) times: Vec<f64>,
}

impl<F: Fn(f64) -> f64> Keys<'_, F> {
    /// The frames of the body and the keys between them.
    pub(super) fn choose(&self) -> Chosen {
        let mut numbers = self.frames.of_track(self.track);
        let mut times: Vec<f64> = numbers.iter().map(|number| self.time(*number)).collect();
        if let [.., before, end] = times[..]
            && before == end
        {
            // Rounding leaves no time between them: the end is the frame.
            numbers.remove(numbers.len() - 2);
            times.pop();
        }
        let mut chosen = Chosen::default();
        let mut spare = self.frames.spare;
        for (k, (number, time)) in numbers.into_iter().zip(&times).enumerate() {
            if let Some(before) = k.checked_sub(1) {
                let [a, b] = [times[before], *time].map(|time| self.track.at(time));
                self.between(&a, &b, self.inside(&a, &b), &mut chosen, &mut spare);
            }
            chosen.numbers.push(number);
            chosen.times.push(*time);
        }
        chosen
    }

    fn time(&self, number: f64) -> f64 {
        (self.rounded_time)(self.frames.time(number))
    }

    /// The poses between two times.
    fn inside(&self, a: &Pose, b: &Pose) -> &[Pose] {
        let poses = self.track.poses();
        let first = poses.partition_point(|pose| pose.time <= a.time);
        let end = poses.partition_point(|pose| pose.time < b.time);
        &poses[first..end.max(first)]
    }

    /// Halves the poses between two keys until the way from key to key is near them.
    fn between(&self, a: &Pose, b: &Pose, inside: &[Pose], chosen: &mut Chosen, spare: &mut usize) {
        if *spare == 0 || inside.is_empty() || !self.is_far(a, b, inside) {
            return;
        }
        let (before, rest) = inside.split_at(inside.len() / 2);
        let (middle, after) = (&rest[0], &rest[1..]);
        self.between(a, middle, before, chosen, spare);
        let number = self.frames.number(middle.time);
        let time = self.time(number);
        // Single precision may not tell it from its neighbours.
        let last = chosen.times.last().is_none_or(|last| *last < time);
        if *spare > 0 && last && time < b.time {
            *spare -= 1;
            chosen.numbers.push(number);
            chosen.times.push(time);
        }
        self.between(middle, b, after, chosen, spare);
    }

    /// Whether the body turns far on its way from `a` to `b`, or strays far from the straight way.
    fn is_far(&self, a: &Pose, b: &Pose, inside: &[Pose]) -> bool {
        let way: f64 = [a]
            .into_iter()
            .chain(inside)
            .zip(inside.iter().chain([b]))
            .map(|(from, to)| turn(unit(from.orientation), to.orientation))
            .sum();
        way > MOST_TURN
            || inside.iter().any(|pose| {
                let part = (pose.time - a.time) / (b.time - a.time);
                let shown = (
                    line(a.position, b.position, part),
                    arc(a.orientation, b.orientation, part),
                );
                Deviation::of(shown, pose).is_large(self.length)
            })
    }
}
