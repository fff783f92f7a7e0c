//! Many bodies of a scene in real time: do their steps keep up with 60 frames a second?
//!
//! All bodies begin at the scene's release, each with noise of its own; walls, floors and other bodies do not act.
//!
//! ```
//! use langevin_rigid_scenes::prepared::Prepared;
//! use langevin_rigid_scenes::real_time::real_time;
//! use langevin_rigid_scenes::scene::Scene;
//! let scene = Scene::parse("ball", "ball.toml", r#"
//!     fluid.preset = "water"
//!     run = { time_step = 0.002, duration = 1.0 }
//!     body = { shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }
//! "#)?;
//! let ball = Prepared::new(scene, None, &())?;
//! let crowd = real_time(&ball, 100, 0.1, &())?;
//! assert_eq!(crowd.frames, 6);
//! assert!(crowd.median_frame_ms <= crowd.longest_frame_ms);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::time::{Duration, Instant};

use langevin_rigid::{Batch, BatchError};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::budget::{self, Need, TooMuch};
use rayon::prelude::*;
use serde::Serialize;

use crate::prepared::Prepared;

/// Frames a second.
pub const FRAMES_PER_SECOND: f64 = 60.0;

const FRAME: Duration = Duration::from_nanos(1_000_000_000 / 60);

/// Memory of a body in the batch (bytes): its state in lanes, and what a growing list holds ready.
const BODY: f64 = 300.0;

/// How many bodies kept up with their frames.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RealTime {
    /// Name of the scene.
    pub scene: String,
    /// Name of the model.
    pub model: String,
    /// Bodies that were stepped.
    pub bodies: u32,
    /// Threads that shared them.
    pub threads: usize,
    /// Time step (s).
    pub time_step: f64,
    /// Frames that were shown.
    pub frames: usize,
    /// Frames whose steps took longer than a frame.
    pub missed_frames: usize,
    /// Median of the time that the steps of a frame took (ms).
    pub median_frame_ms: f64,
    /// The longest such time (ms).
    pub longest_frame_ms: f64,
    /// How long the steps of each frame took.
    #[serde(skip)]
    pub spent: Vec<Duration>,
}

/// Why bodies cannot be stepped in real time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RealTimeError {
    /// There are none.
    #[error("there are no bodies; at least one is stepped")]
    NoBodies,
    /// It is no time.
    #[error("the time is {0} s; it must be a positive number")]
    Seconds(f64),
    /// It cannot be done here.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// Some bodies could not take a step.
    #[error(transparent)]
    Step(#[from] BatchError),
    /// Its progress cancelled it.
    #[error("interrupted before the first frame")]
    Cancelled,
}

/// What it takes to step so many bodies for so long (s), in steps of `time_step` (s).
pub fn need(bodies: u32, seconds: f64, time_step: f64) -> Need {
    let frames = seconds * FRAMES_PER_SECOND * size_of::<Duration>() as f64;
    let steps = f64::from(bodies) * (seconds / time_step);
    Need::new(f64::from(bodies) * BODY + frames, steps)
}

/// Steps so many bodies of the scene on all cores for so long (s): each frame begins when it is due, or at once where the one
/// before took too long. When `progress` cancels, the frames until then count.
///
/// # Errors
/// [`RealTimeError`]; [`RealTimeError::Cancelled`] where there was no frame.
pub fn real_time(
    prepared: &Prepared,
    bodies: u32,
    seconds: f64,
    progress: &dyn Progress,
) -> Result<RealTime, RealTimeError> {
    let scene = prepared.scene();
    if bodies == 0 {
        return Err(RealTimeError::NoBodies);
    }
    if !(seconds > 0.0 && seconds.is_finite()) {
        return Err(RealTimeError::Seconds(seconds));
    }
    let need = need(bodies, seconds, scene.time_step);
    budget::check(need, &format!("{bodies} bodies for {seconds:?} s"))?;
    let mut batch = Batch::new(scene.seed);
    for _ in 0..bodies {
        batch.push(&scene.release);
    }
    let spent = frames(prepared, &mut batch, seconds, progress)?;
    let mut sorted = spent.clone();
    sorted.sort_unstable();
    let (Some(median), Some(longest)) = (sorted.get(sorted.len() / 2), sorted.last()) else {
        return Err(RealTimeError::Cancelled);
    };
    let milliseconds = |time: &Duration| 1e3 * time.as_secs_f64();
    Ok(RealTime {
        scene: scene.name.clone(),
        model: scene.settings.model.to_string(),
        bodies,
        threads: rayon::current_num_threads(),
        time_step: scene.time_step,
        frames: spent.len(),
        missed_frames: spent.iter().filter(|&&time| time > FRAME).count(),
        median_frame_ms: milliseconds(median),
        longest_frame_ms: milliseconds(longest),
        spent,
    })
}

