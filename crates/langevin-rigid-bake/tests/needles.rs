//! Added mass of meshes with needles: fans, cones, spikes, stars.
//!
//! Very many long, thin triangles at one vertex are ordinary output of CAD. What they cost must grow with
//! the mesh and not with its square, and what they give is the tensor of the body: that of an even mesh of
//! the same shape.

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{AddedMass, AddedMassError, Options, added_mass, expected};
use langevin_rigid_bake::progress::Progress;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

type Vec3 = [f64; 3];

/// Most triangles solved on: the layer cuts a triangle in four at most.
fn bound(given: usize) -> usize {
    4 * (8 * given + 4 * Options::default().target_triangles)
}

/// A body of revolution about Z through `profile` (r, z), poles at its ends, with `n` triangles around
/// each; `radius` of the direction scales r.
fn turned(profile: &[[f64; 2]], n: usize, radius: impl Fn(usize) -> f64) -> TriMesh {
    let last = profile.len() - 1;
    let mut vertices: Vec<Vec3> = vec![[0.0, 0.0, profile[0][1]], [0.0, 0.0, profile[last][1]]];
    for [r, z] in &profile[1..last] {
        vertices.extend((0..n).map(|i| {
            let (angle, r) = (TAU * i as f64 / n as f64, r * radius(i));
            [r * libm::cos(angle), r * libm::sin(angle), *z]
        }));
    }
    let at = |ring: usize, i: usize| (2 + ring * n + i % n) as u32;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, at(0, i + 1), at(0, i)]);
        triangles.push([1, at(last - 2, i), at(last - 2, i + 1)]);
        for k in 0..last - 2 {
            triangles.push([at(k, i), at(k, i + 1), at(k + 1, i)]);
            triangles.push([at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)]);
        }
    }
    TriMesh::new(vertices, triangles).expect("a body of revolution")
}

fn cone(n: usize) -> TriMesh {
    turned(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], n, |_| 1.0)
}

fn solve(mesh: &TriMesh) -> AddedMass {
    let result = added_mass(mesh, &Options::default(), &()).expect("a body has a tensor");
    assert_sound(mesh, &result);
    result
}

/// Finite, symmetric, of no negative energy, on a bounded number of panels, with potentials at every
/// vertex given.
fn assert_sound(mesh: &TriMesh, result: &AddedMass) {
    let tensor = &result.tensor;
    assert!(tensor.iter().flatten().all(|x| x.is_finite()), "{tensor:?}");
    for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
        assert_eq!(tensor[i][j], tensor[j][i]);
        // Of a positive semidefinite matrix no minor is negative, but for the error.
        let largest = |k: usize| {
            let block = k / 3 * 3;
            (block..block + 3).map(|k| tensor[k][k]).fold(0.0, f64::max)
        };
        let error = 2.0 * result.error_estimate + 1e-9;
        let size = |k: usize| (tensor[k][k] + error * largest(k)).sqrt();
        assert!(
            tensor[i][j].abs() <= size(i) * size(j),
            "{i} {j}: {tensor:?}"
        );
    }
    let surface = &result.surface;
    let given = mesh.triangles().len();
    assert!(surface.triangles.len() <= bound(given));
    assert_eq!(&surface.vertices[..mesh.vertices().len()], mesh.vertices());
    assert_eq!(surface.potentials.len(), surface.vertices.len());
    assert!(surface.potentials.iter().flatten().all(|x| x.is_finite()));
}

fn assert_same(got: &AddedMass, want: &AddedMass, tolerance: f64) {
    for block in [0, 3] {
        let largest = (block..block + 3)
            .map(|k| want.tensor[k][k])
            .fold(0.0, f64::max);
        for (i, j) in (block..block + 3).flat_map(|i| (block..block + 3).map(move |j| (i, j))) {
            let error = (got.tensor[i][j] - want.tensor[i][j]) / largest;
            assert!(error.abs() < tolerance, "{i} {j}: {error:e}");
        }
    }
}

