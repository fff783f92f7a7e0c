//! Scenes of Langevin Rigid: what to simulate, as files and built in, and what is done with them: bakes that
//! are kept, steps, ensembles of falls, maps of the regimes.

pub mod advance;
pub mod baking;
pub mod ensemble;
pub mod prepared;
pub mod regimes;
pub mod scene;
