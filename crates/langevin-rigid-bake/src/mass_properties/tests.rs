use super::*;
use crate::mesh::vector::mat_vec;
use crate::shapes::Shape;
use proptest::prelude::*;

fn close(a: [[f64; 3]; 3], b: [[f64; 3]; 3], tolerance: f64) -> bool {
    let largest = b.as_flattened().iter().fold(0.0f64, |m, x| m.max(x.abs()));
    (0..3).all(|i| (0..3).all(|j| (a[i][j] - b[i][j]).abs() <= tolerance * largest))
}

fn rotated(m: [[f64; 3]; 3], r: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(r[i], mat_vec(&m, r[j]))))
}

fn rotation(q: [f64; 4]) -> [[f64; 3]; 3] {
    let n = 1.0 / q.iter().map(|c| c * c).sum::<f64>().sqrt();
    langevin_rigid::linalg::rotation_matrix(q.map(|c| c * n))
}

#[test]
fn box_is_exact() {
    let [a, b, c] = [0.3, 0.02, 1.1];
    let mesh = Shape::Box { size: [a, b, c] }.mesh(500).unwrap();
    let got = MassProperties::of(&mesh, 700.0).unwrap();
    let m = 700.0 * a * b * c;
    let expected = [
        [m / 12.0 * (b * b + c * c), 0.0, 0.0],
        [0.0, m / 12.0 * (a * a + c * c), 0.0],
        [0.0, 0.0, m / 12.0 * (a * a + b * b)],
    ];
    assert!((got.mass / m - 1.0).abs() < 1e-13);
    assert!(close(got.inertia, expected, 1e-13));
    assert!(got.centroid.iter().all(|x| x.abs() < 1e-15));
}

