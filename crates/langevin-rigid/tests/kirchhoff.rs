//! Kirchhoff's equations without turbulence.
//!
//! A body in ideal fluid keeps its kinetic energy (body and fluid together), |p|, p.l, and in the
//! world frame its linear and angular impulse. Its planar motion is a pendulum in twice the angle: the
//! broadside position is stable, the one along the axis of least added mass is not. A sign error in a
//! cross term (the paper prints one) shows as an energy that drifts by tens of percent within a
//! second; a lost coupling block shows in the body without symmetry.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, distance, ellipsoid};
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid::{Body, Fluid, GRAVITY, Input, Integrator, Model, Settings, State, Stepper};

const WATER: Fluid = Fluid {
    density: 1000.0,
    viscosity: 1e-6,
    velocity: [0.0; 3],
};

fn settings(gravity: [f64; 3], integrator: Integrator) -> Settings {
    Settings {
        model: Model::Kirchhoff,
        integrator,
        gravity,
        ..Settings::default()
    }
}

fn stepper(body: &Body, fluid: &Fluid, gravity: [f64; 3], integrator: Integrator) -> Stepper {
    Stepper::new(body, fluid, None, &settings(gravity, integrator)).unwrap()
}

fn advance(stepper: &Stepper, state: &mut State, dt: f64, steps: usize) {
    for _ in 0..steps {
        stepper.step(state, dt, &Input::default()).unwrap();
    }
}

fn tumbling() -> State {
    State {
        position: [1.0, 2.0, -0.5],
        orientation: quat_from_rotation_vector([0.3, -0.8, 0.5]),
        velocity: [0.3, 0.2, -0.5],
        angular_velocity: [4.0, -7.0, 2.0],
        ..State::default()
    }
}

#[test]
fn energy_and_impulses_are_conserved_without_loads() {
    let stepper = stepper(&chiral(), &WATER, [0.0; 3], Integrator::Strang);
    let mut state = tumbling();
    let (energy, p, l) = (
        stepper.kinetic_energy(&state),
        stepper.linear_impulse(&state),
        stepper.angular_impulse(&state),
    );
    advance(&stepper, &mut state, 5e-4, 10_000);
    let drift = stepper.kinetic_energy(&state) / energy - 1.0;
    assert!(drift.abs() < 1e-8, "energy drifted by {drift}");
    assert!(distance(stepper.linear_impulse(&state), p) < 2e-13 * norm(p));
    assert!(distance(stepper.angular_impulse(&state), l) < 2e-13 * norm(l));
}

#[test]
fn the_energy_error_is_of_fourth_order() {
    let stepper = stepper(&chiral(), &WATER, [0.0; 3], Integrator::Strang);
    let error = |dt: f64| {
        let mut state = tumbling();
        let before = stepper.kinetic_energy(&state);
        advance(&stepper, &mut state, dt, (0.4 / dt).round() as usize);
        (stepper.kinetic_energy(&state) / before - 1.0).abs()
    };
    let order = (error(8e-3) / error(4e-3)).log2();
    assert!(order > 3.7, "order {order}");
}

#[test]
fn both_integrators_converge_to_the_same_motion() {
    let body = Body {
        centre_of_buoyancy: [0.002, 0.001, -0.003],
        ..chiral()
    };
    let end = |integrator, dt: f64| {
        let stepper = stepper(&body, &WATER, GRAVITY, integrator);
        let mut state = tumbling();
        advance(&stepper, &mut state, dt, (0.5 / dt).round() as usize);
        state
    };
    let reference = end(Integrator::Strang, 2.5e-4);
    let strang = end(Integrator::Strang, 2e-3);
    let rk4 = end(Integrator::RungeKutta4, 2e-3);
    assert!(distance(strang.position, reference.position) < 1e-6);
    assert!(distance(rk4.position, reference.position) < 1e-6);
    assert!(distance(rk4.angular_velocity, reference.angular_velocity) < 1e-3);
}

#[test]
fn weight_changes_the_world_impulse_exactly() {
    let body = ellipsoid([0.02, 0.03, 0.05], 1300.0);
    let stepper = stepper(&body, &WATER, GRAVITY, Integrator::Strang);
    let mut state = tumbling();
    let p = stepper.linear_impulse(&state);
    advance(&stepper, &mut state, 1e-3, 1000);
    let weight = body.mass - WATER.density * body.volume;
    let wanted = std::array::from_fn(|i| p[i] + weight * GRAVITY[i]);
    assert!(distance(stepper.linear_impulse(&state), wanted) < 1e-12 * norm(wanted));
}

