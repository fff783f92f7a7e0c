//! Pressure projection: takes the divergence out of the velocity by one direct solve.
//!
//! The domain is a box and the body is passive, so the discrete Laplacian is diagonal in products
//! of the eigenvectors of [`transform`](super::transform): transform, divide, transform back.

use rayon::prelude::*;

use super::TurbulenceError;
use super::fft::{LINES, Sample};
use super::grid::MacGrid;
use super::lattice::Boundary;
use super::transform::{AxisTransform, Workspace};

/// The solver of one grid: plans and memory are made once, a projection allocates none per cell.
///
/// ```
/// use langevin_rigid_bake::turbulence::{Boundary, MacGrid, Projection};
/// let mut grid = MacGrid::new([12, 10, 9], 0.1, [Boundary::Periodic; 3])?;
/// grid.set_velocity(|[x, y, z]| [x * y, z * z - x, y]);
/// assert!(grid.max_divergence() > 1.0);
/// Projection::new(&grid).project(&mut grid)?;
/// assert!(grid.max_divergence() < 1e-12);
/// # Ok::<(), langevin_rigid_bake::turbulence::TurbulenceError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Projection {
    cells: [usize; 3],
    boundaries: [Boundary; 3],
    axes: [AxisTransform; 3],
    /// Divergence, then potential, x fastest, then y, then z.
    planes: Vec<f64>,
    /// Spectrum, x fastest, then z, then y.
    slabs: Vec<f64>,
}

impl Projection {
    /// Plans the solve for the cells and the bounds of `grid`.
    pub fn new(grid: &MacGrid) -> Self {
        let (cells, boundaries) = (grid.cells(), grid.boundaries());
        let count = cells.iter().product();
        Self {
            cells,
            boundaries,
            axes: core::array::from_fn(|a| AxisTransform::new(cells[a], boundaries[a])),
            planes: vec![0.0; count],
            slabs: vec![0.0; count],
        }
    }

    /// Makes the velocity of `grid` free of divergence, to rounding.
    ///
    /// `u - grad(phi)` with `laplace(phi) = div(u)`; no flow through walls or change of the inflow,
    /// `phi = 0` on the outflow face.
    ///
    /// # Errors
    ///
    /// `grid` has other cells or bounds than the plan.
    pub fn project(&mut self, grid: &mut MacGrid) -> Result<(), TurbulenceError> {
        if (self.cells, self.boundaries) != (grid.cells(), grid.boundaries()) {
            return Err(TurbulenceError::OtherGrid {
                planned: self.cells,
                given: grid.cells(),
            });
        }
        self.transform_divergence(grid);
        self.solve_across_planes();
        self.transform_back();
        for axis in 0..3 {
            self.subtract_gradient(grid, axis);
        }
        grid.apply_boundaries();
        Ok(())
    }

    fn workspace(&self) -> Workspace {
        Workspace::new(self.cells.into_iter().fold(0, usize::max))
    }

    /// Divergence (times the cell size) and its transforms along x and y, plane by plane.
    fn transform_divergence(&mut self, grid: &MacGrid) {
        let mut planes = core::mem::take(&mut self.planes);
        let [nx, ny, _] = self.cells;
        planes.par_chunks_mut(nx * ny).enumerate().for_each_init(
            || self.workspace(),
            |work, (k, plane)| {
                for (j, row) in plane.chunks_exact_mut(nx).enumerate() {
                    divergence_of_row(grid, j, k, row);
                }
                for rows in plane.chunks_mut(LINES * nx) {
                    load_rows(rows, nx, &mut work.line);
                    self.axes[0].forward(work);
                    store_rows(rows, nx, &work.line);
                }
                for first in (0..nx).step_by(LINES) {
                    let columns = first..nx.min(first + LINES);
                    for (row, sample) in plane.chunks_exact(nx).zip(&mut work.line) {
                        *sample = Sample::load(&row[columns.clone()]);
                    }
                    self.axes[1].forward(work);
                    for (row, sample) in plane.chunks_exact_mut(nx).zip(&work.line) {
                        sample.store(&mut row[columns.clone()]);
                    }
                }
            },
        );
        self.planes = planes;
    }

    /// Transforms along z, divides by the eigenvalues and transforms back.
    fn solve_across_planes(&mut self) {
        let mut slabs = core::mem::take(&mut self.slabs);
        let [nx, ny, nz] = self.cells;
        slabs.par_chunks_mut(nx * nz).enumerate().for_each_init(
            || self.workspace(),
            |work, (j, slab)| {
                for first in (0..nx).step_by(LINES) {
                    let columns = first..nx.min(first + LINES);
                    for k in 0..nz {
                        let row = &self.planes[(k * ny + j) * nx..][..nx];
                        work.line[k] = Sample::load(&row[columns.clone()]);
                    }
                    self.axes[2].forward(work);
                    self.divide(&mut work.line, first, j);
                    self.axes[2].inverse(work);
                    for (row, sample) in slab.chunks_exact_mut(nx).zip(&work.line) {
                        sample.store(&mut row[columns.clone()]);
                    }
                }
            },
        );
        self.slabs = slabs;
    }

