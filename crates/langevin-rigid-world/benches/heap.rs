//! Wall-clock time of a simulated tenth of a second of a heap of thin plates, while it is poured and at rest.
#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a benchmark may panic and is nobody's interface"
)]

use std::sync::Arc;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};

const TIME_STEP: f64 = 4e-3;

/// Plates, fifty of which are let go each second over a square of 0.3 m, until there are `count`.
fn poured(count: u32) -> World {
    let settings = Settings::default();
    let plate = Body::plate(0.08, 0.05, 1e-3, 500.0).unwrap();
    let stepper = Stepper::new(&plate, &Fluid::AIR, None, &settings).unwrap();
    let material = Material::default();
    let kind = Kind::new(stepper, Shape::of_body(&plate).unwrap(), material).unwrap();
    let kind = Arc::new(kind);
    let mut world = World::new(settings.gravity);
    world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, material).unwrap());
    for number in 0..count {
        let [x, z] = [0.754877, 0.569840].map(|step| (f64::from(number) * step).fract());
        let state = State {
            position: [0.3 * (x - 0.5), 1.0, 0.3 * (z - 0.5)],
            orientation: quat_from_rotation_vector([3.0 * x, 6.0 * z, 2.0 * x]),
            ..State::default()
        };
        let noise = NoiseStream {
            seed: 1,
            body: number,
        };
        world.add(kind.clone(), state, noise);
        run(&mut world, 0.02);
    }
    world
}

fn run(world: &mut World, time: f64) {
    for _ in 0..(time / TIME_STEP).round() as usize {
        world.step(TIME_STEP).unwrap();
    }
}

fn heap(c: &mut Criterion) {
    let mut group = c.benchmark_group("0.1 s of 300 plates");
    group.sample_size(10);
    let moving = poured(300);
    let mut resting = moving.clone();
    run(&mut resting, 10.0);
    for (name, world) in [("poured", moving), ("at rest", resting)] {
        group.bench_function(name, |b| {
            let begin = || world.clone();
            b.iter_batched_ref(begin, |world| run(world, 0.1), BatchSize::LargeInput);
        });
    }
    group.finish();
}

criterion_group!(benches, heap);
criterion_main!(benches);
