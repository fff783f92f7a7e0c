//! `langevin-rigid direct`

use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use anyhow::{Result, bail};
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid_bake::progress::Silent;
use langevin_rigid_formats::budget::Need;
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_pictures::View;
use langevin_rigid_scenes::direct::{self, Directed, Found};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene;
use langevin_rigid_scenes::shot::{Shot, Shown};
use serde::Serialize;

use crate::arguments::Direct;
use crate::bars::Bars;
use crate::simulate::resolved;
use crate::{cache, forecast, say};

/// `best.json`; SI units.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    version: &'static str,
    seed: u64,
    /// Falls that were made.
    falls: u32,
    /// How many of them were drawn from all the freedom, without steering, and how many of those do what is asked.
    drawn: u32,
    drawn_hits: u32,
    /// Falls of any kind that do what is asked.
    hits: u32,
    seconds: f64,
    seconds_per_hit: Option<f64>,
    best: Vec<Best>,
    warnings: Vec<String>,
}

/// A fall that was found.
#[derive(Debug, Serialize)]
struct Best {
    rank: usize,
    /// Zero if it does what is asked.
    score: f64,
    /// How far it is from each thing asked, in units of the tolerance.
    misses: Vec<(String, f64)>,
    stream: u32,
    position: Vec3,
    /// Quaternion x, y, z, w.
    orientation: [f64; 4],
    velocity: Vec3,
    angular_velocity: Vec3,
    /// Where and when it ended, and by what.
    end: Vec3,
    time: f64,
    ending: &'static str,
    /// Largest force and its root mean square, shares of the weight.
    steering: Option<[f64; 2]>,
}

pub(crate) fn direct(options: &Direct, bars: &Bars) -> Result<()> {
    let mut scene = scene::find(&options.scene)?;
    scene.seed = options.seed.unwrap_or(scene.seed);
    if let Some(asked) = &mut scene.direct {
        asked.falls = options.falls.unwrap_or(asked.falls);
        asked.best = options.best.unwrap_or(asked.best);
    }
    let folder = options
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("out").join(format!("{}-direct", scene.name)));

    let _claim = Claim::folder(&folder)?;
    let prepared = cache::prepare(scene, bars)?;
    prepared.check_release()?;
    forecast(&prepared)?;

    let started = Instant::now();
    let found = bars.stoppable(|| direct::search(&prepared, bars))?;
    let seconds = started.elapsed().as_secs_f64();
    bars.clear();
    if found.best.is_empty() {
        bail!("no fall came to an end");
    }
    let report = report(&prepared, &found, seconds, bars.interrupted());
    write_all(&folder, &prepared, &found, &report)?;
    tell(options, &folder, &report)
}

fn forecast(prepared: &Prepared) -> Result<()> {
    let scene = prepared.scene();
    let falls = scene.direct.as_ref().map_or(0, |asked| asked.falls);
    let seconds = forecast::seconds(scene, prepared.body());
    let steps = f64::from(falls) * (seconds / scene.time_step).max(1.0);
    let need = Need::new(direct::memory(seconds), steps);
    forecast::check(need, &format!("`--falls {falls}`"))
}

fn report(prepared: &Prepared, found: &Found, seconds: f64, interrupted: bool) -> Report {
    let scene = prepared.scene();
    let mut warnings = Vec::new();
    if interrupted {
        warnings.push("interrupted: these are the best so far".to_owned());
    }
    if found.hits == 0 {
        warnings.push(format!(
            "no fall of {} does what is asked; the best misses it by {:.3} tolerances: try more falls (`--falls`), or give \
             it more freedom",
            found.falls,
            found.best[0].score()
        ));
    }
    let wanted = scene.direct.as_ref().map_or(0, |asked| asked.best as usize);
    if found.best.len() < wanted && !interrupted {
        let have = found.best.len();
        warnings.push(format!("only {have} falls are different from each other"));
    }
    let best = found.best.iter().enumerate();
    Report {
        scene: scene.name.clone(),
        version: env!("CARGO_PKG_VERSION"),
        seed: scene.seed,
        falls: found.falls,
        drawn: found.drawn,
        drawn_hits: found.drawn_hits,
        hits: found.hits,
        seconds,
        seconds_per_hit: (found.hits > 0).then(|| seconds / f64::from(found.hits)),
        best: best
            .map(|(place, fall)| Best::new(prepared, found, place + 1, fall))
            .collect(),
        warnings,
    }
}

