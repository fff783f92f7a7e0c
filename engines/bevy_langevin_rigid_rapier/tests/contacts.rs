//! Bodies fall as in the fluid alone, land, lie, and sleep.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use bevy_ecs::prelude::*;
use bevy_langevin_rigid::AmbientWind;
use bevy_langevin_rigid::langevin_rigid::linalg::rotate;
use bevy_langevin_rigid::langevin_rigid::wind::{Wind, WindField};
use bevy_langevin_rigid::langevin_rigid::{Fluid, NoiseStream, Settings, Stepper};
use bevy_math::{Quat, Vec3};
use bevy_rapier3d::prelude::{AdditionalMassProperties, ExternalForce, Sleeping};
use bevy_transform::components::Transform;

use common::{DT, app, card, drop_card, ground, place, state, steps};

fn is_asleep(world: &World, entity: Entity) -> bool {
    world.get::<Sleeping>(entity).unwrap().sleeping
}

#[test]
fn a_body_that_meets_nothing_moves_as_in_the_fluid_alone() {
    let mut app = app();
    let tilt = Quat::from_scaled_axis(Vec3::new(0.4, 0.1, 0.2));
    let pose = Transform::from_xyz(0.0, 50.0, 0.0).with_rotation(tilt);
    let entity = drop_card(&mut app, pose);
    // What would make it another body of Rapier.
    app.world_mut().entity_mut(entity).insert((
        AdditionalMassProperties::Mass(3.0),
        ExternalForce {
            force: Vec3::splat(5.0),
            torque: Vec3::Y,
        },
    ));
    steps(&mut app, 1);
    let stepper = Stepper::new(&card(), &Fluid::AIR, None, &Settings::default()).unwrap();
    let mut alone = state(app.world(), entity);
    assert!(alone.position[1] > 49.9 && alone.position[1] <= 50.0);
    for _ in 0..200 {
        let before = alone.position[1];
        steps(&mut app, 1);
        // A frame that ends with a fixed step draws the one before.
        let drawn = f64::from(place(app.world(), entity).y);
        assert!((drawn - before).abs() < 1e-5, "{drawn} {before}");
        let noise = NoiseStream { seed: 0, body: 0 };
        stepper.step(&mut alone, DT, &noise.into()).unwrap();
        assert_eq!(state(app.world(), entity), alone);
    }
    assert!(alone.position[1] < 49.0);
}

#[test]
fn two_hundred_cards_land_lie_flat_and_sleep() {
    let mut app = app();
    ground(&mut app);
    let entities: Vec<Entity> = (0..200u16)
        .map(|number| {
            let turn = f32::from(number);
            let (x, z) = (
                0.12 * f32::from(number % 10),
                0.12 * f32::from(number / 10 % 10),
            );
            let y = 1.0 + 0.5 * f32::from(number / 100) + 0.01 * f32::from(number % 7);
            let tilt = Vec3::new(0.37, 0.11, 0.23) * turn;
            let pose = Transform::from_xyz(x, y, z).with_rotation(Quat::from_scaled_axis(tilt));
            drop_card(&mut app, pose)
        })
        .collect();
    let height = |world: &World, e: Entity| place(world, e).y;
    let mut waited = 0;
    steps(&mut app, 2);
    while !entities.iter().all(|e| height(app.world(), *e) < 0.15) {
        steps(&mut app, 1);
        waited += 1;
        assert!(waited < 2000, "not all have landed after half a minute");
    }
    steps(&mut app, 320);
    let world = app.world();
    let count = |of: &dyn Fn(Entity) -> bool| entities.iter().filter(|e| of(**e)).count();
    let below = count(&|e| height(world, e) < -0.001);
    let on_edge = count(&|e| rotate(state(world, e).orientation, [0.0, 1.0, 0.0])[1].abs() < 0.5);
    let asleep = count(&|e| is_asleep(world, e));
    println!("{below} below the ground, {on_edge} on edge, {asleep} asleep");
    assert_eq!(below, 0);
    assert!(on_edge <= 2, "{on_edge} stand on edge");
    assert!(asleep >= 190, "{asleep} of 200 sleep");
}

#[test]
fn a_gust_wakes_a_card_and_a_breath_does_not() {
    let mut app = app();
    ground(&mut app);
    let entity = drop_card(&mut app, Transform::from_xyz(0.0, 0.01, 0.0));
    let mut waited = 0;
    steps(&mut app, 1);
    while !is_asleep(app.world(), entity) {
        steps(&mut app, 1);
        waited += 1;
        assert!(waited < 640, "the card does not sleep after 10 s");
    }
    let lies = state(app.world(), entity);
    let blow = |app: &mut bevy_app::App, speed: f64| {
        let mut wind = Wind::default();
        wind.add(WindField::Uniform([speed, 0.4 * speed, 0.0]))
            .unwrap();
        app.insert_resource(AmbientWind(wind));
        steps(app, 60);
    };
    blow(&mut app, 0.05);
    assert!(is_asleep(app.world(), entity));
    assert_eq!(state(app.world(), entity), lies);
    blow(&mut app, 8.0);
    assert!(!is_asleep(app.world(), entity));
    assert!(place(app.world(), entity).x > 0.1);
}
