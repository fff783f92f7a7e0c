//! The target `collada`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("collada");
