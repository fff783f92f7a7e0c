//! What sleeps and what wakes it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::wind::{Wind, WindField};
use langevin_rigid::{Body, Fluid, Model, Stepper};
use langevin_rigid_world::{Kind, Material, Shape, World};
use std::sync::Arc;

/// A board on the ground and one on it, both asleep.
fn two_boards() -> World {
    let body = Body::plate(0.2, 0.14, 0.03, 700.0).unwrap();
    let kind = kind(&body, &Fluid::AIR, DOWN, Material::default());
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(Material::default()));
    for number in 0..2 {
        world.add(
            kind.clone(),
            at([0.0, 0.0151 + 0.0301 * f64::from(number), 0.0]),
            noise(number),
        );
    }
    run(&mut world, 2.0, 2e-3);
    assert!(world.is_asleep(0) && world.is_asleep(1));
    world
}

#[test]
fn a_sleeper_that_is_hit_wakes() {
    let mut world = two_boards();
    let before = *world.state(1);
    let ball = Body::cuboid([0.04, 0.04, 0.04], 700.0).unwrap();
    let ball = kind(&ball, &Fluid::AIR, DOWN, Material::default());
    let mut thrown = at([-0.3, 0.05, 0.0]);
    thrown.velocity = [4.0, 0.3, 0.0];
    world.add(ball, thrown, noise(2));
    run(&mut world, 0.2, 2e-3);
    assert!(!world.is_asleep(1));
    assert!(world.state(1).position[0] > before.position[0] + 0.002);
    run(&mut world, 5.0, 2e-3);
    assert!((0..3).all(|body| world.is_asleep(body)));
}

#[test]
fn what_loses_its_support_wakes_and_falls() {
    let mut world = two_boards();
    let mut aside = *world.state(0);
    aside.position[0] += 1.0;
    world.set_state(0, &aside);
    run(&mut world, 1.0, 2e-3);
    let height = world.state(1).position[1];
    assert!((height - 0.015).abs() < 1e-4, "it lies {height} m high");
}

#[test]
fn wind_wakes_a_leaf_and_a_breath_does_not() {
    let leaf = Body::plate(0.06, 0.04, 0.0005, 300.0).unwrap();
    let settings = settings(Model::Separated, DOWN);
    let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &settings).unwrap();
    let shape = Shape::of_body(&leaf).unwrap();
    let kind = Arc::new(Kind::new(stepper, shape, Material::default()).unwrap());
    for (speed, wakes) in [(0.05, false), (6.0, true)] {
        let mut world = World::new(DOWN);
        world.add_obstacle(ground(Material::default()));
        world.add(
            kind.clone(),
            turned([0.0, 0.01, 0.0], [0.2, 0.0, 0.0]),
            noise(0),
        );
        run(&mut world, 3.0, 2e-3);
        assert!(world.is_asleep(0));
        let before = world.state(0).position[0];
        let mut wind = Wind::default();
        wind.add(WindField::Uniform([speed, 0.0, 0.0])).unwrap();
        world.set_wind(wind, [0.0; 3]);
        run(&mut world, 1.0, 2e-3);
        let gone = world.state(0).position[0] - before;
        assert_eq!(gone > 0.01, wakes, "at {speed} m/s it went {gone} m");
        assert!(wakes || world.is_asleep(0));
    }
}
