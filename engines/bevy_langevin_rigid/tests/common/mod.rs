//! An app without a window.
#![allow(dead_code, unreachable_pub, missing_docs)]

pub mod log;

use std::time::{Duration, Instant};

use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets, Handle};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::{Body, State};
use bevy_langevin_rigid::{BakedBody, LangevinRigidPlugin, Stepped};
use bevy_mesh::MeshPlugin;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::components::Transform;

/// An app that takes one fixed step a frame from its second frame on.
pub fn app() -> App {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        TimePlugin,
        AssetPlugin::default(),
        MeshPlugin,
        LangevinRigidPlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
    app.finish();
    app.cleanup();
    app.update();
    app
}

/// A sheet of A6 paper.
pub fn sheet(app: &mut App) -> Handle<BakedBody> {
    asset(app, Body::plate(0.148, 0.105, 1e-4, 750.0).unwrap())
}

/// A body that the library makes, as an asset.
pub fn asset(app: &mut App, body: Body) -> Handle<BakedBody> {
    app.world_mut()
        .resource_mut::<Assets<BakedBody>>()
        .add(body)
}

pub fn at_height(y: f32) -> Transform {
    Transform::from_xyz(0.0, y, 0.0)
}

/// Frames of `app` until `done`; fails after half a minute.
pub fn until(app: &mut App, done: impl Fn(&World) -> bool) {
    let start = Instant::now();
    while !done(app.world()) {
        assert!(start.elapsed() < Duration::from_secs(30), "it never came");
        app.update();
        std::thread::sleep(Duration::from_millis(1));
    }
}

pub fn joined(world: &World, entity: Entity) -> bool {
    world.get::<Stepped>(entity).is_some()
}

pub fn state(app: &App, entity: Entity) -> State {
    *app.world().get::<Stepped>(entity).unwrap().state()
}

pub fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}