#[test]
fn corner_tetrahedron_is_exact() {
    // Closed forms of the tetrahedron 0, (a,0,0), (0,b,0), (0,0,c): centroid at a quarter,
    // ∫x² = a³bc/60 and ∫xy = a²b²c/120 about the corner.
    let [a, b, c] = [2.0, 3.0, 5.0];
    let vertices = vec![[0.0; 3], [a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let got = MassProperties::of(&TriMesh::new(vertices, triangles).unwrap(), 1.0).unwrap();
    let volume = a * b * c / 6.0;
    assert!((got.volume - volume).abs() < 1e-14);
    for (x, edge) in got.centroid.into_iter().zip([a, b, c]) {
        assert!((x - edge / 4.0).abs() < 1e-14);
    }
    let ixx = volume * (b * b + c * c) * (1.0 / 10.0 - 1.0 / 16.0);
    let ixy = -volume * a * b * (1.0 / 20.0 - 1.0 / 16.0);
    assert!((got.inertia[0][0] - ixx).abs() < 1e-13);
    assert!((got.inertia[0][1] - ixy).abs() < 1e-13);
}

#[test]
fn ellipsoid_converges_to_its_closed_form_at_second_order() {
    let [a, b, c] = [1.0, 2.0, 4.0];
    let error = |n| {
        let mesh = Shape::Ellipsoid {
            semi_axes: [a, b, c],
        }
        .mesh(n)
        .unwrap();
        let got = MassProperties::of(&mesh, 1.0).unwrap();
        got.inertia[0][0] / (got.mass / 5.0 * (b * b + c * c)) - 1.0
    };
    let (coarse, fine) = (error(1280), error(5120));
    assert!(coarse.abs() < 2e-4, "{coarse}");
    assert!(fine.abs() < coarse.abs() / 3.5, "{coarse} {fine}");
}

#[test]
fn overrides_replace_what_they_say() {
    let mesh = Shape::Box {
        size: [1.0, 2.0, 3.0],
    }
    .mesh(12)
    .unwrap();
    let body = MassProperties::of(&mesh, 2.0).unwrap();
    let heavier = body.with_mass(24.0).unwrap();
    assert_eq!((heavier.mass, heavier.density()), (24.0, 4.0));
    assert!(close(
        heavier.inertia,
        body.inertia.map(|r| scale(2.0, r)),
        1e-15
    ));
    assert_eq!(body.with_density(4.0).unwrap().mass, 24.0);
    let moved = body.with_centre_of_mass([0.1, 0.0, 0.0]).unwrap();
    assert_eq!(
        (moved.centre_of_mass, moved.inertia),
        ([0.1, 0.0, 0.0], body.inertia)
    );
    let given = [[3.0, 0.1, 0.0], [0.1, 4.0, 0.0], [0.0, 0.0, 5.0]];
    assert_eq!(body.with_inertia(given).unwrap().inertia, given);
}

#[test]
fn impossible_values_are_refused_by_name() {
    let mesh = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    assert!(matches!(
        MassProperties::of(&mesh, -1.0),
        Err(MassError::Negative { .. })
    ));
    let body = MassProperties::of(&mesh, 1.0).unwrap();
    assert!(matches!(
        body.with_mass(0.0).unwrap().with_mass(1.0),
        Err(MassError::NotPositive { .. })
    ));
    assert!(matches!(
        body.with_density(f64::NAN),
        Err(MassError::Negative { .. })
    ));
    let nowhere = [f64::INFINITY, 0.0, 0.0];
    assert!(matches!(
        body.with_centre_of_mass(nowhere),
        Err(MassError::NotFinite { .. })
    ));
    let diagonal = |a, b, c| body.with_inertia([[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]);
    assert!(
        diagonal(1.0, 1.0, 2.0).is_ok(),
        "a flat body meets the inequality with equality"
    );
    assert!(matches!(
        diagonal(1.0, 1.0, 2.1),
        Err(MassError::TriangleInequality { .. })
    ));
    assert!(matches!(
        diagonal(1.0, -1.0, 1.0),
        Err(MassError::NotPositiveDefinite { .. })
    ));
    assert!(matches!(
        diagonal(1.0, f64::NAN, 1.0),
        Err(MassError::NotFinite { .. })
    ));
    let skew = body.with_inertia([[1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(matches!(
        skew,
        Err(MassError::NotSymmetric {
            row: 0,
            column: 1,
            ..
        })
    ));
    // Positive diagonal, negative eigenvalue: 1 ± 1.5.
    let indefinite = body.with_inertia([[1.0, 1.5, 0.0], [1.5, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(matches!(
        indefinite,
        Err(MassError::NotPositiveDefinite { .. })
    ));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    /// A rigid motion by up to 1000 body lengths moves the centroid, turns the inertia and
    /// changes nothing else; a uniform scale a multiplies by a³ and a⁵.
    #[test]
    fn similarity_transforms_act_as_they_must(
        q in prop::array::uniform4(-1.0..1.0f64).prop_filter("not zero", |q| q.iter().any(|x| x.abs() > 0.1)),
        shift in prop::array::uniform3(-2000.0..2000.0f64),
        factor in 0.1..10.0f64,
        size in prop::array::uniform3(0.5..2.0f64),
    ) {
        let vertices = vec![[0.0; 3], [size[0], 0.0, 0.0], [0.1, size[1], 0.0], [0.3, 0.2, size[2]]];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let mesh = TriMesh::new(vertices, triangles).unwrap();
        let before = MassProperties::of(&mesh, 3.0).unwrap();
        let r = rotation(q);
        let moved = mesh.transformed(r, shift, 1.0).unwrap();
        let after = MassProperties::of(&moved, 3.0).unwrap();
        prop_assert!((after.volume / before.volume - 1.0).abs() < 1e-10);
        prop_assert!(close(after.inertia, rotated(before.inertia, &r), 1e-10));
        let expected = add(mat_vec(&r, before.centroid), shift);
        prop_assert!((0..3).all(|k| (after.centroid[k] - expected[k]).abs() < 1e-11));

        let scaled = MassProperties::of(&mesh.transformed(crate::mesh::vector::IDENTITY, [0.0; 3], factor).unwrap(), 3.0).unwrap();
        prop_assert!((scaled.mass / (before.mass * factor.powi(3)) - 1.0).abs() < 1e-12);
        let fifth = factor.powi(5);
        prop_assert!(close(scaled.inertia, before.inertia.map(|row| scale(fifth, row)), 1e-12));
    }

    /// Eigenvalues of R diag R^T are the diagonal.
    #[test]
    fn principal_moments_survive_rotation(
        q in prop::array::uniform4(0.1..1.0f64),
        moments in prop::array::uniform3(-5.0..5.0f64),
    ) {
        let mut diagonal = [[0.0; 3]; 3];
        for k in 0..3 {
            diagonal[k][k] = moments[k];
        }
        let mut sorted = moments;
        sorted.sort_unstable_by(f64::total_cmp);
        let got = principal_moments(rotated(diagonal, &rotation(q)));
        prop_assert!((0..3).all(|k| (got[k] - sorted[k]).abs() < 1e-13));
    }
}

#[test]
fn a_cavity_floats_and_weighs_nothing() {
    let brick = |size| Shape::Box { size }.mesh(12).unwrap();
    let (outer, inner) = (brick([0.4, 0.2, 0.1]), brick([0.1, 0.1, 0.05]));
    let n = outer.vertices().len() as u32;
    let off = inner.vertices().iter().map(|v| [v[0] + 0.1, v[1], v[2]]);
    let within = inner.triangles().iter().map(|t| t.map(|v| v + n));
    let shell = TriMesh::new(
        outer.vertices().iter().copied().chain(off).collect(),
        outer.triangles().iter().copied().chain(within).collect(),
    );
    let got = MassProperties::of(&shell.unwrap(), 1000.0).unwrap();
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-12, "{got} for {want}");
    close(got.volume, 8e-3);
    close(got.mass, 7.5);
    close(got.density(), 937.5);
    got.centroid.into_iter().for_each(|x| close(x, 0.0));
    let x = -0.5 * 0.1 / 7.5;
    close(got.centre_of_mass[0], x);
    let whole = 8.0 / 12.0 * (0.16 + 0.01);
    let hole = 0.5 / 12.0 * (0.01 + 0.0025) + 0.5 * 0.01;
    close(got.inertia[1][1], whole - hole - 7.5 * x * x);
}

#[test]
fn a_body_of_any_scale_has_its_properties_or_a_reason_why_not() {
    let tetrahedron = |size: f64, away: f64| {
        let vertices = vec![
            [away, 0.0, 0.0],
            [away + size, 0.0, 0.0],
            [away, size, 0.0],
            [away, 0.0, size],
        ];
        TriMesh::new(vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    };
    for exponent in -307..=307 {
        let size = libm::pow(10.0, f64::from(exponent));
        let Ok(mesh) = tetrahedron(size, 0.0) else {
            continue;
        };
        match MassProperties::of(&mesh, 1.0) {
            // The volume goes with the cube, the inertia with the fifth power of the size.
            Ok(got) => {
                let moment = got.inertia[0][0] / got.volume / size / size;
                assert!((moment - 0.075).abs() < 1e-12, "{size:e}: {moment}");
            }
            Err(error) => assert!(
                matches!(error, MassError::Scale { .. }) && !(-50..=50).contains(&exponent),
                "{size:e}: {error}"
            ),
        }
    }
    for away in [1e20, 1e160, 1e300] {
        if let Ok(mesh) = tetrahedron(1.0, away) {
            assert!(MassProperties::of(&mesh, 1.0).is_err(), "{away:e}");
        }
    }
    let body = MassProperties::of(&tetrahedron(1e3, 0.0).unwrap(), 1.0).unwrap();
    let heavy = body.with_mass(f64::MAX).unwrap_err();
    assert!(matches!(heavy, MassError::Scale { .. }), "{heavy}");
}

#[test]
fn inertias_near_the_ends_of_the_range_are_judged() {
    let uniform = |x: f64| [[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]];
    assert!(check_inertia(uniform(1e300)).is_ok());
    assert!(check_inertia(uniform(1e-300)).is_ok());
    let huge = [[f64::MAX; 3]; 3];
    assert!(check_inertia(huge).is_err());
}
