//! Wind: fields of velocity that add up.

use std::path::PathBuf;
use std::sync::Arc;

use langevin_rigid::Flow as RunTimeFlow;
use langevin_rigid::wind::{
    GustSettings, Gusts, Jet, Profile, Region, Shear, Table, Vortex, Wind as RunTimeWind, WindField,
};
use langevin_rigid_formats::wind_table::read_wind_table;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arrays;
use crate::errors::{OrRaise, SetupError};

/// A wind: the sum of any number of fields, which vary in space and time. World frame, metres, seconds; it does not change.
///
/// Winds are made by name and added with `+`; `Wind()` is none.
///
/// >>> breeze = Wind.shear(velocity=[3, 0, 0], height=10.0, roughness=0.03)
/// >>> gusty = breeze + Wind.gusts(rms=0.6, length=5.0, carried=[3, 0, 0], seed=4)
/// >>> gusty.at([0, 2, 0], 1.5).shape
/// (3,)
#[pyclass(frozen, module = "langevin_rigid")]
#[derive(Default)]
pub(crate) struct Wind {
    fields: Vec<(WindField, Option<Region>)>,
    pub(crate) wind: Arc<RunTimeWind>,
}

impl Wind {
    fn of(fields: Vec<(WindField, Option<Region>)>) -> PyResult<Self> {
        let mut wind = RunTimeWind::default();
        for (field, region) in fields.iter().cloned() {
            match region {
                Some(region) => wind.add_within(field, region),
                None => wind.add(field),
            }
            .or_raise()?;
        }
        Ok(Self {
            fields,
            wind: Arc::new(wind),
        })
    }

    fn one(field: impl Into<WindField>) -> PyResult<Self> {
        Self::of(vec![(field.into(), None)])
    }

    fn within(&self, region: Region) -> PyResult<Self> {
        if self.fields.iter().any(|(_, region)| region.is_some()) {
            return Err(SetupError::new_err(
                "a field of this wind has a region already; give each field its region before they are added",
            ));
        }
        let fields = self.fields.iter().cloned();
        Self::of(fields.map(|(field, _)| (field, Some(region))).collect())
    }
}

#[pymethods]
impl Wind {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// The same velocity everywhere (3,), m/s.
    #[staticmethod]
    fn uniform(velocity: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::one(WindField::Uniform(arrays::vector(velocity, "velocity")?))
    }

    /// Wind that grows with the height above y = `ground` (m) and has `velocity` (3,), m/s, at `height` (m).
    ///
    /// Give the `roughness` (m) of the ground, 0.03 in grass, for ln(1 + height/roughness), or the `exponent` of a power
    /// law, 1/7 over open land.
    #[staticmethod]
    #[pyo3(signature = (*, velocity, height, ground = 0.0, roughness = None, exponent = None))]
    fn shear(
        velocity: &Bound<'_, PyAny>,
        height: f64,
        ground: f64,
        roughness: Option<f64>,
        exponent: Option<f64>,
    ) -> PyResult<Self> {
        let profile = match (roughness, exponent) {
            (Some(roughness), None) => Profile::Log { roughness },
            (None, Some(exponent)) => Profile::Power { exponent },
            _ => {
                return Err(PyTypeError::new_err(
                    "give either the roughness of the ground or the exponent of the power law",
                ));
            }
        };
        Self::one(Shear {
            velocity: arrays::vector(velocity, "velocity")?,
            height,
            ground,
            profile,
        })
    }

    /// Homogeneous isotropic turbulence: root mean square `rms` of each component (m/s), integral length scale `length`
    /// (m), size of the `smallest` eddies (m, a fiftieth of `length` by default), and the mean wind that they are `carried`
    /// by (3,), m/s, which is not part of it. `seed` chooses among all such fields.
    #[staticmethod]
    #[pyo3(signature = (*, rms, length, smallest = None, carried = None, seed = 0))]
    fn gusts(
        rms: f64,
        length: f64,
        smallest: Option<f64>,
        carried: Option<&Bound<'_, PyAny>>,
        seed: u64,
    ) -> PyResult<Self> {
        let settings = GustSettings {
            rms,
            length,
            smallest,
            carried: arrays::vector_or(carried, "carried", [0.0; 3])?,
            seed,
        };
        Self::one(Gusts::new(&settings).or_raise()?)
    }

    /// A line vortex (Lamb-Oseen) through `centre` (3,), m, along `axis`, seen from whose tip it turns counter-clockwise:
    /// `circulation` (m^2/s) and radius of the `core` (m).
    #[staticmethod]
    #[pyo3(signature = (*, centre, axis, circulation, core))]
    fn vortex(
        centre: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        circulation: f64,
        core: f64,
    ) -> PyResult<Self> {
        Self::one(Vortex {
            centre: arrays::vector(centre, "centre")?,
            axis: arrays::vector(axis, "axis")?,
            circulation,
            core,
        })
    }

    /// What a fan at `centre` (3,), m, of this `diameter` (m) blows along `axis`: `speed` (m/s) in the middle of the fan.
    #[staticmethod]
    #[pyo3(signature = (*, centre, axis, speed, diameter))]
    fn jet(
        centre: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        speed: f64,
        diameter: f64,
    ) -> PyResult<Self> {
        Self::one(Jet {
            centre: arrays::vector(centre, "centre")?,
            axis: arrays::vector(axis, "axis")?,
            speed,
            diameter,
        })
    }

