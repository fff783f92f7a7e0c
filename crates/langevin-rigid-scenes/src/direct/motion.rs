//! Primitive motions, told from the path of the centre of mass and the turning of the body.

use langevin_rigid::State;
use serde::Serialize;

use super::glimpses::Glimpse;
use crate::ensemble::{MotionClass, MotionTracker};

/// A motion that a fall, or a stretch of it, can be asked to have.
///
/// The first four are those of [`MotionClass`]. A body that does not turn over is on a *helix* where its centre of mass
/// goes round, once at least and as on a circle, at a radius of its largest half extent or more. A body is on a *spiral*
/// where it turns about the vertical itself, once at least and once for two swings or turnovers, as a maple seed does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// It neither swings to and fro nor turns over.
    Steady,
    /// It swings to and fro.
    Flutter,
    /// It turns over and over.
    Tumble,
    /// It does both, or turns over this way and that.
    Chaotic,
    /// Its centre of mass goes round.
    Helix,
    /// It turns about the vertical.
    Spiral,
}

impl Motion {
    /// Every motion.
    pub const ALL: [Self; 6] = [
        Self::Steady,
        Self::Flutter,
        Self::Tumble,
        Self::Chaotic,
        Self::Helix,
        Self::Spiral,
    ];

    /// Most motions that can be asked to follow each other.
    pub(crate) const MOST: usize = 4;

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::Flutter => "flutter",
            Self::Tumble => "tumble",
            Self::Chaotic => "chaotic",
            Self::Helix => "helix",
            Self::Spiral => "spiral",
        }
    }
}

/// How much of the turning is in one sense at least, of what counts as turning.
const ONE_SENSE: f64 = 0.8;
/// How narrow an ellipse of velocities counts as a circle: its smaller mean square by the larger.
const ROUND: f64 = 0.2;
/// Mean times between two swings or turnovers that may go by before the first and after the last.
const IDLE: f64 = 2.0;
/// Pieces that a fall is cut into, at the ends of which a motion may give way to the next.
const PIECES: usize = 24;
/// Fewest of them that make a motion.
const FEWEST: usize = 4;
/// Share of a fall that may be of none of the motions that are asked.
const OF_NONE: f64 = 0.2;

/// The motion of a body over a stretch of its fall; `size` is its largest half extent (m).
pub(super) fn motion(stretch: &[Glimpse], size: f64) -> Motion {
    let tracker = tracked(stretch, |_| ());
    if tracker.turnovers() == 0 && goes_round(stretch, size) {
        return Motion::Helix;
    }
    let pairs = stretch.windows(2);
    let turns = turns(pairs.map(|pair| pair[1].heading - pair[0].heading));
    if turns >= 1.0 && 2.0 * turns >= f64::from(tracker.swings() + tracker.turnovers()) {
        return Motion::Spiral;
    }
    match tracker.motion() {
        MotionClass::Steady => Motion::Steady,
        MotionClass::Flutter => Motion::Flutter,
        MotionClass::Tumble => Motion::Tumble,
        MotionClass::Chaotic => Motion::Chaotic,
    }
}

/// How the thin axis swings and turns over; `event` hears of the glimpses at which it does.
fn tracked(stretch: &[Glimpse], mut event: impl FnMut(usize)) -> MotionTracker {
    let first = stretch.first().map_or([0.0, 1.0, 0.0], |first| first.axis);
    // The glimpses have the axis in the world already.
    let mut tracker = MotionTracker::new(first, &State::default());
    let mut events = 0;
    for (place, glimpse) in stretch.iter().enumerate() {
        tracker.follow_axis(glimpse.axis);
        let now = tracker.swings() + tracker.turnovers();
        if now > events {
            event(place);
        }
        events = now;
    }
    tracker
}

/// Whether a stretch has a motion from its beginning to its end: what swings or turns over does so all the time.
fn has(stretch: &[Glimpse], size: f64, wanted: Motion) -> bool {
    if motion(stretch, size) != wanted {
        return false;
    }
    if matches!(wanted, Motion::Steady | Motion::Helix | Motion::Spiral) {
        return true;
    }
    let mut events = Vec::new();
    tracked(stretch, |place| events.push(place));
    let (Some(&first), Some(&last)) = (events.first(), events.last()) else {
        return false;
    };
    let patience = match events.len() {
        1 => 0.5 * stretch.len() as f64,
        more => IDLE * (last - first) as f64 / (more - 1) as f64,
    };
    first as f64 <= patience && (stretch.len() - last) as f64 <= patience
}

/// Turns in one sense; none if they are in both.
fn turns(angles: impl Iterator<Item = f64>) -> f64 {
    let (net, all) = angles.fold((0.0f64, 0.0), |(net, all), angle| {
        (net + angle, all + angle.abs())
    });
    match net.abs() >= ONE_SENSE * all {
        true => net.abs() / std::f64::consts::TAU,
        false => 0.0,
    }
}

