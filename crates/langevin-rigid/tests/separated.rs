//! Separated flow: discs and strips that fall steadily, flutter, tumble, or cannot decide.
//!
//! The bodies have their tensors in closed form, so what is tested is the closure alone. Light discs
//! and strips flutter, heavy ones tumble (Field et al. 1997, Belmonte et al. 1998, Smith 1970); a
//! closure whose rotational damping is too large makes heavy plates fall steadily, one without
//! dynamic stall never tumbles light ones.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::norm;
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid::{
    Body, Fluid, Model, NoiseStream, SeparatedFlow, Separation, Settings, State, Stepper, Surface,
};

const G: f64 = 9.81;

/// A flat body in a fluid of density 1, thin along y; lengths in units of about one.
struct Plate {
    body: Body,
    /// Width that speeds and times are counted in.
    width: f64,
}

fn diagonal(d: [f64; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

/// A disc of diameter 1 and thickness `h` with I* = I / (rho d^5).
fn disc(inertia_ratio: f64, h: f64) -> Plate {
    let r = 0.5;
    let volume = std::f64::consts::PI * r * r * h;
    let per_mass = r * r / 4.0 + h * h / 12.0;
    let mass = inertia_ratio / per_mass;
    let (broadside, turning) = (8.0 / 3.0 * r * r * r, 16.0 / 45.0 * r.powi(5));
    let edge = std::f64::consts::PI * h * h / 4.0 * 2.0 * r * 0.5;
    let mut added_mass = [[0.0; 6]; 6];
    for (i, a) in [edge, broadside, edge, turning, 0.0, turning]
        .into_iter()
        .enumerate()
    {
        added_mass[i][i] = a;
    }
    let face = std::f64::consts::PI * r * r;
    Plate {
        body: Body {
            mass,
            inertia: diagonal([mass * per_mass, mass * r * r / 2.0, mass * per_mass]),
            volume,
            centre_of_buoyancy: [0.0; 3],
            added_mass,
            half_extents: [r, r, h / 2.0],
            thickness: h,
            length: 2.0 * r,
            separation: Separation {
                drag_area: diagonal([1.2 * 2.0 * r * h, 1.12 * face, 1.2 * 2.0 * r * h]),
                extents: diagonal([r * r, h * h / 4.0, r * r]),
                stokes_translation: diagonal([32.0 / 3.0 * r, 16.0 * r, 32.0 / 3.0 * r]),
                stokes_rotation: diagonal([32.0 / 3.0 * r.powi(3); 3]),
            },
            parts: vec![],
            surface: Surface::default(),
        },
        width: 1.0,
    }
}

/// A strip of chord 1 and relative thickness `h`, as good as infinitely long along z, with
/// I* = rho_s h / rho_f.
fn strip(inertia_ratio: f64, h: f64) -> Plate {
    let (a, b, span) = (0.5, 0.5 * h, 1000.0);
    let volume = 4.0 * a * b * span;
    let mass = inertia_ratio / h * volume;
    let pi = std::f64::consts::PI;
    let added = [
        pi * b * b * span,
        pi * a * a * span,
        0.01 * span,
        span.powi(3),
        span.powi(3),
        pi / 8.0 * (a * a - b * b).powi(2) * span,
    ];
    let mut added_mass = [[0.0; 6]; 6];
    for (i, m) in added.into_iter().enumerate() {
        added_mass[i][i] = m;
    }
    let about_span = mass * (a * a + b * b) / 3.0;
    let long = mass * span * span / 12.0;
    Plate {
        body: Body {
            mass,
            inertia: diagonal([long, long, about_span]),
            volume,
            centre_of_buoyancy: [0.0; 3],
            added_mass,
            half_extents: [span / 2.0, a, b],
            thickness: h,
            length: 2.0 * a,
            separation: Separation {
                drag_area: diagonal([1.2 * 2.0 * b * span, 1.95 * 2.0 * a * span, 0.0]),
                extents: diagonal([a * a, b * b, span * span / 4.0]),
                ..Separation::default()
            },
            parts: vec![],
            surface: Surface::default(),
        },
        width: 1.0,
    }
}

/// One fall: the thin axis' turn about z from level, unwrapped, and the velocity, sampled.
struct Fall {
    turn: Vec<f64>,
    spin: Vec<f64>,
    velocity: Vec<[f64; 3]>,
}

fn fall(plate: &Plate, viscosity: f64, tilt: f64, constants: SeparatedFlow) -> Fall {
    let fluid = Fluid {
        density: 1.0,
        viscosity,
        velocity: [0.0; 3],
    };
    let settings = Settings {
        model: Model::Separated,
        separated: SeparatedFlow {
            turbulence_intensity: 0.0,
            ..constants
        },
        ..Settings::default()
    };
    let stepper = Stepper::new(&plate.body, &fluid, None, &settings).unwrap();
    let drag = plate.body.separation.drag_area[1][1];
    let weight = (plate.body.mass - plate.body.volume) * G;
    let speed = (2.0 * weight / drag).sqrt();
    let dt = 0.02 * plate.width / speed;
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, tilt.to_radians()]),
        ..State::default()
    };
    let mut fall = Fall {
        turn: vec![],
        spin: vec![],
        velocity: vec![],
    };
    let mut turn = tilt.to_radians();
    for _ in 0..20_000 {
        stepper
            .step(&mut state, dt, &NoiseStream::default())
            .unwrap();
        turn += state.angular_velocity[2] * dt;
        fall.turn.push(turn);
        fall.spin.push(state.angular_velocity[2]);
        fall.velocity.push(state.world_velocity());
    }
    fall
}

