//! Run time of Langevin Rigid: light bodies immersed in air or water, in real time.
//!
//! A baked [`Body`] (mass properties and added mass) in a [`Fluid`] becomes a [`Stepper`], which
//! advances a [`State`] by the generalized Kirchhoff equations with generalized Langevin loads
//! (H. Xie and K. Miyata, "Langevin Rigid: Animating Immersed Rigid Bodies in Real-time", 2014).
//! A step allocates nothing, and its noise is a pure function of (seed, body, step): the same run
//! has the same bits on any number of threads and on every platform.
//!
//! SI units throughout. The world is right-handed with +Y up; the body frame has its origin at the
//! centre of mass; six-vectors have their linear part first; quaternions are `[x, y, z, w]`, body to
//! world.
//!
//! What is where, in the order of a step's data flow: [`Body`] and [`Bake`] come in, [`Turbulence`]
//! gives the Langevin coefficients, [`NoiseStream`] the normals, [`Stepper`] moves the [`State`],
//! [`run`] repeats it to the ground; a [`Batch`] of bodies
//! steps in SIMD lanes.

mod bake;
mod batch;
mod body;
mod carlson;
mod elementary;
mod equations;
mod fluid;
mod input;
mod kirchhoff;
mod lanes;
mod langevin;
pub mod linalg;
mod loads;
mod mass_properties;
mod modes;
mod noise;
mod pace;
mod published;
mod real;
mod run;
mod runge_kutta;
mod separated;
mod settings;
mod shape;
mod simple_bodies;
mod state;
mod stepper;
mod stokes;
#[cfg(test)]
mod thin_card;
pub mod turbulence;
mod wake;

pub use bake::{Bake, BakeError};
pub use batch::{Batch, BatchError, Pack, Precision};
pub use body::{Body, BodyError, MOST_SLICES, Part, Separation, Surface, shift_added_mass};
pub use equations::SPEED_LIMIT;
pub use fluid::{Fluid, GRAVITY};
pub use input::{Flow, Input, Wrench};
pub use loads::Loads;
pub use noise::{NORMALS_PER_STEP, NoiseStream};
pub use published::UnitSystem;
pub use run::{Ending, Hull, StopAt, run};
pub use separated::SeparatedFlow;
pub use settings::{Integrator, Model, Settings, UnknownName};
pub use state::State;
pub use stepper::{SetupError, StepError, Stepper, falling_reynolds, falling_speed};
pub use stokes::{stokes_rotation, stokes_translation};
pub use turbulence::{
    HistoryError, LangevinCoefficients, Turbulence, TurbulenceHistory, TurbulenceSource,
    kolmogorov_c0,
};
pub use wake::{SLIP_QUANTILE, Wake};

/// Version of this crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
