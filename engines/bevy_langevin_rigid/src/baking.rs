//! Meshes are baked on tasks, once for all bodies that share them.

use std::collections::HashMap;

use bevy_asset::{AssetEvent, AssetId, AssetServer, Assets, Handle};
use bevy_ecs::message::MessageReader;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Res, ResMut};
use bevy_log::{error, warn};
use bevy_mesh::{Indices, Mesh, MeshAccessError, PrimitiveTopology, VertexAttributeValues};
use bevy_tasks::{AsyncComputeTaskPool, Task, TaskPool, futures::check_ready};
use langevin_rigid_bake::added_mass::Warning;
use langevin_rigid_bake::body::{BodyBakeError, BodySpec};
use langevin_rigid_bake::mesh::{close_seams, open_edge_count, weld};
use langevin_rigid_bake::{MeshError, TriMesh};

use crate::baked_body::BakedBody;

/// What a body is baked from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Solid {
    mesh: AssetId<Mesh>,
    /// Bits of the density (kg/m^3).
    density: u32,
    /// Bits of the thickness of a sheet (m).
    thickness: Option<u32>,
}

impl Solid {
    pub(crate) fn new(mesh: AssetId<Mesh>, density: f32, thickness: Option<f32>) -> Self {
        Self {
            mesh,
            density: density.to_bits(),
            thickness: thickness.map(f32::to_bits),
        }
    }

    fn density(&self) -> f64 {
        f32::from_bits(self.density).into()
    }

    fn thickness(&self) -> Option<f64> {
        self.thickness.map(|bits| f32::from_bits(bits).into())
    }
}

/// Bakes that are made or under way.
#[derive(Resource, Default)]
pub(crate) struct Bakes(HashMap<Solid, Baking>);

enum Baking {
    Running(Task<Result<(BakedBody, Vec<Warning>), MeshBakeError>>),
    Done(Handle<BakedBody>),
    /// The log has said why.
    Failed,
}

/// What has come of something that a body waits for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome<T> {
    /// Not ready yet.
    Waiting,
    /// Here it is.
    Ready(T),
    /// It will never be, and the log has said why.
    Failed,
}

