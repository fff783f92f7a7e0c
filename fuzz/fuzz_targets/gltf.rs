//! The target `gltf`.
#![cfg_attr(fuzzing, no_main)]
langevin_rigid_fuzz::target!("gltf");
