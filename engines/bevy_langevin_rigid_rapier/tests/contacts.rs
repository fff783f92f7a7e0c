//! Bodies fall as in the fluid alone, land, lie, and sleep.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use bevy_langevin_rigid::langevin_rigid::NoiseStream;
use bevy_math::{Quat, Vec3};
use bevy_rapier3d::prelude::{AdditionalMassProperties, ExternalForce};
use bevy_transform::components::Transform;
use contact_tests::bevy::{DT, InBevy, state, steps};

use common::{Rapier, app, drop_card, place};

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
    let stepper = contact_tests::stepper();
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
    contact_tests::two_hundred_cards_land_lie_flat_and_sleep(&mut InBevy::<Rapier>::new());
}

#[test]
fn a_gust_wakes_a_card_and_a_breath_does_not() {
    contact_tests::a_gust_wakes_a_card_and_a_breath_does_not(&mut InBevy::<Rapier>::new());
}

#[test]
fn a_torque_wakes_a_card_and_a_slight_one_does_not() {
    contact_tests::a_torque_wakes_a_card_and_a_slight_one_does_not(&mut InBevy::<Rapier>::new());
}
