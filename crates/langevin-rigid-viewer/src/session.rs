//! A scene made ready, and its runs.

use std::path::Path;

use langevin_rigid::Body;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::export::BodyRow;
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_scenes::prepared::{PrepareError, Prepared, ReleaseError};
use langevin_rigid_scenes::scene::StepsError;
use langevin_rigid_scenes::scene::{Scene, SceneError};
use langevin_rigid_scenes::together::TogetherError;

use crate::run::{ReplayError, Run};

/// States that a run keeps at most: some hundred megabytes.
const MOST_STATES: usize = 1_000_000;

/// A scene with its bake and its stepper.
#[derive(Debug)]
pub struct Session {
    prepared: Prepared,
}

/// Why a scene cannot be shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// Its text is no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It would take too many steps.
    #[error(transparent)]
    Steps(#[from] StepsError),
    /// It cannot be made ready.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// Its run would be none.
    #[error(transparent)]
    Release(#[from] ReleaseError),
    /// Its bodies cannot be let go.
    #[error(transparent)]
    Together(#[from] TogetherError),
}

impl Session {
    /// Reads the text of a scene and bakes its body, or takes the bake from the folder `cache`.
    ///
    /// # Errors
    /// [`SessionError`].
    pub fn open(
        name: &str,
        text: &str,
        cache: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Self, SessionError> {
        let scene = Scene::parse(name, name, text)?;
        scene.steps()?;
        let prepared = Prepared::new(scene, cache, progress)?;
        prepared.check_release()?;
        Ok(Self { prepared })
    }

    /// The scene with its bake.
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    /// The kinds of bodies with their bakes, the scene's own first.
    pub fn kinds(&self) -> impl Iterator<Item = (&str, &Body)> {
        let kinds = self.prepared.kinds();
        kinds.map(|(scene, baked)| (scene.name.as_str(), &baked.bake.body))
    }

    /// Drops the body, or lets the bodies of a world go.
    ///
    /// # Errors
    /// [`SessionError::Together`]. A step that fails is none: the run ends there and says so.
    pub fn drop(&self, progress: &dyn Progress) -> Result<Run, SessionError> {
        let falls = match self.prepared.surroundings() {
            Some(_) => self.prepared.drop_together(1, MOST_STATES, progress)?,
            None => {
                let release = self.prepared.release(0);
                vec![self.prepared.drop_within(&release, MOST_STATES, progress)]
            }
        };
        Ok(Run::of_falls(&falls))
    }

    /// A run that was made before, from its tables.
    ///
    /// # Errors
    /// [`ReplayError`].
    pub fn replay(
        &self,
        trajectories: Vec<Trajectory>,
        rows: &[BodyRow],
    ) -> Result<Run, ReplayError> {
        let kinds = self.kinds().map(|(name, _)| name);
        Run::of_tables(trajectories, rows, &kinds.collect::<Vec<_>>())
    }
}
