use std::f64::consts::TAU;

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{norm, sub};
use langevin_rigid::{Body, Fluid, Input, Model, Settings, State};

use crate::water::{Immersion, Sea, WaterError, WaterSurface, Wave};

const G: f64 = 9.81;

/// Three waves on a current.
fn waves() -> WaterSurface {
    let wave = |amplitude, wavelength, heading, phase| Wave {
        amplitude,
        wavelength,
        heading,
        phase,
    };
    let waves = [
        wave(0.10, 5.0, [1.0, 0.3], 0.4),
        wave(0.05, 2.0, [-0.5, 2.0], 1.9),
        wave(0.02, 1.1, [0.1, -1.0], -2.0),
    ];
    let surface = WaterSurface::new(0.7, G, &waves).unwrap();
    surface.with_current([0.4, -0.2]).unwrap()
}

/// Central difference of a vector over one of (x, y, z, t).
fn difference(at: impl Fn(Vec3, f64) -> Vec3, [x, y, z, t]: [f64; 4], over: usize) -> Vec3 {
    const STEP: f64 = 1e-4;
    let moved = |by: f64| {
        let mut place = [x, y, z, t];
        place[over] += by;
        at([place[0], place[1], place[2]], place[3])
    };
    sub(moved(STEP), moved(-STEP)).map(|d| d / (2.0 * STEP))
}

const PLACES: [[f64; 4]; 3] = [
    [0.3, 0.2, -0.8, 0.0],
    [-2.0, 0.6, 5.0, 1.7],
    [11.0, -0.5, 3.0, 40.0],
];

#[test]
fn gradient_and_acceleration_are_those_of_the_velocity() {
    let surface = waves();
    let velocity = |p, t| surface.flow(p, t).velocity;
    for place @ [x, y, z, t] in PLACES {
        let flow = surface.flow([x, y, z], t);
        let mut acceleration = difference(velocity, place, 3);
        for j in 0..3 {
            let slope = difference(velocity, place, j);
            for i in 0..3 {
                assert!((flow.gradient[i][j] - slope[i]).abs() < 1e-7);
                acceleration[i] += flow.velocity[j] * slope[i];
            }
        }
        assert!(norm(sub(flow.acceleration, acceleration)) < 1e-6);
    }
}

#[test]
fn the_water_has_neither_sources_nor_vortices() {
    for [x, y, z, t] in PLACES {
        // Above the still level too.
        for y in [y, 1.5] {
            let flow = waves().flow([x, y, z], t);
            let divergence: f64 = (0..3).map(|i| flow.gradient[i][i]).sum();
            assert!(divergence.abs() < 1e-15, "{divergence}");
            assert!(norm(flow.rotation_rate()) < 1e-15);
        }
    }
}

/// The linear conditions at the still level: the surface goes with the water, under the pressure of the air.
#[test]
fn waves_meet_the_conditions_at_the_surface() {
    let surface = waves().with_current([0.0; 2]).unwrap();
    for [x, _, z, t] in PLACES {
        let level = [x, surface.level(), z];
        let height = |p: Vec3, t: f64| [surface.height(p[0], p[2], t), 0.0, 0.0];
        let slope = |over| difference(height, [x, level[1], z, t], over)[0];
        assert!((surface.flow(level, t).velocity[1] - slope(3)).abs() < 1e-7);
        // du/dt = -g d(eta)/dx is the dispersion, omega^2 = g k.
        let velocity = |p, t| surface.flow(p, t).velocity;
        let rate = difference(velocity, [x, level[1], z, t], 3);
        assert!((rate[0] + G * slope(0)).abs() < 1e-6);
        assert!((rate[2] + G * slope(2)).abs() < 1e-6);
        let normal = surface.normal(x, z, t);
        assert!((norm(normal) - 1.0).abs() < 1e-15 && normal[1] > 0.0);
        assert!((normal[0] + normal[1] * slope(0)).abs() < 1e-7);
        assert!((normal[2] + normal[1] * slope(2)).abs() < 1e-7);
        let tangent = surface.tangent(x, z, t);
        assert!(tangent.height([x, surface.height(x, z, t), z]).abs() < 1e-15);
    }
}

#[test]
fn a_wave_repeats_after_its_period() {
    let wave = Wave {
        amplitude: 0.1,
        wavelength: 6.0,
        heading: [0.0, 2.0],
        phase: 0.3,
    };
    let surface = WaterSurface::new(0.0, G, &[wave]).unwrap();
    let period = (TAU * 6.0 / G).sqrt();
    let at = |z, t| surface.height(0.0, z, t);
    assert!((at(1.0, 0.2) - at(1.0, 0.2 + period)).abs() < 1e-14);
    // It travels along its heading.
    assert!((at(1.0, 0.2) - at(1.0 + 0.25 * 6.0, 0.2 + 0.25 * period)).abs() < 1e-14);
}

