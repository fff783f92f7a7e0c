//! Scene files: what to simulate, as TOML in SI units and degrees.
//!
//! [`Scene::parse`] reads and checks one; what is wrong comes back with its line and column.
//! [`Scene::to_toml`] writes the resolved scene, which reads back as the same scene.
//! [`find`] opens a built-in scene by name or a file by path; [`BUILT_IN`] is their one registry.

mod place;
mod raw;
mod registry;
mod separated;
mod shape;

use std::path::PathBuf;

use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::{Fluid, Integrator, Model, Settings, State, StopAt};
use langevin_rigid_bake::body::BodySpec;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_bake::turbulence::{FlowOptions, Sampling};
use serde_spanned::Spanned;

use crate::mesh::LengthUnit;
use place::Document;
pub use place::SceneError;
use raw::{
    Given, RawFluid, RawPicture, RawRelease, RawRun, RawScatter, RawScene, RawTank, RawTurbulence,
    given,
};
pub use registry::{BUILT_IN, BuiltIn, FindError, find};

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
    /// How the releases of an ensemble differ from `release`.
    pub scatter: Scatter,
    /// Walls and floor around the release point, if any.
    pub tank: Option<Tank>,
}

/// Standard deviations of the normal scatter of an ensemble's releases, one draw per run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scatter {
    /// Tilt about each of the world's horizontal axes x and z (degrees).
    pub tilt: f64,
    /// Each component of the angular velocity, world frame (rad/s).
    pub spin: f64,
    /// Each component of the velocity, world frame (m/s).
    pub velocity: f64,
}

/// A tank whose water surface is at the height of the release point, which is above its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tank {
    /// Width along x, depth of the water, width along z (m).
    pub size: [f64; 3],
}

impl Tank {
    /// Height of the floor for a release at `position` (m).
    pub fn floor(&self, position: [f64; 3]) -> f64 {
        position[1] - self.size[1]
    }
}

/// Where the body's surface and mass come from.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySource {
    /// The surface.
    pub geometry: Geometry,
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

impl Default for Grid {
    /// The grid of the paper's Fig. 2.
    fn default() -> Self {
        Self {
            cells: FlowOptions::PAPER_CELLS,
            cell: None,
            inflow_speed: None,
            time_step: None,
            duration: None,
            sampling: Sampling::Fixed,
        }
    }
}

