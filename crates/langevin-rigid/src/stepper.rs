//! One body made ready to step: Algorithm 2.

mod paper;
mod setup;

use crate::body::Body;
use crate::equations::{Equations, FluidLoads, Noise, SPEED_LIMIT, is_unit, possible};
use crate::fluid::Fluid;
use crate::input::{Forcing, Input};
use crate::kirchhoff::{Kirchhoff, Motion};
use crate::linalg::{Mat6, Vec3, add, cross, join, mul, rotate, split};
use crate::noise::Counter;
use crate::pace::Pace;
use crate::settings::{Model, Settings};
use crate::state::State;
use crate::symmetry::Symmetric;
use crate::turbulence::TurbulenceHistory;
pub(crate) use paper::{Paper, relative_to_turning};
pub use setup::{SetupError, falling_reynolds, falling_speed};

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
///     thickness: 0.1, length: 0.1, separation: Separation::default(), slices: vec![], surface: Default::default(),
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
        setup::check(fluid, settings)?;
        if let Some(history) = history {
            history.check()?;
        }
        let kirchhoff = Kirchhoff::new(body, fluid, settings.gravity)
            .ok_or_else(|| SetupError::without_inertia(body, fluid))?;
        let (loads, paper) = setup::loads(body, fluid, history, settings, &kirchhoff)?;
        let moving = fluid.velocity.iter().any(|&u| u != 0.0);
        let closure = match &loads {
            FluidLoads::Separated(separated) => Some(&separated.closure),
            FluidLoads::None | FluidLoads::Langevin(_) => None,
        };
        let equations = Equations {
            pace: Pace::of(&kirchhoff, closure, settings.longest_part),
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
            reynolds: setup::reynolds(body, fluid, settings),
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
            Some(paper) => paper.step(&self.equations, &before, state, dt, input, forcing.as_ref()),
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

    /// Mass of body and fluid together, body frame, about the centre of mass: what an impulse and its moment divide by
    /// to become a change of velocity and spin. Translation first: kg, kg m, kg m^2.
    pub fn total_mass(&self) -> &Mat6 {
        &self.equations.kirchhoff.total
    }

    /// Inverse of [`Stepper::total_mass`].
    ///
    /// ```
    /// use langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper, Wrench};
    /// let ball = Body::sphere(0.01, 500.0)?;
    /// let stepper = Stepper::new(&ball, &Fluid::WATER, None, &Settings::default())?;
    /// // A neutral ball gains half its volume in water.
    /// let mass = ball.mass + 0.5 * 998.2 * ball.volume;
    /// assert!((stepper.inverse_total_mass()[0][0] * mass - 1.0).abs() < 1e-2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse_total_mass(&self) -> &Mat6 {
        &self.equations.kirchhoff.inverse
    }

    /// The longest step (s) that a body in this state takes whole in steady fluid; a longer one is taken in parts.
    ///
    /// Infinite for a body at rest without friction.
    pub fn longest_step(&self, state: &State) -> f64 {
        let motion = self.equations.relative_to_fluid(&state.motion(), None);
        self.equations.pace.longest_step(&motion.xi)
    }

    /// The paper's own integrator, where it takes the steps.
    pub(crate) fn paper(&self) -> Option<&Paper> {
        self.paper.as_ref()
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
}

impl State {
    pub(crate) fn motion(&self) -> Motion {
        Motion {
            position: self.position,
            orientation: self.orientation,
            xi: join(self.velocity, self.angular_velocity),
            fluctuation: self.fluctuation,
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
            fluctuation: motion.fluctuation,
        }
    }
}
