#![doc = include_str!("../README.md")]
//!
//! # Order
//!
//! Bodies step in `FixedUpdate`, in the order of [`LangevinRigidSystems`]; after all fixed steps of a frame their
//! `Transform`s are drawn between the last two. What a game sets in `FixedUpdate` for the coming step, such as an
//! [`ExternalWrench`], it sets before [`LangevinRigidSystems::Read`]. The length of a step is that of `Time<Fixed>`; any
//! length is stable.
//!
//! # What a game may do
//!
//! - Move a body: whoever writes its `Transform` puts the body there, with the velocities it has.
//! - Read and set [`LinearVelocity`] and [`AngularVelocity`].
//! - Push it with an [`ExternalWrench`], which acts until it is changed.
//! - Hold it: a body with a parent goes where the parent takes it, and is at rest when it is let go
//!   (`remove_parent_in_place`).
//! - Change [`ImmersionSettings`] and [`AmbientWind`] at any time.
//! - Scale it. The body has the size that its entity has when it joins; later changes of scale only change what is
//!   drawn.
//!
//! # Same bits
//!
//! The states of the bodies ([`Stepped`]) are in double precision, and a pure function of what was spawned, of what the
//! game set before which fixed step, and of the seed: neither the frame rate nor the number of threads changes a bit. When a
//! body joins that is baked from its mesh depends on how long that takes; load a [`BakedBody`] where that matters.
//! With a [`LevelOfDetail`] the states also depend on where the viewer is at each fixed step.
//!
//! # Conventions
//!
//! SI units, angles in radians, +Y up, world frame. Bodies do not meet one another or the ground: contacts are
//! a physics engine's, to which a body is [`Hosted`].

mod ambient;
mod baked_body;
mod baking;
mod components;
mod crowd;
mod detail;
mod draw;
mod drawn;
mod faults;
#[cfg(feature = "gizmos")]
mod gizmos;
mod handed;
mod join;
mod loads;
mod medium;
mod moving;
mod pace;
mod plain_fall;
mod plugin;
mod quarantine;
mod regions;
mod said;
mod shedding;
mod sleepers;
mod stepped;
mod steppers;
mod steps;
mod winds;

pub use ambient::{AmbientWind, ImmersionSettings};
pub use baked_body::{BakedBody, BakedBodyLoader, BakedBodyLoaderSettings, LoadError};
pub use components::{
    AngularVelocity, BodySource, ExternalWrench, Hosted, Immersed, LinearVelocity, Quarantined,
};
pub use detail::LevelOfDetail;
#[cfg(feature = "gizmos")]
pub use gizmos::{ForceGizmos, ForceGizmosPlugin, ShowForces};
pub use handed::{Handed, Motion};
pub use loads::BodyLoads;
pub use plugin::{LangevinRigidPlugin, LangevinRigidSystems};
pub use regions::{Extent, FluidRegion};
pub use shedding::{Crown, DropLeaves, Leaf, LeafLimit, LeavesShed, ShedFrom};
pub use sleepers::Sleepers;
pub use stepped::Stepped;
pub use winds::{Fan, LocalWind};

/// The library that the plugin steps bodies with.
pub use langevin_rigid;
/// What bakes bodies of meshes.
pub use langevin_rigid_bake;
/// The library's bodies between two fluids.
pub use langevin_rigid_world;
