//! Added mass against closed forms, tables and the symmetries of potential flow.
//!
//! The fluid's kinetic energy around a moving body is half the added-mass tensor in its velocity.
//! Lamb's ellipsoids pin the smooth part of the scheme, cubes, prisms and plates the treatment of
//! edges, where potentials have infinite gradients and an untreated mesh is percents too low. A
//! wrong sign or factor shows as errors of order one; a broken edge layer, extrapolation or outer
//! quadrature as errors of 0.5 % and more; a mesh-dependent decision left to rounding as a tensor
//! that changes by 1e-5 when the body is turned.

use langevin_rigid::shift_added_mass;
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{AddedMass, AddedMassError, Options, Warning, added_mass};
use langevin_rigid_bake::mesh::weld;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;

type Six = [[f64; 6]; 6];

const CUBE: [f64; 2] = [0.638423, 0.03926];

fn solve(mesh: &TriMesh) -> AddedMass {
    added_mass(mesh, &Options::default(), &()).expect("a body of moderate size")
}

fn assert_within(got: f64, want: f64, tolerance: f64, what: &str) {
    let error = got / want - 1.0;
    assert!(
        error.abs() < tolerance,
        "{what}: {got} for {want}, off by {:.4} %",
        100.0 * error
    );
}

/// Lamb's (1932) added mass of an ellipsoid: three translations, three rotations.
fn lamb(axes: [f64; 3]) -> [f64; 6] {
    let [a, b, c] = axes;
    let volume = 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
    let kappa = kappa(axes);
    std::array::from_fn(|i| {
        if i < 3 {
            return volume * kappa[i] / (2.0 - kappa[i]);
        }
        let (j, k) = ((i - 2) % 3, (i - 1) % 3);
        let (x, y) = (axes[j] * axes[j], axes[k] * axes[k]);
        let difference = kappa[k] - kappa[j];
        volume / 5.0 * (x - y) * (x - y) * difference / (2.0 * (x - y) - (x + y) * difference)
    })
}

/// kappa_i = int_0^inf a b c dL / ((r_i^2 + L) sqrt(...)), by the double exponential rule.
fn kappa(axes: [f64; 3]) -> [f64; 3] {
    let mut kappa = [0.0; 3];
    let step = 1.0 / 128.0;
    for i in -640..=640 {
        let s = f64::from(i) * step;
        let l = libm::exp(std::f64::consts::FRAC_PI_2 * libm::sinh(s));
        let weight = step * l * std::f64::consts::FRAC_PI_2 * libm::cosh(s);
        let root: f64 = axes.iter().map(|r| (r * r + l).sqrt()).product();
        for (sum, r) in kappa.iter_mut().zip(axes) {
            *sum += weight * axes.iter().product::<f64>() / ((r * r + l) * root);
        }
    }
    kappa
}

#[test]
fn kappa_is_the_tabulated_one() {
    assert!((kappa([1.0, 2.0, 4.0]).iter().sum::<f64>() - 2.0).abs() < 1e-12);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
    let table = [1.518061, 0.398172, 0.126571, 0.580722, 3.313726, 0.406198];
    for (got, want) in lamb([1.0, 2.0, 4.0]).into_iter().zip(table) {
        assert!(
            (got / volume - want).abs() < 6e-7,
            "{} {want}",
            got / volume
        );
    }
}

#[test]
fn ellipsoids_agree_with_lamb() {
    for (semi_axes, tolerance) in [
        ([1.0, 2.0, 4.0], 1e-3),
        ([4.0, 1.0, 0.5], 1e-3),
        ([4.0, 1.0, 0.005], 5e-3),
    ] {
        let result = solve(&Shape::Ellipsoid { semi_axes }.mesh(1280).unwrap());
        for (i, want) in lamb(semi_axes).into_iter().enumerate() {
            assert_within(
                result.tensor[i][i],
                want,
                tolerance,
                &format!("{semi_axes:?} {i}"),
            );
        }
        assert_eq!(result.quality.triangles_solved, 1280);
    }
}

