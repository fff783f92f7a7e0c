//! Bodies that cannot go on.

use bevy_ecs::entity::Entity;
use bevy_ecs::query::Has;
use bevy_ecs::system::{Commands, Query, ResMut};
use bevy_log::error;
use bevy_transform::components::Transform;

use crate::components::{AngularVelocity, Hosted, LinearVelocity, Quarantined};
use crate::drawn::Drawn;
use crate::faults::Faults;
use crate::stepped::Stepped;

/// Puts bodies with a fault back to where they last were, says why, and leaves them there.
pub(crate) fn quarantine(
    mut faults: ResMut<Faults>,
    mut bodies: Query<(
        &Stepped,
        &Drawn,
        &mut Transform,
        &mut LinearVelocity,
        &mut AngularVelocity,
        Has<Hosted>,
    )>,
    mut commands: Commands,
) {
    for (entity, fault) in faults.take() {
        let Ok((stepped, drawn, mut transform, mut velocity, mut angular_velocity, hosted)) =
            bodies.get_mut(entity)
        else {
            continue;
        };
        // Where an engine has a hosted body, it leaves it.
        if !hosted {
            drawn.restore(&mut transform);
            (*velocity, *angular_velocity) = stepped.written;
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
