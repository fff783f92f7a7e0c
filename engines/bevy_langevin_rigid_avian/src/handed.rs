//! What Avian was last given of a body.

use avian3d::prelude::{AngularVelocity, LinearVelocity, Position, Rotation};
use bevy_ecs::component::Component;

/// Pose and velocities as Avian has them; whatever differs later, contacts or the game have changed.
#[derive(Component, Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Handed {
    pub(crate) position: Position,
    pub(crate) rotation: Rotation,
    pub(crate) velocity: LinearVelocity,
    pub(crate) spin: AngularVelocity,
    /// Whether these are the velocities of a step that Avian is to take.
    pub(crate) flies: bool,
}

impl Handed {
    pub(crate) fn is_moved(
        &self,
        position: &Position,
        rotation: &Rotation,
        velocity: &LinearVelocity,
        spin: &AngularVelocity,
    ) -> bool {
        self.position != *position
            || self.rotation != *rotation
            || self.is_accelerated(velocity, spin)
    }

    pub(crate) fn is_accelerated(&self, velocity: &LinearVelocity, spin: &AngularVelocity) -> bool {
        self.velocity != *velocity || self.spin != *spin
    }
}
