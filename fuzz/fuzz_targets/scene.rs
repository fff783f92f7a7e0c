//! The target `scene`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("scene");
