use super::*;
use crate::mass_properties::centroid;
use crate::mesh::vector::{norm, sub};
use std::f64::consts::PI;

fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn ellipsoid_has_the_counts_and_volume_it_promises() {
    let semi_axes = [1.0, 2.0, 4.0];
    for (wish, got) in [
        (20, 20),
        (49, 20),
        (50, 20),
        (51, 80),
        (320, 320),
        (700, 720),
        (1280, 1280),
    ] {
        let mesh = Shape::Ellipsoid { semi_axes }.mesh(wish).unwrap();
        assert_eq!(mesh.triangles().len(), got, "asked for {wish}");
        assert!(relative(mesh.volume(), 4.0 / 3.0 * PI * 8.0) < 1e-12);
        assert!(mesh.is_smooth() && !mesh.was_turned());
    }
}

#[test]
fn box_has_the_counts_and_volume_it_promises() {
    let cube = Shape::Box { size: [2.0; 3] };
    for (wish, got) in [(12, 12), (1200, 1200), (2352, 2352), (1100, 1200)] {
        let mesh = cube.mesh(wish).unwrap();
        assert_eq!(mesh.triangles().len(), got, "asked for {wish}");
        assert!(relative(mesh.volume(), 8.0) < 1e-13);
        assert!(!mesh.is_smooth() && !mesh.was_turned());
    }
}

/// Ratio of the longest edge to the shortest height, 1.15 for an equilateral triangle.
fn worst_aspect(mesh: &TriMesh) -> f64 {
    let aspect = |t: usize| {
        let [a, b, c] = mesh.corners(t);
        let longest = [sub(b, a), sub(c, b), sub(a, c)]
            .into_iter()
            .map(norm)
            .fold(0.0, f64::max);
        longest * longest / (2.0 * mesh.area(t))
    };
    (0..mesh.triangles().len()).map(aspect).fold(0.0, f64::max)
}

fn centred(mesh: &TriMesh) -> bool {
    let [low, high] = mesh.bounding_box();
    norm(centroid(mesh)) < 1e-14 * norm(sub(high, low))
}

#[test]
fn round_bodies_have_the_volume_and_thickness_they_promise() {
    let t = 0.003;
    let (d, hole) = (0.1, 0.03);
    for (shape, volume, axis) in [
        (
            Shape::Disc {
                radius: 0.05,
                thickness: t,
            },
            PI * 0.0025 * t,
            1,
        ),
        (
            Shape::EllipticalPlate {
                semi_axes: [0.04, 0.01],
                thickness: t,
            },
            PI * 0.0004 * t,
            1,
        ),
        (
            Shape::Coin {
                diameter: d,
                thickness: t,
                hole: 0.0,
            },
            PI / 4.0 * d * d * t,
            1,
        ),
        (
            Shape::Coin {
                diameter: d,
                thickness: t,
                hole,
            },
            PI / 4.0 * (d * d - hole * hole) * t,
            1,
        ),
        (
            Shape::Washer {
                diameter: d,
                inner_diameter: 0.097,
                thickness: t,
            },
            PI / 4.0 * (d * d - 0.097 * 0.097) * t,
            1,
        ),
        (
            Shape::Cylinder {
                radius: 0.001,
                height: t,
            },
            PI * 1e-6 * t,
            0,
        ),
        (
            Shape::Cylinder {
                radius: 1e-5,
                height: t,
            },
            PI * 1e-10 * t,
            0,
        ),
    ] {
        for wish in [64, 100, 333, 1000, 1024, 4000] {
            let mesh = shape.mesh(wish).unwrap();
            let n = mesh.triangles().len();
            println!(
                "{shape:?} {wish} -> {n}, worst aspect {:.1}",
                worst_aspect(&mesh)
            );
            assert!(relative(mesh.volume(), volume) < 1e-12, "{shape:?} {wish}");
            let [low, high] = mesh.bounding_box();
            assert!(relative(high[axis] - low[axis], t) < 1e-14);
            assert!(centred(&mesh) && !mesh.was_turned(), "{shape:?} {wish}");
        }
    }
}