#[test]
fn a_cone_of_needles_is_a_cone_of_rings() {
    // Even triangles: rings a twelfth of the slope apart.
    let rings = 12u32;
    let slope = (1..rings).map(|k| {
        let s = f64::from(k) / f64::from(rings);
        [1.0 - s, s]
    });
    let base = (1..=rings).map(|k| [f64::from(k) / f64::from(rings), 0.0]);
    let profile: Vec<[f64; 2]> = [[0.0, 0.0]]
        .into_iter()
        .chain(base)
        .chain(slope)
        .chain([[0.0, 1.0]])
        .collect();
    let even = solve(&turned(&profile, 60, |_| {
        // The polygon of 60 sides has the area of the circle.
        (TAU / 60.0 / libm::sin(TAU / 60.0)).sqrt()
    }));
    for n in [300, 2000] {
        let needles = solve(&cone(n));
        assert_same(&needles, &even, 5e-3);
        assert!(needles.error_estimate < 0.02);
        assert!(needles.quality.triangles_solved < 8000);
    }
}

#[test]
fn potentials_at_vertices_merged_are_those_of_the_flow() {
    // Moving along Z a body of revolution has the same potential all around its rim.
    let mesh = cone(1000);
    let result = solve(&mesh);
    let rim: Vec<[f64; 6]> = (2..1002).map(|v| result.surface.potentials[v]).collect();
    let mean = rim.iter().map(|p| p[2]).sum::<f64>() / 1000.0;
    let all = result.surface.potentials.iter();
    let largest = all.fold(0.0, |l: f64, p| l.max(p[2].abs()));
    for (i, p) in rim.iter().enumerate() {
        assert!((p[2] - mean).abs() < 0.01 * largest, "{i}: {} {mean}", p[2]);
        let angle = TAU * i as f64 / 1000.0;
        let turned = p[0] * libm::sin(angle) - p[1] * libm::cos(angle);
        assert!(turned.abs() < 0.01 * largest, "{i}: {turned}");
    }
}

#[test]
fn very_many_needles_are_solved_on_few_panels() {
    let profile = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let cylinder = turned(&profile, 20_000, |_| 1.0);
    let expected = expected(&cylinder, &Options::default()).unwrap();
    assert!(expected.triangles_solved < 10_000, "{expected:?}");
}

#[test]
fn flutes_are_kept_and_their_pairs_are_bounded() {
    // Every second radius is a tenth longer: no needle may go.
    let flutes = |n: usize| {
        let radius = |i: usize| 1.0 + 0.1 * (i % 2) as f64;
        turned(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], n, radius)
    };
    let mesh = flutes(300);
    let result = solve(&mesh);
    assert!(result.quality.quadrature_error < 0.01);
    let error = added_mass(&flutes(20_000), &Options::default(), &()).unwrap_err();
    assert!(matches!(error, AddedMassError::TooCrowded { .. }));
    assert!(error.to_string().contains("--proxy"), "{error}");
}

#[test]
fn a_spike_of_few_triangles_stays_small() {
    let spike = TriMesh::new(
        vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.3, 0.3, 1000.0],
        ],
        vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
    .unwrap();
    solve(&spike);
}

#[test]
fn a_long_spike_takes_few_iterations() {
    // A box of twelve triangles, one corner of which is drawn out.
    let spike = |length: f64| {
        let vertices = vec![
            [0.0, -0.5, -0.5],
            [-0.5, 0.5, -0.5],
            [-0.5, 0.5, 0.5],
            [-0.5, -0.5, length],
            [0.5, -0.5, -0.5],
            [0.5, 0.5, -0.5],
            [0.5, 0.5, 0.5],
            [0.5, -0.5, 0.5],
        ];
        let mut triangles = vec![
            [0, 2, 1],
            [0, 3, 2],
            [4, 5, 6],
            [4, 6, 7],
            [0, 7, 3],
            [0, 4, 7],
        ];
        triangles.extend([
            [1, 2, 6],
            [1, 6, 5],
            [0, 5, 4],
            [0, 1, 5],
            [3, 7, 6],
            [3, 6, 2],
        ]);
        TriMesh::new(vertices, triangles).expect("a spike")
    };
    for length in [1e3, 5e4, 1e6] {
        let quality = solve(&spike(length)).quality;
        assert!(quality.residual <= 1e-6, "{length}: {quality:?}");
        assert!(quality.iterations < 60, "{length}: {quality:?}");
    }
}

