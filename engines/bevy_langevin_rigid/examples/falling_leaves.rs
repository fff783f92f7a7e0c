//! Ten leaves fall through a breeze, without a window; prints where they are, twice a second.

use std::time::Duration;

use bevy_app::{App, AppExit, FixedUpdate, ScheduleRunnerPlugin, Startup, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::Body;
use bevy_langevin_rigid::langevin_rigid::wind::{GustSettings, Gusts, Wind};
use bevy_langevin_rigid::{
    AmbientWind, BakedBody, Immersed, LangevinRigidPlugin, LangevinRigidSystems, Stepped,
};
use bevy_math::Quat;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::components::Transform;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut breeze = Wind::default();
    breeze.add(Gusts::new(&GustSettings {
        rms: 0.3,
        length: 2.0,
        carried: [1.0, 0.0, 0.0],
        ..GustSettings::default()
    })?)?;
    // 8 cm by 5 cm, 0.2 mm thick, 450 kg/m^3.
    let leaf = BakedBody::from(Body::plate(0.08, 0.05, 0.2e-3, 450.0)?);
    App::new()
        .add_plugins((
            TaskPoolPlugin::default(),
            TimePlugin,
            AssetPlugin::default(),
            ScheduleRunnerPlugin::run_loop(Duration::ZERO),
            LangevinRigidPlugin,
        ))
        // One fixed step a frame, as fast as they can be taken.
        .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
        .insert_resource(AmbientWind(breeze))
        .add_systems(
            Startup,
            move |mut commands: Commands, mut bodies: ResMut<Assets<BakedBody>>| {
                let leaf = bodies.add(leaf.clone());
                for number in 0..10u8 {
                    let place = Transform::from_xyz(0.3 * f32::from(number), 2.0, 0.0)
                        .with_rotation(Quat::from_rotation_z(0.1 * f32::from(number)));
                    commands.spawn((place, Immersed::baked(leaf.clone())));
                }
            },
        )
        .add_systems(FixedUpdate, tell.after(LangevinRigidSystems::Write))
        .run();
    Ok(())
}

fn tell(time: Res<Time<Fixed>>, leaves: Query<&Stepped>, mut exit: MessageWriter<AppExit>) {
    let Some(steps) = leaves.iter().map(|leaf| leaf.state().step).max() else {
        return;
    };
    if steps.is_multiple_of(32) {
        println!("{:.1} s", time.elapsed_secs());
        for leaf in &leaves {
            println!("  {:.2?} m", leaf.state().position);
        }
    }
    if leaves.iter().all(|leaf| leaf.state().position[1] < 0.0) {
        exit.write(AppExit::Success);
    }
}
