//! Bodies that have come to rest are let be until something disturbs them.
//!
//! At rest is what stays near one pose for a while, whatever its momentary speed: contacts jitter. A body that leaves its
//! pose stirs those that slept against it.

use langevin_rigid::State;
use langevin_rigid::linalg::vector::{norm, sub};
use langevin_rigid::linalg::{Quat, Vec3};

/// How long a body stays near a pose before it sleeps (s).
const DROWSY: f64 = 0.5;
/// How long it waits for an overlap to be mended before it sleeps in it (s).
const PATIENT: f64 = 5.0;
/// How near, in its radii.
const NEAR: f64 = 0.01;
/// How far a body goes until it wakes those that sleep against it, in its radii.
const FAR: f64 = 0.04;

/// Where a body was.
#[derive(Debug, Clone, Copy)]
struct Pose {
    position: Vec3,
    orientation: Quat,
}

impl Pose {
    fn of(state: &State) -> Self {
        Self {
            position: state.position,
            orientation: state.orientation,
        }
    }

    /// How far the farthest point of the body is from where it was, at most (m).
    fn away(&self, state: &State, radius: f64) -> f64 {
        let pairs = self.orientation.iter().zip(state.orientation);
        let same: f64 = pairs.map(|(a, b)| a * b).sum();
        // The chord between two unit quaternions is half the angle, where it is small.
        let angle = 2.0 * (2.0 - 2.0 * same.abs()).max(0.0).sqrt();
        norm(sub(state.position, self.position)) + radius * angle
    }
}

/// Rest of one body.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rest {
    /// The pose that it stays near.
    pose: Option<Pose>,
    /// Where it last stirred others.
    stirred: Option<Pose>,
    /// How long it has been near its pose (s).
    still: f64,
    /// What it sleeps on, while it does.
    asleep: Option<Bed>,
}

/// What a body touched when it fell asleep.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bed {
    /// Bodies.
    pub(crate) against: Vec<u32>,
    /// Impulses of all contacts in a step (N s).
    pub(crate) pressed: f64,
    /// Whether it is too far in one of them to be let be.
    pub(crate) is_deep: bool,
}

impl Rest {
    pub(crate) fn is_asleep(&self) -> bool {
        self.asleep.is_some()
    }

    pub(crate) fn wake(&mut self) {
        (self.still, self.asleep) = (0.0, None);
    }

    /// Follows a body that is awake over a step; whether it has gone so far that it stirs others.
    pub(crate) fn stirs(&mut self, state: &State, radius: f64, dt: f64) -> bool {
        let within = |pose: &Option<Pose>, limit: f64| {
            pose.is_some_and(|pose| pose.away(state, radius) < limit * radius)
        };
        if within(&self.pose, NEAR) {
            self.still += dt;
        } else {
            (self.pose, self.still) = (Some(Pose::of(state)), 0.0);
        }
        let far = !within(&self.stirred, FAR);
        if far {
            self.stirred = Some(Pose::of(state));
        }
        far
    }

    /// Whether it is time to sleep in this bed.
    pub(crate) fn is_drowsy(&self, bed: &Bed) -> bool {
        self.still >= if bed.is_deep { PATIENT } else { DROWSY }
    }

    /// Whether it has stayed near one pose for so long (s).
    pub(crate) fn is_still(&self, time: f64) -> bool {
        self.is_asleep() || self.still >= time
    }

    /// Falls asleep.
    pub(crate) fn sleep(&mut self, bed: Bed) {
        self.asleep = Some(bed);
    }

    /// Impulses of its contacts when it fell asleep (N s).
    pub(crate) fn pressed(&self) -> f64 {
        self.asleep.as_ref().map_or(0.0, |bed| bed.pressed)
    }

    /// Whether it sleeps against one of those that have stirred.
    pub(crate) fn is_stirred_by(&self, stirred: &[bool]) -> bool {
        let mut against = self.asleep.iter().flat_map(|bed| &bed.against);
        against.any(|body| stirred[*body as usize])
    }
}

/// A speed (m/s) that disturbs the rest of a body of this radius (m): what it gains in falling by so much of it, and
/// without weight what takes it so far before it would fall asleep.
pub(crate) fn disturbing(radius: f64, gravity: f64) -> f64 {
    (2.0 * NEAR * gravity * radius)
        .sqrt()
        .max(NEAR * radius / DROWSY)
}

/// Speed of the fastest point of a body, at most (m/s).
pub(crate) fn fastest(state: &State, radius: f64) -> f64 {
    norm(state.velocity) + norm(state.angular_velocity) * radius
}
