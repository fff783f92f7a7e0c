//! What the viewer of Langevin Rigid shows, computed.

#[cfg(target_arch = "wasm32")]
mod binding;
