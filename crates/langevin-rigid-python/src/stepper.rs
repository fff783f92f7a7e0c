//! A body in a fluid, made ready to step.

use std::sync::Arc;

use langevin_rigid::wind::Wind as RunTimeWind;
use langevin_rigid::{
    Bake, Flow as RunTimeFlow, Fluid as RunTimeFluid, Input, Integrator, Model, NoiseStream,
    SeparatedFlow, Settings, State as RunTimeState, Stepper as RunTimeStepper,
    TurbulenceHistory as History, TurbulenceSource, Wrench as RunTimeWrench,
};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::body::{Body, take_numbers};
use crate::errors::OrRaise;
use crate::fluid::Fluid;
use crate::interrupt::repeated;
use crate::state::{State, States};
use crate::turbulence::TurbulenceHistory;
use crate::wind::{Flow, Wind};
use crate::{arrays, loads::Loads};

/// A body in a fluid under a model, made ready to step. It does not change; any number of bodies of the shape share it.
///
/// `model` is "separated" (bodies flutter and tumble), "consistent" (the paper's method), "kirchhoff", "published" or
/// "published-si"; `integrator` "strang" or "rk4", by default what the model is meant for; `turbulence` "body-driven",
/// "wake-age=LENGTHS" or "history". The latter two sample a `history`, by default that of the body. `gravity` (3,), m/s^2,
/// world frame; `turbulence_length` (m), `release_speed` (m/s, relative to the fluid) and `reynolds` are for Eqs. (10) and
/// (18); `longest_part` up to 1.6 makes steps coarser and faster. `separated` has constants of that model by name, such as
/// {"attachment": 0.5}, and `attached=True` keeps its flow attached.
///
/// SetupError says what is impossible.
///
/// >>> leaf = Body.plate(length=0.08, width=0.05, thickness=2e-4, density=450.0)
/// >>> stepper = Stepper(leaf, Fluid.air())
/// >>> state = State(position=[0, 2, 0])
/// >>> while state.position[1] > 0.0:
/// ...     stepper.step(state, 1 / 60, seed=1)
/// >>> state.time > 0.6
/// True
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Stepper {
    pub(crate) stepper: Arc<RunTimeStepper>,
    pub(crate) fluid: RunTimeFluid,
    body: Arc<Bake>,
    settings: Settings,
    /// Where it is not that of the body.
    history: Option<History>,
}

