//! A body made ready to step.

use langevin_rigid::{Fluid, Input, NoiseStream, State, StepError, Stepper};

use crate::body::lr_body;
use crate::fluid::lr_fluid;
use crate::input::lr_input;
use crate::loads::lr_loads;
use crate::pointers;
use crate::settings::{lr_settings, lr_settings_default};
use crate::state::{check, lr_state};
use crate::status::{Error, call, lr_status};

/// A body in a fluid under settings. It is made once and steps any number of bodies of that shape; it holds no state, so
/// several threads may use it at a time.
pub struct lr_stepper(Stepper);

/// Makes a body ready to step in a fluid. NULL settings are `lr_settings_default`. Body, fluid and settings are not needed
/// afterwards.
///
/// `LR_STATUS_SETUP` if they do not go together.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_new(
    body: *const lr_body,
    fluid: *const lr_fluid,
    settings: *const lr_settings,
    out: *mut *mut lr_stepper,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        pointers::put_new(out, || {
            let lr_body { body, history } = pointers::shared(body, "body")?;
            let fluid = Fluid::from(*pointers::shared(fluid, "fluid")?);
            let settings = match settings.is_null() {
                true => lr_settings_default(),
                false => *pointers::shared(settings, "settings")?,
            };
            let settings = settings.chosen()?;
            let stepper = Stepper::new(body, &fluid, history.as_ref(), &settings)?;
            Ok(lr_stepper(stepper))
        })
    })
}

/// Frees a stepper; NULL is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_free(stepper: *mut lr_stepper) {
    // SAFETY: promised by the caller.
    unsafe { pointers::free(stepper) }
}

/// Advances a state by `dt` (s). The input stays what it is over the step; NULL is `lr_input_default`. A step of any length
/// is stable, and allocates nothing.
///
/// On failure the state is left as it was: `LR_STATUS_STATE` if it was impossible, `LR_STATUS_ARGUMENT` if `dt` or the
/// input is, `LR_STATUS_DIVERGED` if the step would have made it so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_step(
    stepper: *const lr_stepper,
    state: *mut lr_state,
    dt: f64,
    input: *const lr_input,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let stepper = &pointers::shared(stepper, "stepper")?.0;
        let state = pointers::exclusive(state, "state")?;
        let input = input_or_still(input)?;
        Ok(step(stepper, state, dt, &input)?)
    })
}

/// Advances `count` states by `dt` (s), each under its own input. NULL inputs are fluid at rest, no wrench, seed 0 and the
/// index as the number of the body.
///
/// It stops at the first failure, whose index `lr_last_error` names: the states before it have taken their step, that one
/// and those after it have not. Threads may step parts of the states at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_step_many(
    stepper: *const lr_stepper,
    states: *mut lr_state,
    count: usize,
    dt: f64,
    inputs: *const lr_input,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let stepper = &pointers::shared(stepper, "stepper")?.0;
        let states = pointers::exclusive_many(states, count, "states")?;
        let inputs = match inputs.is_null() {
            true => None,
            false => Some(pointers::shared_many(inputs, count, "inputs")?),
        };
        for (index, state) in states.iter_mut().enumerate() {
            let input = match inputs {
                Some(inputs) => inputs[index].into(),
                None => Input::with_noise(numbered(index)?),
            };
            step(stepper, state, dt, &input).map_err(|cause| Error::StepOfMany { index, cause })?;
        }
        Ok(())
    })
}

/// What acts on the body in a state under an input, by cause; a NULL input is `lr_input_default`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_loads(
    stepper: *const lr_stepper,
    state: *const lr_state,
    input: *const lr_input,
    out: *mut lr_loads,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let stepper = &pointers::shared(stepper, "stepper")?.0;
        let state = State::from(*pointers::shared(state, "state")?);
        check(&state)?;
        let input = input_or_still(input)?;
        if !input.is_finite() {
            return Err(StepError::Input { step: state.step }.into());
        }
        pointers::put(out, "out", stepper.loads(&state, &input).into())
    })
}

/// The longest step (s) that a body in this state takes whole; a longer one is taken in parts, which cost as much each.
/// Infinite for a body at rest without friction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_stepper_longest_step(
    stepper: *const lr_stepper,
    state: *const lr_state,
    out: *mut f64,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let stepper = &pointers::shared(stepper, "stepper")?.0;
        let state = State::from(*pointers::shared(state, "state")?);
        check(&state)?;
        pointers::put(out, "out", stepper.longest_step(&state))
    })
}

fn step(stepper: &Stepper, state: &mut lr_state, dt: f64, input: &Input) -> Result<(), StepError> {
    let mut stepped = State::from(*state);
    stepper.step(&mut stepped, dt, input)?;
    *state = stepped.into();
    Ok(())
}

/// # Safety
/// It is NULL or an input that nobody writes to meanwhile.
unsafe fn input_or_still(input: *const lr_input) -> Result<Input, Error> {
    if input.is_null() {
        return Ok(Input::default());
    }
    // SAFETY: promised by the caller.
    Ok(unsafe { *pointers::shared(input, "input")? }.into())
}

fn numbered(index: usize) -> Result<NoiseStream, Error> {
    let body = u32::try_from(index).map_err(|_| Error::Argument {
        name: "the count",
        value: format!("more than {index}"),
        wanted: "at most 4294967296 without inputs, which number bodies otherwise",
    })?;
    Ok(NoiseStream { seed: 0, body })
}
