//! What a file will become, counted before it does.
//!
//! A scene can show one mesh over and over: a few kilobytes can stand for any number of triangles.

use std::collections::BTreeMap;

use super::super::proportion::{most_triangles, too_many};
use super::super::{ParseError, Place};
use super::accessor::Accessors;
use super::document::{Mesh, Node, Primitive};
use super::get;
use super::instancing::Instances;
use super::node::World;
use super::surface;

/// Refuses a scene of more triangles than its size accounts for.
pub(super) fn check(
    world: &World<'_>,
    accessors: &Accessors<'_>,
    json: usize,
) -> Result<(), ParseError> {
    let mut meshes = BTreeMap::new();
    let mut total = 0u64;
    for index in world.meshes() {
        let mesh = get(&accessors.document.meshes, index, "mesh")?;
        let primitives = surfaces(mesh, accessors)?;
        total = primitives
            .iter()
            .fold(total, |sum, p| sum.saturating_add(p.0));
        meshes.insert(index, (mesh, primitives));
    }
    let size = json.saturating_add(accessors.buffers.size()) as u64;
    let most = most_triangles(size);
    for shown in &world.shown {
        let instances = Instances::of(shown.node, accessors)?.count as u64;
        let (mesh, primitives) = &meshes[&shown.mesh];
        for (triangles, primitive) in primitives {
            let passes = passes(primitive, mesh, shown.node);
            let each = triangles
                .saturating_mul(passes.done)
                .saturating_add(passes.idle);
            total = total.saturating_add(each.max(1).saturating_mul(instances));
            if total > most {
                return Err(too_many(most, size));
            }
        }
    }
    if total > most {
        Err(too_many(most, size))
    } else {
        Ok(())
    }
}

/// The surfaces among the primitives of a mesh, with their triangles.
fn surfaces<'a>(
    mesh: &'a Mesh,
    accessors: &Accessors<'_>,
) -> Result<Vec<(u64, &'a Primitive)>, ParseError> {
    let mut surfaces = Vec::new();
    for primitive in &mesh.primitives {
        if primitive.mode > 6 {
            let reason = format!("there is no primitive mode {}", primitive.mode);
            return Err(ParseError::at(Place::File, reason));
        }
        if primitive.mode >= 4 {
            let triangles = surface::expected(primitive, accessors)?;
            surfaces.extend(triangles.map(|n| (n as u64, primitive)));
        }
    }
    Ok(surfaces)
}

/// How often the vertices of a primitive are gone through, and what morph targets of weight zero cost.
struct Passes {
    done: u64,
    idle: u64,
}

fn passes(primitive: &Primitive, mesh: &Mesh, node: &Node) -> Passes {
    let weights = node.weights.as_ref().unwrap_or(&mesh.weights);
    let weights = &weights[..weights.len().min(primitive.targets.len())];
    let active = weights.iter().filter(|&&w| w != 0.0).count();
    let joints = match node.skin {
        Some(_) => primitive.attributes.len(),
        None => 0,
    };
    Passes {
        done: 1 + (active + joints) as u64,
        idle: weights.len() as u64,
    }
}
