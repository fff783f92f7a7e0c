//! Where bakes are kept.

use anyhow::Result;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::baking::{
    Baked, CACHE_VARIABLE, SceneBakeError, bake_scene, cache_folder,
};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::Scene;

use crate::say;

/// The scene made ready, its bakes from the cache if they are there.
pub(crate) fn prepare(scene: Scene, progress: &dyn Progress) -> Result<Prepared> {
    let prepared = Prepared::new(scene, cache_folder().as_deref(), progress)?;
    for (_, baked) in prepared.kinds() {
        tell(baked);
    }
    Ok(prepared)
}

/// The scene's bake, from the cache if it is there.
pub(crate) fn bake(scene: &Scene, progress: &dyn Progress) -> Result<Baked, SceneBakeError> {
    let baked = bake_scene(scene, cache_folder().as_deref(), progress)?;
    tell(&baked);
    Ok(baked)
}

fn tell(baked: &Baked) {
    for notice in &baked.notices {
        say::note(notice);
    }
    if let Some(trouble) = &baked.cache_trouble {
        say::warning(format!(
            "{trouble} (set {CACHE_VARIABLE} to a writable folder)"
        ));
    }
}