/// Whether the centre of mass goes round as on a circle, apart from its drift.
fn goes_round(stretch: &[Glimpse], size: f64) -> bool {
    let steps = stretch
        .windows(2)
        .filter(|pair| pair[1].time > pair[0].time);
    let velocities: Vec<[f64; 2]> = steps
        .map(|pair| {
            let per = 1.0 / (pair[1].time - pair[0].time);
            [0, 2].map(|i| per * (pair[1].position[i] - pair[0].position[i]))
        })
        .collect();
    let number = velocities.len().max(1) as f64;
    let drift = [0, 1].map(|i| velocities.iter().map(|v| v[i]).sum::<f64>() / number);
    let rest: Vec<[f64; 2]> = velocities
        .iter()
        .map(|v| [v[0] - drift[0], v[1] - drift[1]])
        .collect();
    let mean = |of: fn(&[f64; 2]) -> f64| rest.iter().map(of).sum::<f64>() / number;
    let (xx, zz, xz) = (
        mean(|v| v[0] * v[0]),
        mean(|v| v[1] * v[1]),
        mean(|v| v[0] * v[1]),
    );
    let (middle, half) = (
        0.5 * (xx + zz),
        (0.25 * (xx - zz) * (xx - zz) + xz * xz).sqrt(),
    );
    if middle - half < ROUND * (middle + half) {
        return false;
    }
    let turns = turns(rest.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
    }));
    let seconds = match (stretch.first(), stretch.last()) {
        (Some(first), Some(last)) => last.time - first.time,
        _ => 0.0,
    };
    // The speed over the rate of turning.
    let radius = (xx + zz).sqrt() * seconds / (std::f64::consts::TAU * turns);
    turns >= 1.0 && radius >= size
}

/// How far a fall is from having the motions `wanted`, one after the other, in units of the tolerance: by the share of its
/// time that is of none of them, cut where that is least. Where one is not there at all it is farther than the tolerance.
pub(super) fn miss(wanted: &[Motion], seen: &[Glimpse], size: f64) -> f64 {
    let place = |piece: usize| piece * seen.len() / PIECES;
    let right = |from, to, wanted| has(&seen[place(from)..place(to)], size, wanted);
    // Up to each piece: how many of the motions so far are there, and on how many pieces.
    let mut most = [(0usize, 0usize); PIECES + 1];
    for &wanted in wanted {
        let mut next = most;
        for end in FEWEST..=PIECES {
            for from in 0..=end - FEWEST {
                let (there, pieces) = most[from];
                let with = (there + 1, pieces + end - from);
                if with > next[end] && right(from, end, wanted) {
                    next[end] = with;
                }
            }
            next[end] = next[end].max(next[end - 1]);
        }
        most = next;
    }
    let (there, pieces) = most[PIECES];
    let of_none = (1.0 - pieces as f64 / PIECES as f64) / OF_NONE;
    match wanted.len() - there {
        0 => of_none,
        missing => 1.0 + of_none + missing as f64,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;

    const SIZE: f64 = 0.04;

    /// A fall of three seconds whose place, tilt about z and heading are functions of time.
    fn fall(at: impl Fn(f64) -> ([f64; 2], f64, f64)) -> Vec<Glimpse> {
        let glimpse = |number: u32| {
            let time = f64::from(number) / 60.0;
            let ([x, z], tilt, heading) = at(time);
            Glimpse {
                time,
                position: [x, 3.0 - time, z],
                axis: [-tilt.sin(), tilt.cos(), 0.0],
                heading,
            }
        };
        (0..=180).map(glimpse).collect()
    }

    fn swing(time: f64) -> f64 {
        0.5 * (TAU * 1.5 * time).sin()
    }

    #[test]
    fn synthetic_falls_are_what_they_were_made_as() {
        let straight = fall(|t| ([0.1 * t, 0.0], 0.02, 0.0));
        assert_eq!(motion(&straight, SIZE), Motion::Steady);
        let swings = fall(|t| ([0.2 * (TAU * 1.5 * t).cos(), 0.0], swing(t), 0.1 * t));
        assert_eq!(motion(&swings, SIZE), Motion::Flutter);
        let tumbles = fall(|t| ([0.5 * t, 0.0], 2.0 * PI * 2.0 * t, 0.0));
        assert_eq!(motion(&tumbles, SIZE), Motion::Tumble);
        let circle = |t: f64| [0.1 * (TAU * t).cos() + 0.2 * t, 0.1 * (TAU * t).sin()];
        assert_eq!(
            motion(&fall(|t| (circle(t), 0.2, 0.0)), SIZE),
            Motion::Helix
        );
        let small = |t: f64| circle(t).map(|x| 0.1 * x);
        assert_eq!(
            motion(&fall(|t| (small(t), 0.2, 0.0)), SIZE),
            Motion::Steady
        );
        let seed = fall(|t| (small(t), 0.2, -9.0 * t));
        assert_eq!(motion(&seed, SIZE), Motion::Spiral);
        let to_and_fro = fall(|t| ([0.0; 2], 0.2, 9.0 * (3.0 * t).sin()));
        assert_eq!(motion(&to_and_fro, SIZE), Motion::Steady);
    }

    #[test]
    fn motions_that_follow_each_other_are_told_apart() {
        let seen = fall(|t| match t < 1.5 {
            true => ([0.0, 0.0], 0.0, 0.0),
            false => ([0.2 * swing(t), 0.0], swing(t), 0.0),
        });
        let miss = |wanted: &[Motion]| miss(wanted, &seen, SIZE);
        assert!(miss(&[Motion::Steady, Motion::Flutter]) < 0.3);
        // A third of the time or more is of no flutter.
        assert!((1.1..3.0).contains(&miss(&[Motion::Flutter])));
        assert!(miss(&[Motion::Tumble]) > 6.0);
        assert!(miss(&[Motion::Tumble, Motion::Flutter]) > 2.0);
        assert!(miss(&[Motion::Flutter, Motion::Steady]) > 1.0);
    }
}
