//! How the values of a grid lie in memory.

use super::lanes::LANES;

/// What bounds the domain along one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// The low and the high side are the same place.
    Periodic,
    /// Slip walls on both sides: nothing crosses them and they exert no stress.
    Walls,
    /// Prescribed inflow through the low side, outflow at constant pressure through the high side.
    /// The axis of the stream, `Y`, is the only one that may have it.
    Through,
}

/// Sizes and strides shared by all fields of a grid.
///
/// A field has one value for each cell and for one more layer of cells all around, x fastest.
/// Cell `(i, j, k)` is at `[i + 1, j + 1, k + 1]`; a face has the index of the cell on its high side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lattice {
    pub(crate) cells: [usize; 3],
    pub(crate) boundaries: [Boundary; 3],
    /// Values to the next cell along each axis.
    pub(crate) strides: [usize; 3],
}

impl Lattice {
    pub(super) fn new(cells: [usize; 3], boundaries: [Boundary; 3]) -> Self {
        let row = cells[0] + 2;
        Self {
            cells,
            boundaries,
            strides: [1, row, row * (cells[1] + 2)],
        }
    }

    /// Values of a field: cells, the outer layer, and what reading a few cells at a time runs over.
    pub(crate) fn len(&self) -> usize {
        self.strides[2] * (self.cells[2] + 2) + LANES
    }

    /// Values of a row, both ends included.
    pub(crate) fn row(&self) -> usize {
        self.strides[1]
    }

    /// Index of cell `(i, j, k)`.
    pub(crate) fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i + 1) + (j + 1) * self.strides[1] + (k + 1) * self.strides[2]
    }

    /// `(j, k)` of a row, counted with the outer layer: 1 is the first row of cells.
    pub(crate) fn padded_row(&self, row: usize) -> [usize; 2] {
        let rows = self.cells[1] + 2;
        [row % rows, row / rows]
    }

    /// `(j, k)` of a row of cells, `None` for a row of the outer layer.
    pub(crate) fn row_of_cells(&self, row: usize) -> Option<[usize; 2]> {
        let [j, k] = self.padded_row(row);
        let inside = (1..=self.cells[1]).contains(&j) && (1..=self.cells[2]).contains(&k);
        inside.then(|| [j - 1, k - 1])
    }

    /// Faces normal to `axis` whose value the flow decides, as a range of indices along the axis.
    pub(crate) fn free_faces(&self, axis: usize) -> core::ops::Range<usize> {
        let n = self.cells[axis];
        match self.boundaries[axis] {
            Boundary::Periodic => 0..n,
            Boundary::Walls => 1..n,
            Boundary::Through => 1..n + 1,
        }
    }

    /// `(j, k)` of a row of faces normal to `axis` that the flow decides (all or part of the row
    /// for `x`), `None` for other rows.
    pub(crate) fn row_of_faces(&self, axis: usize, row: usize) -> Option<[usize; 2]> {
        let [j, k] = self.padded_row(row);
        let place = [j.checked_sub(1)?, k.checked_sub(1)?];
        let decided = |a: usize| match a == axis {
            true => self.free_faces(a).contains(&place[a - 1]),
            false => place[a - 1] < self.cells[a],
        };
        (decided(1) && decided(2)).then_some(place)
    }

    /// Sets the last face (periodic) or both outer faces (walls) of a component along its own axis.
    pub(crate) fn close_faces(&self, component: &mut [f64], axis: usize) {
        let last = self.cells[axis] * self.strides[axis];
        match self.boundaries[axis] {
            Boundary::Periodic => {
                self.for_lines(axis, |start| component[start + last] = component[start]);
            }
            Boundary::Walls => self.for_lines(axis, |start| {
                component[start] = 0.0;
                component[start + last] = 0.0;
            }),
            Boundary::Through => {}
        }
    }

    /// Fills the outer layer of a field along an axis on which it is at cell centres.
    ///
    /// Periodic: the other side. Inflow: so that the face between has the value of `inflow`.
    /// Elsewhere: the slope of the two cells inside.
    pub(crate) fn fill_layer(&self, field: &mut [f64], axis: usize, inflow: &[f64]) {
        let (n, s) = (self.cells[axis], self.strides[axis]);
        let inner = |first: f64, second: f64| if n > 1 { 2.0 * first - second } else { first };
        self.for_lines(axis, |first| {
            let (low, last, high) = (first - s, first + (n - 1) * s, first + n * s);
            [field[low], field[high]] = match self.boundaries[axis] {
                Boundary::Periodic => [field[last], field[first]],
                Boundary::Walls => [
                    inner(field[first], field[first + s]),
                    inner(field[last], field[last - s]),
                ],
                Boundary::Through => [
                    2.0 * inflow[self.inflow_index(first)] - field[first],
                    inner(field[last], field[last - s]),
                ],
            };
        });
    }

    /// Calls `visit` with the index of the first cell of each line along `axis`, lines of the outer
    /// layer included.
    pub(super) fn for_lines(&self, axis: usize, mut visit: impl FnMut(usize)) {
        let [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
        for q in 0..self.cells[b] + 2 {
            for p in 0..self.cells[a] + 2 {
                visit(self.strides[axis] + p * self.strides[a] + q * self.strides[b]);
            }
        }
    }

    /// Values on the inflow face: a plane with the outer layer, x fastest.
    pub(crate) fn inflow_len(&self) -> usize {
        self.strides[1] * (self.cells[2] + 2)
    }

    /// Index in a plane of inflow values of what is above it at `index`.
    pub(super) fn inflow_index(&self, index: usize) -> usize {
        index % self.strides[1] + (index / self.strides[2]) * self.strides[1]
    }
}
