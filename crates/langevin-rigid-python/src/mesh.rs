//! Triangle meshes: as they come, and as bodies.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use langevin_rigid_bake::mass_properties::MassProperties;
use langevin_rigid_bake::{MeshError as NoBody, TriMesh};
use langevin_rigid_formats::mesh::{
    LengthUnit, MeshFormat, ParseError, RawMesh, ReadError, parse_mesh, read_mesh, write_obj,
    write_stl,
};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::errors::{BakeError, MeshError, OrRaise};
use crate::warnings::warn;
use crate::{arrays, files, shapes, threads};

/// Triangles over vertices, as they come: a closed body or something that is none yet.
///
/// `vertices` (n, 3) are positions in metres, `triangles` (m, 3) numbers of vertices from 0, counter-clockwise seen from
/// outside, of any integer type. `check` tells what is wrong with it, `repair` mends it; what needs a body says what hinders.
///
/// >>> import numpy as np
/// >>> corners = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]])
/// >>> tetrahedron = Mesh(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
/// >>> round(tetrahedron.volume * 6, 12)
/// 0.001
/// >>> Mesh(corners, [[0, 2, 1], [0, 1, 3]]).is_body
/// False
#[pyclass(frozen, module = "langevin_rigid")]
pub(crate) struct Mesh {
    pub(crate) raw: RawMesh,
    pub(crate) name: String,
    /// What it was generated from, if it was.
    recipe: Option<Recipe>,
    body: OnceLock<Result<Arc<TriMesh>, NoBody>>,
}

/// A shape by name, its dimensions, and how many triangles were wished for.
struct Recipe {
    shape: String,
    triangles: usize,
    dimensions: Py<PyDict>,
}

impl Mesh {
    pub(crate) fn of_raw(raw: RawMesh, name: String) -> Self {
        Self {
            raw,
            name,
            recipe: None,
            body: OnceLock::new(),
        }
    }

    pub(crate) fn of_body(body: TriMesh, name: String) -> Self {
        let raw = RawMesh {
            vertices: body.vertices().to_vec(),
            triangles: body.triangles().to_vec(),
            ..RawMesh::default()
        };
        Self {
            body: OnceLock::from(Ok(Arc::new(body))),
            ..Self::of_raw(raw, name)
        }
    }

    /// The body that the triangles enclose.
    pub(crate) fn body(&self, py: Python<'_>) -> PyResult<Arc<TriMesh>> {
        self.found(py)?
            .clone()
            .map_err(|fault| MeshError::new_err(format!("{}: {fault}", self.name)))
    }

    fn found(&self, py: Python<'_>) -> PyResult<&Result<Arc<TriMesh>, NoBody>> {
        let pool = threads::pool()?;
        let raw = &self.raw;
        let find = || pool.install(|| raw.clone().body().map(Arc::new));
        Ok(py.detach(|| self.body.get_or_init(find)))
    }

    /// The mesh of an argument that may also be a path, in metres where its format has no unit. What the reader of a path
    /// passed over is warned of, as the caller does not see that mesh.
    pub(crate) fn of_argument<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Mesh>> {
        if let Ok(mesh) = given.cast::<Mesh>() {
            return Ok(mesh.clone());
        }
        let py = given.py();
        let mesh = match given.extract::<PathBuf>() {
            Ok(path) => Mesh::read(py, path, None)?,
            Err(_) => Mesh::of(given)?,
        };
        for notice in &mesh.raw.notices {
            warn(py, &format!("{}: {notice}", mesh.name))?;
        }
        Bound::new(py, mesh)
    }

    fn bounds_of(&self) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in self.raw.triangles.as_flattened() {
            let place = self.raw.vertices[*corner as usize];
            for k in 0..3 {
                bounds[0][k] = bounds[0][k].min(place[k]);
                bounds[1][k] = bounds[1][k].max(place[k]);
            }
        }
        match self.raw.triangles.is_empty() {
            true => [[0.0; 3]; 2],
            false => bounds,
        }
    }
}

#[pymethods]
impl Mesh {
    #[new]
    #[pyo3(signature = (vertices, triangles, *, name = "mesh"))]
    fn new(
        vertices: &Bound<'_, PyAny>,
        triangles: &Bound<'_, PyAny>,
        name: &str,
    ) -> PyResult<Self> {
        let vertices = arrays::rows(vertices, "vertices", "n")?;
        if let Some(words) = arrays::not_finite("vertices", &vertices) {
            return Err(MeshError::new_err(words));
        }
        let raw = RawMesh {
            triangles: numbered(&arrays::triples(triangles, "triangles")?, vertices.len())?,
            vertices,
            ..RawMesh::default()
        };
        Ok(Self::of_raw(raw, name.to_owned()))
    }

