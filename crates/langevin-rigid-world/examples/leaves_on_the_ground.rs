//! Forty leaves fall on the ground and on each other, come to rest, and fly up again when wind comes.

use std::error::Error;
use std::sync::Arc;

use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::wind::{Wind, WindField};
use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};

/// Steps of four milliseconds.
const TIME_STEP: f64 = 4e-3;

/// How many sleep.
fn asleep(world: &World) -> usize {
    (0..world.len())
        .filter(|body| world.is_asleep(*body))
        .count()
}

fn main() -> Result<(), Box<dyn Error>> {
    let settings = Settings::default();
    let leaf = Body::plate(0.08, 0.05, 0.5e-3, 450.0)?;
    let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &settings)?;
    let material = Material {
        friction: 0.5,
        restitution: 0.1,
    };
    let kind = Arc::new(Kind::new(stepper, Shape::of_body(&leaf)?, material)?);

    let mut world = World::new(settings.gravity);
    world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, material)?);
    let box_of_wood = Shape::cuboid([0.1, 0.05, 0.1])?;
    let upright = [0.0, 0.0, 0.0, 1.0];
    world.add_obstacle(Obstacle::shape(
        box_of_wood,
        [0.0, 0.05, 0.0],
        upright,
        material,
    )?);

    for number in 0..40 {
        let turn = f64::from(number);
        let state = State {
            position: [
                0.2 * turn.sin(),
                0.4 + 0.04 * turn,
                0.2 * (1.7 * turn).sin(),
            ],
            orientation: quat_from_rotation_vector([0.3 * turn.cos(), turn, 0.3]),
            ..State::default()
        };
        let noise = NoiseStream {
            seed: 1,
            body: number,
        };
        let body = world.add(kind.clone(), state, noise);
        if let Some(overlap) = world.overlap(body) {
            return Err(overlap.into());
        }
    }

    while asleep(&world) < world.len() && world.time() < 12.0 {
        world.step(TIME_STEP)?;
    }
    let on_box = |body: &usize| world.state(*body).position[1] > 0.1;
    let count = (0..world.len()).filter(on_box).count();
    println!(
        "after {:.1} s {} of {} lie still, {count} of them on the box",
        world.time(),
        asleep(&world),
        world.len()
    );

    let mut wind = Wind::default();
    wind.add(WindField::Uniform([5.0, 0.0, 0.0]))?;
    world.set_wind(wind, [0.0; 3]);
    let end = world.time() + 1.0;
    while world.time() < end {
        world.step(TIME_STEP)?;
    }
    println!("a second of wind later {} lie still", asleep(&world));
    Ok(())
}
