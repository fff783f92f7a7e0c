//! Many bodies of one shape.

use std::collections::BTreeMap;
use std::sync::Arc;

use langevin_rigid::wind::Wind as RunTimeWind;
use langevin_rigid::{
    Batch as RunTimeBatch, BatchError, Flow, Input, Pack, State as RunTimeState, StepError,
    Stepper as RunTimeStepper, Wrench,
};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use rayon::ThreadPool;
use rayon::prelude::*;

use crate::errors::OrRaise;
use crate::interrupt::repeated;
use crate::state::{State, States};
use crate::stepper::{Stepper, together};
use crate::wind::Wind;
use crate::{arrays, threads};

/// Packs that a thread takes at once: 256 bodies.
const PACKS: usize = 16;

/// Many bodies of one shape, which step together, in SIMD lanes and on all cores.
///
/// One row a body: `positions` (n, 3), m, world frame; `orientations` (n, 4), unit quaternions x, y, z, w from the body to
/// the world; `velocities` (n, 3), m/s, and `angular_velocities` (n, 3), rad/s, body frame. What is left out is at rest at
/// the origin, as many as `count` says. Each body has the bits of `Stepper.step` with the same `seed` and its number.
///
/// >>> disc = Body.disc(radius=0.05, thickness=0.001, density=500.0)
/// >>> batch = Batch(Stepper(disc, Fluid.air()), count=1000, seed=7)
/// >>> batch.step(0.01, n=10)
/// array([], dtype=uint32)
/// >>> batch.positions.shape
/// (1000, 3)
#[pyclass(module = "langevin_rigid")]
pub(crate) struct Batch {
    batch: RunTimeBatch,
    stepper: Arc<RunTimeStepper>,
    stream: [f64; 3],
    seed: u64,
}

/// What acts on the bodies of a batch over steps.
struct Acting {
    wind: Option<Arc<RunTimeWind>>,
    apart: f64,
    stream: [f64; 3],
    velocity: Option<Vec<[f64; 3]>>,
    force: Option<Vec<[f64; 3]>>,
    torque: Option<Vec<[f64; 3]>>,
}

impl Acting {
    fn step(
        &self,
        stepper: &RunTimeStepper,
        packs: &mut [Pack],
        dt: f64,
    ) -> Result<(), BatchError> {
        let told = [&self.velocity, &self.force, &self.torque];
        match &self.wind {
            _ if told.iter().any(|told| told.is_some()) => {
                stepper.step_packs_with(packs, dt, |body, state| self.input(body, state))
            }
            Some(wind) => stepper.step_packs_in(packs, dt, wind, self.apart),
            None => stepper.step_packs(packs, dt),
        }
    }

    fn input(&self, body: u32, state: &RunTimeState) -> Input {
        let of = |rows: &Option<Vec<[f64; 3]>>| {
            rows.as_ref().map_or([0.0; 3], |rows| rows[body as usize])
        };
        let flow = Flow::uniform(of(&self.velocity));
        let flow = match &self.wind {
            None => flow,
            Some(wind) => {
                let time = state.time + self.apart * f64::from(body);
                together(&wind.flow(state.position, time, self.stream), &flow)
            }
        };
        Input {
            flow,
            wrench: Wrench {
                force: of(&self.force),
                torque: of(&self.torque),
            },
            ..Input::default()
        }
    }
}

impl Batch {
    fn place(&self, body: i64) -> PyResult<usize> {
        let count = self.batch.len();
        let place = if body < 0 { body + count as i64 } else { body };
        usize::try_from(place)
            .ok()
            .filter(|place| *place < count)
            .ok_or_else(|| {
                PyIndexError::new_err(format!("there is no body {body} in a batch of {count}"))
            })
    }
}

