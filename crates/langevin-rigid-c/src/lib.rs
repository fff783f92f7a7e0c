//! C interface of Langevin Rigid's run time: for engines, and for programs in C, C++ and C#.
//!
//! `include/langevin_rigid.h` declares all of it and says how its pointers are handled; a test keeps the two the same. The
//! functions here check what they are given, call the crate `langevin-rigid` and hand on what it returns, so a step has
//! the same bits from C as from Rust.

#![expect(
    non_camel_case_types,
    reason = "types have the names that they have in C"
)]
#![expect(
    clippy::missing_safety_doc,
    reason = "it is the same for all functions, and at the head of the header"
)]

mod body;
mod fluid;
mod input;
mod loads;
mod pointers;
mod settings;
mod state;
mod status;
mod stepper;
mod vector;
mod version;
mod wind;

pub use body::*;
pub use fluid::*;
pub use input::*;
pub use loads::*;
pub use settings::*;
pub use state::*;
pub use status::{lr_last_error, lr_status};
pub use stepper::*;
pub use vector::*;
pub use version::*;
pub use wind::*;
