//! `langevin-rigid export`

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use langevin_rigid_formats::export::{
    self, BodyRow, Format, Kind, Options, RecordedBody, Recording, Up,
};
use langevin_rigid_formats::files::Claim;
use langevin_rigid_formats::trajectory::Trajectory;
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::scene::Scene;

use crate::arguments::Export;
use crate::bars::Bars;
use crate::recorded_run::{BODIES, RecordedRun};
use crate::{cache, forecast, say};

pub(crate) fn export(options: &Export, bars: &Bars) -> Result<()> {
    export::check(&options.format)?;
    let folder = options.out.as_deref().unwrap_or(&options.run);
    keep_the_table(options, folder)?;
    let made = RecordedRun::open(&options.run);
    let trajectories = made.trajectories()?.rows;
    let rows = made.bodies()?.map_or_else(Vec::new, |bodies| bodies.rows);
    let scene = without_surroundings(made.scene()?);
    forecast(options, &trajectories)?;
    let _claim = Claim::folder(folder)?;
    let prepared = cache::prepare(scene, bars)?;
    let cast = Cast::new(&prepared)?;
    bars.clear();
    for notice in cast.notices() {
        say::warning(notice);
    }
    let kinds = cast.kinds();
    let bodies = trajectories
        .iter()
        .map(|trajectory| recorded(trajectory, &kinds, &rows));
    let bodies: Vec<RecordedBody<'_>> = bodies.collect::<Result<_>>()?;
    let run = Recording {
        conditions: prepared.scene().conditions(),
        kinds: &kinds,
        bodies: &bodies,
    };
    let how = Options {
        fps: options.fps,
        up: options.up,
    };
    if options.up == Up::Z && options.format.contains(&Format::Glb) {
        say::note("glb has +Y up by definition; programs turn it to their own axes");
    }
    let mut out = say::out();
    for &format in &options.format {
        let written = export::write(&run, format, folder, &how)?;
        let path = folder.join(format.file_name());
        write!(out, "wrote {}", path.display())?;
        if let Some(deviation) = written.deviation {
            write!(
                out,
                ": {} frames a second, within {deviation} of the trajectory",
                options.fps
            )?;
        }
        for warning in written.warnings {
            say::warning(format!("{format}: {warning}"));
        }
        writeln!(out)?;
    }
    Ok(())
}

fn forecast(options: &Export, trajectories: &[Trajectory]) -> Result<()> {
    let ends = trajectories
        .iter()
        .filter_map(|t| Some(t.poses.last()?.time));
    let seconds: f64 = ends.sum();
    let need = forecast::kept(1, seconds, f64::INFINITY, Some(options.fps));
    forecast::check(need, &format!("`--fps {:?}`", options.fps))
}

/// The table of a run is what everything else is made from.
fn keep_the_table(options: &Export, folder: &Path) -> Result<()> {
    let same = || folder.canonicalize().ok() == options.run.canonicalize().ok();
    if options.format.contains(&Format::Csv) && options.up != Up::Y && same() {
        bail!(
            "csv with another axis up would take the place of the run's own table, {}; give another \
             folder with --out",
            options.run.join(Format::Csv.file_name()).display()
        );
    }
    Ok(())
}

fn recorded<'a>(
    trajectory: &'a Trajectory,
    kinds: &[Kind<'_>],
    rows: &[BodyRow],
) -> Result<RecordedBody<'a>> {
    if rows.is_empty() {
        return Ok(trajectory.into());
    }
    let number = trajectory.body;
    let row = rows.iter().find(|row| row.body == number);
    let row = row.with_context(|| format!("{BODIES} does not tell the kind of body {number}"))?;
    let kind = kinds.iter().position(|kind| kind.name == row.kind);
    Ok(RecordedBody {
        kind: kind.with_context(|| {
            let kind = &row.kind;
            format!("body {number} is of kind `{kind}`, which the scene does not have")
        })?,
        scale: row.scale,
        trajectory,
    })
}

/// The scene without what moved its bodies.
fn without_surroundings(scene: Scene) -> Scene {
    Scene {
        wind: Vec::new(),
        obstacles: Vec::new(),
        water: None,
        ..scene
    }
}
