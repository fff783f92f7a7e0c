//! `langevin-rigid check`

mod report;

use std::io::Write as _;

use anyhow::{Context, Result};
use langevin_rigid_bake::check::check as look;

use crate::arguments::Check;
use crate::bars::Bars;
use crate::{meshes, say};
use report::Report;

/// Whether the mesh is ready.
pub(crate) fn check(options: &Check, bars: &Bars) -> Result<bool> {
    let raw = meshes::read(&options.mesh, options.unit)?;
    let checked = look(&raw.vertices, &raw.triangles, bars).context("the check was interrupted")?;
    let report = Report::new(options, raw.unit, &checked);
    bars.clear();
    let text = match options.json {
        true => serde_json::to_string_pretty(&report)? + "\n",
        false => report.table(),
    };
    say::out().write_all(text.as_bytes())?;
    Ok(report.ready)
}
