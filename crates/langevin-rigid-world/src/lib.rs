//! World of Langevin Rigid: what immersed bodies meet besides their fluid.

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
