//! All cases in their order.

use std::error::Error;

use crate::fnv::Fnv;
use crate::{cases, scenes};

/// What a case came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// Model, body, density, fluid, time step, and how it was stepped; or a scene and what of it.
    pub name: String,
    /// FNV-1a of the bits of its states, or of what it names.
    pub hash: u64,
}

/// Runs all cases; the last line has the hash of all before it.
///
/// # Errors
/// A body that cannot be set up or stepped, a scene that cannot be baked.
pub fn lines() -> Result<Vec<Line>, Box<dyn Error>> {
    let mut lines = cases::lines()?;
    lines.extend(scenes::lines()?);
    let mut all = Fnv::default();
    lines.iter().for_each(|line| all.word(line.hash));
    lines.push(Line {
        name: "all".into(),
        hash: all.0,
    });
    Ok(lines)
}
