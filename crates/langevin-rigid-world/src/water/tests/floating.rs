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

/// Lets go of a body and waits until it lies still (s at most).
fn come_to_rest(immersion: &Immersion, mut state: State, seconds: f64) -> State {
    let water = calm();
    while state.time < seconds {
        immersion
            .step(&mut state, 4e-3, &Input::default(), &water)
            .unwrap();
    }
    let (speed, spin) = (norm(state.velocity), norm(state.angular_velocity));
    // Roll and drift have quadratic resistance alone and end slowly.
    assert!(speed < 2e-3 && spin < 0.05, "{speed} m/s, {spin} rad/s");
    state
}

/// Times at which a value goes through zero upwards.
fn period(mut value: impl FnMut() -> f64, dt: f64, seconds: f64) -> f64 {
    let (mut first, mut last, mut count) = (None, 0.0, -1.0);
    let (mut before, mut time) = (value(), 0.0);
    while time < seconds {
        let now = value();
        if before < 0.0 && now >= 0.0 {
            last = time + dt * before / (before - now);
            first = first.or(Some(last));
            count += 1.0;
        }
        (before, time) = (now, time + dt);
    }
    (last - first.unwrap()) / count
}

/// Share of the volume in the water where a body floats: weight is buoyancy of both fluids.
fn floating_share(density: f64) -> f64 {
    let [air, water] = [Fluid::AIR.density, Fluid::WATER.density];
    (density - air) / (water - air)
}

#[test]
fn draughts_are_those_of_archimedes() {
    let release = State {
        position: [0.0, 0.02, 0.0],
        ..State::default()
    };
    let rests = |body: &Body| come_to_rest(&immersion(body, Model::Separated), release, 60.0);
    // A block: the draught is the share of its height.
    let block = Body::cuboid([0.3, 0.06, 0.2], 640.0).unwrap();
    let state = rests(&block);
    let draught = 0.03 - state.position[1];
    assert!((draught / (0.06 * floating_share(640.0)) - 1.0).abs() < 1e-4);
    // A ball: h^2 (3 r - h) / 4 r^3.
    let r = 0.05;
    let ball = with_mesh(
        Body::sphere(r, 300.0).unwrap(),
        Shape::Ellipsoid { semi_axes: [r; 3] },
        5120,
    );
    let h = (r - rests(&ball).position[1]) / r;
    let share = h * h * (3.0 - h) / 4.0;
    assert!(
        (share / floating_share(300.0) - 1.0).abs() < 1e-3,
        "{share}"
    );
    // A cylinder on its side.
    let cylinder = with_mesh(
        Body::cylinder(r, 0.4, 300.0).unwrap(),
        Shape::Cylinder {
            radius: r,
            height: 0.4,
        },
        6000,
    );
    let angle = libm::acos(rests(&cylinder).position[1] / r);
    let share = (angle - libm::sin(angle) * libm::cos(angle)) / PI;
    assert!(
        (share / floating_share(300.0) - 1.0).abs() < 2e-3,
        "{share}"
    );
}

/// A block: GM = KB + BM - KG with BM = I / V.
#[test]
fn a_small_heel_is_righted_by_the_metacentric_height() {
    let [a, b, c] = [0.4, 0.1, 0.3];
    let body = Body::cuboid([a, b, c], 600.0).unwrap();
    let immersion = immersion(&body, Model::Kirchhoff);
    let draught = b * floating_share(600.0);
    let (volume, angle) = (a * c * draught, 1e-3);
    for (axis, length, breadth) in [(2, c, a), (0, a, c)] {
        let metacentric =
            0.5 * draught + length * breadth * breadth * breadth / (12.0 * volume) - 0.5 * b;
        let mut heel = [0.0; 3];
        heel[axis] = angle;
        let state = State {
            position: [0.0, 0.5 * b - draught, 0.0],
            orientation: quat_from_rotation_vector(heel),
            ..State::default()
        };
        let arm = below(&immersion, &state).centroid;
        // The moment of an upward force at the centroid, about z and about x.
        let moment = if axis == 2 { arm[0] } else { -arm[2] };
        assert!((-moment / (metacentric * angle) - 1.0).abs() < 1e-4);
    }
}

