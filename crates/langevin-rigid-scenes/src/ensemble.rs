//! Ensembles: many releases of one scene, and what they have in common.
//!
//! [`run`] drops the body again and again on all cores; each run has its own noise and its own
//! release, scattered as [`crate::scene::Scatter`] says, and both depend on nothing but the scene's
//! seed and the number of the run. [`Statistics::new`] and [`landings_csv`] make numbers of the
//! [`Fall`]s.

mod fall;
mod motion;
mod scatter;
mod side_by_side;
mod statistics;

use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid::{Body, Hull, Stepper};
use langevin_rigid_bake::progress::Progress;
use rayon::prelude::*;

use crate::scene::Scene;
pub use fall::{Fall, FallEnding, SAMPLES_PER_SECOND};
pub use motion::{Motion, MotionTracker};
pub use scatter::scattered_release;
pub use side_by_side::side_by_side;
pub use statistics::{Statistics, landings_csv};

/// Drops `body` `runs` times as `scene` says, on all cores.
///
/// Run `i` has the noise of body `i` under the scene's seed and the release
/// [`scattered_release`]. The falls come in the order of their runs, with the same bits on any
/// number of threads. Of work that `progress` cancels, the falls that are complete are given.
///
/// The floor of a tank ends a fall when the body's lowest point touches it.
///
/// ```
/// use langevin_rigid_scenes::{baking, ensemble, scene::Scene};
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
/// let bake = baking::bake_scene(&scene, None, &())?.bake;
/// let stepper = baking::stepper(&scene, &bake)?;
/// let falls = ensemble::run(&scene, &bake.body, &stepper, 4, &());
/// let statistics = ensemble::Statistics::new(&falls);
/// assert_eq!(statistics.falling, [4; 7]); // at 0, 1/60, ..., 6/60 s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(
    scene: &Scene,
    body: &Body,
    stepper: &Stepper,
    runs: u32,
    progress: &dyn Progress,
) -> Vec<Fall> {
    let setup = fall::Setup {
        scene,
        stepper,
        hull: Hull::new(&body.surface.vertices),
        thin_axis: motion::thin_axis(body),
    };
    let done = AtomicU32::new(0);
    let falls: Vec<Option<Fall>> = (0..runs)
        .into_par_iter()
        .with_max_len(1)
        .map(|run| {
            let fall = setup.fall(run, &|| progress.cancelled());
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report("dropping", f64::from(done) / f64::from(runs));
            fall
        })
        .collect();
    falls.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests;
