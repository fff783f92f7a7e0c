//! `langevin-rigid check`

mod remedy;
mod report;

use std::io::Write as _;

use anyhow::{Result, bail};
use langevin_rigid_bake::mesh::survey;

use crate::arguments::Check;
use crate::bars::Bars;
use crate::{meshes, say};
use remedy::Remedy;
use report::Report;

/// Whether the mesh is ready.
pub(crate) fn check(options: &Check, bars: &Bars) -> Result<bool> {
    let raw = meshes::read(&options.mesh, options.unit)?;
    let Some(survey) = survey(&raw.vertices, &raw.triangles, bars) else {
        bail!("the check was interrupted");
    };
    let remedy = match &survey.body {
        Ok(_) => Remedy::default(),
        Err(_) => Remedy::find(&raw, &survey, bars),
    };
    if bars.interrupted() {
        bail!("the check was interrupted");
    }
    let report = Report::new(options, raw.unit, &survey, &remedy);
    bars.clear();
    let text = match options.json {
        true => serde_json::to_string_pretty(&report)? + "\n",
        false => report.table(),
    };
    say::out().write_all(text.as_bytes())?;
    Ok(report.ready)
}
