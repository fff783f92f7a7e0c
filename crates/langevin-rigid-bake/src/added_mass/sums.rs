//! What the single layer of the six unit motions needs from each row of pair integrals.

use super::kernel::PairMoments;
use super::panels::{Panel, Vec3};
use crate::mesh::vector::{cross, dot};

/// Sums over the panels b of one row a; x on a, y on b, n the normal of b.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RowSums {
    /// sum n II 1/r.
    pub(super) normal: Vec3,
    /// sum n_k II y_m / r.
    pub(super) normal_y: [Vec3; 3],
    /// sum n . II x / r.
    pub(super) normal_x: f64,
    /// sum II (x x n_a)_k (y x n)_l / r.
    pub(super) rotational: [Vec3; 3],
}

impl RowSums {
    pub(super) fn add_near(&mut self, moments: &PairMoments, normal: Vec3) {
        for k in 0..3 {
            self.normal[k] += normal[k] * moments.p;
            for m in 0..3 {
                self.normal_y[k][m] += normal[k] * moments.y[m];
            }
        }
        self.normal_x += dot(normal, moments.x);
    }

    pub(super) fn add_energy(&mut self, rotational: [Vec3; 3]) {
        for k in 0..3 {
            for l in 0..3 {
                self.rotational[k][l] += rotational[k][l];
            }
        }
    }

    pub(super) fn add(&mut self, other: &RowSums) {
        for k in 0..3 {
            self.normal[k] += other.normal[k];
            for m in 0..3 {
                self.normal_y[k][m] += other.normal_y[k][m];
            }
        }
        self.normal_x += other.normal_x;
        self.add_energy(other.rotational);
    }

    /// sum II (y x n) / r.
    pub(super) fn y_cross_normal(&self) -> Vec3 {
        let z = &self.normal_y;
        [z[2][1] - z[1][2], z[0][2] - z[2][0], z[1][0] - z[0][1]]
    }

    /// 4 pi times the integral over a of the vector potential of the rotation about axis `k`.
    pub(super) fn vector_potential(&self, k: usize) -> Vec3 {
        let mut total = self.normal_y[k];
        total[k] -= self.normal_x;
        total
    }
}

/// II (x x n_a)_k (y x n_b)_l / r from II x_k y_l / r.
pub(super) fn rotational(na: Vec3, nb: Vec3, xy: &[Vec3; 3]) -> [Vec3; 3] {
    // (y x n_b) row by row, then (x x n_a) column by column.
    let rows = xy.map(|row| cross(row, nb));
    let columns: [Vec3; 3] =
        std::array::from_fn(|l| cross([rows[0][l], rows[1][l], rows[2][l]], na));
    std::array::from_fn(|k| std::array::from_fn(|l| columns[l][k]))
}

/// <V g_i, g_j> of the six unit motions, symmetric.
pub(super) fn single_layer_energy(panels: &[Panel], sums: &[RowSums]) -> [[f64; 6]; 6] {
    let mut energy = [[0.0; 6]; 6];
    for (panel, row) in panels.iter().zip(sums) {
        let y_cross_n = row.y_cross_normal();
        for i in 0..3 {
            for j in 0..3 {
                energy[i][j] += panel.normal[i] * row.normal[j];
                energy[i][3 + j] += panel.normal[i] * y_cross_n[j];
                energy[3 + i][3 + j] += row.rotational[i][j];
            }
        }
    }
    symmetric(&energy)
}

/// The symmetric part, the lower left block taken from the upper right one.
fn symmetric(energy: &[[f64; 6]; 6]) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i < 3, j < 3) {
            (true, false) => energy[i][j],
            (false, true) => energy[j][i],
            _ => 0.5 * (energy[i][j] + energy[j][i]),
        } / (4.0 * std::f64::consts::PI))
    })
}
