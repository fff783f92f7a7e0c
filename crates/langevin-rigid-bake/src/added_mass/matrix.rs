//! The dense symmetric matrix of the hypersingular operator, and products with it.

use rayon::prelude::*;
use wide::bytemuck::cast_slice;
use wide::f64x4;

use super::operator::{Operator, Six, SparseRow};

/// Columns per block: a block is the unit of parallel work.
pub(super) const BLOCK: usize = 64;
/// Lanes of four per row of a block.
pub(super) const GROUPS: usize = BLOCK / 4;
/// Rows whose entries are reused from the first-level cache during a product.
const STRIP: usize = 8;

/// A symmetric n x n matrix as blocks of columns: block k holds entries (row, 64 k + lane), row by
/// row; lanes beyond n are zero.
#[derive(Debug, Clone)]
pub(super) struct Matrix {
    n: usize,
    blocks: Vec<Vec<f64x4>>,
}

impl Matrix {
    pub(super) fn new(n: usize, blocks: Vec<Vec<f64x4>>) -> Matrix {
        debug_assert!(blocks.iter().all(|b| b.len() == n * GROUPS));
        Matrix { n, blocks }
    }

    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        let block: &[f64] = cast_slice(&self.blocks[column / BLOCK]);
        block[row * BLOCK + column % BLOCK]
    }

    /// The combination sum w_i W(i, :) of rows, as a full row.
    pub(super) fn combined_row(&self, members: &[(u32, f64)]) -> Vec<f64> {
        let mut row = vec![0.0; self.blocks.len() * BLOCK];
        for (block, part) in self.blocks.iter().zip(row.chunks_exact_mut(BLOCK)) {
            let block: &[f64] = cast_slice(block);
            for &(i, weight) in members {
                let entries = &block[i as usize * BLOCK..][..BLOCK];
                for (sum, entry) in part.iter_mut().zip(entries) {
                    *sum += weight * entry;
                }
            }
        }
        row.truncate(self.n);
        row
    }

    /// T^t W T, column j of T given by its nonzero entries `members[j]`.
    pub(super) fn restricted(&self, members: &[Vec<(u32, f64)>]) -> Matrix {
        let n = members.len();
        let blocks = members
            .par_chunks(BLOCK)
            .map(|columns| self.restricted_block(columns, members))
            .collect();
        Matrix::new(n, blocks)
    }

    fn restricted_block(
        &self,
        columns: &[Vec<(u32, f64)>],
        members: &[Vec<(u32, f64)>],
    ) -> Vec<f64x4> {
        let mut block = vec![f64x4::ZERO; members.len() * GROUPS];
        let entries: &mut [f64] = wide::bytemuck::cast_slice_mut(&mut block);
        for (lane, column) in columns.iter().enumerate() {
            let row = self.combined_row(column);
            for (v, children) in members.iter().enumerate() {
                entries[v * BLOCK + lane] =
                    children.iter().map(|&(j, w)| w * row[j as usize]).sum();
            }
        }
        block
    }
}

impl Operator for Matrix {
    /// Every entry is summed in the order of the rows.
    fn product(&self, x: &[Six]) -> Vec<Six> {
        let spread: Vec<[f64x4; 6]> = x.iter().map(|v| v.map(f64x4::splat)).collect();
        let blocks: Vec<[[f64x4; 6]; GROUPS]> = self
            .blocks
            .par_iter()
            .map(|block| block_product(block, &spread))
            .collect();
        let lanes = blocks.iter().flatten().flat_map(|group| {
            let columns = group.map(f64x4::to_array);
            [0, 1, 2, 3].map(|lane| columns.map(|c| c[lane]))
        });
        lanes.take(self.n).collect()
    }

    fn diagonal(&self) -> Vec<f64> {
        (0..self.n).map(|i| self.get(i, i)).collect()
    }

    fn block(&self, rows: &[usize]) -> Vec<f64> {
        let entries = rows
            .iter()
            .flat_map(|&row| rows.iter().map(move |&column| (row, column)));
        entries
            .map(|(row, column)| self.get(row.max(column), row.min(column)))
            .collect()
    }

    fn galerkin(&self, members: &[SparseRow]) -> Vec<f64> {
        let (m, small) = (members.len(), self.restricted(members));
        (0..m * m).map(|k| small.get(k / m, k % m)).collect()
    }

    fn most_coarse(&self) -> usize {
        400
    }
}

fn block_product(block: &[f64x4], x: &[[f64x4; 6]]) -> [[f64x4; 6]; GROUPS] {
    let mut total = [[f64x4::ZERO; 6]; GROUPS];
    for (rows, x) in block.chunks(STRIP * GROUPS).zip(x.chunks(STRIP)) {
        for (group, sums) in total.iter_mut().enumerate() {
            let mut kept = *sums;
            for (row, x) in rows.chunks_exact(GROUPS).zip(x) {
                let w = row[group];
                for c in 0..6 {
                    kept[c] += w * x[c];
                }
            }
            *sums = kept;
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    /// W(i, j) = 1 / (1 + |i - j|).
    fn sample(n: usize) -> Matrix {
        let entry = |i: usize, j: usize| 1.0 / (1.0 + i.abs_diff(j) as f64);
        let block = |k: usize| {
            let lane = |i: usize, l: usize| {
                let j = k * BLOCK + l;
                if j < n { entry(i, j) } else { 0.0 }
            };
            (0..n)
                .flat_map(|i| (0..GROUPS).map(move |g| (i, g)))
                .map(|(i, g)| f64x4::new([0, 1, 2, 3].map(|l| lane(i, 4 * g + l))))
                .collect()
        };
        Matrix::new(n, (0..n.div_ceil(BLOCK)).map(block).collect())
    }

    #[test]
    fn product_is_the_sum_over_columns() {
        let (n, m) = (150, sample(150));
        let x: Vec<Six> = (0..n)
            .map(|i| [1.0, i as f64, 0.0, -1.0, 2.0, 0.5])
            .collect();
        let y = m.product(&x);
        for i in [0, 63, 64, 149] {
            let want: f64 = (0..n).map(|j| m.get(i, j) * x[j][1]).sum();
            assert!((y[i][1] - want).abs() < 1e-12 * want);
            assert_eq!(y[i][0], -y[i][3]);
        }
    }

    #[test]
    fn restriction_to_pairs_adds_four_entries() {
        let m = sample(130);
        let members: Vec<Vec<(u32, f64)>> = (0..65)
            .map(|i| vec![(2 * i, 1.0), (2 * i + 1, 0.5)])
            .collect();
        let r = m.restricted(&members);
        let want = m.get(4, 10) + 0.5 * (m.get(5, 10) + m.get(4, 11)) + 0.25 * m.get(5, 11);
        assert!((r.get(2, 5) - want).abs() < 1e-15);
        assert!((r.get(64, 0) - r.get(0, 64)).abs() < 1e-15);
    }
}
