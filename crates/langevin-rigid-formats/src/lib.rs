//! Files of Langevin Rigid: what comes in (meshes) and what goes out (trajectories, animations, added
//! mass for other programs), and what writes them whole or not at all.

pub mod added_mass;
pub mod budget;
pub mod export;
pub mod files;
pub mod mesh;
pub mod motion;
pub mod trajectory;
