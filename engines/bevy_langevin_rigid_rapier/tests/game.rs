//! What a game may do to bodies, by right and by mistake.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::time::Duration;

use bevy_ecs::hierarchy::ChildOf;
use bevy_langevin_rigid::{Hosted, LinearVelocity};
use bevy_math::{Quat, Vec3};
use bevy_rapier3d::prelude::{RigidBody, Sleeping, Velocity};
use bevy_time::{Fixed, Time, TimeUpdateStrategy};
use bevy_transform::components::Transform;
use contact_tests::bevy::{DT, state, steps};

use common::{app, drop_card, ground, place};

#[test]
fn a_game_moves_and_pushes_a_body() {
    let mut app = app();
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 50.0, 0.0));
    steps(&mut app, 10);
    let world = app.world_mut();
    world.get_mut::<Transform>(entity).unwrap().translation = Vec3::new(5.0, 80.0, 0.0);
    world.get_mut::<Velocity>(entity).unwrap().linear = Vec3::X;
    steps(&mut app, 1);
    let moved = state(app.world(), entity);
    assert!((moved.position[0] - 5.0).abs() < 0.05 && moved.position[1] > 79.0);
    assert!(moved.world_velocity()[0] > 0.5);
    assert!(app.world().get::<Velocity>(entity).unwrap().linear.x > 0.5);
    assert!((place(app.world(), entity).x - 5.0).abs() < 0.05);
}

#[test]
fn a_body_is_released_with_the_velocity_of_either_plugin() {
    let mut app = app();
    let ours = drop_card(&mut app, Transform::from_xyz(0.0, 50.0, 0.0));
    let rapiers = drop_card(&mut app, Transform::from_xyz(5.0, 50.0, 0.0));
    let world = app.world_mut();
    world.entity_mut(ours).insert(LinearVelocity(Vec3::X));
    world.entity_mut(rapiers).insert(Velocity::linear(Vec3::X));
    steps(&mut app, 1);
    for entity in [ours, rapiers] {
        let speed = state(app.world(), entity).world_velocity()[0];
        assert!(speed > 0.5 && speed <= 1.0, "{speed}");
    }
}

#[test]
fn a_body_is_drawn_between_its_last_two_fixed_steps() {
    let mut app = app();
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 50.0, 0.0));
    steps(&mut app, 30);
    let frame = Duration::from_secs_f64(DT / 4.0);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
    let (mut before, mut after) = (f64::NAN, state(app.world(), entity).position[1]);
    let mut seen = 0;
    for _ in 0..40 {
        steps(&mut app, 1);
        let now = state(app.world(), entity).position[1];
        if now != after {
            (before, after) = (after, now);
        }
        let part = app
            .world()
            .resource::<Time<Fixed>>()
            .overstep_fraction_f64();
        let between = before + part * (after - before);
        let drawn = f64::from(place(app.world(), entity).y);
        if between.is_finite() {
            seen += 1;
            assert!((drawn - between).abs() < 2e-5, "{drawn} {between}");
        }
    }
    assert!(seen > 30);
    // Where the game has moved it, it is drawn at once, and goes on from there.
    app.world_mut()
        .get_mut::<Transform>(entity)
        .unwrap()
        .translation
        .y = 80.0;
    for _ in 0..12 {
        steps(&mut app, 1);
        let drawn = place(app.world(), entity).y;
        assert!(drawn > 79.5 && drawn <= 80.0, "{drawn}");
    }
    let y = state(app.world(), entity).position[1];
    assert!(y > 79.5 && y < 80.0, "{y}");
}

#[test]
fn a_sleeping_body_is_thrown() {
    let mut app = app();
    ground(&mut app);
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 0.01, 0.0));
    steps(&mut app, 640);
    assert!(app.world().get::<Sleeping>(entity).unwrap().sleeping);
    let mut velocity = app.world_mut().get_mut::<Velocity>(entity).unwrap();
    velocity.linear = Vec3::new(0.0, 2.0, 0.0);
    steps(&mut app, 6);
    assert!(!app.world().get::<Sleeping>(entity).unwrap().sleeping);
    assert!(place(app.world(), entity).y > 0.05);
}

#[test]
fn a_held_body_goes_where_its_parent_goes_and_falls_when_let_go() {
    let mut app = app();
    let hand = app
        .world_mut()
        .spawn(Transform::from_xyz(0.0, 20.0, 0.0))
        .id();
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 20.0, 0.0));
    steps(&mut app, 10);
    app.world_mut()
        .entity_mut(entity)
        .insert((ChildOf(hand), Transform::IDENTITY));
    for _ in 0..20 {
        app.world_mut()
            .get_mut::<Transform>(hand)
            .unwrap()
            .translation
            .x += 0.1;
        steps(&mut app, 1);
    }
    assert!(place(app.world(), entity).length() < 1e-3);
    app.world_mut()
        .entity_mut(entity)
        .remove::<ChildOf>()
        .insert(Transform::from_xyz(2.0, 20.0, 0.0));
    steps(&mut app, 1);
    let start = state(app.world(), entity);
    assert!((start.position[0] - 2.0).abs() < 1e-2 && start.position[1] > 19.99);
    assert!(start.world_velocity()[1] > -0.3);
    steps(&mut app, 30);
    assert!(place(app.world(), entity).y < 19.9);
}

#[test]
fn only_dynamic_bodies_are_hosted_and_despawning_is_quiet() {
    let mut app = app();
    let held = drop_card(&mut app, Transform::from_xyz(0.0, 3.0, 0.0));
    app.world_mut()
        .entity_mut(held)
        .insert(RigidBody::KinematicPositionBased);
    let free = drop_card(&mut app, Transform::from_xyz(1.0, 3.0, 0.0));
    let bare = drop_card(&mut app, Transform::from_xyz(2.0, 3.0, 0.0));
    steps(&mut app, 3);
    let hosted = |app: &bevy_app::App, entity| app.world().get::<Hosted>(entity).is_some();
    assert!(!hosted(&app, held) && hosted(&app, free) && hosted(&app, bare));
    app.world_mut().entity_mut(held).insert(RigidBody::Dynamic);
    app.world_mut().entity_mut(bare).remove::<RigidBody>();
    app.world_mut().despawn(free);
    steps(&mut app, 3);
    assert!(hosted(&app, held) && !hosted(&app, bare));
    let before = place(app.world(), bare).y;
    steps(&mut app, 10);
    assert!(place(app.world(), bare).y < before);
}

#[test]
fn what_is_no_number_is_not_taken() {
    let mut app = app();
    ground(&mut app);
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 3.0, 0.0));
    drop_card(&mut app, Transform::from_xyz(f32::NAN, 3.0, 0.0));
    steps(&mut app, 10);
    for bad in [f32::NAN, f32::INFINITY] {
        let before = state(app.world(), entity);
        let world = app.world_mut();
        world.get_mut::<Transform>(entity).unwrap().translation.x = bad;
        world.get_mut::<Velocity>(entity).unwrap().angular.y = bad;
        steps(&mut app, 1);
        app.world_mut()
            .get_mut::<Transform>(entity)
            .unwrap()
            .rotation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        steps(&mut app, 1);
        let after = state(app.world(), entity);
        assert!(after.is_finite() && place(app.world(), entity).is_finite());
        assert!(after.position[1] < before.position[1] && after.position[1] > 2.0);
    }
    steps(&mut app, 200);
    assert!(place(app.world(), entity).y < 1.0);
}
