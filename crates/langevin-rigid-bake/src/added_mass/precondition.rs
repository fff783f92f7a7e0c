//! Preconditioners: the diagonal, and for thin bodies an approximate inverse with a coarse space.
//!
//! On a thin body the modes that are equal on both faces have energies of the order of the
//! thickness; the diagonal does not see them. A factorized sparse approximate inverse (L. Kolotilina
//! and A. Yeremin, 1993) over the neighbours in space, which include the opposite face, does.
//!
//! On a needle, whose triangles are longer than it is around, the softest modes are equal all around and vary
//! along it alone. The coarse space has them if each station along the needle has a function of its own, and what the
//! edge layer put between stations is linear there: a function made of distances is not, and its defect costs
//! (length of a triangle / width of the needle)^2 times the energy of the mode, as many iterations as their ratio.

use rayon::prelude::*;

use super::AddedMassError;
use super::operator::Six;
use super::operator::{Operator, SparseRow};
use super::panels::Vec3;
use super::report::Cancel;
use crate::mesh::vector::{bounding_box, dot, sub};

/// Neighbours in the factorized sparse approximate inverse.
const NEIGHBOURS: usize = 24;
/// Order from which fewer products with W pay for the better preconditioner on any body.
const LARGE: usize = 3000;
/// Vertices per coarse function.
const COARSENING: usize = 16;
/// So many times as many of them on a needle.
const FINER: usize = 2;
/// Vertices that a search for neighbours passes over together.
const GROUP: usize = 32;
/// What W is where it has no such inverse.
const NOT_POSITIVE: AddedMassError = AddedMassError::Singular {
    iteration: 0,
    energy: 0.0,
};

/// An approximate inverse of W.
pub(super) enum Preconditioner {
    /// 1 / W_ii.
    Diagonal(Vec<f64>),
    /// G^t G + Q (Q^t W Q)^-1 Q^t.
    TwoLevel {
        factor: SparseFactor,
        coarse: Coarse,
    },
}

impl Preconditioner {
    /// The one for a body with these vertices.
    ///
    /// A constant on one component of the surface has no energy; `components` tells them apart. A body whose triangles
    /// are longer than it is around is a `needle`, given by its functions without the edge layer.
    pub(super) fn new(
        w: &dyn Operator,
        vertices: &[Vec3],
        components: &[u32],
        sheet: bool,
        needle: Option<&[SparseRow]>,
        cancel: &Cancel,
    ) -> Result<Preconditioner, AddedMassError> {
        let diagonal = w.diagonal();
        if !diagonal.iter().all(|&d| d > 0.0) {
            return Err(NOT_POSITIVE);
        }
        let simple = !sheet && vertices.len() < LARGE;
        if simple || vertices.len() < 4 * NEIGHBOURS {
            return Ok(Preconditioner::Diagonal(
                diagonal.iter().map(|d| 1.0 / d).collect(),
            ));
        }
        Ok(Preconditioner::TwoLevel {
            factor: SparseFactor::new(w, vertices, components, cancel)?,
            coarse: Coarse::new(w, vertices, components, needle, cancel)?,
        })
    }

    pub(super) fn apply(&self, r: &[Six]) -> Vec<Six> {
        match self {
            Preconditioner::Diagonal(inverse) => r
                .iter()
                .zip(inverse)
                .map(|(r, d)| r.map(|v| v * d))
                .collect(),
            Preconditioner::TwoLevel { factor, coarse } => {
                let mut z = factor.apply(r);
                coarse.add_correction(r, &mut z);
                z
            }
        }
    }
}

/// Lower triangular G with G^t G close to the inverse of W.
pub(super) struct SparseFactor {
    rows: Vec<SparseRow>,
    columns: Vec<SparseRow>,
}

impl SparseFactor {
    fn new(
        w: &dyn Operator,
        vertices: &[Vec3],
        components: &[u32],
        cancel: &Cancel,
    ) -> Result<SparseFactor, AddedMassError> {
        let groups: Vec<Group> = vertices.chunks(GROUP).map(Group::new).collect();
        let small = small_components(components);
        let rows: Vec<SparseRow> = (0..vertices.len())
            .into_par_iter()
            .with_min_len(16)
            .map(|i| {
                cancel.check()?;
                factor_row(w, vertices, &groups, &small, i).ok_or(NOT_POSITIVE)
            })
            .collect::<Result<_, _>>()?;
        let columns = transposed(&rows, vertices.len());
        Ok(SparseFactor { rows, columns })
    }

