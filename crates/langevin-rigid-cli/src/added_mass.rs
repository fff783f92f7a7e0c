//! `langevin-rigid added-mass`

use std::fmt::Write as _;
use std::io::Write as _;
use std::time::Instant;

use anyhow::{Context, Result};
use langevin_rigid::shift_added_mass;
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{Options, added_mass as solve};
use langevin_rigid_formats::mesh::read_mesh;
use serde::Serialize;

use crate::arguments::{About, AddedMass, Format};
use crate::bars::Bars;

/// The JSON keys are a contract with scripts.
#[derive(Serialize)]
struct Report {
    triangles: usize,
    triangles_solved: usize,
    volume: f64,
    centroid: [f64; 3],
    fluid_density: f64,
    reference: [f64; 3],
    added_mass: [[f64; 6]; 6],
    error_estimate: f64,
    /// The simplified mesh, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    proxy: Option<Proxy>,
    warnings: Vec<String>,
    seconds: f64,
}

/// What stands for the mesh; its part of the error estimate is in that of the report too.
#[derive(Serialize)]
struct Proxy {
    triangles: usize,
    /// Largest distance of a vertex of the mesh (m).
    deviation: f64,
    error_estimate: f64,
}

pub(crate) fn added_mass(options: &AddedMass, bars: &Bars) -> Result<()> {
    let started = Instant::now();
    let mesh = read(options)?;
    let (result, proxy) = match options.proxy {
        Some(triangles) => {
            let simplified = mesh.proxy(triangles as usize)?;
            let result = solve(&simplified, &Options::default(), bars)?;
            let error = result.shape_error(&mesh);
            let proxy = Proxy {
                triangles: simplified.triangles().len(),
                deviation: error.deviation,
                error_estimate: error.estimate,
            };
            (result, Some(proxy))
        }
        None => (solve(&mesh, &Options::default(), bars)?, None),
    };
    let reference = match options.about {
        About::Com => result.reference,
        About::Origin => [0.0; 3],
    };
    let offset = std::array::from_fn(|i| reference[i] - result.reference[i]);
    let tensor = shift_added_mass(&result.tensor, offset);
    let mut warnings: Vec<String> = result.warnings.iter().map(ToString::to_string).collect();
    if mesh.was_turned() {
        warnings.push("the mesh was inside out; its triangles were turned".into());
    }
    let report = Report {
        triangles: mesh.triangles().len(),
        triangles_solved: result.surface.triangles.len(),
        volume: mesh.volume(),
        centroid: result.reference,
        fluid_density: options.fluid_density,
        reference,
        added_mass: tensor.map(|row| row.map(|a| options.fluid_density * a)),
        error_estimate: result.error_estimate
            + proxy.as_ref().map_or(0.0, |proxy| proxy.error_estimate),
        proxy,
        warnings,
        seconds: started.elapsed().as_secs_f64(),
    };
    bars.clear();
    for warning in &report.warnings {
        eprintln!("warning: {warning}");
    }
    let text = match options.format {
        Format::Json => serde_json::to_string_pretty(&report)? + "\n",
        Format::Table => table(&report),
    };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

fn read(options: &AddedMass) -> Result<TriMesh> {
    let raw = read_mesh(&options.mesh, options.unit)?;
    match options.thickness {
        Some(thickness) => raw.sheet(thickness),
        None => raw.body(),
    }
    .with_context(|| options.mesh.display().to_string())
}

fn table(report: &Report) -> String {
    let mut out = String::new();
    let point = |p: [f64; 3]| format!("({:.6e}, {:.6e}, {:.6e}) m", p[0], p[1], p[2]);
    // Writing to a string cannot fail.
    let mut line = |name: &str, value: String| {
        let _ = writeln!(out, "{name:<16}{value}");
    };
    let solved = match report.triangles_solved {
        n if n == report.triangles => String::new(),
        n => format!(" (solved on {n})"),
    };
    line("triangles", format!("{}{solved}", report.triangles));
    if let Some(proxy) = &report.proxy {
        let Proxy {
            triangles,
            deviation,
            error_estimate,
        } = proxy;
        let cost = 100.0 * error_estimate;
        line(
            "proxy",
            format!("{triangles} triangles, {deviation:.2e} m away, which may cost {cost:.2} %"),
        );
    }
    line("volume", format!("{:.6e} m^3", report.volume));
    line("centroid", point(report.centroid));
    line("fluid density", format!("{} kg/m^3", report.fluid_density));
    line("about", point(report.reference));
    line(
        "error estimate",
        format!("{:.2} %", 100.0 * report.error_estimate),
    );
    line("time", format!("{:.3} s", report.seconds));
    out.push_str("\nadded mass (kg, kg m, kg m^2; force per acceleration, linear first)\n");
    out.push_str("           ");
    for name in ["x", "y", "z", "rot x", "rot y", "rot z"] {
        let _ = write!(out, "{name:>15}");
    }
    for (name, row) in ["x", "y", "z", "rot x", "rot y", "rot z"]
        .iter()
        .zip(&report.added_mass)
    {
        let _ = write!(out, "\n{name:>11}");
        for entry in row {
            let _ = write!(out, "{entry:>15.6e}");
        }
    }
    out.push('\n');
    out
}
