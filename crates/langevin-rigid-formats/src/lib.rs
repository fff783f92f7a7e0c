//! Files of Langevin Rigid: what comes in (meshes, scenes) and what goes out (bakes, trajectories,
//! animations, ensembles, regimes, pictures, added mass for other programs).

pub mod added_mass;
pub mod advance;
pub mod baking;
pub mod budget;
pub mod ensemble;
pub mod export;
pub mod files;
pub mod mesh;
pub mod motion;
pub mod picture;
pub mod regimes;
pub mod scene;
pub mod trajectory;