#[pymethods]
impl Stepper {
    #[new]
    #[pyo3(signature = (
        body, fluid, *, model = "separated", integrator = None, turbulence = "body-driven", history = None,
        gravity = None, turbulence_length = None, release_speed = 0.0, reynolds = None, longest_part = 1.0,
        separated = None, attached = false
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        body: &Body,
        fluid: &Fluid,
        model: &str,
        integrator: Option<&str>,
        turbulence: &str,
        history: Option<&TurbulenceHistory>,
        gravity: Option<&Bound<'_, PyAny>>,
        turbulence_length: Option<f64>,
        release_speed: f64,
        reynolds: Option<f64>,
        longest_part: f64,
        separated: Option<&Bound<'_, PyDict>>,
        attached: bool,
    ) -> PyResult<Self> {
        let usual = Settings::default();
        let model: Model = model.parse().or_raise()?;
        let integrator = integrator
            .map(str::parse::<Integrator>)
            .transpose()
            .or_raise()?;
        let settings = Settings {
            model,
            integrator: integrator.unwrap_or(model.integrator()),
            turbulence: turbulence.parse::<TurbulenceSource>().or_raise()?,
            separated: constants(separated, attached)?,
            gravity: arrays::vector_or(gravity, "gravity", usual.gravity)?,
            turbulence_length,
            release_speed,
            reynolds,
            longest_part,
        };
        let history = history.map(|history| &history.0);
        let sampled = history.or(body.bake.history.as_ref());
        let stepper = RunTimeStepper::new(body.body(), &fluid.0, sampled, &settings);
        Ok(Self {
            stepper: Arc::new(stepper.or_raise()?),
            fluid: fluid.0,
            body: Arc::clone(&body.bake),
            settings,
            history: history.cloned(),
        })
    }

    /// Advances `state` by `dt` (s).
    ///
    /// `wind` is taken where the body is, `flow` comes on top of it: a Flow, or the velocity of a uniform one (3,), m/s.
    /// `force` (3,), N, and `torque` (3,), N m, about the centre of mass, are in the world frame. The noise is a pure
    /// function of `seed`, the number of the `body` and `state.step`. Any step is stable; a long one is taken in parts.
    ///
    /// StepError leaves the state as it was.
    #[pyo3(signature = (state, dt, *, wind = None, flow = None, force = None, torque = None, seed = 0, body = 0))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn step(
        &self,
        state: &mut State,
        dt: f64,
        wind: Option<&Wind>,
        flow: Option<&Bound<'_, PyAny>>,
        force: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        seed: u64,
        body: u32,
    ) -> PyResult<()> {
        let acting = Acting::of(self, wind, flow, force, torque, NoiseStream { seed, body })?;
        let input = acting.input(&state.0);
        self.stepper.step(&mut state.0, dt, &input).or_raise()
    }

    /// Takes `n` steps of `dt` (s) and gives the `States` after every `every`th of them; `state` is then the last.
    ///
    /// The rest is as in `step`; `flow`, `force` and `torque` stay what they are. StepError leaves the state as it was
    /// before the step that could not be taken.
    #[pyo3(signature = (
        state, dt, n, *, every = 1, wind = None, flow = None, force = None, torque = None, seed = 0, body = 0
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn steps(
        &self,
        py: Python<'_>,
        state: &mut State,
        dt: f64,
        n: usize,
        every: usize,
        wind: Option<&Wind>,
        flow: Option<&Bound<'_, PyAny>>,
        force: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        seed: u64,
        body: u32,
    ) -> PyResult<States> {
        if every == 0 {
            return Err(PyValueError::new_err("every is 0; it must be 1 or more"));
        }
        let acting = Acting::of(self, wind, flow, force, torque, NoiseStream { seed, body })?;
        let mut states = Vec::new();
        let current = &mut state.0;
        let mut taken = 0;
        let outcome = repeated(py, || {
            if taken == n {
                return Some(Ok(()));
            }
            let input = acting.input(current);
            if let Err(error) = self.stepper.step(current, dt, &input) {
                return Some(Err(error));
            }
            taken += 1;
            if taken.is_multiple_of(every) {
                states.push(*current);
            }
            None
        })?;
        outcome.or_raise()?;
        Ok(States(states))
    }

    /// What acts on the body, by cause: `Loads`, whose sum is the rate at which the impulse of the body and the fluid that
    /// it moves changes. Kicks of noise are not among them.
    ///
    /// >>> disc = Body.disc(radius=0.05, thickness=0.001, density=500.0)
    /// >>> loads = Stepper(disc, Fluid.air()).loads(State(velocity=[0, -1, 0]))
    /// >>> bool(loads["drag"].force[1] > 0.0 > loads["weight"].force[1])
    /// True
    #[pyo3(signature = (state, *, wind = None, flow = None, force = None, torque = None))]
    fn loads(
        &self,
        state: &State,
        wind: Option<&Wind>,
        flow: Option<&Bound<'_, PyAny>>,
        force: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Loads> {
        let acting = Acting::of(self, wind, flow, force, torque, NoiseStream::default())?;
        Ok(Loads(self.stepper.loads(&state.0, &acting.input(&state.0))))
    }

    /// Linear impulse of body and fluid, world frame (3,), kg m/s, relative to the undisturbed fluid.
    fn linear_impulse<'py>(&self, py: Python<'py>, state: &State) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.stepper.linear_impulse(&state.0))
    }

    /// Angular impulse of body and fluid about the world's origin (3,), kg m^2/s.
    fn angular_impulse<'py>(&self, py: Python<'py>, state: &State) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.stepper.angular_impulse(&state.0))
    }

    /// Kinetic energy of the body and the fluid that it moves, relative to the undisturbed fluid (J).
    fn kinetic_energy(&self, state: &State) -> f64 {
        self.stepper.kinetic_energy(&state.0)
    }

    /// The longest step (s) that a body in this state takes whole in steady fluid.
    fn longest_step(&self, state: &State) -> f64 {
        self.stepper.longest_step(&state.0)
    }

    /// Fraction of the couple of the added mass that separation leaves, under the model "separated"; None in others.
    #[pyo3(signature = (state, *, wind = None, flow = None))]
    fn attachment(
        &self,
        state: &State,
        wind: Option<&Wind>,
        flow: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Option<f64>> {
        let acting = Acting::of(self, wind, flow, None, None, NoiseStream::default())?;
        Ok(self.stepper.attachment(&state.0, &acting.input(&state.0)))
    }

    /// Mass of body and fluid together, body frame, about the centre of mass (6, 6): kg, kg m, kg m^2.
    #[getter]
    fn total_mass<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, self.stepper.total_mass())
    }

    /// The body.
    #[getter]
    fn body(&self) -> Body {
        Body {
            bake: Arc::clone(&self.body),
        }
    }

    /// The fluid.
    #[getter]
    fn fluid(&self) -> Fluid {
        Fluid(self.fluid)
    }

    /// Reynolds number of the run.
    #[getter]
    fn reynolds(&self) -> f64 {
        self.stepper.reynolds()
    }

    /// Name of the model.
    #[getter]
    fn model(&self) -> &'static str {
        self.settings.model.name()
    }

    /// Gravity, world frame (3,), m/s^2.
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.settings.gravity)
    }

    fn __repr__(&self) -> String {
        format!(
            "<Stepper: model {}, integrator {}, turbulence {}, Reynolds number {:.3e}>",
            self.settings.model,
            self.settings.integrator,
            self.settings.turbulence,
            self.stepper.reynolds()
        )
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, stepper) = (slf.py(), slf.get());
        let settings = &stepper.settings;
        let separated = PyDict::new(py);
        for (name, value) in named(&mut settings.separated.clone()) {
            separated.set_item(name, *value)?;
        }
        let keywords = PyDict::new(py);
        keywords.set_item("model", settings.model.name())?;
        keywords.set_item("integrator", settings.integrator.to_string())?;
        keywords.set_item("turbulence", settings.turbulence.to_string())?;
        keywords.set_item("history", stepper.history.clone().map(TurbulenceHistory))?;
        keywords.set_item("gravity", settings.gravity)?;
        keywords.set_item("turbulence_length", settings.turbulence_length)?;
        keywords.set_item("release_speed", settings.release_speed)?;
        keywords.set_item("reynolds", settings.reynolds)?;
        keywords.set_item("longest_part", settings.longest_part)?;
        keywords.set_item("separated", separated)?;
        keywords.set_item("attached", settings.separated.attached)?;
        let partial = py.import("functools")?.getattr("partial")?;
        let made = partial.call((slf.get_type(),), Some(&keywords))?;
        Ok((made, (stepper.body(), stepper.fluid()).into_pyobject(py)?))
    }
}

