#![doc = include_str!("../README.md")]
//!
//! # A step
//!
//! Rapier moves a body by its velocities and changes them where the body touches something. So each step has three parts:
//!
//! 1. [`ImmersedBodies::before_step`] takes the step in the fluid alone ([`Stepper::fly`]) and gives Rapier the mean
//!    velocities of it; and, as mass and inertia, those of the body with the fluid that it moves, along the normal of what it
//!    touches or, where it touches nothing, along the vertical ([`Stepper::contact_mass`]).
//! 2. `PhysicsPipeline::step`.
//! 3. [`ImmersedBodies::after_step`]: a body that met nothing is where the fluid took it, to the last bit of double
//!    precision; another has what contacts left of these velocities ([`FreeFlight::met`]).
//!
//! The engine solves a contact with one mass, that along the normal; along a surface, where a body may be lighter, friction
//! is made up for afterwards ([`FreeFlight::met`]). What that leaves out: a contact off the centre of a body without
//! symmetry feels no coupling of turning and moving.
//!
//! # Sleep
//!
//! Rapier lets bodies sleep and wakes them when something moves them. A body that sleeps is woken also by a fluid that would
//! move it: by [`Loads::STIRRING`] of its weight in the fluid.
//!
//! [`FreeFlight::met`]: langevin_rigid::FreeFlight::met
//! [`Loads::STIRRING`]: langevin_rigid::Loads::STIRRING
//! [`Stepper::fly`]: langevin_rigid::Stepper::fly
//! [`Stepper::contact_mass`]: langevin_rigid::Stepper::contact_mass

mod bodies;
mod body;
mod convert;

pub use bodies::{ImmersedBodies, Immersion, InsertError, StepTrouble};

/// The library that bodies are stepped with.
pub use langevin_rigid;
