use super::*;
use crate::ambient::STILL;
use crate::body::{Separation, Surface};
use crate::linalg::eigen_symmetric;
use crate::noise::NoiseStream;

fn diagonal(d: [f64; 3]) -> Mat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

/// A flat body, thin along y, in a fluid of density 1 without viscosity.
fn plate(added: [f64; 6], drag: [f64; 3], half_extents: [f64; 3]) -> Closure {
    let mut added_mass = [[0.0; 6]; 6];
    for i in 0..6 {
        added_mass[i][i] = added[i];
    }
    let mut sorted = half_extents;
    sorted.sort_by(|a, b| b.total_cmp(a));
    let body = Body {
        mass: 1.0,
        inertia: diagonal([1.0; 3]),
        volume: 1.0,
        centre_of_buoyancy: [0.0; 3],
        added_mass,
        half_extents: sorted,
        thickness: 1.0,
        length: 1.0,
        separation: Separation {
            drag_area: diagonal(drag),
            extents: diagonal(half_extents.map(|e| e * e)),
            ..Separation::default()
        },
        slices: vec![],
        surface: Surface::default(),
    };
    Closure::new(&body, 1.0, 0.0, SeparatedFlow::default()).unwrap()
}

fn disc() -> Closure {
    let face = std::f64::consts::PI;
    let (broadside, turning) = (8.0 / 3.0, 16.0 / 45.0);
    plate(
        [0.0, broadside, 0.0, turning, 0.0, turning],
        [0.072, 1.12 * face, 0.072],
        [1.0, 0.015, 1.0],
    )
}

/// A strip of chord 2 along x and unit span, with the aspect ratio of a long one.
fn strip() -> Closure {
    let pi = std::f64::consts::PI;
    plate(
        [0.0, pi, 0.0, 0.0, 0.0, pi / 8.0],
        [0.04, 1.95 * 2.0, 0.04],
        [1.0, 0.02, 1e6],
    )
}

/// Normal force coefficient and centre of pressure (chords from the middle) at rest in a stream.
fn statics(closure: &Closure, area: f64, degrees: f64) -> (f64, f64) {
    let (sin, cos) = (degrees.to_radians().sin(), degrees.to_radians().cos());
    let v = [cos, -sin, 0.0];
    let (force, torque) = split(&closure.load(&join(v, [0.0; 3]), &STILL).unwrap().force);
    // With the Munk couple that Kirchhoff's terms contribute.
    let slice = &closure.slices[0];
    let munk = scale(
        slice.largest,
        slice.incidence(&SeparatedFlow::default(), v).couple,
    );
    let normal = force[1];
    (normal / (0.5 * area), (torque[2] + munk[2]) / normal / 2.0)
}

#[test]
fn normal_force_and_centre_of_pressure_follow_the_incidence() {
    // (incidence, strip CN, strip x_cp, disc CN, disc x_cp)
    let table = [
        (5.0, 0.29, 0.283, 0.14, 0.278),
        (10.0, 0.58, 0.268, 0.29, 0.262),
        (20.0, 1.14, 0.239, 0.62, 0.234),
        (30.0, 1.57, 0.206, 0.86, 0.201),
        (45.0, 1.89, 0.145, 1.06, 0.140),
        (60.0, 1.97, 0.077, 1.12, 0.074),
        (90.0, 1.95, 0.0, 1.12, 0.0),
    ];
    for (degrees, strip_cn, strip_cp, disc_cn, disc_cp) in table {
        let (cn, cp) = statics(&strip(), 2.0, degrees);
        assert!((cn - strip_cn).abs() < 0.02, "strip {degrees}: CN {cn}");
        assert!((cp - strip_cp).abs() < 0.01, "strip {degrees}: x_cp {cp}");
        let (cn, cp) = statics(&disc(), std::f64::consts::PI, degrees);
        assert!((cn - disc_cn).abs() < 0.02, "disc {degrees}: CN {cn}");
        assert!((cp - disc_cp).abs() < 0.01, "disc {degrees}: x_cp {cp}");
    }
}

#[test]
fn the_attached_switch_is_kirchhoff() {
    let mut closure = disc();
    closure.constants.attached = true;
    assert!(
        closure
            .load(&[1.0, -2.0, 0.5, 3.0, 1.0, -1.0], &STILL)
            .is_none()
    );
}

