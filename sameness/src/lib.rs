//! What bodies do in fluids, as hashes that must be the same on every processor.
//!
//! A case is a body in a fluid under a model, stepped alone or in a batch, or a built-in scene, baked and
//! dropped; its hash is of every bit of what came of it. `sameness/run` compares the hashes between compilers'
//! settings and processors; `pinned` has that of all.

mod bodies;
mod cases;
#[path = "../../crates/langevin-rigid/tests/common/mod.rs"]
mod common;
mod fnv;
mod line;
mod scenes;
#[cfg(target_family = "wasm")]
mod wasm;

pub use line::{Line, lines};

/// The SIMD instructions that the run time found, or none.
pub fn simd() -> String {
    format!("{:?}", fearless_simd::Level::new())
}
