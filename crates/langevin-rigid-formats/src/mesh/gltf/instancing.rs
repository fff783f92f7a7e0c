//! Many copies of a node's mesh (EXT_mesh_gpu_instancing).

use super::super::transform::Transform;
use super::super::{ParseError, Place};
use super::accessor::{Accessors, Component, Items};
use super::document::Node;

/// The places where a node shows its mesh, each within the node; one if it says nothing.
pub(super) struct Instances<'a> {
    pub(super) count: usize,
    translation: Option<Items<'a>>,
    rotation: Option<Items<'a>>,
    scale: Option<Items<'a>>,
}

impl<'a> Instances<'a> {
    pub(super) fn of(node: &Node, accessors: &Accessors<'a>) -> Result<Instances<'a>, ParseError> {
        let extensions = node.extensions.as_ref();
        let instancing = extensions.and_then(|e| e.instancing.as_ref());
        if instancing.is_some() && node.skin.is_some() {
            return Err(ParseError::Unsupported {
                feature: "instances of a mesh with a skin".to_owned(),
                remedy: "apply the armature before exporting",
            });
        }
        let items = |name: &str, shape, allowed: &[Component]| {
            let index = instancing.and_then(|i| i.attributes.get(name));
            index
                .map(|&index| accessors.items(index, shape, allowed))
                .transpose()
        };
        let translation = items("TRANSLATION", "VEC3", &[Component::Float])?;
        let rotation = items("ROTATION", "VEC4", &ROTATION)?;
        let scale = items("SCALE", "VEC3", &[Component::Float])?;
        let given = [&translation, &rotation, &scale];
        let counts = given.map(|items| items.as_ref().map(|items| items.count));
        let count = counts.iter().flatten().next().copied().unwrap_or(1);
        if counts.iter().flatten().any(|&other| other != count) {
            let reason = "the instances of a node have not as many rotations or scales as places";
            return Err(ParseError::at(Place::File, reason));
        }
        Ok(Instances {
            count,
            translation,
            rotation,
            scale,
        })
    }

    /// The map of an instance into its node.
    pub(super) fn transform(&self, k: usize) -> Transform {
        Transform::of_parts(
            self.translation.as_ref().map(|items| items.at(k)),
            self.rotation.as_ref().map(|items| unit(items.at(k))),
            self.scale.as_ref().map(|items| items.at(k)),
        )
    }
}

const ROTATION: [Component; 3] = [Component::Float, Component::Byte, Component::Short];

/// Of length one: integers make a quaternion only nearly so.
fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}
