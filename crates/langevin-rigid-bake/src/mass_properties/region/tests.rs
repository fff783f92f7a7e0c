//! Halves, shells and layers, whose mass, centre and inertia have closed forms.

use super::*;
use crate::mass_properties::Ballast;
use crate::shapes::Shape;
use proptest::prelude::*;

const FAR: f64 = 9.0;

fn front(from: f64, density: f64) -> Region {
    Region {
        from: [from, -FAR, -FAR],
        to: [FAR; 3],
        density,
    }
}

fn brick() -> TriMesh {
    let size = [0.3, 0.02, 1.1];
    Shape::Box { size }.mesh(500).unwrap()
}

/// Mass, centre and inertia agree to a share of the mass and of its size.
fn assert_same(a: &MassProperties, b: &MassProperties, tolerance: f64) {
    assert!((a.mass / b.mass - 1.0).abs() <= tolerance, "{a:?} {b:?}");
    let largest = b
        .inertia
        .as_flattened()
        .iter()
        .fold(0.0f64, |m, x| m.max(x.abs()));
    let length = (largest / b.mass).sqrt();
    for k in 0..3 {
        let apart = a.centre_of_mass[k] - b.centre_of_mass[k];
        assert!(apart.abs() <= tolerance * length, "{a:?} {b:?}");
    }
    let entries = a
        .inertia
        .as_flattened()
        .iter()
        .zip(b.inertia.as_flattened());
    for (x, y) in entries {
        assert!((x - y).abs() <= tolerance * largest, "{a:?} {b:?}");
    }
}

#[test]
fn halves_of_a_box_have_their_closed_form() {
    let got = MassProperties::of_regions(&brick(), 500.0, &[front(0.0, 1500.0)]).unwrap();
    let half = 0.15 * 0.02 * 1.1;
    let [light, heavy] = [500.0 * half, 1500.0 * half];
    let mass = light + heavy;
    let centre = 0.075 * (heavy - light) / mass;
    assert!((got.mass / mass - 1.0).abs() < 1e-13);
    assert!((got.centre_of_mass[0] - centre).abs() < 1e-15);
    let x = mass * 0.15f64.powi(2) / 3.0 - mass * centre * centre;
    let [y, z] = [0.02f64, 1.1].map(|edge| mass * edge * edge / 12.0);
    for (entry, exact) in [(0, y + z), (1, x + z), (2, x + y)] {
        assert!((got.inertia[entry][entry] / exact - 1.0).abs() < 1e-12);
    }
    assert_eq!(
        got.volume,
        MassProperties::of(&brick(), 1.0).unwrap().volume
    );
}

#[test]
fn halves_of_an_ellipsoid_have_their_closed_form() {
    let [a, b, c] = [0.01, 0.02, 0.04];
    let semi_axes = [a, b, c];
    let errors = [1280, 5120].map(|triangles| {
        let mesh = Shape::Ellipsoid { semi_axes }.mesh(triangles).unwrap();
        let got = MassProperties::of_regions(&mesh, 1000.0, &[front(0.0, 3000.0)]).unwrap();
        let half = 2.0 / 3.0 * std::f64::consts::PI * a * b * c;
        let mass = 4000.0 * half;
        assert!((got.mass / mass - 1.0).abs() < 1e-12);
        // The centroid of half an ellipsoid is 3/8 of its semi-axis from the middle.
        let centre = 0.375 * a * 0.5;
        let z = mass * ((a * a + b * b) / 5.0 - centre * centre);
        [
            (got.centre_of_mass[0] / centre - 1.0).abs(),
            (got.inertia[2][2] / z - 1.0).abs(),
        ]
    });
    for k in 0..2 {
        assert!(errors[0][k] < 1e-5, "{errors:?}");
        assert!(errors[1][k] < errors[0][k] / 3.0, "{errors:?}");
    }
}

#[test]
fn a_body_that_is_all_regions_is_uniform_in_their_density() {
    let mesh = Shape::Samara {
        length: 0.035,
        width: 0.011,
        thickness: 3e-4,
    }
    .mesh(1280)
    .unwrap();
    let halves = [front(-FAR, 700.0), front(0.003, 700.0)];
    let got = MassProperties::of_regions(&mesh, 20.0, &halves).unwrap();
    assert_same(&got, &MassProperties::of(&mesh, 700.0).unwrap(), 1e-11);
    let error = MassProperties::of_regions_and_mass(&mesh, 1.0, &halves).unwrap_err();
    assert_eq!(error, MassError::RegionsHoldAll);
}

#[test]
fn the_last_of_overlapping_regions_counts() {
    let mesh = brick();
    let [inner, outer] = [front(0.1, 4000.0), front(-0.1, 2000.0)];
    let got = MassProperties::of_regions(&mesh, 1000.0, &[outer, inner]).unwrap();
    let area = 0.02 * 1.1;
    let mass = area * (0.05 * 1000.0 + 0.2 * 2000.0 + 0.05 * 4000.0);
    assert!((got.mass / mass - 1.0).abs() < 1e-13);
    let first = area * 0.05 * 0.125 * (4000.0 - 1000.0);
    assert!((got.centre_of_mass[0] - first / mass).abs() < 1e-15);
    // The other way round the smaller one is covered.
    let error = MassProperties::of_regions(&mesh, 1000.0, &[inner, outer]).unwrap_err();
    assert!(
        matches!(error, MassError::EmptyRegion { region: 0, .. }),
        "{error}"
    );
}

