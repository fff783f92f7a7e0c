//! `langevin-rigid scenes`

use std::io::Write;

use anyhow::Result;
use langevin_rigid_scenes::scene::BUILT_IN;

use crate::say;

pub(crate) fn scenes() -> Result<()> {
    let width = BUILT_IN.iter().map(|s| s.name.len()).max().unwrap_or(0);
    let mut out = say::out();
    for built_in in BUILT_IN {
        writeln!(
            out,
            "{:width$}  {}",
            built_in.name,
            built_in.scene()?.description
        )?;
    }
    Ok(())
}
