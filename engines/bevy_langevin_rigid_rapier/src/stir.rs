//! Wind, currents and wrenches wake what they would move.

use bevy_ecs::query::With;
use bevy_ecs::system::{Local, Query};
use bevy_langevin_rigid::{BodyLoads, ExternalWrench, Hosted, Stepped};
use bevy_rapier3d::dynamics::Sleeping;

/// Share of its weight in the fluid by which the fluid and the wrench must push a sleeping body to wake it.
pub const STIRRING: f64 = 0.3;

/// Fixed steps between two looks at a sleeping body.
const LOOKS: u32 = 8;

/// Wakes bodies that sleep where they would be moved. Looks at each now and then.
pub(crate) fn stir(
    mut bodies: Query<(&Stepped, &ExternalWrench, &mut Sleeping), With<Hosted>>,
    loads: BodyLoads,
    mut step: Local<u32>,
) {
    *step = (*step + 1) % LOOKS;
    for (number, (stepped, wrench, mut sleeping)) in (*step..).zip(&mut bodies) {
        let seen = sleeping.sleeping && number.is_multiple_of(LOOKS);
        if !seen || loads.is_calm(stepped, wrench) {
            continue;
        }
        let loads = loads.of(stepped, wrench);
        if loads.is_some_and(|loads| loads.push_to_weight() > STIRRING) {
            sleeping.sleeping = false;
        }
    }
}
