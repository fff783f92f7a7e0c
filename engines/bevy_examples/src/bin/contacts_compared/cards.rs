//! The cards, how they are let go, and how they fall where there is no ground.

use bevy_langevin_rigid::langevin_rigid::linalg::{Quat, rotate_back};
use bevy_langevin_rigid::langevin_rigid::{
    Body, BodyError, Fluid, Input, NoiseStream, Settings, State, StepError, Stepper,
};
pub(crate) use contact_tests::SIZE;

/// The fixed step of Bevy (s).
pub(crate) const DT: f64 = 1.0 / 64.0;
/// Of cards and ground; nothing bounces.
pub(crate) const FRICTION: f64 = 0.5;

/// The states of a card: at the begin, and after each step.
pub(crate) type Way = Vec<State>;

/// The body itself.
pub(crate) fn body() -> Result<Body, BodyError> {
    Body::cuboid(SIZE, contact_tests::DENSITY)
}

/// What cards share: the defaults of the Bevy plugin.
pub(crate) fn stepper() -> Result<Stepper, Box<dyn std::error::Error>> {
    Ok(Stepper::new(
        &body()?,
        &Fluid::AIR,
        None,
        &Settings::default(),
    )?)
}

/// The turbulence of a card.
pub(crate) fn input(number: usize) -> Input {
    let body = number as u32;
    Input::from(NoiseStream { seed: 0, body })
}

/// Heights of their centres (m) and orientations: those of the two hundred cards of the adapters' tests.
pub(crate) fn releases() -> impl Iterator<Item = (f64, Quat)> {
    contact_tests::releases().map(|pose| (pose.position[1], pose.orientation))
}

/// The ways of cards that meet nothing.
pub(crate) fn free_ways(
    card: &Stepper,
    starts: &[State],
    dt: f64,
    steps: usize,
) -> Result<Vec<Way>, StepError> {
    let free_way = |(number, start): (usize, &State)| {
        let mut way = vec![*start];
        for step in 0..steps {
            let mut state = way[step];
            card.step(&mut state, dt, &input(number))?;
            way.push(state);
        }
        Ok(way)
    };
    starts.iter().enumerate().map(free_way).collect()
}

/// How far up the upper face of a card looks: one where it lies face up, minus one face down.
pub(crate) fn upward(state: &State) -> f64 {
    up(state)[1]
}

/// Height of the lowest corner of a card (m).
pub(crate) fn lowest(state: &State) -> f64 {
    let up = up(state);
    let reach: f64 = (0..3).map(|axis| 0.5 * SIZE[axis] * up[axis].abs()).sum();
    state.position[1] - reach
}

/// The vertical, body frame.
fn up(state: &State) -> [f64; 3] {
    rotate_back(state.orientation, [0.0, 1.0, 0.0])
}
