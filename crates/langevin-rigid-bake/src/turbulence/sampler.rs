//! Reading a field between its values, by linear interpolation in each direction.

use wide::f64x4;

use super::lanes::{LANES, indices, nearest_whole, whole_below};
use super::lattice::{Boundary, Lattice};

/// How positions along one axis become the lower of two neighbours and a weight.
#[derive(Debug, Clone, Copy)]
struct Placement {
    /// Range of positions (cells) between the outer values.
    low: f64x4,
    high: f64x4,
    /// Place of position 0 among the values, the outer layer included.
    offset: f64x4,
    /// Highest lower neighbour.
    last: f64x4,
    /// Cells in a period, and one over it.
    period: Option<[f64x4; 2]>,
}

impl Placement {
    /// Placement along an axis for values on faces (`half` 0) or at centres (`half` 0.5).
    fn new(cells: usize, boundary: Boundary, half: f64) -> Self {
        let n = cells as f64;
        let [low, high] = match boundary {
            Boundary::Periodic => [0.0, n],
            Boundary::Walls => [half, n - half],
            Boundary::Through => [0.0, n - half],
        };
        Self {
            low: f64x4::splat(low),
            high: f64x4::splat(high),
            offset: f64x4::splat(1.0 - half),
            last: f64x4::splat(n),
            period: (boundary == Boundary::Periodic).then(|| [n, 1.0 / n].map(f64x4::splat)),
        }
    }

    /// Lower neighbours and weights of the upper ones.
    #[inline(always)]
    fn locate(&self, mut position: f64x4) -> [f64x4; 2] {
        if let Some([period, inverse]) = self.period {
            position -= nearest_whole(position * inverse - f64x4::splat(0.5)) * period;
        }
        let at = position.fast_max(self.low).fast_min(self.high) + self.offset;
        let lower = whole_below(at).fast_min(self.last);
        [lower, at - lower]
    }
}

/// Neighbours of points and their weights.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stencil {
    base: [usize; LANES],
    weights: [f64x4; 3],
}

/// Reads fields with one staggering.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sampler {
    placements: [Placement; 3],
    row: usize,
    plane: usize,
    /// The same two as numbers.
    row_lanes: f64x4,
    plane_lanes: f64x4,
    /// Values that may be the first of a stencil.
    bases: usize,
}

impl Sampler {
    /// Sampler of the component along `axis` of the velocity.
    pub(crate) fn of_faces(lattice: &Lattice, axis: usize) -> Self {
        Self::new(lattice, |a| if a == axis { 0.0 } else { 0.5 })
    }

    /// Sampler of a field at cell centres.
    pub(crate) fn of_centres(lattice: &Lattice) -> Self {
        Self::new(lattice, |_| 0.5)
    }

    fn new(lattice: &Lattice, half: impl Fn(usize) -> f64) -> Self {
        let placement = |a: usize| Placement::new(lattice.cells[a], lattice.boundaries[a], half(a));
        let [_, row, plane] = lattice.strides;
        Self {
            placements: core::array::from_fn(placement),
            row,
            plane,
            row_lanes: f64x4::splat(row as f64),
            plane_lanes: f64x4::splat(plane as f64),
            bases: lattice.len() - plane - row,
        }
    }

    /// Neighbours of positions in cells from the low corner of the domain.
    #[inline(always)]
    pub(crate) fn stencil(&self, [x, y, z]: [f64x4; 3]) -> Stencil {
        let [i, x] = self.placements[0].locate(x);
        let [j, y] = self.placements[1].locate(y);
        let [k, z] = self.placements[2].locate(z);
        let [p, q, r, s] = indices(i + j * self.row_lanes + k * self.plane_lanes);
        // A position that is not a number has no place; any will do, its weight is not a number.
        let last = self.bases - 2;
        Stencil {
            base: [p.min(last), q.min(last), r.min(last), s.min(last)],
            weights: [x, y, z],
        }
    }

    /// Values of `field` at a stencil.
    #[inline(always)]
    pub(crate) fn read(&self, field: &[f64], at: Stencil) -> f64x4 {
        // Four slices of one length: one check of a base serves the four pairs that start there.
        let n = self.bases;
        let (near, right) = (&field[..n], &field[self.row..][..n]);
        let (above, opposite) = (
            &field[self.plane..][..n],
            &field[self.plane + self.row..][..n],
        );
        let [x, y, z] = at.weights;
        let [p, q, r, s] = at.base;
        let along_x = |row: &[f64]| {
            let high = f64x4::new([row[p + 1], row[q + 1], row[r + 1], row[s + 1]]);
            let low = f64x4::new([row[p], row[q], row[r], row[s]]);
            low + x * (high - low)
        };
        let (a, b) = (along_x(near), along_x(right));
        let (c, d) = (along_x(above), along_x(opposite));
        let (low, high) = (a + y * (b - a), c + y * (d - c));
        low + z * (high - low)
    }

    /// Values of `field` at positions in cells from the low corner of the domain.
    #[inline(always)]
    pub(crate) fn sample(&self, field: &[f64], positions: [f64x4; 3]) -> f64x4 {
        self.read(field, self.stencil(positions))
    }
}