#[test]
fn with_a_mass_the_rest_weighs_what_is_left() {
    let mesh = brick();
    let regions = [front(0.0, 1500.0)];
    let by_density = MassProperties::of_regions(&mesh, 500.0, &regions).unwrap();
    let got = MassProperties::of_regions_and_mass(&mesh, by_density.mass, &regions).unwrap();
    assert_same(&got, &by_density, 1e-13);
    let error = MassProperties::of_regions_and_mass(&mesh, 4.0, &regions).unwrap_err();
    assert!(
        matches!(error, MassError::RegionsOutweigh { mass: 4.0, .. }),
        "{error}"
    );
}

#[test]
fn a_shell_is_what_is_cut_out_of_it() {
    let mesh = Shape::Box { size: [2.0; 3] }.mesh(12).unwrap();
    let cube = |half: f64, density| Region {
        from: [-half; 3],
        to: [half; 3],
        density,
    };
    let got =
        MassProperties::of_regions(&mesh, 100.0, &[cube(0.8, 300.0), cube(0.5, 10.0)]).unwrap();
    let moment = |edge: f64| edge.powi(5) / 6.0;
    let exact = 100.0 * (moment(2.0) - moment(1.6))
        + 300.0 * (moment(1.6) - moment(1.0))
        + 10.0 * moment(1.0);
    for k in 0..3 {
        assert!((got.inertia[k][k] / exact - 1.0).abs() < 1e-12);
        assert!(got.centre_of_mass[k].abs() < 1e-14);
    }
}

#[test]
fn a_region_beside_the_body_is_refused() {
    // Beside the ball, but within the box about it.
    let mesh = Shape::Ellipsoid {
        semi_axes: [1.0; 3],
    }
    .mesh(320)
    .unwrap();
    let corner = Region {
        from: [0.8; 3],
        to: [1.0; 3],
        density: 5.0,
    };
    for region in [front(2.0, 5.0), corner] {
        let error = MassProperties::of_regions(&mesh, 1.0, &[front(0.0, 2.0), region]).unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("nothing of the body is in region 2, from"),
            "{error}"
        );
    }
    let tiny = Region {
        from: [0.5; 3],
        to: [0.5 + 1e-6; 3],
        density: 5.0,
    };
    assert!(MassProperties::of_regions(&mesh, 1.0, &[tiny]).is_ok());
}

#[test]
fn what_is_no_region_or_ballast_is_refused() {
    let mesh = brick();
    let refused = |region| {
        MassProperties::of_regions(&mesh, 1.0, &[region])
            .unwrap_err()
            .to_string()
    };
    for from in [f64::NAN, f64::NEG_INFINITY, FAR, 10.0] {
        assert!(refused(front(from, 1.0)).starts_with("region 1 is no box"));
    }
    assert!(refused(front(0.0, 0.0)).contains("density of a region must be positive"));
    let good = Ballast {
        mass: 1.0,
        ..Ballast::default()
    };
    for (ballast, words) in [
        (
            Ballast { mass: 0.0, ..good },
            "mass of a ballast must be positive",
        ),
        (
            Ballast {
                radius: -1.0,
                ..good
            },
            "radius of a ballast must be finite",
        ),
        (
            Ballast {
                position: [0.0, f64::NAN, 0.0],
                ..good
            },
            "position of a ballast",
        ),
    ] {
        let body = MassProperties::of(&mesh, 1.0).unwrap();
        let error = body.with_ballast(&[good, ballast]).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn a_ball_of_ballast_weighs_as_a_ball() {
    let ball = Shape::Ellipsoid {
        semi_axes: [0.1; 3],
    }
    .mesh(20480)
    .unwrap();
    let ball = MassProperties::of(&ball, 1000.0).unwrap();
    let speck = ball.with_mass(1e-12 * ball.mass).unwrap();
    let (at, half) = ([0.3, -0.2, 0.1], 0.5 * ball.mass);
    let weights = [
        Ballast {
            mass: half,
            position: at,
            radius: 0.1,
        },
        Ballast {
            mass: half,
            position: at,
            radius: 0.1,
        },
    ];
    let got = speck.with_ballast(&weights).unwrap();
    let moved = ball.with_centre_of_mass(at).unwrap();
    assert_same(&got, &moved, 1e-4);
}

proptest! {
    /// Cutting a body along other planes, in another order, changes nothing.
    #[test]
    fn slabs_add_up(cuts in prop::collection::vec(-0.9..0.9f64, 1..5), axis in 0..3usize) {
        let mesh = Shape::PaperAirplane { side: 2.0, thickness: 0.01 }.mesh(288).unwrap();
        let [low, high] = mesh.bounding_box();
        let slabs: Vec<Region> = cuts
            .iter()
            .map(|cut| {
                let mut from = [-FAR; 3];
                from[axis] = 0.5 * (low[axis] + high[axis]) + 0.5 * cut * (high[axis] - low[axis]);
                Region { from, to: [FAR; 3], density: 3.0 }
            })
            .collect();
        let lowest = slabs.iter().map(|s| s.from[axis]).fold(FAR, f64::min);
        let mut all = slabs[0];
        all.from[axis] = lowest;
        let one = MassProperties::of_regions(&mesh, 1.0, &[all]).unwrap();
        let mut ascending = slabs;
        ascending.sort_by(|a, b| a.from[axis].total_cmp(&b.from[axis]));
        ascending.dedup();
        let many = MassProperties::of_regions(&mesh, 1.0, &ascending).unwrap();
        assert_same(&many, &one, 1e-10);
    }
}
