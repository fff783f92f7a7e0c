//! Between Avian's components and ours.

use avian3d::prelude::{AngularVelocity, LinearVelocity, Position, Rotation};
use bevy_langevin_rigid::Motion;

/// How Avian has a body.
pub(crate) fn motion(
    position: &Position,
    rotation: &Rotation,
    v: &LinearVelocity,
    omega: &AngularVelocity,
) -> Motion {
    Motion {
        translation: position.0,
        rotation: rotation.0,
        velocity: v.0,
        angular_velocity: omega.0,
    }
}