#[test]
fn an_ellipsoid_from_a_file_needs_no_mark() {
    let semi_axes = [1.0, 2.0, 4.0];
    let marked = Shape::Ellipsoid { semi_axes }.mesh(1280).unwrap();
    let result = solve(&remade(&marked));
    for (i, want) in lamb(semi_axes).into_iter().enumerate() {
        assert_within(result.tensor[i][i], want, 1e-3, &format!("{i}"));
    }
}

fn remade(mesh: &TriMesh) -> TriMesh {
    TriMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).expect("a body again")
}

#[test]
fn inscribed_spheres_converge_with_the_square_of_the_mesh_size() {
    let error = |triangles: usize| {
        let sphere = Shape::Ellipsoid {
            semi_axes: [1.0; 3],
        }
        .mesh(triangles)
        .unwrap();
        let radius = sphere.vertices()[0]
            .iter()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt();
        // Scaled so that the vertices are on the unit sphere.
        let tensor = solve(&sphere).tensor;
        let want = 2.0 / 3.0 * std::f64::consts::PI;
        1.0 - tensor[0][0] / (radius * radius * radius) / want
    };
    let ratio = error(320) / error(1280);
    assert!((3.8..4.2).contains(&ratio), "{ratio}");
}

fn assert_cube(mesh: &TriMesh, translation: f64, rotation: f64) -> AddedMass {
    let result = solve(mesh);
    for k in 0..3 {
        assert_within(result.tensor[k][k], CUBE[0], translation, "translation");
        assert_within(result.tensor[3 + k][3 + k], CUBE[1], rotation, "rotation");
    }
    result
}

#[test]
fn cubes_agree_with_graded_meshes() {
    let cube = Shape::Box { size: [1.0; 3] };
    let fine = assert_cube(&cube.mesh(1200).unwrap(), 1e-3, 1e-3);
    assert_eq!(
        (fine.quality.triangles_given, fine.quality.triangles_solved),
        (1200, 2064)
    );
    assert!(fine.warnings.is_empty(), "{:?}", fine.warnings);
    assert_cube(&cube.mesh(12).unwrap(), 3e-3, 3e-3);
    assert_cube(&cube.mesh(432).unwrap(), 3e-3, 5e-3);
}

#[test]
fn square_prisms_agree_with_the_table() {
    for (length, want) in [(2.0, 0.33442), (4.0, 0.17302), (10.0, 0.07103)] {
        let result = solve(
            &Shape::Box {
                size: [length, 1.0, 1.0],
            }
            .mesh(12)
            .unwrap(),
        );
        assert_within(
            result.tensor[0][0],
            want * length,
            3e-3,
            &format!("1 x 1 x {length}"),
        );
    }
}

#[test]
fn a_coarse_slender_box_agrees_with_a_fine_one() {
    // 1 x 1 x 6 on 11 700 equal triangles: 6.2775, 0.7025, 14.907, 0.2655.
    let tensor = solve(
        &Shape::Box {
            size: [1.0, 1.0, 6.0],
        }
        .mesh(12)
        .unwrap(),
    )
    .tensor;
    assert_within(tensor[0][0], 6.2775, 1e-3, "across");
    assert_within(tensor[2][2], 0.7025, 1e-3, "along");
    assert_within(tensor[3][3], 14.907, 1e-3, "end over end");
    assert_within(tensor[5][5], 0.2655, 6e-3, "about the axis");
}

