//! A coin spun on a table.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::linalg::{Vec3, rotate};
use langevin_rigid::{Body, Fluid};
use langevin_rigid_world::{Material, World};

const THICKNESS: f64 = 0.0018;

/// A coin on its edge, this much off the vertical (rad), with this spin about it (rad/s).
fn coin(tilt: f64, spin: f64, material: Material) -> World {
    let body = Body::cylinder(0.0121, THICKNESS, 7000.0).unwrap();
    let kind = kind(&body, &Fluid::AIR, DOWN, material);
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(material));
    // Its axis is x.
    let mut state = turned([0.0, 0.0135, 0.0], [0.0, 0.0, tilt]);
    state.set_world_velocities([0.0; 3], [0.0, spin, 0.0]);
    world.add(kind, state, noise(0));
    world
}

fn axis(world: &World) -> Vec3 {
    rotate(world.state(0).orientation, [1.0, 0.0, 0.0])
}

/// Angle of the coin's face to the table (rad).
fn lean(world: &World) -> f64 {
    axis(world)[1].abs().min(1.0).acos()
}

#[test]
fn its_wobble_quickens_as_it_falls() {
    let dt = 2e-4;
    let mut world = coin(0.15, 25.0, material(0.5, 0.0));
    // Rate at which the axis goes around the vertical, by the lean.
    let mut rates: Vec<(f64, f64)> = Vec::new();
    let mut before = axis(&world);
    let (mut turned, mut begin, mut lean_sum, mut count) = (0.0, 0.0, 0.0, 0.0);
    for _ in 0..(10.0 / dt) as usize {
        world.step(dt).unwrap();
        let now = axis(&world);
        let sine = before[2] * now[0] - before[0] * now[2];
        let cosine = before[0] * now[0] + before[2] * now[2];
        turned += sine.atan2(cosine);
        (lean_sum, count) = (lean_sum + lean(&world), count + 1.0);
        before = now;
        if f64::abs(turned) > std::f64::consts::TAU {
            rates.push((lean_sum / count, turned.abs() / (world.time() - begin)));
            (turned, begin, lean_sum, count) = (0.0, world.time(), 0.0, 0.0);
        }
        if world.is_asleep(0) {
            break;
        }
    }
    println!("{rates:?}");
    assert!(world.is_asleep(0), "still moves after {} s", world.time());
    assert!(lean(&world) < 0.01, "rests at {} rad", lean(&world));
    let mean = |from: f64, to: f64| {
        let within: Vec<f64> = rates
            .iter()
            .filter(|(lean, _)| (from..to).contains(lean))
            .map(|(_, rate)| *rate)
            .collect();
        (
            within.iter().sum::<f64>() / within.len() as f64,
            within.len(),
        )
    };
    let ((steep, some), (flat, more)) = (mean(0.4, 0.8), mean(0.1, 0.25));
    assert!(some > 0 && more > 0, "{rates:?}");
    assert!(
        flat > 1.3 * steep,
        "{steep} rad/s when steep, {flat} rad/s when flat"
    );
}

#[test]
fn it_falls_heads_or_tails() {
    let mut heads = 0;
    let mut numbers = Numbers(11);
    for seed in 0..24 {
        let side = numbers.next();
        let mut world = coin(
            // Not so upright that it would stand on its edge.
            0.25 * (side + side.signum()),
            20.0 + 15.0 * numbers.next(),
            material(0.4, 0.2),
        );
        while !world.is_asleep(0) && world.time() < 20.0 {
            world.step(1e-3).unwrap();
        }
        assert!(
            world.is_asleep(0),
            "{seed}: still moves, lean {} rad",
            lean(&world)
        );
        assert!(lean(&world) < 0.02, "{seed}: rests at {} rad", lean(&world));
        let height = world.state(0).position[1];
        assert!(
            (height - 0.5 * THICKNESS).abs() < 5e-5,
            "{seed}: rests {height} m high"
        );
        heads += usize::from(axis(&world)[1] > 0.0);
    }
    assert!((6..=18).contains(&heads), "{heads} heads of 24");
}