/// One step of all packs: which bodies could not take it, and why.
fn step_all(
    pool: &ThreadPool,
    stepper: &RunTimeStepper,
    packs: &mut [Pack],
    dt: f64,
    acting: &Acting,
) -> Vec<BatchError> {
    if packs.len() <= PACKS {
        return acting.step(stepper, packs, dt).err().into_iter().collect();
    }
    pool.install(|| {
        let chunks = packs.par_chunks_mut(PACKS);
        chunks
            .filter_map(|packs| acting.step(stepper, packs, dt).err())
            .collect()
    })
}

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (
        stepper, positions = None, orientations = None, velocities = None, angular_velocities = None, *, count = None,
        seed = 0
    ))]
    fn new(
        stepper: &Stepper,
        positions: Option<&Bound<'_, PyAny>>,
        orientations: Option<&Bound<'_, PyAny>>,
        velocities: Option<&Bound<'_, PyAny>>,
        angular_velocities: Option<&Bound<'_, PyAny>>,
        count: Option<u32>,
        seed: u64,
    ) -> PyResult<Self> {
        let mut given = [positions, orientations, velocities, angular_velocities].into_iter();
        let count = match (count, given.find_map(|rows| rows)) {
            (Some(count), _) => count as usize,
            (None, Some(rows)) => rows.len()?,
            (None, None) => {
                return Err(PyValueError::new_err(
                    "give the positions of the bodies, or how many there are as count",
                ));
            }
        };
        if u32::try_from(count).is_err() {
            return Err(PyValueError::new_err("a batch has fewer than 2^32 bodies"));
        }
        let mut batch = RunTimeBatch::new(seed);
        for _ in 0..count {
            batch.push(&RunTimeState::default());
        }
        let mut batch = Self {
            batch,
            stepper: Arc::clone(&stepper.stepper),
            stream: stepper.fluid.velocity,
            seed,
        };
        let all: Vec<usize> = (0..count).collect();
        batch.put(
            &all,
            positions,
            orientations,
            velocities,
            angular_velocities,
        )?;
        Ok(batch)
    }

    /// Advances every body by `n` steps of `dt` (s).
    ///
    /// `wind` is taken where each body is; body k meets it as it is k `apart` (s) later. `flow_velocity` (n, 3), m/s, comes on
    /// top; `force` (n, 3), N, and `torque` (n, 3), N m, about the centre of mass, are in the world frame. They stay what
    /// they are over the steps.
    ///
    /// Gives the numbers of the bodies that could not take a step, ascending: each stays as it was before it, the others
    /// have gone on. With `raises` it is a StepError if there are any, with these numbers in `bodies`.
    #[pyo3(signature = (
        dt, *, n = 1, wind = None, apart = 0.0, flow_velocity = None, force = None, torque = None, raises = true
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        dt: f64,
        n: usize,
        wind: Option<&Wind>,
        apart: f64,
        flow_velocity: Option<&Bound<'_, PyAny>>,
        force: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        raises: bool,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let count = self.batch.len();
        let rows = |given: Option<&Bound<'_, PyAny>>, name: &str| {
            given
                .map(|given| arrays::rows_of(given, name, count))
                .transpose()
        };
        let acting = Acting {
            wind: wind.map(|wind| Arc::clone(&wind.wind)),
            apart,
            stream: self.stream,
            velocity: rows(flow_velocity, "flow_velocity")?,
            force: rows(force, "force")?,
            torque: rows(torque, "torque")?,
        };
        let pool = threads::pool()?;
        let (batch, stepper) = (&mut self.batch, &*self.stepper);
        let mut stopped: BTreeMap<u32, Option<StepError>> = BTreeMap::new();
        let mut taken = 0;
        repeated(py, || {
            if taken == n {
                return Some(());
            }
            for BatchError { bodies, first } in
                step_all(&pool, stepper, batch.packs_mut(), dt, &acting)
            {
                let mut first = Some(first);
                for body in bodies {
                    // Of each error the words are those of its first body.
                    let words = first.take();
                    stopped.entry(body).or_insert(words);
                }
            }
            taken += 1;
            None
        })?;
        let bodies: Vec<u32> = stopped.keys().copied().collect();
        if raises && let Some(first) = stopped.into_values().flatten().next() {
            return Err(BatchError { bodies, first }).or_raise();
        }
        Ok(arrays::of_column(py, bodies))
    }

    /// Puts some bodies into other states, such as those whose episode is over; what is left out stays as it is.
    ///
    /// `bodies` are their numbers (k,); the others have a row for each, as in the constructor. `times` and `steps` (k,) are
    /// those since release; `steps` also selects the noise of the next step. Turbulence that the bodies see starts anew
    /// with `forget`.
    #[pyo3(signature = (
        bodies, *, positions = None, orientations = None, velocities = None, angular_velocities = None, times = None,
        steps = None, forget = true
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn set(
        &mut self,
        bodies: &Bound<'_, PyAny>,
        positions: Option<&Bound<'_, PyAny>>,
        orientations: Option<&Bound<'_, PyAny>>,
        velocities: Option<&Bound<'_, PyAny>>,
        angular_velocities: Option<&Bound<'_, PyAny>>,
        times: Option<&Bound<'_, PyAny>>,
        steps: Option<&Bound<'_, PyAny>>,
        forget: bool,
    ) -> PyResult<()> {
        let bodies = arrays::integers(bodies, "bodies")?;
        let places: Vec<usize> = bodies
            .iter()
            .map(|body| self.place(*body))
            .collect::<PyResult<_>>()?;
        let one_each = |count: usize, name: &str| match count == places.len() {
            true => Ok(()),
            false => Err(PyValueError::new_err(format!(
                "{name} has {count} numbers; it must have {}, one for each body",
                places.len()
            ))),
        };
        let times = times
            .map(|times| arrays::column(times, "times"))
            .transpose()?;
        let steps = steps
            .map(|steps| arrays::integers(steps, "steps"))
            .transpose()?;
        if let Some(times) = &times {
            one_each(times.len(), "times")?;
        }
        if let Some(steps) = &steps {
            one_each(steps.len(), "steps")?;
        }
        self.put(
            &places,
            positions,
            orientations,
            velocities,
            angular_velocities,
        )?;
        for (row, place) in places.iter().enumerate() {
            let Some(mut state) = self.batch.state(*place) else {
                continue;
            };
            if let Some(times) = &times {
                state.time = times[row];
            }
            if let Some(steps) = &steps {
                state.step = steps[row] as u64;
            }
            if forget {
                state.fluctuation = [0.0; 6];
            }
            self.batch.set(*place, &state);
        }
        Ok(())
    }

    /// The state of one body.
    fn state(&self, body: i64) -> PyResult<State> {
        Ok(State(
            self.batch.state(self.place(body)?).unwrap_or_default(),
        ))
    }

    /// Puts one body into a state.
    fn set_state(&mut self, body: i64, state: &State) -> PyResult<()> {
        let place = self.place(body)?;
        self.batch.set(place, &state.0);
        Ok(())
    }

    /// The states of all, as they are now.
    fn states(&self) -> States {
        let bodies = 0..self.batch.len();
        States(bodies.filter_map(|body| self.batch.state(body)).collect())
    }

    /// Centres of mass, world frame (n, 3), m.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().positions(py)
    }

    /// Unit quaternions x, y, z, w from the body to the world (n, 4).
    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().orientations(py)
    }

    /// Velocities, body frame (n, 3), m/s.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().velocities(py)
    }

    /// Angular velocities, body frame (n, 3), rad/s.
    #[getter]
    fn angular_velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().angular_velocities(py)
    }

    /// Velocities, world frame (n, 3), m/s.
    #[getter]
    fn world_velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().world_velocities(py)
    }

    /// Angular velocities, world frame (n, 3), rad/s.
    #[getter]
    fn world_angular_velocities<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.states().world_angular_velocities(py)
    }

    /// Times since release (n,), s.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.states().times(py)
    }

    /// Seed of the noise.
    #[getter]
    fn seed(&self) -> u64 {
        self.seed
    }

    fn __len__(&self) -> usize {
        self.batch.len()
    }

    fn __repr__(&self) -> String {
        format!("<Batch: {} bodies, seed {}>", self.batch.len(), self.seed)
    }
}

