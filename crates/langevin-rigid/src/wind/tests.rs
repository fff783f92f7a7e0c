use super::*;
use crate::linalg::sub;

const H: f64 = 1e-5;

/// Holds a field's gradient and rate against differences of its velocities.
fn consistent(wind: &Wind, position: Vec3, time: f64) {
    let velocity = |x: Vec3, t: f64| wind.flow(x, t, [0.0; 3]).velocity;
    let local = wind.flow(position, time, [0.0; 3]);
    let scale = norm(local.velocity)
        + local
            .gradient
            .as_flattened()
            .iter()
            .fold(0.0, |a: f64, x| a.max(x.abs()));
    for j in 0..3 {
        let (mut to, mut from) = (position, position);
        to[j] += H;
        from[j] -= H;
        let change = sub(velocity(to, time), velocity(from, time)).map(|x| x / (2.0 * H));
        for i in 0..3 {
            let found = local.gradient[i][j];
            assert!(
                (found - change[i]).abs() < 1e-4 * scale + 1e-9,
                "du{i}/dx{j} at {position:?}: {found}, by differences {}",
                change[i]
            );
        }
    }
    let rate = sub(velocity(position, time + H), velocity(position, time - H));
    for i in 0..3 {
        let own = rate[i] / (2.0 * H);
        let carried = dot(local.gradient[i], local.velocity);
        let found = local.acceleration[i];
        assert!(
            (found - own - carried).abs() < 1e-3 * (1.0 + scale * scale),
            "acceleration {i}: {found} for {own} + {carried}"
        );
    }
}

fn divergence(flow: &Flow) -> f64 {
    (0..3).map(|i| flow.gradient[i][i]).sum()
}

fn of(field: impl Into<WindField>) -> Wind {
    let mut wind = Wind::default();
    wind.add(field).unwrap();
    wind
}

fn places() -> impl Iterator<Item = Vec3> {
    let stream = crate::NoiseStream { seed: 8, body: 0 };
    (0..200u64).map(move |n| {
        let z = stream.normals(n);
        [z[0], z[1], z[2]]
    })
}

fn vortex() -> Vortex {
    Vortex {
        centre: [0.1, 0.2, 0.3],
        axis: [1.0, 2.0, -0.5],
        circulation: 0.7,
        core: 0.4,
    }
}

fn jet() -> Jet {
    Jet {
        centre: [-0.3, 0.1, 0.0],
        axis: [2.0, 0.3, 0.4],
        speed: 3.0,
        diameter: 0.4,
    }
}

#[test]
fn gradients_and_accelerations_are_those_of_the_velocities() {
    let log = Profile::Log { roughness: 0.03 };
    let shear = |profile| Shear {
        velocity: [3.0, 0.0, 1.0],
        height: 2.0,
        ground: -4.0,
        profile,
    };
    let gusts = GustSettings {
        rms: 0.4,
        length: 1.5,
        carried: [1.0, 0.2, 0.0],
        ..GustSettings::default()
    };
    let winds = [
        of(shear(log)),
        of(shear(Profile::Power { exponent: 0.2 })),
        of(vortex()),
        of(jet()),
        of(Gusts::new(&gusts).unwrap()),
    ];
    for wind in &winds {
        for (n, place) in places().enumerate() {
            consistent(wind, place, 0.1 * n as f64);
        }
    }
}

#[test]
fn what_is_incompressible_has_no_divergence() {
    let gusts = Gusts::new(&GustSettings::default()).unwrap();
    for wind in [of(vortex()), of(jet()), of(gusts)] {
        for place in places() {
            let flow = wind.flow(place, 0.3, [0.0; 3]);
            let size = flow
                .gradient
                .as_flattened()
                .iter()
                .fold(0.0, |a: f64, x| a.max(x.abs()));
            assert!(divergence(&flow).abs() < 1e-9 * (1.0 + size), "{place:?}");
        }
    }
}

#[test]
fn a_region_ends_softly_and_wholly() {
    let uniform = || WindField::Uniform([2.0, 0.0, 0.0]);
    let regions = [
        Region::Box {
            centre: [0.0; 3],
            size: [2.0, 3.0, 4.0],
            edge: 0.5,
        },
        Region::Sphere {
            centre: [0.0; 3],
            radius: 1.0,
            edge: 0.5,
        },
    ];
    for region in regions {
        let mut wind = Wind::default();
        wind.add_within(uniform(), region).unwrap();
        let speed = |x: f64| wind.flow([x, 0.0, 0.0], 0.0, [0.0; 3]).velocity[0];
        assert_eq!(
            [speed(0.0), speed(0.5), speed(1.0), speed(3.0)],
            [2.0, 2.0, 0.0, 0.0]
        );
        assert!((speed(0.75) - 1.0).abs() < 1e-12);
        for place in places() {
            consistent(&wind, place, 0.0);
        }
    }
}

