//! Wind, currents and wrenches wake what they would move.

use avian3d::prelude::{Sleeping, WakeBody};
use bevy_ecs::entity::Entity;
use bevy_ecs::query::With;
use bevy_ecs::system::{Commands, Local, Query};
use bevy_langevin_rigid::{BodyLoads, ExternalWrench, Hosted, Stepped};

/// Share of its weight in the fluid by which the fluid and the wrench must push a sleeping body to wake it.
pub const STIRRING: f64 = 0.3;

/// Fixed steps between two looks at a sleeping body.
const LOOKS: u32 = 8;

/// Wakes bodies that sleep where they would be moved. Looks at each now and then.
pub(crate) fn stir(
    bodies: Query<(Entity, &Stepped, &ExternalWrench), (With<Sleeping>, With<Hosted>)>,
    loads: BodyLoads,
    mut step: Local<u32>,
    mut commands: Commands,
) {
    *step = (*step + 1) % LOOKS;
    for (number, (entity, stepped, wrench)) in (*step..).zip(&bodies) {
        if !number.is_multiple_of(LOOKS) || loads.is_calm(stepped, wrench) {
            continue;
        }
        let loads = loads.of(stepped, wrench);
        if loads.is_some_and(|loads| loads.push_to_weight() > STIRRING) {
            commands.queue(WakeBody(entity));
        }
    }
}