impl Batch {
    /// Puts the bodies in these places into these poses and motions, all of them or none.
    fn put(
        &mut self,
        places: &[usize],
        positions: Option<&Bound<'_, PyAny>>,
        orientations: Option<&Bound<'_, PyAny>>,
        velocities: Option<&Bound<'_, PyAny>>,
        angular_velocities: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let rows = |given: Option<&Bound<'_, PyAny>>, name: &str| {
            given
                .map(|given| arrays::rows_of::<3>(given, name, places.len()))
                .transpose()
        };
        let positions = rows(positions, "positions")?;
        let velocities = rows(velocities, "velocities")?;
        let angular_velocities = rows(angular_velocities, "angular_velocities")?;
        let orientations = orientations
            .map(|given| arrays::rows_of::<4>(given, "orientations", places.len()))
            .transpose()?
            .map(|rows| {
                let each = rows.into_iter().enumerate();
                each.map(|(row, q)| arrays::unit(q, &format!("row {row} of orientations")))
                    .collect::<PyResult<Vec<_>>>()
            })
            .transpose()?;
        for (row, place) in places.iter().enumerate() {
            let Some(mut state) = self.batch.state(*place) else {
                continue;
            };
            if let Some(positions) = &positions {
                state.position = positions[row];
            }
            if let Some(orientations) = &orientations {
                state.orientation = orientations[row];
            }
            if let Some(velocities) = &velocities {
                state.velocity = velocities[row];
            }
            if let Some(angular_velocities) = &angular_velocities {
                state.angular_velocity = angular_velocities[row];
            }
            self.batch.set(*place, &state);
        }
        Ok(())
    }
}
