//! Run time of Langevin Rigid.

pub mod turbulence;
