//! The equal times at which the body is drawn.

use crate::hull::Hull;
use crate::numbers::fine_above;
use langevin_rigid_formats::track::Track;

/// Overlapping pairs tolerated, and more for each body drawn: a body released from rest overlaps
/// itself at the start, however far apart the rest are.
const TOLERATED: [f64; 2] = [1.0, 0.12];

/// Times a constant interval apart, seconds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Instants {
    pub times: Vec<f64>,
    pub interval: f64,
}

/// At most `most` instants from the start of the motion, the shortest round interval apart at
/// which the bodies are not `crowded`; failing that, the start and the end.
pub(super) fn instants(
    track: &Track<'_>,
    most: usize,
    crowded: impl Fn(&[f64]) -> bool,
) -> Instants {
    let (start, duration) = (track.start(), track.end() - track.start());
    if most < 2 || duration <= 0.0 {
        let times = vec![start; most.min(1)];
        return Instants {
            times,
            interval: 0.0,
        };
    }
    let mut interval = fine_above(duration / (most - 1) as f64);
    loop {
        let count = (duration / interval * (1.0 + 1e-9)) as usize + 1;
        if count <= 2 {
            let times = vec![start, track.end()];
            return Instants {
                times,
                interval: duration,
            };
        }
        let times: Vec<f64> = (0..count).map(|k| start + k as f64 * interval).collect();
        if !crowded(&times) {
            return Instants { times, interval };
        }
        interval = fine_above(1.01 * interval);
    }
}

/// Most instants of a given interval.
const MOST: usize = 256;

/// All multiples of `interval` from the start of the motion, up to a limit; the start alone for
/// an interval that is not positive.
pub(super) fn every(track: &Track<'_>, interval: f64) -> Instants {
    let steps = (track.end() - track.start()) / interval * (1.0 + 1e-9);
    let more = if interval > 0.0 {
        (steps as usize).min(MOST - 1)
    } else {
        0
    };
    let after = (1..=more).map(|k| track.start() + k as f64 * interval);
    let times = std::iter::once(track.start()).chain(after).collect();
    Instants { times, interval }
}

/// Whether more bodies overlap than a strobe picture bears.
pub(super) fn crowded(bodies: &[Hull]) -> bool {
    let met_before = |i: usize| (0..i).filter(|&j| bodies[i].meets(&bodies[j])).count();
    let pairs: usize = (0..bodies.len()).map(met_before).sum();
    pairs as f64 > TOLERATED[0] + TOLERATED[1] * bodies.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pose;

    fn poses(times: &[f64]) -> Vec<Pose> {
        let pose = |&time| Pose {
            time,
            position: [0.0, -time, 0.0],
            orientation: [0.0, 0.0, 0.0, 1.0],
        };
        times.iter().map(pose).collect()
    }

    #[test]
    fn the_interval_is_round_and_as_short_as_allowed() {
        let poses = poses(&[0.0, 3.0]);
        let track = Track::new(&poses).unwrap();
        let free = instants(&track, 31, |_| false);
        assert_eq!(free.times.len(), 31);
        assert!((free.interval - 0.1).abs() < 1e-15);
        let spaced = instants(&track, 31, |times| times[1] - times[0] < 0.45);
        assert!((spaced.interval - 0.5).abs() < 1e-15);
        assert_eq!(spaced.times.len(), 7);
    }

    #[test]
    fn a_given_interval_is_kept() {
        let poses = poses(&[1.0, 2.5]);
        let track = Track::new(&poses).unwrap();
        assert_eq!(every(&track, 0.5).times, [1.0, 1.5, 2.0, 2.5]);
        assert_eq!(every(&track, 1e-9).times.len(), MOST);
        assert_eq!(every(&track, -1.0).times, [1.0]);
        assert_eq!(every(&track, f64::NAN).times, [1.0]);
    }

    #[test]
    fn a_body_that_stays_is_drawn_at_start_and_end() {
        let poses = poses(&[1.0, 4.0]);
        let track = Track::new(&poses).unwrap();
        let ends = instants(&track, 30, |_| true);
        assert_eq!(ends.times, [1.0, 4.0]);
        assert_eq!(instants(&track, 1, |_| true).times, [1.0]);
        assert!(instants(&track, 0, |_| true).times.is_empty());
    }
}
