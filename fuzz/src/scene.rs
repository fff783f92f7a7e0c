//! Scene files.

use langevin_rigid_scenes::scene::Scene;

/// Reads a scene, and what is written of it again.
pub(crate) fn read(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else {
        return;
    };
    match Scene::parse("fuzz", "fuzz.toml", text) {
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert!(
                (1..=text.split('\n').count()).contains(&error.line),
                "{error}"
            );
            assert!((1..=text.len() + 1).contains(&error.column), "{error}");
        }
        Ok(scene) => {
            let resolved = scene.to_toml().unwrap();
            let again = Scene::parse("fuzz", "fuzz.toml", &resolved);
            // Compared as text, in which numbers read back to the bit.
            let again = again.unwrap_or_else(|error| panic!("{error}\n{resolved}"));
            assert_eq!(format!("{again:?}"), format!("{scene:?}"), "{resolved}");
        }
    }
}
