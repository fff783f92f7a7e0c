//! Ensembles: many releases of one scene, and what they have in common.
//!
//! [`run`] drops the body again and again on all cores; each run has its own noise and its own
//! release, body and fluid, drawn as [`crate::scene::Scatter`] says, and all depend on nothing but the scene's
//! seed and the number of the run. [`Statistics::new`] and [`landings()`] sum up the [`Fall`]s.

mod draw;
mod fall;
mod journal;
mod landings;
mod lying;
mod motion_class;
mod side_by_side;
mod statistics;

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid_bake::progress::Progress;
use rayon::prelude::*;

use crate::prepared::Prepared;
pub use draw::{Change, Draw, draw, scattered_release};
pub(crate) use draw::{product, uniform};
pub use fall::{Fall, FallEnding, SAMPLES_PER_SECOND};
pub use journal::{Journal, JournalError};
pub use landings::{LANDINGS_ABOUT, landings};
pub use lying::Lying;
pub(crate) use motion_class::thin_axis;
pub use motion_class::{MotionClass, MotionTracker};
pub use side_by_side::side_by_side;
pub use statistics::{Faces, Statistics};

/// Drops the body of a scene once for each of `runs`, on all cores and in lanes.
///
/// Run `i` has the noise of body `i` under the scene's seed and begins as [`draw`] says. Runs of the same body and fluid
/// fall in lanes. The falls come in the order of their runs, with the same bits on any
/// number of threads and however the runs are shared among processes. Of work that `progress` cancels, the falls that are complete are given.
///
/// The ground, and the floor of a tank, ends a fall when the body's lowest point touches it. In a
/// [world](crate::scene::Scene::is_world) it goes on until the body lies still, which [`Fall::lying`] tells.
///
/// ```
/// use langevin_rigid_scenes::{ensemble, prepared::Prepared, scene::Scene};
/// let scene = Scene::parse("ball", "ball.toml", r#"
///     fluid.preset = "water"
///     run = { time_step = 0.002, duration = 0.1, model = "kirchhoff" }
///     scatter.velocity = 0.1
///     [body]
///     shape = "ellipsoid"
///     semi_axes = [0.01, 0.01, 0.01]
///     triangles = 80
///     density = 1100.0
/// "#)?;
/// let falls = ensemble::run(&Prepared::new(scene, None, &())?, 0..4, &());
/// let statistics = ensemble::Statistics::new(&falls);
/// assert_eq!(statistics.falling, [4; 7]); // at 0, 1/60, ..., 6/60 s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(prepared: &Prepared, runs: Range<u32>, progress: &dyn Progress) -> Vec<Fall> {
    let runs: Vec<u32> = runs.collect();
    let done = AtomicU32::new(0);
    // Nothing is kept, so nothing can fail.
    let falls = run_some(
        prepared,
        &runs,
        &done,
        &|_| Ok::<_, Infallible>(()),
        progress,
    );
    falls.unwrap_or_default()
}

/// The same, with each fall kept in `journal` as soon as those that fell with it have ended, and without the runs that are
/// there already. The falls are those of [`run`], to the bit.
///
/// # Errors
/// [`JournalError`] where it cannot be written.
pub fn run_with(
    prepared: &Prepared,
    runs: Range<u32>,
    journal: &Journal,
    progress: &dyn Progress,
) -> Result<Vec<Fall>, JournalError> {
    let kept: BTreeSet<u32> = journal.kept().iter().map(|fall| fall.run).collect();
    let missing: Vec<u32> = runs.clone().filter(|run| !kept.contains(run)).collect();
    let done = AtomicU32::new((runs.len() - missing.len()) as u32);
    let mut falls = run_some(
        prepared,
        &missing,
        &done,
        &|falls| journal.add(falls),
        progress,
    )?;
    let wanted = journal
        .kept()
        .iter()
        .filter(|fall| runs.contains(&fall.run));
    falls.extend(wanted.cloned());
    falls.sort_by_key(|fall| fall.run);
    Ok(falls)
}

/// The falls of some runs; `done` of all are there already, and `keep` sees those that end together.
fn run_some<E: Send>(
    prepared: &Prepared,
    runs: &[u32],
    done: &AtomicU32,
    keep: &(dyn Fn(&[Fall]) -> Result<(), E> + Sync),
    progress: &dyn Progress,
) -> Result<Vec<Fall>, E> {
    let thin_axis = thin_axis(prepared.body());
    let all = (runs.len() + done.load(Ordering::Relaxed) as usize).max(1) as f64;
    // Several shares for each thread, so that none waits long for the last of another.
    let shares = match rayon::current_num_threads() {
        1 => 1,
        threads => 4 * threads,
    };
    let together = (runs.len() / shares).clamp(1, TOGETHER);
    let falls: Result<Vec<Vec<Fall>>, E> = runs
        .par_chunks(together)
        .map(|some| {
            let ended = || {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.report("dropping", f64::from(done) / all);
            };
            let falls = fall::falls(prepared, thin_axis, some, &|| progress.cancelled(), &ended);
            if !falls.is_empty() {
                keep(&falls)?;
            }
            Ok(falls)
        })
        .collect();
    Ok(falls?.into_iter().flatten().collect())
}

/// Runs that fall together at most: some packs of a batch, few enough that none waits long for the last of the others.
pub(crate) const TOGETHER: usize = 64;

#[cfg(test)]
mod tests;
