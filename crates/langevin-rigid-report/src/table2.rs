//! Table 2 and the precomputation times, measured here.

use std::time::Instant;

use langevin_rigid::{NoiseStream, Stepper};
use langevin_rigid_bake::added_mass::{self, added_mass};
use langevin_rigid_bake::body::BodyBakeError;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::turbulence::{FlowOptions, turbulence_history};
use langevin_rigid_scenes::{baking, scene};

use crate::chart::escape;
use crate::error::ReportError;
use crate::options::Options;
use crate::runs::{CONSISTENT, SEPARATED, Setting};
use crate::section::Section;
use crate::spread::Spread;
use crate::{machine, paper};

/// Steps timed at a time, and how often.
const BATCH: u32 = 200;
const BATCHES: u32 = 201;
/// Precomputations timed.
const REPEATS: u32 = 5;

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let mut section = Section::new("table2", "Table 2: what it costs");
    let threads = rayon::current_num_threads();
    let cores = section.quote("threads", threads as f64, 0);
    let (batch, batches) = (
        section.quote("batch", f64::from(BATCH), 0),
        section.quote("batches", f64::from(BATCHES), 0),
    );
    section.text(format!(
        "Measured on: {}, one thread a body ({cores} for the precomputations). The paper: {}. A cost is the \
         median over {batches} batches of {batch} steps, with the 10th and 90th percentile. Times differ \
         from run to run, unlike all other numbers of this report.",
        escape(&machine::processor()),
        paper::MACHINE
    ));
    steps(&mut section, options, progress)?;
    precomputation(&mut section, progress)?;
    Ok(section)
}

fn steps(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    let mut rows = Vec::new();
    let mut medians = Vec::new();
    for (k, row) in paper::TABLE_2.iter().enumerate() {
        let (name, body, triangles, time_step, paper_cost) = *row;
        let setting = Setting::new(name, options, progress)?;
        let drawn = setting.baked.bake.body.surface.triangles.len();
        let mut cells = vec![body.to_owned()];
        cells.push(format!(
            "{triangles}, here {}",
            section.quote(format!("{name}.triangles"), drawn as f64, 0)
        ));
        cells.push(format!("{} ms", 1e3 * time_step));
        let quoted = section.quote(format!("{name}.paper"), 1e3 * paper_cost, 3);
        cells.push(format!("{quoted} ms"));
        for reading in [CONSISTENT, SEPARATED] {
            let stepper = setting.stepper(&reading)?;
            let cost = time_steps(&setting, &stepper, progress)?;
            let key = format!("{name}.{}", reading.name());
            let median = section.quote(format!("{key}.median"), 1e6 * cost.median, 3);
            let low = section.quote(format!("{key}.low"), 1e6 * cost.low, 2);
            let high = section.quote(format!("{key}.high"), 1e6 * cost.high, 2);
            cells.push(format!(
                "{median} \u{b5}s <span class=\"note\">[{low}, {high}]</span>"
            ));
            if reading == CONSISTENT {
                medians.push(cost.median);
                let faster = paper_cost / cost.median;
                cells.push(
                    section
                        .quote(format!("{key}.faster"), faster, 2)
                        .to_string(),
                );
            }
        }
        rows.push(cells);
        progress.report("table 2", (k + 1) as f64 / paper::TABLE_2.len() as f64);
    }
    let head = [
        "body",
        "triangles",
        "time step",
        "paper",
        "here, consistent",
        "times faster",
        "here, separated",
    ];
    section.table("steps", &head, &rows);
    let limit = section.quote("paper.limit", 1e3 * paper::STEP_LIMIT_SECONDS, 2);
    let slowest = medians.iter().copied().fold(0.0, f64::max);
    let fastest = medians.iter().copied().fold(f64::INFINITY, f64::min);
    let ratio = section.quote("slowest_over_fastest", slowest / fastest, 3);
    section.text(format!(
        "The paper's bound for one loop is {limit} ms. It says that the cost depends neither on the number of \
         triangles nor on the time step: here the dearest row costs {ratio} times the cheapest."
    ));
    Ok(())
}

/// Seconds a step.
fn time_steps(
    setting: &Setting,
    stepper: &Stepper,
    progress: &dyn Progress,
) -> Result<Spread, ReportError> {
    let mut costs = Vec::new();
    for batch in 0..BATCHES {
        let noise = NoiseStream {
            seed: u64::from(batch),
            body: 0,
        };
        let mut state = setting.scene.release;
        let started = Instant::now();
        for _ in 0..BATCH {
            if stepper
                .step(&mut state, setting.scene.time_step, &noise.into())
                .is_err()
            {
                state = setting.scene.release;
            }
        }
        costs.push(started.elapsed().as_secs_f64() / f64::from(BATCH));
        if progress.cancelled() {
            return Err(ReportError::Cancelled);
        }
    }
    Ok(Spread::new(costs))
}

fn precomputation(section: &mut Section, progress: &dyn Progress) -> Result<(), ReportError> {
    let scene = scene::find("table2-ellipsoid-1280-5ms")?;
    let (mesh, _) = baking::mesh(&scene)?;
    let added = median_time(progress, || {
        added_mass(&mesh, &added_mass::Options::default(), &())
            .map(drop)
            .map_err(|e| ReportError::Bake(BodyBakeError::from(e).into()))
    })?;
    let flow = FlowOptions::new(paper::TIMED_CELLS, 0.01, 1.0);
    let turbulence = median_time(progress, || {
        turbulence_history(&flow, &())?;
        Ok(())
    })?;
    let [nx, ny, nz] = paper::TIMED_CELLS;
    let mut row = |words: String, key: &str, paper: f64, here: f64| {
        let paper = section.quote(format!("{key}.paper"), 1e3 * paper, 3);
        let here = section.quote(format!("{key}.median"), 1e3 * here, 3);
        vec![words, format!("{paper} ms"), format!("{here} ms")]
    };
    let triangles = mesh.triangles().len();
    let rows = [
        row(
            format!("added mass, {triangles} triangles"),
            "added_mass",
            paper::ADDED_MASS_SECONDS,
            added.median,
        ),
        row(
            format!(
                "turbulence, {nx}x{ny}x{nz} cells, one transit ({} steps)",
                flow.cells[1]
            ),
            "turbulence",
            paper::TURBULENCE_SECONDS,
            turbulence.median,
        ),
    ];
    section.table(
        "precomputation",
        &["precomputation", "paper", "here, median"],
        &rows,
    );
    Ok(())
}

fn median_time(
    progress: &dyn Progress,
    mut work: impl FnMut() -> Result<(), ReportError>,
) -> Result<Spread, ReportError> {
    let mut times = Vec::new();
    for _ in 0..REPEATS {
        let started = Instant::now();
        work()?;
        times.push(started.elapsed().as_secs_f64());
        if progress.cancelled() {
            return Err(ReportError::Cancelled);
        }
    }
    Ok(Spread::new(times))
}
