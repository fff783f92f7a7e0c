//! What the tests share.
#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "no test uses all of it; a test may panic"
)]

use std::sync::Arc;

use langevin_rigid::linalg::{Quat, Vec3, quat_from_rotation_vector};
use langevin_rigid::{Body, Fluid, Model, NoiseStream, Settings, State, Stepper};
use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};

pub(crate) const G: f64 = 9.81;
pub(crate) const DOWN: Vec3 = [0.0, -G, 0.0];

/// A fluid so thin that a body in it is all but in a void.
pub(crate) const THIN: Fluid = Fluid {
    density: 1e-9,
    ..Fluid::AIR
};

pub(crate) fn settings(model: Model, gravity: Vec3) -> Settings {
    Settings {
        model,
        gravity,
        ..Settings::default()
    }
}

/// Bodies without drag.
pub(crate) fn kind(body: &Body, fluid: &Fluid, gravity: Vec3, material: Material) -> Arc<Kind> {
    shaped(
        body,
        Shape::of_body(body).unwrap(),
        fluid,
        gravity,
        material,
    )
}

pub(crate) fn shaped(
    body: &Body,
    shape: Shape,
    fluid: &Fluid,
    gravity: Vec3,
    material: Material,
) -> Arc<Kind> {
    let settings = settings(Model::Kirchhoff, gravity);
    let stepper = Stepper::new(body, fluid, None, &settings).unwrap();
    Arc::new(Kind::new(stepper, shape, material).unwrap())
}

pub(crate) fn material(friction: f64, restitution: f64) -> Material {
    Material {
        friction,
        restitution,
    }
}

pub(crate) fn ground(material: Material) -> Obstacle {
    Obstacle::half_space([0.0, 1.0, 0.0], 0.0, material).unwrap()
}

pub(crate) fn at(position: Vec3) -> State {
    State {
        position,
        ..State::default()
    }
}

pub(crate) fn turned(position: Vec3, rotation: Vec3) -> State {
    State {
        position,
        orientation: quat_from_rotation_vector(rotation),
        ..State::default()
    }
}

pub(crate) fn noise(body: u32) -> NoiseStream {
    NoiseStream { seed: 1, body }
}

pub(crate) fn run(world: &mut World, time: f64, dt: f64) {
    for _ in 0..(time / dt).round() as usize {
        world.step(dt).unwrap();
    }
}

pub(crate) const UPRIGHT: Quat = [0.0, 0.0, 0.0, 1.0];

/// Numbers between -1 and 1 that look random and are the same for ever.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self, scale: f64) -> Vec3 {
        std::array::from_fn(|_| scale * self.next())
    }
}
