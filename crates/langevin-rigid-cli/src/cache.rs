//! Where bakes are kept.

use std::sync::Arc;

use anyhow::Result;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::baking::{
    Baked, CACHE_VARIABLE, SceneBakeError, bake_scene, cache_folder,
};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::Scene;

use crate::say;

/// The scene made ready, its bake from the cache if it is there.
pub(crate) fn prepare(scene: Scene, progress: &dyn Progress) -> Result<Prepared> {
    let baked = bake(&scene, progress)?;
    let baked = Arc::new(baked);
    Ok(Prepared::with_bake(
        scene,
        baked,
        cache_folder().as_deref(),
        progress,
    )?)
}

/// The scene's bake, from the cache if it is there.
pub(crate) fn bake(scene: &Scene, progress: &dyn Progress) -> Result<Baked, SceneBakeError> {
    let baked = bake_scene(scene, cache_folder().as_deref(), progress)?;
    for notice in &baked.notices {
        say::note(notice);
    }
    if let Some(trouble) = &baked.cache_trouble {
        say::warning(format!(
            "{trouble}; the bake was not kept (set {CACHE_VARIABLE} to a writable folder)"
        ));
    }
    Ok(baked)
}