#[test]
fn heave_and_roll_have_their_periods() {
    let [a, b, c] = [0.4, 0.1, 0.3];
    let body = Body::cuboid([a, b, c], 600.0).unwrap();
    let immersion = immersion(&body, Model::Kirchhoff);
    let share = floating_share(600.0);
    let draught = b * share;
    let mass = immersion.total_mass(share);
    let stiffness = G * (Fluid::WATER.density - Fluid::AIR.density);
    let afloat = State {
        position: [0.0, 0.5 * b - draught, 0.0],
        ..State::default()
    };
    let water = calm();
    let dt = 2e-3;
    let measured = |mut state: State, value: &dyn Fn(&State) -> f64| {
        let value = || {
            immersion
                .step(&mut state, dt, &Input::default(), &water)
                .unwrap();
            value(&state)
        };
        period(value, dt, 20.0)
    };
    let mut heaved = afloat;
    heaved.position[1] += 1e-4;
    let found = measured(heaved, &|state| state.position[1] - afloat.position[1]);
    let wanted = TAU * (mass[1][1] / (stiffness * a * c)).sqrt();
    assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    // About z.
    let mut heeled = afloat;
    heeled.orientation = quat_from_rotation_vector([0.0, 0.0, 2e-3]);
    let found = measured(heeled, &|state| state.orientation[2]);
    let volume = a * c * draught;
    let metacentric = 0.5 * draught + c * a * a * a / (12.0 * volume) - 0.5 * b;
    let wanted = TAU * (mass[5][5] / (stiffness * volume * metacentric)).sqrt();
    assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
}

/// A ball half in the water loses heave to its waves as a hemisphere does: a tenth of critical damping.
#[test]
fn heave_ends_as_by_the_waves_that_it_makes() {
    let r = 0.05;
    let body = Body::sphere(r, 0.5 * (Fluid::WATER.density + Fluid::AIR.density)).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let water = calm();
    let mass = immersion.total_mass(0.5)[1][1];
    let number = Fluid::WATER.density * PI * r * r / mass;
    assert!((number * r - 1.0).abs() < 0.01);
    let frequency = (G * number).sqrt();
    // Hulme's 0.2484 is what the fit has to a tenth.
    let displaced = 2.0 / 3.0 * PI * r * r * r * Fluid::WATER.density;
    let damping = 0.2484 * displaced * frequency;
    let mut state = State {
        position: [0.0, 2e-4, 0.0],
        ..State::default()
    };
    let mut peaks = Vec::new();
    let mut before = state.position[1];
    let mut rising = false;
    while state.time < 2.0 {
        immersion
            .step(&mut state, 1e-3, &Input::default(), &water)
            .unwrap();
        let y = state.position[1];
        if rising && y < before {
            peaks.push((state.time, before));
        }
        (rising, before) = (y > before, y);
    }
    let [(start, from), (end, to)] = [peaks[0], peaks[2]];
    let rate = 2.0 * libm::log(from / to) / (end - start);
    assert!(
        (rate / (damping / mass) - 1.0).abs() < 0.12,
        "{rate} {}",
        damping / mass
    );
}

