//! The matrix of the hypersingular operator and the single-layer sums, row block by row block.

use rayon::prelude::*;
use wide::bytemuck::cast_slice_mut;
use wide::f64x4;

use super::far::{FarSums, Sources, TILE, Target};
use super::matrix::{BLOCK, GROUPS, Matrix};
use super::near::NearPairs;
use super::panels::{Panels, Vec3};
use super::report::Cancel;
use super::sums::RowSums;

/// Assembles W; adds the far pairs to the sums, which hold the near ones.
///
/// A block of vertices computes the rows of every panel that touches it, so a panel on the border
/// of blocks is computed more than once and no sum depends on which thread does what.
pub(super) fn assemble(
    panels: &Panels,
    pairs: &NearPairs,
    sums: &mut [RowSums],
    cancel: &Cancel,
) -> Result<Matrix, super::AddedMassError> {
    let n = panels.vertices.len();
    let sources = Sources::all(&panels.panels);
    let touching = panels_of_blocks(panels);
    let blocks: Vec<Block> = touching
        .par_iter()
        .enumerate()
        .map(|(index, touching)| {
            cancel.check()?;
            let block = Rows::new(index, touching, panels, pairs).run(&sources);
            cancel.advance();
            Ok(block)
        })
        .collect::<Result<_, super::AddedMassError>>()?;
    let mut columns = Vec::with_capacity(blocks.len());
    for block in blocks {
        for (panel, far) in &block.sums {
            sums[*panel].add(far);
        }
        columns.push(block.entries);
    }
    Ok(Matrix::new(n, columns))
}

/// The panels that touch each block of vertices.
fn panels_of_blocks(panels: &Panels) -> Vec<Vec<usize>> {
    let mut touching = vec![Vec::new(); panels.vertices.len().div_ceil(BLOCK)];
    for (a, panel) in panels.panels.iter().enumerate() {
        let mut blocks = panel.corners.map(|v| v as usize / BLOCK);
        blocks.sort_unstable();
        for (i, &block) in blocks.iter().enumerate() {
            if i == 0 || blocks[i - 1] != block {
                touching[block].push(a);
            }
        }
    }
    touching
}

struct Block {
    entries: Vec<f64x4>,
    sums: Vec<(usize, RowSums)>,
}

/// The rows of one block of vertices in the making.
struct Rows<'a> {
    panels: &'a Panels,
    pairs: &'a NearPairs,
    touching: &'a [usize],
    targets: Vec<Target>,
    /// Far sums of the panels whose first block this is.
    far: Vec<Option<FarSums>>,
    /// How far along its near pairs each row is.
    cursors: Vec<usize>,
    /// For each vertex of the block, its panels (place in `touching`) and its curl / 4 pi on them.
    stars: Vec<Vec<(usize, Vec3)>>,
}

