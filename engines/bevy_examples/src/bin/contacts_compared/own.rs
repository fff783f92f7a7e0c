//! The library's own contacts.

use std::error::Error;
use std::sync::Arc;

use bevy_langevin_rigid::langevin_rigid::{Settings, State, Stepper};
use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};

use crate::cards::{self, FRICTION, SIZE, Way};

const MATERIAL: Material = Material {
    friction: FRICTION,
    restitution: 0.0,
};

/// The ways of cards onto the ground, each in a world of its own.
pub(crate) fn ways(
    card: &Stepper,
    starts: &[State],
    dt: f64,
    steps: usize,
) -> Result<Vec<Way>, Box<dyn Error>> {
    let shape = Shape::cuboid(SIZE.map(|size| 0.5 * size))?;
    let kind = Arc::new(Kind::new(card.clone(), shape, MATERIAL)?);
    let numbered = starts.iter().enumerate();
    numbered
        .map(|(number, start)| way(&kind, start, number, dt, steps))
        .collect()
}

fn way(
    kind: &Arc<Kind>,
    start: &State,
    number: usize,
    dt: f64,
    steps: usize,
) -> Result<Way, Box<dyn Error>> {
    let mut world = World::new(Settings::default().gravity);
    world.set_time(start.time);
    world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, MATERIAL)?);
    let body = world.add(kind.clone(), *start, cards::input(number).noise);
    let mut way = vec![*world.state(body)];
    for _ in 0..steps {
        world.step(dt)?;
        way.push(*world.state(body));
    }
    Ok(way)
}
