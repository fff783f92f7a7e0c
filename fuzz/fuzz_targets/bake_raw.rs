//! The target `bake_raw`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("bake_raw");
