//! Bodies that can be stepped: of simple form, baked, or from a bake file.

use std::path::PathBuf;
use std::sync::Arc;

use langevin_rigid::{Bake, Body as RunTimeBody, BodyError};
use langevin_rigid_bake::body::BodySpec;
use langevin_rigid_bake::mass_properties::{Ballast, Region};
use langevin_rigid_scenes::baking::bake_mesh;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};

use crate::errors::OrRaise;
use crate::interrupt::interruptible;
use crate::mesh::Mesh;
use crate::turbulence::TurbulenceHistory;
use crate::{arrays, files};

/// A rigid body with all that the run time needs of its shape. It does not change.
///
/// Vectors and matrices are in the body frame: its origin is the centre of mass, its axes are those of the mesh, or of the
/// form. Plates and discs have their thin axis along y, cylinders their axis along x.
///
/// >>> leaf = Body.plate(length=0.08, width=0.05, thickness=2e-4, density=450.0)
/// >>> round(leaf.mass * 1e3, 6)
/// 0.36
/// >>> leaf.added_mass.shape
/// (6, 6)
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Body {
    pub(crate) bake: Arc<Bake>,
}

impl Body {
    fn simple(body: Result<RunTimeBody, BodyError>) -> PyResult<Self> {
        let body = body.or_raise()?;
        Ok(Self::of(Bake {
            body,
            history: None,
            // Nothing was computed that could estimate it, and no bake has none.
            error_estimate: 0.0,
            warnings: Vec::new(),
            fingerprint: [0; 32],
        }))
    }

    pub(crate) fn of(bake: Bake) -> Self {
        Self {
            bake: Arc::new(bake),
        }
    }

    pub(crate) fn body(&self) -> &RunTimeBody {
        &self.bake.body
    }

    /// The same bake of another body, which is no longer what its fingerprint says.
    fn with(&self, body: RunTimeBody) -> Self {
        Self::of(Bake {
            body,
            fingerprint: [0; 32],
            ..(*self.bake).clone()
        })
    }
}

/// From, to and density.
type GivenRegion<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, f64);
/// Mass, position and radius.
type GivenBallast<'py> = (f64, Bound<'py, PyAny>, f64);

#[pymethods]
impl Body {
    /// A homogeneous sphere: radius (m), density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, radius, density))]
    fn sphere(radius: f64, density: f64) -> PyResult<Self> {
        Self::simple(RunTimeBody::sphere(radius, density))
    }

    /// A homogeneous ellipsoid: semi-axes along x, y, z (3,), m; density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, semi_axes, density))]
    fn ellipsoid(semi_axes: &Bound<'_, PyAny>, density: f64) -> PyResult<Self> {
        let semi_axes = arrays::vector(semi_axes, "semi_axes")?;
        Self::simple(RunTimeBody::ellipsoid(semi_axes, density))
    }

    /// A homogeneous disc, its axis along y: radius and thickness (m), density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, radius, thickness, density))]
    fn disc(radius: f64, thickness: f64, density: f64) -> PyResult<Self> {
        Self::simple(RunTimeBody::disc(radius, thickness, density))
    }

    /// A homogeneous flat plate: length along x, width along z, thickness along y (m); density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, length, width, thickness, density))]
    fn plate(length: f64, width: f64, thickness: f64, density: f64) -> PyResult<Self> {
        Self::simple(RunTimeBody::plate(length, width, thickness, density))
    }

    /// A homogeneous circular cylinder, its axis along x: radius and length (m), density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, radius, length, density))]
    fn cylinder(radius: f64, length: f64, density: f64) -> PyResult<Self> {
        Self::simple(RunTimeBody::cylinder(radius, length, density))
    }

    /// A homogeneous box: edges along x, y, z (3,), m; density (kg/m^3).
    #[staticmethod]
    #[pyo3(signature = (*, size, density))]
    fn cuboid(size: &Bound<'_, PyAny>, density: f64) -> PyResult<Self> {
        let size = arrays::vector(size, "size")?;
        Self::simple(RunTimeBody::cuboid(size, density))
    }