/// A body without any symmetry, with a centre of mass off its centroid.
fn general() -> Closure {
    let mut closure = plate(
        [0.4, 2.0, 0.9, 0.3, 0.5, 0.2],
        [0.3, 2.2, 0.7],
        [1.5, 0.1, 0.8],
    );
    let (s, c) = (0.6, 0.8);
    closure.slices[0].centre = [0.2, -0.1, 0.3];
    closure.slices[0].turn(&[[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]);
    closure
}

#[test]
fn the_closure_never_feeds_energy() {
    let closure = general();
    let stream = NoiseStream { seed: 3, body: 0 };
    for n in 0..2000 {
        let z = stream.normals(n);
        let xi: Vec6 = std::array::from_fn(|i| if i < 3 { z[i] } else { 4.0 * z[i] });
        let load = closure.load(&xi, &STILL).unwrap().force;
        let (v, omega) = split(&xi);
        let at_centre = add(v, cross(omega, closure.slices[0].centre));
        let power: f64 = (0..6).map(|i| load[i] * xi[i]).sum();
        let scale = norm(at_centre).powi(3) + norm(omega).powi(3);
        assert!(power <= 1e-12 * scale, "state {n}: power {power}");
    }
}

#[test]
fn the_resistances_are_a_positive_tensor_and_the_rest_does_no_work() {
    let closure = general();
    let stream = NoiseStream { seed: 4, body: 0 };
    for n in 0..500 {
        let z = stream.normals(n);
        let xi: Vec6 = std::array::from_fn(|i| if i < 3 { z[i] } else { 4.0 * z[i] });
        let (free, resistance) = closure.resisted_load(&xi, &STILL).unwrap();
        let free = free.force;
        let (values, _) = eigen_symmetric(&resistance);
        assert!(values[0] >= -1e-12 * values[5], "{values:?}");
        // What is left is the rotational lift and the lost couple, of which the first does no work.
        let slice = &closure.slices[0];
        let (v, omega) = split(&xi);
        let at_centre = add(v, cross(omega, slice.centre));
        let stream = slice.stream(&closure.constants, at_centre, omega, norm(omega));
        let fed = dot(slice.loads(&stream).lost, omega);
        let power: f64 = (0..6).map(|i| free[i] * xi[i]).sum();
        let size = norm(at_centre).powi(3) + norm(omega).powi(3);
        let left = power - fed;
        assert!(
            left.abs() <= 1e-12 * size || (fed > 0.0 && left < 0.0),
            "state {n}: {left}"
        );
    }
}

#[test]
fn a_spinning_sphere_bends_to_the_magnus_side() {
    let sphere = plate([0.5, 0.5, 0.5, 0.0, 0.0, 0.0], [0.45; 3], [1.0; 3]);
    // Moving along x with the spin along z: backspin lifts a ball that flies with its top
    // moving backwards, omega x v along +y.
    let (force, _) = split(
        &sphere
            .load(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0], &STILL)
            .unwrap()
            .force,
    );
    assert!(force[1] > 0.0 && force[0] < 0.0, "{force:?}");
}

#[test]
fn rest_and_pure_motions_have_no_direction_to_fail_on() {
    for closure in [disc(), strip(), general()] {
        for xi in [
            [0.0; 6],
            [0.0, 0.0, 0.0, 1.0, 2.0, 3.0],
            [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 1e-300, 0.0, 0.0, 0.0, 1.0],
        ] {
            assert!(
                closure
                    .load(&xi, &STILL)
                    .unwrap()
                    .force
                    .iter()
                    .all(|f| f.is_finite()),
                "{xi:?}"
            );
        }
    }
}

#[test]
fn turbulence_acts_by_the_relative_motion() {
    let closure = general();
    let stream = NoiseStream { seed: 5, body: 0 };
    for n in 0..500 {
        let normals = stream.normals(n);
        let z: Vec6 = std::array::from_fn(|i| normals[i]);
        let turbulence: Vec6 = std::array::from_fn(|i| normals[6 + i]);
        let ambient = Ambient {
            gradient: None,
            fluctuation: Some(turbulence),
        };
        let load = closure.load(&z, &ambient).unwrap();
        let relative: Vec6 = std::array::from_fn(|i| z[i] - turbulence[i]);
        let alone = closure.load(&relative, &STILL).unwrap();
        assert_eq!(load.force, alone.force);
    }
}

/// Rotational lift over that of the round ball, of one that is flattened along the axis `flat`.
fn magnus(out_of_round: f64, flat: usize) -> f64 {
    let ball = |e: f64| {
        let mut semi_axes = [1.0; 3];
        semi_axes[flat] -= e;
        let body = Body::ellipsoid(semi_axes, 2.0).unwrap();
        Closure::new(&body, 1.0, 0.0, SeparatedFlow::default()).unwrap()
    };
    let lift = |closure: &Closure| {
        let mut sum = 0.0;
        for step in 0..36 {
            let (sin, cos) = (f64::from(10 * step)).to_radians().sin_cos();
            // A turn about z past the stream, with the tips at 0.3 of its speed.
            let load = closure.load(&[cos, -sin, 0.0, 0.0, 0.0, 0.3], &STILL);
            let force = load.unwrap().force;
            sum += sin * force[0] + cos * force[1];
        }
        sum
    };
    lift(&ball(out_of_round)) / lift(&ball(0.0))
}

