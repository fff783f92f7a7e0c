//! Runs for other programs: tables for analysis, animations for pictures.
//!
//! A [`Recording`] is a run: how it was made, its bake, and where every body went. [`write()`] puts it into a folder
//! in a [`Format`]. Tables have every step. Animations have frames at equal times, between which programs
//! interpolate; [`Deviation`] says how far that takes the bodies from where they were.

mod animation;
mod format;
mod frames;
mod gltf;
mod npz;
mod parameters;
#[cfg(feature = "parquet")]
mod parquet;
mod shading;
mod up;
mod usd;

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use langevin_rigid::{Bake, Fluid, Settings};

pub use animation::Deviation;
pub use format::Format;
pub use up::Up;

use crate::files::{self, WriteError};
use crate::track::TrackError;
use crate::trajectory::{Trajectory, write_csv};

/// How a run was made, which animations say beside what they show.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// What the bodies are immersed in.
    pub fluid: &'a Fluid,
    /// Model, integrator, turbulence, gravity.
    pub settings: &'a Settings,
    /// Seed of the noise.
    pub seed: u64,
    /// Time step (s).
    pub time_step: f64,
}

/// A run: the bodies of a scene and where they went.
#[derive(Debug, Clone, Copy)]
pub struct Recording<'a> {
    /// How it was made.
    pub conditions: Conditions<'a>,
    /// Its bake, of which surface and mass properties are shown.
    pub bake: &'a Bake,
    /// One for each body; all have the same shape.
    pub trajectories: &'a [Trajectory],
}

/// How a recording is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Frames a second of animations.
    pub fps: f64,
    /// The axis that points up in tables and USD; glTF has +Y by definition.
    pub up: Up,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            fps: 60.0,
            up: Up::Y,
        }
    }
}

/// Refuses what this build cannot write, before there is anything to lose.
///
/// # Errors
/// [`ExportError::NotBuilt`].
pub fn check(formats: &[Format]) -> Result<(), ExportError> {
    match formats.iter().find(|format| !format.built()) {
        Some(&format) => Err(ExportError::NotBuilt { format }),
        None => Ok(()),
    }
}

/// Why a recording could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A trajectory cannot be shown.
    #[error("body {body}: {error}")]
    Track {
        /// Number of the body.
        body: u32,
        /// What is wrong with its trajectory.
        error: TrackError,
    },
    /// There is no body.
    #[error("there is no trajectory to export: run the scene again")]
    NoBodies,
    /// The run cannot be divided into frames.
    #[error(
        "{fps} frames a second of {duration} s make no animation: ask for a positive rate and at most \
         {most} frames"
    )]
    FrameRate {
        /// Frames a second asked for.
        fps: f64,
        /// Duration of the run (s).
        duration: f64,
        /// The largest number of frames.
        most: usize,
    },
    /// The bodies together make more frames than there may be.
    #[error(
        "{bodies} bodies at {fps} frames a second make {frames:.3e} frames, and at most {most} are possible: \
         ask for fewer frames a second, or for a format that has every step (csv, npz)"
    )]
    TooManyFrames {
        /// How many they make.
        frames: f64,
        /// Frames a second asked for.
        fps: f64,
        /// How many bodies there are.
        bodies: usize,
        /// The largest number of frames.
        most: usize,
    },
    /// More than the format holds.
    #[error("the animation takes {bytes} bytes, a GLB file holds 4 GiB: lower the frames a second")]
    TooLarge {
        /// Its size.
        bytes: u64,
    },
    /// The format was left out of this build.
    #[error(
        "this build cannot write {format}: build it with `cargo build --release --features {format}`"
    )]
    NotBuilt {
        /// The format.
        format: Format,
    },
}

/// Writes a recording into `folder` as [`Format::file_name`] says; of an animation gives how far it strays.
///
/// ```
/// use langevin_rigid::{Bake, Fluid, Input, Model, Settings, State, Stepper};
/// use langevin_rigid_bake::body::{BodySpec, bake_body};
/// use langevin_rigid_bake::shapes::Shape;
/// use langevin_rigid_formats::export::{Conditions, Format, Options, Recording, write};
/// use langevin_rigid_formats::trajectory::Trajectory;
/// let ball = Shape::Ellipsoid { semi_axes: [0.01, 0.01, 0.01] }.mesh(80)?;
/// let spec = BodySpec { density: Some(1100.0), ..BodySpec::default() };
/// let (body, added_mass) = bake_body(&ball, &spec, &())?;
/// let settings = Settings { model: Model::Kirchhoff, ..Settings::default() };
/// let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings)?;
/// let mut states = vec![State::default()];
/// for _ in 0..50 {
///     let mut state = states[states.len() - 1];
///     stepper.step(&mut state, 0.002, &Input::default())?;
///     states.push(state);
/// }
/// let bake = Bake {
///     body,
///     history: None,
///     error_estimate: added_mass.error_estimate,
///     warnings: vec![],
///     fingerprint: [0; 32],
/// };
/// let conditions = Conditions {
///     scene: "ball",
///     fluid: &Fluid::WATER,
///     settings: &settings,
///     seed: 0,
///     time_step: 0.002,
/// };
/// let fall = [Trajectory::new(0, &states)];
/// let recording = Recording { conditions, bake: &bake, trajectories: &fall };
/// let folder = tempfile::tempdir()?;
/// let deviation = write(&recording, Format::Glb, folder.path(), &Options::default())?;
/// assert!(deviation.is_some_and(|s| s.position < 3e-5)); // of 3 mm fallen
/// assert!(folder.path().join("trajectory.glb").is_file());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ExportError`]; no file is left half written.
pub fn write(
    recording: &Recording<'_>,
    format: Format,
    folder: &Path,
    options: &Options,
) -> Result<Option<Deviation>, ExportError> {
    let path = folder.join(format.file_name());
    let trajectories = || options.up.of(recording.trajectories);
    match format {
        Format::Csv => table(&path, |out| write_csv(&trajectories(), out)),
        Format::Npz => table(&path, |out| npz::write(&trajectories(), out)),
        #[cfg(feature = "parquet")]
        Format::Parquet => table(&path, |out| parquet::write(&trajectories(), out)),
        #[cfg(not(feature = "parquet"))]
        Format::Parquet => Err(ExportError::NotBuilt { format }),
        Format::Glb => {
            let (bytes, deviation) = gltf::glb(recording, options.fps)?;
            files::write(&path, &bytes)?;
            Ok(Some(deviation))
        }
        Format::Usd => {
            let layer = usd::Layer::new(recording, options)?;
            files::write_with(&path, |out| layer.write(out))?;
            Ok(Some(layer.deviation))
        }
    }
}

fn table(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<Option<Deviation>, ExportError> {
    files::write_with(path, content)?;
    Ok(None)
}

#[cfg(test)]
mod tests;