impl Scene {
    /// Reads a scene from the text of a TOML file.
    ///
    /// ```
    /// use langevin_rigid_formats::scene::Scene;
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
        let fluid = fluid(&doc, &raw.fluid)?;
        let settings = Settings {
            separated: separated::resolve(&doc, &raw.separated)?,
            ..settings(&doc, raw.run.get_ref(), &raw.turbulence)?
        };
        let run = raw.run.get_ref();
        let release = release(&doc, &raw.release)?;
        let tank = tank(&doc, raw.tank.as_ref())?;
        let stop = stop(&doc, &raw.run, tank.map(|t| t.floor(release.position)))?;
        if let (Some(ground), Some(height)) = (&run.ground, stop.ground)
            && release.position[1] <= height
        {
            let message = format!(
                "the ground is at {height} m and the body is released at {} m; release it higher",
                release.position[1]
            );
            return Err(doc.error(ground.span(), message));
        }
        Ok(Self {
            name: name.to_owned(),
            description: raw.description.clone().unwrap_or_default(),
            fluid,
            body: shape::resolve(&doc, &raw.body)?,
            release,
            carried: carried(&doc, &raw.release)?,
            settings,
            time_step: match &run.time_step {
                Some(dt) => doc.positive(dt, "`time_step` (s)")?,
                None => return Err(doc.error(raw.run.span(), "the run needs a `time_step` (s)")),
            },
            stop,
            seed: run.seed.as_ref().map_or(Ok(0), |s| {
                u64::try_from(*s.get_ref()).map_err(|_| {
                    doc.error(s.span(), "`seed` must be zero or a positive whole number")
                })
            })?,
            grid: grid(&doc, &raw.turbulence)?,
            picture_interval: match &raw.picture.interval {
                Some(interval) => Some(doc.positive(interval, "`interval` (s)")?),
                None => None,
            },
            scatter: scatter(&doc, &raw.scatter)?,
            tank,
        })
    }

    /// The scene as a TOML file, every choice spelled out.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&RawScene {
            description: Some(self.description.clone()),
            fluid: Spanned::new(
                0..0,
                RawFluid {
                    preset: None,
                    density: given(self.fluid.density),
                    viscosity: given(self.fluid.viscosity),
                    velocity: given(self.fluid.velocity),
                },
            ),
            body: Spanned::new(0..0, shape::write(&self.body)),
            release: write_release(&self.release, self.carried),
            run: Spanned::new(
                0..0,
                RawRun {
                    model: given(self.settings.model.to_string()),
                    integrator: given(self.settings.integrator.to_string()),
                    turbulence: given(self.settings.turbulence.to_string()),
                    time_step: given(self.time_step),
                    duration: self.stop.time.and_then(given),
                    ground: self.stop.ground.and_then(given),
                    seed: given(self.seed as i64),
                    gravity: given(self.settings.gravity),
                },
            ),
            turbulence: RawTurbulence {
                length: self.settings.turbulence_length.and_then(given),
                cells: given(self.grid.cells.map(|n| n as i64)),
                cell: self.grid.cell.and_then(given),
                inflow_speed: self.grid.inflow_speed.and_then(given),
                time_step: self.grid.time_step.and_then(given),
                duration: self.grid.duration.and_then(given),
                sampling: given(sampling_name(self.grid.sampling).to_owned()),
            },
            separated: separated::write(&self.settings.separated),
            picture: RawPicture {
                interval: self.picture_interval.and_then(given),
            },
            scatter: RawScatter {
                tilt: given(self.scatter.tilt),
                spin: given(self.scatter.spin),
                velocity: given(self.scatter.velocity),
            },
            tank: self.tank.map(|tank| RawTank {
                size: Spanned::new(0..0, tank.size),
            }),
        })
    }
}

fn fluid(doc: &Document, raw: &Spanned<RawFluid>) -> Result<Fluid, SceneError> {
    let given = raw.get_ref();
    let preset = match given.preset.as_ref().map(|p| (p, p.get_ref().as_str())) {
        None => None,
        Some((_, "air")) => Some(Fluid::AIR),
        Some((_, "water")) => Some(Fluid::WATER),
        Some((p, other)) => {
            let message = format!(
                "`{other}` is no preset fluid; choose air or water, or give `density` and `viscosity`"
            );
            return Err(doc.error(p.span(), message));
        }
    };
    let quantity = |value: &Given<f64>, of_preset: Option<f64>, what: &str| match (value, of_preset)
    {
        (Some(v), _) => doc.positive(v, what),
        (None, Some(p)) => Ok(p),
        (None, None) => Err(doc.error(
            raw.span(),
            format!("the fluid needs {what}, or a `preset` (\"air\" or \"water\")"),
        )),
    };
    Ok(Fluid {
        density: quantity(
            &given.density,
            preset.map(|p| p.density),
            "`density` (kg/m^3)",
        )?,
        viscosity: quantity(
            &given.viscosity,
            preset.map(|p| p.viscosity),
            "`viscosity` (kinematic, m^2/s)",
        )?,
        velocity: vector(doc, &given.velocity, "`velocity` (m/s)")?,
    })
}

fn vector<const N: usize>(
    doc: &Document,
    value: &Given<[f64; N]>,
    what: &str,
) -> Result<[f64; N], SceneError> {
    value
        .as_ref()
        .map_or(Ok([0.0; N]), |v| doc.finite_all(v, what))
}

