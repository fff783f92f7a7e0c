//! What bodies do in fluids, as hashes that must be the same on every processor.
//!
//! A case is a body in a fluid under a model, stepped alone or in a batch; its hash is of every bit of its
//! states. `sameness/run` compares the hashes between compilers' settings and processors.

mod bodies;
mod cases;
#[path = "../../crates/langevin-rigid/tests/common/mod.rs"]
mod common;
mod fnv;
#[cfg(target_family = "wasm")]
mod wasm;

pub use cases::{Line, lines};

/// The SIMD instructions that the run time found, or none.
pub fn simd() -> String {
    format!("{:?}", fearless_simd::Level::new())
}
