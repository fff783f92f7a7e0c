//! World of Langevin Rigid: what immersed bodies meet besides their fluid.
//!
//! A [`World`] holds bodies, obstacles, wind and water, and steps them together: each body by its own
//! [`Stepper`](langevin_rigid::Stepper), then all of them by the impulses that keep them out of each other. Use it where
//! bodies land, pile up, bump into walls or float. A body that only falls needs `langevin-rigid` alone.
//!
//! ```
//! use std::sync::Arc;
//! use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
//! use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};
//!
//! // Cards that share all but where they are.
//! let settings = Settings::default();
//! let card = Body::plate(0.09, 0.06, 0.002, 700.0)?;
//! let stepper = Stepper::new(&card, &Fluid::AIR, None, &settings)?;
//! let kind = Arc::new(Kind::new(stepper, Shape::of_body(&card)?, Material::default())?);
//!
//! let mut world = World::new(settings.gravity);
//! world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, Material::default())?);
//! for body in 0..3 {
//!     let position = [0.02 * f64::from(body), 0.2 + 0.1 * f64::from(body), 0.0];
//!     world.add(kind.clone(), State { position, ..State::default() }, NoiseStream { seed: 1, body });
//! }
//! while !(0..3).all(|body| world.is_asleep(body)) && world.time() < 20.0 {
//!     world.step(0.004)?;
//! }
//! assert!((0..3).all(|body| world.state(body).position[1] < 0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The example `leaves_on_the_ground` goes on from here: a box, forty leaves, and wind that wakes them.
//!
//! # From a body to a world
//!
//! 1. A [`Shape`] says what of a body touches: the convex hull of its surface, or convex parts of it.
//! 2. A [`Kind`] is a stepper, a shape and a [`Material`]; bodies of one kind share it.
//! 3. An [`Obstacle`] is what stands still: a half-space, a shape, a closed mesh, a terrain.
//! 4. [`World::add`] lets bodies in, [`World::overlap`] tells which begin inside something, [`World::step`] moves all.
//!
//! # Modules
//!
//! - [`water`]: surfaces of water, and bodies that cross them.
//!
//! # Conventions
//!
//! - SI units and radians. World and body frame are those of the run time: +Y is up, the body's origin is its centre of mass.
//! - A mistake is an error when something is made, and names what to mend. A step fails only if a body's own does, and then
//!   no body has moved.
//! - The same bodies, added in the same order, have the same bits on any number of threads.
//!
//! # What is approximate
//!
//! - Fluid does not flow from between surfaces that close, and bodies do not feel each other's flow: added mass is that of
//!   a body alone.
//! - Surfaces are polyhedra. A ball rolls over its corners, and loses a little energy at each.
//! - Impulses are found by iteration, in heaps of many bodies not to the end: what they lack shows as overlap of a fraction
//!   of a millimetre while bodies pour in, which is mended as they come to rest.
//! - Speeds change at the ends of steps: a bounce is exact to the first order of the step.

mod broad;
mod contact;
mod kind;
mod material;
mod obstacle;
mod shape;
mod sleep;
pub mod water;
mod world;

pub use kind::Kind;
pub use material::{Material, MaterialError};
pub use obstacle::{Obstacle, ObstacleError};
pub use shape::{Shape, ShapeError};
pub use world::{Overlap, World, WorldError};