#[test]
fn random_fans_stars_and_needles_give_tensors() {
    let fans = (
        3usize..150,
        -2.0..2.0f64,
        -4.0..1.0f64,
        prop::collection::vec(0.0..1.0f64, 150),
    );
    let config = Config {
        cases: 6,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, deterministic())
        .run(&fans, |(n, height, roughness, radii)| {
            let [height, roughness] = [height, roughness].map(|x: f64| libm::pow(10.0, x));
            let radius = |i: usize| 1.0 / (1.0 + roughness * radii[i]);
            let mesh = turned(
                &[[0.0, -0.3 * height], [1.0, 0.0], [0.0, height]],
                n,
                radius,
            );
            solve(&mesh);
            Ok(())
        })
        .unwrap();
}

#[test]
fn random_tetrahedra_of_any_size_give_tensors_or_say_why() {
    let coordinate = || (-30.0..30.0f64, any::<bool>());
    let corners = prop::collection::vec([coordinate(), coordinate(), coordinate()], 4);
    let config = Config {
        cases: 15,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, deterministic())
        .run(
            &(corners, 0.0..1.0f64, -70.0..70.0f64),
            |(corners, spread, size)| {
                let number = |(power, negative): (f64, bool)| {
                    let x = libm::pow(10.0, size + spread * 0.2 * power);
                    if negative { -x } else { x }
                };
                let vertices = corners.iter().map(|c| c.map(number)).collect();
                let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
                if let Ok(mesh) = TriMesh::new(vertices, triangles) {
                    match added_mass(&mesh, &Options::default(), &()) {
                        Ok(result) => assert_sound(&mesh, &result),
                        Err(error) => assert!(!error.to_string().is_empty()),
                    }
                }
                Ok(())
            },
        )
        .unwrap();
}

fn deterministic() -> prop::test_runner::TestRng {
    prop::test_runner::TestRng::deterministic_rng(prop::test_runner::RngAlgorithm::ChaCha)
}

#[test]
fn a_million_triangles_are_refused() {
    // A barrel of rings: no crowd of needles, in which the mesh would first be searched for what meets.
    let rings = 1000;
    let side = (0..=rings).map(|k| [1.0, f64::from(k) / f64::from(rings)]);
    let profile: Vec<[f64; 2]> = [[0.0, 0.0]]
        .into_iter()
        .chain(side)
        .chain([[0.0, 1.0]])
        .collect();
    let cylinder = turned(&profile, 500, |_| 1.0);
    let error = added_mass(&cylinder, &Options::default(), &()).unwrap_err();
    assert!(matches!(
        error,
        AddedMassError::TooLarge {
            triangles: 1_001_000,
            ..
        }
    ));
    assert!(error.to_string().contains("--proxy"), "{error}");
}

/// Cancels after a while.
struct Later {
    started: Instant,
    after: Duration,
}

impl Progress for Later {
    fn cancelled(&self) -> bool {
        self.started.elapsed() > self.after
    }
}

#[test]
fn work_stops_soon_wherever_it_is() {
    let flutes = turned(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 1000, |i| {
        1.0 + 0.1 * (i % 2) as f64
    });
    for milliseconds in [1, 100, 500, 2000] {
        let later = Later {
            started: Instant::now(),
            after: Duration::from_millis(milliseconds),
        };
        let error = added_mass(&flutes, &Options::default(), &later).unwrap_err();
        assert_eq!(error, AddedMassError::Cancelled);
        let late = later.started.elapsed() - later.after;
        assert!(late < Duration::from_secs(3), "{late:?}");
    }
}
