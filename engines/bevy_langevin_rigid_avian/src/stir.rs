//! Wind and wrenches wake what they would move.

use avian3d::prelude::{Sleeping, WakeBody};
use bevy_ecs::entity::Entity;
use bevy_ecs::query::With;
use bevy_ecs::system::{Commands, Query, Res};
use bevy_langevin_rigid::langevin_rigid::{Input, Wrench};
use bevy_langevin_rigid::{AmbientWind, ExternalWrench, Hosted, ImmersionSettings, Stepped};
use bevy_math::DVec3;
use bevy_time::{Fixed, Time};

/// Share of its weight in the fluid by which the fluid and the wrench must push a sleeping body to wake it.
pub const STIRRING: f64 = 0.3;

/// Wakes bodies that sleep in a wind that would move them.
pub(crate) fn stir(
    time: Res<Time<Fixed>>,
    wind: Res<AmbientWind>,
    settings: Res<ImmersionSettings>,
    bodies: Query<(Entity, &Stepped, &ExternalWrench), (With<Sleeping>, With<Hosted>)>,
    mut commands: Commands,
) {
    for (entity, stepped, wrench) in &bodies {
        let still = wind.0.is_empty() && *wrench == ExternalWrench::default();
        let Some(stepper) = stepped.stepper().filter(|_| !still) else {
            continue;
        };
        let position = stepped.state().position;
        let input = Input {
            flow: wind
                .0
                .flow(position, time.elapsed_secs_f64(), settings.fluid.velocity),
            wrench: Wrench {
                force: wrench.force.as_dvec3().to_array(),
                torque: wrench.torque.as_dvec3().to_array(),
            },
            ..Input::default()
        };
        let loads = stepper.loads(stepped.state(), &input);
        let held = DVec3::from(loads.weight.force) + DVec3::from(loads.buoyancy.force);
        let pushed = [
            loads.drag.force,
            loads.normal_force.force,
            loads.rotational_lift.force,
            loads.friction.force,
            loads.fluid_acceleration.force,
            loads.outside.force,
        ];
        let pushed: DVec3 = pushed.map(DVec3::from).into_iter().sum();
        if pushed.length() > STIRRING * held.length() {
            commands.queue(WakeBody(entity));
        }
    }
}
