//! One body made ready to step: Algorithm 2.

use crate::batch::{Batch, BatchError, Inputs, Pack, Precision};
use crate::body::{Body, BodyError};
use crate::equations::{Equations, Loads, Noise, SPEED_LIMIT, Separated, is_unit, possible};
use crate::fluid::Fluid;
use crate::input::{Forcing, Input, Wrench, rotation_rate};
use crate::kirchhoff::{Kirchhoff, Motion, seen_from};
use crate::langevin::Langevin;
use crate::linalg::{
    Quat, Vec3, Vec6, add, cross, join, matrix_of, mul, norm, rotate, rotate_back, split, sub,
};
use crate::loads::Loads as ByCause;
use crate::noise::Counter;
use crate::pace::Pace;
use crate::published::Published;
use crate::runge_kutta;
use crate::separated::Closure;
use crate::settings::{Integrator, Model, Settings};
use crate::shape::Symmetric;
use crate::state::State;
use crate::turbulence::{
    HistoryError, PreparedSource, TurbulenceHistory, TurbulenceSource, kolmogorov_c0,
};

/// A body in a fluid under a model, made ready to step.
///
/// Holds everything that stays the same from step to step; the state is the caller's. A step
/// allocates nothing.
///
/// ```
/// use langevin_rigid::{Body, Fluid, Input, Separation, Settings, State, Stepper};
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
///     stepper.step(&mut state, 1e-3, &Input::default())?;
/// }
/// assert!(state.position[1] < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Stepper {
    pub(crate) equations: Equations,
    /// The same for a body that is symmetric, which takes its default steps.
    pub(crate) symmetric: Option<Box<Equations<Symmetric>>>,
    /// The paper's own integrator in place of the default one.
    paper: Option<Paper>,
    model: Model,
    reynolds: f64,
}

/// What the paper's integrator is given.
#[derive(Debug, Clone)]
enum Paper {
    RungeKutta4(Option<Box<Langevin>>),
    Published(Box<Published>),
}

/// Why a body cannot be made ready to step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The body is impossible.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The turbulence history is impossible.
    #[error(transparent)]
    History(#[from] HistoryError),
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
#[non_exhaustive]
pub enum StepError {
    /// The state that the step was to start from is impossible.
    #[error(
        "{name} of the state before step {step} is no {wanted}; whoever set this state must mend it"
    )]
    State {
        /// What of the state.
        name: &'static str,
        /// What it must be.
        wanted: &'static str,
        /// Number of the step.
        step: u64,
    },
    /// The time step is negative, infinite or not a number.
    #[error("the time step is {0} s; it must be zero or a positive number")]
    TimeStep(f64),
    /// The input is impossible.
    #[error(
        "the input of step {step} (flow or wrench) has a number that is not finite; whoever set it must mend it"
    )]
    Input {
        /// Number of the step.
        step: u64,
    },
    /// The step would have left the state infinite, not a number, or faster than [`SPEED_LIMIT`].
    #[error(
        "the state diverged at t = {time} s (step {step}, time step {time_step} s, model `{model}`): it is no longer finite, or faster than {SPEED_LIMIT:e} m/s{}",
        hint(.model)
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

