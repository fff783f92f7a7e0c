//! What Rapier was last given of a body.

use bevy_ecs::component::Component;
use bevy_rapier3d::dynamics::Velocity;
use bevy_rapier3d::rapier::dynamics::RigidBody;
use bevy_rapier3d::rapier::math::Pose;

/// Pose and velocities as Rapier has them; whatever differs later, contacts or the game have changed.
#[derive(Component, Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Handed {
    pub(crate) pose: Pose,
    pub(crate) velocity: Velocity,
    /// Whether these are the velocities of a step that Rapier is to take.
    pub(crate) flies: bool,
}

impl Handed {
    pub(crate) fn of(body: &RigidBody) -> Self {
        Self {
            pose: *body.position(),
            velocity: Velocity {
                linear: body.linvel(),
                angular: body.angvel(),
            },
            flies: false,
        }
    }
}
