//! Sums over many columns at once, in the processor's lanes; the same bits at any width.

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x4};

/// Columns of one product: three components of six vectors, and two spare.
pub(super) const COLUMNS: usize = 20;
const GROUPS: usize = COLUMNS / 4;

/// A number for each column.
pub(super) type Columns = [f64; COLUMNS];
/// Zeros.
pub(super) const NONE: Columns = [0.0; COLUMNS];

/// A row in registers.
type Row<S> = [f64x4<S>; GROUPS];

#[inline(always)]
fn load<S: Simd>(simd: S, columns: &Columns) -> Row<S> {
    let mut row = [f64x4::splat(simd, 0.0); GROUPS];
    for g in 0..GROUPS {
        row[g] = f64x4::from_slice(simd, &columns[4 * g..4 * g + 4]);
    }
    row
}

#[inline(always)]
fn store<S: Simd>(row: &Row<S>, columns: &mut Columns) {
    for (group, four) in row.iter().zip(columns.chunks_exact_mut(4)) {
        group.store_slice(four);
    }
}

/// sum += weight * row.
#[inline(always)]
fn add_scaled<S: Simd>(simd: S, sum: &mut Row<S>, weight: f64, columns: &Columns) {
    let weight = f64x4::splat(simd, weight);
    let row = load(simd, columns);
    for g in 0..GROUPS {
        sum[g] += row[g] * weight;
    }
}

/// expansion[i] += weights[i] * density.
pub(super) fn accumulate<const N: usize>(
    expansion: &mut [Columns; N],
    weights: &[f64; N],
    density: &Columns,
) {
    dispatch!(Level::new(), simd => {
        for (column, &weight) in expansion.iter_mut().zip(weights) {
            let mut sum = load(simd, column);
            add_scaled(simd, &mut sum, weight, density);
            store(&sum, column);
        }
    });
}

/// sum += weights . rows.
pub(super) fn combine<const N: usize>(weights: &[f64; N], rows: &[Columns; N], sum: &mut Columns) {
    dispatch!(Level::new(), simd => {
        let mut total = load(simd, sum);
        for (&weight, row) in weights.iter().zip(rows) {
            add_scaled(simd, &mut total, weight, row);
        }
        store(&total, sum);
    });
}

/// y += M x.
pub(super) fn multiply_add<const N: usize>(
    matrix: &[[f64; N]; N],
    x: &[Columns; N],
    y: &mut [Columns; N],
) {
    dispatch!(Level::new(), simd => {
        for (row, column) in matrix.iter().zip(y) {
            let mut sum = load(simd, column);
            for (&entry, x) in row.iter().zip(x) {
                add_scaled(simd, &mut sum, entry, x);
            }
            store(&sum, column);
        }
    });
}

/// y[i] += sum_j entry(i, j) x[j], the entries `strides` apart along i and j.
pub(super) fn add_products(entries: &[f32], strides: [usize; 2], x: &[Columns], y: &mut [Columns]) {
    dispatch!(Level::new(), simd => {
        for (i, column) in y.iter_mut().enumerate() {
            let mut sum = load(simd, column);
            for (j, x) in x.iter().enumerate() {
                let entry = f64::from(entries[i * strides[0] + j * strides[1]]);
                add_scaled(simd, &mut sum, entry, x);
            }
            store(&sum, column);
        }
    });
}

pub(super) fn transposed<const N: usize>(m: &[[f64; N]; N]) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}
