//! Separated flow: discs and strips that fall steadily, flutter, tumble, or cannot decide.
//!
//! The bodies have their tensors in closed form, so what is tested is the closure alone. Light discs
//! and strips flutter, heavy ones tumble (Field et al. 1997, Belmonte et al. 1998, Smith 1970); a
//! closure whose rotational damping is too large makes heavy plates fall steadily, one without
//! dynamic stall never tumbles light ones.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::{Body, Input, State};
use langevin_rigid_scenes::regimes::{Plate, broadside_speed, stepper};

/// One fall: the thin axis' turn about z from level, unwrapped, and the velocity, sampled.
struct Fall {
    turn: Vec<f64>,
    spin: Vec<f64>,
    velocity: Vec<[f64; 3]>,
}

fn fall(body: &Body, viscosity: f64, tilt: f64) -> Fall {
    let stepper = stepper(body, viscosity).unwrap();
    let dt = 0.02 / broadside_speed(body, f64::INFINITY);
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
        stepper.step(&mut state, dt, &Input::default()).unwrap();
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

fn regimes(body: &Body, tilts: &[f64]) -> String {
    tilts
        .iter()
        .map(|t| regime(&fall(body, 1e-9, *t)))
        .collect()
}

#[test]
fn light_strips_flutter_and_heavy_ones_tumble() {
    // Measured boundary at I* 0.45. Here thin strips swing over from 0.2 on, and 0.4 to 0.7 is a band of mixed motion.
    let of = |inertia: f64, h: f64| regimes(&Plate::Strip.body(inertia, h), &[5.0, 40.0]);
    for (inertia, h) in [(0.1, 0.02), (0.1, 0.07), (0.2, 0.07)] {
        assert_eq!(of(inertia, h), "FF", "h {h}, I* {inertia}");
    }
    for h in [0.02, 0.07] {
        for inertia in [0.35, 1.0, 2.5, 20.0] {
            assert_eq!(of(inertia, h), "TT", "h {h}, I* {inertia}");
        }
    }
}

#[test]
fn light_discs_flutter_and_heavy_ones_tumble() {
    // Field et al. (1997): flutter below about 0.01, chaos to about 0.04, tumbling above.
    for inertia in [0.002, 0.004, 0.006] {
        assert_eq!(
            regimes(&Plate::Disc.body(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "FFF",
            "I* {inertia}"
        );
    }
    for inertia in [0.013, 0.017, 0.022] {
        assert_eq!(
            regimes(&Plate::Disc.body(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "CCC",
            "I* {inertia}"
        );
    }
    for inertia in [0.045, 0.06, 0.1, 0.3] {
        assert_eq!(
            regimes(&Plate::Disc.body(inertia, 0.015), &[5.0, 15.0, 40.0]),
            "TTT",
            "I* {inertia}"
        );
    }
}

#[test]
fn at_low_reynolds_number_small_disturbances_die_out() {
    // Steady below Re of about 100: here 30, on the diameter.
    for inertia in [0.004, 0.03] {
        let disc = Plate::Disc.body(inertia, 0.015);
        let viscosity = broadside_speed(&disc, 30.0) / 30.0;
        let end = fall(&disc, viscosity, 3.0);
        assert_eq!(regime(&end), 'S', "I* {inertia}");
    }
}

#[test]
fn heavy_strips_tumble_as_fast_and_glide_as_steeply_as_measured() {
    // Smith (1970), strips in a wind tunnel: tip speed 1.1 of the flight speed, C_L 2.2 and C_D 1.6,
    // which is a glide at 36 degrees.
    let fall = fall(&Plate::Strip.body(5.0, 0.02), 1e-9, 40.0);
    let half = fall.turn.len() / 2;
    let mean = |f: &dyn Fn(usize) -> f64| {
        (half..fall.turn.len()).map(f).sum::<f64>() / (fall.turn.len() - half) as f64
    };
    let across = mean(&|n| fall.velocity[n][0]);
    let down = -mean(&|n| fall.velocity[n][1]);
    let tip = 0.5 * mean(&|n| fall.spin[n]).abs() / across.hypot(down);
    let glide = down.atan2(across.abs()).to_degrees();
    assert!((tip / 1.1 - 1.0).abs() < 0.1, "tip speed {tip}");
    assert!((glide / 36.0 - 1.0).abs() < 0.25, "glide {glide} degrees");
}
