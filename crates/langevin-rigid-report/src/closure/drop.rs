//! Bodies from a shape, and their falls.

use langevin_rigid::linalg::{Quat, quat_from_rotation_vector};
use langevin_rigid::{
    Body, Fluid, Input, Model, NoiseStream, Settings, SetupError, State, Stepper,
};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_scenes::baking::SceneBakeError;

use crate::error::ReportError;

/// The homogeneous body of a shape, baked from about 1300 triangles.
pub(super) fn baked(
    shape: &Shape,
    density: f64,
    progress: &dyn Progress,
) -> Result<Body, ReportError> {
    let mesh = shape.mesh(1300).map_err(SceneBakeError::from)?;
    let spec = BodySpec {
        density: Some(density),
        ..BodySpec::default()
    };
    Ok(bake_body(&mesh, &spec, progress)
        .map_err(SceneBakeError::from)?
        .0)
}

/// The model with its default constants, with its turbulence or without.
pub(super) fn stepper(body: &Body, fluid: &Fluid, turbulent: bool) -> Result<Stepper, SetupError> {
    let mut settings = Settings {
        model: Model::Separated,
        ..Settings::default()
    };
    if !turbulent {
        settings.separated.turbulence_intensity = 0.0;
    }
    Stepper::new(body, fluid, None, &settings)
}

/// The states of a fall, one a step, until `ends` or so many steps; less where a step fails.
pub(super) fn fall(
    stepper: &Stepper,
    release: State,
    time_step: f64,
    steps: u32,
    noise: NoiseStream,
    ends: impl Fn(&State) -> bool,
) -> Vec<State> {
    let input = Input::from(noise);
    let mut states = vec![release];
    let mut state = release;
    for _ in 0..steps {
        if ends(&state) || stepper.step(&mut state, time_step, &input).is_err() {
            break;
        }
        states.push(state);
    }
    states
}

/// A turn by so many degrees about an axis of unit length.
pub(super) fn turned(axis: [f64; 3], degrees: f64) -> Quat {
    quat_from_rotation_vector(axis.map(|x| x * degrees.to_radians()))
}

/// The least turn after which the body's y axis points along `axis` (any length but zero).
pub(super) fn facing(axis: [f64; 3]) -> Quat {
    let [x, y, z] = axis;
    let across = libm::hypot(x, z);
    let angle = libm::atan2(across, y);
    if across == 0.0 {
        return turned([1.0, 0.0, 0.0], angle.to_degrees());
    }
    turned([z / across, 0.0, -x / across], angle.to_degrees())
}

/// Velocity between two states.
pub(super) fn between(a: &State, b: &State) -> [f64; 3] {
    std::array::from_fn(|i| (b.position[i] - a.position[i]) / (b.time - a.time))
}

pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values
        .into_iter()
        .fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
    sum / count
}

pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
