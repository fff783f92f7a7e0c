//! Triangle meshes from files: OBJ, STL, PLY, glTF, GLB and Collada.
//!
//! [`read_mesh`] gives the triangles as they are in the file, in metres; [`RawMesh::body`] and
//! [`RawMesh::sheet`] make a checked body of them. Polygons of any shape become triangles. Vertices that
//! a format stores once per facet or seam are welded where their positions are equal to the last
//! bit: always for STL and glTF, for OBJ, PLY and Collada where the surface is open otherwise; where it is open
//! still, within a millionth of its size if that closes edges. What a reader tolerated it says in
//! [`RawMesh::notices`].
//!
//! The readers take nothing in a file at its word: a damaged or hostile file gives a
//! [`ParseError`], never a panic, and no more memory than the file's own length calls for.

#[cfg_attr(not(feature = "collada"), path = "mesh/without_collada.rs")]
mod collada;
mod error;
mod foreign;
pub(crate) mod gltf;
mod obj;
mod ply;
mod polygon;
mod proportion;
mod stl;
mod text;
mod transform;
mod unit;

use std::path::Path;

use langevin_rigid_bake::mesh::{MeshError, TriMesh, close_seams, open_edge_count, weld};

use crate::files;
use foreign::Foreign;

pub use error::{ParseError, Place, ReadError};
pub use obj::write_obj;
pub use stl::write_stl;
pub use unit::{FileUnit, LengthUnit};

/// Triangles as read from a file, unchecked; positions in metres.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawMesh {
    /// Vertex positions (m).
    pub vertices: Vec<[f64; 3]>,
    /// Vertex numbers of each triangle, all below the number of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// What the reader passed over or took for something else, a sentence each, each kind once a file.
    pub notices: Vec<String>,
    /// What the file's lengths were taken to be in.
    pub unit: FileUnit,
}

impl RawMesh {
    /// The closed body these triangles enclose.
    ///
    /// # Errors
    ///
    /// Whatever [`TriMesh::new`] finds wrong.
    pub fn body(self) -> Result<TriMesh, MeshError> {
        TriMesh::new(self.vertices, self.triangles)
    }

    /// The body made of this open sheet at the given thickness (m).
    ///
    /// # Errors
    ///
    /// Whatever [`TriMesh::from_sheet`] finds wrong.
    pub fn sheet(self, thickness: f64) -> Result<TriMesh, MeshError> {
        TriMesh::from_sheet(self.vertices, self.triangles, thickness)
    }

    fn welded(self) -> RawMesh {
        let (vertices, triangles) = weld(&self.vertices, &self.triangles);
        RawMesh {
            vertices,
            triangles,
            ..self
        }
    }

    /// Welded, unless the vertex numbers of the file close the surface already.
    fn welded_if_open(self) -> RawMesh {
        if open_edge_count(&self.triangles) == 0 {
            self
        } else {
            self.welded()
        }
    }

    /// With the seams closed that rounding left open.
    fn seamless(self) -> RawMesh {
        if open_edge_count(&self.triangles) == 0 {
            return self;
        }
        let Some(closed) = close_seams(&self.vertices, &self.triangles) else {
            return self;
        };
        let mut mesh = RawMesh {
            vertices: closed.vertices,
            triangles: closed.triangles,
            notices: self.notices,
            unit: self.unit,
        };
        let distance = mesh.unit.to_metres(closed.distance);
        mesh.note(format!(
            "welded {} vertices within {distance:.1e} m of another to close open edges",
            closed.welded
        ));
        mesh
    }

    /// Adds placed vertices and the triangles over them, turned over where they were mirrored.
    fn append(
        &mut self,
        vertices: impl Iterator<Item = [f64; 3]>,
        triangles: &[[u32; 3]],
        mirrored: bool,
    ) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices);
        self.triangles.extend(triangles.iter().map(|t| {
            let [a, b, c] = t.map(|corner| first + corner);
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
    }

    /// Drops vertices without a triangle.
    fn drop_unused(&mut self) {
        let mut number = vec![None; self.vertices.len()];
        for v in self.triangles.as_flattened() {
            number[*v as usize] = Some(0);
        }
        let used = number.iter_mut().flatten();
        used.zip(0..).for_each(|(n, new)| *n = new);
        let mut is_used = number.iter().map(Option::is_some);
        self.vertices.retain(|_| is_used.next() == Some(true));
        for v in self.triangles.as_flattened_mut() {
            *v = number[*v as usize].unwrap_or(*v);
        }
    }

    fn note(&mut self, notice: impl Into<String>) {
        self.notices.push(notice.into());
    }

    fn in_metres(mut self) -> RawMesh {
        let unit = self.unit;
        for x in self.vertices.as_flattened_mut() {
            *x = unit.to_metres(*x);
        }
        self
    }
}

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL, text or binary.
    Stl,
    /// Stanford PLY, text or binary of either byte order.
    Ply,
    /// glTF 2.0 as JSON with separate or embedded buffers.
    Gltf,
    /// glTF 2.0 as one binary file.
    Glb,
    /// Collada 1.4 or 1.5.
    Collada,
}