#[test]
fn square_plates_agree_with_graded_meshes() {
    for (thickness, broadside, turning) in
        [(0.01, 0.46982, 0.020943), (1.0 / 800.0, 0.45772, 0.020254)]
    {
        let plate = Shape::Box {
            size: [1.0, thickness, 1.0],
        };
        for triangles in [12, 1020] {
            let tensor = solve(&plate.mesh(triangles).unwrap()).tensor;
            let what = format!("{thickness}, {triangles} triangles");
            assert_within(tensor[1][1], broadside, 3e-3, &what);
            assert_within(tensor[3][3], turning, 3.5e-3, &what);
            assert_within(tensor[5][5], turning, 3.5e-3, &what);
        }
    }
}

#[test]
fn unlike_triangulations_of_the_two_faces_agree_with_graded_meshes() {
    let result = solve(&uneven_plate(0.01));
    assert_within(result.tensor[1][1], 0.46982, 2e-3, "broadside");
    assert_within(result.tensor[3][3], 0.020943, 3e-3, "turning");
    let thin = solve(&uneven_plate(1.0 / 800.0));
    assert_within(thin.tensor[1][1], 0.45772, 3e-3, "broadside, 1/800");
    assert!(
        thin.warnings
            .iter()
            .any(|w| matches!(w, Warning::ThinnerThanTriangles { .. })),
        "{:?}",
        thin.warnings
    );
}

/// A square plate normal to Y on 22 x 22 cells, the lower face's inner vertices out of place.
fn uneven_plate(thickness: f64) -> TriMesh {
    let plate = Shape::Box {
        size: [1.0, thickness, 1.0],
    }
    .mesh(2112)
    .expect("a body");
    let mut seed = 1u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((seed >> 40) as f64 / f64::from(1 << 24) - 0.5) * 0.6 / 22.0
    };
    let displaced = |&[x, y, z]: &[f64; 3]| {
        let inner = x.abs().max(z.abs()) < 0.49 && y < 0.0;
        if inner {
            [x + noise(), y, z + noise()]
        } else {
            [x, y, z]
        }
    };
    let vertices = plate.vertices().iter().map(displaced).collect();
    TriMesh::new(vertices, plate.triangles().to_vec()).expect("a body")
}

#[test]
fn thin_plates_agree_with_the_classic_coefficients() {
    // m = CA (pi/4) a^2 b for zero thickness; 1/800 adds about half a percent.
    for (b, coefficient) in [(1.0, 0.579), (2.0, 0.757), (5.0, 0.897)] {
        let tensor = solve(
            &Shape::Box {
                size: [1.0, 1.0 / 800.0, b],
            }
            .mesh(12)
            .expect("a body"),
        )
        .tensor;
        let want = coefficient * std::f64::consts::FRAC_PI_4 * b;
        assert_within(tensor[1][1], want, 1e-2, &format!("{b}"));
        assert!(tensor[1][1] > want);
    }
}

/// Four unit cubes in a screw, each face in 5 x 5 cells: no symmetry, every coupling present.
fn screw() -> TriMesh {
    let cells = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]];
    let n = 5;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for cell in cells {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut next = cell;
            next[axis] += 2 * side - 1;
            if cells.contains(&next) {
                continue;
            }
            let start = vertices.len() as u32;
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let mut steps = cell.map(|c: i32| c * n);
                steps[axis] += side * n;
                steps[(axis + 1) % 3] += i;
                steps[(axis + 2) % 3] += j;
                vertices.push(steps.map(|s| f64::from(s) / f64::from(n)));
            }
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let corner = |i: i32, j: i32| start + (i * (n + 1) + j) as u32;
                let [a, b, c, d] = [
                    corner(i, j),
                    corner(i + 1, j),
                    corner(i + 1, j + 1),
                    corner(i, j + 1),
                ];
                triangles.extend(if side == 1 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, c, b], [a, d, c]]
                });
            }
        }
    }
    let (vertices, triangles) = weld(&vertices, &triangles);
    TriMesh::new(vertices, triangles).expect("a body")
}

fn rotation() -> [[f64; 3]; 3] {
    // Of a quaternion without symmetry.
    let [w, x, y, z] = [0.5, -0.1, 0.7, 0.5];
    [
        [
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ],
    ]
}

