//! The world of a scene before there are bodies in it, and the kinds of bodies that there will be.

use std::path::Path;
use std::sync::Arc;

use langevin_rigid::linalg::vector::{add, dot};
use langevin_rigid::linalg::{Quat, Vec3, rotate};
use langevin_rigid::wind::Wind;
use langevin_rigid::{Bake, SetupError};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::mesh::{ReadError, read_mesh};
use langevin_rigid_pictures::Scenery;
use langevin_rigid_world::water::{Immersion, ImmersionError, Sea, WaterError, WaterSurface};
use langevin_rigid_world::{
    Kind, MaterialError, Obstacle, ObstacleError, Overlap, Shape, ShapeError, World,
};

use crate::baking::{Baked, SceneBakeError, bake_scene, settings, stepper};
use crate::scene::{
    Contact, ContactShape, FindError, OWN, ObstacleGeometry, Scene, SceneObstacle, SceneWater,
    SceneWindError, find,
};
use crate::stage::cuboid;

/// A world without bodies, and the bodies that may be let go in it.
#[derive(Debug, Clone)]
pub struct Surroundings {
    scene: Scene,
    world: World,
    /// What each obstacle of the world is.
    names: Vec<String>,
    /// What pictures show of them: boxes and meshes.
    scenery: Vec<Scenery>,
    kinds: Vec<CrowdBody>,
}

/// A kind of bodies.
#[derive(Debug, Clone)]
pub struct CrowdBody {
    /// Its scene.
    pub scene: Scene,
    /// Its bake.
    pub baked: Arc<Baked>,
    shape: Shape,
    /// At its own size.
    kind: Arc<Kind>,
}

