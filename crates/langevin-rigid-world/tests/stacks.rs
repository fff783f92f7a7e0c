//! Stacks that stand.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{norm, sub};
use langevin_rigid::{Body, Fluid};
use langevin_rigid_world::{Material, World};

/// Ten boards, of these densities in turn.
fn stack(densities: &[f64]) -> World {
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(Material::default()));
    for number in 0..10 {
        let density = densities[number % densities.len()];
        let board = Body::plate(0.2, 0.14, 0.03, density).unwrap();
        let kind = kind(&board, &Fluid::AIR, DOWN, Material::default());
        let aside = 0.002 * (number % 3) as f64;
        let state = at([aside, 0.0151 + 0.0301 * number as f64, 0.0]);
        world.add(kind, state, noise(number as u32));
    }
    world
}

const STEPS: [f64; 4] = [1e-3, 2e-3, 5e-3, 1.0 / 60.0];

#[test]
fn a_stack_of_ten_stands() {
    // How far a board may go while the stack settles (m): the impulses of long steps are found less exactly.
    for (dt, far) in STEPS.into_iter().zip([1e-3, 1e-3, 4e-3, 8e-3]) {
        for densities in [&[700.0][..], &[1500.0, 150.0]] {
            let mut world = stack(densities);
            let before: Vec<Vec3> = (0..10).map(|body| world.state(body).position).collect();
            // What overlaps is given time to be mended before it sleeps.
            run(&mut world, 15.0, dt);
            for (body, before) in before.into_iter().enumerate() {
                assert!(world.is_asleep(body), "{densities:?}, {dt} s: {body}");
                let way = norm(sub(world.state(body).position, before));
                assert!(way < far, "{densities:?}, {dt} s: {body} went {way} m");
            }
        }
    }
}

#[test]
fn a_stack_stands_though_it_never_sleeps() {
    for dt in STEPS {
        let mut world = stack(&[700.0]);
        let mut run = |time: f64| {
            while world.time() < time {
                world.step(dt).unwrap();
                (0..10).for_each(|body| world.wake(body));
            }
            world.state(9).position
        };
        let before = run(5.0);
        let creep = norm(sub(run(15.0), before)) / 10.0;
        assert!(creep < 3e-5, "{dt} s: the top creeps at {creep} m/s");
    }
}
