//! Added mass against an independent method: constant panels, direct collocation.
//!
//! Green's identity for the exterior potential, (1/2 - D) phi = -S (n . U), at the centroids of
//! panels of constant strength, with exact solid angles and edge logarithms; nothing is shared with
//! the scheme under test, neither equations nor unknowns nor code. On a bent ellipsoid without
//! symmetry all 21 entries are compared. The panels are a first-order method, high by about one
//! percent here; a missing term, a swapped pair of moments or a wrong sign in the couplings of the
//! Galerkin scheme shows as tens of percent in single entries.

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{Options, added_mass};
use langevin_rigid_bake::shapes::Shape;

type Vec3 = [f64; 3];

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

struct Panel {
    corners: [Vec3; 3],
    centroid: Vec3,
    normal: Vec3,
    area: f64,
}

fn panels(mesh: &TriMesh) -> Vec<Panel> {
    let panel = |t: &[u32; 3]| {
        let corners @ [a, b, c] = t.map(|v| mesh.vertices()[v as usize]);
        let twice = cross(sub(b, a), sub(c, a));
        Panel {
            corners,
            centroid: std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0),
            normal: twice.map(|x| x / norm(twice)),
            area: 0.5 * norm(twice),
        }
    };
    mesh.triangles().iter().map(panel).collect()
}

/// Integrals over a panel, seen from x: 1/r, and (x - y) . n / r^3, the solid angle.
fn influence(panel: &Panel, x: Vec3) -> (f64, f64) {
    let r = panel.corners.map(|c| sub(c, x));
    let l = r.map(norm);
    let triple = dot(r[0], cross(r[1], r[2]));
    let denominator = l[0] * l[1] * l[2]
        + dot(r[0], r[1]) * l[2]
        + dot(r[1], r[2]) * l[0]
        + dot(r[2], r[0]) * l[1];
    let solid_angle = -2.0 * libm::atan2(triple, denominator);
    let height = dot(r[0], panel.normal);
    let edges: f64 = (0..3)
        .map(|k| {
            let next = (k + 1) % 3;
            let edge = sub(r[next], r[k]);
            let length = norm(edge);
            let outward = cross(edge, panel.normal);
            let across = dot(r[k], outward) / length;
            across * libm::log((l[k] + l[next] + length) / (l[k] + l[next] - length))
        })
        .sum();
    (edges + height * solid_angle, solid_angle)
}

/// Added mass about `origin` by constant panels.
fn constant_panels(mesh: &TriMesh, origin: Vec3) -> [[f64; 6]; 6] {
    let panels = panels(mesh);
    let velocity = |p: &Panel| {
        let turn = cross(sub(p.centroid, origin), p.normal);
        [
            p.normal[0],
            p.normal[1],
            p.normal[2],
            turn[0],
            turn[1],
            turn[2],
        ]
    };
    let velocities: Vec<[f64; 6]> = panels.iter().map(velocity).collect();
    let four_pi = 4.0 * std::f64::consts::PI;
    let mut rows: Vec<(Vec<f64>, [f64; 6])> = panels
        .iter()
        .enumerate()
        .map(|(i, target)| {
            let mut row = vec![0.0; panels.len()];
            let mut right = [0.0; 6];
            for (j, source) in panels.iter().enumerate() {
                let (single, double) = influence(source, target.centroid);
                row[j] = if i == j { 0.5 } else { -double / four_pi };
                for c in 0..6 {
                    right[c] -= single / four_pi * velocities[j][c];
                }
            }
            (row, right)
        })
        .collect();
    eliminate(&mut rows);
    let mut tensor = [[0.0; 6]; 6];
    for ((panel, g), (_, phi)) in panels.iter().zip(&velocities).zip(&rows) {
        for i in 0..6 {
            for j in 0..6 {
                tensor[i][j] -= panel.area * phi[i] * g[j];
            }
        }
    }
    tensor
}

/// Gaussian elimination; the matrix is dominated by its diagonal. Leaves the solutions.
fn eliminate(rows: &mut [(Vec<f64>, [f64; 6])]) {
    for k in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(k + 1);
        let (pivot, right) = &done[k];
        for (row, value) in rest {
            let factor = row[k] / pivot[k];
            for (a, p) in row[k..].iter_mut().zip(&pivot[k..]) {
                *a -= factor * p;
            }
            for c in 0..6 {
                value[c] -= factor * right[c];
            }
        }
    }
    for k in (0..rows.len()).rev() {
        let (before, rest) = rows.split_at_mut(k);
        let (pivot, right) = &mut rest[0];
        for value in right.iter_mut() {
            *value /= pivot[k];
        }
        for (row, value) in before {
            for c in 0..6 {
                value[c] -= row[k] * right[c];
            }
        }
    }
}

#[test]
fn all_couplings_agree_with_constant_panels() {
    let straight = Shape::Ellipsoid {
        semi_axes: [1.0, 0.6, 1.6],
    }
    .mesh(980)
    .unwrap();
    // Bent and twisted: no plane or axis of symmetry is left.
    let bend = |&[x, y, z]: &Vec3| {
        let (s, c) = (libm::sin(0.4 * z), libm::cos(0.4 * z));
        [
            c * x - s * y + 0.3 * z * z,
            s * x + c * y + 0.2 * x * z,
            z + 0.25 * x * x,
        ]
    };
    let vertices = straight.vertices().iter().map(bend).collect();
    let body = TriMesh::new(vertices, straight.triangles().to_vec()).unwrap();
    let result = added_mass(&body, &Options::default(), &()).unwrap();
    let panels = constant_panels(&body, result.reference);
    for i in 0..6 {
        for j in 0..6 {
            let got = result.tensor[i][j];
            let scale = (result.tensor[i][i] * result.tensor[j][j]).sqrt();
            let error = (panels[i][j] - got) / scale;
            assert!(
                error.abs() < 0.02,
                "{i} {j}: {got} {} {error}",
                panels[i][j]
            );
        }
    }
    // The body does couple, or the off-diagonal entries would test nothing.
    let couplings = (0..9)
        .filter(|k| result.tensor[k / 3][3 + k % 3].abs() > 0.02)
        .count();
    assert!(couplings >= 3, "{:?}", result.tensor);
}
