//! The constants of the closure for separated flow in a scene.

use langevin_rigid::SeparatedFlow;

use super::place::{Document, SceneError};
use super::quantity::{FRACTION, GAIN, Kind};
use super::raw::{Given, RawSeparated, given};

pub(super) fn resolve(doc: &Document, raw: &RawSeparated) -> Result<SeparatedFlow, SceneError> {
    let defaults = SeparatedFlow::default();
    let or = |value: &Given<f64>, default: f64, key: &str, kind: Kind| {
        Ok(doc.given(value, key, kind)?.unwrap_or(default))
    };
    Ok(SeparatedFlow {
        attachment: or(&raw.attachment, defaults.attachment, "attachment", FRACTION)?,
        broadside_attachment: or(
            &raw.broadside_attachment,
            defaults.broadside_attachment,
            "broadside_attachment",
            FRACTION,
        )?,
        dynamic_stall: or(
            &raw.dynamic_stall,
            defaults.dynamic_stall,
            "dynamic_stall",
            GAIN,
        )?,
        rotational_lift: or(
            &raw.rotational_lift,
            defaults.rotational_lift,
            "rotational_lift",
            GAIN,
        )?,
        rotational_damping: or(
            &raw.rotational_damping,
            defaults.rotational_damping,
            "rotational_damping",
            GAIN,
        )?,
        turbulence_intensity: or(
            &raw.turbulence_intensity,
            defaults.turbulence_intensity,
            "turbulence_intensity",
            GAIN,
        )?,
        attached: raw.attached.unwrap_or(defaults.attached),
    })
}

/// The section of a resolved scene.
pub(super) fn write(constants: &SeparatedFlow) -> RawSeparated {
    RawSeparated {
        attachment: given(constants.attachment),
        broadside_attachment: given(constants.broadside_attachment),
        dynamic_stall: given(constants.dynamic_stall),
        rotational_lift: given(constants.rotational_lift),
        rotational_damping: given(constants.rotational_damping),
        turbulence_intensity: given(constants.turbulence_intensity),
        attached: Some(constants.attached),
    }
}