/// Planar motion: with P the conserved impulse and th its angle to the first axis,
/// J th'' = -P^2/2 (1/M1 - 1/M2) sin 2 th for impulse along the world's x and th the body's turn.
#[test]
fn planar_motion_is_a_pendulum() {
    let body = ellipsoid([0.01, 0.02, 0.04], 1100.0);
    let total = body.total_mass(WATER.density);
    let (m1, m2, j) = (total[0][0], total[1][1], total[5][5]);
    let stepper = stepper(&body, &WATER, [0.0; 3], Integrator::Strang);
    let impulse = 0.02;
    let mut angle = 0.7f64;
    let mut spin = 0.5f64;
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, angle]),
        // p = R^T (P, 0, 0).
        velocity: [impulse * angle.cos() / m1, -impulse * angle.sin() / m2, 0.0],
        angular_velocity: [0.0, 0.0, spin],
        ..State::default()
    };
    let (dt, steps) = (1e-3, 800);
    advance(&stepper, &mut state, dt, steps);
    // Stoermer-Verlet on the pendulum, ten times finer.
    let torque = |a: f64| 0.5 * impulse * impulse * (1.0 / m1 - 1.0 / m2) * (2.0 * a).sin() / j;
    let fine = dt / 100.0;
    for _ in 0..steps * 100 {
        spin += 0.5 * fine * torque(angle);
        angle += fine * spin;
        spin += 0.5 * fine * torque(angle);
    }
    assert!(
        (state.angular_velocity[2] - spin).abs() < 1e-5,
        "{} {spin}",
        state.angular_velocity[2]
    );
    let x_axis = rotate(state.orientation, [1.0, 0.0, 0.0]);
    assert!((x_axis[0] - angle.cos()).abs() < 1e-5 && (x_axis[1] - angle.sin()).abs() < 1e-5);
}

#[test]
fn broadside_oscillates_at_the_known_frequency() {
    // Moving along y of a body whose largest added mass is along y.
    let body = ellipsoid([0.04, 0.01, 0.02], 1100.0);
    let total = body.total_mass(WATER.density);
    let (m1, m2, j) = (total[0][0], total[1][1], total[5][5]);
    let stepper = stepper(&body, &WATER, [0.0; 3], Integrator::Strang);
    let impulse = 0.05;
    let frequency = (impulse * impulse / j * (1.0 / m1 - 1.0 / m2)).sqrt();
    let mut state = State {
        velocity: [0.0, impulse / m2, 0.0],
        angular_velocity: [0.0, 0.0, 1e-3],
        ..State::default()
    };
    let dt = 1e-4;
    // From full spin one way to full spin the other way is half a period.
    let half = std::f64::consts::PI / frequency;
    advance(&stepper, &mut state, dt, (half / dt).round() as usize);
    assert!((state.angular_velocity[2] / -1e-3 - 1.0).abs() < 1e-3);
}

#[test]
fn the_axis_of_least_added_mass_is_unstable() {
    let body = ellipsoid([0.04, 0.01, 0.02], 1100.0);
    let stepper = stepper(&body, &WATER, [0.0; 3], Integrator::Strang);
    let mut state = State {
        velocity: [0.5, 0.0, 0.0],
        angular_velocity: [0.0, 0.0, 1e-4],
        ..State::default()
    };
    let mut turned = 0.0f64;
    for _ in 0..3000 {
        advance(&stepper, &mut state, 1e-3, 1);
        turned = turned.max(rotate(state.orientation, [1.0, 0.0, 0.0])[1].abs());
    }
    assert!(turned > 0.99, "turned to sin = {turned}");
}

#[test]
fn a_body_whose_buoyancy_acts_above_its_mass_is_stable() {
    let upright = |offset: f64| {
        let mut body = ellipsoid([0.03, 0.03, 0.03], 1000.0);
        body.centre_of_buoyancy = [0.0, offset, 0.0];
        let stepper = stepper(&body, &WATER, GRAVITY, Integrator::Strang);
        let mut state = State {
            orientation: quat_from_rotation_vector([0.05, 0.0, 0.0]),
            ..State::default()
        };
        let mut lowest = 1.0f64;
        for _ in 0..2000 {
            advance(&stepper, &mut state, 1e-3, 1);
            lowest = lowest.min(rotate(state.orientation, [0.0, 1.0, 0.0])[1]);
        }
        lowest
    };
    assert!(upright(0.005) > 0.998, "stable: {}", upright(0.005));
    assert!(upright(-0.005) < -0.9, "capsizes: {}", upright(-0.005));
}

#[test]
fn a_uniform_current_only_carries_the_motion() {
    let current = [0.4, -0.1, 0.2];
    let body = chiral();
    let still = stepper(&body, &WATER, GRAVITY, Integrator::Strang);
    let flowing = stepper(
        &body,
        &Fluid {
            velocity: current,
            ..WATER
        },
        GRAVITY,
        Integrator::Strang,
    );
    let mut a = tumbling();
    let mut b = tumbling();
    let v = b.world_velocity();
    b.set_world_velocities(
        std::array::from_fn(|i| v[i] + current[i]),
        b.world_angular_velocity(),
    );
    advance(&still, &mut a, 1e-3, 1000);
    advance(&flowing, &mut b, 1e-3, 1000);
    let carried = std::array::from_fn(|i| a.position[i] + current[i] * 1.0);
    assert!(distance(b.position, carried) < 1e-9);
    assert!((still.kinetic_energy(&a) / flowing.kinetic_energy(&b) - 1.0).abs() < 1e-9);
}

#[test]
fn large_steps_stay_on_the_rotation_group() {
    let stepper = stepper(&chiral(), &WATER, [0.0; 3], Integrator::Strang);
    let mut state = tumbling();
    advance(&stepper, &mut state, 1.0 / 60.0, 600);
    let length: f64 = state.orientation.iter().map(|x| x * x).sum();
    assert!((length - 1.0).abs() < 1e-15);
}
