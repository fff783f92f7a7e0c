//! What contacts must keep, and what they must not add.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, norm, sub};
use langevin_rigid::{Body, Fluid, Input};
use langevin_rigid_world::{Obstacle, Shape, World};

fn energy(world: &World) -> f64 {
    let of = |body| world.kind(body).stepper().kinetic_energy(world.state(body));
    (0..world.len()).map(of).sum()
}

/// What it would be after a step without contacts.
fn free_energy(world: &World, dt: f64) -> f64 {
    let of = |body| {
        let mut state = *world.state(body);
        let stepper = world.kind(body).stepper();
        if !world.is_asleep(body) {
            stepper.step(&mut state, dt, &Input::default()).unwrap();
        }
        stepper.kinetic_energy(&state)
    };
    (0..world.len()).map(of).sum()
}

fn impulse(world: &World) -> Vec3 {
    let of = |body| world.kind(body).stepper().linear_impulse(world.state(body));
    (0..world.len()).map(of).fold([0.0; 3], add)
}

/// Bodies of every form in a box of half-spaces, without weight or drag.
fn gas(fluid: &Fluid, friction: f64, restitution: f64) -> World {
    let material = material(friction, restitution);
    let mut world = World::new([0.0; 3]);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut normal = [0.0; 3];
            normal[axis] = side;
            world.add_obstacle(Obstacle::half_space(normal, -0.25, material).unwrap());
        }
    }
    let pillar = Shape::cuboid([0.03, 0.25, 0.03]).unwrap();
    world.add_obstacle(Obstacle::shape(pillar, [0.0; 3], UPRIGHT, material).unwrap());
    let kinds = [
        Body::plate(0.08, 0.05, 0.004, 500.0).unwrap(),
        Body::cuboid([0.05, 0.04, 0.06], 500.0).unwrap(),
        Body::ellipsoid([0.04, 0.02, 0.03], 1100.0).unwrap(),
        Body::disc(0.03, 0.003, 7000.0).unwrap(),
    ]
    .map(|body| kind(&body, fluid, [0.0; 3], material));
    let mut numbers = Numbers(7);
    for x in [-0.17, 0.0, 0.17] {
        for y in [-0.17, 0.0, 0.17] {
            for z in [-0.17, 0.17] {
                let number = world.len();
                let mut state = turned([x, y, z], numbers.vector(3.0));
                state.velocity = numbers.vector(2.0);
                state.angular_velocity = numbers.vector(20.0);
                world.add(kinds[number % 4].clone(), state, noise(number as u32));
            }
        }
    }
    world
}

#[test]
fn contacts_add_no_energy() {
    for fluid in [Fluid::AIR, Fluid::WATER] {
        for (friction, restitution) in [
            (0.0, 0.0),
            (0.0, 1.0),
            (0.3, 0.5),
            (1.0, 0.0),
            (1.0, 1.0),
            (0.5, 0.9),
        ] {
            let mut world = gas(&fluid, friction, restitution);
            let first = energy(&world);
            let mut before = first;
            for step in 0..1000 {
                let free = free_energy(&world, 1e-3);
                world.step(1e-3).unwrap();
                let after = energy(&world);
                assert!(
                    after <= free * (1.0 + 1e-12),
                    "friction {friction}, restitution {restitution}, step {step}: {free} to {after} J"
                );
                // The steps of bodies that meet nothing keep it to their own error.
                assert!(
                    after <= before * (1.0 + 1e-6),
                    "step {step}: {before} to {after} J"
                );
                before = after;
            }
            let left = before / first;
            // What rubs and does not bounce comes to rest; what only bounces does not.
            if (friction, restitution) == (1.0, 0.0) {
                assert!(left < 0.3, "{left}");
            } else if (friction, restitution) == (0.0, 1.0) {
                assert!(left > 0.7, "{left}");
            }
        }
    }
}

/// Two bricks that fly at each other, askew and turning; what their impulse and energy change by.
fn collide(fluid: &Fluid, apart: f64, dt: f64, friction: f64) -> (f64, f64) {
    let brick = Body::cuboid([0.06, 0.03, 0.1], 700.0).unwrap();
    let kind = kind(&brick, fluid, [0.0; 3], material(friction, 0.5));
    let mut world = World::new([0.0; 3]);
    let mut numbers = Numbers(3);
    for side in [-1.0, 1.0] {
        let mut state = turned(
            [0.1 * side, 0.01 * side + apart * side, 0.0],
            numbers.vector(2.0),
        );
        state.set_world_velocities([-1.5 * side + 0.3, 0.1, 0.0], numbers.vector(6.0));
        world.add(kind.clone(), state, noise(0));
    }
    let (before, had) = (impulse(&world), energy(&world));
    run(&mut world, 0.2, dt);
    let change = norm(sub(impulse(&world), before)) / norm(before);
    (change, energy(&world) / had)
}

#[test]
fn a_collision_conserves_momentum() {
    for friction in [0.0, 0.5] {
        let (change, left) = collide(&THIN, 0.0, 1e-3, friction);
        assert!(left < 0.95, "they did not meet: {left}");
        assert!(change < 1e-9, "in a thin fluid: {change:e}");
        let (change, left) = collide(&Fluid::WATER, 0.0, 1e-3, friction);
        let (free, _) = collide(&Fluid::WATER, 10.0, 1e-3, friction);
        assert!(left < 0.95, "they did not meet: {left}");
        println!("water {change:e}, free {free:e}");
        assert!(
            change < 1e-2 + free,
            "in water: {change:e}, without a collision {free:e}"
        );
    }
}
