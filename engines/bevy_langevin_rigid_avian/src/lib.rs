#![doc = include_str!("../README.md")]
//!
//! # A step
//!
//! In `FixedUpdate` the body takes the step in the fluid alone. Avian, in `FixedPostUpdate`, gets the mean velocities of it,
//! and as mass and inertia those of the body with the fluid that it moves, along the normal of what it touches or, where it
//! touches nothing, along the vertical. A body that met nothing is then where the fluid took it, in double precision;
//! another has what contacts left of these velocities ([`FreeFlight::met`]).
//!
//! The engine solves a contact with one mass, that along the normal; along a surface, where a body may be lighter, friction
//! is made up for afterwards ([`FreeFlight::met`]). What that leaves out: a contact off the centre of a body without
//! symmetry feels no coupling of turning and moving.
//!
//! # Sleep
//!
//! Avian lets bodies sleep that turn slower than 2 rad/s (a `SleepThreshold`, to be changed once a body is `Hosted`) and wakes
//! them. One that sleeps is woken also by an [`AmbientWind`] or an [`ExternalWrench`] that
//! would move it, by [`Loads::STIRRING`] of its weight in the fluid.
//!
//! [`AmbientWind`]: bevy_langevin_rigid::AmbientWind
//! [`FreeFlight::met`]: bevy_langevin_rigid::langevin_rigid::FreeFlight::met
//! [`Loads::STIRRING`]: bevy_langevin_rigid::langevin_rigid::Loads::STIRRING
//! [`ExternalWrench`]: bevy_langevin_rigid::ExternalWrench

mod convert;
mod plugin;
mod steps;

pub use plugin::LangevinRigidAvianPlugin;
