//! Where a body is and how it moves.

use langevin_rigid::State;

use crate::pointers;
use crate::status::{Error, call, lr_status};
use crate::vector::{lr_quat, lr_vec3};

/// Pose and velocities of a body at a time. The velocities are in the body frame, where the equations are:
/// `lr_state_set_world_velocities` and `lr_state_get_world_velocities` convert them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_state {
    /// Time since release (s).
    pub time: f64,
    /// Steps taken since release; selects the noise of the next one.
    pub step: u64,
    /// Position of the centre of mass, world frame (m).
    pub position: lr_vec3,
    /// Orientation, body to world.
    pub orientation: lr_quat,
    /// Velocity of the centre of mass, body frame (m/s).
    pub velocity: lr_vec3,
    /// Angular velocity, body frame (rad/s).
    pub angular_velocity: lr_vec3,
    /// Turbulence that the body sees under `LR_MODEL_SEPARATED`, world frame: velocity of the fluid in units of its standard
    /// deviation. Zero at release; steps change it.
    pub fluctuation: lr_vec3,
    /// The same of the rotation rate of the fluid.
    pub fluctuation_spin: lr_vec3,
}

/// At rest at the origin, body axes along the world's.
#[unsafe(no_mangle)]
pub extern "C" fn lr_state_default() -> lr_state {
    State::default().into()
}

/// Sets both velocities from the world frame (m/s, rad/s), by the orientation that the state has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_state_set_world_velocities(
    state: *mut lr_state,
    velocity: lr_vec3,
    angular_velocity: lr_vec3,
) -> lr_status {
    call(|| {
        // SAFETY: promised by the caller.
        let state = unsafe { pointers::exclusive(state, "state") }?;
        let mut set = State::from(*state);
        set.set_world_velocities(velocity.into(), angular_velocity.into());
        check(&set)?;
        *state = set.into();
        Ok(())
    })
}

/// Both velocities in the world frame (m/s, rad/s). Either place may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_state_get_world_velocities(
    state: *const lr_state,
    velocity: *mut lr_vec3,
    angular_velocity: *mut lr_vec3,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let state = State::from(*pointers::shared(state, "state")?);
        check(&state)?;
        if !velocity.is_null() {
            pointers::put(velocity, "velocity", state.world_velocity().into())?;
        }
        if !angular_velocity.is_null() {
            let spin = state.world_angular_velocity().into();
            pointers::put(angular_velocity, "angular_velocity", spin)?;
        }
        Ok(())
    })
}

/// Checks what a step would check, for calls that take none.
pub(crate) fn check(state: &State) -> Result<(), Error> {
    let impossible = |name, wanted| langevin_rigid::StepError::State {
        name,
        wanted,
        step: state.step,
    };
    if !state.is_finite() {
        return Err(impossible("a number", "finite number").into());
    }
    let length: f64 = state.orientation.iter().map(|x| x * x).sum();
    if (length - 1.0).abs() >= 0.01 {
        return Err(impossible("the orientation", "unit quaternion").into());
    }
    Ok(())
}

impl From<State> for lr_state {
    fn from(state: State) -> Self {
        let [a, b, c, d, e, f] = state.fluctuation;
        Self {
            time: state.time,
            step: state.step,
            position: state.position.into(),
            orientation: state.orientation.into(),
            velocity: state.velocity.into(),
            angular_velocity: state.angular_velocity.into(),
            fluctuation: [a, b, c].into(),
            fluctuation_spin: [d, e, f].into(),
        }
    }
}

impl From<lr_state> for State {
    fn from(state: lr_state) -> Self {
        let (v, spin) = (state.fluctuation, state.fluctuation_spin);
        Self {
            time: state.time,
            step: state.step,
            position: state.position.into(),
            orientation: state.orientation.into(),
            velocity: state.velocity.into(),
            angular_velocity: state.angular_velocity.into(),
            fluctuation: [v.x, v.y, v.z, spin.x, spin.y, spin.z],
        }
    }
}