fn moved(mesh: &TriMesh, scale: f64, by: [f64; 3]) -> TriMesh {
    let r = rotation();
    let place = |v: &[f64; 3]| {
        std::array::from_fn(|i| scale * (0..3).map(|k| r[i][k] * v[k]).sum::<f64>() + by[i])
    };
    TriMesh::new(
        mesh.vertices().iter().map(place).collect(),
        mesh.triangles().to_vec(),
    )
    .expect("a body again")
}

/// The tensor in turned axes.
fn turned(tensor: &Six) -> Six {
    let r = rotation();
    let entry = |i: usize, j: usize| {
        let term =
            |k: usize, l: usize| r[i % 3][k] * tensor[i / 3 * 3 + k][j / 3 * 3 + l] * r[j % 3][l];
        (0..9).map(|kl| term(kl / 3, kl % 3)).sum()
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn assert_close(got: &Six, want: &Six, tolerance: f64) {
    for i in 0..6 {
        for j in 0..6 {
            let scale = (want[i][i] * want[j][j]).sqrt();
            let error = (got[i][j] - want[i][j]).abs() / scale;
            assert!(
                error < tolerance,
                "{i} {j}: {} {} {error:.1e}",
                got[i][j],
                want[i][j]
            );
        }
    }
}

#[test]
fn the_tensor_moves_with_the_body() {
    let bodies = [
        screw(),
        Shape::Box {
            size: [1.0, 0.013, 1.7],
        }
        .mesh(12)
        .unwrap(),
        Shape::Cylinder {
            radius: 0.5,
            height: 1.0,
        }
        .mesh(400)
        .unwrap(),
    ];
    for body in bodies {
        let still = solve(&body);
        for by in [[0.0; 3], [300.0, -500.0, 200.0]] {
            let result = solve(&moved(&body, 1.0, by));
            assert_eq!(
                result.quality.triangles_solved,
                still.quality.triangles_solved
            );
            assert_close(&result.tensor, &turned(&still.tensor), 1e-10);
        }
    }
}

#[test]
fn the_tensor_scales_with_the_powers_of_length() {
    let (body, scale) = (screw(), 0.003);
    let (one, small) = (
        solve(&moved(&body, 1.0, [0.0; 3])),
        solve(&moved(&body, scale, [0.0; 3])),
    );
    let power = |i: usize, j: usize| libm::pow(scale, 3.0 + (i / 3 + j / 3) as f64);
    let want = std::array::from_fn(|i| std::array::from_fn(|j| one.tensor[i][j] * power(i, j)));
    assert_close(&small.tensor, &want, 1e-10);
}

#[test]
fn the_tensor_is_symmetric_and_positive() {
    let tensor = solve(&screw()).tensor;
    for i in 0..6 {
        for j in 0..6 {
            assert_eq!(tensor[i][j], tensor[j][i]);
        }
    }
    // Every pivot of the elimination is positive.
    let mut m = tensor;
    for k in 0..6 {
        assert!(m[k][k] > 0.0, "pivot {k}: {}", m[k][k]);
        for i in k + 1..6 {
            let factor = m[i][k] / m[k][k];
            for j in k..6 {
                m[i][j] -= factor * m[k][j];
            }
        }
    }
}

#[test]
fn shifting_keeps_the_energy_of_every_motion() {
    let tensor = solve(&screw()).tensor;
    let offset = [0.4, -1.3, 0.2];
    let about = shift_added_mass(&tensor, offset);
    let energy = |t: &Six, v: &[f64; 6]| {
        (0..36)
            .map(|k| v[k / 6] * t[k / 6][k % 6] * v[k % 6])
            .sum::<f64>()
    };
    // The same motion seen from the new point moves at v + omega x offset there.
    let (v, omega) = ([0.3, -0.5, 0.9], [1.1, 0.2, -0.7]);
    let [x, y, z] = offset;
    let there = [
        v[0] + omega[1] * z - omega[2] * y,
        v[1] + omega[2] * x - omega[0] * z,
        v[2] + omega[0] * y - omega[1] * x,
    ];
    let join = |v: [f64; 3]| [v[0], v[1], v[2], omega[0], omega[1], omega[2]];
    let (old, new) = (energy(&tensor, &join(v)), energy(&about, &join(there)));
    assert!((old / new - 1.0).abs() < 1e-13, "{old} {new}");
    assert_close(
        &shift_added_mass(&about, offset.map(|c| -c)),
        &tensor,
        1e-13,
    );
}

#[test]
fn potentials_of_a_sphere_are_dipoles() {
    // phi = -x/2 for unit velocity along x; none for rotation.
    let result = solve(
        &Shape::Ellipsoid {
            semi_axes: [2.0; 3],
        }
        .mesh(1280)
        .unwrap(),
    );
    let surface = &result.surface;
    assert_eq!(surface.potentials.len(), surface.vertices.len());
    for (v, phi) in surface.vertices.iter().zip(&surface.potentials) {
        for k in 0..3 {
            assert!((phi[k] + 0.5 * v[k]).abs() < 0.004, "{v:?} {phi:?}");
            assert!(phi[3 + k].abs() < 0.004, "{v:?} {phi:?}");
        }
    }
}

#[test]
fn the_surface_is_a_refinement_of_the_mesh_given() {
    let mesh = Shape::Cylinder {
        radius: 0.3,
        height: 0.1,
    }
    .mesh(200)
    .unwrap();
    let surface = solve(&mesh).surface;
    assert_eq!(&surface.vertices[..mesh.vertices().len()], mesh.vertices());
    let refined = TriMesh::new(surface.vertices, surface.triangles).unwrap();
    assert!((refined.volume() / mesh.volume() - 1.0).abs() < 1e-12);
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let mesh = Shape::Box {
        size: [1.0, 0.02, 0.6],
    }
    .mesh(100)
    .unwrap();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| solve(&mesh))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn the_estimate_covers_the_error() {
    for triangles in [12, 300, 588, 1200] {
        let result = solve(&Shape::Box { size: [1.0; 3] }.mesh(triangles).unwrap());
        let error = (result.tensor[0][0] / CUBE[0] - 1.0).abs();
        assert!(
            error < result.error_estimate,
            "{triangles}: {error} {}",
            result.error_estimate
        );
        assert!(result.error_estimate < 0.01);
    }
}

#[test]
fn a_coarse_target_is_reported_as_doubtful() {
    let options = Options {
        target_triangles: 12,
        ..Options::default()
    };
    let cube = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let result = added_mass(&cube, &options, &()).unwrap();
    let warning = result
        .warnings
        .iter()
        .find(|w| matches!(w, Warning::InaccurateTensor { .. }));
    let text = warning
        .unwrap_or_else(|| panic!("{:?}", result.warnings))
        .to_string();
    assert!(text.contains('%') && text.contains("finer mesh"), "{text}");
}

#[test]
fn too_many_triangles_are_refused_with_the_memory_they_take() {
    let options = Options {
        max_triangles: 1000,
        ..Options::default()
    };
    let cube = Shape::Box { size: [1.0; 3] }.mesh(1200).unwrap();
    let error = added_mass(&cube, &options, &()).unwrap_err();
    assert!(matches!(
        error,
        AddedMassError::TooLarge {
            triangles: 1200,
            limit: 1000,
            ..
        }
    ));
    assert!(error.to_string().contains("GB"), "{error}");
}

struct Stop;

impl Progress for Stop {
    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn work_stops_when_asked() {
    let cube = Shape::Box { size: [1.0; 3] }.mesh(300).unwrap();
    let outcome = added_mass(&cube, &Options::default(), &Stop);
    assert_eq!(outcome.unwrap_err(), AddedMassError::Cancelled);
}
