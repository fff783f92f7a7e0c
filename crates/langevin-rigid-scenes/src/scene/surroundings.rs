//! What is around the body: fluid and tank.

use langevin_rigid::{Fluid, Tank, choose};
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{DENSITY, Kind, SIZE, SPEED, VISCOSITY};
use super::raw::{Given, RawFluid, RawTank};

pub(super) fn fluid(doc: &Document, raw: &Spanned<RawFluid>) -> Result<Fluid, SceneError> {
    let given = raw.get_ref();
    let preset = given.preset.as_ref().map(|name| preset(doc, name));
    let preset = preset.transpose()?.map(|(_, fluid)| fluid);
    let quantity = |value: &Given<f64>, of_preset: Option<f64>, key: &str, kind: Kind| {
        doc.given(value, key, kind)?.or(of_preset).ok_or_else(|| {
            let what = kind.named(key);
            let message = format!("the fluid needs {what}, or a `preset` (\"air\" or \"water\")");
            doc.error(raw.span(), message)
        })
    };
    let (density, viscosity) = (preset.map(|p| p.density), preset.map(|p| p.viscosity));
    Ok(Fluid {
        density: quantity(&given.density, density, "density", DENSITY)?,
        viscosity: quantity(&given.viscosity, viscosity, "viscosity", VISCOSITY)?,
        velocity: doc.vector(&given.velocity, "velocity", SPEED)?,
    })
}

/// The fluid of a name, and the name.
pub(super) fn preset(
    doc: &Document,
    name: &Spanned<String>,
) -> Result<(&'static str, Fluid), SceneError> {
    let presets = [("air", Fluid::AIR), ("water", Fluid::WATER)];
    let choices = presets.map(|(name, fluid)| (name, (name, fluid)));
    choose("preset fluid", name.get_ref(), choices).map_err(|unknown| {
        let message = format!("{unknown}, or give `density` and `viscosity`");
        doc.error(name.span(), message)
    })
}

pub(super) fn tank(doc: &Document, raw: Option<&RawTank>) -> Result<Option<Tank>, SceneError> {
    let size = raw.map(|tank| doc.numbers(&tank.size, "size", SIZE));
    Ok(size.transpose()?.map(|size| Tank { size }))
}
