//! A balloon in wind that comes in gusts and grows with height.
//!
//! A wind that changes in time says so by its acceleration. The last column is the same balloon where it is left out.

use std::f64::consts::TAU;

use langevin_rigid::{Body, Flow, Fluid, Input, Settings, State, Stepper};

/// Growth of the wind with height (1/s).
const SHEAR: f64 = 0.5;
/// Amplitude (m/s) and period (s) of the gusts.
const GUST: f64 = 1.5;
const PERIOD: f64 = 4.0;

/// The wind at a height (m) and a time (s): along x, (2 + SHEAR y + GUST sin) m/s.
fn wind(height: f64, time: f64) -> Flow {
    let (sine, cosine) = (TAU * time / PERIOD).sin_cos();
    let mut flow = Flow::uniform([2.0 + SHEAR * height + GUST * sine, 0.0, 0.0]);
    // Row: the wind's component; column: the direction in which it grows.
    flow.gradient[0][1] = SHEAR;
    // Du/Dt is du/dt here: the wind carries nothing to where it is faster.
    flow.acceleration[0] = GUST * TAU / PERIOD * cosine;
    flow
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 28 cm wide; rubber and helium, a little heavier than the air that they displace.
    let balloon = Body::sphere(0.14, 1.25)?;
    let stepper = Stepper::new(&balloon, &Fluid::AIR, None, &Settings::default())?;
    let mut state = State::default();
    state.position[1] = 3.0;
    state.velocity[0] = wind(3.0, 0.0).velocity[0];
    let mut untold = state;

    println!(" time  height    wind  balloon  without acceleration");
    println!("    s       m     m/s      m/s                   m/s");
    let dt = 1.0 / 60.0;
    for step in 0..=360 {
        let flow = wind(state.position[1], state.time);
        if step % 20 == 0 {
            let [speed, speed_untold] = [state, untold].map(|s| s.world_velocity()[0]);
            println!(
                "{:5.2} {:7.2} {:7.2} {speed:8.2} {speed_untold:21.2}",
                state.time, state.position[1], flow.velocity[0],
            );
        }
        let input = Input {
            flow,
            ..Input::default()
        };
        stepper.step(&mut state, dt, &input)?;

        let mut input = Input {
            flow: wind(untold.position[1], untold.time),
            ..Input::default()
        };
        input.flow.acceleration = [0.0; 3];
        stepper.step(&mut untold, dt, &input)?;
    }
    Ok(())
}
