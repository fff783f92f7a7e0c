//! Bodies fall as in the fluid alone, land, lie, and sleep.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use avian3d::prelude::{LinearVelocity, Position, RigidBody, Rotation, Sleeping};
use bevy_langevin_rigid::Hosted;
use bevy_langevin_rigid::langevin_rigid::NoiseStream;
use bevy_math::{DQuat, DVec3, Vec3};
use bevy_transform::components::Transform;
use contact_tests::bevy::{DT, InBevy, state, steps};

use common::{Avian, app, drop_card, ground};

#[test]
fn a_body_that_meets_nothing_moves_as_in_the_fluid_alone() {
    let mut app = app();
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 50.0, 0.0));
    steps(&mut app, 1);
    let stepper = contact_tests::stepper();
    let mut alone = state(app.world(), entity);
    assert!(alone.position[1] > 49.9 && alone.position[1] <= 50.0);
    for _ in 0..100 {
        steps(&mut app, 1);
        let noise = NoiseStream { seed: 0, body: 0 };
        stepper.step(&mut alone, DT, &noise.into()).unwrap();
    }
    assert_eq!(state(app.world(), entity), alone);
    let drawn = app.world().get::<Transform>(entity).unwrap().translation.y;
    assert!((f64::from(drawn) - alone.position[1]).abs() < 1e-4);
}

#[test]
fn two_hundred_cards_land_lie_flat_and_sleep() {
    contact_tests::two_hundred_cards_land_lie_flat_and_sleep(&mut InBevy::<Avian>::new());
}

#[test]
fn a_gust_wakes_a_card_and_a_breath_does_not() {
    contact_tests::a_gust_wakes_a_card_and_a_breath_does_not(&mut InBevy::<Avian>::new());
}

#[test]
fn a_torque_wakes_a_card_and_a_slight_one_does_not() {
    contact_tests::a_torque_wakes_a_card_and_a_slight_one_does_not(&mut InBevy::<Avian>::new());
}

#[test]
fn a_card_that_falls_asleep_has_taken_its_last_step() {
    let mut app = app();
    ground(&mut app);
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 0.01, 0.0));
    let mut waited = 0;
    while app.world().get::<Sleeping>(entity).is_none() {
        steps(&mut app, 1);
        waited += 1;
        assert!(waited < 640, "the card does not sleep after 10 s");
    }
    let lies = state(app.world(), entity);
    let position = app.world().get::<Position>(entity).unwrap().0.as_dvec3();
    let rotation = app.world().get::<Rotation>(entity).unwrap().0.as_dquat();
    // A free step would be two millimetres lower.
    assert!((position - DVec3::from(lies.position)).length() < 1e-6);
    assert!(rotation.angle_between(DQuat::from_array(lies.orientation)) < 1e-3);
    steps(&mut app, 10);
    assert_eq!(state(app.world(), entity), lies);
}

#[test]
fn a_game_moves_and_pushes_a_body() {
    let mut app = app();
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 50.0, 0.0));
    steps(&mut app, 10);
    app.world_mut().get_mut::<Position>(entity).unwrap().0 = Vec3::new(5.0, 80.0, 0.0);
    app.world_mut().get_mut::<LinearVelocity>(entity).unwrap().0 = Vec3::X;
    steps(&mut app, 1);
    let moved = state(app.world(), entity);
    assert!((moved.position[0] - 5.0).abs() < 0.05 && moved.position[1] > 79.0);
    assert!(moved.world_velocity()[0] > 0.5);
}

#[test]
fn only_dynamic_bodies_are_hosted_and_despawning_is_quiet() {
    let mut app = app();
    let held = drop_card(&mut app, Transform::from_xyz(0.0, 3.0, 0.0));
    app.world_mut()
        .entity_mut(held)
        .insert(RigidBody::Kinematic);
    let free = drop_card(&mut app, Transform::from_xyz(1.0, 3.0, 0.0));
    steps(&mut app, 3);
    assert!(app.world().get::<Hosted>(held).is_none());
    assert!(app.world().get::<Hosted>(free).is_some());
    app.world_mut().despawn(free);
    steps(&mut app, 3);
}
