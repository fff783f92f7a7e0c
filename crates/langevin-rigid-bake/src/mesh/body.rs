//! Several closed surfaces as one body: which way each faces, and which the fluid reaches.

use super::TriMesh;
use super::edges::sorted_sides;
use super::nesting::around;
use super::parts::components;
use super::repair::signed_volumes;
use super::{MeshError, check};

impl TriMesh {
    /// Turns each component to face out of the solid, by how many are around it: those with an even number
    /// outward, the walls of cavities inward. Also says which are sealed in.
    pub(super) fn oriented(mut self) -> Result<TriMesh, MeshError> {
        let sides = sorted_sides(&self.triangles);
        let root_of = components(self.triangles.len(), &sides);
        let volumes = signed_volumes(&self.vertices, &self.triangles, &root_of);
        check::volumes(&self, &root_of, &volumes)?;
        let depth = depths(&self.vertices, &self.triangles, &root_of, |_| true);
        for (t, &root) in self.triangles.iter_mut().zip(&root_of) {
            let inward = volumes[root] < 0.0;
            if inward != (depth[root] % 2 == 1) {
                t.swap(1, 2);
                self.turned += 1;
            }
        }
        let sealed = (0u32..).zip(&root_of).filter(|&(_, &root)| depth[root] > 0);
        self.sealed = sealed.map(|(t, _)| t).collect();
        let outer = (0..volumes.len()).filter(|&t| root_of[t] == t && depth[t] == 0);
        check::resolved(&self, outer.map(|root| volumes[root].abs()).sum())?;
        Ok(self)
    }
}

/// How many closed components are around each, at the number of its first triangle.
pub(super) fn depths(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    root_of: &[usize],
    closed: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let roots: Vec<usize> = (0..root_of.len()).filter(|&t| root_of[t] == t).collect();
    let around = around(vertices, triangles, root_of, &roots, closed);
    let mut depths = vec![0; triangles.len()];
    for (&root, around) in roots.iter().zip(&around) {
        depths[root] = around.len();
    }
    depths
}
