//! One body made ready to step: Algorithm 2.

use crate::body::{Body, BodyError};
use crate::fluid::Fluid;
use crate::kirchhoff::{Kirchhoff, Motion};
use crate::langevin::Langevin;
use crate::linalg::{Vec3, Vec6, add, add_scaled, join, mul, norm, rotate_back, split, sub};
use crate::noise::NoiseStream;
use crate::published::Published;
use crate::runge_kutta;
use crate::separated::Closure;
use crate::settings::{Integrator, Model, Settings};
use crate::state::State;
use crate::turbulence::{PreparedSource, TurbulenceHistory, TurbulenceSource, kolmogorov_c0};

/// A step is taken in no more parts.
const MOST_PARTS: u32 = 256;

/// Speed (m/s) and spin (rad/s) beyond which a run has diverged: no light body in a fluid comes near.
pub const SPEED_LIMIT: f64 = 1e6;

/// A body in a fluid under a model, made ready to step.
///
/// Holds everything that stays the same from step to step; the state is the caller's. A step
/// allocates nothing.
///
/// ```
/// use langevin_rigid::{Body, Fluid, NoiseStream, Separation, Settings, State, Stepper};
/// // A 10 cm rubber ball in water: its added mass is half the water it displaces.
/// let volume = 5.236e-4;
/// let mut body = Body {
///     mass: 0.6, volume, inertia: [[6e-4, 0.0, 0.0], [0.0, 6e-4, 0.0], [0.0, 0.0, 6e-4]],
///     centre_of_buoyancy: [0.0; 3], added_mass: [[0.0; 6]; 6], half_extents: [0.05; 3],
///     thickness: 0.1, length: 0.1, separation: Separation::default(), parts: vec![], surface: Default::default(),
/// };
/// for i in 0..3 {
///     body.added_mass[i][i] = 0.5 * volume;
///     body.separation.drag_area[i][i] = 0.5 * 7.85e-3;
///     body.separation.extents[i][i] = 0.05 * 0.05;
/// }
///
/// let stepper = Stepper::new(&body, &Fluid::WATER, None, &Settings::default())?;
/// let mut state = State::default();
/// for _ in 0..100 {
///     stepper.step(&mut state, 1e-3, &NoiseStream::default())?;
/// }
/// assert!(state.position[1] < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Stepper {
    kirchhoff: Kirchhoff,
    scheme: Scheme,
    model: Model,
    /// Uniform velocity of the fluid, world frame.
    current: Vec3,
}

/// The loads and how they are advanced.
#[derive(Debug, Clone)]
enum Scheme {
    Strang(Option<Box<Langevin>>),
    RungeKutta4(Option<Box<Langevin>>),
    Published(Box<Published>),
    Separated(Box<Separated>),
}

/// Kirchhoff's equations with the closure for separated flow, and the turbulence that the body
/// sheds as noise.
#[derive(Debug, Clone)]
struct Separated {
    closure: Closure,
    noise: Langevin,
}

/// Why a body cannot be made ready to step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// The body is impossible.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A quantity is out of its range.
    #[error("{name} is {value}; it must be {wanted}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        wanted: &'static str,
    },
    /// Mass plus added mass is not positive definite.
    #[error(
        "the total mass tensor (body plus added mass) is not positive definite; check mass, inertia and centre of mass, and bake the body again"
    )]
    TotalMass,
    /// The source of turbulence needs a history that there is none of.
    #[error(
        "the turbulence source `{0}` samples a precomputed history and there is none; bake the scene with its turbulence, or use `body-driven`"
    )]
    NoHistory(TurbulenceSource),
    /// The body lacks the tensors that separated flow needs.
    #[error(
        "the model `separated` needs the body's extents and drag areas, and this body has none; bake it from its mesh"
    )]
    NoSeparation,
    /// The printed equations were asked for with another scheme.
    #[error(
        "the model `published` is defined with the integrator `rk4` only; choose `rk4` or another model"
    )]
    PublishedIntegrator,
}

