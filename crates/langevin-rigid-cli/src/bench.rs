//! `langevin-rigid bench`

use std::io::Write;
use std::time::Instant;

use anyhow::{Result, anyhow, bail};
use langevin_rigid::turbulence::Turbulence;
use langevin_rigid::wind::GustSettings;
use langevin_rigid::{Batch, Model, Pack, Precision};
use langevin_rigid_bake::added_mass;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_bake::turbulence::{Boundary, MacGrid, TurbulentFlow};
use langevin_rigid_report::{Table, pages, paper};
use langevin_rigid_scenes::advance::advance;
use langevin_rigid_scenes::scene::{self, Scene, SceneField, WindPart};
use rayon::prelude::*;
use serde::Serialize;

use crate::arguments::Bench;
use crate::bars::Bars;
use crate::{cache, reproduce, say};

/// Times are medians over so many repetitions.
const REPEATS: usize = 31;
const FEW: usize = 5;
/// Steps of one repetition.
const STEPS: u32 = 2000;
/// Bodies of a batch, those of the batch that all threads share, and body-steps of one repetition.
const BODIES: u32 = 4096;
const CROWD: u32 = 65_536;
const BODY_STEPS: u32 = 262_144;
/// Cells of the timed turbulence grids: ours, and the paper's.
const CELLS: [usize; 3] = [64; 3];
const FEW_CELLS: [usize; 3] = [32, 32, 8];

/// What the manual calls these figures.
const PART: &str = "bench";

/// The scenes of the paper's Table 2, and that of them whose step is the headline.
const TABLE_2: &str = "table2-";
const BODY: &str = "table2-ellipsoid-1280-5ms";

/// What is printed, medians; nanoseconds where a name does not say otherwise.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    threads: usize,
    /// One step of the 1:2:4 ellipsoid in water, model `consistent`, default integrator, with noise.
    step: f64,
    /// The same for each of many bodies, on one core.
    step_batch: f64,
    /// One step of one body under `separated`, and for each of many.
    step_separated: f64,
    step_separated_batch: f64,
    /// The same two in gusts.
    step_gusts: f64,
    step_gusts_batch: f64,
    /// `step_batch` and `step_separated_batch` in single precision.
    step_batch_f32: f64,
    step_separated_batch_f32: f64,
    /// How many times faster all cores step a large batch than one.
    batch_scaling: f64,
    added_mass_1280_ms: f64,
    added_mass_5120_ms: f64,
    /// Whole steps of the flow solver on a grid of 64^3 cells.
    turbulence_cells_per_s: f64,
    /// One step on the paper's grid of 32 x 32 x 8 cells.
    turbulence_paper_ms: f64,
    /// One step of each row of the paper's Table 2, model `consistent`.
    table2: std::collections::BTreeMap<&'static str, f64>,
}

pub(crate) fn bench(options: &Bench, bars: &Bars) -> Result<()> {
    if let Some(manual) = &options.update {
        pages::list(manual)?;
    }
    let threads = rayon::current_num_threads();
    let on_one = step_batch::<f64>(&steady(Model::Consistent), BODIES, 1, bars)?;
    let scaling = step_batch::<f64>(&steady(Model::Consistent), CROWD, 1, bars)?
        / step_batch::<f64>(&steady(Model::Consistent), CROWD, threads, bars)?;
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        threads,
        step: step(BODY, &steady(Model::Consistent), bars)?,
        step_batch: on_one,
        step_separated: step(BODY, &steady(Model::Separated), bars)?,
        step_separated_batch: step_batch::<f64>(&steady(Model::Separated), BODIES, 1, bars)?,
        step_gusts: step(BODY, &GUSTY, bars)?,
        step_gusts_batch: step_batch::<f64>(&GUSTY, BODIES, 1, bars)?,
        step_batch_f32: step_batch::<f32>(&steady(Model::Consistent), BODIES, 1, bars)?,
        step_separated_batch_f32: step_batch::<f32>(&steady(Model::Separated), BODIES, 1, bars)?,
        batch_scaling: scaling,
        table2: scene::BUILT_IN
            .iter()
            .filter(|row| row.name.starts_with(TABLE_2))
            .map(|row| Ok((row.name, step(row.name, &steady(Model::Consistent), bars)?)))
            .collect::<Result<_>>()?,
        added_mass_1280_ms: added_mass_ms(1280, bars)?,
        added_mass_5120_ms: added_mass_ms(5120, bars)?,
        turbulence_cells_per_s: CELLS.iter().product::<usize>() as f64
            / turbulence_seconds(CELLS, bars)?,
        turbulence_paper_ms: 1e3 * turbulence_seconds(FEW_CELLS, bars)?,
    };
    bars.clear();
    if options.json {
        writeln!(say::out(), "{}", serde_json::to_string_pretty(&report)?)?;
    } else {
        print(&report)?;
    }
    if let Some(manual) = &options.update {
        reproduce::update(manual, &[(PART, &[table(&report)])])?;
    }
    Ok(())
}

