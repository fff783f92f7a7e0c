//! What animations say of a run besides what they show.

use serde_json::{Map, Value, json};

use super::{Deviation, Kind, RecordedBody, Recording, Up};

/// The key under which all of it stands.
pub(super) const KEY: &str = "langevin_rigid";

/// The run: model, noise, fluid, and what the animation makes of it.
pub(super) fn of_run(
    recording: &Recording<'_>,
    up: Up,
    fps: f64,
    deviation: Deviation,
) -> Map<String, Value> {
    let made = recording.conditions;
    object(json!({
        "scene": made.scene,
        "version": env!("CARGO_PKG_VERSION"),
        "model": made.settings.model.to_string(),
        "integrator": made.settings.integrator.to_string(),
        "turbulence": made.settings.turbulence.to_string(),
        "seed": made.seed.to_string(),
        "bodies": recording.bodies.len(),
        "time_step_s": made.time_step,
        "gravity_m_s2": up.vector(made.settings.gravity),
        "fluid_density_kg_m3": made.fluid.density,
        "fluid_kinematic_viscosity_m2_s": made.fluid.viscosity,
        "fluid_velocity_m_s": up.vector(made.fluid.velocity),
        "frames_per_second": fps,
        "largest_position_error_m": deviation.position,
        "largest_rotation_error_rad": deviation.rotation,
    }))
}

/// A body of scale one, in its own frame; matrices row by row, linear part first.
pub(super) fn of_kind(recording: &Recording<'_>, kind: &Kind<'_>) -> Map<String, Value> {
    let (body, density) = (&kind.bake.body, recording.conditions.fluid.density);
    let added_mass: Vec<f64> = body
        .added_mass
        .as_flattened()
        .iter()
        .map(|a| density * a)
        .collect();
    object(json!({
        "mass_kg": body.mass,
        "volume_m3": body.volume,
        "inertia_kg_m2": body.inertia.as_flattened(),
        "centre_of_buoyancy_m": body.centre_of_buoyancy,
        "half_extents_m": body.half_extents,
        "added_mass_kg": added_mass,
        "added_mass_error_estimate": kind.bake.error_estimate,
    }))
}

/// Which body it is; of bodies that differ, also its kind and size.
pub(super) fn of_body(recording: &Recording<'_>, body: &RecordedBody<'_>) -> Map<String, Value> {
    let number = body.trajectory.body;
    object(match recording.is_uniform() {
        true => json!({ "body": number }),
        false => json!({
            "body": number,
            "kind": recording.kind_of(body).name,
            "scale": body.scale,
        }),
    })
}

fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}