/// S steady, F flutter, T tumble, C both in turn; from the second half of the fall.
fn regime(fall: &Fall) -> char {
    let half = fall.turn.len() / 2;
    let turn = &fall.turn[half..];
    let low = turn.iter().copied().fold(f64::INFINITY, f64::min);
    let high = turn.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let pi = std::f64::consts::PI;
    let reversals = fall.spin[half..]
        .windows(2)
        .filter(|w| w[0] * w[1] < 0.0)
        .count();
    match high - low {
        swing if swing < 0.1 => 'S',
        swing if swing < pi => 'F',
        swing if swing > 4.0 * pi && reversals <= 2 => 'T',
        _ => 'C',
    }
}

fn regimes(plate: &Plate, tilts: &[f64]) -> String {
    tilts
        .iter()
        .map(|t| regime(&fall(plate, 1e-9, *t, SeparatedFlow::default())))
        .collect()
}

#[test]
fn light_strips_flutter_and_heavy_ones_tumble() {
    // Wanted boundary at I* 0.2 to 0.4; a band of mixed motion above it.
    for h in [0.02, 0.07] {
        for inertia in [0.1, 0.2] {
            assert_eq!(
                regimes(&strip(inertia, h), &[5.0, 40.0]),
                "FF",
                "h {h}, I* {inertia}"
            );
        }
        for inertia in [0.35, 0.4, 1.0, 2.5, 20.0] {
            assert_eq!(
                regimes(&strip(inertia, h), &[5.0, 40.0]),
                "TT",
                "h {h}, I* {inertia}"
            );
        }
    }
}

