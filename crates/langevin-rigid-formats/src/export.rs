//! Runs for other programs: tables for analysis, animations for pictures.
//!
//! A [`Recording`] is a run: how it was made, the kinds of its bodies, and where every body went. [`write()`] puts
//! it into a folder in a [`Format`]. Tables have every step. Animations have frames at equal times, and keys between
//! them for bodies that turn far from frame to frame. Programs interpolate between keys; [`Deviation`] says how far
//! that takes the bodies from where they were.

mod animation;
mod bodies;
mod format;
mod frames;
mod gltf;
mod keys;
#[cfg(feature = "npz")]
mod npz;
mod parameters;
#[cfg(feature = "parquet")]
mod parquet;
mod recording;
mod shading;
mod up;
mod usd;

use std::io;
use std::path::Path;

use animation::Animation;
pub use animation::Deviation;
pub use bodies::{BodyRow, read_bodies};
pub use format::Format;
pub use recording::{Conditions, Kind, RecordedBody, Recording};
pub use up::Up;

use crate::files::{self, WriteError};
use crate::track::TrackError;
use crate::trajectory::write_csv;

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
    /// A body is of a kind that is not there.
    #[error("body {body} is of kind {kind}, and there are {kinds} kinds, counted from 0")]
    UnknownKind {
        /// Number of the body.
        body: u32,
        /// Its kind.
        kind: usize,
        /// How many kinds there are.
        kinds: usize,
    },
    /// A body has no possible size.
    #[error("body {body} has the scale {scale}: give a positive number")]
    Scale {
        /// Number of the body.
        body: u32,
        /// Its scale.
        scale: f64,
    },
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
    /// Visuals of many parts on many bodies.
    #[error(
        "the visuals of {bodies} bodies make {nodes} objects, and at most {most} are possible: join the objects of \
         a visual, or export fewer bodies"
    )]
    TooManyNodes {
        /// How many nodes they make.
        nodes: usize,
        /// How many bodies there are.
        bodies: usize,
        /// The largest number of nodes.
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

/// What was written of a recording.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Written {
    /// Names of the files in the folder, that of the format first.
    pub files: Vec<String>,
    /// Of an animation, how far it strays from the trajectories.
    pub deviation: Option<Deviation>,
    /// What is not as one might expect and what to do about it, a sentence each.
    pub warnings: Vec<String>,
}

impl Written {
    fn note(&mut self, animation: &Animation) {
        self.deviation = Some(animation.deviation);
        self.warnings.extend(animation.warning());
    }
}

/// Writes a recording into `folder`: a file as [`Format::file_name`] says, and `bodies.csv` beside a table of bodies
/// that differ in kind or size.
///
/// ```
/// use langevin_rigid::{Bake, Fluid, Input, Model, Settings, State, Stepper};
/// use langevin_rigid_bake::body::{BodySpec, bake_body};
/// use langevin_rigid_bake::shapes::Shape;
/// use langevin_rigid_formats::export::{Conditions, Format, Kind, Options, RecordedBody, Recording, write};
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
/// let fall = Trajectory::new(0, &states);
/// let recording = Recording {
///     conditions,
///     kinds: &[Kind::new("ball", &bake)],
///     bodies: &[RecordedBody::from(&fall)],
/// };
/// let folder = tempfile::tempdir()?;
/// let written = write(&recording, Format::Glb, folder.path(), &Options::default())?;
/// assert!(written.deviation.is_some_and(|s| s.position < 3e-5)); // of 3 mm fallen
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
) -> Result<Written, ExportError> {
    recording.check()?;
    let path = folder.join(format.file_name());
    let trajectories = || recording.trajectories(options.up);
    let mut written = Written {
        files: vec![format.file_name().to_owned()],
        ..Written::default()
    };
    match format {
        Format::Csv => table(&path, |out| write_csv(&trajectories(), out))?,
        #[cfg(feature = "npz")]
        Format::Npz => table(&path, |out| npz::write(recording, options.up, out))?,
        #[cfg(feature = "parquet")]
        Format::Parquet => table(&path, |out| parquet::write(&trajectories(), out))?,
        Format::Glb => {
            let (bytes, animation) = gltf::glb(recording, options.fps)?;
            files::write(&path, &bytes)?;
            written.note(&animation);
        }
        Format::Usd => {
            let layer = usd::Layer::new(recording, options)?;
            files::write_with(&path, |out| layer.write(out))?;
            written.note(&layer.animation);
            written.warnings.extend(recording.without_visuals());
        }
        #[cfg(not(all(feature = "npz", feature = "parquet")))]
        format => return Err(ExportError::NotBuilt { format }),
    }
    // NumPy's arrays have it all, and animations show it.
    if matches!(format, Format::Csv | Format::Parquet) && !recording.is_uniform() {
        let path = folder.join(bodies::FILE_NAME);
        table(&path, |out| bodies::write(recording, out))?;
        written.files.push(bodies::FILE_NAME.to_owned());
    }
    Ok(written)
}

fn table(
    path: &Path,
    content: impl FnOnce(&mut files::Out) -> io::Result<()>,
) -> Result<(), WriteError> {
    files::write_with(path, content)
}

#[cfg(test)]
mod tests;
