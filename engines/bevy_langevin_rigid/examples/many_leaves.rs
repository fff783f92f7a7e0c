//! Twenty thousand leaves fall around a viewer, two thousand of them near, without a window; prints what the plugin takes
//! of a frame.
//!
//! `cargo run --release --features multi_threaded --example many_leaves`; with `gusts` behind it, in gusts.

use std::time::{Duration, Instant};

use bevy_app::{
    App, RunFixedMainLoop, RunFixedMainLoopSystems, TaskPoolOptions, TaskPoolPlugin,
    TaskPoolThreadAssignmentPolicy,
};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::wind::{GustSettings, Gusts, Wind};
use bevy_langevin_rigid::langevin_rigid::{Body, NoiseStream};
use bevy_langevin_rigid::{
    AmbientWind, BakedBody, Immersed, LangevinRigidPlugin, LangevinRigidSystems, LevelOfDetail,
    Stepped,
};
use bevy_math::{Quat, Vec3};
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::components::Transform;

/// Leaves, and between which distances from the viewer they are (m).
const RINGS: [(u32, f32, f32); 3] = [
    (2_000, 2.0, 20.0),
    (6_000, 20.0, 50.0),
    (12_000, 50.0, 90.0),
];
/// Frames that are timed, of one fixed step each, and those before them.
const TIMED: usize = 600;
const BEFORE: usize = 60;

/// When the plugin began in this frame, and what it took in all frames.
#[derive(Resource)]
struct Clock(Instant, Vec<Duration>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let leaf = BakedBody::from(Body::plate(0.08, 0.05, 0.2e-3, 450.0)?);
    let mut wind = Wind::default();
    if std::env::args().any(|argument| argument == "gusts") {
        wind.add(Gusts::new(&GustSettings {
            rms: 0.4,
            length: 3.0,
            carried: [1.0, 0.0, 0.0],
            ..GustSettings::default()
        })?)?;
    }
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin {
            task_pool_options: two_cores(),
        },
        TimePlugin,
        AssetPlugin::default(),
        LangevinRigidPlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
    .insert_resource(AmbientWind(wind))
    .insert_resource(Clock(Instant::now(), Vec::new()))
    .add_systems(
        RunFixedMainLoop,
        (
            begin.in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop),
            end.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop)
                .after(LangevinRigidSystems::Draw),
        ),
    );
    app.finish();
    app.cleanup();
    let world = app.world_mut();
    let viewer = world.spawn(Transform::default()).id();
    world.insert_resource(LevelOfDetail {
        viewer: Some(viewer),
        distances: [20.0, 50.0],
    });
    let leaf = world.resource_mut::<Assets<BakedBody>>().add(leaf);
    for (count, from, to) in RINGS {
        for leaf_number in 0..count {
            let place = scattered(leaf_number, from, to);
            world.spawn((place, Immersed::baked(leaf.clone())));
        }
    }
    for _ in 0..BEFORE + TIMED {
        app.update();
    }
    report(&mut app, viewer);
    Ok(())
}

/// Two threads for what systems share out, whatever the machine has.
fn two_cores() -> TaskPoolOptions {
    TaskPoolOptions {
        compute: TaskPoolThreadAssignmentPolicy {
            min_threads: 2,
            max_threads: 2,
            ..TaskPoolOptions::default().compute
        },
        ..TaskPoolOptions::default()
    }
}

/// A place between two distances from the origin, evenly by number, and a rotation.
fn scattered(number: u32, from: f32, to: f32) -> Transform {
    let [a, b, c, x, y, z, w, d, ..] = NoiseStream::default()
        .normals(number.into())
        .map(|n| n as f32);
    let part = (d / (1.0 + d.abs()) + 1.0) / 2.0;
    let place = (from + part * (to - from)) * Vec3::new(a, b, c).normalize();
    Transform::from_translation(place).with_rotation(Quat::from_xyzw(x, y, z, w).normalize())
}

fn begin(mut clock: ResMut<Clock>) {
    clock.0 = Instant::now();
}

fn end(mut clock: ResMut<Clock>) {
    let taken = clock.0.elapsed();
    clock.1.push(taken);
}

fn report(app: &mut App, viewer: Entity) {
    let world = app.world_mut();
    let eye = world
        .get::<Transform>(viewer)
        .map_or(Vec3::ZERO, |eye| eye.translation);
    let mut leaves = world.query::<(&Stepped, &Transform)>();
    let near = leaves
        .iter(world)
        .filter(|(_, at)| at.translation.distance(eye) < 20.0)
        .count();
    let all = leaves.iter(world).len();
    let clock = world.resource::<Clock>();
    let mut timed: Vec<f64> = clock
        .1
        .iter()
        .skip(BEFORE)
        .map(|t| 1e3 * t.as_secs_f64())
        .collect();
    timed.sort_by(f64::total_cmp);
    let at = |share: f64| timed[((timed.len() - 1) as f64 * share) as usize];
    println!("{all} leaves, {near} of them within 20 m at the end");
    println!(
        "ms a frame: median {:.2}, nine tenths below {:.2}, longest {:.2}",
        at(0.5),
        at(0.9),
        at(1.0)
    );
}