#[test]
fn light_discs_flutter_and_heavy_ones_tumble() {
    // Field et al. (1997): flutter below about 0.01, chaos to about 0.04, tumbling above.
    for inertia in [0.002, 0.004, 0.006] {
        assert_eq!(
            regimes(&disc(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "FFF",
            "I* {inertia}"
        );
    }
    for inertia in [0.013, 0.017, 0.022] {
        assert_eq!(
            regimes(&disc(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "CCC",
            "I* {inertia}"
        );
    }
    for inertia in [0.045, 0.06, 0.1, 0.3] {
        assert_eq!(
            regimes(&disc(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "TTT",
            "I* {inertia}"
        );
    }
}

#[test]
fn at_low_reynolds_number_small_disturbances_die_out() {
    // Steady below Re of about 100: here 30, on the diameter.
    for inertia in [0.004, 0.03] {
        let plate = disc(inertia, 0.015);
        let weight = (plate.body.mass - plate.body.volume) * G;
        let speed = (2.0 * weight / plate.body.separation.drag_area[1][1]).sqrt();
        let end = fall(&plate, speed / 30.0, 3.0, SeparatedFlow::default());
        assert_eq!(regime(&end), 'S', "I* {inertia}");
    }
}

#[test]
fn heavy_strips_tumble_as_fast_and_glide_as_steeply_as_measured() {
    // Smith (1970), strips in a wind tunnel: tip speed 1.1 of the flight speed, C_L 2.2 and C_D 1.6,
    // which is a glide at 36 degrees.
    let fall = fall(&strip(5.0, 0.02), 1e-9, 40.0, SeparatedFlow::default());
    let half = fall.turn.len() / 2;
    let mean = |f: &dyn Fn(usize) -> f64| {
        (half..fall.turn.len()).map(f).sum::<f64>() / (fall.turn.len() - half) as f64
    };
    let across = mean(&|n| fall.velocity[n][0]);
    let down = -mean(&|n| fall.velocity[n][1]);
    let tip = 0.5 * mean(&|n| fall.spin[n]).abs() / norm([across, down, 0.0]);
    let glide = down.atan2(across.abs()).to_degrees();
    assert!((tip / 1.1 - 1.0).abs() < 0.25, "tip speed {tip}");
    assert!((glide / 36.0 - 1.0).abs() < 0.25, "glide {glide} degrees");
}

#[test]
fn without_weight_energy_never_grows() {
    let fluid = Fluid {
        density: 1.0,
        viscosity: 1e-6,
        velocity: [0.0; 3],
    };
    let settings = Settings {
        model: Model::Separated,
        gravity: [0.0; 3],
        separated: SeparatedFlow {
            turbulence_intensity: 0.0,
            ..SeparatedFlow::default()
        },
        ..Settings::default()
    };
    let stepper = Stepper::new(&disc(0.01, 0.05).body, &fluid, None, &settings).unwrap();
    for seed in 0..50 {
        let z = NoiseStream { seed, body: 0 }.normals(0);
        let mut state = State {
            velocity: [z[0], z[1], z[2]],
            angular_velocity: [3.0 * z[3], 3.0 * z[4], 3.0 * z[5]],
            ..State::default()
        };
        let mut before = stepper.kinetic_energy(&state);
        for _ in 0..400 {
            stepper
                .step(&mut state, 2e-3, &NoiseStream::default())
                .unwrap();
            let after = stepper.kinetic_energy(&state);
            assert!(
                after <= before * (1.0 + 1e-6),
                "seed {seed}: {before} -> {after}"
            );
            before = after;
        }
    }
}

#[test]
fn a_long_body_released_along_its_axis_turns_broadside() {
    let mut body = common::ellipsoid([0.04, 0.01, 0.01], 2000.0);
    let pi = std::f64::consts::PI;
    body.separation = Separation {
        drag_area: diagonal([0.1 * pi * 1e-4, 0.7 * pi * 4e-4, 0.7 * pi * 4e-4]),
        extents: diagonal([16e-4, 1e-4, 1e-4]),
        ..Separation::default()
    };
    let settings = Settings {
        model: Model::Separated,
        ..Settings::default()
    };
    let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap();
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, 85f64.to_radians()]),
        ..State::default()
    };
    for _ in 0..5000 {
        stepper
            .step(&mut state, 1e-3, &NoiseStream::default())
            .unwrap();
    }
    let axis = rotate(state.orientation, [1.0, 0.0, 0.0]);
    assert!(
        axis[1].abs() < 0.5,
        "the axis still points along the fall: {axis:?}"
    );
}

#[test]
fn a_body_without_extents_is_refused() {
    let mut plate = disc(0.01, 0.05);
    plate.body.separation = Separation::default();
    let settings = Settings {
        model: Model::Separated,
        ..Settings::default()
    };
    let error = Stepper::new(&plate.body, &Fluid::WATER, None, &settings).unwrap_err();
    assert!(error.to_string().contains("bake"), "{error}");
}
