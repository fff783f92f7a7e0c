//! Where bakes are kept.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::baking::{Baked, SceneBakeError, bake_scene};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::Scene;

use crate::say;

const VARIABLE: &str = "LANGEVIN_RIGID_CACHE";

pub(crate) fn folder() -> Option<PathBuf> {
    let named = std::env::var_os(VARIABLE)
        .filter(|v| !v.is_empty())
        .map(PathBuf::from);
    named.or_else(|| Some(dirs::cache_dir()?.join("langevin-rigid")))
}

/// The scene made ready, its bake from the cache if it is there.
pub(crate) fn prepare(scene: Scene, progress: &dyn Progress) -> Result<Prepared> {
    let baked = bake(&scene, progress)?;
    let baked = Arc::new(baked);
    Ok(Prepared::with_bake(
        scene,
        baked,
        folder().as_deref(),
        progress,
    )?)
}

/// The scene's bake, from the cache if it is there.
pub(crate) fn bake(scene: &Scene, progress: &dyn Progress) -> Result<Baked, SceneBakeError> {
    let baked = bake_scene(scene, folder().as_deref(), progress)?;
    for notice in &baked.notices {
        say::note(notice);
    }
    if let Some(trouble) = &baked.cache_trouble {
        say::warning(format!(
            "{trouble}; the bake was not kept (set {VARIABLE} to a writable folder)"
        ));
    }
    Ok(baked)
}
