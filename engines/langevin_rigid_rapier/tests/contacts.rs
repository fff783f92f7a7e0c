//! Bodies fall as in the fluid alone, land, lie, and sleep.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::sync::Arc;

use common::{DT, FRICTION, World, card};
use contact_tests::{Engine, Seen, pose};
use langevin_rigid_rapier::langevin_rigid::{
    Body, Flow, Fluid, Input, Model, NoiseStream, Settings, State, Stepper,
};
use rapier3d::prelude::*;

struct Rapier {
    world: World,
    card: Arc<Stepper>,
    input: Input,
}

impl Rapier {
    fn new() -> Self {
        let mut world = World::default();
        world.ground();
        Self {
            world,
            card: card(),
            input: Input::default(),
        }
    }
}

impl Engine for Rapier {
    type Card = RigidBodyHandle;
    const DT: f64 = DT;

    fn release(&mut self, pose: &State) -> RigidBodyHandle {
        self.world.drop(&self.card, pose)
    }

    fn blow(&mut self, wind: [f64; 3]) {
        self.input.flow = Flow::uniform(wind);
    }

    fn twist(&mut self, _: RigidBodyHandle, torque: [f64; 3]) {
        self.input.wrench.torque = torque;
    }

    fn step(&mut self) {
        let input = self.input;
        self.world.step(&mut |handle, _| Input {
            noise: NoiseStream {
                seed: 5,
                body: handle.into_raw_parts().0,
            },
            ..input
        });
    }

    fn seen(&self, card: RigidBodyHandle) -> Seen {
        let body = &self.world.bodies[card];
        Seen {
            state: *self.world.immersed.state(card).unwrap(),
            place: body.translation().to_array().map(f64::from),
            asleep: body.is_sleeping(),
        }
    }
}

#[test]
fn a_body_that_meets_nothing_moves_as_in_the_fluid_alone() {
    let mut world = World::default();
    let stepper = card();
    let handle = world.drop(&stepper, &pose([0.0, 100.0, 0.0], [0.4, 0.1, 0.2]));
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
    contact_tests::two_hundred_cards_land_lie_flat_and_sleep(&mut Rapier::new());
}

#[test]
fn a_gust_wakes_a_card_and_a_breath_does_not() {
    contact_tests::a_gust_wakes_a_card_and_a_breath_does_not(&mut Rapier::new());
}

#[test]
fn a_torque_wakes_a_card_and_a_slight_one_does_not() {
    contact_tests::a_torque_wakes_a_card_and_a_slight_one_does_not(&mut Rapier::new());
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
    let stepper = Arc::new(Stepper::new(&ball, &Fluid::WATER, None, &settings).unwrap());
    let total = stepper.total_mass()[0][0];
    let mut world = World::default();
    let handle = world.insert(&stepper, ColliderBuilder::ball(0.05), &State::default());
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
fn friction_in_water_stops_a_coin_over_the_way_that_its_mass_along_the_bed_says() {
    let (radius, thickness, speed) = (0.0125, 0.00175, 0.3);
    let coin = Body::disc(radius, thickness, 2700.0).unwrap();
    let settings = Settings {
        // Without drag.
        model: Model::Kirchhoff,
        ..Settings::default()
    };
    let water = Fluid::WATER;
    let stepper = Arc::new(Stepper::new(&coin, &water, None, &settings).unwrap());
    let mut world = World::default();
    world.ground();
    let collider = ColliderBuilder::cylinder(0.5 * thickness as f32, radius as f32);
    let lies = pose([0.0, 0.5 * thickness, 0.0], [0.0; 3]);
    let handle = world.insert(&stepper, collider, &lies);
    let run = |world: &mut World| {
        for _ in 0..60 {
            world.step(&mut |_, _| Input::default());
        }
        world.immersed.state(handle).unwrap().position[0]
    };
    // The bed bears it before it slides.
    let start = run(&mut world);
    world.bodies[handle].set_linvel(Vector::new(speed as f32, 0.0, 0.0), true);
    let slid = run(&mut world) - start;
    let weight = 9.81 * (coin.mass - water.density * coin.volume);
    let mass = stepper.total_mass()[0][0];
    let expected = 0.5 * mass * speed * speed / (FRICTION * weight);
    // Friction begins within a step; by the mass towards the bed it would take more than three times this way.
    let step = speed * DT;
    assert!((slid - expected).abs() < step, "{slid} m, not {expected} m");
}

#[test]
fn wrong_bodies_and_numbers_are_told() {
    use langevin_rigid_rapier::{Immersion, InsertError};
    let mut world = World::default();
    let stepper = card();
    let handle = world.drop(&stepper, &pose([0.0, 1.0, 0.0], [0.0; 3]));
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
    let lost = world.drop(&stepper, &pose([0.0, 1.0, 0.0], [0.0; 3]));
    let sound = world.drop(&stepper, &pose([1.0, 1.0, 0.0], [0.0; 3]));
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
