use std::f64::consts::{PI, TAU};

use langevin_rigid::linalg::vector::norm;
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate, rotate_back};
use langevin_rigid::{
    Body, Fluid, Input, Model, NoiseStream, Settings, State, Stepper, TurbulenceSource,
};
use langevin_rigid_bake::shapes::Shape;

use super::hull::with_mesh;
use crate::water::{Immersion, ImmersionError, Plane, Submerged, WaterSurface};

const G: f64 = 9.81;

fn settings(model: Model) -> Settings {
    Settings {
        model,
        ..Settings::default()
    }
}

fn immersion(body: &Body, model: Model) -> Immersion {
    let (air, water) = ((&Fluid::AIR, None), (&Fluid::WATER, None));
    Immersion::new(body, air, water, &settings(model)).unwrap()
}

fn calm() -> WaterSurface {
    WaterSurface::calm(0.0).unwrap()
}

/// What of the body is below the still surface at y = 0, world frame.
fn below(immersion: &Immersion, state: &State) -> Submerged {
    let up = [0.0, 1.0, 0.0];
    let below = immersion.hull().below(&Plane {
        normal: rotate_back(state.orientation, up),
        offset: -state.position[1],
    });
    Submerged {
        centroid: rotate(state.orientation, below.centroid),
        ..below
    }
}

/// Kinetic energy of body and moved fluid, and what gravity and pressure of both fluids can give (J).
fn energy(immersion: &Immersion, body: &Body, state: &State) -> f64 {
    let xi = [state.velocity, state.angular_velocity];
    let xi = xi.as_flattened();
    let below = below(immersion, state);
    let total = immersion.total_mass(below.volume / body.volume);
    let mut kinetic = 0.0;
    for i in 0..6 {
        for j in 0..6 {
            kinetic += 0.5 * xi[i] * total[i][j] * xi[j];
        }
    }
    let y = state.position[1];
    let whole = body.volume * (y + rotate(state.orientation, body.centre_of_buoyancy)[1]);
    let wet = below.volume * (y + below.centroid[1]);
    let pressure = -Fluid::WATER.density * wet - Fluid::AIR.density * (whole - wet);
    kinetic + G * (body.mass * y + pressure)
}

#[test]
fn drops_gain_no_energy_probe() {
    let bodies = [
        Body::ellipsoid([0.05, 0.02, 0.03], 500.0).unwrap(),
        Body::sphere(0.03, 30.0).unwrap(),
        Body::plate(0.1, 0.06, 0.004, 700.0).unwrap(),
        Body::cuboid([0.1, 0.1, 0.1], 300.0).unwrap(),
        Body::cylinder(0.01, 0.15, 900.0).unwrap(),
        Body::disc(0.05, 0.002, 1200.0).unwrap(),
        Body::cuboid([0.1, 0.05, 0.1], 10.0).unwrap(),
    ];
    let water = calm();
    for (number, body) in bodies.iter().enumerate() {
        let immersion = immersion(body, Model::Kirchhoff);
        for dt in [5e-4, 2e-3, 8e-3, 1.0 / 30.0] {
            let mut line = String::new();
            for fall in 0..6u32 {
                let dice = NoiseStream {
                    seed: 5,
                    body: fall,
                };
                let z = dice.normals(number as u64);
                let mut state = State {
                    position: [0.0, 0.15, 0.0],
                    orientation: quat_from_rotation_vector([z[0], z[1], z[2]]),
                    ..State::default()
                };
                state.set_world_velocities(
                    [0.5 * z[3], -1.0 + z[4], 0.5 * z[5]],
                    [3.0 * z[6], 3.0 * z[7], 3.0 * z[8]],
                );
                let start = energy(&immersion, body, &state);
                let scale = body.mass * G * 0.15 + start - G * body.mass * 0.15;
                let (mut least, mut gained, mut most) = (start, 0f64, 0f64);
                while state.time < 10.0 {
                    immersion
                        .step(&mut state, dt, &Input::default(), &water)
                        .unwrap();
                    let now = energy(&immersion, body, &state);
                    gained = gained.max(now - least);
                    least = least.min(now);
                    most = most.max((now - start) / scale);
                }
                let end = (energy(&immersion, body, &state) - start) / scale;
                line += &format!(" {:.1e}/{most:.1e}({end:.2})", gained / scale);
            }
            println!("{number} {dt:.4}: {line}");
        }
    }
}
