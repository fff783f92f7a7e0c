//! `langevin-rigid export`

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use langevin_rigid_formats::export::{
    self, BodyRow, Format, Kind, Options, RecordedBody, Recording, Up, read_bodies,
};
use langevin_rigid_formats::files::Claim;
use langevin_rigid_formats::trajectory::{Trajectory, read_csv};
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::scene::{self, Scene};
use serde_json::Value;

use crate::arguments::Export;
use crate::bars::Bars;
use crate::{cache, forecast, say};

pub(crate) fn export(options: &Export, bars: &Bars) -> Result<()> {
    export::check(&options.format)?;
    let folder = options.out.as_deref().unwrap_or(&options.run);
    keep_the_table(options, folder)?;
    let summary = summary(&options.run);
    let trajectories = trajectories(&options.run, &summary)?;
    let rows = bodies(&options.run, &summary)?;
    let scene = scene_of(&options.run, &summary)?;
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

fn trajectories(run: &Path, summary: &Value) -> Result<Vec<Trajectory>> {
    let path = run.join(Format::Csv.file_name());
    let table = std::fs::read_to_string(&path).with_context(|| {
        format!(
            "cannot read `{}`, the table that exports are made from; give a folder that `langevin-rigid \
             simulate` wrote with csv among its formats",
            path.display()
        )
    })?;
    if let Some(files) = summary["files"].as_array()
        && !files.iter().any(|file| file == Format::Csv.file_name())
    {
        bail!(
            "`{}` is of an older run: the last one in this folder was not asked for csv; simulate it \
             again with csv among its formats",
            path.display()
        );
    }
    read_csv(&table).with_context(|| path.display().to_string())
}

/// Kinds and sizes of the bodies, where they differ.
fn bodies(run: &Path, summary: &Value) -> Result<Vec<BodyRow>> {
    let name = "bodies.csv";
    let files = summary["files"].as_array();
    if !files.is_some_and(|files| files.iter().any(|file| file == name)) {
        return Ok(Vec::new());
    }
    let path = run.join(name);
    let table = std::fs::read_to_string(&path).with_context(|| {
        format!(
            "cannot read `{}`, the kinds and sizes of the bodies",
            path.display()
        )
    })?;
    read_bodies(&table).with_context(|| path.display().to_string())
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
    let row = row.with_context(|| format!("bodies.csv does not tell the kind of body {number}"))?;
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

/// What the run said of itself; nothing where that is lost.
fn summary(run: &Path) -> Value {
    let bytes = std::fs::read(run.join("summary.json")).ok();
    let summary = bytes.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    summary.unwrap_or_default()
}

/// The scene of a run, by the name it had, without what moved its bodies.
fn scene_of(run: &Path, summary: &Value) -> Result<Scene> {
    let scene = scene::find(&run.join("scene.toml").display().to_string())?;
    let name = summary["scene"].as_str().unwrap_or(&scene.name).to_owned();
    Ok(Scene {
        name,
        wind: Vec::new(),
        obstacles: Vec::new(),
        water: None,
        ..scene
    })
}
