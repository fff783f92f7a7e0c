//! W without its matrix: near pairs of panels one by one, far ones through expansions of their
//! clusters (L. Greengard and V. Rokhlin, 1987).
//!
//! W(u, v) = 1/(4 pi) sum_ab P_ab c_u^a . c_v^b, so a product is the potential of the surface curls on the
//! panels, P_ab = II 1/r. From afar a panel is charges at the middles of its sides, which have its
//! moments up to the second. Every sum has one order, whatever the number of threads.

use rayon::prelude::*;
use wide::bytemuck::{cast_slice, cast_slice_mut};
use wide::f64x4;

use super::AddedMassError;
use super::clusters::Clusters;
use super::columns::{Columns, NONE, accumulate, add_products, combine, multiply_add, transposed};
use super::far::{FarSums, Sources, Target};
use super::harmonics::{Shift, TERMS, Translation, basis};
use super::near::NearPairs;
use super::operator::Six;
use super::operator::{Operator, SparseRow};
use super::panels::{Panel, Panels, Vec3};
use super::report::{Cancel, check_memory};
use super::sums::RowSums;
use crate::mesh::vector::{add, cross, scale, sub};
use crate::progress::Progress;

/// An expansion of each density.
type Expansion = [Columns; TERMS];

const EMPTY: Expansion = [NONE; TERMS];
/// Most memory for the pairs of near leaves (bytes): twice what even meshes of the most triangles take.
const MOST_BLOCKS: u64 = 6_000_000_000;

/// The operator.
pub(super) struct Hierarchical<'a> {
    panels: &'a Panels,
    pairs: &'a NearPairs,
    clusters: Clusters,
    /// II 1/r of each pair of near leaves, rows of the first, in the tree's order.
    blocks: Vec<Vec<f32>>,
    /// For each cluster that is a leaf its near leaves: block, other leaf, whether it is the second.
    neighbours: Vec<Vec<Neighbour>>,
    /// Moments of each panel with unit density, about the centre of its leaf.
    weights: Vec<[f64; TERMS]>,
    /// Panels and corners at each vertex.
    stars: Vec<Vec<(u32, u8)>>,
    /// Once it cancels, products are worth nothing and end soon: who asked for them asks it too.
    progress: &'a dyn Progress,
}

#[derive(Clone, Copy)]
struct Neighbour {
    block: u32,
    leaf: u32,
    transposed: bool,
}

