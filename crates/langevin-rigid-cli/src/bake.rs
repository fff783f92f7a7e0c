//! `langevin-rigid bake`

use std::io::Write;
use std::path::PathBuf;

use anyhow::Result;
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_scenes::scene;

use crate::arguments::Bake;
use crate::bars::Bars;
use crate::{cache, say};

pub(crate) fn bake(options: &Bake, bars: &Bars) -> Result<()> {
    let scene = scene::find(&options.scene)?;
    let default = || PathBuf::from(format!("{}.lrbake", scene.name));
    let path = options.out.clone().unwrap_or_else(default);
    let _claim = Claim::file(&path)?;
    let baked = cache::bake(&scene, bars)?;
    let bytes = baked.bake.to_bytes();
    files::write(&path, &bytes)?;
    for warning in &baked.bake.warnings {
        say::warning(warning);
    }
    let surface = &baked.bake.body.surface;
    writeln!(
        say::out(),
        "{}: {} triangles, {} panels, {} bytes",
        path.display(),
        surface.triangles.len(),
        surface.panels.len(),
        bytes.len()
    )?;
    Ok(())
}
