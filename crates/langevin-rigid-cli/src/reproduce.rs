//! `langevin-rigid reproduce`

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use langevin_rigid_formats::budget::Need;
use langevin_rigid_formats::files::Claim;
use langevin_rigid_report::Options;
use langevin_rigid_report::pages::{self, Computed};
use langevin_rigid_scenes::baking::cache_folder;

use crate::arguments::Reproduce;
use crate::bars::Bars;
use crate::{forecast, say};

/// Steps and memory of a seed in a part, at the least.
const SEED: [f64; 2] = [500.0, 1e4];

pub(crate) fn reproduce(options: &Reproduce, bars: &Bars) -> Result<()> {
    let plan = plan(options)?;
    if let Some(manual) = &options.update {
        pages::list(manual)?;
    }
    let _claim = Claim::folder(&options.out)?;
    let work = || langevin_rigid_report::reproduce(&plan, &options.out, bars);
    let report = bars.stoppable(work)?;
    bars.clear();
    if report.sections.is_empty() {
        anyhow::bail!("interrupted before a part was finished");
    }
    let names: Vec<&str> = report.sections.iter().map(|s| s.id).collect();
    let state = if report.complete { "" } else { ", interrupted" };
    writeln!(
        say::out(),
        "wrote {} ({}{state})",
        report.page.display(),
        names.join(", ")
    )?;
    if let Some(manual) = &options.update {
        let computed: Vec<Computed> = report
            .sections
            .iter()
            .map(|section| (section.id, section.tables.as_slice()))
            .collect();
        update(manual, &computed)?;
    }
    Ok(())
}

/// Writes tables into the pages of a folder and says into which.
pub(crate) fn update(manual: &Path, computed: &[Computed]) -> Result<()> {
    for page in pages::update(manual, computed)? {
        say::note(format!("updated {}", page.display()));
    }
    Ok(())
}

fn plan(options: &Reproduce) -> Result<Options> {
    let (seeds, first) = (options.seeds, options.seed);
    let parts = (!options.only.is_empty()).then_some(options.only.as_slice());
    let plan = Options::new(parts, seeds, first, cache_folder())
        .with_context(|| format!("`--seeds {seeds} --seed {first}`"))?;
    let [steps, bytes] = SEED.map(|each| f64::from(seeds) * each);
    forecast::check(Need::new(bytes, steps), &format!("`--seeds {seeds}`"))?;
    Ok(plan)
}