impl<'a> Hierarchical<'a> {
    /// Also adds the far pairs to the sums, which hold the near ones.
    pub(super) fn new(
        panels: &'a Panels,
        pairs: &'a NearPairs,
        sums: &mut [RowSums],
        progress: &'a dyn Progress,
    ) -> Result<Hierarchical<'a>, AddedMassError> {
        let clusters = Clusters::new(&panels.panels);
        let entries: u64 = clusters
            .near
            .iter()
            .map(|pair| pair.map(|c| clusters.panels(c as usize).len() as u64))
            .map(|[rows, columns]| rows * columns)
            .sum();
        check_memory(entries * size_of::<f32>() as u64, MOST_BLOCKS)?;
        let mut neighbours = vec![Vec::new(); clusters.clusters.len()];
        for (block, &[a, b]) in clusters.near.iter().enumerate() {
            let block = block as u32;
            let of = |leaf, transposed| Neighbour {
                block,
                leaf,
                transposed,
            };
            neighbours[a as usize].push(of(b, false));
            if a != b {
                neighbours[b as usize].push(of(a, true));
            }
        }
        let mut stars = vec![Vec::new(); panels.vertices.len()];
        for (a, panel) in panels.panels.iter().enumerate() {
            for (k, &v) in panel.corners.iter().enumerate() {
                stars[v as usize].push((a as u32, k as u8));
            }
        }
        let mut weights = vec![[0.0; TERMS]; panels.panels.len()];
        for c in (0..clusters.clusters.len()).filter(|&c| clusters.is_leaf(c)) {
            for &a in clusters.panels(c) {
                let panel = &panels.panels[a as usize];
                weights[a as usize] = moments_of(panel, clusters.clusters[c].centre);
            }
        }
        let mut operator = Hierarchical {
            panels,
            pairs,
            weights,
            blocks: vec![Vec::new(); clusters.near.len()],
            clusters,
            neighbours,
            stars,
            progress,
        };
        let cancel = Cancel::new(progress, "clusters", 1);
        operator.integrate(sums, &cancel)?;
        operator.add_far_sums(sums);
        cancel.check()?;
        Ok(operator)
    }

    fn leaves(&self) -> Vec<usize> {
        (0..self.clusters.clusters.len())
            .filter(|&c| self.clusters.is_leaf(c))
            .collect()
    }

    /// The near blocks, and what their far pairs add to the sums.
    fn integrate(&mut self, sums: &mut [RowSums], cancel: &Cancel) -> Result<(), AddedMassError> {
        let leaves = self.leaves();
        let sources: Vec<Vec<Sources>> = (0..self.clusters.clusters.len())
            .map(|c| {
                if self.clusters.is_leaf(c) {
                    Sources::all(&self.gathered(self.clusters.panels(c)))
                } else {
                    Vec::new()
                }
            })
            .collect();
        let rows: Vec<LeafRows> = leaves
            .par_iter()
            .map(|&leaf| {
                cancel.check()?;
                Ok(self.leaf_rows(leaf, &sources))
            })
            .collect::<Result<_, AddedMassError>>()?;
        for rows in rows {
            for (block, entries) in rows.blocks {
                self.blocks[block] = entries;
            }
            for (panel, far) in rows.sums {
                sums[panel].add(&far);
            }
        }
        Ok(())
    }

    fn gathered(&self, panels: &[u32]) -> Vec<Panel> {
        let all = &self.panels.panels;
        panels.iter().map(|&p| all[p as usize]).collect()
    }

    fn leaf_rows(&self, leaf: usize, sources: &[Vec<Sources>]) -> LeafRows {
        let members = self.clusters.panels(leaf);
        let mut far = vec![FarSums::zero(); members.len()];
        let mut blocks = Vec::new();
        for neighbour in &self.neighbours[leaf] {
            let other = neighbour.leaf as usize;
            let columns = self.clusters.panels(other);
            let mut entries = Vec::with_capacity(members.len() * columns.len());
            for (&a, far) in members.iter().zip(&mut far) {
                let target = Target::new(&self.panels.panels[a as usize]);
                let mut row = vec![f64x4::ZERO; sources[other].len()];
                for (tile, row) in sources[other]
                    .chunks(super::far::TILE)
                    .zip(row.chunks_mut(super::far::TILE))
                {
                    target.potentials_and_sums(tile, row, far);
                }
                if !neighbour.transposed {
                    let row: &mut [f64] = cast_slice_mut(&mut row);
                    let row = &mut row[..columns.len()];
                    self.put_near(a, columns, row);
                    entries.extend(row.iter().map(|&p| p as f32));
                }
            }
            if !neighbour.transposed {
                blocks.push((neighbour.block as usize, entries));
            }
        }
        let finished = members.iter().zip(&far).map(|(&a, far)| {
            let a = a as usize;
            (a, far.finish(&self.panels.panels[a]))
        });
        LeafRows {
            sums: finished.collect(),
            blocks,
        }
    }

    /// Puts the exact integrals of the near pairs of panel `a` with `columns` (ascending) into its row.
    fn put_near(&self, a: u32, columns: &[u32], row: &mut [f64]) {
        let (near, values) = self.pairs.row(a as usize);
        let mut cursor = near.partition_point(|b| b < &columns[0]);
        for (&b, entry) in columns.iter().zip(row) {
            while cursor < near.len() && near[cursor] < b {
                cursor += 1;
            }
            if cursor < near.len() && near[cursor] == b {
                *entry = values[cursor];
            }
        }
    }

    /// Far pairs through the expansions: the densities n and n y^t of the single layer.
    fn add_far_sums(&self, sums: &mut [RowSums]) {
        let moments = self.moments(|a, centre, moments| {
            let panel = &self.panels.panels[a];
            let charge = panel.area / 3.0;
            for y in middles(panel) {
                let mut density = NONE;
                for k in 0..3 {
                    density[k] = charge * panel.normal[k];
                    for m in 0..3 {
                        density[3 + 3 * k + m] = charge * panel.normal[k] * y[m];
                    }
                }
                accumulate(moments, &basis(sub(y, centre)), &density);
            }
        });
        let locals = self.locals(&moments);
        let added: Vec<Vec<(usize, RowSums)>> = self
            .leaves()
            .par_iter()
            .map(|&leaf| self.far_sums(leaf, &locals))
            .collect();
        for (panel, far) in added.into_iter().flatten() {
            sums[panel].add(&far);
        }
    }

    fn far_sums(&self, leaf: usize, locals: &[Expansion]) -> Vec<(usize, RowSums)> {
        if self.progress.cancelled() {
            return Vec::new();
        }
        let centre = self.clusters.clusters[leaf].centre;
        let members = self.clusters.panels(leaf).iter().map(|&a| {
            let panel = &self.panels.panels[a as usize];
            let weight = panel.area / 3.0;
            let mut sums = RowSums::default();
            for x in middles(panel) {
                let mut field = NONE;
                combine(&basis(sub(x, centre)), &locals[leaf], &mut field);
                let mut here = RowSums::default();
                for k in 0..3 {
                    here.normal[k] = weight * field[k];
                    for m in 0..3 {
                        here.normal_y[k][m] = weight * field[3 + 3 * k + m];
                    }
                    here.normal_x += x[k] * here.normal[k];
                }
                let (turn, y) = (cross(x, panel.normal), here.y_cross_normal());
                here.rotational = turn.map(|t| scale(t, y));
                sums.add(&here);
            }
            (a as usize, sums)
        });
        members.collect()
    }

    /// Moments of every cluster about its centre, to which `add` adds those of a panel.
    fn moments(&self, add: impl Fn(usize, Vec3, &mut Expansion) + Sync) -> Vec<Expansion> {
        let clusters = &self.clusters.clusters;
        let leaf = |c: usize| {
            let mut moments = EMPTY;
            if self.clusters.is_leaf(c) {
                for &p in self.clusters.panels(c) {
                    add(p as usize, clusters[c].centre, &mut moments);
                }
            }
            moments
        };
        let mut moments: Vec<Expansion> = (0..clusters.len()).into_par_iter().map(leaf).collect();
        // Children come after their parents.
        for c in (1..clusters.len()).rev() {
            let (parents, own) = moments.split_at_mut(c);
            if let Some(parent) = clusters[c].parent {
                let shift = Shift::new(sub(clusters[c].centre, clusters[parent].centre));
                multiply_add(&shift.rows, &own[0], &mut parents[parent]);
            }
        }
        moments
    }

    /// Coefficients, about the centre of every leaf, of the potential of all that is far from it.
    fn locals(&self, moments: &[Expansion]) -> Vec<Expansion> {
        let clusters = &self.clusters.clusters;
        let from_afar = |(c, far): (usize, &Vec<u32>)| {
            let mut local = EMPTY;
            if self.progress.cancelled() {
                return local;
            }
            for &other in far {
                let other = other as usize;
                let d = sub(clusters[c].centre, clusters[other].centre);
                multiply_add(&Translation::new(d).rows, &moments[other], &mut local);
            }
            local
        };
        let far = self.clusters.far.par_iter().enumerate();
        let mut locals: Vec<Expansion> = far.map(from_afar).collect();
        for c in 1..clusters.len() {
            let (parents, own) = locals.split_at_mut(c);
            if let Some(parent) = clusters[c].parent {
                let shift = Shift::new(sub(clusters[c].centre, clusters[parent].centre));
                multiply_add(&transposed(&shift.rows), &parents[parent], &mut own[0]);
            }
        }
        locals
    }

    /// sum_b P_ab j_b for the panels of a leaf.
    fn potentials(&self, leaf: usize, curls: &[Columns], local: &Expansion) -> Vec<Columns> {
        let members = self.clusters.panels(leaf);
        let mut potentials = vec![NONE; members.len()];
        if self.progress.cancelled() {
            return potentials;
        }
        for (potential, &a) in potentials.iter_mut().zip(members) {
            combine(&self.weights[a as usize], local, potential);
        }
        for neighbour in &self.neighbours[leaf] {
            let others = self.clusters.panels(neighbour.leaf as usize);
            let curls: Vec<Columns> = others.iter().map(|&b| curls[b as usize]).collect();
            let block = &self.blocks[neighbour.block as usize];
            if neighbour.transposed {
                add_products(block, [1, members.len()], &curls, &mut potentials);
            } else {
                add_products(block, [others.len(), 1], &curls, &mut potentials);
            }
        }
        potentials
    }
}