impl<'a> Rows<'a> {
    fn new(
        index: usize,
        touching: &'a [usize],
        panels: &'a Panels,
        pairs: &'a NearPairs,
    ) -> Rows<'a> {
        let mut stars = vec![Vec::new(); BLOCK];
        let mut far = Vec::with_capacity(touching.len());
        for (place, &a) in touching.iter().enumerate() {
            let panel = &panels.panels[a];
            let blocks = panel.corners.map(|v| v as usize / BLOCK);
            far.push((blocks.iter().min() == Some(&index)).then(FarSums::zero));
            for k in (0..3).filter(|&k| blocks[k] == index) {
                let curl = panel.curls[k].map(|c| c / (4.0 * std::f64::consts::PI));
                stars[panel.corners[k] as usize % BLOCK].push((place, curl));
            }
        }
        Rows {
            panels,
            pairs,
            touching,
            targets: touching
                .iter()
                .map(|&a| Target::new(&panels.panels[a]))
                .collect(),
            far,
            cursors: vec![0; touching.len()],
            stars,
        }
    }

    fn run(mut self, sources: &[Sources]) -> Block {
        let mut entries = vec![f64x4::ZERO; self.panels.vertices.len() * GROUPS];
        let mut integrals = vec![f64x4::ZERO; self.touching.len() * TILE];
        let mut curls = vec![f64x4::ZERO; 4 * TILE * 3 * GROUPS];
        for (tile, sources) in sources.chunks(TILE).enumerate() {
            let first = 4 * TILE * tile;
            self.integrate(sources, first, &mut integrals);
            self.gather_curls(&integrals, &mut curls);
            self.add_entries(first, &curls, &mut entries);
        }
        let sums = self
            .touching
            .iter()
            .zip(&self.far)
            .filter_map(|(&a, far)| far.map(|far| (a, far.finish(&self.panels.panels[a]))));
        Block {
            sums: sums.collect(),
            entries,
        }
    }

    /// II 1/r of every row with the panels of a tile.
    fn integrate(&mut self, sources: &[Sources], first: usize, integrals: &mut [f64x4]) {
        for (place, row) in integrals.chunks_exact_mut(TILE).enumerate() {
            let target = &self.targets[place];
            match &mut self.far[place] {
                Some(sums) => target.potentials_and_sums(sources, row, sums),
                None => target.potentials(sources, row),
            }
            let (columns, values) = self.pairs.row(self.touching[place]);
            let entries: &mut [f64] = cast_slice_mut(row);
            let cursor = &mut self.cursors[place];
            while let Some(&b) = columns.get(*cursor)
                && (b as usize) < first + 4 * TILE
            {
                entries[b as usize - first] = values[*cursor];
                *cursor += 1;
            }
        }
    }

    /// sum_a P_ab c_u^a for every panel b of the tile: component by component, lanes over u.
    fn gather_curls(&self, integrals: &[f64x4], curls: &mut [f64x4]) {
        let curls: &mut [f64] = cast_slice_mut(curls);
        for (four, curls) in curls.chunks_exact_mut(4 * 3 * BLOCK).enumerate() {
            for (lane, star) in self.stars.iter().enumerate() {
                let mut total = [f64x4::ZERO; 3];
                for &(place, curl) in star {
                    let p = integrals[place * TILE + four];
                    for k in 0..3 {
                        total[k] += p * curl[k];
                    }
                }
                for k in 0..3 {
                    for (b, value) in total[k].to_array().into_iter().enumerate() {
                        curls[(b * 3 + k) * BLOCK + lane] = value;
                    }
                }
            }
        }
    }

    /// W(v, u) += c_v^b . sum_a P_ab c_u^a.
    fn add_entries(&self, first: usize, curls: &[f64x4], entries: &mut [f64x4]) {
        let panels = self.panels.panels[first..].iter().take(4 * TILE);
        for (panel, curls) in panels.zip(curls.chunks_exact(3 * GROUPS)) {
            let (x, rest) = curls.split_at(GROUPS);
            let (y, z) = rest.split_at(GROUPS);
            for (corner, c) in panel.corners.iter().zip(&panel.curls) {
                let row = &mut entries[*corner as usize * GROUPS..][..GROUPS];
                for g in 0..GROUPS {
                    row[g] += x[g] * c[0] + y[g] * c[1] + z[g] * c[2];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::added_mass::near;
    use crate::added_mass::operator::Operator;

    /// A cube of side 1 with each face in 2 x 2 cells.
    fn cube() -> Panels {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                let start = vertices.len() as u32;
                for (i, j) in (0..9).map(|k| (f64::from(k / 3) / 2.0, f64::from(k % 3) / 2.0)) {
                    let mut p = [side; 3];
                    p[(axis + 1) % 3] = i;
                    p[(axis + 2) % 3] = j;
                    vertices.push(p);
                }
                for cell in [0, 1, 3, 4] {
                    let [a, b, c, d] = [cell, cell + 3, cell + 4, cell + 1].map(|v| v + start);
                    let flip = side == 0.0;
                    triangles.extend(if flip {
                        [[a, c, b], [a, d, c]]
                    } else {
                        [[a, b, c], [a, c, d]]
                    });
                }
            }
        }
        let mesh = crate::mesh::weld(&vertices, &triangles);
        Panels::new(&mesh.0, &mesh.1)
    }

    #[test]
    fn matrix_is_symmetric_and_annihilates_constants() {
        let panels = cube();
        let cancel = Cancel::new(&(), "matrix", 1);
        let mut pairs = NearPairs::find(&panels.panels, &cancel).unwrap();
        let mut sums = near::integrate(&panels, &mut pairs, false, &cancel).unwrap();
        let cancel = Cancel::new(&(), "", 1);
        let w = assemble(&panels, &pairs, &mut sums, &cancel).unwrap();
        let n = panels.vertices.len();
        assert_eq!(n, 26);
        let largest = w.diagonal().into_iter().fold(0.0, f64::max);
        for i in 0..n {
            let row: f64 = (0..n).map(|j| w.get(i, j)).sum();
            assert!(row.abs() < 1e-14 * largest, "row {i}: {row}");
            for j in 0..i {
                assert!((w.get(i, j) - w.get(j, i)).abs() < 1e-15);
            }
        }
    }
}