    /// The triangles of an OBJ, STL, PLY, glTF, GLB or Collada file.
    ///
    /// `unit` is that of its lengths: "m", "cm", "mm", "um", "in" or "ft"; by default that of the format or of the file,
    /// and metres where neither has one. What the reader passed over is in `notices`.
    #[staticmethod]
    #[pyo3(signature = (path, *, unit = None))]
    fn read(py: Python<'_>, path: PathBuf, unit: Option<&str>) -> PyResult<Self> {
        let unit = unit.map(str::parse::<LengthUnit>).transpose().or_raise()?;
        let raw = threads::shared(py, || match read_mesh(&path, unit) {
            Err(ReadError::Parse {
                error: ParseError::NoUnit,
                ..
            }) => read_mesh(&path, Some(LengthUnit::M)),
            read => read,
        })?;
        Ok(Self::of_raw(raw.or_raise()?, files::name_of(&path)))
    }

    /// The mesh of anything with `vertices` and `faces`, such as a `trimesh.Trimesh`, in metres.
    #[staticmethod]
    fn of(mesh: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(mesh) = mesh.cast::<Mesh>() {
            let mesh = mesh.get();
            return Ok(Self::of_raw(mesh.raw.clone(), mesh.name.clone()));
        }
        let part = |name: &str| {
            mesh.getattr(name).map_err(|_| {
                pyo3::exceptions::PyTypeError::new_err(format!(
                    "a mesh is wanted, which is a langevin_rigid.Mesh or has `vertices` and `faces`; `{}` has no `{name}`",
                    mesh.get_type()
                ))
            })
        };
        Self::new(&part("vertices")?, &part("faces")?, "mesh")
    }

    /// A parametric body by the name that scenes give it, with about so many triangles; dimensions in metres.
    ///
    /// Names and dimensions: "ellipsoid" (semi_axes), "elliptical-plate" (semi_axes, thickness), "disc" (radius, thickness),
    /// "coin" (diameter, thickness, hole), "washer" (diameter, inner_diameter, thickness), "box" (size), "cylinder" (radius,
    /// height), "paper-airplane" (side, thickness), "leaf", "feather" and "samara" (length, width, thickness).
    ///
    /// >>> Mesh.shape("disc", radius=0.05, thickness=0.001, triangles=600)
    /// <Mesh disc: 592 triangles over 298 vertices, 0.1003 x 0.0010 x 0.1003 m>
    #[staticmethod]
    #[pyo3(signature = (shape, *, triangles = 1000, **dimensions))]
    fn shape(
        py: Python<'_>,
        shape: &str,
        triangles: usize,
        dimensions: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let dimensions = dimensions.map_or_else(|| Ok(PyDict::new(py)), PyDictMethods::copy)?;
        let named = shapes::named(shape, &dimensions)?;
        let body = threads::shared(py, || named.mesh(triangles))?.or_raise()?;
        Ok(Self {
            recipe: Some(Recipe {
                shape: shape.to_owned(),
                triangles,
                dimensions: dimensions.unbind(),
            }),
            ..Self::of_body(body, shape.to_owned())
        })
    }