#[test]
fn a_tall_block_lies_down() {
    let body = Body::cuboid([0.08, 0.3, 0.1], 500.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let upright = State {
        orientation: quat_from_rotation_vector([0.005, 0.0, 0.01]),
        ..State::default()
    };
    let state = come_to_rest(&immersion, upright, 120.0);
    let axis = |i: usize| {
        rotate(
            state.orientation,
            std::array::from_fn(|k| f64::from(k == i)),
        )[1]
    };
    // Along, or nearly: half in the water, one of nearly square section may float on an edge.
    assert!(axis(1).abs() < 0.02, "{:?}", [axis(0), axis(1), axis(2)]);
    assert!((immersion.share(&state, &calm()) - floating_share(500.0)).abs() < 1e-3);
}

#[test]
fn a_ball_let_go_under_water_comes_up_and_floats() {
    let r = 0.04;
    let body = Body::sphere(r, 200.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let water = calm();
    let mut state = State {
        position: [0.0, -0.6, 0.0],
        ..State::default()
    };
    let mut highest = f64::NEG_INFINITY;
    while state.time < 40.0 {
        immersion
            .step(&mut state, 5e-3, &Input::default(), &water)
            .unwrap();
        highest = highest.max(state.position[1]);
    }
    assert!(highest > r, "it leaps: {highest}");
    assert!((immersion.share(&state, &water) - floating_share(200.0)).abs() < 1e-3);
    // What its wake gave it to the side ends slowly.
    let [x, y, z] = state.world_velocity();
    assert!(y.abs() < 1e-4, "{y}");
    assert!(norm([x, 0.0, z]) < 0.02, "{x} {z}");
}

/// Without drag, bodies that fall through the surface at random lose energy to the water's entry and exit alone, however light
/// or heavy they are and however long the steps.
#[test]
fn no_fall_through_the_surface_gains_energy() {
    let bodies = [
        Body::ellipsoid([0.05, 0.02, 0.03], 500.0).unwrap(),
        Body::sphere(0.03, 30.0).unwrap(),
        Body::sphere(0.005, 3.0).unwrap(),
        Body::plate(0.1, 0.06, 0.004, 700.0).unwrap(),
        Body::plate(0.1, 0.06, 3e-4, 4.0).unwrap(),
        Body::cuboid([0.1; 3], 300.0).unwrap(),
        Body::cylinder(0.01, 0.15, 900.0).unwrap(),
        Body::disc(0.05, 0.002, 1200.0).unwrap(),
        Body::cuboid([0.1, 0.05, 0.1], 8000.0).unwrap(),
    ];
    let water = calm();
    for (number, body) in bodies.iter().enumerate() {
        let immersion = immersion(body, Model::Kirchhoff);
        for dt in [1e-3, 4e-3, 1.0 / 60.0, 0.5] {
            for fall in 0..3 {
                let stream = NoiseStream {
                    seed: 5,
                    body: fall,
                };
                let z = stream.normals(number as u64);
                let mut state = State {
                    position: [0.0, 0.15, 0.0],
                    orientation: quat_from_rotation_vector([z[0], z[1], z[2]]),
                    ..State::default()
                };
                let spin = [3.0 * z[6], 3.0 * z[7], 3.0 * z[8]];
                state.set_world_velocities([0.5 * z[3], z[4] - 1.0, 0.5 * z[5]], spin);
                let start = energy(&immersion, body, &state);
                let mut least = start;
                // Deep down the integrator of the water is at work alone.
                while state.time < 4.0 && state.position[1] > -0.5 {
                    immersion
                        .step(&mut state, dt, &Input::default(), &water)
                        .unwrap();
                    let now = energy(&immersion, body, &state);
                    // What a leapfrog's energy goes up and down by.
                    let gained = now - least;
                    assert!(
                        gained < 2e-5 * start,
                        "body {number}, fall {fall}, step {dt}: {gained} of {start} J at {} s",
                        state.time
                    );
                    least = least.min(now);
                }
            }
        }
    }
}

/// Neither rule for the added mass adds energy, whatever the motion and the shares.
#[test]
fn neither_entry_nor_exit_gains_energy() {
    let body = Body::cuboid([0.3, 0.02, 0.1], 90.0).unwrap();
    let body = body
        .with_mass_properties(body.mass, [0.03, 0.004, -0.01], body.inertia)
        .unwrap();
    let immersion = immersion(&body, Model::Kirchhoff);
    let form = |m: &langevin_rigid::linalg::Mat6, a: &[f64]| -> f64 {
        (0..6)
            .map(|i| (0..6).map(|j| a[i] * m[i][j] * a[j]).sum::<f64>())
            .sum()
    };
    for n in 0..50u64 {
        let z = NoiseStream::default().normals(n);
        let [less, more] = [
            0.02 * (n % 7) as f64,
            0.02 * (n % 7) as f64 + 0.01 * n as f64,
        ];
        let more = more.min(1.0);
        // Momenta stay as the mass grows; velocities stay as it falls.
        let (before, after) = (
            immersion.inverse_total_mass(less),
            immersion.inverse_total_mass(more),
        );
        assert!(form(&after, &z[..6]) <= form(&before, &z[..6]) * (1.0 + 1e-12));
        let (before, after) = (immersion.total_mass(more), immersion.total_mass(less));
        assert!(form(&after, &z[..6]) <= form(&before, &z[..6]) * (1.0 + 1e-12));
    }
}

/// A ball that hits the water fast has the speed of its momentum once it is under: von Karman.
#[test]
fn at_entry_the_momentum_stays() {
    let body = Body::sphere(0.05, 400.0).unwrap();
    let immersion = immersion(&body, Model::Kirchhoff);
    let water = calm();
    let fast = 40.0;
    let mut state = State {
        position: [0.0, 0.06, 0.0],
        velocity: [0.0, -fast, 0.0],
        ..State::default()
    };
    while immersion.share(&state, &water) < 1.0 {
        immersion
            .step(&mut state, 1e-4, &Input::default(), &water)
            .unwrap();
    }
    let [air, under] = [0.0, 1.0].map(|share| immersion.total_mass(share)[1][1]);
    let wanted = -fast * air / under;
    assert!((state.velocity[1] / wanted - 1.0).abs() < 1e-3);
}

/// Away from the surface the bits are those of the steppers in the fluids.
#[test]
fn far_from_the_surface_a_step_is_that_of_the_fluid() {
    let body = Body::disc(0.03, 0.002, 1300.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let noise = NoiseStream { seed: 3, body: 7 };
    let input = Input {
        wrench: langevin_rigid::Wrench {
            force: [0.0, 1e-3, 0.0],
            ..Default::default()
        },
        ..Input::with_noise(noise)
    };
    for (height, fluid) in [(20.0, Fluid::AIR), (-20.0, Fluid::WATER)] {
        let stepper = Stepper::new(&body, &fluid, None, &settings(Model::Separated)).unwrap();
        let mut state = State {
            position: [0.0, height, 0.0],
            orientation: quat_from_rotation_vector([0.3, 0.0, 0.1]),
            ..State::default()
        };
        let mut alone = state;
        for _ in 0..200 {
            immersion.step(&mut state, 5e-3, &input, &calm()).unwrap();
            stepper.step(&mut alone, 5e-3, &input).unwrap();
        }
        assert_eq!(state, alone);
    }
}

/// From any share to the next the step goes on without a jump.
#[test]
fn a_step_is_continuous_in_the_share() {
    let body = Body::cuboid([0.1, 0.05, 0.08], 100.0).unwrap();
    for model in [Model::Kirchhoff, Model::Separated, Model::Consistent] {
        let immersion = immersion(&body, model);
        let water = calm();
        let after = |height: f64| {
            let mut state = State {
                position: [0.0, height, 0.0],
                orientation: quat_from_rotation_vector([0.4, 0.1, 0.3]),
                velocity: [0.2, -0.4, 0.1],
                angular_velocity: [1.0, -2.0, 0.5],
                ..State::default()
            };
            immersion
                .step(&mut state, 1e-3, &Input::default(), &water)
                .unwrap();
            state
        };
        let fine = 1e-5;
        let mut before = after(0.08);
        let mut largest = 0f64;
        for n in 1..=16_000 {
            let state = after(0.08 - fine * f64::from(n));
            let jump: f64 = (0..3)
                .map(|i| {
                    (state.velocity[i] - before.velocity[i]).abs()
                        + 0.05 * (state.angular_velocity[i] - before.angular_velocity[i]).abs()
                })
                .sum();
            largest = largest.max(jump);
            before = state;
        }
        // Metres per second, over ten micrometres of height.
        assert!(largest < 1e-3, "{model}: {largest}");
    }
}

/// A flat float follows long waves: it goes up and down with the surface and lies along it.
#[test]
fn a_float_follows_long_waves() {
    let wave = crate::water::Wave {
        amplitude: 0.05,
        wavelength: 8.0,
        heading: [1.0, 0.0],
        phase: 0.0,
    };
    let water = WaterSurface::new(0.0, G, &[wave]).unwrap();
    let body = Body::cuboid([0.2, 0.04, 0.2], 500.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let mut state = State {
        position: [0.0, 0.05, 0.0],
        velocity: water.flow([0.0; 3], 0.0).velocity,
        ..State::default()
    };
    let mut apart = 0f64;
    while state.time < 30.0 {
        immersion
            .step(&mut state, 5e-3, &Input::default(), &water)
            .unwrap();
        if state.time > 20.0 {
            let [x, y, z] = state.position;
            apart = apart.max((y - water.height(x, z, state.time)).abs());
            let up = rotate(state.orientation, [0.0, 1.0, 0.0]);
            let normal = water.normal(x, z, state.time);
            apart = apart.max(0.1 * (up[0] - normal[0]).abs());
        }
    }
    assert!(apart < 2e-3, "{apart} m");
    // It is carried along the waves' heading.
    assert!(state.position[0] > 0.0, "{}", state.position[0]);
}

/// A current carries what floats.
#[test]
fn a_current_carries_what_floats() {
    let water = calm().with_current([0.3, -0.1]).unwrap();
    let body = Body::cuboid([0.1, 0.05, 0.1], 500.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let mut state = State::default();
    for _ in 0..20_000 {
        immersion
            .step(&mut state, 5e-3, &Input::default(), &water)
            .unwrap();
    }
    let [x, _, z] = state.world_velocity();
    assert!((x - 0.3).abs() < 0.01 && (z + 0.1).abs() < 0.01, "{x} {z}");
}

#[test]
fn what_cannot_be_stepped_between_fluids_is_refused() {
    let body = Body::cuboid([0.1; 3], 500.0).unwrap();
    let new = |body: &Body, air: Fluid, water: Fluid, settings: &Settings| {
        Immersion::new(body, (&air, None), (&water, None), settings).unwrap_err()
    };
    let usual = Settings::default();
    let sideways = Settings {
        gravity: [1.0, -9.81, 0.0],
        ..usual
    };
    let error = new(&body, Fluid::AIR, Fluid::WATER, &sideways);
    assert!(matches!(error, ImmersionError::Gravity(_)));
    let error = new(&body, Fluid::WATER, Fluid::AIR, &usual);
    assert!(matches!(error, ImmersionError::Densities { .. }));
    let flowing = Fluid {
        velocity: [1.0, 0.0, 0.0],
        ..Fluid::WATER
    };
    let error = new(&body, Fluid::AIR, flowing, &usual);
    assert!(matches!(error, ImmersionError::Current(_)));
    let history = Settings {
        turbulence: TurbulenceSource::History,
        ..usual
    };
    let error = new(&body, Fluid::AIR, Fluid::WATER, &history);
    assert!(matches!(error, ImmersionError::Setup(_)));
    let turbulence = langevin_rigid::TurbulenceHistory {
        interval: 0.1,
        inflow_speed: 0.5,
        length: 0.1,
        k: vec![0.1, 0.05],
        epsilon: vec![0.2, 0.1],
    };
    let both = |air, water| {
        let (air, water) = ((&Fluid::AIR, air), (&Fluid::WATER, water));
        Immersion::new(&body, air, water, &history)
    };
    assert!(both(Some(&turbulence), Some(&turbulence)).is_ok());
    assert!(both(Some(&turbulence), None).is_err());
    let mut bare = body.clone();
    bare.surface = Default::default();
    let error = new(&bare, Fluid::AIR, Fluid::WATER, &usual);
    assert!(matches!(error, ImmersionError::Hull(_)));
    // An impossible step leaves the state as it was.
    let immersion = immersion(&body, Model::Separated);
    let mut state = State::default();
    for dt in [-1.0, f64::NAN] {
        assert!(
            immersion
                .step(&mut state, dt, &Input::default(), &calm())
                .is_err()
        );
    }
    assert_eq!(state, State::default());
}

/// One fall into a sea has these bits on every platform.
#[test]
fn a_fall_into_a_sea_has_the_same_bits_everywhere() {
    let sea = crate::water::Sea {
        seed: 4,
        ..Default::default()
    };
    let water = WaterSurface::sea(0.2, G, &sea).unwrap();
    let body = Body::ellipsoid([0.1, 0.03, 0.06], 450.0).unwrap();
    let immersion = immersion(&body, Model::Separated);
    let mut state = State {
        position: [0.0, 0.8, 0.0],
        orientation: quat_from_rotation_vector([0.5, 0.2, 0.7]),
        ..State::default()
    };
    // FNV-1a.
    let mut hash = 0xCBF2_9CE4_8422_2325u64;
    for _ in 0..1000 {
        immersion
            .step(&mut state, 5e-3, &Input::default(), &water)
            .unwrap();
        let numbers = [state.position, state.velocity, state.angular_velocity];
        for x in numbers.as_flattened().iter().chain(&state.orientation) {
            for byte in x.to_bits().to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3);
            }
        }
    }
    assert_eq!(hash, 0x6D45_2F45_B9CC_39D9, "{hash:#018X}");
}