/// Why a mesh is no body.
#[derive(Debug, thiserror::Error)]
enum MeshBakeError {
    #[error(
        "its data are on the GPU alone; load it with `RenderAssetUsages::MAIN_WORLD` beside `RENDER_WORLD`"
    )]
    OnGpu,
    #[error("it has no positions of three floats (`Mesh::ATTRIBUTE_POSITION`)")]
    NoPositions,
    #[error(
        "it is made of {0:?}; only triangles enclose a body: use `TriangleList` or `TriangleStrip`"
    )]
    Topology(PrimitiveTopology),
    #[error("{0}")]
    Mesh(#[from] MeshError),
    #[error("{0}")]
    Body(#[from] BodyBakeError),
}

impl Bakes {
    /// The body of `solid`, whose bake is begun if nobody has asked for it before and its mesh is loaded.
    pub(crate) fn body(
        &mut self,
        solid: Solid,
        meshes: Option<&Assets<Mesh>>,
        server: &AssetServer,
    ) -> Outcome<Handle<BakedBody>> {
        match self.0.get(&solid) {
            Some(Baking::Running(_)) => return Outcome::Waiting,
            Some(Baking::Done(body)) => return Outcome::Ready(body.clone()),
            Some(Baking::Failed) => return Outcome::Failed,
            None => {}
        }
        let Some(mesh) = meshes.and_then(|meshes| meshes.get(solid.mesh)) else {
            if server.load_state(solid.mesh).is_failed() {
                error!(
                    "{} could not be loaded; its bodies fall plainly, as in no fluid",
                    name(solid.mesh, server)
                );
                self.0.insert(solid, Baking::Failed);
                return Outcome::Failed;
            }
            return Outcome::Waiting;
        };
        let triangles = triangles(mesh);
        let task = AsyncComputeTaskPool::get_or_init(TaskPool::default)
            .spawn(async move { bake(triangles?, &solid) });
        self.0.insert(solid, Baking::Running(task));
        Outcome::Waiting
    }
}

/// Takes the results of tasks that have ended, and says of those that failed why.
pub(crate) fn finish(
    mut bakes: ResMut<Bakes>,
    mut bodies: ResMut<Assets<BakedBody>>,
    server: Res<AssetServer>,
) {
    for (solid, baking) in &mut bakes.0 {
        let Baking::Running(task) = baking else {
            continue;
        };
        let Some(result) = check_ready(task) else {
            continue;
        };
        *baking = match result {
            Ok((body, warnings)) => {
                for warning in warnings {
                    warn!("{}: {warning}", name(solid.mesh, &server));
                }
                Baking::Done(bodies.add(body))
            }
            Err(error) => {
                error!(
                    "{} cannot be baked: {error}. Its bodies fall plainly, as in no fluid",
                    name(solid.mesh, &server)
                );
                Baking::Failed
            }
        };
    }
}

/// Forgets bakes of meshes that were changed or dropped; bodies that have joined keep theirs.
pub(crate) fn forget_changed_meshes(
    mut events: MessageReader<AssetEvent<Mesh>>,
    mut bakes: ResMut<Bakes>,
) {
    for event in events.read() {
        if let AssetEvent::Modified { id } | AssetEvent::Removed { id } = event {
            bakes.0.retain(|solid, _| solid.mesh != *id);
        }
    }
}

/// What the log calls a mesh.
fn name(mesh: AssetId<Mesh>, server: &AssetServer) -> String {
    match server.get_path(mesh) {
        Some(path) => format!("the mesh `{path}`"),
        None => format!("the mesh {mesh}"),
    }
}

/// Positions (m) and vertex numbers of the triangles of a mesh.
type Triangles = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn triangles(mesh: &Mesh) -> Result<Triangles, MeshBakeError> {
    let positions = match mesh.try_attribute(Mesh::ATTRIBUTE_POSITION) {
        Ok(VertexAttributeValues::Float32x3(positions)) => positions,
        Err(MeshAccessError::ExtractedToRenderWorld) => return Err(MeshBakeError::OnGpu),
        Ok(_) | Err(MeshAccessError::NotFound) => return Err(MeshBakeError::NoPositions),
    };
    let vertices: Vec<[f64; 3]> = positions.iter().map(|p| p.map(f64::from)).collect();
    let numbers: Vec<u32> = match mesh.try_indices_option() {
        Ok(Some(Indices::U16(numbers))) => numbers.iter().map(|&v| v.into()).collect(),
        Ok(Some(Indices::U32(numbers))) => numbers.clone(),
        Ok(None) => (0..vertices.len() as u32).collect(),
        Err(_) => return Err(MeshBakeError::OnGpu),
    };
    let triangles = match mesh.primitive_topology() {
        PrimitiveTopology::TriangleList => numbers.as_chunks().0.to_vec(),
        PrimitiveTopology::TriangleStrip => strip(&numbers),
        other => return Err(MeshBakeError::Topology(other)),
    };
    Ok((vertices, triangles))
}

/// The triangles of a strip, every second one turned, without those that only join its parts.
fn strip(numbers: &[u32]) -> Vec<[u32; 3]> {
    let corners = numbers.windows(3).enumerate().map(|(i, v)| match i % 2 {
        0 => [v[0], v[1], v[2]],
        _ => [v[1], v[0], v[2]],
    });
    corners
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect()
}

fn bake(
    (vertices, triangles): Triangles,
    solid: &Solid,
) -> Result<(BakedBody, Vec<Warning>), MeshBakeError> {
    let (vertices, triangles) = joined(vertices, triangles);
    let mesh = match solid.thickness() {
        None => TriMesh::new(vertices, triangles)?,
        Some(thickness) => TriMesh::from_sheet(vertices, triangles, thickness)?,
    };
    let spec = BodySpec {
        density: Some(solid.density()),
        ..BodySpec::default()
    };
    let (body, warnings) = BakedBody::bake(&mesh, &spec)?;
    // The small added mass along a thin sheet hardly matters to how it moves, whatever its accuracy.
    let matters = |warning: &Warning| !matches!(warning, Warning::ThinnerThanTriangles { .. });
    Ok((body, warnings.into_iter().filter(matters).collect()))
}

/// Joins the vertices that normals and texture coordinates have split.
fn joined(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Triangles {
    if open_edge_count(&triangles) == 0 {
        return (vertices, triangles);
    }
    let (vertices, triangles) = weld(&vertices, &triangles);
    // A triangle at the pole of a sphere has two corners there.
    let triangles: Vec<[u32; 3]> = triangles
        .into_iter()
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    match close_seams(&vertices, &triangles) {
        Some(closed) if open_edge_count(&triangles) > 0 => (closed.vertices, closed.triangles),
        _ => (vertices, triangles),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_asset::RenderAssetUsages;
    use bevy_math::primitives::{Cuboid, Sphere};
    use bevy_mesh::Meshable;

    fn baked(mesh: &Mesh, density: f32) -> BakedBody {
        let solid = Solid::new(AssetId::default(), density, None);
        bake(triangles(mesh).unwrap(), &solid).unwrap().0
    }

    #[test]
    fn a_box_has_the_mass_that_it_should() {
        let body = baked(&Cuboid::new(0.1, 0.2, 0.3).into(), 500.0).bake.body;
        assert!((body.mass / 3.0 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_sphere_is_closed_at_its_seam_and_poles() {
        let mesh = Sphere::new(0.1).mesh().uv(16, 8);
        let body = baked(&mesh, 500.0).bake.body;
        let of_ball = 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
        assert!(body.volume < of_ball && body.volume > 0.85 * of_ball);
    }

    #[test]
    fn the_centre_of_mass_is_where_the_solid_is() {
        let mesh = Mesh::from(Cuboid::new(0.1, 0.2, 0.3)).translated_by([1.0, 2.0, 3.0].into());
        let centre = baked(&mesh, 500.0).centre_of_mass;
        for (found, wanted) in centre.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - wanted).abs() < 1e-6);
        }
    }

    #[test]
    fn a_strip_is_the_list_of_its_triangles() {
        assert_eq!(strip(&[0, 1, 2, 3]), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(strip(&[0, 1, 2, 2, 4, 4, 5, 6]), [[0, 1, 2], [5, 4, 6]]);
        assert!(strip(&[0, 1]).is_empty());
    }

    #[test]
    fn what_is_no_surface_is_refused_by_name() {
        let lines = Mesh::new(PrimitiveTopology::LineList, RenderAssetUsages::default());
        let error = triangles(&lines).unwrap_err().to_string();
        assert!(error.contains("positions"), "{error}");
        let lines = lines.with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, vec![[0.0; 3]; 2]);
        let error = triangles(&lines).unwrap_err().to_string();
        assert!(error.contains("LineList"), "{error}");
    }
}
