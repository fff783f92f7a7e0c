//! `langevin-rigid ensemble`

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Result, bail};
use langevin_rigid::Body;
use langevin_rigid::linalg::Vec3;
use langevin_rigid_formats::budget::Need;
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_scenes::baking::Baked;
use langevin_rigid_scenes::ensemble::{
    self, Faces, Fall, FallEnding, Journal, SAMPLES_PER_SECOND, Statistics, landings,
};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::{self, Scene};
use serde::Serialize;

use crate::arguments::Ensemble;
use crate::bars::Bars;
use crate::simulate::resolved;
use crate::{cache, forecast, say};

/// Where falls are kept until all have ended.
const JOURNAL: &str = "falls.journal";

/// `statistics.json`; SI units.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    version: &'static str,
    model: String,
    seed: u64,
    /// Runs that were asked for.
    runs: u32,
    /// Runs that came to an end.
    done: usize,
    diverged: usize,
    #[serde(flatten)]
    statistics: Statistics,
    warnings: Vec<String>,
    bake_cached: bool,
    seconds: Seconds,
}

/// Wall-clock time of each stage.
#[derive(Debug, Default, Serialize)]
struct Seconds {
    bake: f64,
    run: f64,
}

pub(crate) fn ensemble(options: &Ensemble, bars: &Bars) -> Result<()> {
    let mut scene = scene::find(&options.scene)?;
    scene.seed = options.seed.unwrap_or(scene.seed);
    if let Some(model) = options.model {
        scene.set_model(model);
    }
    let folder = options
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("out").join(format!("{}-ensemble", scene.name)));

    let _claim = Claim::folder(&folder)?;
    let started = Instant::now();
    let prepared = cache::prepare(scene, bars)?;
    let bake = started.elapsed().as_secs_f64();
    let (scene, baked) = (prepared.scene(), prepared.baked());
    prepared.check_release()?;
    forecast(scene, prepared.body(), options.runs)?;

    let path = folder.join(JOURNAL);
    let journal = match options.resume {
        true => Journal::open(&path, &prepared)?,
        false => Journal::create(&path, &prepared)?,
    };
    let started = Instant::now();
    let runs = 0..options.runs;
    let falls = bars.stoppable(|| ensemble::run_with(&prepared, runs, &journal, bars))?;
    let run = started.elapsed().as_secs_f64();
    bars.clear();
    if falls.is_empty() {
        bail!("no run came to an end");
    }
    let report = report(options, scene, baked, &falls, Seconds { bake, run });
    write_all(&folder, &prepared, &falls, &report)?;
    if falls.len() == options.runs as usize {
        journal.remove()?;
    }
    tell(options, &folder, &report)?;
    if report.diverged == falls.len() {
        bail!(
            "every run diverged; how is in {}",
            folder.join("statistics.json").display()
        );
    }
    Ok(())
}

fn forecast(scene: &Scene, body: &Body, runs: u32) -> Result<()> {
    let seconds = forecast::seconds(scene, body);
    let steps = (seconds / scene.time_step).max(1.0);
    // Lists grow to twice what they hold; a row of the table takes some hundred bytes.
    let samples = seconds * f64::from(SAMPLES_PER_SECOND) * size_of::<Vec3>() as f64;
    let bytes = 2.0 * (size_of::<Fall>() as f64 + samples) + 200.0;
    let need = Need::new(f64::from(runs) * bytes, f64::from(runs) * steps);
    forecast::check(need, &format!("`--runs {runs}`"))
}

fn report(
    options: &Ensemble,
    scene: &Scene,
    baked: &Baked,
    falls: &[Fall],
    seconds: Seconds,
) -> Report {
    let mut warnings = baked.bake.warnings.clone();
    if falls.len() < options.runs as usize {
        let (done, asked) = (falls.len(), options.runs);
        warnings.push(format!(
            "interrupted: {done} of {asked} runs came to an end, slow ones are missing more often; go on with `--resume`"
        ));
    }
    let mut diverged = 0;
    for fall in falls {
        if let FallEnding::Diverged(error) = &fall.ending {
            diverged += 1;
            warnings.push(format!("run {} is left out: {error}", fall.run));
        } else if fall.time == 0.0 {
            warnings.push(format!(
                "run {} began on the ground; release it higher",
                fall.run
            ));
        }
    }
    Report {
        scene: scene.name.clone(),
        version: env!("CARGO_PKG_VERSION"),
        model: scene.settings.model.to_string(),
        seed: scene.seed,
        runs: options.runs,
        done: falls.len(),
        diverged,
        statistics: Statistics::new(falls),
        warnings,
        bake_cached: baked.cached,
        seconds,
    }
}

fn write_all(folder: &Path, prepared: &Prepared, falls: &[Fall], report: &Report) -> Result<()> {
    let landings = landings(prepared, falls);
    files::write(&folder.join("landings.csv"), landings.csv().as_bytes())?;
    #[cfg(feature = "parquet")]
    files::write_with(&folder.join("landings.parquet"), |out| {
        landings.write_parquet(ensemble::LANDINGS_ABOUT, out)
    })?;
    let scene = resolved(prepared.scene())?;
    files::write(&folder.join("scene.toml"), scene.as_bytes())?;
    let json = serde_json::to_string_pretty(report)? + "\n";
    files::write(&folder.join("statistics.json"), json.as_bytes())?;
    Ok(())
}

fn tell(options: &Ensemble, folder: &Path, report: &Report) -> Result<()> {
    for warning in &report.warnings {
        say::warning(warning);
    }
    let mut out = say::out();
    if options.json {
        writeln!(out, "{}", serde_json::to_string_pretty(report)?)?;
        return Ok(());
    }
    let statistics = &report.statistics;
    writeln!(
        out,
        "{}: {} runs ({}, seed {}), {} landed, {} diverged, in {:.3} s",
        report.scene,
        report.done,
        report.model,
        report.seed,
        statistics.landed,
        report.diverged,
        report.seconds.run
    )?;
    let motions: Vec<String> = statistics
        .motions
        .iter()
        .map(|(motion, count)| format!("{} {count}", motion.name()))
        .collect();
    writeln!(out, "  motions: {}", motions.join(", "))?;
    if let (Some(x), Some(z), Some(distance)) = (
        statistics.landing_sigma_x,
        statistics.landing_sigma_z,
        statistics.median_landing_distance,
    ) {
        writeln!(
            out,
            "  landing sigma {x:.4} m along x and {z:.4} m along z, median distance {distance:.4} m"
        )?;
    }
    if let Some(Faces { up, down, edge }) = statistics.faces {
        writeln!(
            out,
            "  at rest {up} face up, {down} face down, {edge} steep"
        )?;
    }
    writeln!(
        out,
        "  wrote landings.csv, landings.parquet, statistics.json and scene.toml to {}",
        folder.display()
    )?;
    Ok(())
}