    fn apply(&self, r: &[Six]) -> Vec<Six> {
        multiply(&self.columns, &multiply(&self.rows, r))
    }
}

/// Row i of G: the last column of the inverse of W over i and its earlier neighbours, normalized.
fn factor_row(
    w: &dyn Operator,
    vertices: &[Vec3],
    groups: &[Group],
    small: &[Option<u32>],
    i: usize,
) -> Option<SparseRow> {
    let mut members = nearest(vertices, groups, i, NEIGHBOURS);
    members.retain(|&j| j <= i);
    members.sort_unstable();
    let m = members.len();
    let mut block = w.block(&members);
    let energy = block[m * m - 1];
    for (row, &j) in members.iter().enumerate() {
        for (column, &k) in members.iter().enumerate() {
            if small[j].is_some() && small[j] == small[k] {
                block[row * m + column] += energy;
            }
        }
    }
    let factor = Cholesky::new(block, m)?;
    let mut y = vec![0.0; m];
    y[m - 1] = 1.0;
    factor.solve(&mut y);
    let norm = y[m - 1].sqrt();
    Some(
        members
            .iter()
            .zip(&y)
            .map(|(&j, y)| (j as u32, y / norm))
            .collect(),
    )
}

/// The component of each vertex, if all of it may be among the neighbours, whose constants then need an energy.
fn small_components(components: &[u32]) -> Vec<Option<u32>> {
    let mut sizes = vec![0; components.len()];
    components.iter().for_each(|&c| sizes[c as usize] += 1);
    let small = |&c: &u32| (sizes[c as usize] <= NEIGHBOURS).then_some(c);
    components.iter().map(small).collect()
}

/// A run of vertices, for passing over many at once.
struct Group {
    bounds: [Vec3; 2],
}

impl Group {
    fn new(vertices: &[Vec3]) -> Group {
        Group {
            bounds: bounding_box(vertices),
        }
    }

    fn distance2(&self, v: Vec3) -> f64 {
        let [low, high] = self.bounds;
        let outside: Vec3 = std::array::from_fn(|k| (low[k] - v[k]).max(v[k] - high[k]).max(0.0));
        dot(outside, outside)
    }
}

/// The `count` vertices nearest to vertex `i`, itself among them; the earlier one of two equally near.
/// Searched outwards along the curve on which neighbours in memory are neighbours in space.
fn nearest(vertices: &[Vec3], groups: &[Group], i: usize, count: usize) -> Vec<usize> {
    let mut found: Vec<(f64, usize)> = Vec::with_capacity(count + 1);
    let mut offer = |group: usize| {
        let worst = |found: &[(f64, usize)]| found.get(count - 1).map_or(f64::INFINITY, |f| f.0);
        if groups[group].distance2(vertices[i]) > worst(&found) {
            return;
        }
        let first = group * GROUP;
        for (j, v) in vertices[first..].iter().enumerate().take(GROUP) {
            let d = sub(*v, vertices[i]);
            let candidate = (dot(d, d), first + j);
            if candidate.0 <= worst(&found) {
                let place = found.partition_point(|other| other < &candidate);
                found.insert(place, candidate);
                found.truncate(count);
            }
        }
    };
    let own = i / GROUP;
    offer(own);
    for step in 1..groups.len() {
        if own >= step {
            offer(own - step);
        }
        if own + step < groups.len() {
            offer(own + step);
        }
    }
    found.into_iter().map(|(_, j)| j).collect()
}

fn transposed(rows: &[SparseRow], columns: usize) -> Vec<SparseRow> {
    let mut result = vec![Vec::new(); columns];
    for (i, row) in rows.iter().enumerate() {
        for &(j, value) in row {
            result[j as usize].push((i as u32, value));
        }
    }
    result
}

fn multiply(rows: &[SparseRow], x: &[Six]) -> Vec<Six> {
    let product = |row: &SparseRow| {
        let mut sum = [0.0; 6];
        for &(j, value) in row {
            for c in 0..6 {
                sum[c] += value * x[j as usize][c];
            }
        }
        sum
    };
    rows.par_iter().with_min_len(256).map(product).collect()
}

