//! `langevin-rigid simulate`

use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Result, bail};
use langevin_rigid::{
    Ending, Hull, Integrator, Model, NoiseStream, State, StepError, Stepper, run,
};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::advance::advance;
use langevin_rigid_formats::baking::{self, Baked};
use langevin_rigid_formats::scene::{self, Scene};
use langevin_rigid_formats::{files, trajectory};

use crate::arguments::Simulate;
use crate::bars::Bars;
use crate::cache;
use crate::pictures::{self, Shot};
use crate::summary::Summary;

pub(crate) fn simulate(options: &Simulate, bars: &Bars) -> Result<()> {
    let mut scene = scene::find(&options.scene)?;
    apply(options, &mut scene);
    let folder = options
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("out").join(&scene.name));

    let started = Instant::now();
    let baked = cache::bake(&scene, bars)?;
    let bake_seconds = started.elapsed().as_secs_f64();
    let stepper = baking::stepper(&scene, &baked.bake)?;
    let hull = Hull::new(&baked.bake.body.surface.vertices);
    check_start(&scene, &baked, &hull)?;

    let started = Instant::now();
    let (states, ended) = drop_body(&scene, &stepper, &hull, bars);
    let run_seconds = started.elapsed().as_secs_f64();

    let mut summary = Summary::new(&scene, &baked, &stepper, &states, ending_name(&ended));
    summary.seconds.bake = bake_seconds;
    summary.seconds.run = run_seconds;
    summary.seconds.per_step = run_seconds / summary.steps.max(1) as f64;
    let shot = Shot::new(options, &scene, &baked, &states);
    write_all(&folder, &scene, &states, &shot, &mut summary)?;
    let film = match &options.frames {
        Some(folder) => Some(pictures::film(&shot, folder, options.fps, bars)?),
        None => None,
    };
    bars.clear();
    tell(options, &folder, &summary)?;
    if let Some(film) = film {
        film.tell(options.json)?;
    }
    if let Err(error) = ended {
        bail!(
            "{error}\nthe {} states before it are in {}",
            states.len(),
            folder.display()
        );
    }
    Ok(())
}

/// The command line's word is above the scene's.
fn apply(options: &Simulate, scene: &mut Scene) {
    scene.seed = options.seed.unwrap_or(scene.seed);
    scene.time_step = options.dt.unwrap_or(scene.time_step);
    scene.stop.time = options.duration.or(scene.stop.time);
    scene.settings.turbulence = options.turbulence.unwrap_or(scene.settings.turbulence);
    set_model(options.model, scene);
}

/// Another model than the scene's brings the integrator it is meant for.
pub(crate) fn set_model(model: Option<Model>, scene: &mut Scene) {
    if let Some(model) = model.filter(|m| *m != scene.settings.model) {
        scene.settings.model = model;
        scene.settings.integrator = match model {
            Model::Published(_) => Integrator::RungeKutta4,
            _ => Integrator::default(),
        };
    }
}

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

/// All states of the run, the release first, and how it ended.
fn drop_body(
    scene: &Scene,
    stepper: &Stepper,
    hull: &Hull,
    bars: &Bars,
) -> (Vec<State>, Result<Ending, StepError>) {
    let noise = NoiseStream {
        seed: scene.seed,
        body: 0,
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
                bars.report("simulating", fraction(scene, state));
            }
            if bars.cancelled() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
    );
    (states, ended)
}

fn fraction(scene: &Scene, state: &State) -> f64 {
    let of_time = scene.stop.time.map_or(0.0, |end| state.time / end);
    let of_way = scene.stop.ground.map_or(0.0, |ground| {
        let start = scene.release.position[1];
        (start - state.position[1]) / (start - ground)
    });
    of_time.max(of_way)
}

fn ending_name(ended: &Result<Ending, StepError>) -> &'static str {
    match ended {
        Ok(Ending::Ground) => "ground",
        Ok(Ending::Time) => "time",
        Ok(Ending::Stopped) => "interrupted",
        Err(StepError::Diverged { .. }) => "diverged",
    }
}

/// The trajectory first: it is what cannot be made again cheaply.
fn write_all(
    folder: &Path,
    scene: &Scene,
    states: &[State],
    shot: &Shot<'_>,
    summary: &mut Summary,
) -> Result<()> {
    let started = Instant::now();
    files::write(
        &folder.join("trajectory.csv"),
        trajectory::csv(0, states).as_bytes(),
    )?;
    files::write(&folder.join("scene.toml"), resolved(scene)?.as_bytes())?;
    summary.seconds.write = started.elapsed().as_secs_f64();

    let started = Instant::now();
    match shot.picture() {
        Ok(png) => files::write(&folder.join("trajectory.png"), &png)?,
        Err(error) => summary.warnings.push(format!("no picture: {error}")),
    }
    summary.seconds.picture = started.elapsed().as_secs_f64();
    let json = serde_json::to_string_pretty(&summary)? + "\n";
    files::write(&folder.join("summary.json"), json.as_bytes())?;
    Ok(())
}

/// The scene as it was run; a mesh is named by its full path so that the file works anywhere.
pub(crate) fn resolved(scene: &Scene) -> Result<String> {
    let mut scene = scene.clone();
    if let scene::Geometry::Mesh { path, .. } = &mut scene.body.geometry {
        *path = std::path::absolute(&path)?;
    }
    Ok(scene.to_toml()?)
}

fn tell(options: &Simulate, folder: &Path, summary: &Summary) -> Result<()> {
    for warning in &summary.warnings {
        eprintln!("warning: {warning}");
    }
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", serde_json::to_string_pretty(summary)?)?;
        return Ok(());
    }
    let bake = if summary.bake_cached {
        "bake from the cache"
    } else {
        "baked"
    };
    writeln!(
        out,
        "{}: {:.3} s in {} steps, ended by {}",
        summary.scene, summary.duration, summary.steps, summary.ending
    )?;
    writeln!(
        out,
        "  U0 {:.3} m/s, Re {:.3e}, mean vertical speed over the last half {:.3} m/s",
        summary.u0, summary.re, summary.terminal_speed
    )?;
    writeln!(
        out,
        "  {bake} in {:.3} s (added mass within about {:.2} %), run in {:.3} s ({:.2} us a step)",
        summary.seconds.bake,
        100.0 * summary.added_mass_error_estimate,
        summary.seconds.run,
        1e6 * summary.seconds.per_step
    )?;
    writeln!(
        out,
        "  wrote trajectory.csv, trajectory.png, summary.json and scene.toml to {}",
        folder.display()
    )?;
    Ok(())
}
