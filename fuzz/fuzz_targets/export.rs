//! The target `export`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("export");
