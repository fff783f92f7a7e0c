//! `langevin-rigid repair`

use std::io::Write as _;
use std::path::Path;

use anyhow::{Context, Result, bail};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::mesh::{Balance, Options, Step, Unrepaired, repair as mend};
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh, write_obj, write_stl};
use serde::Serialize;

use crate::arguments::Repair;
use crate::bars::Bars;
use crate::{meshes, say};

/// The JSON keys are a contract with scripts.
#[derive(Serialize)]
struct Report {
    steps: Vec<StepReport>,
    /// Whether the file was written.
    written: bool,
    triangles: Option<usize>,
    volume: Option<f64>,
    balance: Option<BalanceReport>,
    warnings: Vec<String>,
}

/// Areas and volumes of [`Balance`] as shares.
#[derive(Serialize)]
pub(crate) struct BalanceReport {
    lost_share_of_area_given: f64,
    made_share_of_area: f64,
    volume_share_of_convex_hull: f64,
    text: String,
}

impl BalanceReport {
    pub(crate) fn new(balance: &Balance) -> Self {
        Self {
            lost_share_of_area_given: balance.lost_share(),
            made_share_of_area: balance.made_share(),
            volume_share_of_convex_hull: balance.hull_share(),
            text: balance.to_string(),
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

#[derive(Serialize)]
pub(crate) struct StepReport {
    step: &'static str,
    count: usize,
    text: String,
}

impl StepReport {
    pub(crate) fn new(step: &Step) -> Self {
        Self {
            step: step.name(),
            count: step.count(),
            text: step.to_string(),
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

pub(crate) fn repair(options: &Repair, bars: &Bars) -> Result<()> {
    let format = format(&options.out)?;
    let _claim = Claim::file(&options.out)?;
    let raw = meshes::read(&options.mesh, options.unit)?;
    let choices = Options {
        weld: options.weld,
        fill: options.fill,
        thickness: options.thickness,
        wrap: options.wrap.map(|size| size.of(&raw)),
        triangles: options.triangles.map(|n| n as usize),
        largest: options.largest,
    };
    let repaired = mend(&raw.vertices, &raw.triangles, &choices, bars);
    bars.clear();
    let written = repaired
        .body
        .map_err(|e| unmended(options, &e))
        .and_then(|body| {
            write(&options.out, format, &body)?;
            Ok(body)
        });
    let report = Report {
        steps: repaired.steps.iter().map(StepReport::new).collect(),
        written: written.is_ok(),
        triangles: written.as_ref().ok().map(|body| body.triangles().len()),
        volume: written.as_ref().ok().map(TriMesh::volume),
        balance: repaired.balance.as_ref().map(BalanceReport::new),
        warnings: repaired.balance.map_or_else(Vec::new, |b| b.warnings()),
    };
    for warning in &report.warnings {
        say::warning(warning);
    }
    let text = match options.json {
        true => serde_json::to_string_pretty(&report)? + "\n",
        false => lines(&report, &options.out),
    };
    say::out().write_all(text.as_bytes())?;
    written.map(|_| ())
}

fn unmended(options: &Repair, error: &Unrepaired) -> anyhow::Error {
    let place = options.mesh.display();
    anyhow::anyhow!("{place}: {error}; nothing was written")
}

fn format(out: &Path) -> Result<MeshFormat> {
    match MeshFormat::of_extension(out) {
        Some(format @ (MeshFormat::Obj | MeshFormat::Stl)) => Ok(format),
        _ => bail!(
            "cannot write `{}`: the file must end in .obj or .stl",
            out.display()
        ),
    }
}

/// Writes the body, if it is still one when it is read back.
fn write(out: &Path, format: MeshFormat, body: &TriMesh) -> Result<()> {
    let mut bytes = Vec::new();
    match format {
        MeshFormat::Stl => write_stl(body, &mut bytes)?,
        _ => write_obj(body, &mut bytes)?,
    }
    parse_mesh(&bytes, format, Some(LengthUnit::M), None)?
        .body()
        .with_context(|| {
            "written as STL, which rounds to single precision and tells equal vertices apart by nothing, \
             it would be no body; write .obj (nothing was written)"
        })?;
    Ok(files::write(out, &bytes)?)
}

fn lines(report: &Report, out: &Path) -> String {
    let mut text = String::new();
    for step in &report.steps {
        text += &step.text;
        text.push('\n');
    }
    if let Some(balance) = report.balance.as_ref().filter(|_| !report.steps.is_empty()) {
        text += &balance.text;
        text.push('\n');
    }
    if report.steps.is_empty() && report.written {
        text += "nothing to mend\n";
    }
    if let (Some(triangles), Some(volume)) = (report.triangles, report.volume) {
        text += &format!(
            "{}: a body of {triangles} triangles and {volume:.6e} m^3, in metres\n",
            out.display()
        );
    }
    text
}
