//! What a fall is, in numbers: does it wind, swing, turn over, roll?
//!
//! The path is smoothed first by a moving average, so that the step-to-step noise does not count as
//! motion.

use langevin_rigid::linalg::vector::{dot, norm};
use langevin_rigid::linalg::{Vec3, eigen_symmetric, rotate};
use langevin_rigid::{Body, State};
use langevin_rigid_scenes::ensemble::MotionTracker;
use std::f64::consts::{PI, TAU};

/// What is too small to count as motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    /// Width of the moving average over the path (s).
    pub(crate) window: f64,
    /// Least swing between two reversals, in lengths of the body.
    pub(crate) least_swing: f64,
}

impl Scale {
    /// For sheets of some centimetres in air.
    pub(crate) const SHEET: Self = Self {
        window: 0.1,
        least_swing: 0.25,
    };
    /// For the ellipsoid, whose flutter is faster and narrower.
    pub(crate) const ELLIPSOID: Self = Self {
        window: 0.03,
        least_swing: 0.025,
    };
}

/// The body's own directions, body frame, and its length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axes {
    /// Of the least moment of inertia.
    long: Vec3,
    /// Of the largest.
    thin: Vec3,
    /// Largest extent (m).
    length: f64,
}

impl Axes {
    pub(crate) fn new(body: &Body) -> Self {
        let (_, axes) = eigen_symmetric(&body.inertia);
        let column = |k: usize| std::array::from_fn(|i| axes[i][k]);
        Self {
            long: column(0),
            thin: column(2),
            length: body.length,
        }
    }

    /// Another direction in place of the thin axis, for bodies that have none.
    pub(crate) fn set_thin(&mut self, axis: Vec3) {
        self.thin = axis;
    }

    /// Angle of the thin axis from the vertical, as a line: 0 flat, 90 on edge (degrees).
    pub(crate) fn tilt(&self, state: &State) -> f64 {
        let up = rotate(state.orientation, self.thin)[1].abs();
        libm::acos(up.min(1.0)).to_degrees()
    }

    /// Angle of the thin axis from straight up, 0 to 180 (degrees).
    pub(crate) fn lean(&self, state: &State) -> f64 {
        let up = rotate(state.orientation, self.thin)[1];
        libm::acos(up.clamp(-1.0, 1.0)).to_degrees()
    }

    /// Elevation of the long axis (degrees), 0 to 90.
    pub(crate) fn elevation(&self, state: &State) -> f64 {
        let up = rotate(state.orientation, self.long)[1].abs();
        libm::asin(up.min(1.0)).to_degrees()
    }

    /// Angular velocity about the long axis (rad/s).
    pub(crate) fn roll(&self, state: &State) -> f64 {
        dot(self.long, state.angular_velocity)
    }
}

/// The measures of one fall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Measures {
    /// Drop over time (m/s).
    pub(crate) fall_speed: f64,
    /// Horizontal distance from release to end (m).
    pub(crate) drift: f64,
    /// Turns of the path about the vertical, left less right.
    pub(crate) turns: f64,
    /// What part of all its turning is net, 0 to 1.
    pub(crate) winding: f64,
    /// Horizontal path over net turn (m): the radius of a helix of as much path and turn.
    pub(crate) radius: f64,
    /// Drop per net turn (m).
    pub(crate) pitch: f64,
    /// Changes of direction along the path's main horizontal direction.
    pub(crate) reversals: f64,
    /// The same across it.
    pub(crate) cross_reversals: f64,
    /// Half the widest swing along the main direction (m).
    pub(crate) amplitude: f64,
    /// Revolutions of the thin axis, end over end.
    pub(crate) revolutions: f64,
    /// Net turns about the long axis.
    pub(crate) rolls: f64,
    /// The long axis' part of the mean square spin, 0 to 1.
    pub(crate) roll_share: f64,
    /// Root mean square spin (rad/s).
    pub(crate) spin: f64,
    /// Largest turn of the heading of the path (degrees).
    pub(crate) heading_turn: f64,
    /// Farthest from the vertical plane of the launch (body lengths); that of x without a launch.
    pub(crate) sideways: f64,
    /// Largest turn about the body's own z axis, nose over tail for the airplane (degrees).
    pub(crate) pitch_turn: f64,
}

