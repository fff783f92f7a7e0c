//! What a page says of a scene, and what stands around its bodies.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::{Fluid, falling_reynolds, falling_speed};
use serde::Serialize;

use crate::session::Session;

/// A scene in words and numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Description {
    /// Its name.
    pub name: String,
    /// What it shows.
    pub description: String,
    /// Whether bodies meet more than their fluid.
    pub world: bool,
    /// Names of its kinds of bodies, its own first.
    pub kinds: Vec<String>,
    /// Mass (kg).
    pub mass: f64,
    /// Volume (m^3).
    pub volume: f64,
    /// Mean density of the body (kg/m^3).
    pub density: f64,
    /// Name of the fluid, if it is one of the presets.
    pub fluid: Option<&'static str>,
    /// Density of the fluid (kg/m^3).
    pub fluid_density: f64,
    /// Kinematic viscosity of the fluid (m^2/s).
    pub fluid_viscosity: f64,
    /// Half-extents along its principal axes, descending (m).
    pub half_extents: Vec3,
    /// Diagonal of the added mass in the fluid: kg, then kg m^2.
    pub added_mass: [f64; 6],
    /// Speed U0 of Eq. (1) (m/s), and its Reynolds number.
    pub falling_speed: f64,
    /// Reynolds number of that speed.
    pub falling_reynolds: f64,
    /// Relative error of the added mass, estimated.
    pub error_estimate: f64,
    /// What the reader of the mesh, and the bake, have to say.
    pub notices: Vec<String>,
    /// Time step (s).
    pub time_step: f64,
    /// Gravity (m/s^2).
    pub gravity: Vec3,
    /// Where it is released (m), world frame.
    pub position: Vec3,
    /// Orientation at release.
    pub orientation: [f64; 4],
    /// Velocity at release, world frame (m/s).
    pub velocity: Vec3,
    /// Angular velocity at release, world frame (rad/s).
    pub angular_velocity: Vec3,
    /// What stands around its bodies.
    pub stage: Stage,
}

/// What stands around bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stage {
    /// Height of the ground (m).
    pub ground: Option<f64>,
    /// Level of the water (m).
    pub water: Option<f64>,
    /// Corners of a tank (m).
    pub walls: Option<[Vec3; 2]>,
    /// Sloping planes: a point and the normal.
    pub planes: Vec<[Vec3; 2]>,
    /// Obstacles.
    pub solids: Vec<Solid>,
}

/// The surface of an obstacle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Solid {
    /// Its vertices (m), world frame.
    pub vertices: Vec<Vec3>,
    /// Corners of its triangles.
    pub triangles: Vec<[u32; 3]>,
}

impl Session {
    /// The scene in words and numbers.
    pub fn describe(&self) -> Description {
        let prepared = self.prepared();
        let (scene, body) = (prepared.scene(), prepared.body());
        let (fluid, gravity) = (&scene.fluid, scene.settings.gravity);
        let baked = prepared.baked();
        let notices = baked.notices.iter().chain(&baked.bake.warnings);
        Description {
            name: scene.name.clone(),
            description: scene.description.clone(),
            world: scene.is_world(),
            kinds: self.kinds().map(|(name, _)| name.to_owned()).collect(),
            mass: body.mass,
            volume: body.volume,
            density: body.density(),
            fluid: preset(fluid),
            fluid_density: fluid.density,
            fluid_viscosity: fluid.viscosity,
            half_extents: body.half_extents,
            added_mass: std::array::from_fn(|i| fluid.density * body.added_mass[i][i]),
            falling_speed: falling_speed(body, fluid, gravity),
            falling_reynolds: falling_reynolds(body, fluid, gravity),
            error_estimate: baked.bake.error_estimate,
            notices: notices.cloned().collect(),
            time_step: scene.time_step,
            gravity,
            position: scene.release.position,
            orientation: scene.release.orientation,
            velocity: scene.release.world_velocity(),
            angular_velocity: scene.release.world_angular_velocity(),
            stage: self.stage(),
        }
    }

    fn stage(&self) -> Stage {
        let stage = self.prepared().stage();
        let planes = stage.planes.iter().map(|plane| [plane.point, plane.normal]);
        let solids = stage.solids.into_iter().map(|solid| Solid {
            vertices: solid.vertices,
            triangles: solid.triangles,
        });
        Stage {
            ground: stage.ground,
            water: stage.water,
            walls: stage.walls,
            planes: planes.collect(),
            solids: solids.collect(),
        }
    }
}

/// The preset that a fluid is, whatever its stream.
fn preset(fluid: &Fluid) -> Option<&'static str> {
    let presets = [("air", Fluid::AIR), ("water", Fluid::WATER)];
    let same =
        |preset: &Fluid| (preset.density, preset.viscosity) == (fluid.density, fluid.viscosity);
    let found = presets.iter().find(|(_, preset)| same(preset));
    found.map(|(name, _)| *name)
}
