//! A dry leaf falls two metres through still air and prints where it is, ten times a second.

use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 8 cm by 5 cm, 0.2 mm thick, 450 kg/m^3.
    let leaf = Body::plate(0.08, 0.05, 0.2e-3, 450.0)?;
    let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &Settings::default())?;
    let mut state = State::default();
    state.position[1] = 2.0;
    let noise = NoiseStream { seed: 1, body: 0 };
    while state.position[1] > 0.0 {
        stepper.step(&mut state, 1.0 / 60.0, &noise.into())?;
        if state.step.is_multiple_of(6) {
            println!("{:.1} s: {:.2?} m", state.time, state.position);
        }
    }
    Ok(())
}
