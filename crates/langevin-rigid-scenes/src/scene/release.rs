//! Pose and velocities at release.

use langevin_rigid::State;
use langevin_rigid::linalg::quat_from_rotation_vector;

use super::place::{Document, SceneError, length};
use super::quantity::{ANGLE, DELAY, DIRECTION, PLACE, SPEED, SPIN, UNIT};
use super::raw::{RawRelease, given};

/// The shortest vector that has a direction.
const SHORTEST: f64 = 1e-6;

pub(super) fn resolve(doc: &Document, raw: &RawRelease) -> Result<State, SceneError> {
    let place = |v| doc.numbers(v, "position", PLACE);
    let mut state = State {
        position: raw.position.as_ref().map_or(Ok([0.0; 3]), place)?,
        orientation: orientation(doc, raw)?,
        ..State::default()
    };
    let velocity = doc.vector(&raw.velocity, "velocity", SPEED)?;
    let spin = doc.vector(&raw.angular_velocity, "angular_velocity", SPIN)?;
    let of_body = raw.frame.as_ref().map_or(Ok(false), |frame| {
        let choices = [("world", false), ("body", true)];
        doc.choose("`frame` of the velocities", frame, choices)
    })?;
    if of_body {
        (state.velocity, state.angular_velocity) = (velocity, spin);
    } else {
        state.set_world_velocities(velocity, spin);
    }
    Ok(state)
}

/// How long the body is carried along (s).
pub(super) fn carried(doc: &Document, raw: &RawRelease) -> Result<f64, SceneError> {
    Ok(doc.given(&raw.carried, "carried", DELAY)?.unwrap_or(0.0))
}

/// The release as it reads back: velocities in the world frame where rounding lets them.
pub(super) fn write(release: &State, carried: f64) -> RawRelease {
    let (velocity, spin) = (release.world_velocity(), release.world_angular_velocity());
    let mut again = *release;
    again.set_world_velocities(velocity, spin);
    let (frame, velocity, spin) = if again == *release {
        ("world", velocity, spin)
    } else {
        ("body", release.velocity, release.angular_velocity)
    };
    RawRelease {
        position: given(release.position.to_vec()),
        orientation: given(release.orientation.to_vec()),
        velocity: given(velocity.to_vec()),
        angular_velocity: given(spin.to_vec()),
        frame: given(frame.to_owned()),
        carried: given(carried),
        ..RawRelease::default()
    }
}

pub(super) fn orientation(doc: &Document, raw: &RawRelease) -> Result<[f64; 4], SceneError> {
    let Some(given) = &raw.orientation else {
        return tilted(doc, raw);
    };
    let q: [f64; 4] = doc.numbers(given, "orientation", UNIT)?;
    let length = length(&q);
    if (length - 1.0).abs() > 1e-6 {
        let message =
            format!("`orientation` [x, y, z, w] must be a unit quaternion; its length is {length}");
        return Err(doc.error(given.span(), message));
    }
    match &raw.tilt {
        Some(tilt) => Err(doc.error(tilt.span(), "give a `tilt` or an `orientation`, not both")),
        None => Ok(unit(q)),
    }
}

fn tilted(doc: &Document, raw: &RawRelease) -> Result<[f64; 4], SceneError> {
    let axis = match &raw.tilt_axis {
        None => [0.0, 0.0, 1.0],
        Some(given) => {
            let axis: [f64; 3] = doc.numbers(given, "tilt_axis", DIRECTION)?;
            let length = length(&axis);
            if length < SHORTEST {
                let message = format!(
                    "`tilt_axis` must be at least {SHORTEST:e} long, and is {length:e} long"
                );
                return Err(doc.error(given.span(), message));
            }
            axis.map(|x| x / length)
        }
    };
    let angle = doc.given(&raw.tilt, "tilt", ANGLE)?.unwrap_or(0.0);
    let turn = axis.map(|x| x * angle.to_radians());
    Ok(unit(quat_from_rotation_vector(turn)))
}

/// Of unit length. What is so to rounding keeps its bits: resolved scenes read back the same.
fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = length(&q);
    match (length - 1.0).abs() < 1e-15 {
        true => q,
        false => q.map(|x| x / length),
    }
}
