//! The target `consistent`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("consistent");
