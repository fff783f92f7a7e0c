//! World of Langevin Rigid: what immersed bodies meet besides their fluid.

pub mod water;
