//! Rapier in an app without a window.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used)]

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid_rapier::LangevinRigidRapierPlugin;
use bevy_math::Vec3;
use bevy_rapier3d::prelude::{Collider, RapierPhysicsPlugin, RigidBody, Sleeping, TimestepMode};
use bevy_transform::components::Transform;
use contact_tests::bevy::{DT, Solver};

/// The step of Rapier that goes with that of the app.
pub const FIXED: TimestepMode = TimestepMode::Fixed {
    dt: DT as f32,
    substeps: 1,
};

pub struct Rapier;

impl Solver for Rapier {
    fn app() -> App {
        app_with(RapierPhysicsPlugin::default().in_fixed_schedule(), FIXED)
    }

    fn moving_box(sides: Vec3) -> impl Bundle {
        (RigidBody::Dynamic, cuboid(sides))
    }

    fn fixed_box(sides: Vec3) -> impl Bundle {
        (RigidBody::Fixed, cuboid(sides))
    }

    fn place(world: &World, body: Entity) -> Vec3 {
        place(world, body)
    }

    fn is_asleep(world: &World, body: Entity) -> bool {
        world.get::<Sleeping>(body).unwrap().sleeping
    }
}

fn cuboid(sides: Vec3) -> Collider {
    let [x, y, z] = (0.5 * sides).to_array();
    Collider::cuboid(x, y, z)
}

/// An app with Rapier as it is given.
pub fn app_with(rapier: RapierPhysicsPlugin<()>, mode: TimestepMode) -> App {
    contact_tests::bevy::app(|app| {
        app.insert_resource(mode)
            .add_plugins((rapier, LangevinRigidRapierPlugin));
    })
}

pub fn app() -> App {
    Rapier::app()
}

pub fn drop_card(app: &mut App, transform: Transform) -> Entity {
    contact_tests::bevy::drop_card::<Rapier>(app, transform)
}

pub fn ground(app: &mut App) {
    contact_tests::bevy::ground::<Rapier>(app);
}

pub fn place(world: &World, body: Entity) -> Vec3 {
    world.get::<Transform>(body).unwrap().translation
}