/// Why a step was not taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The step would have left the state infinite, not a number, or faster than
    /// [`SPEED_LIMIT`].
    #[error(
        "the state diverged at t = {time} s (step {step}, time step {time_step} s, model `{model}`): it is no longer finite, or faster than {SPEED_LIMIT:e} m/s; use a smaller time step{}",
        published_hint(.model)
    )]
    Diverged {
        /// Time at the start of the step (s).
        time: f64,
        /// Number of the step.
        step: u64,
        /// Time step (s).
        time_step: f64,
        /// Model of the run.
        model: Model,
    },
}

fn published_hint(model: &Model) -> &'static str {
    match model {
        Model::Published(_) => {
            ", or the model `consistent`: the printed equations diverge at ordinary steps"
        }
        _ => "",
    }
}

impl Stepper {
    /// Makes `body` ready to step in `fluid`.
    ///
    /// `history` is needed by the sources that sample it. See [`SetupError`] for what is refused.
    pub fn new(
        body: &Body,
        fluid: &Fluid,
        history: Option<&TurbulenceHistory>,
        settings: &Settings,
    ) -> Result<Self, SetupError> {
        body.check()?;
        check(fluid, settings)?;
        let kirchhoff =
            Kirchhoff::new(body, fluid, settings.gravity).ok_or(SetupError::TotalMass)?;
        let scheme = Scheme::new(body, fluid, history, settings, &kirchhoff)?;
        Ok(Self {
            kirchhoff,
            scheme,
            model: settings.model,
            current: fluid.velocity,
        })
    }

    /// Advances `state` by `dt` (s) with the noise of its step number.
    ///
    /// # Errors
    /// [`StepError::Diverged`], with `state` left as it was before the step.
    pub fn step(&self, state: &mut State, dt: f64, noise: &NoiseStream) -> Result<(), StepError> {
        let mut motion = self.relative_to_fluid(state);
        match &self.scheme {
            Scheme::Strang(None) => self.kirchhoff.step(&mut motion, dt, unloaded),
            Scheme::Strang(Some(langevin)) => {
                self.strang_step(&mut motion, langevin, state, dt, noise);
            }
            Scheme::Separated(separated) => {
                let (normals, _) = halves(&noise.normals(state.step));
                let kick = separated.noise.kick(&motion.xi, state.time, dt, &normals);
                self.kirchhoff
                    .step(&mut motion, dt, |xi| separated.closure.load(xi));
                accumulate(&mut motion.xi, &mul(&self.kirchhoff.inverse, &kick));
            }
            Scheme::RungeKutta4(langevin) => {
                let (normals, _) = halves(&noise.normals(state.step));
                self.runge_kutta_step(&mut motion, langevin.as_deref(), state.time, dt, &normals);
            }
            Scheme::Published(published) => {
                let (normals, _) = halves(&noise.normals(state.step));
                published.step(&mut motion, state.time, dt, &normals);
            }
        }
        let next = self.in_the_world(&motion, state, dt);
        if !next.is_finite() || fastest(&next) > SPEED_LIMIT {
            return Err(StepError::Diverged {
                time: state.time,
                step: state.step,
                time_step: dt,
                model: self.model,
            });
        }
        *state = next;
        Ok(())
    }

