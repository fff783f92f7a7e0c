//! Avian in an app without a window.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used)]

use avian3d::prelude::{Collider, PhysicsPlugins, Position, RigidBody, Sleeping};
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid_avian::LangevinRigidAvianPlugin;
use bevy_math::Vec3;
use bevy_transform::components::Transform;
use contact_tests::bevy::Solver;

pub struct Avian;

impl Solver for Avian {
    fn app() -> App {
        contact_tests::bevy::app(|app| {
            app.add_plugins((PhysicsPlugins::default(), LangevinRigidAvianPlugin));
        })
    }

    fn moving_box(sides: Vec3) -> impl Bundle {
        (
            RigidBody::Dynamic,
            Collider::cuboid(sides.x, sides.y, sides.z),
        )
    }

    fn fixed_box(sides: Vec3) -> impl Bundle {
        (
            RigidBody::Static,
            Collider::cuboid(sides.x, sides.y, sides.z),
        )
    }

    fn place(world: &World, body: Entity) -> Vec3 {
        world.get::<Position>(body).unwrap().0
    }

    fn is_asleep(world: &World, body: Entity) -> bool {
        world.get::<Sleeping>(body).is_some()
    }
}

pub fn app() -> App {
    Avian::app()
}

pub fn drop_card(app: &mut App, transform: Transform) -> Entity {
    contact_tests::bevy::drop_card::<Avian>(app, transform)
}

pub fn ground(app: &mut App) {
    contact_tests::bevy::ground::<Avian>(app);
}
