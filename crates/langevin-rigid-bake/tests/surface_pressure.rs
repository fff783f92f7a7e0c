//! Pressures on the panels of baked bodies against closed forms.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::Body;
use langevin_rigid::linalg::Vec3;
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;

const DENSITY: f64 = 998.2;

fn baked(shape: Shape, triangles: usize) -> Body {
    let spec = BodySpec {
        density: Some(1200.0),
        ..BodySpec::default()
    };
    let mesh = shape.mesh(triangles).unwrap();
    bake_body(&mesh, &spec, &()).unwrap().0
}

fn middles(body: &Body) -> Vec<Vec3> {
    let surface = &body.surface;
    let middle = |panel: &[u32; 3]| {
        let corners = panel.map(|vertex| surface.vertices[vertex as usize]);
        std::array::from_fn(|i| corners.iter().map(|corner| corner[i]).sum::<f64>() / 3.0)
    };
    surface.panels.iter().map(middle).collect()
}

#[test]
fn a_sphere_has_the_pressure_of_potential_flow() {
    let radius = 0.02;
    let ball = baked(
        Shape::Ellipsoid {
            semi_axes: [radius; 3],
        },
        5120,
    );
    let speed = 0.7;
    let pressures = ball.surface_pressures(DENSITY, [0.0, 0.0, speed], [0.0; 3]);
    let dynamic = 0.5 * DENSITY * speed * speed;
    assert_eq!(pressures.len(), ball.surface.panels.len());
    for (pressure, [x, y, z]) in pressures.iter().zip(middles(&ball)) {
        let cos2 = z * z / (x * x + y * y + z * z);
        // 1 - 9/4 sin^2 of the angle from the way.
        let exact = 1.0 - 2.25 * (1.0 - cos2);
        let error = pressure / dynamic - exact;
        assert!(error.abs() < 0.03, "{error} at cos^2 = {cos2}");
    }
}

#[test]
fn a_sphere_that_spins_moves_no_fluid() {
    let ball = baked(
        Shape::Ellipsoid {
            semi_axes: [0.02; 3],
        },
        1280,
    );
    // In the frame of the fluid at rest there is no pressure: rho (|U|^2 - |w|^2) / 2 with w = -U.
    let pressures = ball.surface_pressures(DENSITY, [0.0; 3], [0.0, 30.0, 0.0]);
    let scale = 0.5 * DENSITY * (30.0f64 * 0.02).powi(2);
    for pressure in pressures {
        assert!(pressure.abs() < 0.03 * scale, "{pressure}");
    }
}

#[test]
fn the_pressure_of_steady_motion_gives_no_force_but_munks_couple() {
    let body = baked(
        Shape::Ellipsoid {
            semi_axes: [0.03, 0.01, 0.02],
        },
        5120,
    );
    let velocity = [0.6, 0.8, 0.0];
    let pressures = body.surface_pressures(DENSITY, velocity, [0.0; 3]);
    let (mut force, mut torque, mut size) = ([0.0; 3], 0.0, 0.0);
    let surface = &body.surface;
    for (panel, pressure) in surface.panels.iter().zip(pressures) {
        let [a, b, c] = panel.map(|vertex| surface.vertices[vertex as usize]);
        let (e, f): (Vec3, Vec3) = (
            std::array::from_fn(|i| b[i] - a[i]),
            std::array::from_fn(|i| c[i] - a[i]),
        );
        let area = [
            0.5 * (e[1] * f[2] - e[2] * f[1]),
            0.5 * (e[2] * f[0] - e[0] * f[2]),
            0.5 * (e[0] * f[1] - e[1] * f[0]),
        ];
        let middle: Vec3 = std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0);
        let push: Vec3 = std::array::from_fn(|i| -pressure * area[i]);
        for i in 0..3 {
            force[i] += push[i];
        }
        size += pressure.abs() * (area[0].powi(2) + area[1].powi(2) + area[2].powi(2)).sqrt();
        torque += middle[0] * push[1] - middle[1] * push[0];
    }
    assert!(
        force.iter().all(|f| f.abs() < 0.01 * size),
        "{force:?} of {size}"
    );
    // -(v x A v) about z.
    let added = |i: usize| DENSITY * body.added_mass[i][i];
    let munk = -velocity[0] * velocity[1] * (added(1) - added(0));
    assert!((torque / munk - 1.0).abs() < 0.02, "{torque} for {munk}");
}
