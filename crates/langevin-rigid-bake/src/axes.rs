//! Principal axes of symmetric tensors, and means over them where they are not unique.

use std::f64::consts::PI;

use langevin_rigid::linalg::{Mat3, Vec3, eigen_symmetric};

use crate::mesh::vector::{add, scale};

/// Eigenvalues closer than this, relative to the larger of the two, have no axes of their own.
const DEGENERATE: f64 = 1e-3;
/// Directions that stand for all of a plane; those of half a turn, as an axis has no sense.
const PLANE_DIRECTIONS: u32 = 64;
/// Directions that stand for all of space.
const SPACE_DIRECTIONS: u32 = 256;

/// The principal axes of a symmetric tensor.
pub(crate) struct PrincipalAxes {
    /// Unit vectors by ascending eigenvalue.
    axes: [Vec3; 3],
    /// Whether the first and the second, the second and the third eigenvalue agree.
    same: [bool; 2],
}

impl PrincipalAxes {
    pub(crate) fn of(tensor: &Mat3) -> Self {
        let (values, columns) = eigen_symmetric(tensor);
        let same = |i: usize, j: usize| {
            let largest = values[i].abs().max(values[j].abs());
            (values[i] - values[j]).abs() <= DEGENERATE * largest
        };
        Self {
            axes: std::array::from_fn(|k| std::array::from_fn(|i| columns[i][k])),
            same: [same(0, 1), same(1, 2)],
        }
    }

    /// A quantity along each axis.
    ///
    /// Where two or three axes are arbitrary it is the mean over the directions of their plane or of
    /// space, so that it does not depend on how the body lies.
    pub(crate) fn along(&self, quantity: impl Fn(Vec3) -> f64) -> [f64; 3] {
        let [a, b, c] = self.axes;
        let plane = |a, b| mean(PLANE_DIRECTIONS, |n| quantity(plane_direction(a, b, n)));
        match self.same {
            [true, true] => [mean(SPACE_DIRECTIONS, |n| quantity(space_direction(n))); 3],
            [true, false] => {
                let shared = plane(a, b);
                [shared, shared, quantity(c)]
            }
            [false, true] => {
                let shared = plane(b, c);
                [quantity(a), shared, shared]
            }
            [false, false] => self.axes.map(quantity),
        }
    }

    /// The tensor with these eigenvalues along the axes.
    pub(crate) fn tensor(&self, values: [f64; 3]) -> Mat3 {
        let entry = |i: usize, j: usize| {
            let term = |k: usize| values[k] * (self.axes[k][i] * self.axes[k][j]);
            term(0) + term(1) + term(2)
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }
}

fn mean(count: u32, value: impl Fn(u32) -> f64) -> f64 {
    (0..count).map(value).sum::<f64>() / f64::from(count)
}

fn plane_direction(a: Vec3, b: Vec3, n: u32) -> Vec3 {
    let (s, c) = libm::sincos(PI * f64::from(n) / f64::from(PLANE_DIRECTIONS));
    add(scale(c, a), scale(s, b))
}

/// A Fibonacci lattice on the half sphere.
fn space_direction(n: u32) -> Vec3 {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let y = 1.0 - (f64::from(n) + 0.5) / f64::from(SPACE_DIRECTIONS);
    let r = (1.0 - y * y).sqrt();
    let (s, c) = libm::sincos(GOLDEN_ANGLE * f64::from(n));
    [r * c, y, r * s]
}