/// How long the steps of each frame took, until the end or until they were cancelled.
fn frames(
    prepared: &Prepared,
    batch: &mut Batch,
    seconds: f64,
    progress: &dyn Progress,
) -> Result<Vec<Duration>, BatchError> {
    let frames = (seconds * FRAMES_PER_SECOND).ceil() as usize;
    let time_step = prepared.scene().time_step;
    let mut spent = Vec::with_capacity(frames);
    let mut steps = 0u64;
    let mut due = Instant::now();
    for number in 1..=frames {
        let started = Instant::now();
        let wanted = (number as f64 / FRAMES_PER_SECOND / time_step).round() as u64;
        step(prepared, batch, wanted - steps, progress)?;
        // The last frame may then be a part of one.
        if progress.cancelled() {
            break;
        }
        steps = wanted;
        spent.push(started.elapsed());
        progress.report("crowd", number as f64 / frames as f64);
        due = (due + FRAME).max(Instant::now());
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
    }
    Ok(spent)
}

/// Steps of all bodies, shared among the threads: each takes its share through all of them, as bodies
/// do not meet.
fn step(
    prepared: &Prepared,
    batch: &mut Batch,
    steps: u64,
    progress: &dyn Progress,
) -> Result<(), BatchError> {
    let (stepper, wind) = (prepared.stepper(), prepared.wind());
    let dt = prepared.scene().time_step;
    let packs = batch.packs_mut();
    let share = packs
        .len()
        .div_ceil(4 * rayon::current_num_threads())
        .max(1);
    packs.par_chunks_mut(share).try_for_each(|share| {
        (0..steps)
            .take_while(|_| !progress.cancelled())
            .try_for_each(|_| stepper.step_packs_in(share, dt, wind, 0.0))
    })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::scene::Scene;

    fn ball(time_step: f64) -> Prepared {
        let text = format!(
            "fluid.preset = \"water\"\nrun = {{ time_step = {time_step:?}, duration = 1.0 }}\n\
             body = {{ shape = \"ellipsoid\", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }}"
        );
        let scene = Scene::parse("ball", "ball.toml", &text).unwrap();
        Prepared::new(scene, None, &()).unwrap()
    }

    #[test]
    fn every_frame_has_its_time() {
        let started = Instant::now();
        let crowd = real_time(&ball(0.002), 50, 0.2, &()).unwrap();
        // In real time: the last frame began 11 frames after the first.
        assert!(started.elapsed() >= 11 * FRAME);
        assert_eq!((crowd.frames, crowd.spent.len()), (12, 12));
        let missed = crowd.spent.iter().filter(|time| **time > FRAME).count();
        assert_eq!(crowd.missed_frames, missed);
        let longest = crowd.spent.iter().max().unwrap();
        assert!((crowd.longest_frame_ms - 1e3 * longest.as_secs_f64()).abs() < 1e-9);
        assert!(0.0 < crowd.median_frame_ms && crowd.median_frame_ms <= crowd.longest_frame_ms);
    }

    #[test]
    fn the_steps_of_the_frames_are_those_of_the_time() {
        // 12 frames are 0.2 s; at a step of 7 ms that is 28.6 steps.
        let prepared = ball(0.007);
        let mut batch = Batch::new(0);
        batch.push(&prepared.scene().release);
        frames(&prepared, &mut batch, 0.2, &()).unwrap();
        assert_eq!(batch.state(0).unwrap().step, 29);
    }

    #[test]
    fn frames_until_it_is_cancelled_count() {
        /// Lets so many frames be reported.
        struct After(AtomicUsize);
        impl Progress for After {
            fn report(&self, _: &str, _: f64) {
                self.0.fetch_sub(1, Ordering::Relaxed);
            }
            fn cancelled(&self) -> bool {
                self.0.load(Ordering::Relaxed) == 0
            }
        }
        let after = |frames| After(AtomicUsize::new(frames));
        let crowd = real_time(&ball(0.002), 10, 600.0, &after(3)).unwrap();
        assert_eq!(crowd.frames, 3);
        let none = real_time(&ball(0.002), 10, 600.0, &after(0));
        assert!(matches!(none, Err(RealTimeError::Cancelled)));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let ball = ball(0.002);
        let refused = |bodies, seconds| {
            let refused = real_time(&ball, bodies, seconds, &()).unwrap_err();
            refused.to_string()
        };
        assert!(refused(0, 1.0).contains("at least one"));
        assert!(refused(1, f64::NAN).contains("the time is NaN s"));
        assert!(refused(1, -1.0).contains("must be a positive number"));
        assert!(refused(1, f64::INFINITY).contains("must be a positive number"));
        assert!(refused(u32::MAX, 1e9).contains("4294967295 bodies for 1000000000.0 s would take"));
    }
}