fn print(report: &Report) -> Result<()> {
    let mut out = say::out();
    writeln!(
        out,
        "one step of one body: {:.0} ns (consistent), {:.0} ns (separated), {:.0} ns (in gusts)",
        report.step, report.step_separated, report.step_gusts
    )?;
    writeln!(
        out,
        "of many, a body on one core: {:.0} ns, {:.0} ns, {:.0} ns; in single precision {:.0} ns, {:.0} ns",
        report.step_batch,
        report.step_separated_batch,
        report.step_gusts_batch,
        report.step_batch_f32,
        report.step_separated_batch_f32
    )?;
    writeln!(
        out,
        "  {} threads are {:.2} times faster than one",
        report.threads, report.batch_scaling
    )?;
    for (row, nanoseconds) in &report.table2 {
        writeln!(out, "  {row}: {nanoseconds:.0} ns")?;
    }
    writeln!(
        out,
        "added mass, {} threads: {:.1} ms at 1280 triangles, {:.0} ms at 5120",
        report.threads, report.added_mass_1280_ms, report.added_mass_5120_ms
    )?;
    writeln!(
        out,
        "turbulence: {:.1} million cell updates a second at 64^3 cells, {:.2} ms a step of 32 x 32 x 8",
        1e-6 * report.turbulence_cells_per_s,
        report.turbulence_paper_ms
    )?;
    Ok(())
}

/// The figures as the manual has them, beside those of the paper and what they are to stay below, or above.
fn table(report: &Report) -> Table {
    let microseconds = |ns: f64, digits: usize| format!("{:.digits$} us", 1e-3 * ns);
    let of_many =
        |double: f64, single: f64| format!("{} ({:.3})", microseconds(double, 3), 1e-3 * single);
    let steps = paper::TABLE_2.map(|row| row.4);
    let [least, most] = [
        steps.iter().copied().fold(f64::INFINITY, f64::min),
        steps.iter().copied().fold(0.0, f64::max),
    ];
    let rows = [
        [
            "step of one body, <code>consistent</code>, default integrator",
            &format!("{:.1} to {:.1} ms", 1e3 * least, 1e3 * most),
            &microseconds(report.step, 2),
            "0.30 us",
        ],
        [
            "of many, a body on one core (single precision)",
            "",
            &of_many(report.step_batch, report.step_batch_f32),
            "0.06 us",
        ],
        [
            "all cores over one",
            "",
            &format!(
                "{:.2} times ({} cores)",
                report.batch_scaling, report.threads
            ),
            "1.9 times (2 cores)",
        ],
        [
            "step of one body, <code>separated</code>",
            "",
            &microseconds(report.step_separated, 2),
            "0.65 us",
        ],
        [
            "of many, a body on one core (single precision)",
            "",
            &of_many(report.step_separated_batch, report.step_separated_batch_f32),
            "0.14 us",
        ],
        [
            "step of one body in gusts, <code>separated</code>",
            "",
            &microseconds(report.step_gusts, 2),
            "1.3 us",
        ],
        [
            "of many, a body on one core",
            "",
            &microseconds(report.step_gusts_batch, 3),
            "0.28 us",
        ],
        [
            "added mass, 1280 triangles",
            &format!("{:.0} ms", 1e3 * paper::ADDED_MASS_SECONDS),
            &format!("{:.1} ms", report.added_mass_1280_ms),
            "20 ms",
        ],
        [
            "added mass, 5120 triangles",
            "",
            &format!("{:.2} s", 1e-3 * report.added_mass_5120_ms),
            "0.4 s",
        ],
        [
            "turbulence, whole steps at 64^3",
            "",
            &format!(
                "{:.0} million cells/s",
                1e-6 * report.turbulence_cells_per_s
            ),
            "20 million cells/s",
        ],
        [
            "turbulence, a step of 32 x 32 x 8 cells",
            &format!("{:.0} ms", 1e3 * paper::TURBULENCE_SECONDS),
            &format!("{:.2} ms", report.turbulence_paper_ms),
            "",
        ],
    ]
    .map(|row| row.map(str::to_owned).to_vec());
    Table::new("main", &["", "paper (2013, desktop)", "here", "aim"], &rows)
}

/// What is measured of a body.
struct Conditions {
    model: Model,
    gusts: bool,
}

const GUSTY: Conditions = Conditions {
    model: Model::Separated,
    gusts: true,
};

fn steady(model: Model) -> Conditions {
    Conditions {
        model,
        gusts: false,
    }
}

impl Conditions {
    fn of(&self, mut scene: Scene) -> Scene {
        scene.set_model(self.model);
        if self.gusts {
            let settings = GustSettings::default();
            let field = SceneField::Gusts {
                settings,
                seed: None,
            };
            let within = None;
            scene.wind.push(WindPart {
                field,
                within,
                bodies: Vec::new(),
            });
        }
        scene
    }
}

