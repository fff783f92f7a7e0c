//! Scene files: what to simulate, as TOML in SI units and degrees.
//!
//! [`Scene::parse`] reads and checks one; what is wrong comes back with its line and column.
//! [`Scene::to_toml`] writes the resolved scene, which reads back as the same scene. [`find`] opens a
//! built-in scene by name or a file by path; [`BUILT_IN`] lists the built-in ones.

mod body;
mod crowd;
mod direct;
mod grid;
mod materials;
mod place;
pub(crate) mod quantity;
mod raw;
mod registry;
mod release;
mod run;
mod scatter;
mod seed;
mod separated;
mod shape;
mod steering;
mod surroundings;
#[cfg(test)]
mod tests;
mod wind;
mod world;

use std::path::PathBuf;

use langevin_rigid::linalg::vector::{add, norm, sub};
use langevin_rigid::wind::Wind;
use langevin_rigid::{Fluid, Model, Settings, State, StopAt, Tank};
use langevin_rigid_bake::body::BodySpec;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_bake::turbulence::Sampling;
use serde_spanned::Spanned;

pub use crowd::{Crowd, CrowdKind};
pub use direct::{Direct, Freedom, Landing, Path, Ring, Side};
use langevin_rigid_formats::export::Conditions;
use langevin_rigid_formats::mesh::LengthUnit;
use place::Document;
pub use place::SceneError;
use quantity::TIME_STEP;
use raw::{RawFluid, RawPicture, RawRun, RawScene, RawTank, given};
pub use registry::{BUILT_IN, BuiltIn, FindError, Source, find};
pub use run::StepsError;
pub use scatter::{Scatter, Spread};
use seed::Seed;
pub use steering::Steering;
pub use wind::{OWN, SceneField, SceneWindError, WindPart};
pub use world::{Contact, ContactShape, ObstacleGeometry, SceneObstacle, SceneWater, SceneWaves};

/// A scene, checked and complete.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name: that of a built-in scene, or the file's without ending.
    pub name: String,
    /// What it shows, in a line.
    pub description: String,
    /// The fluid.
    pub fluid: Fluid,
    /// The body.
    pub body: BodySource,
    /// Pose and velocities at release.
    pub release: State,
    /// How long the body is carried along at its release velocity before it is let go (s): fingers
    /// that follow it, a gripper that opens late.
    pub carried: f64,
    /// Model, integrator, turbulence source and gravity.
    pub settings: Settings,
    /// Time step (s).
    pub time_step: f64,
    /// When the run ends.
    pub stop: StopAt,
    /// Seed of the noise.
    pub seed: u64,
    /// The grid of the turbulence history.
    pub grid: Grid,
    /// Time between two drawings of the body in a picture (s); the picture's choice if none.
    pub picture_interval: Option<f64>,
    /// How the runs of an ensemble differ from the scene.
    pub scatter: Scatter,
    /// Walls and floor around the release point, if any.
    pub tank: Option<Tank>,
    /// The fields that make the wind, on top of the velocity of the fluid.
    pub wind: Vec<WindPart>,
    /// How bodies touch the ground and each other, if they do.
    pub contact: Option<Contact>,
    /// What stands in their way.
    pub obstacles: Vec<SceneObstacle>,
    /// The water that they may fall into.
    pub water: Option<SceneWater>,
    /// Many bodies in place of one.
    pub crowd: Option<Crowd>,
    /// Which of the seed's streams of noise a single run has.
    pub stream: u32,
    /// The force that steers the body, if any.
    pub steering: Option<Steering>,
    /// What its fall shall do, for [`crate::direct`].
    pub direct: Option<Direct>,
}

/// Where the body's surface and mass come from.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySource {
    /// The surface.
    pub geometry: Geometry,
    /// A glTF file with the look of the body in exports, drawn where its mesh is.
    pub visual: Option<PathBuf>,
    /// Mass and characteristic sizes.
    pub spec: BodySpec,
}

/// A body's surface.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Geometry {
    /// A parametric body.
    Shape {
        /// Its shape.
        shape: Shape,
        /// Wished number of triangles.
        triangles: usize,
    },
    /// A mesh file.
    Mesh {
        /// Path; relative ones start from the scene's folder.
        path: PathBuf,
        /// Unit of its coordinates; that of the format if none.
        unit: Option<LengthUnit>,
        /// Thickness that an open sheet is given (m).
        thickness: Option<f64>,
    },
}

