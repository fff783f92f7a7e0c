//! The constants of the closure for separated flow in a scene.

use langevin_rigid::SeparatedFlow;

use super::place::{Document, SceneError};
use super::raw::{Given, RawSeparated, given};

pub(super) fn resolve(doc: &Document, raw: &RawSeparated) -> Result<SeparatedFlow, SceneError> {
    let defaults = SeparatedFlow::default();
    let fraction = |value: &Given<f64>, default, key: &str| {
        within(
            doc,
            value,
            default,
            0.0..=1.0,
            &format!("`{key}` must lie between 0 and 1"),
        )
    };
    let gain = |value: &Given<f64>, default, key: &str| {
        within(
            doc,
            value,
            default,
            0.0..=f64::MAX,
            &format!("`{key}` must be zero or positive"),
        )
    };
    Ok(SeparatedFlow {
        attachment: fraction(&raw.attachment, defaults.attachment, "attachment")?,
        broadside_attachment: fraction(
            &raw.broadside_attachment,
            defaults.broadside_attachment,
            "broadside_attachment",
        )?,
        dynamic_stall: gain(&raw.dynamic_stall, defaults.dynamic_stall, "dynamic_stall")?,
        rotational_lift: gain(
            &raw.rotational_lift,
            defaults.rotational_lift,
            "rotational_lift",
        )?,
        rotational_damping: gain(
            &raw.rotational_damping,
            defaults.rotational_damping,
            "rotational_damping",
        )?,
        turbulence_intensity: gain(
            &raw.turbulence_intensity,
            defaults.turbulence_intensity,
            "turbulence_intensity",
        )?,
        attached: raw.attached.unwrap_or(defaults.attached),
    })
}

fn within(
    doc: &Document,
    value: &Given<f64>,
    default: f64,
    range: std::ops::RangeInclusive<f64>,
    message: &str,
) -> Result<f64, SceneError> {
    match value {
        None => Ok(default),
        Some(v) if range.contains(v.get_ref()) => Ok(*v.get_ref()),
        Some(v) => Err(doc.error(v.span(), format!("{message}, and is {}", v.get_ref()))),
    }
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
