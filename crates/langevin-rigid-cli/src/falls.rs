//! The bodies of a scene, dropped.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

use anyhow::{Result, bail};
use langevin_rigid::{Ending, Hull, NoiseStream, State, StepError, Stepper, run};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::budget;
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_scenes::advance::advance;
use langevin_rigid_scenes::baking::Baked;
use langevin_rigid_scenes::ensemble::side_by_side;
use langevin_rigid_scenes::scene::Scene;
use rayon::prelude::*;

use crate::bars::Bars;
use crate::forecast;

/// One body from its release to how it ended.
pub(crate) struct Fall {
    pub(crate) body: u32,
    /// The release first.
    pub(crate) states: Vec<State>,
    pub(crate) ended: Result<Ending, StepError>,
    /// Whether it was stopped because memory holds no more of it.
    pub(crate) full: bool,
}

impl Fall {
    pub(crate) fn ending(&self) -> &'static str {
        match self.ended {
            Ok(Ending::Ground) => "ground",
            Ok(Ending::Time) => "time",
            Ok(Ending::Stopped) if self.full => "memory",
            Ok(Ending::Stopped) => "interrupted",
            Err(_) => "diverged",
        }
    }

    pub(crate) fn trajectory(&self) -> Trajectory {
        Trajectory::new(self.body, &self.states)
    }
}

/// Drops so many bodies on all cores; without those that had not begun when Ctrl-C came.
pub(crate) fn drop_bodies(
    scene: &Scene,
    baked: &Baked,
    stepper: &Stepper,
    hull: &Hull,
    bodies: u32,
    bars: &Bars,
) -> Vec<Fall> {
    let done = AtomicU32::new(0);
    let most = budget::spare() / (u64::from(bodies) * forecast::STATE as u64);
    let falls: Vec<Option<Fall>> = (0..bodies)
        .into_par_iter()
        .with_max_len(1)
        .map(|body| {
            if body > 0 && bars.cancelled() {
                return None;
            }
            // The walls of a tank go with the release.
            let own = Scene {
                release: side_by_side(scene, &baked.bake.body, body),
                ..scene.clone()
            };
            let report = |state: &State| {
                if bodies == 1 {
                    bars.report("simulating", fraction(scene, state));
                }
            };
            let stop = |kept: usize| bars.cancelled() || kept as u64 >= most;
            let fall = drop_body(&own, stepper, hull, body, stop, report);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            if bodies > 1 {
                bars.report("simulating", f64::from(done) / f64::from(bodies));
            }
            Some(Fall {
                full: fall.states.len() as u64 >= most,
                ..fall
            })
        })
        .collect();
    falls.into_iter().flatten().collect()
}

fn drop_body(
    scene: &Scene,
    stepper: &Stepper,
    hull: &Hull,
    body: u32,
    stop: impl Fn(usize) -> bool,
    report: impl Fn(&State),
) -> Fall {
    let noise = NoiseStream {
        seed: scene.seed,
        body,
    };
    let mut state = scene.release;
    let mut states = vec![state];
    let ended = run(
        |state| advance(scene, stepper, state, &noise),
        &mut state,
        scene.time_step,
        hull,
        &scene.stop,
        |state| {
            states.push(*state);
            if state.step % 4096 == 0 {
                report(state);
            }
            if stop(states.len()) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
    );
    Fall {
        body,
        states,
        ended,
        full: false,
    }
}

fn fraction(scene: &Scene, state: &State) -> f64 {
    let of_time = scene.stop.time.map_or(0.0, |end| state.time / end);
    let of_way = scene.stop.ground.map_or(0.0, |ground| {
        let start = scene.release.position[1];
        (start - state.position[1]) / (start - ground)
    });
    of_time.max(of_way)
}

/// Refuses a run that ends before it begins, or never.
pub(crate) fn check_start(scene: &Scene, baked: &Baked, hull: &Hull) -> Result<()> {
    let Some(ground) = scene.stop.ground else {
        return Ok(());
    };
    let lowest = hull.lowest(&scene.release);
    if lowest <= ground {
        bail!(
            "the body already touches the ground at release (its lowest point is at {lowest:.4} m, \
             the ground at {ground} m); release it higher"
        );
    }
    let body = &baked.bake.body;
    if scene.stop.time.is_none() && body.mass <= scene.fluid.density * body.volume {
        bail!(
            "the body is no heavier than the fluid and may never reach the ground; give the run a \
             duration (`--duration S`, or `duration` under [run])"
        );
    }
    Ok(())
}
