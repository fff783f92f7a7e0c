//! States of bodies.

use langevin_rigid::State as RunTimeState;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays;

/// Where a body is and how it moves.
///
/// Position and orientation are in the world frame, +Y up: the centre of mass (3,), m, and a unit quaternion x, y, z, w
/// that turns body vectors into world vectors. `velocity` (m/s) and `angular_velocity` (rad/s) are in the body frame, as
/// the equations have them; `world_velocity` and `world_angular_velocity` are the same in the world frame. All can be set.
///
/// >>> state = State(position=[0, 2, 0], world_velocity=[1, 0, 0])
/// >>> state.velocity.tolist()
/// [1.0, 0.0, 0.0]
#[pyclass(module = "langevin_rigid")]
pub(crate) struct State(pub(crate) RunTimeState);

#[pymethods]
impl State {
    #[new]
    #[pyo3(signature = (
        *, position = None, orientation = None, velocity = None, angular_velocity = None, world_velocity = None,
        world_angular_velocity = None, time = 0.0, step = 0
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        position: Option<&Bound<'_, PyAny>>,
        orientation: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        angular_velocity: Option<&Bound<'_, PyAny>>,
        world_velocity: Option<&Bound<'_, PyAny>>,
        world_angular_velocity: Option<&Bound<'_, PyAny>>,
        time: f64,
        step: u64,
    ) -> PyResult<Self> {
        let mut state = Self(RunTimeState {
            time,
            step,
            position: arrays::vector_or(position, "position", [0.0; 3])?,
            ..RunTimeState::default()
        });
        if let Some(orientation) = orientation {
            state.set_orientation(orientation)?;
        }
        let twice = |name: &str| {
            pyo3::exceptions::PyTypeError::new_err(format!(
                "give either {name} (body frame) or world_{name}, not both"
            ))
        };
        match (velocity, world_velocity) {
            (Some(_), Some(_)) => return Err(twice("velocity")),
            (Some(velocity), None) => state.set_velocity(velocity)?,
            (None, Some(velocity)) => state.set_world_velocity(velocity)?,
            (None, None) => {}
        }
        match (angular_velocity, world_angular_velocity) {
            (Some(_), Some(_)) => return Err(twice("angular_velocity")),
            (Some(velocity), None) => state.set_angular_velocity(velocity)?,
            (None, Some(velocity)) => state.set_world_angular_velocity(velocity)?,
            (None, None) => {}
        }
        Ok(state)
    }

    /// Time since release (s).
    #[getter]
    fn time(&self) -> f64 {
        self.0.time
    }

    #[setter]
    fn set_time(&mut self, time: f64) {
        self.0.time = time;
    }

    /// Steps since release; with the seed it selects the noise of the next.
    #[getter]
    fn step(&self) -> u64 {
        self.0.step
    }

    #[setter]
    fn set_step(&mut self, step: u64) {
        self.0.step = step;
    }

    /// Centre of mass, world frame (3,), m.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.position)
    }

    #[setter]
    fn set_position(&mut self, position: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.position = arrays::vector(position, "position")?;
        Ok(())
    }

    /// Unit quaternion x, y, z, w from the body to the world (4,); what is set is made a unit.
    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.orientation)
    }

    #[setter]
    fn set_orientation(&mut self, orientation: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.orientation =
            arrays::unit(arrays::vector(orientation, "orientation")?, "orientation")?;
        Ok(())
    }

    /// Velocity of the centre of mass, body frame (3,), m/s.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.velocity)
    }

    #[setter]
    fn set_velocity(&mut self, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.velocity = arrays::vector(velocity, "velocity")?;
        Ok(())
    }

    /// Angular velocity, body frame (3,), rad/s.
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.angular_velocity)
    }

    #[setter]
    fn set_angular_velocity(&mut self, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.angular_velocity = arrays::vector(velocity, "angular_velocity")?;
        Ok(())
    }

    /// Velocity of the centre of mass, world frame (3,), m/s.
    #[getter]
    fn world_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.world_velocity())
    }

    #[setter]
    fn set_world_velocity(&mut self, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        let spin = self.0.world_angular_velocity();
        let velocity = arrays::vector(velocity, "world_velocity")?;
        let kept = self.0.angular_velocity;
        self.0.set_world_velocities(velocity, spin);
        self.0.angular_velocity = kept;
        Ok(())
    }

    /// Angular velocity, world frame (3,), rad/s.
    #[getter]
    fn world_angular_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.world_angular_velocity())
    }

    #[setter]
    fn set_world_angular_velocity(&mut self, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        let kept = self.0.velocity;
        let spin = arrays::vector(velocity, "world_angular_velocity")?;
        self.0.set_world_velocities(kept, spin);
        self.0.velocity = kept;
        Ok(())
    }

    /// Turbulence that the body sees under the model "separated", world frame (6,): velocity and rotation rate of the
    /// fluid, in units of their standard deviations.
    #[getter]
    fn fluctuation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.fluctuation)
    }

    #[setter]
    fn set_fluctuation(&mut self, fluctuation: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.fluctuation = arrays::vector(fluctuation, "fluctuation")?;
        Ok(())
    }

    /// Rotation matrix from the body to the world (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let matrix = langevin_rigid::linalg::rotation_matrix(self.0.orientation);
        arrays::of_rows(py, &matrix)
    }

    /// The same motion told from a centre of mass that lies by `offset` (3,), m, body frame, from this one.
    fn recentred(&self, offset: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(self.0.recentred(arrays::vector(offset, "offset")?)))
    }

    /// Another one that is the same.
    fn copy(&self) -> Self {
        Self(self.0)
    }

    fn __copy__(&self) -> Self {
        self.copy()
    }

    fn __repr__(&self) -> String {
        let RunTimeState {
            time,
            step,
            position,
            orientation,
            velocity,
            angular_velocity,
            ..
        } = self.0;
        format!(
            "State(position={position:?}, orientation={orientation:?}, velocity={velocity:?}, angular_velocity={angular_velocity:?}, time={time:?}, step={step})"
        )
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let state = slf.borrow().0;
        let parts = (
            (state.time, state.step),
            (state.position, state.orientation),
            (state.velocity, state.angular_velocity),
            state.fluctuation,
        );
        let unpickle = py
            .import("langevin_rigid._native")?
            .getattr("_state_of_parts")?;
        Ok((unpickle, parts.into_pyobject(py)?))
    }
}

