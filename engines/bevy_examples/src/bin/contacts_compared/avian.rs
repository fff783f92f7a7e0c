//! Avian's contacts.

use std::error::Error;

use avian3d::prelude::{
    Collider, CollisionLayers, Friction, PhysicsPlugins, Restitution, RigidBody,
};
use bevy::app::App;
use bevy::asset::Assets;
use bevy::ecs::prelude::*;
use bevy::math::Quat;
use bevy::transform::components::Transform;
use bevy_langevin_rigid::langevin_rigid::State;
use bevy_langevin_rigid::{BakedBody, Immersed, Stepped};
use bevy_langevin_rigid_avian::LangevinRigidAvianPlugin;

use crate::cards::{self, FRICTION, SIZE, Way};

/// Cards meet the ground and not each other.
const GROUND: u32 = 1;
const CARDS: u32 = 2;

/// The ways of cards onto the ground, from states that are those of the [releases](cards::releases) but for rounding.
pub(crate) fn ways(starts: &[State], steps: usize) -> Result<Vec<Way>, Box<dyn Error>> {
    let mut app = contact_tests::bevy::app(|app| {
        app.add_plugins((PhysicsPlugins::default(), LangevinRigidAvianPlugin));
    });
    app.world_mut().spawn(ground());
    let entities = drop_cards(&mut app)?;
    // They join in this frame. What they move in it is taken back.
    app.update();
    for (entity, start) in entities.iter().zip(starts) {
        let stepped = app.world_mut().get_mut::<Stepped>(*entity);
        stepped.ok_or("a card has not joined")?.set_state(*start);
    }
    let mut ways: Vec<Way> = starts.iter().map(|start| vec![*start]).collect();
    for _ in 0..steps {
        app.update();
        for (entity, way) in entities.iter().zip(&mut ways) {
            way.extend(app.world().get(*entity).map(Stepped::state));
        }
    }
    Ok(ways)
}

fn drop_cards(app: &mut App) -> Result<Vec<Entity>, Box<dyn Error>> {
    let mut bodies = app.world_mut().resource_mut::<Assets<BakedBody>>();
    let body = bodies.add(cards::body()?);
    let spawn = |(number, (height, turn))| {
        let turn: [f64; 4] = turn;
        let turn = Quat::from_array(turn.map(|x| x as f32));
        let pose = Transform::from_xyz(0.0, height as f32, 0.0).with_rotation(turn);
        let immersed = Immersed::baked(body.clone()).numbered(number);
        app.world_mut().spawn(card(immersed, pose)).id()
    };
    Ok((0..).zip(cards::releases()).map(spawn).collect())
}

fn card(immersed: Immersed, pose: Transform) -> impl Bundle {
    let [x, y, z] = SIZE.map(|size| size as f32);
    (
        pose,
        immersed,
        RigidBody::Dynamic,
        Collider::cuboid(x, y, z),
        CollisionLayers::from_bits(CARDS, GROUND),
        surface(),
    )
}

/// A box, its upper face at height zero.
fn ground() -> impl Bundle {
    (
        Transform::from_xyz(0.0, -1.0, 0.0),
        RigidBody::Static,
        Collider::cuboid(100.0, 2.0, 100.0),
        CollisionLayers::from_bits(GROUND, CARDS),
        surface(),
    )
}

fn surface() -> (Friction, Restitution) {
    (Friction::new(FRICTION as f32), Restitution::new(0.0))
}