    /// Divides a line along z of the spectrum by minus its eigenvalues; undoes the scales.
    fn divide(&self, line: &mut [Sample], first: usize, j: usize) {
        let [x, y, z] = &self.axes;
        let scale = Sample::load(&[-(x.scale * y.scale * z.scale); LINES]);
        let of_x = &x.eigenvalues[first..x.eigenvalues.len().min(first + LINES)];
        // Lanes past the last column hold zeros: keep them from dividing by zero.
        let mut lanes = [1.0; LINES];
        lanes[..of_x.len()].copy_from_slice(of_x);
        for (sample, of_z) in line.iter_mut().zip(&z.eigenvalues) {
            let shift = y.eigenvalues[j] + of_z;
            let sum = Sample::load(&lanes.map(|of_x| match of_x + shift {
                // The constant, where no bound fixes it: its coefficient is the net flow into the
                // domain, which is zero; what rounding leaves of it is dropped.
                0.0 => f64::INFINITY,
                sum => sum,
            }));
            sample.re = sample.re * scale.re / sum.re;
            sample.im = sample.im * scale.im / sum.im;
        }
    }

    /// Transforms back along y and x, plane by plane.
    fn transform_back(&mut self) {
        let mut planes = core::mem::take(&mut self.planes);
        let [nx, ny, nz] = self.cells;
        planes.par_chunks_mut(nx * ny).enumerate().for_each_init(
            || self.workspace(),
            |work, (k, plane)| {
                for first in (0..nx).step_by(LINES) {
                    let columns = first..nx.min(first + LINES);
                    for j in 0..ny {
                        let row = &self.slabs[(j * nz + k) * nx..][..nx];
                        work.line[j] = Sample::load(&row[columns.clone()]);
                    }
                    self.axes[1].inverse(work);
                    for (row, sample) in plane.chunks_exact_mut(nx).zip(&work.line) {
                        sample.store(&mut row[columns.clone()]);
                    }
                }
                for rows in plane.chunks_mut(LINES * nx) {
                    load_rows(rows, nx, &mut work.line);
                    self.axes[0].inverse(work);
                    store_rows(rows, nx, &work.line);
                }
            },
        );
        self.planes = planes;
    }

    /// Subtracts the gradient of the potential along `axis` from the faces the flow may change.
    fn subtract_gradient(&self, grid: &mut MacGrid, axis: usize) {
        let lattice = grid.lattice;
        let subtract = |(row, values): (usize, &mut [f64])| {
            if let Some(place) = lattice.row_of_faces(axis, row) {
                match axis {
                    0 => self.subtract_along_row(place, values),
                    _ => self.subtract_between_rows(axis, place, values),
                }
            }
        };
        let rows = grid.velocity[axis].par_chunks_mut(lattice.row());
        rows.enumerate().for_each(subtract);
    }

    fn potential_row(&self, [j, k]: [usize; 2]) -> &[f64] {
        let [nx, ny, _] = self.cells;
        &self.planes[(k * ny + j) * nx..][..nx]
    }

    fn subtract_along_row(&self, place: [usize; 2], values: &mut [f64]) {
        let potential = self.potential_row(place);
        for (value, pair) in values[2..].iter_mut().zip(potential.windows(2)) {
            *value -= pair[1] - pair[0];
        }
        if self.boundaries[0] == Boundary::Periodic {
            values[1] -= potential[0] - potential[potential.len() - 1];
        }
    }

    /// Faces of a row normal to y (`axis` 1) or z (2): between the rows of cells on either side.
    fn subtract_between_rows(&self, axis: usize, place: [usize; 2], values: &mut [f64]) {
        let (face, n) = (place[axis - 1], self.cells[axis]);
        let row = |along: usize| {
            let mut at = place;
            at[axis - 1] = along;
            self.potential_row(at)
        };
        let low = row(if face == 0 { n - 1 } else { face - 1 });
        if face == n {
            // Outflow: the potential has the opposite value on the far side of the face.
            for (value, low) in values[1..].iter_mut().zip(low) {
                *value += 2.0 * low;
            }
        } else {
            for ((value, low), high) in values[1..].iter_mut().zip(low).zip(row(face)) {
                *value -= high - low;
            }
        }
    }
}

/// Net flow out of the cells of row `(j, k)` per face area (m/s).
fn divergence_of_row(grid: &MacGrid, j: usize, k: usize, out: &mut [f64]) {
    let n = out.len();
    let start = grid.lattice.index([0, j, k]);
    let [_, row, plane] = grid.lattice.strides;
    let [u, v, w] = &grid.velocity;
    let (west, east) = (&u[start..start + n], &u[start + 1..start + 1 + n]);
    let (south, north) = (&v[start..start + n], &v[start + row..start + row + n]);
    let (back, front) = (&w[start..start + n], &w[start + plane..start + plane + n]);
    for i in 0..n {
        out[i] = (east[i] - west[i]) + (north[i] - south[i]) + (front[i] - back[i]);
    }
}

