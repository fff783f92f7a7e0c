//! Placing nodes by those that hold them.

use std::collections::BTreeSet;

use super::super::transform::Transform;
use super::super::{ParseError, Place};
use super::document::{Document, Node};
use super::get;

/// A mesh that a node of the scene shows.
pub(super) struct Shown<'a> {
    pub(super) node: &'a Node,
    pub(super) mesh: usize,
    /// From the node to the world.
    pub(super) transform: Transform,
}

/// The nodes of a document in the world.
pub(super) struct World<'a> {
    document: &'a Document,
    /// What the default scene shows.
    pub(super) shown: Vec<Shown<'a>>,
    /// The map of each node to the world, where it is in a tree.
    pub(super) transforms: Vec<Option<Transform>>,
}

impl<'a> World<'a> {
    pub(super) fn new(document: &'a Document) -> Result<World<'a>, ParseError> {
        let mut world = World {
            document,
            shown: Vec::new(),
            transforms: vec![None; document.nodes.len()],
        };
        for root in document.roots()? {
            world.add_tree(root, true)?;
        }
        // Joints may be outside the scene; they show nothing there.
        if !document.skins.is_empty() {
            for root in document.tops() {
                if world.transforms[root].is_none() {
                    world.add_tree(root, false)?;
                }
            }
        }
        Ok(world)
    }

    /// The meshes that are shown, each once, in order.
    pub(super) fn meshes(&self) -> BTreeSet<usize> {
        self.shown.iter().map(|shown| shown.mesh).collect()
    }

    fn add_tree(&mut self, root: usize, in_scene: bool) -> Result<(), ParseError> {
        let mut waiting = vec![(root, Transform::IDENTITY)];
        while let Some((index, parent)) = waiting.pop() {
            let node = get(&self.document.nodes, index, "node")?;
            let transform = parent.after(&placed(node));
            if self.transforms[index].replace(transform).is_some() {
                let reason = format!("node {index} is reached twice, the nodes are not a tree");
                return Err(ParseError::at(Place::File, reason));
            }
            self.shown
                .extend(node.mesh.filter(|_| in_scene).map(|mesh| Shown {
                    node,
                    mesh,
                    transform,
                }));
            waiting.extend(node.children.iter().rev().map(|&child| (child, transform)));
        }
        Ok(())
    }
}

/// The map of a node into its parent: its matrix, or translation · rotation · scale.
fn placed(node: &Node) -> Transform {
    match &node.matrix {
        Some(m) => Transform::of_matrix(m),
        None => Transform::of_parts(
            node.translation.as_deref().copied(),
            node.rotation.as_deref().copied(),
            node.scale.as_deref().copied(),
        ),
    }
}
