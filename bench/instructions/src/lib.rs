//! The benchmarks are in `benches/instructions.rs`.
