//! Welding of what the file left apart.

use super::{Options, Soup, Step};
use crate::mesh::boundary::open_sides;
use crate::mesh::edges::sorted_sides;
use crate::mesh::parts::SignedParts;
use crate::mesh::seams::twins;

/// Joins vertices of open edges within the tolerance, exact copies first of all.
pub(super) fn weld(soup: &mut Soup, options: &Options) {
    let tolerance = soup.weld_distance(options);
    let open = open_sides(&sorted_sides(&soup.triangles));
    let found = twins(&soup.vertices, &open, tolerance);
    let distance = found.iter().map(|p| p.distance).fold(0.0, f64::max);
    let vertices = soup.merge(found.iter().map(|p| p.vertices));
    soup.did(Step::Welded { vertices, distance });
}

impl Soup {
    /// Gives the vertices of each pair one number, the lower; how many are no longer used.
    pub(super) fn merge(&mut self, pairs: impl Iterator<Item = [u32; 2]>) -> usize {
        let mut parts = SignedParts::new(self.vertices.len());
        for [a, b] in pairs {
            parts.join(a as usize, b as usize, false);
        }
        let number: Vec<usize> = (0..self.vertices.len()).map(|v| parts.root(v).0).collect();
        for v in self.triangles.as_flattened_mut() {
            *v = number[*v as usize] as u32;
        }
        (0..number.len()).filter(|&v| number[v] != v).count()
    }
}
