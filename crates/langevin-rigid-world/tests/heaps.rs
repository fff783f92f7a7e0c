//! Heaps of thin plates: at rest nothing is in anything, and the bits are the same on any number of threads.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::sync::Arc;

use common::*;
use langevin_rigid::{Body, Fluid, Model, Stepper};
use langevin_rigid_world::{Kind, Shape, World};

const THICKNESS: f64 = 0.001;

fn plate() -> Arc<Kind> {
    let body = Body::plate(0.08, 0.05, THICKNESS, 500.0).unwrap();
    let stepper =
        Stepper::new(&body, &Fluid::AIR, None, &settings(Model::Separated, DOWN)).unwrap();
    let shape = Shape::of_body(&body).unwrap();
    Arc::new(Kind::new(stepper, shape, material(0.5, 0.1)).unwrap())
}

/// Pours so many plates over a square of this edge (m), fifty a second, and lets them lie for at most `time` (s).
fn heap(count: u32, edge: f64, dt: f64, time: f64) -> World {
    let kind = plate();
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(material(0.5, 0.1)));
    let mut numbers = Numbers(2);
    for number in 0..count {
        let [x, _, z] = numbers.vector(0.5 * edge);
        let body = world.add(
            kind.clone(),
            turned([x, 1.0, z], numbers.vector(3.0)),
            noise(number),
        );
        while world.overlap(body).is_some() {
            let mut higher = *world.state(body);
            higher.position[1] += 0.05;
            world.set_state(body, &higher);
        }
        run(&mut world, 0.02, dt);
    }
    while world.time() < time && !(0..world.len()).all(|body| world.is_asleep(body)) {
        world.step(dt).unwrap();
    }
    world
}

fn lies_apart(world: &World, awake_at_most: usize) {
    let awake = (0..world.len())
        .filter(|body| !world.is_asleep(*body))
        .count();
    let overlaps = (0..world.len()).filter_map(|body| world.overlap(body));
    let mut deep: Vec<_> = overlaps
        .filter(|overlap| overlap.depth > 0.1 * THICKNESS + 1e-4)
        .collect();
    deep.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    assert!(
        deep.is_empty(),
        "{} overlaps, first {}",
        deep.len(),
        deep[0]
    );
    assert!(awake <= awake_at_most, "{awake} awake");
}

#[test]
fn plates_come_to_rest_apart() {
    lies_apart(&heap(150, 0.3, 4e-3, 20.0), 0);
}

#[test]
#[ignore = "half a minute"]
fn five_hundred_plates_come_to_rest_apart() {
    // Under the others one or the other may still creep.
    lies_apart(&heap(500, 0.5, 4e-3, 40.0), 5);
}

/// FNV-1a over the bits of all states.
fn hash(world: &World) -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for body in 0..world.len() {
        let state = world.state(body);
        let pose = state.position.into_iter().chain(state.orientation);
        let motion = state.velocity.into_iter().chain(state.angular_velocity);
        for byte in pose.chain(motion).flat_map(|x| x.to_bits().to_le_bytes()) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    hash
}

#[test]
fn bits_are_the_same_on_any_number_of_threads_and_for_ever() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| hash(&heap(40, 0.15, 4e-3, 2.0)))
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, 0x1fc7_ef8b_0029_4997, "{one:#018x}");
}