#[test]
fn shear_has_its_speed_at_its_height_and_none_on_the_ground() {
    for profile in [
        Profile::Log { roughness: 0.02 },
        Profile::Power {
            exponent: 1.0 / 7.0,
        },
    ] {
        let wind = of(Shear {
            velocity: [4.0, 0.0, 0.0],
            height: 10.0,
            ground: 1.0,
            profile,
        });
        let speed = |y: f64| wind.flow([0.0, y, 0.0], 0.0, [0.0; 3]).velocity[0];
        assert!((speed(11.0) - 4.0).abs() < 1e-8);
        assert_eq!([speed(1.0), speed(0.0)], [0.0; 2]);
        let wanted = match profile {
            Profile::Power { exponent } => libm::pow(0.2, exponent),
            Profile::Log { roughness } => {
                libm::log1p(2.0 / roughness) / libm::log1p(10.0 / roughness)
            }
        };
        assert!((speed(3.0) / 4.0 - wanted).abs() < 1e-8);
    }
}

#[test]
fn a_vortex_has_its_circulation_and_a_jet_its_momentum() {
    let wind = of(Vortex {
        axis: [0.0, 0.0, 3.0],
        centre: [0.0; 3],
        ..vortex()
    });
    // Counter-clockwise, and far from the core all of the circulation.
    let far = wind.flow([5.0, 0.0, 1.0], 0.0, [0.0; 3]).velocity;
    assert!((far[1] * std::f64::consts::TAU * 5.0 - 0.7).abs() < 1e-9);

    let fan = Jet {
        centre: [0.0; 3],
        axis: [1.0, 0.0, 0.0],
        ..jet()
    };
    let wind = of(fan);
    let along = |s: f64, r: f64| wind.flow([s, r, 0.0], 0.0, [0.0; 3]).velocity[0];
    let momentum = |s: f64| {
        let ring = |n: i32| {
            let r = 0.005 * (f64::from(n) + 0.5);
            std::f64::consts::TAU * r * 0.005 * along(s, r) * along(s, r)
        };
        (0..2000).map(ring).sum::<f64>()
    };
    let disc = 9.0 * std::f64::consts::FRAC_PI_4 * 0.16;
    for s in [0.0, 1.0, 4.0, 10.0] {
        assert!(
            (momentum(s) / disc - 1.0).abs() < 1e-3,
            "{s}: {}",
            momentum(s)
        );
    }
    assert!((along(0.0, 0.0) - 3.0).abs() < 1e-12);
    assert!((along(200.0, 0.0) * 200.0 / (3.0 * 0.4) - 6.26).abs() < 0.02);
    // In its far field half the speed at 0.094 of the way.
    assert!((along(20.0, 0.094 * 20.0) / along(20.0, 0.0) - 0.5).abs() < 0.01);
    assert!(along(-1.0, 0.0) > 0.0 && along(-1.0, 0.0) < 0.3);
}

#[test]
fn gusts_are_isotropic_with_von_karmans_correlations() {
    let settings = GustSettings {
        rms: 0.7,
        length: 2.0,
        ..GustSettings::default()
    };
    let fields = 300;
    let apart = [0.5, 1.0, 2.0, 4.0];
    let mut stress = [[0.0; 3]; 3];
    let (mut longitudinal, mut lateral) = ([0.0; 4], [0.0; 4]);
    let (mut fourth, mut samples) = (0.0, 0.0);
    for seed in 0..fields {
        let gusts = of(Gusts::new(&GustSettings { seed, ..settings }).unwrap());
        // So far apart that they have little to do with each other.
        for place in places().take(50).map(|x| x.map(|x| 20.0 * x)) {
            let at = |x: Vec3| gusts.flow(x, 0.0, [0.0; 3]).velocity;
            let u = at(place);
            samples += 1.0;
            for i in 0..3 {
                fourth += u[i] * u[i] * u[i] * u[i] / 3.0;
                for j in 0..3 {
                    stress[i][j] += u[i] * u[j];
                }
            }
            for (n, r) in apart.into_iter().enumerate() {
                let v = at([place[0], place[1] + r, place[2]]);
                longitudinal[n] += u[1] * v[1];
                lateral[n] += 0.5 * (u[0] * v[0] + u[2] * v[2]);
            }
        }
    }
    let square = 0.49;
    for i in 0..3 {
        for j in 0..3 {
            let wanted = if i == j { 1.0 } else { 0.0 };
            let found = stress[i][j] / samples / square;
            assert!((found - wanted).abs() < 0.04, "{i} {j}: {found}");
        }
    }
    // As many normals together have it: three times the square of the second.
    let flatness = fourth / samples / (square * square);
    assert!((flatness - 3.0).abs() < 0.15, "{flatness}");
    for (n, r) in apart.into_iter().enumerate() {
        let [f, g] = von_karman(r / (1.339 * 2.0));
        let [found, across] = [longitudinal[n], lateral[n]].map(|x| x / samples / square);
        assert!((found - f).abs() < 0.05, "{r}: {found} for {f}");
        assert!((across - g).abs() < 0.05, "{r}: {across} for {g}");
    }
}

