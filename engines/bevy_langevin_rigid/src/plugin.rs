//! The plugin, and the order of its systems.

use bevy_app::{App, FixedUpdate, Plugin, RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy_asset::{AssetApp, AssetEvent};
use bevy_ecs::message::Messages;
use bevy_ecs::schedule::common_conditions::resource_exists;
use bevy_ecs::schedule::{IntoScheduleConfigs, SystemSet};
use bevy_mesh::Mesh;

use crate::ambient::{AmbientWind, ImmersionSettings};
use crate::baked_body::{BakedBody, BakedBodyLoader};
use crate::baking::Bakes;
use crate::components::NextNumber;
use crate::steppers::Steppers;
use crate::{baking, draw, join, quarantine, steppers, steps};

/// Moves bodies that are [`Immersed`](crate::Immersed).
///
/// Needs what `DefaultPlugins` adds: `AssetPlugin`, `TimePlugin` and `TaskPoolPlugin`, before it; and `MeshPlugin` for
/// bodies that are baked from their meshes.
#[derive(Debug, Clone, Copy, Default)]
pub struct LangevinRigidPlugin;

/// The systems of the plugin, in their order.
#[derive(SystemSet, Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LangevinRigidSystems {
    /// In `FixedUpdate`: meshes are baked, and bodies join whose shape is ready.
    Join,
    /// In `FixedUpdate`: what the game has changed since the last step (`Transform`s and velocities) is read.
    Read,
    /// In `FixedUpdate`: all bodies step.
    Step,
    /// In `FixedUpdate`: velocities are written, and bodies that cannot go on are quarantined.
    Write,
    /// In `RunFixedMainLoop`, after the fixed steps of the frame: `Transform`s are drawn between the last two of them.
    Draw,
}

impl Plugin for LangevinRigidPlugin {
    fn build(&self, app: &mut App) {
        use LangevinRigidSystems::{Draw, Join, Read, Step, Write};
        app.init_asset::<BakedBody>()
            .init_asset_loader::<BakedBodyLoader>()
            .init_resource::<ImmersionSettings>()
            .init_resource::<AmbientWind>()
            .init_resource::<Bakes>()
            .init_resource::<NextNumber>()
            .init_resource::<Steppers>()
            .register_type::<crate::Immersed>()
            .register_type::<crate::LinearVelocity>()
            .register_type::<crate::AngularVelocity>()
            .register_type::<crate::ExternalWrench>()
            .register_type::<crate::Hosted>()
            .register_type::<crate::Quarantined>()
            .configure_sets(FixedUpdate, (Join, Read, Step, Write).chain())
            .configure_sets(
                RunFixedMainLoop,
                Draw.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop),
            )
            .add_systems(
                FixedUpdate,
                (
                    (
                        steppers::renew,
                        baking::forget_changed_meshes
                            .run_if(resource_exists::<Messages<AssetEvent<Mesh>>>),
                        baking::finish,
                        join::leave,
                        join::join,
                    )
                        .chain()
                        .in_set(Join),
                    (steps::come_to_rest_in_hand, steps::read)
                        .chain()
                        .in_set(Read),
                    steps::step.in_set(Step),
                    (steps::write, quarantine::quarantine).chain().in_set(Write),
                ),
            )
            .add_systems(
                RunFixedMainLoop,
                (draw::draw, quarantine::quarantine).chain().in_set(Draw),
            );
    }
}