/// Rows of a leaf: sums of the far pairs in its near blocks, and the blocks it comes first in.
struct LeafRows {
    sums: Vec<(usize, RowSums)>,
    blocks: Vec<(usize, Vec<f32>)>,
}

/// The middles of a panel's sides: charges of a third of it there have its moments up to the second.
fn middles(panel: &Panel) -> [Vec3; 3] {
    let [a, b, c] = panel.points;
    [(a, b), (b, c), (c, a)].map(|(p, q)| scale(0.5, add(p, q)))
}

/// Moments of a panel with unit density.
fn moments_of(panel: &Panel, centre: Vec3) -> [f64; TERMS] {
    let [a, b, c] = middles(panel).map(|x| basis(sub(x, centre)));
    let third = panel.area / 3.0;
    std::array::from_fn(|i| third * (a[i] + b[i] + c[i]))
}

impl Operator for Hierarchical<'_> {
    fn product(&self, x: &[Six]) -> Vec<Six> {
        let curls: Vec<Columns> = self
            .panels
            .panels
            .par_iter()
            .with_min_len(256)
            .map(|panel| {
                let mut density = NONE;
                for (&v, curl) in panel.corners.iter().zip(&panel.curls) {
                    let x = &x[v as usize];
                    for (i, density) in density[..18].iter_mut().enumerate() {
                        *density += curl[i / 6] * x[i % 6];
                    }
                }
                density
            })
            .collect();
        let moments = self.moments(|a, _, moments| {
            accumulate(moments, &self.weights[a], &curls[a]);
        });
        let locals = self.locals(&moments);
        let leaves = self.leaves();
        let potentials: Vec<Vec<Columns>> = leaves
            .par_iter()
            .map(|&leaf| self.potentials(leaf, &curls, &locals[leaf]))
            .collect();
        let mut of_panel = vec![NONE; curls.len()];
        for (&leaf, potentials) in leaves.iter().zip(&potentials) {
            for (&a, potential) in self.clusters.panels(leaf).iter().zip(potentials) {
                of_panel[a as usize] = *potential;
            }
        }
        self.stars
            .par_iter()
            .with_min_len(256)
            .map(|star| {
                let mut sum = [0.0; 6];
                for &(a, k) in star {
                    let curl = self.panels.panels[a as usize].curls[k as usize];
                    let potential = &of_panel[a as usize];
                    for (i, p) in potential[..18].iter().enumerate() {
                        sum[i % 6] += curl[i / 6] * p;
                    }
                }
                sum.map(|s| s / (4.0 * std::f64::consts::PI))
            })
            .collect()
    }

    fn diagonal(&self) -> Vec<f64> {
        (0..self.stars.len())
            .into_par_iter()
            .with_min_len(64)
            .map(|i| self.block(&[i])[0])
            .collect()
    }

    fn block(&self, rows: &[usize]) -> Vec<f64> {
        let mut members: Vec<u32> = rows
            .iter()
            .flat_map(|&v| self.stars[v].iter().map(|&(a, _)| a))
            .collect();
        members.sort_unstable();
        members.dedup();
        let place = |a: u32| members.partition_point(|&b| b < a);
        let sources = Sources::all(&self.gathered(&members));
        let integrals: Vec<Vec<f64>> = members
            .iter()
            .map(|&a| {
                let target = Target::new(&self.panels.panels[a as usize]);
                let mut values = vec![f64x4::ZERO; sources.len()];
                target.potentials(&sources, &mut values);
                let values: &[f64] = cast_slice(&values);
                let mut row = values[..members.len()].to_vec();
                self.put_near(a, &members, &mut row);
                row
            })
            .collect();
        let curl = |&(a, k): &(u32, u8)| self.panels.panels[a as usize].curls[k as usize];
        let mut block = vec![0.0; rows.len() * rows.len()];
        for (i, &u) in rows.iter().enumerate() {
            // The potential of vertex u's curls on every panel.
            let mut potential = vec![[0.0; 3]; members.len()];
            for at in &self.stars[u] {
                let c = curl(at);
                for (sum, p) in potential.iter_mut().zip(&integrals[place(at.0)]) {
                    *sum = add(*sum, scale(*p, c));
                }
            }
            for (j, &v) in rows.iter().enumerate() {
                let entries = self.stars[v].iter();
                block[i * rows.len() + j] = entries
                    .map(|at| crate::mesh::vector::dot(curl(at), potential[place(at.0)]))
                    .sum::<f64>()
                    / (4.0 * std::f64::consts::PI);
            }
        }
        block
    }

    fn galerkin(&self, members: &[SparseRow]) -> Vec<f64> {
        galerkin(self, self.stars.len(), members)
    }

    fn most_coarse(&self) -> usize {
        48
    }
}