impl Best {
    fn new(prepared: &Prepared, found: &Found, rank: usize, fall: &Directed) -> Self {
        let state = &fall.release.state;
        let misses = found.asks.iter().cloned().zip(fall.misses.iter().copied());
        let weight = prepared.body().mass * norm(prepared.scene().settings.gravity);
        Self {
            rank,
            score: fall.score(),
            misses: misses.collect(),
            stream: fall.release.noise.body,
            position: state.position,
            orientation: state.orientation,
            velocity: state.world_velocity(),
            angular_velocity: state.world_angular_velocity(),
            end: fall.last.position,
            time: fall.last.time,
            ending: fall.ending.name(),
            steering: fall.steering.as_ref().map(|steering| {
                steering
                    .largest_and_rms(fall.last.time)
                    .map(|force| force / weight)
            }),
        }
    }
}

fn write_all(folder: &Path, prepared: &Prepared, found: &Found, report: &Report) -> Result<()> {
    files::write(&folder.join("best.csv"), table(report)?.as_bytes())?;
    let json = serde_json::to_string_pretty(report)? + "\n";
    files::write(&folder.join("best.json"), json.as_bytes())?;
    for (number, best) in (1..).zip(&found.best) {
        let scene = best.scene(prepared);
        let file = folder.join(format!("best-{number}.toml"));
        files::write(&file, resolved(&scene)?.as_bytes())?;
        let again = Prepared::of(scene, Arc::clone(prepared.baked()))?;
        let fall = again.drop(&again.release(0), &Silent(&()));
        let trajectory = fall.trajectory();
        let shot = Shot::new(
            Shown::Both,
            View::default(),
            &again,
            &[(&trajectory).into()],
        );
        let picture = shot.picture()?.png()?;
        files::write(&folder.join(format!("best-{number}.png")), &picture)?;
    }
    Ok(())
}

/// `best.csv`
fn table(report: &Report) -> Result<String> {
    let mut text = String::from(
        "rank,score,stream,x0,y0,z0,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz,x,y,z,time,ending,largest_force,rms_force",
    );
    let asks = report.best.first().map_or(&[][..], |best| &best.misses);
    for (ask, _) in asks {
        write!(text, ",miss_{}", ask.replace(' ', "_"))?;
    }
    text.push('\n');
    for best in &report.best {
        write!(text, "{},{:?},{}", best.rank, best.score, best.stream)?;
        let (place, turn) = (best.position.iter(), best.orientation.iter());
        let numbers = place.chain(turn).chain(&best.velocity);
        for number in numbers.chain(&best.angular_velocity).chain(&best.end) {
            write!(text, ",{number:?}")?;
        }
        let [largest, rms] = best.steering.unwrap_or_default();
        let (time, ending) = (best.time, best.ending);
        write!(text, ",{time:?},{ending},{largest:?},{rms:?}")?;
        for (_, miss) in &best.misses {
            write!(text, ",{miss:?}")?;
        }
        text.push('\n');
    }
    Ok(text)
}

fn tell(options: &Direct, folder: &Path, report: &Report) -> Result<()> {
    for warning in &report.warnings {
        say::warning(warning);
    }
    let mut out = say::out();
    if options.json {
        writeln!(out, "{}", serde_json::to_string_pretty(report)?)?;
        return Ok(());
    }
    let hits = report.best.iter().filter(|best| best.score == 0.0).count();
    writeln!(
        out,
        "{}: {hits} of the best {} falls do what is asked; {} of {} falls (seed {}) in {:.3} s",
        report.scene,
        report.best.len(),
        report.hits,
        report.falls,
        report.seed,
        report.seconds
    )?;
    let chance = 100.0 * f64::from(report.drawn_hits) / f64::from(report.drawn.max(1));
    let each = report
        .seconds_per_hit
        .map_or_else(String::new, |seconds| format!("; {seconds:.2e} s a hit"));
    writeln!(
        out,
        "  by chance: {} of {} draws, {chance:.2} %{each}",
        report.drawn_hits, report.drawn
    )?;
    for best in &report.best {
        let [x, y, z] = best.end;
        let misses = best.misses.iter();
        let misses: Vec<String> = misses
            .map(|(ask, miss)| format!("{ask} {miss:.2}"))
            .collect();
        let force = best.steering.map_or_else(String::new, |[largest, rms]| {
            format!("; force {largest:.3} of the weight at most, {rms:.3} rms")
        });
        writeln!(
            out,
            "  {}: ended by {} at ({x:.3}, {y:.3}, {z:.3}) m after {:.3} s; in tolerances: {}{force}",
            best.rank,
            best.ending,
            best.time,
            misses.join(", ")
        )?;
    }
    writeln!(
        out,
        "  wrote best.csv, best.json, and a scene and a picture of each to {}",
        folder.display()
    )?;
    Ok(())
}
