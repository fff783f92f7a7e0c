//! Placing meshes by the nodes of a scene.

use super::super::{ParseError, Place};
use super::document::{Document, Node};
use super::get;
use langevin_rigid::linalg::rotation_matrix;

/// An affine map x → linear · x + translation, the rows of `linear` first to third.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transform {
    linear: [[f64; 3]; 3],
    translation: [f64; 3],
}

impl Transform {
    const IDENTITY: Transform = Transform {
        linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// The map of a node into its parent: its matrix, or translation · rotation · scale.
    fn of(node: &Node) -> Transform {
        if let Some(m) = node.matrix {
            return Transform {
                linear: [0, 1, 2].map(|i| [m[i], m[4 + i], m[8 + i]]),
                translation: [m[12], m[13], m[14]],
            };
        }
        let rotation = rotation_matrix(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
        let scale = node.scale.unwrap_or([1.0; 3]);
        Transform {
            linear: rotation.map(|row| [0, 1, 2].map(|j| row[j] * scale[j])),
            translation: node.translation.unwrap_or([0.0; 3]),
        }
    }

    fn linear_part(&self, v: [f64; 3]) -> [f64; 3] {
        self.linear
            .map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    pub(super) fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        let mapped = self.linear_part(v);
        [0, 1, 2].map(|k| mapped[k] + self.translation[k])
    }

    /// This map after `inner`.
    fn after(&self, inner: &Transform) -> Transform {
        let columns = [0, 1, 2].map(|j| self.linear_part(inner.linear.map(|row| row[j])));
        Transform {
            linear: [0, 1, 2].map(|i| columns.map(|column| column[i])),
            translation: self.apply(inner.translation),
        }
    }

    /// Whether the map turns triangles over (negative determinant).
    pub(super) fn mirrors(&self) -> bool {
        let [a, b, c] = self.linear;
        let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        det < 0.0
    }
}

/// The meshes of the default scene with the maps of their nodes to the world.
pub(super) fn placed_meshes(document: &Document) -> Result<Vec<(usize, Transform)>, ParseError> {
    let mut placed = Vec::new();
    let mut seen = vec![false; document.nodes.len()];
    let mut waiting: Vec<(usize, Transform)> = document
        .roots()?
        .into_iter()
        .rev()
        .map(|root| (root, Transform::IDENTITY))
        .collect();
    while let Some((index, parent)) = waiting.pop() {
        let node = get(&document.nodes, index, "node")?;
        if std::mem::replace(&mut seen[index], true) {
            let reason = format!("node {index} is reached twice, the nodes are not a tree");
            return Err(ParseError::at(Place::File, reason));
        }
        let transform = parent.after(&Transform::of(node));
        placed.extend(node.mesh.map(|mesh| (mesh, transform)));
        waiting.extend(node.children.iter().rev().map(|&child| (child, transform)));
    }
    Ok(placed)
}
