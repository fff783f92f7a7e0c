//! Bodies fall as in the fluid alone, land, lie, and sleep.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{DT, World, card};
use langevin_rigid_rapier::langevin_rigid::{
    Body, Flow, Fluid, Input, NoiseStream, Settings, State, Stepper,
};
use rapier3d::prelude::*;

#[test]
fn a_body_that_meets_nothing_moves_as_in_the_fluid_alone() {
    let mut world = World::default();
    let stepper = card();
    let handle = world.drop(&stepper, [0.0, 100.0, 0.0], [0.4, 0.1, 0.2]);
    let mut alone = *world.immersed.state(handle).unwrap();
    let mut input = Input::from(NoiseStream { seed: 1, body: 0 });
    for _ in 0..200 {
        world.step(&mut |_, _| input);
        stepper.step(&mut alone, DT, &input).unwrap();
        input.flow.velocity = [0.1 * alone.time, 0.0, 0.0];
    }
    assert_eq!(world.immersed.state(handle).unwrap(), &alone);
    let drawn = world.bodies[handle].translation();
    assert!((f64::from(drawn.y) - alone.position[1]).abs() < 1e-4);
}

#[test]
fn two_hundred_cards_land_lie_flat_and_sleep() {
    let mut world = World::default();
    world.ground();
    let stepper = card();
    let mut handles = Vec::new();
    for number in 0..200u32 {
        let (x, z) = (f64::from(number % 10), f64::from(number / 10 % 10));
        let height = 1.0 + 0.5 * f64::from(number / 100) + 0.01 * f64::from(number % 7);
        let tilt = [
            0.37 * f64::from(number),
            0.11 * f64::from(number),
            0.23 * f64::from(number),
        ];
        handles.push(world.drop(&stepper, [0.12 * x, height, 0.12 * z], tilt));
    }
    let landed = |world: &World| {
        let height = |h: &RigidBodyHandle| world.bodies[*h].translation().y;
        handles.iter().all(|h| height(h) < 0.15)
    };
    let mut input = |handle: RigidBodyHandle, _: &State| {
        Input::from(NoiseStream {
            seed: 5,
            body: handle.into_raw_parts().0,
        })
    };
    let mut steps = 0;
    while !landed(&world) {
        world.step(&mut input);
        steps += 1;
        assert!(steps < 1800, "not all have landed after 30 s");
    }
    for _ in 0..300 {
        world.step(&mut input);
    }
    let of = |handle: &RigidBodyHandle| world.immersed.state(*handle).unwrap();
    let below = handles
        .iter()
        .filter(|h| of(h).position[1] < -0.001)
        .count();
    let on_edge = handles
        .iter()
        .filter(|h| common::thin_axis(of(h))[1].abs() < 0.5)
        .count();
    let asleep = handles
        .iter()
        .filter(|h| world.bodies[**h].is_sleeping())
        .count();
    println!("{below} below the ground, {on_edge} on edge, {asleep} asleep");
    assert_eq!(below, 0);
    assert!(on_edge <= 2, "{on_edge} stand on edge");
    assert!(asleep >= 190, "{asleep} of 200 sleep");
}

#[test]
fn a_gust_wakes_a_card_and_a_breath_does_not() {
    let mut world = World::default();
    world.ground();
    let handle = world.drop(&card(), [0.0, 0.01, 0.0], [0.0; 3]);
    let mut steps = 0;
    while !world.bodies[handle].is_sleeping() {
        world.step(&mut |_, _| Input::default());
        steps += 1;
        assert!(steps < 600, "the card does not sleep after 10 s");
    }
    let blow = |speed: f64| Input {
        flow: Flow {
            velocity: [speed, 0.4 * speed, 0.0],
            ..Flow::default()
        },
        ..Input::default()
    };
    world.step(&mut |_, _| blow(0.05));
    assert!(world.bodies[handle].is_sleeping());
    for _ in 0..60 {
        world.step(&mut |_, _| blow(8.0));
    }
    assert!(!world.bodies[handle].is_sleeping());
    assert!(world.bodies[handle].translation().x > 0.1);
}

