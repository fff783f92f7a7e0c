//! Why there is no report.

use langevin_rigid::{BodyError, SetupError};
use langevin_rigid_bake::turbulence::TurbulenceError;
use langevin_rigid_formats::files::WriteError;
use langevin_rigid_pictures::PictureError;
use langevin_rigid_scenes::baking::SceneBakeError;
use langevin_rigid_scenes::prepared::PrepareError;
use langevin_rigid_scenes::scene::{FindError, SceneWindError};
use langevin_rigid_scenes::together::SurroundingsError;

/// Why there is no report, or only a part of it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A built-in scene is damaged.
    #[error(transparent)]
    Scene(#[from] FindError),
    /// A scene could not be baked.
    #[error(transparent)]
    Bake(#[from] SceneBakeError),
    /// A body could not be made ready to step.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A wind is none.
    #[error(transparent)]
    Wind(#[from] SceneWindError),
    /// What bodies meet in a scene is none.
    #[error(transparent)]
    Surroundings(#[from] SurroundingsError),
    /// The turbulence could not be computed.
    #[error(transparent)]
    Turbulence(#[from] TurbulenceError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// Numbers could not be written as JSON.
    #[error(transparent)]
    Json(std::io::Error),
    /// A body cannot be.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The caller's [`Progress`](langevin_rigid_bake::progress::Progress) asked to stop.
    #[error("the report was cancelled")]
    Cancelled,
}

impl From<PrepareError> for ReportError {
    fn from(error: PrepareError) -> Self {
        match error {
            PrepareError::Bake(error) => Self::Bake(error),
            PrepareError::Body(error) => Self::Body(error),
            PrepareError::Setup(error) => Self::Setup(error),
            PrepareError::Wind(error) => Self::Wind(error),
            PrepareError::Surroundings(error) => Self::Surroundings(error),
        }
    }
}
