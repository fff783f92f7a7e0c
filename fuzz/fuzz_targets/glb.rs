//! The target `glb`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("glb");