/// Nanoseconds a step of a built-in scene's body.
fn step(name: &'static str, conditions: &Conditions, bars: &Bars) -> Result<f64> {
    let scene = conditions.of(scene::find(name)?);
    let prepared = cache::prepare(scene, bars)?;
    let seconds = median(REPEATS, name, bars, |repeat| {
        let mut release = prepared.release(0);
        release.noise.seed = repeat as u64;
        let mut state = release.state;
        for _ in 0..STEPS {
            advance(&prepared, &release, &mut state)?;
        }
        Ok(())
    })?;
    Ok(1e9 * seconds / f64::from(STEPS))
}

/// Nanoseconds a step of each of so many bodies, shared among `threads`.
fn step_batch<P: Precision>(
    conditions: &Conditions,
    bodies: u32,
    threads: usize,
    bars: &Bars,
) -> Result<f64> {
    let scene = conditions.of(scene::find(BODY)?);
    let prepared = cache::prepare(scene, bars)?;
    let (scene, stepper, wind) = (prepared.scene(), prepared.stepper(), prepared.wind());
    let steps = BODY_STEPS / bodies;
    let mut batch = Batch::<P>::new(0);
    for _ in 0..bodies {
        batch.push(&scene.release);
    }
    let packs = batch.packs_mut();
    let share = packs.len().div_ceil(threads);
    let seconds = median(REPEATS, "batch", bars, |_| {
        // Bodies do not meet: a thread takes its share through all steps.
        let through = |share: &mut [Pack<P>]| {
            (0..steps).try_for_each(|_| stepper.step_packs_in(share, scene.time_step, wind, 0.0))
        };
        if threads == 1 {
            through(packs)?;
        } else {
            packs.par_chunks_mut(share).try_for_each(through)?;
        }
        Ok(())
    })?;
    Ok(1e9 * seconds / f64::from(steps * bodies))
}

fn added_mass_ms(triangles: usize, bars: &Bars) -> Result<f64> {
    let ellipsoid = Shape::Ellipsoid {
        semi_axes: [0.01, 0.02, 0.04],
    };
    let mesh = ellipsoid.mesh(triangles)?;
    let options = added_mass::Options::default();
    let seconds = median(FEW, "added mass", bars, |_| {
        added_mass::added_mass(&mesh, &options, &())?;
        Ok(())
    })?;
    Ok(1e3 * seconds)
}

/// Seconds a step of a flow on so many cells.
fn turbulence_seconds(cells: [usize; 3], bars: &Bars) -> Result<f64> {
    let sides = [Boundary::Walls, Boundary::Through, Boundary::Walls];
    let size = 1.0 / cells[0] as f64;
    let mut grid = MacGrid::new(cells, size, sides)?;
    // A vortex in a stream: uniform flow would be too easy.
    grid.set_velocity(|[x, y, _]| {
        let turn = std::f64::consts::PI;
        let (x, y) = (turn * x, turn * y);
        [0.3 * x.sin() * y.cos(), 1.0 - 0.3 * x.cos() * y.sin(), 0.0]
    });
    let mut flow = TurbulentFlow::new(grid, Turbulence::at_birth(1.0, size))?;
    median(FEW, "turbulence", bars, |_| Ok(flow.step(size)?))
}

/// Median seconds of `work`, after one untimed round.
fn median(
    repeats: usize,
    stage: &str,
    bars: &Bars,
    mut work: impl FnMut(usize) -> Result<()>,
) -> Result<f64> {
    work(0)?;
    let mut seconds = Vec::with_capacity(repeats);
    for repeat in 0..repeats {
        if bars.cancelled() {
            bail!("interrupted");
        }
        let started = Instant::now();
        work(repeat)?;
        seconds.push(started.elapsed().as_secs_f64());
        bars.report(stage, (repeat + 1) as f64 / repeats as f64);
    }
    seconds.sort_by(f64::total_cmp);
    let middle = seconds.get(repeats / 2);
    middle.copied().ok_or_else(|| anyhow!("nothing was timed"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use std::path::Path;

    use super::*;

    #[test]
    fn the_manual_has_a_place_for_the_table() {
        let report = Report {
            version: "",
            threads: 2,
            step: 280.0,
            step_batch: 37.0,
            step_separated: 810.0,
            step_separated_batch: 102.0,
            step_gusts: 1300.0,
            step_gusts_batch: 230.0,
            step_batch_f32: 21.0,
            step_separated_batch_f32: 55.0,
            batch_scaling: 1.97,
            added_mass_1280_ms: 15.1,
            added_mass_5120_ms: 160.0,
            turbulence_cells_per_s: 32e6,
            turbulence_paper_ms: 0.49,
            table2: Default::default(),
        };
        let manual = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
        let mut places = 0;
        for page in pages::list(&manual).unwrap() {
            let text = std::fs::read_to_string(&page).unwrap();
            let ours = pages::marks(&text).filter(|mark| mark.starts_with("bench/"));
            places += ours.count();
            pages::replaced(&text, &[(PART, &[table(&report)])]).unwrap();
        }
        assert_eq!(places, 1);
    }
}
