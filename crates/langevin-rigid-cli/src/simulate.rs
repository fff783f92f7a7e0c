//! `langevin-rigid simulate`

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, Result, bail};
use langevin_rigid_formats::export::{self, ExportError, Format, Options, RecordedBody, Recording};
use langevin_rigid_formats::files;
use langevin_rigid_formats::files::Claim;
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_pictures::{Film, View};
use langevin_rigid_scenes::baking::Baked;
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::prepared::Fall;
use langevin_rigid_scenes::scene::{self, Scene};
use langevin_rigid_scenes::shot::Shot;
use langevin_rigid_scenes::summary::Summary;

use crate::arguments::Simulate;
use crate::bars::Bars;
use crate::{cache, forecast, pictures, say};

pub(crate) fn simulate(options: &Simulate, bars: &Bars) -> Result<()> {
    export::check(&options.format)?;
    let mut scene = scene::find(&options.scene)?;
    apply(options, &mut scene);
    scene
        .steps()
        .context("with the scene's values or those of `--dt` and `--duration`")?;
    let folder = options
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("out").join(&scene.name));

    let _claims = claims(options, &folder)?;
    let started = Instant::now();
    let prepared = cache::prepare(scene, bars)?;
    let bake_seconds = started.elapsed().as_secs_f64();
    let (scene, baked) = (prepared.scene(), prepared.baked());
    prepared.check_release()?;
    forecast(options, scene, baked)?;

    // Read before there is anything to lose.
    let cast = Cast::new(&prepared)?;

    let started = Instant::now();
    let falls = bars.stoppable(|| prepared.drop_bodies(options.bodies, bars))?;
    let run_seconds = started.elapsed().as_secs_f64();

    let mut summary = Summary::new(&prepared, &falls);
    summary
        .warnings
        .extend(missing(asked(options.bodies, scene), falls.len()));
    summary.warnings.extend(cast.notices());
    summary.seconds.bake = bake_seconds;
    summary.seconds.run = run_seconds;
    let steps: usize = falls.iter().map(|fall| fall.states.len() - 1).sum();
    summary.seconds.per_step = run_seconds / steps.max(1) as f64;
    let trajectories: Vec<Trajectory> = falls.iter().map(Fall::trajectory).collect();
    let kinds = cast.kinds();
    let bodies = falls.iter().zip(&trajectories);
    let bodies: Vec<RecordedBody<'_>> = bodies
        .map(|(fall, trajectory)| fall.recorded(trajectory))
        .collect();
    let view = options.view.map_or(View::default(), View::from);
    let shot = Shot::new(options.picture.into(), view, &prepared, &bodies);
    let run = Recording {
        conditions: scene.conditions(),
        kinds: &kinds,
        bodies: &bodies,
    };
    let formats = write_all(options, &folder, scene, &run, &shot, &mut summary)?;
    let film = match &options.frames {
        Some(folder) => {
            let work = || shot.film(folder, options.fps, bars);
            Some((folder, bars.stoppable(work)?))
        }
        None => None,
    };
    bars.clear();
    tell(options, &folder, &summary)?;
    if let Some((folder, frames)) = film {
        pictures::tell(frames, folder, options.fps, options.json)?;
    }
    fail_if_full(&falls, &folder)?;
    fail_if_diverged(&falls, &folder)?;
    Ok(formats?)
}

/// How many bodies the run is to have.
fn asked(bodies: u32, scene: &Scene) -> u32 {
    scene.crowd.as_ref().map_or(bodies, |crowd| crowd.count)
}

fn missing(asked: u32, begun: usize) -> Option<String> {
    let some = begun < asked as usize;
    some.then(|| format!("interrupted: {begun} of {asked} bodies had been released"))
}

/// The folders that are written to, tried before there is anything to lose.
fn claims(options: &Simulate, folder: &Path) -> Result<Vec<Claim>> {
    let mut claims = vec![Claim::folder(folder)?];
    if let Some(frames) = &options.frames {
        let same = frames.canonicalize().ok() == folder.canonicalize().ok();
        if !same {
            claims.push(Claim::folder(frames)?);
        }
    }
    Ok(claims)
}

fn forecast(options: &Simulate, scene: &Scene, baked: &Baked) -> Result<()> {
    let seconds = forecast::seconds(scene, &baked.bake.body);
    let frames = seconds * options.fps;
    if options.frames.is_some() && frames > Film::MOST_FRAMES as f64 {
        bail!(
            "`--frames` at {:?} frames a second (`--fps`) would take {frames:.3e} pictures, and a film \
             has {} at most: ask for fewer a second, or end earlier (`--duration`)",
            options.fps,
            Film::MOST_FRAMES
        );
    }
    let animated = options.format.iter().any(|format| format.is_animation());
    let fps = animated.then_some(options.fps);
    let need = forecast::kept(asked(options.bodies, scene), seconds, scene.time_step, fps);
    let what = format!(
        "`--bodies {} --fps {:?}` for {seconds:.3} s in steps of {:?} s (`--duration`, `--dt`)",
        options.bodies, options.fps, scene.time_step
    );
    forecast::check(need, &what)
}

