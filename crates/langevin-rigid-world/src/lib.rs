//! World of Langevin Rigid: what immersed bodies meet besides their fluid.

mod broad;
mod contact;
mod material;
mod obstacle;
mod shape;
mod sleep;
mod world;

pub use material::{Material, MaterialError};
pub use obstacle::{Obstacle, ObstacleError};
pub use shape::{Shape, ShapeError};
pub use world::{Kind, Overlap, World, WorldError};
pub mod water;