#[test]
fn a_ball_out_of_round_curves_as_a_round_one() {
    for out_of_round in [0.01, 0.05] {
        for flat in 0..3 {
            let ratio = magnus(out_of_round, flat);
            assert!((ratio - 1.0).abs() < 0.1, "{out_of_round}, {flat}: {ratio}");
        }
    }
}

#[test]
fn a_disc_that_spins_fast_has_the_drag_of_a_strip() {
    let closure = disc();
    let drag = |spin: f64| {
        let load = closure.load(&[0.0, -1.0, 0.0, 0.0, 0.0, spin], &STILL);
        load.unwrap().force[1]
    };
    // 1/a_m of a disc is (1 + 1) / (1 + s).
    let lost = drag(1e3) / drag(0.0);
    assert!((lost - 2.0 / 1.08).abs() < 1e-3, "{lost}");
    // Tips at this share of the speed: half of it.
    let share = SeparatedFlow::default().relief_speed;
    let half = (share * share * closure.slices[0].largest / (8.0 * 16.0 / 45.0)).sqrt();
    let gained = (drag(half) / drag(0.0) - 1.0) / (lost - 1.0);
    assert!((gained - 0.5).abs() < 1e-3, "{gained}");
}

#[test]
fn loads_act_at_the_centre_of_the_added_mass() {
    // A body whose added mass is simple about a point that is neither centroid nor centre of mass.
    let point = [0.3, -0.2, 0.1];
    let mut about_point = [[0.0; 6]; 6];
    for (i, a) in [0.4, 2.0, 0.9, 0.3, 0.5, 0.2].into_iter().enumerate() {
        about_point[i][i] = a;
    }
    let added_mass = shift_added_mass(&about_point, point.map(|x: f64| -x));
    let body = Body {
        mass: 1.0,
        inertia: diagonal([1.0; 3]),
        volume: 1.0,
        centre_of_buoyancy: [0.05, 0.0, 0.0],
        added_mass,
        half_extents: [1.5, 0.8, 0.1],
        thickness: 1.0,
        length: 1.0,
        separation: Separation {
            extents: diagonal([2.25, 0.01, 0.64]),
            ..Separation::default()
        },
        slices: vec![],
        surface: Surface::default(),
    };
    let found = added_centre(&body);
    for (x, wanted) in found.into_iter().zip(point) {
        assert!((x - wanted).abs() < 2e-3, "{found:?}");
    }
}

#[test]
fn eddies_are_of_unit_variance_and_forget_at_their_rate() {
    let body = Body::disc(0.05, 1e-3, 700.0).unwrap();
    let eddies = Eddies::shed(&body, 1.5e-5, 1.0, &SeparatedFlow::default());
    let stream = NoiseStream { seed: 6, body: 0 };
    let (speed, h) = (2.0, 5e-3);
    let mut motion = crate::State {
        velocity: [0.0, 0.0, speed],
        ..crate::State::default()
    }
    .motion();
    let (mut squares, mut kept, mut count) = (0.0, 0.0, 0.0);
    for n in 0..40_000 {
        let before = motion.fluctuation;
        let normals = std::array::from_fn(|i| stream.normals(n)[i]);
        eddies.step(&mut motion, 0.0, h, &normals).unwrap();
        for (new, old) in motion.fluctuation.into_iter().zip(before) {
            squares += new * new;
            kept += new * old;
            count += 1.0;
        }
    }
    let (variance, correlation) = (squares / count, kept / squares);
    // Half the width of the disc at this speed.
    let wanted = (-h * speed / 0.05f64).exp();
    assert!((variance - 1.0).abs() < 0.02, "{variance}");
    assert!(
        (correlation - wanted).abs() < 0.01,
        "{correlation}, {wanted}"
    );
}

#[test]
fn a_body_at_rest_or_in_creeping_flow_sheds_nothing() {
    let body = Body::disc(0.05, 1e-3, 700.0).unwrap();
    let constants = SeparatedFlow::default();
    let at = |speed: f64, viscosity: f64| {
        let eddies = Eddies::shed(&body, viscosity, 1.0, &constants);
        let mut motion = crate::State::default().motion();
        motion.xi[1] = speed;
        motion.fluctuation = [1.0; 6];
        eddies.now(&motion, 0.0).unwrap()
    };
    assert_eq!(at(0.0, 1e-6), [0.0; 6]);
    // Reynolds number 50, on the diameter.
    assert_eq!(at(1.0, 2e-3), [0.0; 6]);
    let turbulent = at(1.0, 1e-6);
    let quiet_share = turbulent[0] / (constants.turbulence_intensity * 1.0);
    assert!(quiet_share > 0.3 && quiet_share < 1.2, "{quiet_share}");
}
