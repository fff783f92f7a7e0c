//! The plugin, and the order of its systems.

use bevy_app::{App, FixedUpdate, Plugin, RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_langevin_rigid::LangevinRigidSystems;
use bevy_log::error;
use bevy_rapier3d::plugin::PhysicsSet;
use bevy_transform_interpolation::prelude::TransformInterpolationPlugin;
use bevy_transform_interpolation::{
    TransformEasingPlugin, reset_easing_states_on_transform_change,
};

use crate::{steps, timestep};

/// Gives bodies that are `Immersed` and have bevy_rapier's `RigidBody::Dynamic` the contacts of Rapier.
///
/// Needs `LangevinRigidPlugin`, and `RapierPhysicsPlugin` [in the fixed
/// schedule](bevy_rapier3d::plugin::RapierPhysicsPlugin::in_fixed_schedule) with a
/// [`TimestepMode`](bevy_rapier3d::plugin::TimestepMode) of the same step as `Time<Fixed>`. Where either is amiss, an error in
/// the log says so.
#[derive(Debug, Clone, Copy, Default)]
pub struct LangevinRigidRapierPlugin;

impl Plugin for LangevinRigidRapierPlugin {
    fn build(&self, app: &mut App) {
        app.configure_sets(
            FixedUpdate,
            PhysicsSet::SyncBackend.after(LangevinRigidSystems::Write),
        )
        .add_systems(
            FixedUpdate,
            (
                (steps::release, steps::host, steps::stir, steps::read)
                    .chain()
                    .after(LangevinRigidSystems::Join)
                    .before(LangevinRigidSystems::Read),
                (timestep::check, steps::hand_over)
                    .after(PhysicsSet::SyncBackend)
                    .before(PhysicsSet::StepSimulation),
                steps::take_back
                    .after(PhysicsSet::StepSimulation)
                    .before(PhysicsSet::Writeback),
            ),
        );
    }

    fn finish(&self, app: &mut App) {
        // Here, since the app may add them after this plugin.
        if !app.is_plugin_added::<TransformInterpolationPlugin>() {
            app.add_plugins(TransformInterpolationPlugin::default());
        }
        if !app.is_plugin_added::<TransformEasingPlugin>() {
            app.add_plugins(TransformEasingPlugin);
        }
        // A body that was moved since it was drawn stays there: the plugin asks this again before it draws, which is too late.
        app.add_systems(
            RunFixedMainLoop,
            reset_easing_states_on_transform_change
                .in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop),
        );
        if !timestep::is_fixed(app) {
            error!(
                "Rapier does not step in `FixedUpdate`: bodies that are `Immersed` meet nothing. Add \
                 `RapierPhysicsPlugin::<()>::default().in_fixed_schedule()`"
            );
        }
    }
}
