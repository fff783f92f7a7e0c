//! What kind of motion a fall is.

use langevin_rigid::linalg::vector::cross;
use langevin_rigid::linalg::{Vec3, eigen_symmetric, rotate};
use langevin_rigid::{Body, State};
use serde::{Deserialize, Serialize};

/// A motion, by how the body's thin axis swings and turns over.
///
/// A *turnover* is a reversal of the sign of the thin axis' vertical component, counted once it is
/// past 0.1 on the other side. A *swing* is a passage of the body through flat: the horizontal part
/// of the thin axis, pointing upwards, reverses from more than 5 degrees on one side to more than 5
/// degrees on the other, without a turnover between.
///
/// | motion | turnovers | swings |
/// |---|---|---|
/// | steady | none | at most one |
/// | flutter | none | two or more |
/// | tumble | all in the same sense | at most one more than turnovers |
/// | chaotic | all others | |
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MotionClass {
    /// It neither swings to and fro nor turns over.
    Steady,
    /// It swings to and fro.
    Flutter,
    /// It turns over and over.
    Tumble,
    /// It does both, or turns over this way and that.
    Chaotic,
}

impl MotionClass {
    /// Every motion.
    pub const ALL: [Self; 4] = [Self::Steady, Self::Flutter, Self::Tumble, Self::Chaotic];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::Flutter => "flutter",
            Self::Tumble => "tumble",
            Self::Chaotic => "chaotic",
        }
    }
}

/// The body's thin axis, body frame: that of its largest moment of inertia.
pub(crate) fn thin_axis(body: &Body) -> Vec3 {
    let (_, axes) = eigen_symmetric(&body.inertia);
    std::array::from_fn(|i| axes[i][2])
}

/// Vertical component of the thin axis that makes a turnover certain.
const TURNED: f64 = 0.1;
/// Horizontal component of the thin axis that makes a swing certain: the sine of 5 degrees.
const SWUNG: f64 = 0.087_155_742_747_658_17;

/// Follows the thin axis through a fall, state by state.
///
/// ```
/// use langevin_rigid::{State, linalg::quat_from_rotation_vector};
/// use langevin_rigid_scenes::ensemble::{MotionClass, MotionTracker};
/// let turned = |angle: f64| State {
///     orientation: quat_from_rotation_vector([angle, 0.0, 0.0]),
///     ..State::default()
/// };
/// let mut tracker = MotionTracker::new([0.0, 1.0, 0.0], &turned(0.0));
/// for i in 0..100 {
///     tracker.follow(&turned(0.1 * f64::from(i)));
/// }
/// assert_eq!((tracker.turnovers(), tracker.motion()), (3, MotionClass::Tumble));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionTracker {
    axis: Vec3,
    /// 1 or -1: the sign of the vertical component as last counted.
    side: f64,
    /// The thin axis when it was last certain to be on this side, world frame.
    before: Vec3,
    /// Its horizontal part, pointing upwards, when it last was large enough; none since a turnover.
    lean: Option<[f64; 2]>,
    /// Axis of the last turnover, world frame.
    turn: Option<Vec3>,
    sense: i32,
    turnovers: u32,
    net: i32,
    swings: u32,
}

impl MotionTracker {
    /// For a body with this thin axis (a unit vector, body frame) at its release.
    pub fn new(thin_axis: Vec3, release: &State) -> Self {
        let before = rotate(release.orientation, thin_axis);
        let mut tracker = Self {
            axis: thin_axis,
            side: 1f64.copysign(before[1]),
            before,
            lean: None,
            turn: None,
            sense: 1,
            turnovers: 0,
            net: 0,
            swings: 0,
        };
        tracker.follow(release);
        tracker
    }

    /// Takes the next state of the fall.
    pub fn follow(&mut self, state: &State) {
        self.follow_axis(rotate(state.orientation, self.axis));
    }

    /// The same from the thin axis, world frame.
    pub(crate) fn follow_axis(&mut self, axis: Vec3) {
        let upright = axis[1] * self.side;
        if upright < -TURNED {
            self.turn_over(axis);
        }
        if upright.abs() > TURNED {
            self.before = axis;
        }
        self.lean(axis.map(|x| x * self.side));
    }

    fn turn_over(&mut self, axis: Vec3) {
        let turn = cross(self.before, axis);
        if self.turn.is_some_and(|last| opposed(&last, &turn)) {
            self.sense = -self.sense;
        }
        self.turn = Some(turn);
        self.side = -self.side;
        self.lean = None;
        self.turnovers += 1;
        self.net += self.sense;
    }

    fn lean(&mut self, up: Vec3) {
        let lean = [up[0], up[2]];
        if lean[0] * lean[0] + lean[1] * lean[1] < SWUNG * SWUNG {
            return;
        }
        if let Some(last) = self.lean
            && opposed(&last, &lean)
        {
            self.swings += 1;
        }
        self.lean = Some(lean);
    }

    /// Reversals of the thin axis' vertical component.
    pub fn turnovers(&self) -> u32 {
        self.turnovers
    }

    /// Passages through flat.
    pub fn swings(&self) -> u32 {
        self.swings
    }

    /// Half-revolutions left when turnovers in opposite senses are taken off each other.
    pub fn net_turnovers(&self) -> u32 {
        self.net.unsigned_abs()
    }

    /// The motion so far.
    pub fn motion(&self) -> MotionClass {
        match (self.turnovers, self.swings) {
            (0, 0 | 1) => MotionClass::Steady,
            (0, _) => MotionClass::Flutter,
            (turns, swings) if self.net_turnovers() == turns && swings <= turns + 1 => {
                MotionClass::Tumble
            }
            _ => MotionClass::Chaotic,
        }
    }
}

/// Whether two directions are more than a quarter turn apart.
fn opposed(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() < 0.0
}