/// A measure's key, its name with unit, and its value.
pub(crate) type Field = (&'static str, &'static str, fn(&Measures) -> f64);

/// All measures, in the order of the raw data.
pub(crate) const FIELDS: &[Field] = &[
    ("fall_speed", "fall speed (m/s)", |m| m.fall_speed),
    ("drift", "drift (m)", |m| m.drift),
    ("turns", "net turns about the vertical", |m| m.turns),
    ("winding", "net part of the turning", |m| m.winding),
    ("radius", "helix radius (m)", |m| m.radius),
    ("pitch", "helix pitch (m)", |m| m.pitch),
    ("reversals", "reversals, main direction", |m| m.reversals),
    ("cross_reversals", "reversals, across", |m| {
        m.cross_reversals
    }),
    ("amplitude", "half width of the swings (m)", |m| m.amplitude),
    ("revolutions", "revolutions end over end", |m| m.revolutions),
    ("rolls", "net turns about the long axis", |m| m.rolls),
    ("roll_share", "long axis' part of the spin", |m| {
        m.roll_share
    }),
    ("spin", "spin, rms (rad/s)", |m| m.spin),
    ("heading_turn", "turn of the heading (deg)", |m| {
        m.heading_turn
    }),
    ("sideways", "sideways (body lengths)", |m| m.sideways),
    ("pitch_turn", "turn nose over tail (deg)", |m| m.pitch_turn),
];

impl Measures {
    /// Of the states of a fall a constant step apart.
    pub(crate) fn new(axes: &Axes, states: &[State], scale: &Scale) -> Self {
        let (Some(first), Some(last)) = (states.first(), states.last()) else {
            return Self::default();
        };
        let duration = (last.time - first.time).max(f64::MIN_POSITIVE);
        let drop = first.position[1] - last.position[1];
        let track = smoothed(states, scale.window);
        let heading = Heading::new(&track);
        let net = heading.net.abs();
        let swings = Swings::new(&track, scale.least_swing * axes.length);
        Self {
            fall_speed: drop / duration,
            drift: libm::hypot(
                last.position[0] - first.position[0],
                last.position[2] - first.position[2],
            ),
            turns: net / TAU,
            winding: net / heading.total.max(f64::MIN_POSITIVE),
            radius: heading.path / net.max(f64::MIN_POSITIVE),
            pitch: drop * TAU / net.max(f64::MIN_POSITIVE),
            reversals: f64::from(swings.main),
            cross_reversals: f64::from(swings.across),
            amplitude: swings.amplitude,
            heading_turn: heading.range.to_degrees(),
            sideways: sideways(first, states) / axes.length,
            ..Self::of_rotation(axes, states)
        }
    }

    fn of_rotation(axes: &Axes, states: &[State]) -> Self {
        let release = &states[0];
        let mut tracker = MotionTracker::new(axes.thin, release);
        let (mut rolled, mut pitched) = (0.0, 0.0);
        let (mut low, mut high) = (0.0f64, 0.0f64);
        let (mut square, mut square_long) = (0.0f64, 0.0f64);
        for pair in states.windows(2) {
            let dt = pair[1].time - pair[0].time;
            let roll = axes.roll(&pair[1]);
            rolled += roll * dt;
            pitched += pair[1].angular_velocity[2] * dt;
            (low, high) = (low.min(pitched), high.max(pitched));
            let spin = norm(pair[1].angular_velocity);
            square += spin * spin * dt;
            square_long += roll * roll * dt;
            tracker.follow(&pair[1]);
        }
        let duration = states.last().map_or(0.0, |s| s.time - release.time);
        Self {
            revolutions: 0.5 * f64::from(tracker.turnovers()),
            rolls: rolled.abs() / TAU,
            roll_share: square_long / square.max(f64::MIN_POSITIVE),
            spin: (square / duration.max(f64::MIN_POSITIVE)).sqrt(),
            pitch_turn: (high - low).to_degrees(),
            ..Self::default()
        }
    }
}

