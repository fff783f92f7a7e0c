//! Skins: vertices that follow joints, in the pose the file is in (linear-blend skinning).

use std::cell::OnceCell;

use super::super::transform::Transform;
use super::super::{ParseError, Place};
use super::accessor::{Accessors, Component};
use super::document::Skin;
use super::get;
use super::node::World;
use super::surface::Surface;

/// The maps from a mesh to the world that the joints of each skin make.
pub(super) struct Skins<'a> {
    accessors: &'a Accessors<'a>,
    world: &'a World<'a>,
    joints: Vec<OnceCell<Vec<Transform>>>,
}

impl<'a> Skins<'a> {
    pub(super) fn new(accessors: &'a Accessors<'a>, world: &'a World<'a>) -> Skins<'a> {
        Skins {
            accessors,
            world,
            joints: vec![OnceCell::new(); accessors.document.skins.len()],
        }
    }

    pub(super) fn joints(&self, index: usize) -> Result<&[Transform], ParseError> {
        let skin = get(&self.accessors.document.skins, index, "skin")?;
        if let Some(joints) = self.joints[index].get() {
            return Ok(joints);
        }
        let joints = self.joints_of(skin)?;
        Ok(self.joints[index].get_or_init(|| joints))
    }

    fn joints_of(&self, skin: &Skin) -> Result<Vec<Transform>, ParseError> {
        let inverse = skin.inverse_bind_matrices;
        let inverse = inverse
            .map(|index| self.accessors.items(index, "MAT4", &[Component::Float]))
            .transpose()?;
        if inverse
            .as_ref()
            .is_some_and(|i| i.count < skin.joints.len())
        {
            let reason = "a skin has fewer inverse bind matrices than joints";
            return Err(ParseError::at(Place::File, reason));
        }
        let joint = |(k, &node): (usize, &usize)| {
            let world = get(&self.world.transforms, node, "node")?.ok_or_else(|| {
                let reason = format!("the joint at node {node} is in no tree of nodes");
                ParseError::at(Place::File, reason)
            })?;
            Ok(match &inverse {
                Some(inverse) => world.after(&Transform::of_matrix(&inverse.at(k))),
                None => world,
            })
        };
        skin.joints.iter().enumerate().map(joint).collect()
    }
}

/// The map of each vertex of a surface.
pub(super) fn blended(
    surface: &Surface<'_>,
    joints: &[Transform],
) -> Result<Vec<Transform>, ParseError> {
    let fault = |vertex: u32, reason: String| {
        ParseError::at(Place::File, format!("vertex {vertex} of a skin {reason}"))
    };
    let of_vertex = |&vertex: &u32| {
        let influences: Vec<(f64, f64)> = surface.influences(vertex).collect();
        let total: f64 = influences.iter().map(|&(_, weight)| weight).sum();
        if !(total > 0.0 && total.is_finite()) {
            return Err(fault(vertex, "follows no joint: bind it to one".to_owned()));
        }
        let mut parts = Vec::with_capacity(influences.len());
        for (joint, weight) in influences.into_iter().filter(|&(_, weight)| weight != 0.0) {
            let map = joints.get(joint as usize).ok_or_else(|| {
                fault(
                    vertex,
                    format!("follows joint {joint}, there are {}", joints.len()),
                )
            })?;
            parts.push((weight / total, *map));
        }
        Ok(Transform::blend(parts.into_iter()))
    };
    surface.used.iter().map(of_vertex).collect()
}