/// The constants of separated flow, with some by name.
fn constants(given: Option<&Bound<'_, PyDict>>, attached: bool) -> PyResult<SeparatedFlow> {
    let mut c = SeparatedFlow {
        attached,
        ..SeparatedFlow::default()
    };
    if let Some(given) = given {
        take_numbers(given, "the model `separated`", &mut named(&mut c))?;
    }
    Ok(c)
}

/// Those that are numbers, by name.
fn named(c: &mut SeparatedFlow) -> [(&'static str, &mut f64); 10] {
    [
        ("attachment", &mut c.attachment),
        ("broadside_attachment", &mut c.broadside_attachment),
        ("normal_force_arm", &mut c.normal_force_arm),
        ("dynamic_stall", &mut c.dynamic_stall),
        ("rotational_lift", &mut c.rotational_lift),
        ("damping", &mut c.damping),
        ("rotational_damping", &mut c.rotational_damping),
        ("relief_speed", &mut c.relief_speed),
        ("turbulence_intensity", &mut c.turbulence_intensity),
        ("turbulence_memory", &mut c.turbulence_memory),
    ]
}

/// What acts on a body over steps.
struct Acting {
    wind: Option<Arc<RunTimeWind>>,
    stream: [f64; 3],
    /// All but the wind.
    input: Input,
}

impl Acting {
    fn of(
        stepper: &Stepper,
        wind: Option<&Wind>,
        flow: Option<&Bound<'_, PyAny>>,
        force: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        noise: NoiseStream,
    ) -> PyResult<Self> {
        let flow = match flow {
            None => RunTimeFlow::default(),
            Some(flow) => match flow.cast::<Flow>() {
                Ok(flow) => flow.get().0,
                Err(_) => RunTimeFlow::uniform(arrays::vector(flow, "flow")?),
            },
        };
        Ok(Self {
            wind: wind.map(|wind| Arc::clone(&wind.wind)),
            stream: stepper.fluid.velocity,
            input: Input {
                flow,
                wrench: RunTimeWrench {
                    force: arrays::vector_or(force, "force", [0.0; 3])?,
                    torque: arrays::vector_or(torque, "torque", [0.0; 3])?,
                },
                noise,
            },
        })
    }

    fn input(&self, state: &RunTimeState) -> Input {
        let flow = match &self.wind {
            None => self.input.flow,
            Some(wind) => {
                let blown = wind.flow(state.position, state.time, self.stream);
                together(&blown, &self.input.flow)
            }
        };
        Input { flow, ..self.input }
    }
}

/// Two flows at the same place and time.
pub(crate) fn together(a: &RunTimeFlow, b: &RunTimeFlow) -> RunTimeFlow {
    let sum = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| a[i] + b[i]) };
    RunTimeFlow {
        velocity: sum(a.velocity, b.velocity),
        gradient: std::array::from_fn(|i| sum(a.gradient[i], b.gradient[i])),
        acceleration: sum(a.acceleration, b.acceleration),
    }
}