/// Correction from a space of few smooth functions.
pub(super) struct Coarse {
    /// Values of the coarse functions at each vertex.
    interpolation: Vec<SparseRow>,
    /// The vertices of each coarse function.
    members: Vec<SparseRow>,
    factor: Cholesky,
}

impl Coarse {
    fn new(
        w: &dyn Operator,
        vertices: &[Vec3],
        components: &[u32],
        needle: Option<&[SparseRow]>,
        cancel: &Cancel,
    ) -> Result<Coarse, AddedMassError> {
        let m = (vertices.len() / COARSENING).min(w.most_coarse());
        let (m, interpolation) = match needle {
            None => (m, by_distance(vertices, m)),
            Some(nested) => {
                let m = (FINER * m).min(nested.len() / 2);
                (m, through(nested, vertices, m))
            }
        };
        let members = transposed(&interpolation, m);
        cancel.check()?;
        let small = w.galerkin(&members);
        cancel.check()?;
        let mut a: Vec<f64> = (0..m * m)
            .map(|k| 0.5 * (small[k] + small[k % m * m + k / m]))
            .collect();
        // Constants are among the coarse functions and have no energy: give them the mean one.
        let mean = (0..m).map(|i| a[i * m + i]).sum::<f64>() / (m * m) as f64;
        for shares in shares_in_components(&members, components) {
            for &(i, s) in &shares {
                for &(j, t) in &shares {
                    a[i as usize * m + j as usize] += mean * (s * t);
                }
            }
        }
        Ok(Coarse {
            interpolation,
            members,
            factor: Cholesky::new(a, m).ok_or(NOT_POSITIVE)?,
        })
    }

    fn add_correction(&self, r: &[Six], z: &mut [Six]) {
        let mut small = multiply(&self.members, r);
        let mut column = vec![0.0; small.len()];
        for c in 0..6 {
            small.iter().zip(&mut column).for_each(|(s, v)| *v = s[c]);
            self.factor.solve(&mut column);
            small.iter_mut().zip(&column).for_each(|(s, v)| s[c] = *v);
        }
        for (z, add) in z.iter_mut().zip(multiply(&self.interpolation, &small)) {
            for c in 0..6 {
                z[c] += add[c];
            }
        }
    }
}

/// For each component of the surface the coarse functions on it, and what share of each is there.
fn shares_in_components(members: &[SparseRow], components: &[u32]) -> Vec<SparseRow> {
    let count = components.iter().max().map_or(0, |&c| c as usize + 1);
    let mut shares: Vec<SparseRow> = vec![Vec::new(); count];
    for (function, row) in (0..).zip(members) {
        let mut weights: SparseRow = row
            .iter()
            .map(|&(v, w)| (components[v as usize], w))
            .collect();
        weights.sort_by_key(|&(component, _)| component);
        let sum = |run: &[(u32, f64)]| run.iter().map(|&(_, w)| w).sum::<f64>();
        let total = sum(&weights);
        for run in weights.chunk_by(|a, b| a.0 == b.0) {
            shares[run[0].0 as usize].push((function, sum(run) / total));
        }
    }
    shares
}

/// Vertices each of which is the farthest from those before it.
fn spread_out(vertices: &[Vec3], count: usize) -> Vec<usize> {
    let mut distance2 = vec![f64::INFINITY; vertices.len()];
    let mut seeds = vec![0];
    while seeds.len() < count {
        let from = vertices[seeds[seeds.len() - 1]];
        let mut farthest = 0;
        for (i, v) in vertices.iter().enumerate() {
            let d = sub(*v, from);
            distance2[i] = distance2[i].min(dot(d, d));
            if distance2[i] > distance2[farthest] {
                farthest = i;
            }
        }
        seeds.push(farthest);
    }
    seeds
}

/// Interpolation at each vertex from `count` of them.
fn by_distance(vertices: &[Vec3], count: usize) -> Vec<SparseRow> {
    let seeds = spread_out(vertices, count);
    let row = |&v: &Vec3| inverse_distance(v, vertices, &seeds);
    vertices.par_iter().with_min_len(64).map(row).collect()
}