    /// Kinetic energy of the body and the fluid it moves, relative to the undisturbed fluid (J).
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        self.kirchhoff.energy(&self.relative_to_fluid(state).xi)
    }

    /// Linear impulse of body and fluid in the world frame (kg m/s), R p, relative to the undisturbed
    /// fluid; constant where no load acts.
    pub fn linear_impulse(&self, state: &State) -> Vec3 {
        self.impulses(state).0
    }

    /// Angular impulse about the world's origin (kg m^2/s), R l + x x R p; constant where no load
    /// acts and the fluid is at rest.
    pub fn angular_impulse(&self, state: &State) -> Vec3 {
        self.impulses(state).1
    }

    fn impulses(&self, state: &State) -> (Vec3, Vec3) {
        let xi = self.relative_to_fluid(state).xi;
        let (p, l) = split(&mul(&self.kirchhoff.total, &xi));
        let world = |a| crate::linalg::rotate(state.orientation, a);
        let linear = world(p);
        (
            linear,
            add(world(l), crate::linalg::cross(state.position, linear)),
        )
    }

    /// The paper's scheme for Kirchhoff's and the Langevin part together.
    /// In parts where the body moves so fast that the coefficients would not hold over the step.
    fn strang_step(
        &self,
        motion: &mut Motion,
        langevin: &Langevin,
        state: &State,
        dt: f64,
        noise: &NoiseStream,
    ) {
        let mut done = 0.0;
        for part in 0..MOST_PARTS {
            let (time, left) = (state.time + done, dt - done);
            let wanted = langevin.longest_step(&motion.xi, time);
            let h = wanted.max(dt / f64::from(MOST_PARTS)).min(left);
            let (first, second) = halves(&noise.normals_of_part(state.step, part));
            langevin.step(&mut motion.xi, time, 0.5 * h, &first);
            self.kirchhoff.step(motion, h, unloaded);
            langevin.step(&mut motion.xi, time + 0.5 * h, 0.5 * h, &second);
            done += h;
            // What rounding leaves is no part.
            if (dt - done).abs() <= 1e-9 * dt.abs() {
                return;
            }
        }
    }

    fn runge_kutta_step(
        &self,
        motion: &mut Motion,
        langevin: Option<&Langevin>,
        time: f64,
        dt: f64,
        normals: &[f64; 6],
    ) {
        let start = motion.xi;
        runge_kutta::step(motion, time, dt, |m, t| {
            let mut rate = self.kirchhoff.momentum_rate(&m.xi);
            accumulate(&mut rate, &self.kirchhoff.static_load(m.orientation));
            if let Some(langevin) = langevin {
                accumulate(&mut rate, &langevin.relaxation(&m.xi, t));
            }
            mul(&self.kirchhoff.inverse, &rate)
        });
        if let Some(langevin) = langevin {
            let kick = langevin.kick(&start, time, dt, normals);
            accumulate(&mut motion.xi, &mul(&self.kirchhoff.inverse, &kick));
        }
    }

    /// The motion in the inertial frame that the undisturbed fluid is at rest in.
    fn relative_to_fluid(&self, state: &State) -> Motion {
        let current = rotate_back(state.orientation, self.current);
        Motion {
            position: state.position,
            orientation: state.orientation,
            xi: join(sub(state.velocity, current), state.angular_velocity),
        }
    }

    fn in_the_world(&self, motion: &Motion, before: &State, dt: f64) -> State {
        let (v, angular_velocity) = split(&motion.xi);
        let step = before.step + 1;
        State {
            time: before.time + dt,
            step,
            position: add_scaled(motion.position, dt, self.current),
            orientation: motion.orientation,
            velocity: add(v, rotate_back(motion.orientation, self.current)),
            angular_velocity,
        }
    }
}