fn settings(
    doc: &Document,
    run: &RawRun,
    turbulence: &RawTurbulence,
) -> Result<Settings, SceneError> {
    let defaults = Settings::default();
    let model = run
        .model
        .as_ref()
        .map_or(Ok(defaults.model), |m| doc.name::<Model>(m))?;
    let published = matches!(model, Model::Published(_));
    let integrator = match &run.integrator {
        Some(name) => {
            let integrator = doc.name::<Integrator>(name)?;
            if published && integrator != Integrator::RungeKutta4 {
                let message = "the model `published` is defined with the integrator `rk4` only";
                return Err(doc.error(name.span(), message));
            }
            integrator
        }
        None if published => Integrator::RungeKutta4,
        None => defaults.integrator,
    };
    let length = |l| doc.positive(l, "`length` (m)");
    Ok(Settings {
        model,
        integrator,
        turbulence: run
            .turbulence
            .as_ref()
            .map_or(Ok(defaults.turbulence), |t| doc.name(t))?,
        gravity: match &run.gravity {
            Some(g) => doc.finite_all(g, "`gravity` (m/s^2)")?,
            None => defaults.gravity,
        },
        turbulence_length: turbulence.length.as_ref().map(length).transpose()?,
        reynolds: None,
        ..defaults
    })
}

/// The ground is the tank's floor or `ground`, whichever is higher.
fn stop(doc: &Document, run: &Spanned<RawRun>, floor: Option<f64>) -> Result<StopAt, SceneError> {
    let raw = run.get_ref();
    let ground = raw
        .ground
        .as_ref()
        .map(|y| doc.finite(y, "`ground` (m)"))
        .transpose()?;
    let stop = StopAt {
        time: raw
            .duration
            .as_ref()
            .map(|t| doc.positive(t, "`duration` (s)"))
            .transpose()?,
        ground: [ground, floor].into_iter().flatten().reduce(f64::max),
    };
    match stop {
        StopAt {
            time: None,
            ground: None,
        } => {
            let message = "the run would never end: give a `duration` (s), a `ground` (height in m), both, or a [tank]";
            Err(doc.error(run.span(), message))
        }
        stop => Ok(stop),
    }
}

fn release(doc: &Document, raw: &RawRelease) -> Result<State, SceneError> {
    let mut state = State {
        position: vector(doc, &raw.position, "`position` (m)")?,
        orientation: orientation(doc, raw)?,
        ..State::default()
    };
    let velocity = vector(doc, &raw.velocity, "`velocity` (m/s)")?;
    let spin = vector(doc, &raw.angular_velocity, "`angular_velocity` (rad/s)")?;
    match raw.frame.as_ref().map(|f| (f, f.get_ref().as_str())) {
        None | Some((_, "world")) => state.set_world_velocities(velocity, spin),
        Some((_, "body")) => (state.velocity, state.angular_velocity) = (velocity, spin),
        Some((frame, other)) => {
            let message = format!("`{other}` is no frame of the velocities; choose world or body");
            return Err(doc.error(frame.span(), message));
        }
    }
    Ok(state)
}

/// The release as it reads back: velocities in the world frame where rounding lets them.
fn write_release(release: &State, carried: f64) -> RawRelease {
    let (velocity, spin) = (release.world_velocity(), release.world_angular_velocity());
    let mut again = *release;
    again.set_world_velocities(velocity, spin);
    let (frame, velocity, spin) = if again == *release {
        ("world", velocity, spin)
    } else {
        ("body", release.velocity, release.angular_velocity)
    };
    RawRelease {
        position: given(release.position),
        orientation: given(release.orientation),
        velocity: given(velocity),
        angular_velocity: given(spin),
        frame: given(frame.to_owned()),
        carried: given(carried),
        ..RawRelease::default()
    }
}

fn carried(doc: &Document, raw: &RawRelease) -> Result<f64, SceneError> {
    match &raw.carried {
        None => Ok(0.0),
        Some(t) if *t.get_ref() < 0.0 => Err(doc.error(
            t.span(),
            "`carried` (s) is a duration and must not be negative",
        )),
        Some(t) => doc.finite(t, "`carried` (s)"),
    }
}

