//! Bodies that cannot go on.

use bevy_ecs::entity::Entity;
use bevy_ecs::query::{Has, Without};
use bevy_ecs::system::{Commands, Query};
use bevy_log::error;
use bevy_transform::components::Transform;

use crate::components::{AngularVelocity, Hosted, LinearVelocity, Quarantined};
use crate::stepped::Stepped;

/// Puts bodies with a fault back to where they last were, says why, and leaves them there.
pub(crate) fn quarantine(
    mut bodies: Query<
        (
            Entity,
            &mut Stepped,
            &mut Transform,
            &mut LinearVelocity,
            &mut AngularVelocity,
            Has<Hosted>,
        ),
        Without<Quarantined>,
    >,
    mut commands: Commands,
) {
    for (entity, mut stepped, mut transform, mut velocity, mut angular_velocity, hosted) in
        &mut bodies
    {
        let Some(fault) = stepped.fault.take() else {
            continue;
        };
        // Where an engine has a hosted body, it leaves it.
        if !hosted {
            stepped.restore(&mut transform, &mut velocity, &mut angular_velocity);
        }
        mark(entity, &fault, &mut commands);
    }
}

/// Quarantines an entity and says why.
pub(crate) fn mark(entity: Entity, fault: &str, commands: &mut Commands) {
    error!(
        "the body {entity} is quarantined: {fault}. It stays where it last was; mend this and remove `Quarantined`"
    );
    if let Ok(mut entity) = commands.get_entity(entity) {
        entity.try_insert(Quarantined);
    }
}
