//! MuJoCo: a Python program that sets `geom_fluid` and `gravcomp`.

use super::statement::Statement;
use super::{Report, row};

/// What is the same for every body.
const PROGRAM: &str = include_str!("mujoco.py");

/// A Python program with the tensor per unit density and a function that gives it to a geom.
pub fn mujoco(report: &Report) -> String {
    let report = report.about(report.centroid);
    let tensor = report
        .added_mass
        .map(|row| row.map(|a| a / report.fluid_density));
    let diagonal: [f64; 6] = std::array::from_fn(|i| tensor[i][i]);
    let rows = tensor
        .iter()
        .map(|numbers| format!("    [{}],\n", row(numbers, ", ")));
    format!(
        "{comment}\
import mujoco
import numpy as np

VOLUME = {volume:.9e}  # m^3
CENTROID = np.array([{centroid}])  # m
ADDED_MASS = np.array([
{rows}])
# geom_fluid[6:12] of a geom at CENTROID with the axes of the mesh:
# {first}
# {second}
{PROGRAM}",
        comment = comment(&report),
        volume = report.volume,
        centroid = row(&report.centroid, ", "),
        rows = rows.collect::<String>(),
        first = row(&diagonal[..3], " "),
        second = row(&diagonal[3..], " "),
    )
}

fn comment(report: &Report) -> String {
    let stated = Statement {
        fluid: "unbounded; numbers per unit density, which MuJoCo multiplies by <option density>"
            .into(),
        order: "x, y, z, then rotation about x, y, z; m^3, m^4, m^5".into(),
        ..Statement::new(report)
    };
    stated.hashed(&format!(
        "
What MuJoCo leaves out of it:
- the acceleration part: a body speeds up as if it had no added mass. What it applies are the terms of
  the velocities alone, (A v) x omega on the force and (A v) x v + (I omega) x omega on the torque.
- terms off the diagonal in the frame of the geom: set_added_mass returns the largest of them over the
  largest kept, lengths in units of VOLUME^(1/3). In the axes of the mesh, about CENTROID: {:.1e}.
- the place where buoyancy acts: gravcomp lifts at the centre of mass, so that nothing rights the body.",
        left_out(report)
    ))
}

/// Largest entry off the diagonal over the largest on it, lengths in units of the volume's cube root.
fn left_out(report: &Report) -> f64 {
    let unit = libm::cbrt(report.volume);
    let power = |i: usize| if i < 3 { 1.0 } else { unit };
    let largest = |on_diagonal: bool| {
        let places = (0..36)
            .map(|n| (n / 6, n % 6))
            .filter(|(i, j)| (i == j) == on_diagonal);
        let sizes = places.map(|(i, j)| (report.added_mass[i][j] / (power(i) * power(j))).abs());
        sizes.fold(0.0, f64::max)
    };
    largest(false) / largest(true)
}