/// Longitudinal and lateral correlation at a distance in units of the bend: 2^(2/3)/Gamma(1/3) x^(1/3) K_1/3(x), and what
/// continuity makes of it.
fn von_karman(x: f64) -> [f64; 2] {
    let f = |x: f64| {
        libm::pow(2.0, 2.0 / 3.0) / libm::tgamma(1.0 / 3.0) * libm::cbrt(x) * bessel_third(x)
    };
    let slope = (f(x + 1e-4) - f(x - 1e-4)) / 2e-4;
    [f(x), f(x) + 0.5 * x * slope]
}

/// K_1/3, by its integral of exp(-x cosh t) cosh(t/3).
fn bessel_third(x: f64) -> f64 {
    let value = |n: i32| {
        let t = f64::from(n) * 1e-3;
        let weight = if n == 0 { 0.5 } else { 1.0 };
        weight * libm::exp(-x * libm::cosh(t)) * libm::cosh(t / 3.0)
    };
    (0..12_000).map(value).sum::<f64>() * 1e-3
}

#[test]
fn gusts_move_with_what_carries_them_and_forget() {
    let carried = [2.0, 0.0, 1.0];
    let settings = GustSettings {
        rms: 0.5,
        carried,
        ..GustSettings::default()
    };
    let (mut soon, mut late, mut still) = (0.0, 0.0, 0.0);
    let mut square = 0.0;
    for seed in 0..200 {
        let gusts = of(Gusts::new(&GustSettings { seed, ..settings }).unwrap());
        for place in places().take(20) {
            let at = |x: Vec3, t: f64| gusts.flow(x, t, [0.0; 3]).velocity;
            let moved = |t: f64| std::array::from_fn(|i| place[i] + t * carried[i]);
            let u = at(place, 0.0);
            square += dot(u, u);
            soon += dot(u, at(moved(0.3), 0.3));
            still += dot(u, at(place, 0.3));
            late += dot(u, at(moved(30.0), 30.0));
        }
    }
    let [soon, still, late] = [soon, still, late].map(|x| x / square);
    assert!(
        soon > 0.85 && still < 0.6 && late.abs() < 0.1,
        "{soon} {still} {late}"
    );
}

#[test]
fn a_table_is_linear_between_its_points_and_times() {
    let field = |x: f64, y: f64, z: f64, t: f64| [1.0 + x - y, 2.0 * z * t, x + y + z + t];
    let counts = [3usize, 4, 2];
    let (origin, spacing, times) = ([-1.0, 0.0, 2.0], [0.5, 0.25, 1.0], [0.0, 1.0, 3.0]);
    let mut velocities = vec![];
    for t in times {
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                for k in 0..counts[2] {
                    let at = |n: usize, i: usize| origin[i] + spacing[i] * n as f64;
                    velocities.push(field(at(i, 0), at(j, 1), at(k, 2), t));
                }
            }
        }
    }
    let table = Table::new(origin, spacing, counts, &times, velocities).unwrap();
    let wind = of(table.clone());
    for (x, t) in [([-0.3, 0.6, 2.2], 0.4), ([-0.9, 0.1, 2.9], 2.7)] {
        let found = table.velocity(x, t);
        let wanted = field(x[0], x[1], x[2], t);
        assert!(norm(sub(found, wanted)) < 1e-12, "{found:?} {wanted:?}");
        consistent(&wind, x, t);
    }
    // Outside as on the nearest face, before and after as at the first and last time.
    assert_eq!(
        table.velocity([9.0, 0.1, 2.5], 9.0),
        table.velocity([0.0, 0.1, 2.5], 3.0)
    );
    let outside = wind.flow([9.0, 0.1, 2.5], 0.5, [0.0; 3]);
    assert_eq!(outside.gradient[0][0], 0.0);
    assert!(outside.gradient[0][1] != 0.0);
}

#[test]
fn what_is_no_field_is_refused_by_name() {
    let mut wind = Wind::default();
    let told = wind
        .add(Vortex {
            core: 0.0,
            ..vortex()
        })
        .unwrap_err()
        .to_string();
    assert_eq!(told, "core of the vortex must be positive, not 0");
    let told = wind
        .add(Jet {
            axis: [0.0; 3],
            ..jet()
        })
        .unwrap_err()
        .to_string();
    assert_eq!(told, "the axis of the jet has no length");
    let told = wind
        .add(WindField::Uniform([f64::NAN, 0.0, 0.0]))
        .unwrap_err();
    assert!(matches!(
        told,
        WindError::NotFinite {
            field: "uniform wind",
            ..
        }
    ));
    let small = GustSettings {
        smallest: Some(3.0),
        ..GustSettings::default()
    };
    assert!(matches!(Gusts::new(&small), Err(WindError::Eddies { .. })));
    assert!(wind.is_empty());
    assert!(matches!(
        Table::new([0.0; 3], [1.0; 3], [2, 1, 1], &[0.0], vec![[0.0; 3]]),
        Err(TableError::Count { velocities: 1, .. })
    ));
}
