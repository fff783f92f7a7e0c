//! `langevin-rigid crowd`

use std::io::Write;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use langevin_rigid::{Batch, BatchError};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::budget::Need;
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene;
use rayon::prelude::*;
use serde::Serialize;

use crate::arguments::Crowd;
use crate::bars::Bars;
use crate::{cache, forecast, say};

const FRAMES_PER_SECOND: f64 = 60.0;
const FRAME: Duration = Duration::from_nanos(1_000_000_000 / 60);

/// Memory of a body in the batch (bytes): its state in lanes, and what a growing list holds ready.
const BODY: f64 = 300.0;

/// What is printed.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    model: String,
    bodies: u32,
    threads: usize,
    time_step: f64,
    frames: usize,
    /// Frames whose steps took longer than a frame.
    missed_frames: usize,
    median_frame_ms: f64,
    longest_frame_ms: f64,
}

pub(crate) fn crowd(options: &Crowd, bars: &Bars) -> Result<()> {
    let mut scene = scene::find(&options.scene)?;
    if let Some(model) = options.model {
        scene.set_model(model);
    }
    let prepared = cache::prepare(scene, bars)?;
    let scene = prepared.scene();
    forecast(options, scene.time_step)?;
    let mut batch = Batch::<f64>::new(scene.seed);
    for _ in 0..options.bodies {
        batch.push(&scene.release);
    }
    let mut spent = bars.stoppable(|| frames(options, &prepared, &mut batch, bars))?;
    bars.clear();
    if spent.is_empty() {
        bail!("interrupted before the first frame");
    }
    let missed_frames = spent.iter().filter(|&&time| time > FRAME).count();
    spent.sort_unstable();
    let milliseconds = |time: Duration| 1e3 * time.as_secs_f64();
    let report = Report {
        scene: scene.name.clone(),
        model: scene.settings.model.to_string(),
        bodies: options.bodies,
        threads: rayon::current_num_threads(),
        time_step: scene.time_step,
        frames: spent.len(),
        missed_frames,
        median_frame_ms: milliseconds(spent[spent.len() / 2]),
        longest_frame_ms: milliseconds(spent[spent.len() - 1]),
    };
    tell(&report, options.json)
}

fn forecast(options: &Crowd, time_step: f64) -> Result<()> {
    let (bodies, seconds) = (options.bodies, options.seconds);
    let frames = seconds * FRAMES_PER_SECOND * size_of::<Duration>() as f64;
    let steps = f64::from(bodies) * (seconds / time_step);
    forecast::check(
        Need::new(f64::from(bodies) * BODY + frames, steps),
        &format!("`--bodies {bodies} --seconds {seconds:?}`"),
    )
}

/// How long the steps of each frame took, until the end or a signal.
fn frames(
    options: &Crowd,
    prepared: &Prepared,
    batch: &mut Batch,
    bars: &Bars,
) -> Result<Vec<Duration>> {
    let frames = (options.seconds * FRAMES_PER_SECOND).ceil() as usize;
    let time_step = prepared.scene().time_step;
    let mut spent = Vec::with_capacity(frames);
    let mut steps = 0u64;
    let mut due = Instant::now();
    for number in 1..=frames {
        if bars.cancelled() {
            break;
        }
        let started = Instant::now();
        let wanted = (number as f64 / FRAMES_PER_SECOND / time_step).round() as u64;
        step(prepared, batch, wanted - steps)?;
        steps = wanted;
        spent.push(started.elapsed());
        bars.report("crowd", number as f64 / frames as f64);
        // In real time: the next frame begins when it is due, or now if it is late.
        due = (due + FRAME).max(Instant::now());
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
    }
    Ok(spent)
}

/// Steps of all bodies, shared among the threads: each takes its share through all of them, as bodies
/// do not meet.
fn step(prepared: &Prepared, batch: &mut Batch, steps: u64) -> Result<(), BatchError> {
    let (stepper, wind) = (prepared.stepper(), prepared.wind());
    let dt = prepared.scene().time_step;
    let packs = batch.packs_mut();
    let share = packs
        .len()
        .div_ceil(4 * rayon::current_num_threads())
        .max(1);
    packs.par_chunks_mut(share).try_for_each(|share| {
        (0..steps).try_for_each(|_| stepper.step_packs_in(share, dt, wind, 0.0))
    })
}

fn tell(report: &Report, json: bool) -> Result<()> {
    let mut out = say::out();
    if json {
        writeln!(out, "{}", serde_json::to_string_pretty(report)?)?;
        return Ok(());
    }
    let Report {
        scene,
        model,
        bodies,
        threads,
        ..
    } = report;
    writeln!(
        out,
        "{bodies} bodies of {scene} ({model}), steps of {:.1} ms, {threads} threads:",
        1e3 * report.time_step
    )?;
    writeln!(
        out,
        "{} frames at 60 a second, {} missed; a frame took {:.1} ms (median), {:.1} ms at most",
        report.frames, report.missed_frames, report.median_frame_ms, report.longest_frame_ms
    )?;
    Ok(())
}