/// Unpickles a state.
#[pyfunction]
pub(crate) fn _state_of_parts(
    clock: (f64, u64),
    pose: ([f64; 3], [f64; 4]),
    motion: ([f64; 3], [f64; 3]),
    fluctuation: [f64; 6],
) -> State {
    let (time, step) = clock;
    let (position, orientation) = pose;
    let (velocity, angular_velocity) = motion;
    State(RunTimeState {
        time,
        step,
        position,
        orientation,
        velocity,
        angular_velocity,
        fluctuation,
    })
}

/// States one after the other, or of many bodies, as arrays with a row each. The frames are those of `State`.
#[pyclass(frozen, module = "langevin_rigid", sequence)]
pub(crate) struct States(pub(crate) Vec<RunTimeState>);

impl States {
    /// What `of` gives of each.
    fn rows<'py, const N: usize>(
        &self,
        py: Python<'py>,
        of: impl Fn(&RunTimeState) -> [f64; N],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<[f64; N]> = self.0.iter().map(of).collect();
        arrays::of_rows(py, &rows)
    }
}

#[pymethods]
impl States {
    /// Times since release (n,), s.
    #[getter]
    pub(crate) fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_column(py, self.0.iter().map(|state| state.time).collect())
    }

    /// Steps since release (n,).
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        arrays::of_column(py, self.0.iter().map(|state| state.step).collect())
    }

    /// Centres of mass, world frame (n, 3), m.
    #[getter]
    pub(crate) fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, |state| state.position)
    }

    /// Unit quaternions x, y, z, w from the body to the world (n, 4).
    #[getter]
    pub(crate) fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, |state| state.orientation)
    }

    /// Velocities, body frame (n, 3), m/s.
    #[getter]
    pub(crate) fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, |state| state.velocity)
    }

    /// Angular velocities, body frame (n, 3), rad/s.
    #[getter]
    pub(crate) fn angular_velocities<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, |state| state.angular_velocity)
    }

    /// Velocities, world frame (n, 3), m/s.
    #[getter]
    pub(crate) fn world_velocities<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, RunTimeState::world_velocity)
    }

    /// Angular velocities, world frame (n, 3), rad/s.
    #[getter]
    pub(crate) fn world_angular_velocities<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, RunTimeState::world_angular_velocity)
    }

    /// Turbulence that the bodies see (n, 6): see `State.fluctuation`.
    #[getter]
    fn fluctuations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, |state| state.fluctuation)
    }

    /// A pandas.DataFrame of one row a state: t, x, y, z, qx, qy, qz, qw, and the velocities vx, vy, vz and wx, wy, wz in
    /// the world frame. Needs pandas.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = PyDict::new(py);
        let of_numbers = |state: &RunTimeState| -> [f64; 14] {
            let mut row = [state.time; 14];
            row[1..4].copy_from_slice(&state.position);
            row[4..8].copy_from_slice(&state.orientation);
            row[8..11].copy_from_slice(&state.world_velocity());
            row[11..].copy_from_slice(&state.world_angular_velocity());
            row
        };
        let names = [
            "t", "x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz", "wx", "wy", "wz",
        ];
        for (k, name) in names.iter().enumerate() {
            let column = self.0.iter().map(|state| of_numbers(state)[k]).collect();
            columns.set_item(name, arrays::of_column::<f64>(py, column))?;
        }
        py.import("pandas")?.call_method1("DataFrame", (columns,))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<State> {
        let count = self.0.len() as isize;
        let place = if index < 0 { index + count } else { index };
        let state = usize::try_from(place)
            .ok()
            .and_then(|place| self.0.get(place));
        state.map(|state| State(*state)).ok_or_else(|| {
            pyo3::exceptions::PyIndexError::new_err(format!("there is no state {index} of {count}"))
        })
    }

    fn __repr__(&self) -> String {
        match (self.0.first(), self.0.last()) {
            (Some(first), Some(last)) => format!(
                "<States: {} from {:.4} s to {:.4} s>",
                self.0.len(),
                first.time,
                last.time
            ),
            _ => "<States: none>".into(),
        }
    }
}