/// The grid that the turbulence history is computed on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells along x, y, z; the stream runs along y.
    pub cells: [usize; 3],
    /// Cell size, which is the length l of the history (m); the body's own length if none.
    pub cell: Option<f64>,
    /// Inflow speed (m/s); the larger of U0, Eq. (1), and the release speed if none.
    pub inflow_speed: Option<f64>,
    /// Time step (s); the flow solver's choice if none.
    pub time_step: Option<f64>,
    /// Length of the history (s); the flow solver's choice if none.
    pub duration: Option<f64>,
    /// Where the turbulence is sampled.
    pub sampling: Sampling,
}

/// Most steps of a run: each leaves some hundred bytes behind.
pub const MAX_STEPS: u64 = 10_000_000;

/// Why a scene cannot be written as TOML.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the scene cannot be written: {message}")]
pub struct WriteSceneError {
    /// What of it, and what to do.
    pub message: String,
}

impl Scene {
    /// Reads a scene from the text of a TOML file.
    ///
    /// ```
    /// use langevin_rigid_scenes::scene::Scene;
    /// let text = r#"
    ///     fluid.preset = "water"
    ///     run = { time_step = 0.002, duration = 1.0 }
    ///     [body]
    ///     shape = "ellipsoid"
    ///     semi_axes = [0.01, 0.02, 0.04]
    ///     density = -1100.0
    /// "#;
    /// let error = Scene::parse("ball", "ball.toml", text).unwrap_err();
    /// assert_eq!((error.line, error.column), (7, 15));
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] with line and column: syntax, unknown keys, missing or impossible values.
    pub fn parse(name: &str, file: &str, text: &str) -> Result<Self, SceneError> {
        let doc = Document { file, text };
        let raw: RawScene = toml::from_str(text)
            .map_err(|e| doc.error(e.span().unwrap_or(0..0), e.message().to_owned()))?;
        let run = raw.run.get_ref();
        let release = release::resolve(&doc, &raw.release)?;
        let tank = surroundings::tank(&doc, raw.tank.as_ref())?;
        let fluid = surroundings::fluid(&doc, &raw.fluid)?;
        let stop = run::stop(&doc, &raw.run, tank.map(|t| t.floor(release.position)))?;
        run::check_height(&doc, run, &stop, release.position[1])?;
        let seed = run.seed.as_ref().map_or(0, |seed| seed.get_ref().0);
        let settings = run::settings(&doc, run, &raw.turbulence)?;
        let contact = raw.contact.as_ref().map(|raw| world::contact(&doc, raw));
        let contact = contact.transpose()?;
        let material = contact.unwrap_or_default().material;
        let water = raw.water.as_ref();
        let water = water.map(|raw| world::water(&doc, raw, settings.gravity));
        let crowd = raw.crowd.as_ref().map(|raw| crowd::resolve(&doc, raw));
        let crowd = crowd.transpose()?;
        let kinds = crowd.iter().flat_map(|crowd| &crowd.kinds);
        let names: Vec<String> = std::iter::once(OWN.to_owned())
            .chain(kinds.map(CrowdKind::name))
            .collect();
        wind::check_bodies(&doc, &raw.wind, &names)?;
        if stop.time.is_none()
            && (contact.is_some() || water.is_some() || crowd.is_some() || !raw.obstacle.is_empty())
        {
            let message = "where bodies touch, float or are many the ground does not end the run: give a `duration` (s)";
            return Err(doc.error(raw.run.span(), message));
        }
        let parts = wind::resolve(&doc, &raw.wind, stop.ground, fluid.velocity)?;
        let scatter = scatter::resolve(&doc, &raw.scatter)?;
        scatter::check_history(&doc, &raw.scatter, &scatter, &settings)?;
        let surroundings = direct::Surroundings {
            ground: stop.ground.is_some(),
            tank: tank.is_some(),
            steered: raw.steering.is_some(),
        };
        Ok(Self {
            name: name.to_owned(),
            description: raw.description.clone().unwrap_or_default(),
            settings: Settings {
                separated: separated::resolve(&doc, &raw.separated)?,
                release_speed: relative_speed(&release, &fluid, &parts, seed),
                ..settings
            },
            time_step: run::time_step(&doc, &raw.run, &stop)?,
            seed,
            grid: grid::resolve(&doc, &raw.turbulence)?,
            picture_interval: doc.given(&raw.picture.interval, "interval", TIME_STEP)?,
            scatter,
            carried: release::carried(&doc, &raw.release)?,
            // Last: it makes a mesh.
            body: body::resolve(&doc, &raw.body)?,
            fluid,
            release,
            stop,
            tank,
            wind: parts,
            contact,
            obstacles: world::obstacles(&doc, &raw.obstacle, material)?,
            water: water.transpose()?,
            crowd,
            stream: run::stream(&doc, run)?,
            steering: steering::resolve(&doc, raw.steering.as_ref())?,
            direct: direct::resolve(&doc, raw.direct.as_ref(), &surroundings)?,
        })
    }

    /// The wind of its run.
    ///
    /// # Errors
    /// [`SceneWindError`]; for a scene that was read only where the file of a table is none.
    pub fn make_wind(&self) -> Result<Wind, SceneWindError> {
        self.make_wind_for(OWN)
    }

    /// The wind that bodies of this name feel: [`OWN`], or the name of a scene of the crowd.
    ///
    /// # Errors
    /// Those of [`Scene::make_wind`].
    pub fn make_wind_for(&self, name: &str) -> Result<Wind, SceneWindError> {
        wind::wind(&self.wind, name, self.seed)
    }

    /// Whether bodies meet more than their fluid: whether they touch, float or are many. The ground does not end a run
    /// there, bodies come to lie on it.
    pub fn is_world(&self) -> bool {
        self.contact.is_some()
            || !self.obstacles.is_empty()
            || self.water.is_some()
            || self.crowd.is_some()
    }

    /// Puts the scene under another model, with the integrator that it is meant for.
    pub fn set_model(&mut self, model: Model) {
        if model != self.settings.model {
            self.settings.model = model;
            self.settings.integrator = model.integrator();
        }
    }

    /// Speed of the release relative to the fluid (m/s).
    pub fn release_speed(&self) -> f64 {
        relative_speed(&self.release, &self.fluid, &self.wind, self.seed)
    }

    /// What is said of its runs in files for other programs.
    pub fn conditions(&self) -> Conditions<'_> {
        Conditions {
            scene: &self.name,
            fluid: &self.fluid,
            settings: &self.settings,
            seed: self.seed,
            time_step: self.time_step,
        }
    }

    /// The scene as a TOML file, every choice spelled out.
    ///
    /// # Errors
    /// [`WriteSceneError`], for a mesh whose path is not UTF-8.
    pub fn to_toml(&self) -> Result<String, WriteSceneError> {
        toml::to_string(&self.raw()?).map_err(|error| WriteSceneError {
            message: error.to_string(),
        })
    }

    fn raw(&self) -> Result<RawScene, WriteSceneError> {
        Ok(RawScene {
            description: Some(self.description.clone()),
            fluid: Spanned::new(
                0..0,
                RawFluid {
                    preset: None,
                    density: given(self.fluid.density),
                    viscosity: given(self.fluid.viscosity),
                    velocity: given(self.fluid.velocity.to_vec()),
                },
            ),
            body: Spanned::new(0..0, body::write(&self.body)?),
            release: release::write(&self.release, self.carried),
            run: Spanned::new(
                0..0,
                RawRun {
                    model: given(self.settings.model.to_string()),
                    integrator: given(self.settings.integrator.to_string()),
                    turbulence: given(self.settings.turbulence.to_string()),
                    time_step: given(self.time_step),
                    duration: self.stop.time.and_then(given),
                    ground: self.stop.ground.and_then(given),
                    seed: given(Seed(self.seed)),
                    gravity: given(self.settings.gravity.to_vec()),
                    reynolds: self.settings.reynolds.and_then(given),
                    stream: (self.stream != 0)
                        .then(|| i64::from(self.stream))
                        .and_then(given),
                },
            ),
            turbulence: grid::write(&self.grid, self.settings.turbulence_length),
            separated: separated::write(&self.settings.separated),
            picture: RawPicture {
                interval: self.picture_interval.and_then(given),
            },
            scatter: scatter::write(&self.scatter),
            tank: self.tank.map(|tank| RawTank {
                size: Spanned::new(0..0, tank.size.to_vec()),
            }),
            steering: self.steering.as_ref().map(steering::write),
            direct: self.direct.as_ref().map(direct::write).transpose()?,
            wind: self
                .wind
                .iter()
                .map(wind::write)
                .collect::<Result<_, _>>()?,
            contact: self.contact.as_ref().map(world::write_contact),
            water: self.water.as_ref().map(world::write_water),
            crowd: self.crowd.as_ref().map(crowd::write),
            obstacle: self
                .obstacles
                .iter()
                .map(world::write_obstacle)
                .collect::<Result<_, _>>()?,
        })
    }
}

/// Of the body and the fluid at the release (m/s).
fn relative_speed(release: &State, fluid: &Fluid, parts: &[WindPart], seed: u64) -> f64 {
    let gust = wind::at_release(parts, seed, release.position);
    norm(sub(release.world_velocity(), add(fluid.velocity, gust)))
}