/// T^t W T, column j of T given by its nonzero entries `members[j]`.
pub(super) struct Subspace<'a> {
    pub(super) whole: &'a Hierarchical<'a>,
    pub(super) members: &'a [SparseRow],
}

impl Operator for Subspace<'_> {
    fn product(&self, x: &[Six]) -> Vec<Six> {
        let n = self.whole.stars.len();
        let image = self.whole.product(&spread(self.members, x, n));
        self.members.iter().map(|m| combined(m, &image)).collect()
    }

    fn diagonal(&self) -> Vec<f64> {
        (0..self.members.len())
            .into_par_iter()
            .with_min_len(64)
            .map(|i| self.block(&[i])[0])
            .collect()
    }

    fn block(&self, rows: &[usize]) -> Vec<f64> {
        let mut vertices: Vec<usize> = rows
            .iter()
            .flat_map(|&r| self.members[r].iter().map(|&(v, _)| v as usize))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let m = vertices.len();
        let full = self.whole.block(&vertices);
        let place = |v: u32| vertices.partition_point(|&other| other < v as usize);
        let entry = |&r: &usize, &s: &usize| -> f64 {
            let row = |&(u, w): &(u32, f64)| -> f64 {
                let full = &full[place(u) * m..];
                w * self.members[s]
                    .iter()
                    .map(|&(v, x)| x * full[place(v)])
                    .sum::<f64>()
            };
            self.members[r].iter().map(row).sum()
        };
        rows.iter()
            .flat_map(|r| rows.iter().map(move |s| (r, s)))
            .map(|(r, s)| entry(r, s))
            .collect()
    }

    fn galerkin(&self, members: &[SparseRow]) -> Vec<f64> {
        galerkin(self, self.members.len(), members)
    }

    fn most_coarse(&self) -> usize {
        self.whole.most_coarse()
    }
}