#[test]
fn plate_of_the_paper_has_1024_triangles() {
    let paper = Shape::EllipticalPlate {
        semi_axes: [0.04, 0.01],
        thickness: 1e-4,
    };
    assert_eq!(paper.mesh(1024).unwrap().triangles().len(), 1024);
}

#[test]
fn discs_have_near_equal_triangles_at_their_ends() {
    let mesh = Shape::Disc {
        radius: 1.0,
        thickness: 1e-3,
    }
    .mesh(2000)
    .unwrap();
    let ends = (0..mesh.triangles().len()).filter(|&t| mesh.normal(t)[1].abs() > 0.5);
    let areas: Vec<f64> = ends.map(|t| mesh.area(t)).collect();
    let mean = areas.iter().sum::<f64>() / areas.len() as f64;
    let extreme = |f: fn(f64, f64) -> f64| areas.iter().copied().reduce(f).unwrap() / mean;
    let (least, most) = (extreme(f64::min), extreme(f64::max));
    assert!(least > 0.6 && most < 1.6, "{least} {most}");
}

/// Meshes that mirror onto themselves: every vertex has its mirror image.
#[test]
fn meshes_have_the_symmetry_of_the_body() {
    for shape in [
        Shape::EllipticalPlate {
            semi_axes: [0.04, 0.01],
            thickness: 1e-4,
        },
        Shape::Cylinder {
            radius: 1.0,
            height: 3.0,
        },
        Shape::Box {
            size: [1.0, 2.0, 3.0],
        },
        Shape::Ellipsoid {
            semi_axes: [1.0, 2.0, 4.0],
        },
    ] {
        let mesh = shape.mesh(900).unwrap();
        let all = mesh.vertices();
        for axis in 0..3 {
            let has_image = |v: &[f64; 3]| {
                let mut image = *v;
                image[axis] = -image[axis];
                all.iter().any(|w| norm(sub(*w, image)) < 1e-14)
            };
            assert!(all.iter().all(has_image), "{shape:?} {axis}");
        }
    }
}

#[test]
fn paper_airplane_has_the_volume_of_its_sheet() {
    let (side, thickness) = (0.083, 1e-4);
    let airplane = Shape::PaperAirplane { side, thickness };
    for (wish, got) in [(24, 24), (288, 288), (1000, 1000), (3000, 3000)] {
        let mesh = airplane.mesh(wish).unwrap();
        let n = mesh.triangles().len();
        println!("{wish} -> {n}, worst aspect {:.1}", worst_aspect(&mesh));
        assert!(n.abs_diff(got) * 50 <= got, "asked for {wish}, got {n}");
        assert!(relative(mesh.volume(), side * side * thickness) < 1e-12);
        assert!(centred(&mesh) && !mesh.was_turned());
    }
    assert_eq!(airplane.mesh(288).unwrap().triangles().len(), 288);
}

#[test]
fn paper_airplane_points_along_x_and_is_symmetric() {
    let mesh = Shape::PaperAirplane {
        side: 0.083,
        thickness: 1e-4,
    }
    .mesh(288)
    .unwrap();
    let [low, high] = mesh.bounding_box();
    let at_nose = |v: &&[f64; 3]| v[0] > high[0] - 1e-6;
    let width = mesh
        .vertices()
        .iter()
        .filter(at_nose)
        .map(|v| v[2].abs())
        .fold(0.0, f64::max);
    assert!(width < 0.01 * (high[2] - low[2]), "the nose is pointed");
    assert!((high[2] + low[2]).abs() < 1e-12, "left and right");
    assert!(-low[1] > 2.0 * high[1], "the keel hangs below the wings");
    // Wing span and length by folding the sheet by hand: 2 L sin δ/cos 2δ and L cos δ/cos 2δ.
    assert!(relative(high[0] - low[0], 0.083 * 1.061_594) < 1e-6);
}

