//! `langevin-rigid added-mass`

use std::io::Write as _;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{AddedMass as Solution, Options, added_mass as solve};
use langevin_rigid_formats::added_mass::{
    Proxy, Report, capytaine, csv, json, mujoco, sdf, table, uuv,
};

use crate::arguments::{About, AddedMass, Format};
use crate::bars::Bars;
use crate::{meshes, say};

pub(crate) fn added_mass(options: &AddedMass, bars: &Bars) -> Result<()> {
    let started = Instant::now();
    check(options)?;
    let mesh = read(options)?;
    let (solution, proxy) = solved(&mesh, options, bars)?;
    let mut report = report(&mesh, &solution, proxy, options);
    if options.about == Some(About::Origin) {
        report = report.about([0.0; 3]);
    }
    report.seconds = started.elapsed().as_secs_f64();
    bars.clear();
    for warning in &report.warnings {
        say::warning(warning);
    }
    let text = match options.format {
        Format::Table => table(&report),
        Format::Json => json(&report)?,
        Format::Csv => csv(&report),
        Format::Sdf => sdf(&report),
        Format::Uuv => uuv(&report),
        Format::Mujoco => mujoco(&report),
        Format::Capytaine => capytaine(&report),
    };
    say::out().write_all(text.as_bytes())?;
    Ok(())
}

/// Refuses a reference point that the format does not have.
fn check(options: &AddedMass) -> Result<()> {
    match (options.format, options.about) {
        (Format::Sdf | Format::Uuv, Some(About::Com)) => bail!(
            "--about com contradicts this --format, whose tensor is about the origin of the link; leave \
             --about out"
        ),
        (Format::Mujoco, Some(_)) => bail!(
            "--format mujoco takes no --about: its program moves the tensor to the geom; leave --about out"
        ),
        _ => Ok(()),
    }
}

fn read(options: &AddedMass) -> Result<TriMesh> {
    let raw = meshes::read(&options.mesh, options.unit)?;
    match options.thickness {
        Some(thickness) => raw.sheet(thickness),
        None => raw.body(),
    }
    .with_context(|| options.mesh.display().to_string())
}

fn solved(mesh: &TriMesh, options: &AddedMass, bars: &Bars) -> Result<(Solution, Option<Proxy>)> {
    let Some(triangles) = options.proxy else {
        return Ok((solve(mesh, &Options::default(), bars)?, None));
    };
    let simplified = mesh.proxy(triangles as usize)?;
    let solution = solve(&simplified, &Options::default(), bars)?;
    let error = solution.shape_error(mesh);
    let proxy = Proxy {
        triangles: simplified.triangles().len(),
        deviation: error.deviation,
        error_estimate: error.estimate,
    };
    Ok((solution, Some(proxy)))
}

/// The report about the centroid.
fn report(
    mesh: &TriMesh,
    solution: &Solution,
    proxy: Option<Proxy>,
    options: &AddedMass,
) -> Report {
    let mut warnings: Vec<String> = solution.warnings.iter().map(ToString::to_string).collect();
    if mesh.was_turned() {
        warnings.push("the mesh was inside out; its triangles were turned".into());
    }
    let name = options.mesh.file_name().unwrap_or(options.mesh.as_os_str());
    Report {
        mesh: name.to_string_lossy().into_owned(),
        triangles: mesh.triangles().len(),
        triangles_solved: solution.surface.triangles.len(),
        volume: mesh.volume(),
        centroid: solution.reference,
        fluid_density: options.fluid_density,
        reference: solution.reference,
        added_mass: solution
            .tensor
            .map(|row| row.map(|a| options.fluid_density * a)),
        error_estimate: solution.error_estimate
            + proxy.as_ref().map_or(0.0, |proxy| proxy.error_estimate),
        proxy,
        warnings,
        seconds: 0.0,
    }
}
