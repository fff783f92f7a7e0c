//! How the bodies of a scene look in exports.

use langevin_rigid_bake::body::{BodyBakeError, mass_properties};
use langevin_rigid_formats::visual::{Visual, VisualError};

use crate::baking::{SceneBakeError, mesh};
use crate::scene::Scene;

/// Why a body has no such look.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LookError {
    /// Its file cannot be used.
    #[error(transparent)]
    Visual(#[from] VisualError),
    /// The mesh that it belongs to cannot be used.
    #[error(transparent)]
    Bake(#[from] SceneBakeError),
    /// The mesh has no centre of mass.
    #[error(transparent)]
    Body(#[from] BodyBakeError),
}

/// The look that a scene gives its body, placed as its mesh is; none where it gives none.
///
/// # Errors
/// [`LookError`].
pub fn look(scene: &Scene) -> Result<Option<Visual>, LookError> {
    let Some(path) = &scene.body.visual else {
        return Ok(None);
    };
    let mut visual = Visual::read(path)?;
    let (mesh, _) = mesh(scene)?;
    visual.centre_of_mass = mass_properties(&mesh, &scene.body.spec)?.centre_of_mass;
    Ok(Some(visual))
}