    /// Positions of the vertices (n, 3), m.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.raw.vertices)
    }

    /// Numbers of the vertices of each triangle (m, 3).
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        arrays::of_rows(py, &self.raw.triangles)
    }

    /// The same, as trimesh calls them.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        self.triangles(py)
    }

    /// What messages and files call it.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// What the reader of its file passed over or took for something else, a sentence each.
    #[getter]
    fn notices(&self) -> Vec<String> {
        self.raw.notices.clone()
    }

    /// Whether it is a closed body that can be baked.
    #[getter]
    fn is_body(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.found(py)?.is_ok())
    }

    /// Why it is no body, at first sight; None for a body.
    #[getter]
    fn fault(&self, py: Python<'_>) -> PyResult<Option<String>> {
        Ok(self.found(py)?.as_ref().err().map(ToString::to_string))
    }

    /// Volume of the fluid displaced (m^3), that of sealed cavities included.
    ///
    /// MeshError if it is no body.
    #[getter]
    fn volume(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.body(py)?.volume())
    }

    /// Centroid of that volume (3,), m.
    ///
    /// MeshError if it is no body.
    #[getter]
    fn centroid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let properties = MassProperties::of(&*self.body(py)?, 1.0)
            .map_err(|error| BakeError::new_err(error.to_string()))?;
        Ok(arrays::of_vector(py, &properties.centroid))
    }

    /// Area of all triangles (m^2).
    #[getter]
    fn area(&self) -> f64 {
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| self.raw.vertices[corner as usize]);
            let side = |to: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| to[k] - a[k]) };
            let ([u, v, w], [x, y, z]) = (side(b), side(c));
            let normal = [v * z - w * y, w * x - u * z, u * y - v * x];
            0.5 * normal.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        self.raw.triangles.iter().map(area).sum()
    }

    /// Lowest and highest corner of the box around all triangles (2, 3), m.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::of_rows(py, &self.bounds_of())
    }

    /// The body made of this open sheet, `thickness` (m) thick, half to either side.
    fn sheet(&self, py: Python<'_>, thickness: f64) -> PyResult<Self> {
        let raw = self.raw.clone();
        let body = threads::shared(py, || raw.sheet(thickness))?.or_raise()?;
        Ok(Self::of_body(body, self.name.clone()))
    }

    /// The body with about so many triangles and the same volume.
    fn simplified(&self, py: Python<'_>, triangles: usize) -> PyResult<Self> {
        let body = self.body(py)?;
        let simplified = threads::shared(py, || body.proxy(triangles))?.or_raise()?;
        Ok(Self::of_body(simplified, self.name.clone()))
    }

    /// Writes the body to an .obj or .stl file, in metres, whole or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let body = self.body(py)?;
        let mut bytes = Vec::new();
        let format = MeshFormat::of_extension(&path);
        let written = match format {
            Some(MeshFormat::Obj) => write_obj(&body, &mut bytes),
            Some(MeshFormat::Stl) => write_stl(&body, &mut bytes),
            _ => {
                return Err(MeshError::new_err(format!(
                    "cannot write `{}`: the file must end in .obj or .stl",
                    path.display()
                )));
            }
        };
        written?;
        // STL rounds to single precision, which may make two vertices one.
        if format == Some(MeshFormat::Stl) {
            let again = || {
                let raw = parse_mesh(&bytes, MeshFormat::Stl, Some(LengthUnit::M), None);
                let raw = raw.map_err(|error| error.to_string())?;
                raw.body().map_err(|error| error.to_string())
            };
            threads::shared(py, again)?.map_err(|error| {
                MeshError::new_err(format!(
                    "written as STL, which rounds to single precision, it would be no body ({error}); write .obj (nothing was written)"
                ))
            })?;
        }
        files::write(py, &path, &bytes)
    }

    fn __repr__(&self) -> String {
        let [low, high] = self.bounds_of();
        let size: [f64; 3] = std::array::from_fn(|k| high[k] - low[k]);
        format!(
            "<Mesh {}: {} triangles over {} vertices, {:.4} x {:.4} x {:.4} m>",
            self.name,
            self.raw.triangles.len(),
            self.raw.vertices.len(),
            size[0],
            size[1],
            size[2]
        )
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.raw.vertices == other.raw.vertices && self.raw.triangles == other.raw.triangles
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, mesh) = (slf.py(), slf.get());
        let module = py.import("langevin_rigid._native")?;
        Ok(match &mesh.recipe {
            Some(recipe) => {
                let dimensions = recipe.dimensions.bind(py);
                let parts = (&recipe.shape, recipe.triangles, dimensions).into_pyobject(py)?;
                (module.getattr("_mesh_of_shape")?, parts)
            }
            None => {
                let parts = (mesh.vertices(py)?, mesh.triangles(py)?, &mesh.name);
                let parts = (parts.0, parts.1, parts.2, mesh.notices()).into_pyobject(py)?;
                (module.getattr("_mesh_of_parts")?, parts)
            }
        })
    }
}

/// Unpickles a mesh that was generated: it is smooth where only a shape can be.
#[pyfunction]
pub(crate) fn _mesh_of_shape(
    py: Python<'_>,
    shape: &str,
    triangles: usize,
    dimensions: &Bound<'_, PyDict>,
) -> PyResult<Mesh> {
    Mesh::shape(py, shape, triangles, Some(dimensions))
}

/// Unpickles any other mesh.
#[pyfunction]
pub(crate) fn _mesh_of_parts(
    vertices: &Bound<'_, PyAny>,
    triangles: &Bound<'_, PyAny>,
    name: &str,
    notices: Vec<String>,
) -> PyResult<Mesh> {
    let mut mesh = Mesh::new(vertices, triangles, name)?;
    mesh.raw.notices = notices;
    Ok(mesh)
}

/// The numbers of vertices, all of which must exist.
fn numbered(triangles: &[[i64; 3]], vertices: usize) -> PyResult<Vec<[u32; 3]>> {
    let number = |corner: i64| {
        u32::try_from(corner)
            .ok()
            .filter(|corner| (*corner as usize) < vertices)
    };
    let each = triangles.iter().enumerate().map(|(row, triangle)| {
        let corners = triangle.map(number);
        match corners {
            [Some(a), Some(b), Some(c)] => Ok([a, b, c]),
            _ => Err(MeshError::new_err(format!(
                "row {row} of triangles is {triangle:?}; its numbers must be those of the {vertices} vertices, counted from 0"
            ))),
        }
    });
    each.collect()
}
