//! Values in files, and back.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::{
    Body, BodyError, Flow, Fluid, Input, Integrator, Loads, Model, NoiseStream, SeparatedFlow,
    Separation, Settings, SetupError, Slice, State, Stepper, Surface, TurbulenceHistory,
    TurbulenceSource, UnitSystem, Wrench,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The value that JSON gives back.
fn returned<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let text = serde_json::to_string(value).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Equal, also in the sign of zeros.
fn same<T: Serialize + DeserializeOwned + std::fmt::Debug>(value: &T) {
    assert_eq!(format!("{:?}", returned(value)), format!("{value:?}"));
}

/// Numbers that lose bits easily, one after the other: thirds, zeros of both signs, the largest and the smallest there are.
fn numbers<const N: usize>(from: usize) -> [f64; N] {
    let hard = [
        1.0 / 3.0,
        -0.0,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        -2.0f64.sqrt() * 1e-7,
        0.1 + 0.2,
        9_007_199_254_740_993.0 * 1.1e15,
    ];
    std::array::from_fn(|i| hard[(from + i) % hard.len()] * (1.0 - (i / hard.len()) as f64 / 64.0))
}

fn matrix<const N: usize>(from: usize) -> [[f64; N]; N] {
    std::array::from_fn(|i| numbers(from + 3 * i))
}

fn wrench(from: usize) -> Wrench {
    Wrench {
        force: numbers(from),
        torque: numbers(from + 3),
    }
}

fn body() -> Body {
    let [mass, volume, thickness, length] = numbers(1);
    Body {
        mass,
        inertia: matrix(0),
        volume,
        centre_of_buoyancy: numbers(2),
        added_mass: matrix(3),
        half_extents: numbers(4),
        thickness,
        length,
        separation: Separation {
            drag_area: matrix(1),
            extents: matrix(2),
            stokes_translation: matrix(3),
            stokes_rotation: matrix(4),
        },
        slices: vec![
            Slice {
                centre: numbers(5),
                translation: matrix(6),
                rotation: matrix(7),
                drag_area: matrix(8),
                extents: matrix(9),
            };
            2
        ],
        surface: Surface {
            vertices: vec![numbers(0), numbers(3), numbers(6)],
            triangles: vec![[0, 1, 2]],
            panels: vec![[2, 1, u32::MAX]],
            potentials: vec![numbers(0), numbers(1), numbers(2)],
        },
    }
}

#[test]
fn every_bit_comes_back() {
    let state = State {
        time: numbers::<1>(0)[0],
        step: u64::MAX,
        position: numbers(1),
        orientation: numbers(2),
        velocity: numbers(3),
        angular_velocity: numbers(4),
        fluctuation: [0.3, -0.1, 2.0, 0.7, -1.5, 1e-9],
    };
    same(&state);
    let [density, viscosity] = numbers(5);
    same(&Fluid {
        density,
        viscosity,
        velocity: numbers(0),
    });
    same(&Input {
        flow: Flow {
            velocity: numbers(0),
            gradient: matrix(1),
            acceleration: numbers(2),
        },
        wrench: wrench(4),
        noise: NoiseStream {
            seed: u64::MAX,
            body: u32::MAX,
        },
    });
    same(&Loads {
        drag: wrench(0),
        outside: wrench(1),
        ..Loads::default()
    });
    let [interval, inflow_speed, length] = numbers(5);
    same(&TurbulenceHistory {
        interval,
        inflow_speed,
        length,
        k: numbers::<20>(0).to_vec(),
        epsilon: numbers::<20>(7).to_vec(),
    });
    same(&body());
    // Numbers of every size and last bit.
    for n in 0..10_000u64 {
        let bits = n.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let x = f64::from_bits(bits);
        if x.is_finite() {
            let velocity = [x, 0.0, 0.0];
            let back = returned(&Flow::uniform(velocity)).velocity[0];
            assert_eq!(back.to_bits(), bits, "{x:e}");
        }
    }
}