/// The horizontal path (x, z) as the moving average over `window` (s), narrower near the ends.
fn smoothed(states: &[State], window: f64) -> Vec<[f64; 2]> {
    let n = states.len();
    let step = if n > 1 {
        states[1].time - states[0].time
    } else {
        1.0
    };
    let half = (0.5 * window / step) as usize;
    (0..n)
        .map(|i| {
            let reach = half.min(i).min(n - 1 - i);
            let window = &states[i - reach..=i + reach];
            let mean = |axis: usize| {
                window.iter().map(|s| s.position[axis]).sum::<f64>() / window.len() as f64
            };
            [mean(0), mean(2)]
        })
        .collect()
}

/// The largest distance from the vertical plane of the launch (m).
fn sideways(release: &State, states: &[State]) -> f64 {
    let [vx, _, vz] = release.world_velocity();
    let speed = libm::hypot(vx, vz);
    let [ux, uz] = if speed > 0.0 {
        [vx / speed, vz / speed]
    } else {
        [1.0, 0.0]
    };
    let off = |s: &State| {
        let (x, z) = (
            s.position[0] - release.position[0],
            s.position[2] - release.position[2],
        );
        (x * uz - z * ux).abs()
    };
    states.iter().map(off).fold(0.0, f64::max)
}

/// How the horizontal path turns.
struct Heading {
    /// Sum of its turns, and of their sizes (rad).
    net: f64,
    total: f64,
    /// Between the leftmost and the rightmost heading, wound on (rad).
    range: f64,
    /// Length of the horizontal path (m).
    path: f64,
}

impl Heading {
    fn new(track: &[[f64; 2]]) -> Self {
        let steps: Vec<[f64; 2]> = track
            .windows(2)
            .map(|w| [w[1][0] - w[0][0], w[1][1] - w[0][1]])
            .collect();
        let length = |s: &[f64; 2]| libm::hypot(s[0], s[1]);
        let path: f64 = steps.iter().map(length).sum();
        // A path that all but stands still has no heading.
        let least = 0.05 * path / steps.len().max(1) as f64;
        let mut heading = Self {
            net: 0.0,
            total: 0.0,
            range: 0.0,
            path,
        };
        let (mut low, mut high) = (0.0f64, 0.0f64);
        let mut before: Option<[f64; 2]> = None;
        for step in steps.into_iter().filter(|s| length(s) > least) {
            if let Some(b) = before {
                // World z is to the left of x seen from below: from above this turn is leftwards.
                let turn = libm::atan2(
                    b[1] * step[0] - b[0] * step[1],
                    b[0] * step[0] + b[1] * step[1],
                );
                heading.net += turn;
                heading.total += turn.abs();
                (low, high) = (low.min(heading.net), high.max(heading.net));
            }
            before = Some(step);
        }
        heading.range = high - low;
        heading
    }
}

/// Swings about the straight line from release to end, along the path's main horizontal direction and
/// across it.
struct Swings {
    main: u32,
    across: u32,
    amplitude: f64,
}

impl Swings {
    fn new(track: &[[f64; 2]], least: f64) -> Self {
        let n = track.len();
        let (start, end) = (track[0], track[n - 1]);
        let off: Vec<[f64; 2]> = track
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let w = i as f64 / (n - 1).max(1) as f64;
                std::array::from_fn(|a| p[a] - start[a] - w * (end[a] - start[a]))
            })
            .collect();
        let moment = |a: usize, b: usize| off.iter().map(|p| p[a] * p[b]).sum::<f64>();
        let (xx, zz, xz) = (moment(0, 0), moment(1, 1), moment(0, 1));
        let angle = 0.5 * libm::atan2(2.0 * xz, xx - zz);
        let along = |angle: f64| -> Vec<f64> {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            off.iter().map(|p| cos * p[0] + sin * p[1]).collect()
        };
        let (main, across) = (along(angle), along(angle + 0.5 * PI));
        let range = |v: &[f64]| {
            let low = v.iter().copied().fold(f64::INFINITY, f64::min);
            v.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
        };
        Self {
            amplitude: 0.5 * range(&main),
            main: reversals(&main, least),
            across: reversals(&across, least),
        }
    }
}

