//! The staggered (MAC) grid: where values sit, what bounds them, how they are read in between.

use rayon::prelude::*;
use wide::f64x4;

use super::TurbulenceError;
use super::lanes::LANES;
use super::lattice::{Boundary, Lattice};
use super::sampler::Sampler;

/// Mean velocity on a staggered grid: each component at the centres of the faces normal to it.
///
/// The low corner of the domain is the origin; coordinates are in metres, the stream along `+Y`.
#[derive(Debug, Clone)]
pub struct MacGrid {
    pub(crate) lattice: Lattice,
    pub(crate) cell: f64,
    /// Component along each axis (m/s).
    pub(crate) velocity: [Vec<f64>; 3],
    /// Velocity on the inflow face; the component along the stream is in `velocity` itself.
    pub(crate) inflow: [Vec<f64>; 3],
    samplers: [Sampler; 3],
}

impl MacGrid {
    /// Largest memory of a flow on a grid (bytes).
    pub const MAX_BYTES: usize = 1 << 30;

    /// Values a flow keeps for each cell: velocity, two turbulence fields, each twice; the path
    /// traced back; two fields of the pressure solve.
    const FIELDS: usize = 15;

    /// A grid at rest of `cells` along x, y and z with edges of `cell` metres.
    ///
    /// # Errors
    ///
    /// No cells along an axis, a cell size that is not positive and finite, more cells than
    /// [`MacGrid::MAX_BYTES`] holds, or [`Boundary::Through`] on another axis than `Y`.
    pub fn new(
        cells: [usize; 3],
        cell: f64,
        boundaries: [Boundary; 3],
    ) -> Result<Self, TurbulenceError> {
        check_size(cells, cell)?;
        for axis in [0, 2] {
            if boundaries[axis] == Boundary::Through {
                return Err(TurbulenceError::StreamAxis { axis });
            }
        }
        let lattice = Lattice::new(cells, boundaries);
        let field = || vec![0.0; lattice.len()];
        let plane = || vec![0.0; lattice.inflow_len()];
        Ok(Self {
            lattice,
            cell,
            velocity: [field(), field(), field()],
            inflow: [plane(), plane(), plane()],
            samplers: core::array::from_fn(|axis| Sampler::of_faces(&lattice, axis)),
        })
    }

    /// Cells along x, y and z.
    pub fn cells(&self) -> [usize; 3] {
        self.lattice.cells
    }

    /// Edge of a cell (m).
    pub fn cell_size(&self) -> f64 {
        self.cell
    }

    /// What bounds the domain along x, y and z.
    pub fn boundaries(&self) -> [Boundary; 3] {
        self.lattice.boundaries
    }

    /// Edges of the domain along x, y and z (m).
    pub fn extent(&self) -> [f64; 3] {
        self.lattice.cells.map(|n| n as f64 * self.cell)
    }

    /// Bytes that a flow on `cells` keeps, `None` beyond what can be counted.
    pub fn bytes(cells: [usize; 3]) -> Option<usize> {
        cells
            .iter()
            .try_fold(Self::FIELDS * size_of::<f64>(), |bytes, n| {
                bytes.checked_mul(n.checked_add(2)?)
            })
    }

    /// Sets the velocity (m/s) to a function of the point (m); walls keep their normal component 0.
    ///
    /// With [`Boundary::Through`] the values on the inflow face stay prescribed from here on.
    ///
    /// ```
    /// use langevin_rigid_bake::turbulence::{Boundary, MacGrid};
    /// let sides = [Boundary::Walls, Boundary::Through, Boundary::Walls];
    /// let mut grid = MacGrid::new([8, 16, 4], 0.5, sides)?;
    /// grid.set_velocity(|[x, _, _]| [0.0, 1.0 + 0.1 * x, 0.0]);
    /// let [_, v, _] = grid.velocity_at([1.0, 3.0, 1.0]);
    /// assert!((v - 1.1).abs() < 1e-12);
    /// # Ok::<(), langevin_rigid_bake::turbulence::TurbulenceError>(())
    /// ```
    pub fn set_velocity(&mut self, velocity: impl Fn([f64; 3]) -> [f64; 3]) {
        let Self { lattice, cell, .. } = *self;
        let half = |axis: usize, a: usize| if a == axis { 1.0 } else { 0.5 };
        for axis in 0..3 {
            let place =
                |p: [usize; 3]| core::array::from_fn(|a| (p[a] as f64 - half(axis, a)) * cell);
            let values = lattice.len() - LANES;
            for (index, value) in self.velocity[axis][..values].iter_mut().enumerate() {
                let [j, k] = lattice.padded_row(index / lattice.row());
                *value = velocity(place([index % lattice.row(), j, k]))[axis];
            }
            for (index, value) in self.inflow[axis].iter_mut().enumerate() {
                let mut point = place([index % lattice.row(), 1, index / lattice.row()]);
                point[1] = 0.0;
                *value = velocity(point)[axis];
            }
        }
        self.apply_boundaries();
    }

    /// Closes walls and periods and fills the outer layer.
    pub(crate) fn apply_boundaries(&mut self) {
        let lattice = self.lattice;
        for (axis, component) in self.velocity.iter_mut().enumerate() {
            lattice.close_faces(component, axis);
            for across in (0..3).filter(|a| *a != axis) {
                lattice.fill_layer(component, across, &self.inflow[axis]);
            }
        }
    }

    /// Velocity (m/s) at a point (m); outside of the domain, that of the nearest point in it.
    pub fn velocity_at(&self, point: [f64; 3]) -> [f64; 3] {
        let position = point.map(|x| f64x4::splat(x / self.cell));
        self.velocity_at_cells(position).map(|v| v.to_array()[0])
    }

