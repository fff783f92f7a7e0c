//! What the page calls.

use langevin_rigid_scenes::scene::BUILT_IN;
use wasm_bindgen::prelude::*;

/// Names of the built-in scenes.
#[wasm_bindgen]
pub fn scene_names() -> Vec<String> {
    BUILT_IN.iter().map(|scene| scene.name.to_owned()).collect()
}
