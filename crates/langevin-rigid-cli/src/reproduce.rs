//! `langevin-rigid reproduce`

use std::io::Write;

use anyhow::Result;
use langevin_rigid_report::{Options, PARTS, Part};

use crate::arguments::Reproduce;
use crate::bars::Bars;
use crate::cache;

pub(crate) fn reproduce(options: &Reproduce, bars: &Bars) -> Result<()> {
    // The order of the page, whatever the order asked for; each part once.
    let wanted = |part: &&Part| options.only.is_empty() || options.only.contains(part);
    let report = langevin_rigid_report::reproduce(
        &Options {
            parts: PARTS.iter().filter(wanted).copied().collect(),
            seeds: options.seeds,
            first_seed: options.seed,
            cache: cache::folder(),
        },
        &options.out,
        bars,
    )?;
    bars.clear();
    if report.sections.is_empty() {
        anyhow::bail!("interrupted before a part was finished");
    }
    let names: Vec<&str> = report.sections.iter().map(|s| s.id).collect();
    let state = if report.complete { "" } else { ", interrupted" };
    writeln!(
        std::io::stdout(),
        "wrote {} ({}{state})",
        report.page.display(),
        names.join(", ")
    )?;
    Ok(())
}