/// Why a scene has no such surroundings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SurroundingsError {
    /// The ground, a wall or an obstacle is none.
    #[error("{what}: {error}")]
    Obstacle {
        /// Which.
        what: String,
        /// What is wrong with it.
        error: ObstacleError,
    },
    /// The shape of a box is none.
    #[error("{what}: {error}")]
    ObstacleShape {
        /// Which.
        what: String,
        /// What is wrong with it.
        error: ShapeError,
    },
    /// The mesh of an obstacle cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The water is none.
    #[error("[water]: {error}")]
    Water {
        /// What is wrong with it.
        error: WaterError,
    },
    /// A body cannot float.
    #[error("the body of `{scene}` in [water]: {error}")]
    Immersion {
        /// Its scene.
        scene: String,
        /// Why not.
        error: ImmersionError,
    },
    /// A body cannot touch.
    #[error("the body of `{scene}`: {error}")]
    Shape {
        /// Its scene.
        scene: String,
        /// Why not.
        error: ShapeError,
    },
    /// A scene of the crowd cannot be found.
    #[error("`kinds` of the [crowd]: {error}")]
    Find {
        /// Why not.
        error: FindError,
    },
    /// A body of the crowd could not be baked.
    #[error(transparent)]
    Bake(#[from] SceneBakeError),
    /// A body of the crowd, fluid and settings do not go together.
    #[error("the body of `{scene}`: {error}")]
    Setup {
        /// Its scene.
        scene: String,
        /// Why not.
        error: SetupError,
    },
    /// Friction or restitution is impossible.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The wind is none.
    #[error(transparent)]
    Wind(#[from] SceneWindError),
}

impl Surroundings {
    /// Those of a scene whose body is `baked`; bakes the other bodies of its crowd.
    pub(crate) fn new(
        scene: &Scene,
        baked: &Arc<Baked>,
        cache: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Self, SurroundingsError> {
        let mut surroundings = Self {
            scene: scene.clone(),
            world: World::new(scene.settings.gravity),
            names: Vec::new(),
            scenery: Vec::new(),
            kinds: Vec::new(),
        };
        // Each kind brings its wind.
        surroundings
            .world
            .set_wind(Wind::default(), scene.fluid.velocity);
        if let Some(water) = &scene.water {
            let surface = surface(water, scene);
            let surface = surface.map_err(|error| SurroundingsError::Water { error })?;
            surroundings.world.set_water(surface);
        }
        surroundings.enclose()?;
        for (number, obstacle) in scene.obstacles.iter().enumerate() {
            surroundings.add_obstacle(number + 1, obstacle)?;
        }
        surroundings.add_kind(scene.clone(), Arc::clone(baked))?;
        for kind in scene.crowd.iter().flat_map(|crowd| &crowd.kinds) {
            let other = find(&kind.scene).map_err(|error| SurroundingsError::Find { error })?;
            let baked = bake_scene(&other, cache, progress)?;
            surroundings.add_kind(other, Arc::new(baked))?;
        }
        Ok(surroundings)
    }

    /// The world without bodies.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The kinds of bodies; the scene's own is the first.
    pub fn kinds(&self) -> &[CrowdBody] {
        &self.kinds
    }

    /// The surfaces of boxes and meshes that stand in the way.
    pub(crate) fn scenery(&self) -> &[Scenery] {
        &self.scenery
    }

    /// The scene's own kind of bodies.
    pub(crate) fn own_kind(&self) -> Arc<Kind> {
        Arc::clone(&self.kinds[0].kind)
    }

    /// A kind of bodies at so many times its size.
    pub(super) fn kind(&self, number: usize, scale: f64) -> Result<Arc<Kind>, SurroundingsError> {
        let CrowdBody {
            scene,
            baked,
            shape,
            kind,
        } = &self.kinds[number];
        if scale == 1.0 {
            return Ok(Arc::clone(kind));
        }
        let bake = Bake {
            body: baked.bake.body.scaled(scale),
            ..baked.bake.clone()
        };
        let wind = if number == 0 { OWN } else { &scene.name };
        let made = self.make_kind(&scene.name, wind, &bake, shape.scaled(scale))?;
        Ok(Arc::new(made))
    }

    /// The same with the obstacle's name.
    pub(super) fn named(&self, overlap: Overlap) -> Overlap {
        let number = overlap.other.strip_prefix("obstacle ");
        let name = number.and_then(|number| self.names.get(number.parse::<usize>().ok()?));
        Overlap {
            other: name.cloned().unwrap_or(overlap.other),
            ..overlap
        }
    }

    fn add(
        &mut self,
        what: String,
        obstacle: Result<Obstacle, ObstacleError>,
    ) -> Result<(), SurroundingsError> {
        match obstacle {
            Ok(obstacle) => self.world.add_obstacle(obstacle),
            Err(error) => return Err(SurroundingsError::Obstacle { what, error }),
        }
        self.names.push(what);
        Ok(())
    }

    /// Ground and tank.
    fn enclose(&mut self) -> Result<(), SurroundingsError> {
        let material = self.contact().material;
        let (ground, tank) = (self.scene.stop.ground, self.scene.tank);
        let origin = self.scene.release.position;
        let mut plane = |normal: Vec3, point: Vec3, what: &str| {
            let offset = dot(normal, point);
            self.add(
                what.to_owned(),
                Obstacle::half_space(normal, offset, material),
            )
        };
        if let Some(height) = ground {
            plane([0.0, 1.0, 0.0], [0.0, height, 0.0], "the ground")?;
        }
        let Some(tank) = tank else {
            return Ok(());
        };
        for axis in [0, 2] {
            for side in [-1.0, 1.0] {
                let (mut normal, mut point) = ([0.0; 3], origin);
                normal[axis] = -side;
                point[axis] += 0.5 * side * tank.size[axis];
                plane(normal, point, "a wall of the tank")?;
            }
        }
        Ok(())
    }

    fn add_obstacle(
        &mut self,
        number: usize,
        obstacle: &SceneObstacle,
    ) -> Result<(), SurroundingsError> {
        let what = format!("[[obstacle]] {number}");
        let material = obstacle.material;
        match &obstacle.geometry {
            ObstacleGeometry::Plane { position, normal } => {
                let offset = dot(*normal, *position);
                self.add(what, Obstacle::half_space(*normal, offset, material))
            }
            ObstacleGeometry::Box {
                size,
                position,
                orientation,
            } => match Shape::cuboid(size.map(|side| 0.5 * side)) {
                Ok(shape) => {
                    let mut drawn = cuboid(*size);
                    drawn.vertices = placed(&drawn.vertices, *position, *orientation);
                    self.scenery.push(drawn);
                    let placed = Obstacle::shape(shape, *position, *orientation, material);
                    self.add(what, placed)
                }
                Err(error) => Err(SurroundingsError::ObstacleShape { what, error }),
            },
            ObstacleGeometry::Mesh {
                path,
                unit,
                position,
                orientation,
                closed,
            } => {
                let mesh = read_mesh(path, *unit)?;
                let vertices = placed(&mesh.vertices, *position, *orientation);
                let made = match closed {
                    true => Obstacle::mesh(&vertices, &mesh.triangles, material),
                    false => Obstacle::terrain(&vertices, &mesh.triangles, material),
                };
                self.scenery.push(Scenery {
                    vertices,
                    triangles: mesh.triangles,
                });
                self.add(format!("{what} (`{}`)", path.display()), made)
            }
        }
    }

    fn contact(&self) -> Contact {
        self.scene.contact.unwrap_or_default()
    }

    fn add_kind(&mut self, scene: Scene, baked: Arc<Baked>) -> Result<(), SurroundingsError> {
        let body = &baked.bake.body;
        let shape = match self.contact().shape {
            ContactShape::Hull => Shape::of_body(body),
            ContactShape::Parts => Shape::decomposed(body),
        };
        let shape = shape.map_err(|error| SurroundingsError::Shape {
            scene: scene.name.clone(),
            error,
        })?;
        let wind = if self.kinds.is_empty() {
            OWN
        } else {
            &scene.name
        };
        let kind = self.make_kind(&scene.name, wind, &baked.bake, shape.clone())?;
        let kind = Arc::new(kind);
        self.kinds.push(CrowdBody {
            scene,
            baked,
            shape,
            kind,
        });
        Ok(())
    }

    /// `wind` is the name by which the winds know it.
    fn make_kind(
        &self,
        name: &str,
        wind: &str,
        bake: &Bake,
        shape: Shape,
    ) -> Result<Kind, SurroundingsError> {
        let scene = &self.scene;
        let wind = scene.make_wind_for(wind)?;
        let material = self.contact().material;
        let Some(water) = &scene.water else {
            let stepper = stepper(scene, bake).map_err(|error| SurroundingsError::Setup {
                scene: name.to_owned(),
                error,
            })?;
            return Ok(Kind::new(stepper, shape, material)?.in_wind(wind));
        };
        let history = bake.history.as_ref();
        let (air, water) = ((&scene.fluid, history), (&water.fluid, history));
        let immersion = Immersion::new(&bake.body, air, water, &settings(scene));
        let immersion = immersion.map_err(|error| SurroundingsError::Immersion {
            scene: name.to_owned(),
            error,
        })?;
        Ok(Kind::between(immersion, shape, material)?.in_wind(wind))
    }
}

fn surface(water: &SceneWater, scene: &Scene) -> Result<WaterSurface, WaterError> {
    let gravity = scene.settings.gravity;
    let surface = match &water.waves {
        None => WaterSurface::calm(water.level)?,
        Some(waves) => {
            let (sin, cos) = libm::sincos(waves.heading.to_radians());
            let sea = Sea {
                significant_height: waves.height,
                peak_period: waves.period,
                heading: [cos, sin],
                seed: waves.seed.unwrap_or(scene.seed),
                ..Sea::default()
            };
            WaterSurface::sea(water.level, dot(gravity, gravity).sqrt(), &sea)?
        }
    };
    match water.current {
        [0.0, 0.0] => Ok(surface),
        current => surface.with_current(current),
    }
}

fn placed(vertices: &[Vec3], position: Vec3, orientation: Quat) -> Vec<Vec3> {
    let place = |vertex: &Vec3| add(position, rotate(orientation, *vertex));
    vertices.iter().map(place).collect()
}