#[test]
fn no_triangle_of_a_generated_body_cuts_another() {
    for shape in [
        Shape::PaperAirplane {
            side: 0.083,
            thickness: 1e-4,
        },
        Shape::Ellipsoid {
            semi_axes: [1.0, 2.0, 4.0],
        },
        Shape::PaperAirplane {
            side: 0.05,
            thickness: 1e-3,
        },
        Shape::Washer {
            diameter: 1.0,
            inner_diameter: 0.97,
            thickness: 0.1,
        },
        Shape::Washer {
            diameter: 1.0,
            inner_diameter: 0.8,
            thickness: 0.1,
        },
        Shape::Washer {
            diameter: 1.0,
            inner_diameter: 0.5,
            thickness: 0.1,
        },
    ] {
        for wish in [64, 288] {
            // What meets itself is no body.
            assert_eq!(shape.mesh(wish).err(), None, "{shape:?} {wish}");
        }
    }
}

#[test]
fn impossible_shapes_are_refused_by_name() {
    let too_few =
        |shape: Shape, n| matches!(shape.mesh(n), Err(ShapeError::TooFewTriangles { .. }));
    assert!(too_few(
        Shape::Ellipsoid {
            semi_axes: [1.0; 3]
        },
        19
    ));
    assert!(too_few(Shape::Box { size: [1.0; 3] }, 11));
    assert!(too_few(
        Shape::Disc {
            radius: 1.0,
            thickness: 0.1
        },
        31
    ));
    assert!(too_few(
        Shape::PaperAirplane {
            side: 1.0,
            thickness: 0.001
        },
        23
    ));
    let many = Shape::Box { size: [1.0; 3] }.mesh(MAX_TRIANGLES + 1);
    assert_eq!(
        many,
        Err(ShapeError::TooManyTriangles {
            asked: MAX_TRIANGLES + 1
        })
    );

    let bad = |shape: Shape| shape.mesh(1000).unwrap_err().to_string();
    let message = bad(Shape::Ellipsoid {
        semi_axes: [1.0, -2.0, 1.0],
    });
    assert_eq!(
        message,
        "ellipsoid: semi-axis b = -2 m is impossible: it must be positive and finite"
    );
    assert!(
        bad(Shape::Coin {
            diameter: 1.0,
            thickness: f64::NAN,
            hole: 0.0
        })
        .contains("thickness")
    );
    let message = bad(Shape::Washer {
        diameter: 1.0,
        inner_diameter: 1.0,
        thickness: 0.1,
    });
    assert!(message.contains("inner_diameter = 1 m") && message.contains("smaller than the outer"));
}

#[test]
fn the_coarsest_sphere_is_the_regular_icosahedron() {
    let mesh = Shape::Ellipsoid {
        semi_axes: [1.0; 3],
    }
    .mesh(20)
    .unwrap();
    for edge in mesh.edges() {
        let [a, b] = edge.vertices.map(|v| mesh.vertices()[v as usize]);
        // Edge of the icosahedron with the volume of the unit sphere: V = 5/12 (3 + √5) a³.
        let expected = (4.0 / 3.0 * PI * 12.0 / 5.0 / (3.0 + 5f64.sqrt())).cbrt();
        assert!(relative(norm(sub(a, b)), expected) < 1e-14);
    }
}

#[test]
fn triangles_are_well_shaped() {
    for (shape, wish, worst) in [
        (
            Shape::Ellipsoid {
                semi_axes: [1.0; 3],
            },
            1280,
            1.5,
        ),
        (
            Shape::Ellipsoid {
                semi_axes: [1.0; 3],
            },
            980,
            1.6,
        ),
        (
            Shape::Box {
                size: [1.0, 2.0, 3.0],
            },
            1000,
            2.1,
        ),
        (
            Shape::Disc {
                radius: 1.0,
                thickness: 0.1,
            },
            1000,
            3.0,
        ),
        (
            Shape::Coin {
                diameter: 1.0,
                thickness: 0.1,
                hole: 0.4,
            },
            1000,
            3.0,
        ),
        (
            Shape::Cylinder {
                radius: 1.0,
                height: 5.0,
            },
            1000,
            3.0,
        ),
    ] {
        let aspect = worst_aspect(&shape.mesh(wish).unwrap());
        assert!(aspect < worst, "{shape:?}: {aspect}");
    }
}
