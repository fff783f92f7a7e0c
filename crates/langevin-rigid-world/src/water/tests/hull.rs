use std::f64::consts::PI;

use langevin_rigid::Body;
use langevin_rigid::linalg::vector::{dot, norm, sub};
use langevin_rigid_bake::shapes::Shape;

use crate::water::{FloatingHull, HullError, Plane};

/// The body with the surface of a finer mesh of the same shape.
pub(super) fn with_mesh(mut body: Body, shape: Shape, triangles: usize) -> Body {
    let mesh = shape.mesh(triangles).unwrap();
    body.surface.vertices = mesh.vertices().to_vec();
    body.surface.triangles = mesh.triangles().to_vec();
    body
}

fn level(offset: f64) -> Plane {
    Plane {
        normal: [0.0, 1.0, 0.0],
        offset,
    }
}

#[test]
fn a_box_is_cut_as_in_closed_form() {
    let [a, b, c] = [0.4, 0.1, 0.3];
    let hull = FloatingHull::new(&Body::cuboid([a, b, c], 600.0).unwrap()).unwrap();
    for draught in [0.01, 0.05, 0.06, 0.0999] {
        let below = hull.below(&level(draught - 0.5 * b));
        assert!((below.volume / (a * c * draught) - 1.0).abs() < 1e-12);
        assert!((below.centroid[1] - 0.5 * (draught - b)).abs() < 1e-14);
        assert!(below.centroid[0].abs() < 1e-14 && below.centroid[2].abs() < 1e-14);
        assert!((below.waterplane / (a * c) - 1.0).abs() < 1e-12);
    }
    // Heeled about z through the middle, no deck under: a trapezium whose centroid moves by b'^2/12 d.
    for angle in [0.01, 0.2] {
        let (sin, cos) = libm::sincos(angle);
        let plane = Plane {
            normal: [-sin, cos, 0.0],
            offset: 0.0,
        };
        let (below, tan) = (hull.below(&plane), sin / cos);
        assert!((below.volume / (0.5 * a * b * c) - 1.0).abs() < 1e-12);
        let [x, y, _] = below.centroid;
        assert!((x - a * a * tan / (6.0 * b)).abs() < 1e-13, "{x}");
        assert!((y - (-0.25 * b + a * a * tan * tan / (12.0 * b))).abs() < 1e-13);
        assert!((below.waterplane / (a * c / cos) - 1.0).abs() < 1e-12);
    }
    // A corner under: a tetrahedron.
    let n = 1.0 / 3f64.sqrt();
    let corner = [0.5 * a, 0.5 * b, 0.5 * c];
    let depth = 0.02;
    let plane = Plane {
        normal: [-n; 3],
        offset: depth - n * (corner[0] + corner[1] + corner[2]),
    };
    let below = hull.below(&plane);
    let edge = depth / n;
    assert!((below.volume / (edge * edge * edge / 6.0) - 1.0).abs() < 1e-11);
    let away = sub(corner, below.centroid);
    assert!(away.iter().all(|x| (x - 0.25 * edge).abs() < 1e-12));
}

#[test]
fn a_cap_of_a_ball_is_cut_as_in_closed_form() {
    let r = 0.05;
    let shape = Shape::Ellipsoid { semi_axes: [r; 3] };
    let fine = with_mesh(Body::sphere(r, 500.0).unwrap(), shape, 20480);
    // The coarse surface that the sphere itself has, scaled to its volume.
    for (body, tolerance) in [(fine, 1e-3), (Body::sphere(r, 500.0).unwrap(), 0.02)] {
        let hull = FloatingHull::new(&body).unwrap();
        for h in [0.4 * r, r, 1.7 * r] {
            let below = hull.below(&level(h - r));
            let volume = PI * h * h * (3.0 * r - h) / 3.0;
            assert!((below.volume / volume - 1.0).abs() < tolerance);
            let away = 0.75 * (2.0 * r - h) * (2.0 * r - h) / (3.0 * r - h);
            assert!((below.centroid[1] + away).abs() < tolerance * r);
            let circle = PI * h * (2.0 * r - h);
            assert!((below.waterplane / circle - 1.0).abs() < tolerance);
        }
    }
}