/// What a body did before memory was full is kept all the same.
fn fail_if_full(falls: &[Fall], folder: &Path) -> Result<()> {
    let Some(fall) = falls.iter().find(|fall| fall.full) else {
        return Ok(());
    };
    bail!(
        "body {} was stopped: {} states, and memory holds no more; give a shorter `--duration` or a larger \
         `--dt`\nwhat it did until then is in {}",
        fall.body,
        fall.states.len(),
        folder.display()
    )
}

/// What a body did before it diverged is kept all the same.
fn fail_if_diverged(falls: &[Fall], folder: &Path) -> Result<()> {
    let mut diverged = falls
        .iter()
        .filter_map(|fall| Some((fall, fall.ended.as_ref().err()?)));
    let Some((first, error)) = diverged.next() else {
        return Ok(());
    };
    let which = match falls.len() {
        1 => String::new(),
        all => format!(
            "{} of {all} bodies diverged, the first body {}: ",
            1 + diverged.count(),
            first.body
        ),
    };
    bail!(
        "{which}{error}\nthe {} states before it are in {}",
        first.states.len(),
        folder.display()
    )
}

/// The command line's word is above the scene's.
fn apply(options: &Simulate, scene: &mut Scene) {
    scene.seed = options.seed.unwrap_or(scene.seed);
    scene.time_step = options.dt.unwrap_or(scene.time_step);
    scene.stop.time = options.duration.or(scene.stop.time);
    scene.settings.turbulence = options.turbulence.unwrap_or(scene.settings.turbulence);
    if let Some(model) = options.model {
        scene.set_model(model);
    }
    if let Some(crowd) = &mut scene.crowd
        && options.bodies > 1
    {
        crowd.count = options.bodies;
    }
}

/// The trajectory first: it is what cannot be made again cheaply. Gives why a format is missing, if one is.
fn write_all(
    options: &Simulate,
    folder: &Path,
    scene: &Scene,
    run: &Recording<'_>,
    shot: &Shot<'_>,
    summary: &mut Summary,
) -> Result<Result<(), ExportError>> {
    let started = Instant::now();
    let how = Options {
        fps: options.fps,
        ..Options::default()
    };
    let mut write = |format: Format| -> Result<(), ExportError> {
        summary.wrote(format, export::write(run, format, folder, &how)?);
        Ok(())
    };
    let mut written = Ok(());
    for &format in &options.format {
        written = written.and(write(format));
    }
    if written.is_err() && !options.format.contains(&Format::Csv) {
        // What was computed is kept in the format that cannot fail.
        written = written.and(write(Format::Csv));
    }
    let scene = resolved(scene)?;
    files::write(&folder.join("scene.toml"), scene.as_bytes())?;
    summary.seconds.write = started.elapsed().as_secs_f64();

    let started = Instant::now();
    match shot.picture().and_then(|picture| picture.png()) {
        Ok(png) => {
            files::write(&folder.join("trajectory.png"), &png)?;
            summary.files.push("trajectory.png".into());
        }
        Err(error) => summary.warnings.push(format!("no picture: {error}")),
    }
    summary.seconds.picture = started.elapsed().as_secs_f64();
    let json = serde_json::to_string_pretty(&summary)? + "\n";
    files::write(&folder.join("summary.json"), json.as_bytes())?;
    Ok(written)
}

/// The scene as it was run; files are named by their full paths so that it works anywhere.
pub(crate) fn resolved(scene: &Scene) -> Result<String> {
    let mut scene = scene.clone();
    scene.relocate(|path| std::path::absolute(path))?;
    Ok(scene.to_toml()?)
}

fn tell(options: &Simulate, folder: &Path, summary: &Summary) -> Result<()> {
    for warning in &summary.warnings {
        say::warning(warning);
    }
    let mut out = say::out();
    if options.json {
        writeln!(out, "{}", serde_json::to_string_pretty(summary)?)?;
        return Ok(());
    }
    let bake = if summary.bake_cached {
        "bake from the cache"
    } else {
        "baked"
    };
    let first = match summary.bodies {
        1 => String::new(),
        bodies => format!("{bodies} bodies, the first "),
    };
    writeln!(
        out,
        "{}: {first}{:.3} s in {} steps, ended by {}",
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
    for (format, deviation) in &summary.deviation {
        writeln!(out, "  {format} within {deviation} of the trajectory")?;
    }
    writeln!(
        out,
        "  wrote {}, summary.json and scene.toml to {}",
        summary.files.join(", "),
        folder.display()
    )?;
    Ok(())
}