fn orientation(doc: &Document, raw: &RawRelease) -> Result<[f64; 4], SceneError> {
    if let Some(given) = &raw.orientation {
        let q = doc.finite_all(given, "`orientation`")?;
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (length - 1.0).abs() > 1e-6 {
            let message = format!(
                "`orientation` [x, y, z, w] must be a unit quaternion; its length is {length}"
            );
            return Err(doc.error(given.span(), message));
        }
        if let Some(tilt) = &raw.tilt {
            return Err(doc.error(tilt.span(), "give a `tilt` or an `orientation`, not both"));
        }
        // What is a unit quaternion to rounding keeps its bits: resolved scenes read back the same.
        let is_unit = (length - 1.0).abs() < 1e-15;
        return Ok(if is_unit { q } else { q.map(|x| x / length) });
    }
    let axis = match &raw.tilt_axis {
        None => [0.0, 0.0, 1.0],
        Some(given) => {
            let axis = doc.finite_all(given, "`tilt_axis`")?;
            let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length == 0.0 {
                return Err(doc.error(given.span(), "`tilt_axis` must not be zero"));
            }
            axis.map(|x| x / length)
        }
    };
    let degrees = raw
        .tilt
        .as_ref()
        .map_or(Ok(0.0), |t| doc.finite(t, "`tilt` (degrees)"))?;
    Ok(quat_from_rotation_vector(
        axis.map(|x| x * degrees.to_radians()),
    ))
}

fn grid(doc: &Document, raw: &RawTurbulence) -> Result<Grid, SceneError> {
    let positive =
        |value: &Given<f64>, what| value.as_ref().map(|v| doc.positive(v, what)).transpose();
    let mut cells = Grid::default().cells;
    if let Some(wanted) = &raw.cells {
        for (n, &want) in cells.iter_mut().zip(wanted.get_ref()) {
            *n = usize::try_from(want)
                .ok()
                .filter(|n| *n > 0)
                .ok_or_else(|| {
                    doc.error(
                        wanted.span(),
                        "`cells` must be three positive whole numbers",
                    )
                })?;
        }
    }
    Ok(Grid {
        cells,
        cell: positive(&raw.cell, "`cell` (m)")?,
        inflow_speed: positive(&raw.inflow_speed, "`inflow_speed` (m/s)")?,
        time_step: positive(&raw.time_step, "`time_step` (s)")?,
        duration: positive(&raw.duration, "`duration` (s)")?,
        sampling: raw.sampling.as_ref().map_or(Ok(Sampling::Fixed), |s| {
            match s.get_ref().as_str() {
                "fixed" => Ok(Sampling::Fixed),
                "passive-particle" => Ok(Sampling::PassiveParticle),
                other => {
                    let message =
                        format!("`{other}` is no sampling; choose fixed or passive-particle");
                    Err(doc.error(s.span(), message))
                }
            }
        })?,
    })
}

fn scatter(doc: &Document, raw: &RawScatter) -> Result<Scatter, SceneError> {
    let deviation = |value: &Given<f64>, what: &str| match value {
        None => Ok(0.0),
        Some(v) if *v.get_ref() < 0.0 => {
            let message = format!("{what} is a standard deviation and must not be negative");
            Err(doc.error(v.span(), message))
        }
        Some(v) => doc.finite(v, what),
    };
    Ok(Scatter {
        tilt: deviation(&raw.tilt, "`tilt` (degrees)")?,
        spin: deviation(&raw.spin, "`spin` (rad/s)")?,
        velocity: deviation(&raw.velocity, "`velocity` (m/s)")?,
    })
}

fn tank(doc: &Document, raw: Option<&RawTank>) -> Result<Option<Tank>, SceneError> {
    let Some(RawTank { size }) = raw else {
        return Ok(None);
    };
    let what = "`size` (width along x, depth, width along z in m)";
    let lengths = doc.finite_all(size, what)?;
    if lengths.iter().any(|&length| length <= 0.0) {
        return Err(doc.error(size.span(), format!("{what} must be positive numbers")));
    }
    Ok(Some(Tank { size: lengths }))
}

fn sampling_name(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Fixed => "fixed",
        Sampling::PassiveParticle => "passive-particle",
    }
}
