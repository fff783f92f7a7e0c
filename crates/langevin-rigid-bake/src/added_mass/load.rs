//! Right-hand sides of the six unit motions.

use super::operator::Operator;
use super::operator::Six;
use super::panels::{Panel, Panels, Vec3};
use super::sums::RowSums;
use crate::mesh::vector::{cross, dot};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;

/// f_i = (1/2 + K') g_i against every hat function; sums to zero over the vertices.
///
/// For a translation it is the normal's load less W x, since W x_i = (1/2 - K') n_i exactly. For a
/// rotation the part of K' beyond the constants is the circulation of a vector potential.
pub(super) fn loads(panels: &Panels, sums: &[RowSums], w: &dyn Operator) -> Vec<Six> {
    let position = |v: &Vec3| [v[0], v[1], v[2], 0.0, 0.0, 0.0];
    let mut f: Vec<Six> = w
        .product(&panels.vertices.iter().map(position).collect::<Vec<Six>>())
        .into_iter()
        .map(|wx| wx.map(|v| -v))
        .collect();
    for (panel, row) in panels.panels.iter().zip(sums) {
        let velocities = panel.points.map(|x| normal_velocity(panel, x));
        let total: Six = std::array::from_fn(|i| velocities.iter().map(|g| g[i]).sum());
        let potentials = [0, 1, 2].map(|k| row.vector_potential(k));
        for (k, &v) in panel.corners.iter().enumerate() {
            let entry = &mut f[v as usize];
            for i in 0..6 {
                entry[i] += panel.area / 12.0 * (total[i] + velocities[k][i]);
            }
            for (axis, potential) in potentials.iter().enumerate() {
                entry[3 + axis] += dot(panel.curls[k], *potential) / FOUR_PI;
            }
        }
    }
    f
}

/// g = (n, x x n).
fn normal_velocity(panel: &Panel, x: Vec3) -> Six {
    let (n, turn) = (panel.normal, cross(x, panel.normal));
    [n[0], n[1], n[2], turn[0], turn[1], turn[2]]
}
