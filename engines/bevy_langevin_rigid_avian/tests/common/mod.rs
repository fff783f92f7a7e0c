//! An app without a window.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used)]

use avian3d::prelude::{Collider, PhysicsPlugins, RigidBody};
use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::{BakedBody, Immersed, LangevinRigidPlugin};
use bevy_langevin_rigid_avian::LangevinRigidAvianPlugin;
use bevy_mesh::MeshPlugin;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;

pub const DT: f64 = 1.0 / 64.0;

/// An app that takes one fixed step a frame from its second frame on.
pub fn app() -> App {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        TimePlugin,
        TransformPlugin,
        AssetPlugin::default(),
        MeshPlugin,
        PhysicsPlugins::default(),
        LangevinRigidPlugin,
        LangevinRigidAvianPlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
    app.finish();
    app.cleanup();
    app.update();
    app
}

pub fn drop_card(app: &mut App, transform: Transform) -> Entity {
    let mut bodies = app.world_mut().resource_mut::<Assets<BakedBody>>();
    let body = bodies.add(contact_tests::card());
    let [x, y, z] = contact_tests::SIZE.map(|size| size as f32);
    let collider = Collider::cuboid(x, y, z);
    let card = (
        transform,
        Immersed::baked(body),
        RigidBody::Dynamic,
        collider,
    );
    app.world_mut().spawn(card).id()
}

/// Of a box, its upper face at height zero.
pub fn ground(app: &mut App) {
    let ground = Collider::cuboid(100.0, 2.0, 100.0);
    let place = Transform::from_xyz(0.0, -1.0, 0.0);
    app.world_mut().spawn((place, RigidBody::Static, ground));
}

pub fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}