impl Scheme {
    fn new(
        body: &Body,
        fluid: &Fluid,
        history: Option<&TurbulenceHistory>,
        settings: &Settings,
        kirchhoff: &Kirchhoff,
    ) -> Result<Self, SetupError> {
        let source = || {
            let reynolds = settings
                .reynolds
                .unwrap_or_else(|| falling_reynolds(body, fluid, settings.gravity));
            let length = settings
                .turbulence_length
                .unwrap_or_else(|| body.turbulence_length());
            PreparedSource::new(
                settings.turbulence,
                history,
                length,
                kolmogorov_c0(reynolds),
            )
            .ok_or(SetupError::NoHistory(settings.turbulence))
        };
        let langevin = match settings.model {
            Model::Kirchhoff => None,
            Model::Consistent => {
                let added = body.added_mass.map(|row| row.map(|a| fluid.density * a));
                let langevin =
                    Langevin::new(added, &kirchhoff.total, body.rotation_length(), source()?);
                Some(Box::new(langevin.ok_or(SetupError::TotalMass)?))
            }
            Model::Separated => {
                let added = body.added_mass.map(|row| row.map(|a| fluid.density * a));
                let constants = settings.separated;
                let source = source()?.with_intensity(constants.turbulence_intensity);
                let noise = Langevin::new(added, &kirchhoff.total, body.rotation_length(), source);
                let noise = noise.ok_or(SetupError::TotalMass)?;
                let closure = Closure::new(body, fluid.density, fluid.viscosity, constants)
                    .ok_or(SetupError::NoSeparation)?;
                return Ok(Self::Separated(Box::new(Separated { closure, noise })));
            }
            Model::Published(_) if settings.integrator != Integrator::RungeKutta4 => {
                return Err(SetupError::PublishedIntegrator);
            }
            Model::Published(units) => {
                let published = Published::new(body, fluid, settings.gravity, units, source()?);
                return Ok(Self::Published(Box::new(
                    published.ok_or(SetupError::TotalMass)?,
                )));
            }
        };
        Ok(match settings.integrator {
            Integrator::Strang => Self::Strang(langevin),
            Integrator::RungeKutta4 => Self::RungeKutta4(langevin),
        })
    }
}

/// Mean falling speed U0 of Eq. (1) (m/s), with the absolute difference of the densities so that
/// rising bodies have one too.
pub fn falling_speed(body: &Body, fluid: &Fluid, gravity: Vec3) -> f64 {
    let ratio = body.density() / fluid.density;
    ((ratio - 1.0).abs() * norm(gravity) * body.thickness).sqrt()
}

/// Reynolds number of Eq. (1).
pub fn falling_reynolds(body: &Body, fluid: &Fluid, gravity: Vec3) -> f64 {
    falling_speed(body, fluid, gravity) * body.length / fluid.viscosity
}

fn check(fluid: &Fluid, settings: &Settings) -> Result<(), SetupError> {
    let positive = [
        ("the fluid's density", Some(fluid.density)),
        ("the fluid's viscosity", Some(fluid.viscosity)),
        ("the turbulence length", settings.turbulence_length),
    ];
    for (name, value) in positive {
        let value = value.unwrap_or(1.0);
        if !(value > 0.0 && value.is_finite()) {
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted: "a positive number",
            });
        }
    }
    let reynolds = settings.reynolds.unwrap_or(0.0);
    if !(reynolds >= 0.0 && reynolds.is_finite()) {
        let name = "the Reynolds number";
        return Err(SetupError::OutOfRange {
            name,
            value: reynolds,
            wanted: "zero or a positive number",
        });
    }
    for (name, vector) in [
        ("a component of gravity", settings.gravity),
        ("a component of the fluid's velocity", fluid.velocity),
    ] {
        if let Some(&value) = vector.iter().find(|x| !x.is_finite()) {
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted: "a finite number",
            });
        }
    }
    Ok(())
}

fn halves(normals: &[f64; 12]) -> ([f64; 6], [f64; 6]) {
    (
        std::array::from_fn(|i| normals[i]),
        std::array::from_fn(|i| normals[6 + i]),
    )
}

/// No load beside gravity and buoyancy.
fn unloaded(_: &Vec6) -> Vec6 {
    [0.0; 6]
}

fn fastest(state: &State) -> f64 {
    norm(state.velocity).max(norm(state.angular_velocity))
}

fn accumulate(sum: &mut Vec6, term: &Vec6) {
    for i in 0..6 {
        sum[i] += term[i];
    }
}
