//! Files of Langevin Rigid: mesh readers, scenes, bakes, trajectories, pictures.

pub mod mesh;
pub mod picture;