fn hint(model: &Model) -> &'static str {
    match model {
        Model::Published(_) => {
            "; use a smaller time step, or the model `consistent`: the printed equations diverge at ordinary steps"
        }
        _ => {
            "; the integrator `rk4` wants a smaller time step, and the default one ends so only where its clock overflows"
        }
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
        if let Some(history) = history {
            history.check()?;
        }
        let kirchhoff =
            Kirchhoff::new(body, fluid, settings.gravity).ok_or(SetupError::TotalMass)?;
        let (loads, paper) = loads(body, fluid, history, settings, &kirchhoff)?;
        let moving = fluid.velocity.iter().any(|&u| u != 0.0);
        let closure = match &loads {
            Loads::Separated(separated) => Some(&separated.closure),
            Loads::None | Loads::Langevin(_) => None,
        };
        let equations = Equations {
            pace: Pace::of(&kirchhoff, closure),
            kirchhoff,
            loads,
            current: moving.then_some(fluid.velocity),
        };
        let symmetric =
            Symmetric::includes(body, fluid.density).then(|| Box::new(equations.lift(1.0)));
        Ok(Self {
            equations,
            symmetric,
            paper,
            model: settings.model,
            reynolds: reynolds(body, fluid, settings),
        })
    }

    /// Advances `state` by `dt` (s) with the noise of its step number, under `input`, which stays what it is over the
    /// step.
    ///
    /// A step longer than [`Stepper::longest_step`] is taken in parts, up to 256. However
    /// long it is, the body gains no more energy than its weight, its buoyancy, `input` and turbulence give it.
    ///
    /// # Errors
    /// [`StepError`], with `state` left as it was before the step.
    pub fn step(&self, state: &mut State, dt: f64, input: &Input) -> Result<(), StepError> {
        let before = state.motion();
        let forcing = Forcing::of(input);
        let (motion, sound) = match &self.paper {
            None => {
                let noise = Noise {
                    seed: input.noise.seed,
                    counter: Counter::new(state.step, input.noise.body),
                };
                let (time, forcing) = (state.time, forcing.as_ref());
                let stepped = match &self.symmetric {
                    Some(equations) => equations.step(&before, time, dt, &noise, forcing),
                    None => self.equations.step(&before, time, dt, &noise, forcing),
                };
                (stepped.motion, stepped.sound)
            }
            Some(paper) => self.paper_step(paper, &before, state, dt, input, forcing.as_ref()),
        };
        let next = State::of(&motion, state.time + dt, state.step.wrapping_add(1));
        let told = forcing.is_none() || input.is_finite();
        if !(sound && told && dt >= 0.0 && next.time.is_finite()) {
            return Err(self.why_not(state, dt, input));
        }
        *state = next;
        Ok(())
    }

    /// Reynolds number of the run: see [`Settings::release_speed`].
    pub fn reynolds(&self) -> f64 {
        self.reynolds
    }

    /// The longest step (s) that a body in this state takes whole in steady fluid; a longer one is taken in parts.
    ///
    /// Infinite for a body at rest without friction.
    pub fn longest_step(&self, state: &State) -> f64 {
        let motion = self.equations.relative_to_fluid(&state.motion(), None);
        self.equations.pace.longest_step(&motion.xi)
    }

    /// Why the step from `state` over `dt` could not be taken.
    pub(crate) fn why_not(&self, state: &State, dt: f64, input: &Input) -> StepError {
        let of_state = |name, wanted| StepError::State {
            name,
            wanted,
            step: state.step,
        };
        if !state.is_finite() {
            of_state("a number", "finite number")
        } else if !is_unit(state.orientation) {
            of_state("the orientation", "unit quaternion")
        } else if !(dt >= 0.0 && dt.is_finite()) {
            StepError::TimeStep(dt)
        } else if !input.is_finite() {
            StepError::Input { step: state.step }
        } else if !possible(&state.motion()) {
            of_state(
                "the speed or spin",
                "possible one (below 1e6 m/s and rad/s)",
            )
        } else {
            StepError::Diverged {
                time: state.time,
                step: state.step,
                time_step: dt,
                model: self.model,
            }
        }
    }

    /// Advances every body of `batch` by `dt` (s), each with the noise of its own step number, in steady fluid.
    ///
    /// In double precision a body has the same bits as by [`Stepper::step`]. Nothing is allocated.
    ///
    /// # Errors
    /// [`BatchError`], which names the bodies that diverged; they are left as they were, the others
    /// have moved on.
    pub fn step_batch<P: Precision>(
        &self,
        batch: &mut Batch<P>,
        dt: f64,
    ) -> Result<(), BatchError> {
        self.step_packs(batch.packs_mut(), dt)
    }

    /// The same under `inputs`, which gives a body's input from its number and its state; the noise is that of the batch.
    ///
    /// ```
    /// use langevin_rigid::{Batch, Body, Flow, Fluid, Input, Settings, State, Stepper};
    /// let disc = Body::disc(0.05, 0.001, 500.0)?;
    /// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;
    /// let mut batch = Batch::<f64>::new(7);
    /// for _ in 0..100 {
    ///     batch.push(&State::default());
    /// }
    /// // A wind that grows with height.
    /// let wind = |_, state: &State| Input {
    ///     flow: Flow::uniform([0.3 * (state.position[1] + 2.0), 0.0, 0.0]),
    ///     ..Input::default()
    /// };
    /// for _ in 0..10 {
    ///     stepper.step_batch_with(&mut batch, 1e-2, wind)?;
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_batch_with<P: Precision>(
        &self,
        batch: &mut Batch<P>,
        dt: f64,
        inputs: impl FnMut(u32, &State) -> Input,
    ) -> Result<(), BatchError> {
        self.step_packs_with(batch.packs_mut(), dt, inputs)
    }

    /// [`Stepper::step_batch`] for some packs of a batch, so that a host can share them among its own threads.
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_packs<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
    ) -> Result<(), BatchError> {
        self.each_pack(packs, dt, None)
    }

    /// [`Stepper::step_batch_with`] for some packs of a batch.
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_packs_with<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        mut inputs: impl FnMut(u32, &State) -> Input,
    ) -> Result<(), BatchError> {
        self.each_pack(packs, dt, Some(&mut inputs))
    }

    fn each_pack<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        mut inputs: Option<&mut Inputs<'_>>,
    ) -> Result<(), BatchError> {
        let mut stopped = Vec::new();
        match self.paper {
            _ if dt.is_nan() || dt < 0.0 => {
                let places = packs.iter().flat_map(Pack::bodies);
                stopped.extend(places.map(|body| (body, StepError::TimeStep(dt))));
            }
            None => {
                let mut forced = |pack: &Pack<P>| pack.forced(inputs.as_mut()?);
                P::step(self, packs, dt, &mut forced, &mut stopped);
            }
            Some(_) => {
                let mut input = |body, state: &State| match &mut inputs {
                    Some(inputs) => inputs(body, state),
                    None => Input::default(),
                };
                for pack in packs {
                    pack.step_each(&mut input, &mut stopped, |state, input| {
                        self.step(state, dt, input)
                    });
                }
            }
        }
        match stopped.first() {
            None => Ok(()),
            Some((_, first)) => Err(BatchError {
                first: first.clone(),
                bodies: stopped.into_iter().map(|(body, _)| body).collect(),
            }),
        }
    }

    /// Kinetic energy of the body and the fluid it moves, relative to the undisturbed fluid (J).
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        let motion = self.equations.relative_to_fluid(&state.motion(), None);
        self.equations.kirchhoff.energy(&motion.xi)
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
        let xi = self.equations.relative_to_fluid(&state.motion(), None).xi;
        let (p, l) = split(&mul(&self.equations.kirchhoff.total, &xi));
        let world = |a| rotate(state.orientation, a);
        let linear = world(p);
        (linear, add(world(l), cross(state.position, linear)))
    }

    fn paper_step(
        &self,
        paper: &Paper,
        before: &Motion,
        state: &State,
        dt: f64,
        input: &Input,
        forcing: Option<&Forcing>,
    ) -> (Motion, bool) {
        let normals = Counter::new(state.step, input.noise.body).normals(input.noise.seed);
        let mut motion = self.equations.relative_to_fluid(before, forcing);
        match paper {
            Paper::RungeKutta4(langevin) => {
                let langevin = langevin.as_deref();
                self.runge_kutta_step(&mut motion, langevin, state.time, dt, &normals, forcing);
            }
            Paper::Published(published) => {
                let outside = |m: &Motion| self.outside(m, forcing);
                published.step(&mut motion, state.time, dt, &normals, outside);
            }
        }
        let after = self.equations.in_the_world(motion, dt, forcing);
        let sound = possible(&after) && is_unit(before.orientation);
        (after, sound)
    }

    /// The generalized force of the forcing alone (body frame).
    fn outside(&self, motion: &Motion, forcing: Option<&Forcing>) -> Vec6 {
        let Some(forcing) = forcing else {
            return [0.0; 6];
        };
        let kirchhoff = &self.equations.kirchhoff;
        let into_body = |a| rotate_back(motion.orientation, a);
        let with = kirchhoff.static_load(&kirchhoff.statics(Some(forcing)), into_body);
        let without = kirchhoff.static_load(&kirchhoff.statics(None), into_body);
        std::array::from_fn(|i| with[i] - without[i])
    }

    /// Adds what the model has beside Kirchhoff's terms and `input` to `loads`.
    pub(crate) fn add_of_model(
        &self,
        motion: &Motion,
        time: f64,
        forcing: Option<&Forcing>,
        loads: &mut ByCause,
    ) {
        let world = |load: &Vec6| {
            let (force, torque) = split(load);
            Wrench {
                force: rotate(motion.orientation, force),
                torque: rotate(motion.orientation, torque),
            }
        };
        let relaxing = |langevin: &Langevin| {
            let relative = relative_to_turning(&motion.xi, motion.orientation, forcing);
            world(&langevin.relaxation(&relative, time))
        };
        match (&self.paper, &self.equations.loads) {
            (Some(Paper::RungeKutta4(None)), _) | (None, Loads::None) => {}
            (Some(Paper::RungeKutta4(Some(langevin))), _) => loads.turbulence = relaxing(langevin),
            (Some(Paper::Published(published)), _) => {
                let printed = published.loads(motion, time);
                loads.buoyancy.torque = world(&printed.buoyancy).torque;
                loads.added_mass = world(&printed.added_mass);
                loads.turbulence = world(&printed.turbulence);
            }
            (None, Loads::Langevin(langevin)) => loads.turbulence = relaxing(langevin),
            (None, Loads::Separated(separated)) => {
                let matrix = matrix_of(motion.orientation);
                let gradient = forcing.and_then(|forcing| forcing.gradient);
                let gradient = gradient.map(|gradient| seen_from(&matrix, &gradient));
                let causes = separated.closure.causes(&motion.xi, gradient.as_ref());
                loads.drag = world(&causes.drag);
                loads.normal_force = world(&causes.normal_force);
                loads.rotational_lift = world(&causes.rotational_lift);
                loads.damping = world(&causes.damping);
                loads.lost_couple = world(&causes.lost_couple);
                loads.friction = world(&causes.friction);
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
        forcing: Option<&Forcing>,
    ) {
        let kirchhoff = &self.equations.kirchhoff;
        let statics = kirchhoff.statics(forcing);
        let start = motion.xi;
        runge_kutta::step(motion, time, dt, |m, t| {
            let mut rate = kirchhoff.momentum_rate(&m.xi);
            accumulate(
                &mut rate,
                &kirchhoff.static_load(&statics, |a| rotate_back(m.orientation, a)),
            );
            if let Some(langevin) = langevin {
                let relative = relative_to_turning(&m.xi, m.orientation, forcing);
                accumulate(&mut rate, &langevin.relaxation(&relative, t));
            }
            mul(&kirchhoff.inverse, &rate)
        });
        if let Some(langevin) = langevin {
            accumulate(
                &mut motion.xi,
                &langevin.kick(&start, time, dt, None, normals),
            );
        }
    }
}

/// The velocity `xi` less the spin of the fluid (body frame).
fn relative_to_turning(xi: &Vec6, orientation: Quat, forcing: Option<&Forcing>) -> Vec6 {
    let Some(gradient) = forcing.and_then(|forcing| forcing.gradient) else {
        return *xi;
    };
    let (v, omega) = split(xi);
    join(
        v,
        sub(omega, rotate_back(orientation, rotation_rate(&gradient))),
    )
}

impl State {
    pub(crate) fn motion(&self) -> Motion {
        Motion {
            position: self.position,
            orientation: self.orientation,
            xi: join(self.velocity, self.angular_velocity),
        }
    }

    fn of(motion: &Motion, time: f64, step: u64) -> Self {
        let (velocity, angular_velocity) = split(&motion.xi);
        Self {
            time,
            step,
            position: motion.position,
            orientation: motion.orientation,
            velocity,
            angular_velocity,
        }
    }
}

/// The loads of a model, and the paper's integrator if that is to take the steps.
fn loads(
    body: &Body,
    fluid: &Fluid,
    history: Option<&TurbulenceHistory>,
    settings: &Settings,
    kirchhoff: &Kirchhoff,
) -> Result<(Loads, Option<Paper>), SetupError> {
    let reynolds = reynolds(body, fluid, settings);
    let source = || {
        let length = settings
            .turbulence_length
            .unwrap_or_else(|| body.turbulence_length());
        let c0 = kolmogorov_c0(reynolds);
        PreparedSource::new(settings.turbulence, history, length, c0)
            .ok_or(SetupError::NoHistory(settings.turbulence))
    };
    // Twice the mean speed: what a swing or a dive may reach.
    let mean = || {
        let falling = falling_speed(body, fluid, settings.gravity);
        let mean = falling.max(reynolds * fluid.viscosity / body.length);
        Ok::<_, SetupError>(source()?.with_mean_speed(2.0 * mean))
    };
    let langevin = |source| {
        let added = body.added_mass.map(|row| row.map(|a| fluid.density * a));
        Langevin::new(added, &kirchhoff.total, body.rotation_length(), source)
            .ok_or(SetupError::TotalMass)
    };
    let by_the_paper = settings.integrator == Integrator::RungeKutta4;
    Ok(match settings.model {
        Model::Kirchhoff if by_the_paper => (Loads::None, Some(Paper::RungeKutta4(None))),
        Model::Kirchhoff => (Loads::None, None),
        Model::Consistent if by_the_paper => {
            let langevin = langevin(mean()?)?;
            (
                Loads::None,
                Some(Paper::RungeKutta4(Some(Box::new(langevin)))),
            )
        }
        Model::Consistent => (Loads::Langevin(langevin(mean()?)?), None),
        Model::Separated => {
            let constants = settings.separated;
            let noise = langevin(source()?.with_intensity(constants.turbulence_intensity))?;
            let closure = Closure::new(body, fluid.density, fluid.viscosity, constants)
                .ok_or(SetupError::NoSeparation)?;
            (Loads::Separated(Separated { closure, noise }), None)
        }
        Model::Published(units) if by_the_paper => {
            let published = Published::new(body, fluid, settings.gravity, units, source()?)
                .ok_or(SetupError::TotalMass)?;
            (Loads::None, Some(Paper::Published(Box::new(published))))
        }
        Model::Published(_) => return Err(SetupError::PublishedIntegrator),
    })
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

/// Reynolds number of a run: see [`Settings::release_speed`].
fn reynolds(body: &Body, fluid: &Fluid, settings: &Settings) -> f64 {
    let speed = falling_speed(body, fluid, settings.gravity).max(settings.release_speed);
    let of_run = speed * body.length / fluid.viscosity;
    settings.reynolds.unwrap_or(of_run)
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
    let c = &settings.separated;
    let wake_age = match settings.turbulence {
        TurbulenceSource::BodyDriven { wake_age } => wake_age,
        TurbulenceSource::History => 0.0,
    };
    for (name, value) in [
        ("the Reynolds number", settings.reynolds.unwrap_or(0.0)),
        ("the release speed", settings.release_speed),
        ("the wake age of the turbulence", wake_age),
        ("the gain of dynamic stall", c.dynamic_stall),
        ("the rotational lift", c.rotational_lift),
        ("the rotational damping", c.rotational_damping),
        ("the turbulence intensity", c.turbulence_intensity),
    ] {
        if !(value >= 0.0 && value.is_finite()) {
            let wanted = "zero or a positive number";
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted,
            });
        }
    }
    for (name, value) in [
        ("the attachment", c.attachment),
        ("the broadside attachment", c.broadside_attachment),
    ] {
        if !(value > 0.0 && value <= 1.0) {
            let wanted = "above 0 and at most 1";
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted,
            });
        }
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

fn accumulate(sum: &mut Vec6, term: &Vec6) {
    for i in 0..6 {
        sum[i] += term[i];
    }
}