#[test]
fn a_sea_is_as_high_as_it_should_be() {
    for (peak_enhancement, spreading) in [(1.0, None), (3.3, Some(10.0)), (3.3, Some(0.0))] {
        let sea = Sea {
            significant_height: 0.8,
            peak_period: 2.0,
            peak_enhancement,
            spreading,
            ..Sea::default()
        };
        let surface = WaterSurface::sea(0.0, G, &sea).unwrap();
        let (mut sum, mut squares, mut number) = (0.0, 0.0, 0.0);
        for n in 0..200_000 {
            let n = f64::from(n);
            let h = surface.height(13.7 * n % 1000.0, 0.0, 0.731 * n);
            sum += h;
            squares += h * h;
            number += 1.0;
        }
        let deviation = (squares / number - (sum / number) * (sum / number)).sqrt();
        assert!((4.0 * deviation / 0.8 - 1.0).abs() < 0.01, "{deviation}");
    }
}

/// The mean periods m_-1/m_0 and (m_0/m_2)^(1/2) of Pierson & Moskowitz are 0.857 and 0.710 peak periods; the latter is
/// 0.729 without the frequencies above five times the peak's.
#[test]
fn waves_have_the_periods_of_their_spectrum() {
    let sea = Sea {
        peak_enhancement: 1.0,
        components: 2000,
        ..Sea::default()
    };
    let surface = WaterSurface::sea(0.0, G, &sea).unwrap();
    let periods: Vec<f64> = surface
        .waves()
        .iter()
        .map(|w| (TAU * w.wavelength / G).sqrt() / sea.peak_period)
        .collect();
    let count = periods.len() as f64;
    let energy = periods.iter().sum::<f64>() / count;
    let crossing = (count / periods.iter().map(|t| 1.0 / (t * t)).sum::<f64>()).sqrt();
    assert!((energy - 0.857).abs() < 0.005, "{energy}");
    assert!((crossing - 0.729).abs() < 0.003, "{crossing}");
    let mean: f64 = surface.waves().iter().map(|w| w.heading[0]).sum::<f64>() / count;
    // The mean cosine of the spreading is n / (n + 1).
    assert!((mean - 10.0 / 11.0).abs() < 0.01, "{mean}");
}

#[test]
fn seas_differ_by_their_seed_and_have_the_same_bits() {
    let surface = |seed| {
        let sea = Sea {
            seed,
            ..Sea::default()
        };
        WaterSurface::sea(0.0, G, &sea).unwrap()
    };
    assert_eq!(surface(1), surface(1));
    assert_ne!(surface(1), surface(2));
}

#[test]
fn impossible_waves_are_named() {
    let wave = |amplitude, wavelength, heading| Wave {
        amplitude,
        wavelength,
        heading,
        phase: 0.0,
    };
    let error = |wave| WaterSurface::new(0.0, G, &[wave]).unwrap_err();
    assert!(matches!(
        error(wave(-1.0, 1.0, [1.0, 0.0])),
        WaterError::Negative { .. }
    ));
    assert!(matches!(
        error(wave(1.0, 0.0, [1.0, 0.0])),
        WaterError::NotPositive { .. }
    ));
    assert_eq!(error(wave(1.0, 1.0, [0.0, 0.0])), WaterError::NoHeading);
    assert!(WaterSurface::calm(f64::NAN).is_err());
    assert!(waves().with_current([f64::INFINITY, 0.0]).is_err());
    let none = Sea {
        components: 0,
        ..Sea::default()
    };
    assert_eq!(
        WaterSurface::sea(0.0, G, &none).unwrap_err(),
        WaterError::NoComponents
    );
}

/// A small ball of the water's own density goes round with it, and drifts as Stokes (1847) says: a^2 omega k e^(2 k y).
#[test]
fn what_is_as_heavy_as_the_water_drifts_with_the_waves() {
    let (amplitude, wavelength) = (0.05, 4.0);
    let wave = Wave {
        amplitude,
        wavelength,
        heading: [1.0, 0.0],
        phase: 0.0,
    };
    let surface = WaterSurface::new(0.0, G, &[wave]).unwrap();
    let ball = Body::sphere(0.005, Fluid::WATER.density).unwrap();
    let settings = Settings {
        model: Model::Kirchhoff,
        ..Settings::default()
    };
    let immersion =
        Immersion::new(&ball, (&Fluid::AIR, None), (&Fluid::WATER, None), &settings).unwrap();
    let number = TAU / wavelength;
    let frequency = (G * number).sqrt();
    let mut state = State {
        position: [0.0, -0.4, 0.0],
        ..State::default()
    };
    state.velocity = surface.flow(state.position, 0.0).velocity;
    let steps = 4000;
    let dt = 10.0 * TAU / frequency / f64::from(steps);
    let mut depth = 0.0;
    for _ in 0..steps {
        immersion
            .step(&mut state, dt, &Input::default(), &surface)
            .unwrap();
        depth += state.position[1] / f64::from(steps);
    }
    let decay = libm::exp(2.0 * number * depth);
    let drift = amplitude * amplitude * frequency * number * decay * state.time;
    assert!(
        (state.position[0] / drift - 1.0).abs() < 0.05,
        "{} {drift}",
        state.position[0]
    );
    let water = surface.flow(state.position, state.time).velocity;
    let apart = norm(sub(state.world_velocity(), water));
    assert!(apart < 0.02 * norm(water), "{apart}");
}