/// Rows of `length` values as lines; rows that are missing are zero.
fn load_rows(rows: &[f64], length: usize, line: &mut [Sample]) {
    for (i, sample) in line[..length].iter_mut().enumerate() {
        let mut lanes = [0.0; LINES];
        for (lane, row) in lanes.iter_mut().zip(rows.chunks_exact(length)) {
            *lane = row[i];
        }
        *sample = Sample::load(&lanes);
    }
}

fn store_rows(rows: &mut [f64], length: usize, line: &[Sample]) {
    for (i, sample) in line[..length].iter().enumerate() {
        let lanes = sample.lanes();
        for (lane, row) in lanes.iter().zip(rows.chunks_exact_mut(length)) {
            row[i] = *lane;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Boundary::{Periodic, Through, Walls};

    fn rough(grid: &mut MacGrid) {
        let noise = |x: f64| libm::sin(12.9898 * x * x + 78.233 * x);
        grid.set_velocity(|[x, y, z]| {
            [
                noise(x + 2.0 * y + 3.0 * z),
                noise(3.0 * x + y + 2.0 * z),
                noise(2.0 * x + 3.0 * y + z),
            ]
        });
    }

    /// Fails when a transform does not match its bounds or a face is corrected twice or not at all.
    #[test]
    fn divergence_goes_to_rounding_on_any_grid() {
        let bounds = [
            [Periodic, Periodic, Periodic],
            [Walls, Through, Walls],
            [Walls, Walls, Walls],
            [Periodic, Through, Walls],
            [Walls, Periodic, Periodic],
        ];
        let sizes = [
            [32, 32, 16],
            [1, 1, 1],
            [7, 5, 1],
            [1, 9, 4],
            [13, 24, 11],
            [2, 2, 2],
        ];
        for boundaries in bounds {
            for cells in sizes {
                let mut grid = MacGrid::new(cells, 1.0, boundaries).unwrap();
                rough(&mut grid);
                let mut projection = Projection::new(&grid);
                projection.project(&mut grid).unwrap();
                // Six differences of a potential are as exact as the potential's last digit.
                let potential = projection
                    .planes
                    .iter()
                    .fold(1.0, |m: f64, p| m.max(p.abs()));
                let residual = grid.max_divergence() / potential;
                assert!(residual < 4e-15, "{boundaries:?} {cells:?}: {residual:e}");
            }
        }
    }

    /// What is subtracted is a gradient: orthogonal to every field that is free of divergence.
    #[test]
    fn projection_is_orthogonal_and_keeps_what_is_free_of_divergence() {
        let mut grid = MacGrid::new([12, 10, 8], 1.0, [Walls, Periodic, Walls]).unwrap();
        rough(&mut grid);
        let before = grid.velocity.clone();
        let mut projection = Projection::new(&grid);
        projection.project(&mut grid).unwrap();
        let once = grid.velocity.clone();
        projection.project(&mut grid).unwrap();
        let (mut product, mut energy) = (0.0, 0.0);
        for axis in 0..3 {
            for row in 0..grid.lattice.len() / grid.lattice.row() {
                let Some(_) = grid.lattice.row_of_faces(axis, row) else {
                    continue;
                };
                for i in 1..=12 {
                    let at = row * grid.lattice.row() + i;
                    let kept = once[axis][at];
                    product += kept * (before[axis][at] - kept);
                    energy += kept * kept;
                    assert!((grid.velocity[axis][at] - kept).abs() < 1e-14);
                }
            }
        }
        assert!(
            energy > 100.0 && product.abs() < 1e-12 * energy,
            "{product:e} {energy}"
        );
    }

    #[test]
    fn refuses_another_grid() {
        let sides = [Walls, Through, Walls];
        let mut projection = Projection::new(&MacGrid::new([4, 5, 6], 1.0, sides).unwrap());
        let mut other = MacGrid::new([6, 5, 4], 1.0, sides).unwrap();
        let error = projection.project(&mut other).unwrap_err();
        assert!(matches!(error, TurbulenceError::OtherGrid { .. }));
    }

    #[test]
    fn a_uniform_stream_is_left_as_it_is_to_the_bit() {
        let mut grid = MacGrid::new([6, 9, 5], 0.1, [Walls, Through, Walls]).unwrap();
        grid.set_velocity(|_| [0.0, 0.81, 0.0]);
        let before = grid.velocity.clone();
        Projection::new(&grid).project(&mut grid).unwrap();
        assert_eq!(grid.velocity, before);
    }
}
