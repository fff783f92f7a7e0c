//! Semi-Lagrangian advection (Stam 1999): each value comes from where the flow was a step ago.

use rayon::prelude::*;
use wide::f64x4;

use super::grid::MacGrid;
use super::lanes::{LANES, counted_from, load, store};
use super::lattice::{Boundary, Lattice};

/// Paths of the cell centres back over one step, by the midpoint rule in the frozen mean flow.
///
/// The path of a face is the mean of the paths of the two cells that share it: second-order, as the
/// interpolation is, and it makes one path serve a cell, its faces and its turbulence.
#[derive(Debug, Clone)]
pub(crate) struct Trace {
    lattice: Lattice,
    /// From the centre of a cell to where its fluid came from (cells), per component.
    displacement: [Vec<f64>; 3],
}

impl Trace {
    pub(crate) fn new(lattice: Lattice) -> Self {
        let field = || vec![0.0; lattice.len()];
        Self {
            lattice,
            displacement: [field(), field(), field()],
        }
    }

    /// Traces all cells back over `dt` seconds.
    pub(crate) fn run(&mut self, grid: &MacGrid, dt: f64) {
        let lattice = self.lattice;
        let (to_cells, length) = (f64x4::splat(-dt / grid.cell), lattice.row());
        let [dx, dy, dz] = &mut self.displacement;
        dx.par_chunks_exact_mut(length)
            .zip(dy.par_chunks_exact_mut(length))
            .zip(dz.par_chunks_exact_mut(length))
            .enumerate()
            .for_each(|(row, ((dx, dy), dz))| {
                if let Some(place) = lattice.row_of_cells(row) {
                    trace_row(grid, place, to_cells, [dx, dy, dz]);
                }
            });
    }

    /// Displacements of the cells from `index` on.
    #[inline(always)]
    fn at(&self, index: usize) -> [f64x4; 3] {
        let [dx, dy, dz] = &self.displacement;
        [load(dx, index), load(dy, index), load(dz, index)]
    }

    /// Part of the step that the fluid of cells in row `j` has spent inside of the inflow face: 1
    /// unless it came in during the step.
    #[inline(always)]
    pub(crate) fn time_inside(&self, index: usize, j: usize) -> f64x4 {
        if self.lattice.boundaries[1] != Boundary::Through {
            return f64x4::splat(1.0);
        }
        let from_face = f64x4::splat(j as f64 + 0.5);
        from_face / from_face.fast_max(-load(&self.displacement[1], index))
    }

    /// Where the fluid of cells from `[i, j, k]` on came from (cells from the low corner).
    #[inline(always)]
    pub(crate) fn feet_of_cells(&self, [i, j, k]: [usize; 3], index: usize) -> [f64x4; 3] {
        let [dx, dy, dz] = self.at(index);
        let centre = |n: usize| f64x4::splat(n as f64 + 0.5);
        [
            counted_from(i as f64 + 0.5) + dx,
            centre(j) + dy,
            centre(k) + dz,
        ]
    }
}

/// Displacements (cells) of the fluid of a row of cells back over a step; `to_cells` is minus the
/// step over the cell size.
fn trace_row(grid: &MacGrid, [j, k]: [usize; 2], to_cells: f64x4, out: [&mut [f64]; 3]) {
    let (lattice, n) = (grid.lattice, grid.lattice.cells[0]);
    let [dx, dy, dz] = out;
    for i in (0..n).step_by(LANES) {
        let at = lattice.index([i, j, k]);
        let quarter = f64x4::splat(0.25) * to_cells;
        let halfway = |axis: usize| {
            let component = &grid.velocity[axis];
            quarter * (load(component, at) + load(component, at + lattice.strides[axis]))
        };
        let midpoint = [
            counted_from(i as f64 + 0.5) + halfway(0),
            f64x4::splat(j as f64 + 0.5) + halfway(1),
            f64x4::splat(k as f64 + 0.5) + halfway(2),
        ];
        let [u, v, w] = grid.velocity_at_cells(midpoint);
        store(&mut dx[..=n], i + 1, u * to_cells);
        store(&mut dy[..=n], i + 1, v * to_cells);
        store(&mut dz[..=n], i + 1, w * to_cells);
    }
    // Before the first face of a period is the last cell.
    if lattice.boundaries[0] == Boundary::Periodic {
        [dx[0], dy[0], dz[0]] = [dx[n], dy[n], dz[n]];
    }
}

/// Carries the component along `axis` of the velocity of `grid` along the paths, into `next`.
///
/// Faces that walls or the inflow prescribe are left as they are in `next`.
pub(crate) fn carry_component(grid: &MacGrid, trace: &Trace, axis: usize, next: &mut [f64]) {
    let lattice = grid.lattice;
    next.par_chunks_exact_mut(lattice.row())
        .enumerate()
        .for_each(|(row, next)| {
            if let Some(place) = lattice.row_of_faces(axis, row) {
                carry_row(grid, trace, axis, place, next);
            }
        });
}

/// Carries a row of faces normal to `axis`.
fn carry_row(grid: &MacGrid, trace: &Trace, axis: usize, [j, k]: [usize; 2], next: &mut [f64]) {
    let lattice = grid.lattice;
    let (sampler, from) = (grid.sampler(axis), &grid.velocity[axis]);
    let faces = if axis == 0 {
        lattice.free_faces(0)
    } else {
        0..lattice.cells[0]
    };
    let [low, high] = rows_beside(&lattice, axis, [j, k]);
    let centre = |a: usize| if a == axis { 0.0 } else { 0.5 };
    let (y, z) = (j as f64 + centre(1), k as f64 + centre(2));
    let half = f64x4::splat(0.5);
    // Rows of one length, so that one check of a place serves them all.
    let length = faces.end + LANES;
    let [dx, dy, dz] = &trace.displacement;
    let (ax, ay, az) = (
        &dx[low..][..length],
        &dy[low..][..length],
        &dz[low..][..length],
    );
    let (bx, by, bz) = (
        &dx[high..][..length],
        &dy[high..][..length],
        &dz[high..][..length],
    );
    for i in faces.clone().step_by(LANES) {
        let feet = [
            counted_from(i as f64 + centre(0)) + half * (load(ax, i) + load(bx, i)),
            f64x4::splat(y) + half * (load(ay, i) + load(by, i)),
            f64x4::splat(z) + half * (load(az, i) + load(bz, i)),
        ];
        store(&mut next[..=faces.end], i + 1, sampler.sample(from, feet));
    }
}

/// Indices of the first cells on the low and the high side of a row of faces.
fn rows_beside(lattice: &Lattice, axis: usize, [j, k]: [usize; 2]) -> [usize; 2] {
    if axis == 0 {
        let first = lattice.index([0, j, k]);
        return [first - 1, first];
    }
    let n = lattice.cells[axis];
    let row = |along: usize| {
        let mut place = [0, j, k];
        place[axis] = along;
        lattice.index(place)
    };
    let face = [0, j, k][axis];
    // Past the outflow there are no cells: the last ones stand for them.
    [
        row(if face == 0 { n - 1 } else { face - 1 }),
        row(face.min(n - 1)),
    ]
}
