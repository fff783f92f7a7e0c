//! An app without a window.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used)]

use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::State;
use bevy_langevin_rigid::{BakedBody, Immersed, LangevinRigidPlugin, Stepped};
use bevy_langevin_rigid_rapier::LangevinRigidRapierPlugin;
use bevy_mesh::MeshPlugin;
use bevy_rapier3d::prelude::{Collider, RapierPhysicsPlugin, RigidBody, TimestepMode};
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;

pub const DT: f64 = 1.0 / 64.0;
/// The step of Rapier that goes with it.
pub const FIXED: TimestepMode = TimestepMode::Fixed {
    dt: DT as f32,
    substeps: 1,
};

/// An app that takes one fixed step a frame from its second frame on.
pub fn app() -> App {
    app_with(RapierPhysicsPlugin::default().in_fixed_schedule(), FIXED)
}

/// [`app`] with Rapier as it is given.
pub fn app_with(rapier: RapierPhysicsPlugin<()>, mode: TimestepMode) -> App {
    let mut app = App::new();
    app.insert_resource(mode)
        .add_plugins((
            TaskPoolPlugin::default(),
            TimePlugin,
            TransformPlugin,
            AssetPlugin::default(),
            MeshPlugin,
            rapier,
            LangevinRigidPlugin,
            LangevinRigidRapierPlugin,
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
    let [x, y, z] = contact_tests::SIZE.map(|size| 0.5 * size as f32);
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
    let ground = Collider::cuboid(50.0, 1.0, 50.0);
    let place = Transform::from_xyz(0.0, -1.0, 0.0);
    app.world_mut().spawn((place, RigidBody::Fixed, ground));
}

pub fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}

pub fn state(world: &World, entity: Entity) -> State {
    *world.get::<Stepped>(entity).unwrap().state()
}

pub fn place(world: &World, entity: Entity) -> bevy_math::Vec3 {
    world.get::<Transform>(entity).unwrap().translation
}
