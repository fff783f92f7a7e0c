//! Run time of Langevin Rigid: light bodies immersed in air or water, in real time.
//!
//! Leaves flutter, coins tumble in water, sheets of paper drift, balloons follow the wind: rigid bodies whose motion is
//! shaped by the fluid around them. The generalized Kirchhoff equations with generalized Langevin loads move them (H. Xie
//! and K. Miyata, "Langevin Rigid: Animating Immersed Rigid Bodies in Real-time", 2014), with a closure for separated
//! flow on top. A step needs no grid and no panels.
//!
//! It is not a rigid-body engine: it knows no contacts, joints or collisions, but takes their forces as a [`Wrench`]; the
//! crate `langevin-rigid-world` has contacts and water. Nor is it a fluid solver: [`Fluid`] and [`Flow`] prescribe the
//! fluid, and bodies do not disturb it for one another. It opens no files, starts no threads and has no unsafe code.
//!
//! ```
#![doc = include_str!("../examples/drop_a_leaf.rs")]
//! ```
//!
//! # From a body to its trajectory
//!
//! 1. A [`Body`] holds mass properties, added mass, and what the closure for separated flow needs. [`Body::sphere`],
//!    [`Body::plate`] and others make simple ones; a mesh is baked once, by the crate `langevin-rigid-bake` or the
//!    command `langevin-rigid bake`, and read as a [`Bake`].
//! 2. A [`Stepper`] is the body in a [`Fluid`] under [`Settings`]: which [`Model`], which [`Integrator`], which
//!    [`TurbulenceSource`]. It is made once and may be shared by any number of bodies of that shape.
//! 3. [`Stepper::step`] advances a [`State`] under an [`Input`]: the [`Flow`] and the [`Wrench`] of the moment, and the
//!    [`NoiseStream`] of the body. [`run`] repeats it until the body reaches the ground or the time is up.
//! 4. [`Batch`] holds many bodies of one shape. They step in SIMD lanes, and in [`Pack`]s on any number of threads.
//! 5. [`Stepper::loads`] returns what acts on the body, by cause, as [`Loads`].
//! 6. Where a physics engine has the contacts, [`Stepper::fly`] returns a step as velocities for it, a [`FreeFlight`].
//!
//! A step of any length is stable, allocates nothing and takes microseconds. What cannot be done is an error
//! ([`SetupError`], [`StepError`], [`BatchError`]) that says what is wrong and leaves the state as it was.
//!
//! # Conventions
//!
//! - SI units throughout, angles in radians.
//! - The world is right-handed; +Y is up, unless [`Settings::gravity`] says otherwise.
//! - The body frame has its origin at the centre of mass, and the axes of the mesh. Plates and discs have their thin
//!   axis along y.
//! - Vectors and matrices are plain arrays, matrices by rows; six-vectors have their linear part first.
//! - Quaternions are `[x, y, z, w]` and turn body vectors into world vectors.
//! - Velocities of a [`State`] are in the body frame; [`State::world_velocity`] and similar methods convert them. Forces,
//!   torques and flows are in the world frame, torques about the centre of mass.
//! - `gradient[i][j]` of a [`Flow`] is du_i/dx_j: a wind along x that grows with height has a positive
//!   `gradient[0][1]`. Half its curl is the rate at which the fluid turns, counter-clockwise positive.
//! - Added mass is per unit density of the fluid, positive where the fluid resists acceleration.
//! - Noise is a pure function of (seed, body, step): the same run has the same bits on any number of threads, from a
//!   saved state, and on every platform.
//!
//! # Modules
//!
//! Everything is at the root except three modules: [`linalg`], the vectors, rotations and small matrices that the types are
//! written in; [`turbulence`], the precomputed history and the coefficients of the Langevin equation; and [`wind`], velocity
//! fields that vary in space and time, which give a step its [`Flow`]. [`Wake`],
//! [`stokes_translation`] and [`shift_added_mass`] are what the precomputation shares with the run time.
//!
//! # Features
//!
//! None is on by default.
//!
//! - `mint`: converts poses, velocities, wrenches and flows to and from the types of any engine's algebra, in either
//!   precision: `State::mint_pose`, `Wrench::from_mint` and similar methods. A single array does not need the feature:
//!   `mint::Vector3::from` converts it.
//! - `serde`: writes and reads states, settings, bodies and inputs. Choices have the names that scenes give them, such as
//!   `"separated"`; what is left out of [`Settings`], [`Input`] and their parts takes its default. Numbers keep their
//!   bits if the format allows it; `serde_json` needs its feature `float_roundtrip` for that. JSON has no infinities and
//!   no NaN: `serde_json` writes `null` for them and then refuses to read it. [`Stepper::new`] checks a body that was
//!   read.

mod ambient;
mod bake;
mod batch;
mod body;
mod carlson;
mod choice;
mod elementary;
mod equations;
mod fluid;
mod free_flight;
mod input;
mod kirchhoff;
mod lanes;
mod langevin;
pub mod linalg;
mod loads;
mod mass_properties;
#[cfg(feature = "mint")]
mod mint;
mod modes;
#[cfg(feature = "serde")]
mod names;
mod noise;
mod pace;
mod published;
mod real;
mod run;
mod runge_kutta;
mod separated;
mod settings;
mod simple_bodies;
mod state;
mod stepper;
mod stokes;
mod surface_pressure;
mod symmetry;
#[cfg(test)]
mod thin_card;
pub mod turbulence;
mod wake;
pub mod wind;
mod world;

pub use bake::{Bake, BakeError};
pub use batch::{Batch, BatchError, Pack, Precision};
pub use body::{Body, BodyError, MOST_SLICES, Separation, Slice, Surface, shift_added_mass};
pub use choice::{UnknownName, choose};
pub use equations::SPEED_LIMIT;
pub use fluid::{Fluid, GRAVITY};
pub use free_flight::{ContactMass, FreeFlight};
pub use input::{Flow, Input, Wrench};
pub use loads::Loads;
pub use noise::{NORMALS_PER_STEP, NoiseStream};
pub use published::UnitSystem;
pub use run::{Ending, Hull, StopAt, run};
pub use separated::SeparatedFlow;
pub use settings::{Integrator, Model, Settings};
pub use state::State;
pub use stepper::{SetupError, StepError, Stepper, falling_reynolds, falling_speed};
pub use stokes::{stokes_rotation, stokes_translation};
pub use turbulence::{
    HistoryError, LangevinCoefficients, Turbulence, TurbulenceHistory, TurbulenceSource,
    kolmogorov_c0,
};
pub use wake::{SLIP_QUANTILE, Wake};
pub use world::Tank;

/// Version of this crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