/// Turning points of a sequence that goes back by more than `least` after each.
fn reversals(values: &[f64], least: f64) -> u32 {
    let Some(first) = values.first() else {
        return 0;
    };
    let (mut low, mut high) = (*first, *first);
    let mut sense = 0.0;
    let mut count = 0;
    for &v in values {
        (low, high) = (low.min(v), high.max(v));
        let turned = if sense >= 0.0 && high - v > least {
            -1.0
        } else if sense <= 0.0 && v - low > least {
            1.0
        } else {
            continue;
        };
        count += u32::from(sense != 0.0);
        sense = turned;
        (low, high) = (v, v);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use langevin_rigid::linalg::quat_from_rotation_vector;

    const AXES: Axes = Axes {
        long: [1.0, 0.0, 0.0],
        thin: [0.0, 1.0, 0.0],
        length: 0.08,
    };

    fn states(path: impl Fn(f64) -> Vec3, roll: f64) -> Vec<State> {
        (0..=800)
            .map(|i| 0.005 * f64::from(i))
            .map(|time| State {
                time,
                position: path(time),
                orientation: quat_from_rotation_vector([roll * time, 0.0, 0.0]),
                angular_velocity: [roll, 0.0, 0.0],
                ..State::default()
            })
            .collect()
    }

    #[test]
    fn a_helix_is_measured_as_what_it_is() {
        // Radius 0.3 m, three turns in 4 s, 0.8 m/s downwards.
        let rate = 3.0 * TAU / 4.0;
        let helix = |t: f64| {
            [
                0.3 * libm::cos(rate * t),
                -0.8 * t,
                0.3 * libm::sin(rate * t),
            ]
        };
        let m = Measures::new(&AXES, &states(helix, 0.0), &Scale::SHEET);
        assert!((m.turns - 3.0).abs() < 0.02, "{m:?}");
        assert!((m.radius - 0.3).abs() < 0.01, "{m:?}");
        assert!((m.pitch - 3.2 / 3.0).abs() < 0.02, "{m:?}");
        assert!(
            m.winding > 0.95 && m.reversals >= 4.0 && m.revolutions == 0.0,
            "{m:?}"
        );
    }

    #[test]
    fn a_swing_reverses_and_does_not_wind() {
        // Along the diagonal, four full swings, with a drift.
        let swing = |t: f64| {
            let s = 0.1 * libm::sin(TAU * t);
            [s + 0.05 * t, -t, s]
        };
        let m = Measures::new(&AXES, &states(swing, 0.0), &Scale::SHEET);
        assert_eq!((m.reversals, m.cross_reversals), (8.0, 0.0), "{m:?}");
        assert!(
            m.winding < 0.2 && (m.amplitude - 0.14).abs() < 0.01,
            "{m:?}"
        );
        assert!((m.fall_speed - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_roll_turns_about_the_long_axis_and_over() {
        let m = Measures::new(&AXES, &states(|t| [0.0, -t, 0.0], TAU), &Scale::SHEET);
        assert!(
            (m.rolls - 4.0).abs() < 1e-9 && m.roll_share > 0.999,
            "{m:?}"
        );
        assert_eq!(m.revolutions, 4.0);
        assert!((m.spin - TAU).abs() < 1e-9);
    }

    #[test]
    fn small_wiggles_are_no_reversals() {
        let wiggle: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i % 2)).collect();
        assert_eq!(reversals(&wiggle, 0.02), 0);
        assert_eq!(reversals(&[0.0, 1.0, 0.0, 1.0, 0.0], 0.5), 3);
    }
}