#[test]
fn a_contact_feels_the_added_mass() {
    // A light ball in water has half the displaced water as added mass: pushed by a body of known speed and mass, it goes
    // off as one of that mass.
    let ball = Body::sphere(0.05, 300.0).unwrap();
    let mut settings = Settings {
        gravity: [0.0; 3],
        ..Settings::default()
    };
    settings.separated.attached = true;
    let stepper = std::sync::Arc::new(Stepper::new(&ball, &Fluid::WATER, None, &settings).unwrap());
    let total = stepper.total_mass()[0][0];
    let mut world = World::default();
    let handle = world.ball(&stepper, 0.05, [0.0; 3]);
    let hammer = world.bodies.insert(
        RigidBodyBuilder::dynamic()
            .translation(Vector::new(-0.2, 0.0, 0.0))
            .linvel(Vector::new(3.0, 0.0, 0.0))
            .gravity_scale(0.0),
    );
    let head = ColliderBuilder::ball(0.05)
        .mass(total as f32)
        .restitution(1.0);
    world
        .colliders
        .insert_with_parent(head, hammer, &mut world.bodies);
    for collider in world.bodies[handle].colliders().to_vec() {
        world.colliders[collider].set_restitution(1.0);
    }
    let mut fastest: f64 = 0.0;
    for _ in 0..20 {
        world.step(&mut |_, _| Input::default());
        fastest = fastest.max(world.immersed.state(handle).unwrap().world_velocity()[0]);
    }
    // Equal masses swap their speeds; water has slowed the ball a little by the end of the step.
    assert!(fastest > 2.4 && fastest < 3.05, "{fastest}");
    let left = world.bodies[hammer].linvel().x;
    assert!(left.abs() < 0.15, "{left}");
}

#[test]
fn wrong_bodies_and_numbers_are_told() {
    use langevin_rigid_rapier::{Immersion, InsertError};
    let mut world = World::default();
    let stepper = card();
    let handle = world.drop(&stepper, [0.0, 1.0, 0.0], [0.0; 3]);
    let immersion = |centre, distance| Immersion {
        stepper: stepper.clone(),
        centre_of_mass: centre,
        contact_distance: distance,
    };
    let fixed = world.bodies.insert(RigidBodyBuilder::fixed());
    let free = world.bodies.insert(RigidBodyBuilder::dynamic());
    let World {
        immersed,
        bodies,
        colliders,
        ..
    } = &mut world;
    let mut insert = |handle, immersion| {
        immersed
            .insert(handle, immersion, bodies, colliders)
            .unwrap_err()
    };
    assert_eq!(
        insert(handle, immersion([0.0; 3], 0.0)),
        InsertError::Twice(handle)
    );
    assert_eq!(
        insert(fixed, immersion([0.0; 3], 0.0)),
        InsertError::NotDynamic(fixed)
    );
    assert_eq!(
        insert(free, immersion([f64::NAN; 3], 0.0)),
        InsertError::Number(free)
    );
    assert_eq!(
        insert(free, immersion([0.0; 3], -1.0)),
        InsertError::Number(free)
    );
    let gone = RigidBodyHandle::from_raw_parts(99, 3);
    assert_eq!(
        insert(gone, immersion([0.0; 3], 0.0)),
        InsertError::Missing(gone)
    );
}

#[test]
fn a_body_that_is_no_number_is_told_and_the_others_go_on() {
    let mut world = World::default();
    let stepper = card();
    let lost = world.drop(&stepper, [0.0, 1.0, 0.0], [0.0; 3]);
    let sound = world.drop(&stepper, [1.0, 1.0, 0.0], [0.0; 3]);
    world.bodies[lost].set_linvel(Vector::new(f32::NAN, 0.0, 0.0), true);
    let World {
        immersed,
        bodies,
        narrow_phase,
        ..
    } = &mut world;
    let troubles = immersed
        .before_step(DT, bodies, narrow_phase, |_, _| Input::default())
        .unwrap_err();
    assert_eq!(troubles.len(), 1);
    assert_eq!(troubles[0].body, lost);
    assert!(
        troubles[0].to_string().contains("finite"),
        "{}",
        troubles[0]
    );
    assert!(world.bodies[sound].linvel().y < 0.0);
    // One that the program removes is forgotten.
    world.remove(lost);
    world.step(&mut |_, _| Input::default());
    assert_eq!(world.immersed.len(), 1);
    assert!(world.immersed.remove(sound) && world.immersed.is_empty());
}
