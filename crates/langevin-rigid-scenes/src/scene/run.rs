//! How a scene is run: choices, steps, and when it ends.

use langevin_rigid::{Integrator, Model, Settings, StopAt, TurbulenceSource};
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{DURATION, GAIN, GRAVITY, PLACE, REYNOLDS, SIZE, TIME_STEP};
use super::raw::{RawRun, RawTurbulence};
use super::{MAX_STEPS, Scene};

/// Why a run cannot be divided into steps.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepsError {
    /// The first step would be the last, and too long.
    #[error(
        "a `time_step` of {time_step:e} s is longer than the run, whose `duration` is {duration:e} s: \
         shorten the step or lengthen the duration"
    )]
    NoStep {
        /// Time step (s).
        time_step: f64,
        /// Duration of the run (s).
        duration: f64,
    },
    /// More than [`MAX_STEPS`].
    #[error(
        "a `time_step` of {time_step:e} s in a `duration` of {duration:e} s makes {steps:.3e} steps, and \
         {:e} are possible: lengthen the step or shorten the duration",
        MAX_STEPS as f64
    )]
    TooMany {
        /// Time step (s).
        time_step: f64,
        /// Duration of the run (s).
        duration: f64,
        /// Steps that they make.
        steps: f64,
    },
}

impl Scene {
    /// The most steps that a run takes; the ground may end it sooner.
    ///
    /// A run without a time to end at stops after [`MAX_STEPS`].
    ///
    /// ```
    /// let mut leaf = langevin_rigid_scenes::scene::find("leaf")?;
    /// assert_eq!(leaf.steps()?, 5000);
    /// leaf.time_step = 1e-9;
    /// assert!(leaf.steps().is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`StepsError`], for a time step that was changed after the scene was parsed.
    pub fn steps(&self) -> Result<u64, StepsError> {
        steps(self.time_step, self.stop.time)
    }
}

fn steps(time_step: f64, duration: Option<f64>) -> Result<u64, StepsError> {
    let Some(duration) = duration else {
        return Ok(MAX_STEPS);
    };
    let steps = duration / time_step;
    if time_step > duration {
        Err(StepsError::NoStep {
            time_step,
            duration,
        })
    } else if steps <= MAX_STEPS as f64 * (1.0 + 1e-9) {
        Ok(steps.round() as u64)
    } else {
        Err(StepsError::TooMany {
            time_step,
            duration,
            steps,
        })
    }
}

/// The time step, checked against the duration (s).
pub(super) fn time_step(
    doc: &Document,
    raw: &Spanned<RawRun>,
    stop: &StopAt,
) -> Result<f64, SceneError> {
    let Some(given) = &raw.get_ref().time_step else {
        return Err(doc.error(raw.span(), "the run needs a `time_step` (s)"));
    };
    let time_step = doc.number(given, "time_step", TIME_STEP)?;
    match steps(time_step, stop.time) {
        Ok(_) => Ok(time_step),
        Err(error) => Err(doc.error(given.span(), error.to_string())),
    }
}

pub(super) fn settings(
    doc: &Document,
    run: &RawRun,
    turbulence: &RawTurbulence,
) -> Result<Settings, SceneError> {
    let defaults = Settings::default();
    let model = match &run.model {
        Some(name) => doc.name::<Model>(name, "model")?,
        None => defaults.model,
    };
    let gravity = |g| doc.numbers(g, "gravity", GRAVITY);
    Ok(Settings {
        model,
        integrator: integrator(doc, run, model)?,
        turbulence: source(doc, run)?,
        gravity: run.gravity.as_ref().map_or(Ok(defaults.gravity), gravity)?,
        turbulence_length: doc.given(&turbulence.length, "length", SIZE)?,
        reynolds: doc.given(&run.reynolds, "reynolds", REYNOLDS)?,
        ..defaults
    })
}

/// Which stream of noise a single run has.
pub(super) fn stream(doc: &Document, run: &RawRun) -> Result<u32, SceneError> {
    run.stream
        .as_ref()
        .map_or(Ok(0), |given| doc.count(given, "stream", 0..=u32::MAX))
}

fn integrator(doc: &Document, run: &RawRun, model: Model) -> Result<Integrator, SceneError> {
    let published = matches!(model, Model::Published(_));
    let Some(name) = &run.integrator else {
        return Ok(model.integrator());
    };
    let integrator = doc.name(name, "integrator")?;
    if published && integrator != Integrator::RungeKutta4 {
        let message = "the model `published` is defined with the integrator `rk4` only";
        return Err(doc.error(name.span(), message));
    }
    Ok(integrator)
}

fn source(doc: &Document, run: &RawRun) -> Result<TurbulenceSource, SceneError> {
    let Some(name) = &run.turbulence else {
        return Ok(TurbulenceSource::default());
    };
    let source = doc.name(name, "turbulence")?;
    match source {
        TurbulenceSource::BodyDriven { wake_age } if !GAIN.includes(wake_age) => {
            let message = format!("the wake age of `turbulence` must be {GAIN} lengths l");
            Err(doc.error(name.span(), message))
        }
        source => Ok(source),
    }
}

/// The ground is the tank's floor or `ground`, whichever is higher.
pub(super) fn stop(
    doc: &Document,
    run: &Spanned<RawRun>,
    floor: Option<f64>,
) -> Result<StopAt, SceneError> {
    let raw = run.get_ref();
    let ground = doc.given(&raw.ground, "ground", PLACE)?;
    let stop = StopAt {
        time: doc.given(&raw.duration, "duration", DURATION)?,
        ground: [ground, floor].into_iter().flatten().reduce(f64::max),
    };
    if stop == StopAt::default() {
        let message = "the run would never end: give a `duration` (s), a `ground` (height in m), both, or a [tank]";
        return Err(doc.error(run.span(), message));
    }
    Ok(stop)
}

/// The body begins above the ground.
pub(super) fn check_height(
    doc: &Document,
    run: &RawRun,
    stop: &StopAt,
    height: f64,
) -> Result<(), SceneError> {
    match (&run.ground, stop.ground) {
        (Some(given), Some(ground)) if height <= ground => {
            let message = format!(
                "the ground is at {ground} m and the body is released at {height} m; release it higher"
            );
            Err(doc.error(given.span(), message))
        }
        _ => Ok(()),
    }
}
