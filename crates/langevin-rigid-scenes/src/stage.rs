//! What a picture of a scene shows around its bodies.

use langevin_rigid::linalg::Vec3;
use langevin_rigid_pictures::{Plane, Scenery, Stage};

use crate::prepared::Prepared;
use crate::scene::{ObstacleGeometry, Scene};

/// Cosine of the tilt below which a plane is level ground.
const LEVEL: f64 = 1.0 - 1e-9;

impl Prepared {
    /// What stands around the bodies in a picture of the scene: ground, and in a [world](Scene::is_world) water, the walls of
    /// its tank, obstacles.
    pub fn stage(&self) -> Stage {
        let scene = self.scene();
        let Some(surroundings) = self.surroundings() else {
            return Stage {
                ground: scene.stop.ground,
                ..Stage::default()
            };
        };
        let planes: Vec<Plane> = planes(scene).collect();
        let (level, sloping): (Vec<Plane>, Vec<Plane>) = planes
            .into_iter()
            .partition(|plane| plane.normal[1] >= LEVEL);
        let floors = level.iter().map(|plane| plane.point[1]);
        Stage {
            ground: floors.chain(scene.stop.ground).reduce(f64::max),
            water: scene.water.as_ref().map(|water| water.level),
            walls: walls(scene),
            planes: sloping,
            solids: surroundings.scenery().to_vec(),
        }
    }
}

fn planes(scene: &Scene) -> impl Iterator<Item = Plane> {
    scene
        .obstacles
        .iter()
        .filter_map(|obstacle| match obstacle.geometry {
            ObstacleGeometry::Plane { position, normal } => Some(Plane {
                point: position,
                normal,
            }),
            _ => None,
        })
}

/// The box of the tank, from its floor to where the body is released.
fn walls(scene: &Scene) -> Option<[Vec3; 2]> {
    let tank = scene.tank?;
    let origin = scene.release.position;
    let side = |sign: f64| std::array::from_fn(|i| origin[i] + 0.5 * sign * tank.size[i]);
    let [mut low, mut high]: [Vec3; 2] = [side(-1.0), side(1.0)];
    low[1] = scene.stop.ground.unwrap_or_else(|| tank.floor(origin));
    high[1] = origin[1];
    Some([low, high])
}

/// A box as a surface.
pub(crate) fn cuboid(size: Vec3) -> Scenery {
    let corner = |i: usize| {
        std::array::from_fn(|axis| if i >> axis & 1 == 1 { 0.5 } else { -0.5 } * size[axis])
    };
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    Scenery {
        vertices: (0..8).map(corner).collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BALL: &str = r#"
        fluid.preset = "air"
        release.position = [0.0, 1.0, 0.0]
        run = { time_step = 0.002, duration = 0.1, ground = 0.0 }
        body = { shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }
        tank.size = [0.4, 1.0, 0.6]
    "#;

    fn stage(more: &str) -> Stage {
        let scene = Scene::parse("ball", "ball.toml", &format!("{BALL}{more}")).unwrap();
        Prepared::new(scene, None, &()).unwrap().stage()
    }

    #[test]
    fn a_world_has_what_its_bodies_meet_and_other_scenes_have_ground_alone() {
        let ground = Stage {
            ground: Some(0.0),
            ..Stage::default()
        };
        assert_eq!(stage(""), ground);
        let world = stage(
            r#"
            [water]
            level = 0.2
            [[obstacle]]
            shape = "plane"
            position = [0.0, 0.1, 0.0]
            normal = [0.0, 1.0, 0.0]
            [[obstacle]]
            shape = "plane"
            position = [0.0, 0.1, 0.0]
            normal = [0.6, 0.8, 0.0]
            [[obstacle]]
            shape = "box"
            size = [0.1, 0.2, 0.3]
            position = [0.0, 0.1, 0.0]
            "#,
        );
        // The level plane is the higher ground.
        assert_eq!((world.ground, world.water), (Some(0.1), Some(0.2)));
        assert_eq!(world.walls, Some([[-0.2, 0.0, -0.3], [0.2, 1.0, 0.3]]));
        assert_eq!((world.planes.len(), world.solids.len()), (1, 1));
        let vertices = &world.solids[0].vertices;
        assert_eq!(vertices[7], [0.05, 0.2, 0.15]);
    }
}
