//! What carries and what turns a strip of paper while it swings there and back.

use langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Long along z, so that it swings in the plane of x and y; let go at 30 degrees.
    let strip = Body::plate(0.08, 0.4, 0.1e-3, 800.0)?;
    let stepper = Stepper::new(&strip, &Fluid::AIR, None, &Settings::default())?;
    let still = Input::default();
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, 30_f64.to_radians()]),
        ..State::default()
    };

    println!("                        force upwards, weights       torque about z, mN m");
    println!(" time  tilt  aside   down |  drag normal  lift | added mass   lost damping   all");
    println!("    s   deg    m/s    m/s |                    |");
    for step in 0..=36 {
        if step % 2 == 0 {
            let loads = stepper.loads(&state, &still);
            let upwards = [loads.drag, loads.normal_force, loads.rotational_lift]
                .map(|load| -load.force[1] / loads.weight.force[1]);
            let turning = [
                loads.added_mass,
                loads.lost_couple,
                loads.damping,
                loads.sum(),
            ]
            .map(|load| 1e3 * load.torque[2]);
            let along = rotate(state.orientation, [1.0, 0.0, 0.0]);
            let [aside, up, _] = state.world_velocity();
            println!(
                "{:5.2} {:5.0} {aside:6.2} {:6.2} | {:5.2} {:6.2} {:5.2} | {:10.2} {:6.2} {:7.2} {:5.2}",
                state.time,
                along[1].atan2(along[0]).to_degrees(),
                0.0 - up,
                upwards[0],
                upwards[1],
                upwards[2],
                turning[0],
                turning[1],
                turning[2],
                turning[3],
            );
        }
        stepper.step(&mut state, 0.01, &still)?;
    }
    Ok(())
}
