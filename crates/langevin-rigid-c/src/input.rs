//! What acts on a body over a step.

use langevin_rigid::{Flow, Input, NoiseStream, Wrench};

use crate::vector::{lr_mat3, lr_vec3};

/// The fluid around a body as it would be without it, on top of the velocity of `lr_fluid`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct lr_flow {
    /// Velocity u at the centre of mass, world frame (m/s).
    pub velocity: lr_vec3,
    /// Its gradient there, world frame (1/s): row i has the derivatives of u_i along x, y and z, so a wind along x that grows
    /// with height has a positive `gradient.x.y`.
    pub gradient: lr_mat3,
    /// Material acceleration Du/Dt there, world frame (m/s^2): the push of a wind that changes in time.
    pub acceleration: lr_vec3,
}

/// A force and a torque.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct lr_wrench {
    /// Force, world frame (N).
    pub force: lr_vec3,
    /// Torque about the centre of mass, world frame (N m).
    pub torque: lr_vec3,
}

/// What acts on a body over one step. All zero is fluid at rest, no wrench, and the first noise of seed 0.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct lr_input {
    /// The fluid around the body.
    pub flow: lr_flow,
    /// What else acts on it: contacts, strings, thrusters.
    pub wrench: lr_wrench,
    /// Seed of the noise: that of a run.
    pub seed: u64,
    /// Number of the body: bodies with different numbers have different noise.
    pub body: u32,
}

/// Fluid at rest, no wrench, seed 0, body 0.
#[unsafe(no_mangle)]
pub extern "C" fn lr_input_default() -> lr_input {
    lr_input::default()
}

impl From<Flow> for lr_flow {
    fn from(flow: Flow) -> Self {
        Self {
            velocity: flow.velocity.into(),
            gradient: flow.gradient.into(),
            acceleration: flow.acceleration.into(),
        }
    }
}

impl From<lr_flow> for Flow {
    fn from(flow: lr_flow) -> Self {
        Self {
            velocity: flow.velocity.into(),
            gradient: flow.gradient.into(),
            acceleration: flow.acceleration.into(),
        }
    }
}

impl From<Wrench> for lr_wrench {
    fn from(wrench: Wrench) -> Self {
        Self {
            force: wrench.force.into(),
            torque: wrench.torque.into(),
        }
    }
}

impl From<lr_wrench> for Wrench {
    fn from(wrench: lr_wrench) -> Self {
        Self {
            force: wrench.force.into(),
            torque: wrench.torque.into(),
        }
    }
}

impl From<lr_input> for Input {
    fn from(input: lr_input) -> Self {
        Self {
            flow: input.flow.into(),
            wrench: input.wrench.into(),
            noise: NoiseStream {
                seed: input.seed,
                body: input.body,
            },
        }
    }
}