    /// Velocities (m/s) at positions in cells from the low corner.
    #[inline(always)]
    pub(crate) fn velocity_at_cells(&self, positions: [f64x4; 3]) -> [f64x4; 3] {
        let [u, v, w] = &self.velocity;
        let [x, y, z] = &self.samplers;
        [
            x.sample(u, positions),
            y.sample(v, positions),
            z.sample(w, positions),
        ]
    }

    /// Sampler of the component along `axis`.
    pub(crate) fn sampler(&self, axis: usize) -> &Sampler {
        &self.samplers[axis]
    }

    /// Whether all velocities are numbers of finite size.
    pub(crate) fn is_finite(&self) -> bool {
        self.velocity
            .iter()
            .chain(&self.inflow)
            .flatten()
            .all(|v| v.is_finite())
    }

    /// Divergence of the velocity (1/s) in cell `(i, j, k)`.
    ///
    /// # Panics
    ///
    /// Outside of the grid.
    pub fn divergence(&self, cell: [usize; 3]) -> f64 {
        let at = self.lattice.index(cell);
        let difference = |axis: usize| {
            let component = &self.velocity[axis];
            component[at + self.lattice.strides[axis]] - component[at]
        };
        (difference(0) + difference(1) + difference(2)) / self.cell
    }

    /// Largest magnitude of the divergence (1/s) over all cells.
    pub fn max_divergence(&self) -> f64 {
        let [nx, ny, nz] = self.lattice.cells;
        let row = |r: usize| {
            let of_cell = |i: usize| self.divergence([i, r % ny, r / ny]).abs();
            (0..nx).map(of_cell).fold(0.0, f64::max)
        };
        (0..ny * nz)
            .into_par_iter()
            .map(row)
            .reduce(|| 0.0, f64::max)
    }
}

fn check_size(cells: [usize; 3], cell: f64) -> Result<(), TurbulenceError> {
    if cells.contains(&0) {
        return Err(TurbulenceError::EmptyGrid { cells });
    }
    if !(cell > 0.0 && cell.is_finite()) {
        return Err(TurbulenceError::CellSize { cell });
    }
    match MacGrid::bytes(cells) {
        Some(bytes) if bytes <= MacGrid::MAX_BYTES => Ok(()),
        bytes => Err(TurbulenceError::GridTooLarge {
            cells,
            gigabytes: bytes.map_or(f64::INFINITY, |b| b as f64 / (1u64 << 30) as f64),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Boundary::{Periodic, Through, Walls};

    #[test]
    fn interpolation_is_exact_for_linear_fields_inside() {
        let mut grid = MacGrid::new([5, 7, 3], 0.25, [Walls, Through, Walls]).unwrap();
        // No velocity along x and z at their walls, as walls would change it.
        let field = |[x, y, z]: [f64; 3]| [0.0, 2.0 + 3.0 * x - y + 0.5 * z, 0.0];
        grid.set_velocity(field);
        for point in [
            [0.2, 0.0, 0.3],
            [0.9, 1.1, 0.5],
            [1.1, 1.75, 0.125],
            [0.5, 0.1, 0.6],
        ] {
            let (got, expected) = (grid.velocity_at(point), field(point));
            assert!((got[1] - expected[1]).abs() < 1e-14, "{point:?}: {got:?}");
        }
    }

    #[test]
    fn periodic_reads_wrap() {
        let mut grid = MacGrid::new([6, 4, 5], 1.0, [Periodic; 3]).unwrap();
        let wave = |x: f64, n: f64| libm::sin(core::f64::consts::TAU * x / n);
        grid.set_velocity(|[x, y, z]| [wave(x, 6.0) + wave(y, 4.0), wave(z, 5.0), wave(x, 6.0)]);
        for point in [[0.1, 0.2, 0.3], [5.9, 3.9, 4.9], [2.5, 1.5, 0.0]] {
            let [a, b] = [0.0, 1.0].map(|turn| {
                grid.velocity_at([
                    point[0] - 6.0 * turn,
                    point[1] + 8.0 * turn,
                    point[2] + 5.0 * turn,
                ])
            });
            for axis in 0..3 {
                assert!((a[axis] - b[axis]).abs() < 1e-14, "{point:?}");
            }
        }
    }

    #[test]
    fn walls_stop_the_normal_component_and_slip_otherwise() {
        let mut grid = MacGrid::new([4, 4, 4], 1.0, [Walls; 3]).unwrap();
        grid.set_velocity(|_| [1.0, 1.0, 1.0]);
        assert_eq!(grid.velocity_at([0.0, 2.0, 2.0]), [0.0, 1.0, 1.0]);
        assert_eq!(grid.velocity_at([-3.0, 2.0, 9.0]), [0.0, 1.0, 0.0]);
    }

    #[test]
    fn refuses_bad_grids() {
        let sides = [Walls, Through, Walls];
        let refused = |cells, cell| MacGrid::new(cells, cell, sides).unwrap_err();
        assert!(matches!(
            refused([4, 0, 4], 1.0),
            TurbulenceError::EmptyGrid { .. }
        ));
        for cell in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                refused([4; 3], cell),
                TurbulenceError::CellSize { .. }
            ));
        }
        let error = refused([1000; 3], 1.0);
        assert!(error.to_string().contains("112.4 GiB"), "{error}");
        assert!(matches!(
            refused([usize::MAX; 3], 1.0),
            TurbulenceError::GridTooLarge { .. }
        ));
        let sideways = MacGrid::new([4; 3], 1.0, [Through, Walls, Walls]).unwrap_err();
        assert!(matches!(sideways, TurbulenceError::StreamAxis { axis: 0 }));
    }
}