/// T x.
fn spread(members: &[SparseRow], x: &[Six], n: usize) -> Vec<Six> {
    let mut full = vec![[0.0; 6]; n];
    for (column, x) in members.iter().zip(x) {
        for &(v, weight) in column {
            for c in 0..6 {
                full[v as usize][c] += weight * x[c];
            }
        }
    }
    full
}

/// One entry of T^t x.
pub(super) fn combined(members: &[(u32, f64)], values: &[Six]) -> Six {
    std::array::from_fn(|c| {
        members
            .iter()
            .map(|&(v, w)| w * values[v as usize][c])
            .sum()
    })
}

/// T^t W T, six columns a product.
fn galerkin(w: &dyn Operator, n: usize, members: &[SparseRow]) -> Vec<f64> {
    let m = members.len();
    let mut entries = vec![0.0; m * m];
    for first in (0..m).step_by(6) {
        let count = 6.min(m - first);
        let mut x = vec![[0.0; 6]; n];
        for c in 0..count {
            for &(v, weight) in &members[first + c] {
                x[v as usize][c] = weight;
            }
        }
        let image = w.product(&x);
        for (i, column) in members.iter().enumerate() {
            let row = combined(column, &image);
            entries[i * m + first..][..count].copy_from_slice(&row[..count]);
        }
    }
    entries
}
