//! `langevin-rigid turbulence`

use std::fmt::Write as _;
use std::io::Write as _;

use anyhow::Result;
use langevin_rigid::{Turbulence as Sample, TurbulenceHistory};
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_scenes::{baking, scene};

use crate::arguments::Turbulence;
use crate::bars::Bars;
use crate::{cache, say};

pub(crate) fn turbulence(options: &Turbulence, bars: &Bars) -> Result<()> {
    let scene = scene::find(&options.scene)?;
    let _claim = options.out.as_deref().map(Claim::file).transpose()?;
    let bake = cache::bake(&scene, bars)?.bake;
    let history = match bake.history {
        Some(history) => history,
        None => baking::history(&scene, &bake.body, bars)?,
    };
    let table = table(&history);
    match &options.out {
        Some(path) => files::write(path, table.as_bytes())?,
        None => say::out().write_all(table.as_bytes())?,
    }
    Ok(())
}

fn table(history: &TurbulenceHistory) -> String {
    let mut table = String::from("t,k,epsilon,chi\n");
    for (i, (&k, &epsilon)) in history.k.iter().zip(&history.epsilon).enumerate() {
        let chi = Sample { k, epsilon }.frequency();
        // Writing to a string cannot fail.
        let _ = writeln!(table, "{},{k},{epsilon},{chi}", i as f64 * history.interval);
    }
    table
}