/// The same from `count` of the vertices that `nested` functions start with, through these functions.
fn through(nested: &[SparseRow], vertices: &[Vec3], count: usize) -> Vec<SparseRow> {
    let kept: Vec<Vec3> = nested.iter().map(|f| vertices[f[0].0 as usize]).collect();
    let coarse = by_distance(&kept, count);
    let row = |functions: &SparseRow| -> SparseRow {
        let mut row: SparseRow = functions
            .iter()
            .flat_map(|&(f, s)| coarse[f as usize].iter().map(move |&(c, t)| (c, s * t)))
            .collect();
        row.sort_by_key(|&(c, _)| c);
        row.chunk_by(|a, b| a.0 == b.0)
            .map(|run| (run[0].0, run.iter().map(|&(_, w)| w).sum()))
            .collect()
    };
    transposed(nested, vertices.len()).iter().map(row).collect()
}

/// Weights of the four nearest seeds, by the inverse square of the distance.
fn inverse_distance(v: Vec3, vertices: &[Vec3], seeds: &[usize]) -> SparseRow {
    let mut best = [(f64::INFINITY, 0u32); 4];
    for (s, &seed) in seeds.iter().enumerate() {
        let d = sub(vertices[seed], v);
        let d2 = dot(d, d);
        if d2 < best[3].0 {
            best[3] = (d2, s as u32);
            for k in (1..4).rev() {
                if best[k].0 < best[k - 1].0 {
                    best.swap(k, k - 1);
                }
            }
        }
    }
    if best[0].0 == 0.0 {
        return vec![(best[0].1, 1.0)];
    }
    let total: f64 = best.iter().map(|(d2, _)| 1.0 / d2).sum();
    best.iter()
        .map(|&(d2, s)| (s, 1.0 / (d2 * total)))
        .collect()
}

/// L L^t factorization of a small dense matrix, row by row.
struct Cholesky {
    l: Vec<f64>,
    n: usize,
}

impl Cholesky {
    fn new(mut a: Vec<f64>, n: usize) -> Option<Cholesky> {
        for i in 0..n {
            let (done, rest) = a.split_at_mut(i * n);
            let row = &mut rest[..n];
            for j in 0..i {
                let other = &done[j * n..];
                let sum: f64 = row[..j].iter().zip(&other[..j]).map(|(a, b)| a * b).sum();
                row[j] = (row[j] - sum) / other[j];
            }
            let pivot = row[i] - row[..i].iter().map(|v| v * v).sum::<f64>();
            if pivot.is_nan() || pivot <= 0.0 {
                return None;
            }
            row[i] = pivot.sqrt();
        }
        Some(Cholesky { l: a, n })
    }

    fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        for i in 0..n {
            let row = &self.l[i * n..][..=i];
            let sum: f64 = row[..i].iter().zip(&*b).map(|(l, x)| l * x).sum();
            b[i] = (b[i] - sum) / row[i];
        }
        for i in (0..n).rev() {
            let row = &self.l[i * n..][..=i];
            b[i] /= row[i];
            let x = b[i];
            for (b, l) in b[..i].iter_mut().zip(row) {
                *b -= l * x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cholesky_solves() {
        let a = vec![4.0, 2.0, 0.0, 2.0, 5.0, 1.0, 0.0, 1.0, 3.0];
        let mut b = [8.0, 15.0, 11.0];
        Cholesky::new(a, 3).unwrap().solve(&mut b);
        for (got, want) in b.iter().zip([1.0, 2.0, 3.0]) {
            assert!((got - want).abs() < 1e-15, "{b:?}");
        }
        assert!(Cholesky::new(vec![1.0, 2.0, 2.0, 1.0], 2).is_none());
    }

    #[test]
    fn nearest_are_the_nearest() {
        let line: Vec<Vec3> = (0..50).map(|i| [f64::from(i * i), 0.0, 0.0]).collect();
        let groups: Vec<Group> = line.chunks(GROUP).map(Group::new).collect();
        let mut found = nearest(&line, &groups, 10, 5);
        found.sort_unstable();
        assert_eq!(found, [8, 9, 10, 11, 12]);
    }

    #[test]
    fn interpolation_weights_sum_to_one_and_are_exact_at_seeds() {
        let points: Vec<Vec3> = (0..30)
            .map(|i| [f64::from(i), f64::from(i % 7), 0.0])
            .collect();
        let seeds = spread_out(&points, 6);
        for (i, p) in points.iter().enumerate() {
            let row = inverse_distance(*p, &points, &seeds);
            assert!((row.iter().map(|r| r.1).sum::<f64>() - 1.0).abs() < 1e-14);
            assert_eq!(seeds.contains(&i), row.len() == 1);
        }
    }
}
