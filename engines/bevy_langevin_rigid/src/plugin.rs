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
use crate::detail::LevelOfDetail;
use crate::faults::Faults;
use crate::regions::Surroundings;
use crate::shedding::{DropLeaves, LeafLimit, Shedding};
use crate::steppers::Steppers;
use crate::steps::Ticks;
use crate::{baking, draw, join, quarantine, regions, shedding, steppers, steps, winds};

/// Moves bodies that are [`Immersed`](crate::Immersed).
///
/// Needs what `DefaultPlugins` adds: `AssetPlugin`, `TimePlugin` and `TaskPoolPlugin`, before it; and `MeshPlugin` for
/// bodies that are baked from their meshes.
#[derive(Debug, Clone, Copy, Default)]
pub struct LangevinRigidPlugin;

/// The systems of the plugin, in their order.
#[derive(SystemSet, Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LangevinRigidSystems {
    /// In `FixedUpdate`: trees shed leaves.
    Shed,
    /// In `FixedUpdate`: fluid regions and fans are found, meshes are baked, and bodies join whose shape is ready.
    Join,
    /// In `FixedUpdate`: what the game has changed since the last step (`Transform`s and velocities) is read; bodies that
    /// were given impossible numbers are quarantined.
    Read,
    /// In `FixedUpdate`: all bodies step, and their velocities are written.
    Step,
    /// In `FixedUpdate`: bodies that could not step are quarantined.
    Write,
    /// In `RunFixedMainLoop`, after the fixed steps of the frame: `Transform`s are drawn between the last two of them.
    Draw,
}

impl Plugin for LangevinRigidPlugin {
    fn build(&self, app: &mut App) {
        use LangevinRigidSystems::{Draw, Join, Read, Shed, Step, Write};
        app.init_asset::<BakedBody>()
            .init_asset_loader::<BakedBodyLoader>()
            .init_resource::<ImmersionSettings>()
            .init_resource::<AmbientWind>()
            .init_resource::<Bakes>()
            .init_resource::<NextNumber>()
            .init_resource::<Steppers>()
            .init_resource::<Faults>()
            .init_resource::<Ticks>()
            .init_resource::<Surroundings>()
            .init_resource::<Shedding>()
            .init_resource::<LevelOfDetail>()
            .register_type::<LevelOfDetail>()
            .init_resource::<LeafLimit>()
            .add_message::<DropLeaves>()
            .register_type::<crate::Fan>()
            .register_type::<crate::Crown>()
            .register_type::<crate::LeavesShed>()
            .register_type::<crate::ShedFrom>()
            .register_type::<crate::LeafLimit>()
            .register_type::<crate::Immersed>()
            .register_type::<crate::LinearVelocity>()
            .register_type::<crate::AngularVelocity>()
            .register_type::<crate::ExternalWrench>()
            .register_type::<crate::Hosted>()
            .register_type::<crate::Quarantined>()
            .configure_sets(FixedUpdate, (Shed, Join, Read, Step, Write).chain())
            .configure_sets(
                RunFixedMainLoop,
                Draw.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop),
            )
            .add_systems(
                FixedUpdate,
                (
                    (shedding::receive, shedding::shed).chain().in_set(Shed),
                    (
                        regions::survey,
                        winds::survey,
                        steppers::renew,
                        baking::forget_changed_meshes
                            .run_if(resource_exists::<Messages<AssetEvent<Mesh>>>),
                        baking::finish,
                        join::leave,
                        join::join,
                    )
                        .chain()
                        .in_set(Join),
                    (
                        steps::come_to_rest_in_hand,
                        steps::read,
                        quarantine::quarantine,
                    )
                        .chain()
                        .in_set(Read),
                    steps::step.in_set(Step),
                    quarantine::quarantine.in_set(Write),
                ),
            )
            .add_systems(
                RunFixedMainLoop,
                (draw::draw, quarantine::quarantine).chain().in_set(Draw),
            );
    }
}