#[test]
fn a_cylinder_is_cut_as_in_closed_form() {
    let (r, l) = (0.03, 0.2);
    let shape = Shape::Cylinder {
        radius: r,
        height: l,
    };
    let body = with_mesh(Body::cylinder(r, l, 500.0).unwrap(), shape, 8000);
    let hull = FloatingHull::new(&body).unwrap();
    for h in [0.5 * r, r, 1.5 * r] {
        let below = hull.below(&level(h - r));
        let angle = libm::acos((r - h) / r);
        let segment = r * r * angle - (r - h) * (2.0 * r * h - h * h).sqrt();
        assert!((below.volume / (segment * l) - 1.0).abs() < 3e-3);
        let chord = 2.0 * (2.0 * r * h - h * h).sqrt();
        assert!((below.waterplane / (chord * l) - 1.0).abs() < 3e-3);
        let away = chord * chord * chord / (12.0 * segment);
        assert!((below.centroid[1] + away).abs() < 1e-3 * r);
    }
}

/// Both sides of any plane make the whole.
#[test]
fn two_sides_make_the_whole() {
    let shape = Shape::Leaf {
        length: 0.1,
        width: 0.05,
        thickness: 0.002,
    };
    let mesh = shape.mesh(400).unwrap();
    let spec = langevin_rigid_bake::body::BodySpec {
        density: Some(500.0),
        centre_of_mass: Some([0.01, 0.001, -0.002]),
        ..Default::default()
    };
    let (body, _) = langevin_rigid_bake::body::bake_body(&mesh, &spec, &()).unwrap();
    let hull = FloatingHull::new(&body).unwrap();
    assert!((hull.volume() / body.volume - 1.0).abs() < 1e-12);
    let mut cut = 0;
    for n in 0..200 {
        let angle = 0.7 * f64::from(n);
        let (s, c) = libm::sincos(angle);
        let (p, q) = libm::sincos(1.3 * angle);
        let normal = [s * q, p, c * q];
        let offset = 0.05 * libm::sin(2.1 * angle);
        let one = hull.below(&Plane { normal, offset });
        let other = hull.below(&Plane {
            normal: normal.map(|x| -x),
            offset: -offset,
        });
        cut += u32::from(one.waterplane > 0.0 && other.waterplane > 0.0);
        assert!((one.volume + other.volume - hull.volume()).abs() < 1e-13 * hull.volume());
        let moment: [f64; 3] = std::array::from_fn(|i| {
            one.volume * one.centroid[i] + other.volume * other.centroid[i]
                - hull.volume() * hull.centroid()[i]
        });
        assert!(norm(moment) < 1e-13 * hull.volume() * hull.radius());
        assert!((one.waterplane - other.waterplane).abs() < 1e-15);
        assert!(one.volume == 0.0 || dot(normal, one.centroid) <= offset + 1e-15);
    }
    assert!(cut > 50);
}

#[test]
fn surfaces_that_cannot_be_cut_are_refused() {
    let body = Body::cuboid([0.1; 3], 500.0).unwrap();
    let refused = |change: fn(&mut Body)| {
        let mut body = body.clone();
        change(&mut body);
        FloatingHull::new(&body).unwrap_err()
    };
    let none = refused(|body| body.surface.triangles.clear());
    assert_eq!(none, HullError::NoSurface);
    let open = refused(|body| body.surface.triangles.truncate(11));
    assert_eq!(open, HullError::Open);
    let inwards = refused(|body| body.surface.triangles.iter_mut().for_each(|t| t.swap(0, 1)));
    assert!(matches!(inwards, HullError::Volume { .. }));
    let beyond = refused(|body| body.surface.triangles[0] = [0, 1, 99]);
    assert!(matches!(beyond, HullError::Body(_)));
}