#[test]
fn a_body_that_was_read_falls_as_before() {
    let plate = Body::plate(0.08, 0.05, 2e-4, 450.0).unwrap();
    let settings = Settings::default();
    let [before, after] = [plate.clone(), returned(&plate)]
        .map(|body| Stepper::new(&body, &Fluid::AIR, None, &settings).unwrap());
    let mut whole = State::default();
    let input = Input::with_noise(NoiseStream { seed: 3, body: 1 });
    let mut saved = whole;
    for step in 0..100 {
        before.step(&mut whole, 0.01, &input).unwrap();
        after.step(&mut saved, 0.01, &input).unwrap();
        if step == 50 {
            saved = returned(&saved);
        }
    }
    assert_eq!(whole, saved);
}

#[test]
fn a_body_that_was_read_is_checked_by_the_stepper() {
    let mut ball = Body::sphere(0.05, 600.0).unwrap();
    ball.mass = -1.0;
    let error =
        Stepper::new(&returned(&ball), &Fluid::AIR, None, &Settings::default()).unwrap_err();
    let told = BodyError::Negative {
        name: "mass",
        value: -1.0,
    };
    assert_eq!(error, SetupError::Body(told));
}

#[test]
fn choices_have_the_names_of_scenes() {
    let settings = Settings {
        model: Model::Published(UnitSystem::Si),
        integrator: Integrator::RungeKutta4,
        turbulence: TurbulenceSource::BodyDriven {
            wake_age: 0.1 + 0.2,
        },
        separated: SeparatedFlow {
            dynamic_stall: 1.0 / 3.0,
            ..SeparatedFlow::default()
        },
        reynolds: Some(1e4),
        ..Settings::default()
    };
    same(&settings);
    let json = serde_json::to_value(settings).unwrap();
    assert_eq!(json["model"], "published-si");
    assert_eq!(json["integrator"], "rk4");
    assert_eq!(json["turbulence"], "wake-age=0.30000000000000004");
    let json = serde_json::to_value(Settings::default()).unwrap();
    assert_eq!(
        [&json["model"], &json["integrator"], &json["turbulence"]],
        ["separated", "strang", "body-driven"]
    );
    let error = serde_json::from_str::<Settings>(r#"{ "integrator": "euler" }"#).unwrap_err();
    let told = error.to_string();
    assert!(
        told.starts_with("`euler` is no integrator; choose one of strang, rk4"),
        "{told}"
    );
}

#[test]
fn what_settings_and_inputs_leave_out_has_its_default() {
    let text = r#"{ "model": "kirchhoff", "separated": { "attached": true } }"#;
    let settings: Settings = serde_json::from_str(text).unwrap();
    let wanted = Settings {
        model: Model::Kirchhoff,
        separated: SeparatedFlow {
            attached: true,
            ..SeparatedFlow::default()
        },
        ..Settings::default()
    };
    assert_eq!(settings, wanted);

    let text = r#"{ "flow": { "velocity": [1, 0, 0] }, "wrench": { "force": [0, 2, 0] } }"#;
    let input: Input = serde_json::from_str(text).unwrap();
    let wanted = Input {
        flow: Flow::uniform([1.0, 0.0, 0.0]),
        wrench: Wrench {
            force: [0.0, 2.0, 0.0],
            ..Wrench::default()
        },
        ..Input::default()
    };
    assert_eq!(input, wanted);

    // A slip of the pen is no default, and a state has none.
    assert!(serde_json::from_str::<Settings>(r#"{ "modle": "kirchhoff" }"#).is_err());
    assert!(serde_json::from_str::<State>(r#"{ "position": [0, 1, 0] }"#).is_err());
}

#[test]
fn json_writes_null_for_what_is_no_number_and_does_not_read_it() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let text = serde_json::to_string(&Flow::uniform([x, 0.0, 0.0])).unwrap();
        assert!(text.contains(r#""velocity":[null,0.0,0.0]"#), "{text}");
        assert!(serde_json::from_str::<Flow>(&text).is_err());
    }
}