    /// The body of a closed mesh: a Mesh, a path in metres, or anything with `vertices` and `faces`.
    ///
    /// Give its `density` (kg/m^3) or its `mass` (kg). `regions` are boxes of another density, each (from, to, density) in
    /// the frame of the mesh; `ballast` adds masses, each (mass, position, radius). `centre_of_mass` (m, frame of the mesh)
    /// and `inertia` (kg m^2, about it) replace those of the solid, but not beside regions or ballast. `thickness` and
    /// `length` (m) are those of Eq. (1) of the paper. It takes as long as `added_mass`.
    ///
    /// >>> coin = Mesh.shape("coin", diameter=0.022, thickness=1.6e-3, hole=0.005, triangles=300)
    /// >>> body = Body.bake(coin, mass=5e-3)
    /// >>> body.mass, body.error_estimate < 0.01
    /// (0.005, True)
    #[staticmethod]
    #[pyo3(signature = (
        mesh, *, density = None, mass = None, regions = None, ballast = None, centre_of_mass = None, inertia = None,
        thickness = None, length = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn bake(
        mesh: &Bound<'_, PyAny>,
        density: Option<f64>,
        mass: Option<f64>,
        regions: Option<Vec<GivenRegion<'_>>>,
        ballast: Option<Vec<GivenBallast<'_>>>,
        centre_of_mass: Option<&Bound<'_, PyAny>>,
        inertia: Option<&Bound<'_, PyAny>>,
        thickness: Option<f64>,
        length: Option<f64>,
    ) -> PyResult<Self> {
        let py = mesh.py();
        let region = |(from, to, density): &GivenRegion<'_>| {
            Ok::<_, PyErr>(Region {
                from: arrays::vector(from, "from of a region")?,
                to: arrays::vector(to, "to of a region")?,
                density: *density,
            })
        };
        let weight = |(mass, position, radius): &GivenBallast<'_>| {
            Ok::<_, PyErr>(Ballast {
                mass: *mass,
                position: arrays::vector(position, "position of ballast")?,
                radius: *radius,
            })
        };
        let spec = BodySpec {
            density,
            mass,
            regions: regions
                .iter()
                .flatten()
                .map(region)
                .collect::<PyResult<_>>()?,
            ballast: ballast
                .iter()
                .flatten()
                .map(weight)
                .collect::<PyResult<_>>()?,
            centre_of_mass: centre_of_mass
                .map(|centre| arrays::vector(centre, "centre_of_mass"))
                .transpose()?,
            inertia: inertia
                .map(|inertia| arrays::matrix(inertia, "inertia"))
                .transpose()?,
            thickness,
            length,
        };
        let mesh = Mesh::of_argument(mesh)?;
        let solid = mesh.get().body(py)?;
        let bake = interruptible(py, |wanted| bake_mesh(&solid, &spec, wanted))?;
        Ok(Self::of(bake.or_raise()?))
    }

    /// The body of a bake file, such as the command's `bake` writes.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let bytes = files::read(py, &path)?;
        Self::from_bytes(&bytes)
    }

    /// The body of the bytes of a bake file.
    #[staticmethod]
    fn from_bytes(data: &[u8]) -> PyResult<Self> {
        Ok(Self::of(Bake::from_bytes(data).or_raise()?))
    }

    /// Writes a bake file, which every program with the run time reads; whole or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        files::write(py, &path, &self.bake.to_bytes())
    }

    /// The bytes of a bake file.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.bake.to_bytes())
    }

    /// Mass (kg).
    #[getter]
    fn mass(&self) -> f64 {
        self.body().mass
    }

    /// Mean density (kg/m^3).
    #[getter]
    fn density(&self) -> f64 {
        self.body().density()
    }

    /// Volume of the fluid displaced (m^3).
    #[getter]
    fn volume(&self) -> f64 {
        self.body().volume
    }

    /// Inertia about the centre of mass (3, 3), kg m^2.
    #[getter]
    fn inertia<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.body().inertia)
    }

    /// Added mass per unit density of the fluid, about the centre of mass (6, 6): m^3, m^4, m^5; translations first.
    #[getter]
    fn added_mass<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.body().added_mass)
    }

    /// Mass of body and fluid of this density (kg/m^3) together, diag(m, J) + density A (6, 6): kg, kg m, kg m^2.
    fn total_mass<'py>(
        &self,
        py: Python<'py>,
        fluid_density: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.body().total_mass(fluid_density))
    }

    /// Centroid of the volume from the centre of mass (3,), m.
    #[getter]
    fn centre_of_buoyancy<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.body().centre_of_buoyancy)
    }

    /// Half the extents along the principal axes of the volume, descending (3,), m.
    #[getter]
    fn half_extents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::of_vector(py, &self.body().half_extents)
    }

    /// Characteristic thickness b of Eq. (1) (m).
    #[getter]
    fn thickness(&self) -> f64 {
        self.body().thickness
    }

    /// Characteristic length d of Eq. (1) (m).
    #[getter]
    fn length(&self) -> f64 {
        self.body().length
    }

    /// Drag areas P (3, 3), m^2: a motion at v is resisted by 1/2 rho (v.P v) along P v.
    #[getter]
    fn drag_area<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.body().separation.drag_area)
    }

    /// The surface from the centre of mass, to draw it.
    #[getter]
    fn surface(&self) -> Mesh {
        let surface = &self.body().surface;
        let used = surface.triangles.as_flattened().iter().max();
        let count = used.map_or(0, |last| *last as usize + 1);
        let raw = langevin_rigid_formats::mesh::RawMesh {
            vertices: surface.vertices[..count].to_vec(),
            triangles: surface.triangles.clone(),
            ..Default::default()
        };
        Mesh::of_raw(raw, "surface".into())
    }

    /// Estimated relative error of the added mass; None for a body of simple form.
    #[getter]
    fn error_estimate(&self) -> Option<f64> {
        Some(self.bake.error_estimate).filter(|error| *error > 0.0)
    }

    /// What makes the bake doubtful, a sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.bake.warnings.clone()
    }

    /// The turbulence that was precomputed for it, if there is any.
    #[getter]
    fn history(&self) -> Option<TurbulenceHistory> {
        self.bake.history.clone().map(TurbulenceHistory)
    }

    /// The same body with a precomputed turbulence, for the sources that sample it.
    fn with_history(&self, history: &TurbulenceHistory) -> Self {
        Self::of(Bake {
            history: Some(history.0.clone()),
            ..(*self.bake).clone()
        })
    }

    /// The same hull with other contents.
    ///
    /// `centre_of_mass` is from the present one (3,), m; `inertia` about the new one (3, 3), kg m^2. What is left out stays
    /// as it is. A body that is under way takes `State.recentred`.
    ///
    /// >>> ball = Body.sphere(radius=0.062, density=500.0)
    /// >>> ball.with_mass_properties(mass=0.9, centre_of_mass=[0, -0.02, 0]).centre_of_buoyancy.tolist()
    /// [0.0, 0.02, 0.0]
    #[pyo3(signature = (*, mass = None, centre_of_mass = None, inertia = None))]
    fn with_mass_properties(
        &self,
        mass: Option<f64>,
        centre_of_mass: Option<&Bound<'_, PyAny>>,
        inertia: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let body = self.body();
        let inertia = match inertia {
            Some(inertia) => arrays::matrix(inertia, "inertia")?,
            None => body.inertia,
        };
        let centre = arrays::vector_or(centre_of_mass, "centre_of_mass", [0.0; 3])?;
        let other = body.with_mass_properties(mass.unwrap_or(body.mass), centre, inertia);
        Ok(self.with(other.or_raise()?))
    }

    /// The same body so many times as large, of the same density.
    fn scaled(&self, factor: f64) -> PyResult<Self> {
        let body = self.body().scaled(factor);
        body.check().or_raise()?;
        Ok(self.with(body))
    }

    fn __repr__(&self) -> String {
        let RunTimeBody {
            mass,
            volume,
            half_extents: [a, b, c],
            ..
        } = self.body();
        format!("<Body: {mass:.4e} kg, {volume:.4e} m^3, half-extents {a:.4e}, {b:.4e}, {c:.4e} m>")
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.bake.to_bytes() == other.bake.to_bytes()
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let unpickle = slf.get_type().getattr("from_bytes")?;
        Ok((unpickle, (slf.get().to_bytes(py),).into_pyobject(py)?))
    }
}

/// Takes named numbers out of a mapping, and refuses the names that are left.
pub(crate) fn take_numbers(
    given: &Bound<'_, PyDict>,
    what: &str,
    numbers: &mut [(&str, &mut f64)],
) -> PyResult<()> {
    for (key, value) in given {
        let key: String = key.extract()?;
        let Some((_, number)) = numbers.iter_mut().find(|(name, _)| *name == key) else {
            let known: Vec<&str> = numbers.iter().map(|(name, _)| *name).collect();
            return Err(PyTypeError::new_err(format!(
                "{what} has no `{key}`; it has {}",
                known.join(", ")
            )));
        };
        **number = value.extract()?;
    }
    Ok(())
}