    /// Velocities on a grid: (nx, ny, nz, 3), or (times, nx, ny, nz, 3) with `times` (s), m/s. Its first point is `origin`
    /// (3,), m, its points are `spacing` (3,), m, apart. Linear between points and times, outside as on the nearest face.
    #[staticmethod]
    #[pyo3(signature = (*, origin, spacing, velocities, times = None))]
    fn table(
        origin: &Bound<'_, PyAny>,
        spacing: &Bound<'_, PyAny>,
        velocities: &Bound<'_, PyAny>,
        times: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (counts, list) = arrays::grid(velocities, "velocities", times.is_some())?;
        let times = times.map_or_else(|| Ok(vec![0.0]), |times| arrays::column(times, "times"))?;
        let origin = arrays::vector(origin, "origin")?;
        let spacing = arrays::vector(spacing, "spacing")?;
        Self::one(Table::new(origin, spacing, counts, &times, list).or_raise()?)
    }

    /// Such a grid from an NPZ file with `origin`, `spacing`, `velocity` and, if it varies in time, `time`.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        let table = read_wind_table(&path);
        Self::one(table.map_err(|error| SetupError::new_err(error.to_string()))?)
    }

    /// The same within a box: its middle and size (3,), m; it fades out over `edge` (m) inwards.
    #[pyo3(signature = (*, centre, size, edge))]
    fn within_box(
        &self,
        centre: &Bound<'_, PyAny>,
        size: &Bound<'_, PyAny>,
        edge: f64,
    ) -> PyResult<Self> {
        self.within(Region::Box {
            centre: arrays::vector(centre, "centre")?,
            size: arrays::vector(size, "size")?,
            edge,
        })
    }

    /// The same within a ball: its middle (3,) and radius (m); it fades out over `edge` (m) inwards.
    #[pyo3(signature = (*, centre, radius, edge))]
    fn within_sphere(&self, centre: &Bound<'_, PyAny>, radius: f64, edge: f64) -> PyResult<Self> {
        self.within(Region::Sphere {
            centre: arrays::vector(centre, "centre")?,
            radius,
            edge,
        })
    }

    fn __add__(&self, other: &Self) -> PyResult<Self> {
        Self::of(self.fields.iter().chain(&other.fields).cloned().collect())
    }

    /// Velocity at a place (3,), m, and a time (s): (3,), m/s. For places (n, 3) it is (n, 3).
    fn at<'py>(&self, place: &Bound<'py, PyAny>, time: f64) -> PyResult<Bound<'py, PyAny>> {
        let py = place.py();
        let still = [0.0; 3];
        if let Ok(place) = arrays::vector(place, "place") {
            let velocity = self.wind.flow(place, time, still).velocity;
            return Ok(arrays::of_vector(py, &velocity).into_any());
        }
        let places = arrays::rows(place, "place", "n")?;
        arrays::finite("place", &places)?;
        let velocities: Vec<[f64; 3]> = py.detach(|| {
            let each = places.iter();
            each.map(|place| self.wind.flow(*place, time, still).velocity)
                .collect()
        });
        Ok(arrays::of_rows(py, &velocities)?.into_any())
    }

    /// All that a body meets at a place (3,), m, and a time (s), on top of a stream (3,), m/s, which carries the wind along.
    #[pyo3(signature = (place, time, *, stream = None))]
    fn flow(
        &self,
        place: &Bound<'_, PyAny>,
        time: f64,
        stream: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Flow> {
        let stream = arrays::vector_or(stream, "stream", [0.0; 3])?;
        let place = arrays::vector(place, "place")?;
        Ok(Flow(self.wind.flow(place, time, stream)))
    }

    fn __repr__(&self) -> String {
        let name = |(field, region): &(WindField, Option<Region>)| {
            let name = match field {
                WindField::Uniform(_) => "uniform",
                WindField::Shear(_) => "shear",
                WindField::Gusts(_) => "gusts",
                WindField::Vortex(_) => "vortex",
                WindField::Jet(_) => "jet",
                WindField::Table(_) => "table",
                _ => "field",
            };
            match region {
                Some(_) => format!("{name} within a region"),
                None => name.to_owned(),
            }
        };
        let names: Vec<String> = self.fields.iter().map(name).collect();
        match names.is_empty() {
            true => "<Wind: none>".into(),
            false => format!("<Wind: {}>", names.join(" + ")),
        }
    }
}

/// The undisturbed fluid at a body over a step, on top of the stream of the fluid, world frame: velocity (3,), m/s, its
/// `gradient` (3, 3), 1/s, with du_i/dx_j in row i and column j, and the material `acceleration` (3,), m/s^2.
///
/// >>> Flow(velocity=[1, 0, 0])
/// Flow(velocity=[1.0, 0.0, 0.0], gradient=[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], acceleration=[0.0, 0.0, 0.0])
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Flow(pub(crate) RunTimeFlow);

#[pymethods]
impl Flow {
    #[new]
    #[pyo3(signature = (*, velocity = None, gradient = None, acceleration = None))]
    fn new(
        velocity: Option<&Bound<'_, PyAny>>,
        gradient: Option<&Bound<'_, PyAny>>,
        acceleration: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        Ok(Self(RunTimeFlow {
            velocity: arrays::vector_or(velocity, "velocity", [0.0; 3])?,
            gradient: gradient.map_or(Ok([[0.0; 3]; 3]), |g| arrays::matrix(g, "gradient"))?,
            acceleration: arrays::vector_or(acceleration, "acceleration", [0.0; 3])?,
        }))
    }

    /// Velocity at the centre of mass (3,), m/s.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.velocity)
    }

    /// du_i/dx_j in row i and column j (3, 3), 1/s.
    #[getter]
    fn gradient<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.0.gradient)
    }

    /// Material acceleration (3,), m/s^2.
    #[getter]
    fn acceleration<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.0.acceleration)
    }

    fn __repr__(&self) -> String {
        let RunTimeFlow {
            velocity,
            gradient,
            acceleration,
        } = self.0;
        format!("Flow(velocity={velocity:?}, gradient={gradient:?}, acceleration={acceleration:?})")
    }
}
