//! The plugin, and the order of its systems.

use avian3d::prelude::PhysicsSystems;
use bevy_app::{App, FixedPostUpdate, FixedUpdate, Plugin};
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_langevin_rigid::LangevinRigidSystems;

use crate::steps;

/// Gives bodies that are `Immersed` and have Avian's `RigidBody::Dynamic` the contacts of Avian.
///
/// Needs `PhysicsPlugins` in `FixedPostUpdate`, its default, and `LangevinRigidPlugin`.
#[derive(Debug, Clone, Copy, Default)]
pub struct LangevinRigidAvianPlugin;

impl Plugin for LangevinRigidAvianPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(
            FixedUpdate,
            (
                (steps::host, steps::stir, steps::read)
                    .chain()
                    .after(LangevinRigidSystems::Join)
                    .before(LangevinRigidSystems::Read),
                steps::hand_over.after(LangevinRigidSystems::Write),
            ),
        )
        .add_systems(
            FixedPostUpdate,
            steps::take_back
                .after(PhysicsSystems::StepSimulation)
                .before(PhysicsSystems::Writeback),
        );
    }
}
