use std::f64::consts::{PI, TAU};

use super::*;
use crate::mesh::{MeshError, TriMesh};
use crate::shapes::Shape;

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn mesh(shape: &Shape, triangles: usize) -> Mesh {
    let mesh = shape.mesh(triangles).unwrap();
    (mesh.vertices().to_vec(), mesh.triangles().to_vec())
}

fn cube(triangles: usize) -> Mesh {
    mesh(&Shape::Box { size: [1.0; 3] }, triangles)
}

fn ball(triangles: usize) -> Mesh {
    mesh(
        &Shape::Ellipsoid {
            semi_axes: [1.0; 3],
        },
        triangles,
    )
}

/// Both, the second scaled and shifted.
fn with(a: &Mesh, b: &Mesh, size: f64, by: [f64; 3]) -> Mesh {
    let n = a.0.len() as u32;
    let place = |v: &[f64; 3]| add(scale(size, *v), by);
    (
        a.0.iter().copied().chain(b.0.iter().map(place)).collect(),
        a.1.iter()
            .copied()
            .chain(b.1.iter().map(|t| t.map(|v| v + n)))
            .collect(),
    )
}

fn meet((vertices, triangles): &Mesh) -> bool {
    !meetings(vertices, triangles).is_empty()
}

/// Two tubes of a closed curve given by its radius and height.
fn tube(radius: impl Fn(f64) -> f64, turns: usize, thick: f64) -> Mesh {
    let around = 12;
    let vertices = (0..turns).flat_map(|i| {
        let angle = TAU * i as f64 / turns as f64;
        let r = radius(angle);
        (0..around).map(move |k| {
            let about = TAU * k as f64 / around as f64;
            let out = r + thick * about.cos();
            [out * angle.cos(), out * angle.sin(), thick * about.sin()]
        })
    });
    let at = |i: usize, k: usize| ((i % turns) * around + k % around) as u32;
    let triangles = (0..turns).flat_map(|i| {
        (0..around).flat_map(move |k| {
            let [a, b, c, d] = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
            [[a, b, c], [a, c, d]]
        })
    });
    (vertices.collect(), triangles.collect())
}

#[test]
fn parts_meet_where_they_touch_or_overlap() {
    let cube = cube(300);
    for (by, size, wanted) in [
        ([0.0; 3], 0.5, false),
        ([1.1, 0.0, 0.0], 1.0, false),
        ([1.0, 0.0, 0.0], 1.0, true),
        ([1.0 + 1e-8, 0.2, 0.1], 1.0, true),
        ([1.0 - 1e-8, 0.2, 0.1], 1.0, true),
        ([1.0 + 1e-5, 0.2, 0.1], 1.0, false),
        ([0.25, 0.0, 0.0], 0.5, true),
        ([0.24, 0.0, 0.0], 0.5, false),
        ([0.3, 0.4, 0.5], 1.0, true),
        ([0.3, 0.0, 0.0], 1.0, true),
        // Of the same corners and sides: along an edge, and in a point.
        ([1.0, 1.0, 0.0], 1.0, false),
        ([1.0, 1.0, 1.0], 1.0, false),
        ([0.0; 3], 1.0, true),
    ] {
        assert_eq!(meet(&with(&cube, &cube, size, by)), wanted, "{by:?} {size}");
        assert_eq!(
            meet(&with(&cube, &super::tests::cube(12), size, by)),
            wanted,
            "{by:?} {size}"
        );
    }
    let ball = ball(1280);
    for (x, wanted) in [(2.01, false), (1.99, true), (0.01, true)] {
        assert_eq!(meet(&with(&ball, &ball, 1.0, [x, 0.0, 0.0])), wanted, "{x}");
    }
    // Its equator lies in the plane of a face.
    assert!(meet(&with(
        &cube,
        &tube(|_| 0.3, 16, 0.1),
        1.0,
        [0.0, 0.0, 0.5]
    )));
}

#[test]
fn a_tube_that_runs_through_itself_is_seen_and_one_that_does_not_is_not() {
    assert!(!meet(&tube(|_| 1.0, 60, 0.2)));
    assert!(!meet(&tube(|a| 1.0 + 0.3 * (3.0 * a).cos(), 120, 0.2)));
    // A spindle torus.
    let spindle = tube(|_| 0.15, 60, 0.2);
    assert!(matches!(
        TriMesh::new(spindle.0, spindle.1),
        Err(MeshError::SelfIntersection { .. })
    ));
}

#[test]
fn the_place_is_on_both_and_the_count_is_of_triangles() {
    let cube = cube(12);
    let both = with(&cube, &cube, 0.5, [0.5, 0.13, 0.07]);
    let found = meetings(&both.0, &both.1);
    // Two of the large face, and the two of each side of the small cube.
    assert_eq!(found.len(), 10);
    assert!(found.iter().all(|m| (m.position[0] - 0.5).abs() < 1e-12));
    assert!(matches!(
        TriMesh::new(both.0, both.1),
        Err(MeshError::PartsMeet { count: 10, .. })
    ));
}

#[test]
fn a_flap_folded_flat_lies_on_its_neighbour() {
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.3, 1.0, 0.0], [0.5, 0.7, 0.0]];
    assert!(meet(&(vertices.clone(), vec![[0, 1, 2], [1, 0, 3]])));
    let mut open = vertices;
    open[3] = [0.5, -0.7, 0.0];
    assert!(!meet(&(open, vec![[0, 1, 2], [1, 0, 3]])));
}

#[test]
fn rounding_to_single_precision_makes_no_meetings() {
    let round = |m: &Mesh, by: f64| -> Mesh {
        let v =
            m.0.iter()
                .map(|v| v.map(|x| f64::from((0.1 * x + by) as f32)));
        (v.collect(), m.1.clone())
    };
    let shapes = [
        (
            Shape::Box {
                size: [1.0, 0.3, 0.7],
            },
            6000,
        ),
        (
            Shape::Disc {
                radius: 1.0,
                thickness: 0.01,
            },
            3000,
        ),
        (
            Shape::Ellipsoid {
                semi_axes: [1.0, 0.5, 0.1],
            },
            5120,
        ),
    ];
    let turn = |v: [f64; 3]| {
        let (s, c) = (0.7f64.sin(), 0.7f64.cos());
        let v = [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
        [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]]
    };
    for (shape, triangles) in shapes {
        let (v, t) = mesh(&shape, triangles);
        let turned = (v.into_iter().map(turn).collect(), t);
        for by in [0.0, PI] {
            assert!(!meet(&round(&turned, by)), "{shape:?} {by}");
        }
    }
}
