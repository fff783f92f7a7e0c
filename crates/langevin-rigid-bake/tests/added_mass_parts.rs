//! Added mass of bodies of several parts, against sums, images of dipoles and the body without its cavity.

use std::f64::consts::PI;

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{AddedMass, Options, added_mass};
use langevin_rigid_bake::shapes::Shape;

fn solve(mesh: &TriMesh) -> AddedMass {
    added_mass(mesh, &Options::default(), &()).expect("a body of moderate size")
}

fn ball(triangles: usize) -> TriMesh {
    let semi_axes = [1.0; 3];
    let ball = Shape::Ellipsoid { semi_axes }
        .mesh(triangles)
        .expect("a ball");
    // As from a file, which does not say that it is smooth.
    TriMesh::new(ball.vertices().to_vec(), ball.triangles().to_vec()).expect("a ball again")
}

/// One body of two meshes, the second scaled and shifted.
fn together(a: &TriMesh, b: &TriMesh, size: f64, by: [f64; 3]) -> TriMesh {
    let n = a.vertices().len() as u32;
    let place = |v: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|k| size * v[k] + by[k]) };
    TriMesh::new(
        a.vertices()
            .iter()
            .copied()
            .chain(b.vertices().iter().map(place))
            .collect(),
        a.triangles()
            .iter()
            .copied()
            .chain(b.triangles().iter().map(|t| t.map(|v| v + n)))
            .collect(),
    )
    .expect("two parts that do not meet")
}

fn assert_within(got: f64, want: f64, tolerance: f64) {
    let error = got / want - 1.0;
    assert!(
        error.abs() < tolerance,
        "{got} for {want}, off by {error:.2e}"
    );
}

/// Added mass of two unit balls, their centres `c` apart, that move as one along the line of centres: each
/// dipole has an image in the other ball (W. Hicks, 1880), and 4 pi of their sum is added mass and volume.
fn along_the_line_of_centres(c: f64) -> f64 {
    let (mut dipole, mut at, mut sum) = (0.5, 0.0, 0.0);
    for _ in 0..1000 {
        sum += dipole;
        let f = c - at;
        dipole *= -1.0 / (f * f * f);
        at = 1.0 / f;
    }
    2.0 * (4.0 * PI * sum - 4.0 / 3.0 * PI)
}

#[test]
fn two_balls_in_line_are_those_of_the_images() {
    let ball = ball(1280);
    // What this many triangles are off by for one ball.
    let facets = solve(&ball).tensor[0][0] / (2.0 / 3.0 * PI);
    for (c, tolerance) in [(2.1, 1.5e-3), (2.5, 5e-4), (4.0, 3e-4), (40.0, 3e-4)] {
        let found = solve(&together(&ball, &ball, 1.0, [c, 0.0, 0.0]));
        assert_within(
            found.tensor[0][0] / facets,
            along_the_line_of_centres(c),
            tolerance,
        );
    }
}

#[test]
fn two_balls_abreast_are_those_of_two_dipoles() {
    let (ball, c) = (ball(1280), 6.0);
    let facets = solve(&ball).tensor[0][0] / (2.0 / 3.0 * PI);
    let found = solve(&together(&ball, &ball, 1.0, [c, 0.0, 0.0]));
    // Each in the field of the other; fields that vary over a ball come in at (1/c)^8.
    let dipole = 0.5 / (1.0 - 0.5 / c.powi(3));
    let want = 2.0 * (4.0 * PI * dipole - 4.0 / 3.0 * PI);
    for k in [1, 2] {
        assert_within(found.tensor[k][k] / facets, want, 1e-4);
    }
}

#[test]
fn a_sealed_cavity_is_out_of_reach() {
    let ball = ball(320);
    let shell = together(&ball, &ball, 0.9, [0.05, 0.0, 0.0]);
    let (hollow, full) = (solve(&shell), solve(&ball));
    assert_eq!(hollow.tensor, full.tensor);
    assert_eq!(
        (hollow.surface, hollow.reference),
        (full.surface, full.reference)
    );
}

#[test]
fn parts_far_apart_add_up_however_they_are_solved() {
    // With a matrix, and the preconditioner for large bodies; with clusters.
    for triangles in [7000, 18_000] {
        let size = [2.0, 1.0, 0.5];
        let large = Shape::Box { size }.mesh(triangles).expect("a box");
        let small = Shape::Box { size: [1.0; 3] }.mesh(12).expect("a cube");
        let both = solve(&together(&large, &small, 0.5, [0.0, 0.0, 40.0]));
        let alone = solve(&large);
        for k in 0..3 {
            // 0.638 of the volume of a cube, on few triangles.
            let found = both.tensor[k][k] - alone.tensor[k][k];
            assert_within(found, 0.6384 * 0.125, 0.03);
        }
    }
}