impl MeshFormat {
    /// The format of some bytes by what only it has, whatever the file is called.
    pub fn of_content(bytes: &[u8]) -> Option<MeshFormat> {
        if stl::is_binary(bytes) {
            return Some(MeshFormat::Stl);
        }
        let utf16 = text::is_utf16(bytes).then(|| text::decode(bytes));
        let plain = match &utf16 {
            Some(file) => file.text.as_bytes(),
            None => text::without_mark(bytes),
        };
        if plain.starts_with(b"glTF") {
            Some(MeshFormat::Glb)
        } else if ply::is_ply(plain) {
            Some(MeshFormat::Ply)
        } else if stl::is_text(plain) {
            Some(MeshFormat::Stl)
        } else if plain.trim_ascii_start().starts_with(b"{") {
            Some(MeshFormat::Gltf)
        } else if foreign::is_collada(plain) {
            Some(MeshFormat::Collada)
        } else if obj::has_vertices(plain) {
            Some(MeshFormat::Obj)
        } else {
            None
        }
    }

    /// Whether lengths have a unit by the format (metres in glTF) or by what each file states (Collada).
    pub fn has_unit(self) -> bool {
        match self {
            MeshFormat::Gltf | MeshFormat::Glb | MeshFormat::Collada => true,
            MeshFormat::Obj | MeshFormat::Stl | MeshFormat::Ply => false,
        }
    }

    /// The format a file's extension names, in upper or lower case.
    pub fn of_extension(path: &Path) -> Option<MeshFormat> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(MeshFormat::Obj),
            "stl" => Some(MeshFormat::Stl),
            "ply" => Some(MeshFormat::Ply),
            "gltf" => Some(MeshFormat::Gltf),
            "glb" => Some(MeshFormat::Glb),
            "dae" => Some(MeshFormat::Collada),
            _ => None,
        }
    }
}

/// Reads the triangles of a mesh file whose lengths are in `unit`, or in that of the file (metres for
/// glTF, what it states for Collada).
///
/// The content decides on the format; the extension where the content does not. All objects of an
/// OBJ file and all meshes of the default scene of a glTF or Collada file come together, placed by the
/// scene's nodes; buffers of a `.gltf` file are looked for beside it.
///
/// ```no_run
/// use langevin_rigid_formats::mesh::{LengthUnit, read_mesh};
///
/// let leaf = read_mesh("leaf.obj".as_ref(), Some(LengthUnit::Cm))?.sheet(0.0002)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// A [`ReadError`] where the file cannot be read, is of no known format, or a [`ParseError`] says
/// what is wrong inside it.
pub fn read_mesh(path: &Path, unit: Option<LengthUnit>) -> Result<RawMesh, ReadError> {
    if path.is_dir() {
        return Err(ReadError::Folder { path: path.into() });
    }
    let bytes = files::read(path).map_err(|source| ReadError::of_file(path, source))?;
    let refused = |foreign: Foreign| ReadError::Foreign {
        path: path.into(),
        what: foreign.what,
        remedy: foreign.remedy,
    };
    if let Some(foreign) = Foreign::of_content(&bytes) {
        return Err(refused(foreign));
    }
    let format = MeshFormat::of_content(&bytes).or_else(|| MeshFormat::of_extension(path));
    let format = format.ok_or_else(|| match Foreign::of_extension(path) {
        Some(foreign) => refused(foreign),
        None => ReadError::UnknownFormat { path: path.into() },
    })?;
    // The parent of a bare file name is the empty path, which joins as it should.
    parse_mesh(&bytes, format, unit, path.parent()).map_err(|error| ReadError::Parse {
        path: path.into(),
        error,
    })
}

/// Reads the triangles out of the bytes of a file.
///
/// `folder` is where buffers named by a [`MeshFormat::Gltf`] file are; with `None` such a file
/// must embed them.
///
/// ```
/// use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh};
///
/// let file = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
/// let square = parse_mesh(file, MeshFormat::Obj, Some(LengthUnit::Cm), None)?;
/// assert_eq!(square.triangles, [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(square.vertices[1], [0.01, 0.0, 0.0]);
/// # Ok::<(), langevin_rigid_formats::mesh::ParseError>(())
/// ```
///
/// # Errors
///
/// A [`ParseError`] with the place in the file where it is known; [`ParseError::NoUnit`] without a
/// `unit` where the format states none.
pub fn parse_mesh(
    bytes: &[u8],
    format: MeshFormat,
    unit: Option<LengthUnit>,
    folder: Option<&Path>,
) -> Result<RawMesh, ParseError> {
    if unit.is_none() && !format.has_unit() {
        return Err(ParseError::NoUnit);
    }
    let metres = Some(FileUnit::Known(LengthUnit::M));
    let (mut mesh, stated) = match format {
        MeshFormat::Obj => (obj::parse(bytes)?.welded_if_open(), None),
        MeshFormat::Stl => (stl::parse(bytes)?.welded(), None),
        MeshFormat::Ply => (ply::parse(bytes)?.welded_if_open(), None),
        MeshFormat::Gltf => (gltf::parse(bytes, None, folder)?.welded(), metres),
        MeshFormat::Glb => (gltf::parse_glb(bytes, folder)?.welded(), metres),
        MeshFormat::Collada => {
            let (mesh, unit) = collada::parse(bytes)?;
            (mesh.welded_if_open(), Some(unit))
        }
    };
    let unit = unit.map(FileUnit::Known).or(stated);
    let unit = unit.ok_or(ParseError::NoUnit)?;
    if mesh.triangles.is_empty() {
        return Err(ParseError::NoTriangles);
    }
    if let Some(stated) = stated.filter(|&stated| stated != unit) {
        let notice = format!("its lengths were taken to be in {unit} in place of {stated}");
        mesh.notices.push(notice);
    }
    mesh.unit = unit;
    Ok(mesh.seamless().in_metres())
}

#[cfg(test)]
mod tests;
