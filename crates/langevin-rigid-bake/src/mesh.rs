//! Closed, oriented triangle meshes: the geometry every body starts from.
//!
//! [`TriMesh::new`] accepts only what the boundary integrals can use: one or several closed manifolds that do not meet,
//! and enclose a volume. Everything else is a [`MeshError`] that names the place and the remedy. [`TriMesh::from_sheet`]
//! turns an open sheet into such a body, [`weld`] joins the vertices a file format duplicated, [`survey()`] reports
//! everything that is wrong with a mesh, and [`repair()`] mends it.

mod body;
mod boundary;
mod check;
mod edges;
mod error;
mod hull;
mod intersect;
mod nesting;
pub(crate) mod parts;
mod proxy;
mod repair;
mod seams;
mod sheet;
mod survey;
pub(crate) mod vector;
mod weld;
mod wrap;

pub use boundary::Hole;
pub use check::fitting_wrap;
pub use edges::{Edge, open_edge_count};
pub use error::{EdgeSite, MeshError};
pub use proxy::ProxyError;
pub use repair::{
    Balance, FILL, Options, Repaired, SMALL_HOLE, Step, Unrepaired, WELD, WIDE_HOLE, diagonal,
    repair,
};
pub use seams::{ClosedSeams, close_seams};
pub use survey::{Component, Faults, Finding, Seams, Survey, survey};
pub use weld::weld;
pub use wrap::{Leak, WrapError};

use std::borrow::Cow;

use vector::{add, cross, det, dot, mat_vec, norm, scale, sub};

/// The surface of a rigid body (metres): closed, with normals out of the solid.
///
/// It may have several components, parts that are apart and cavities: each is turned by how many others are
/// around it. What is inside another component is sealed off from the fluid.
///
/// ```
/// use langevin_rigid_bake::TriMesh;
///
/// let tetrahedron = TriMesh::new(
///     vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
///     vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
/// )?;
/// assert!((tetrahedron.volume() - 1.0 / 6.0).abs() < 1e-15);
/// assert!(!tetrahedron.was_turned());
/// # Ok::<(), langevin_rigid_bake::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TriMesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// How many triangles were turned.
    turned: usize,
    smooth: bool,
    /// Triangles inside another component, ascending.
    sealed: Vec<u32>,
}

impl TriMesh {
    /// A body from vertex positions (m) and counter-clockwise vertex triples, after every check.
    ///
    /// A component whose normals point into the solid is turned ([`TriMesh::was_turned`] tells); vertices
    /// that no triangle uses are dropped and the others renumbered in order.
    ///
    /// # Errors
    ///
    /// The first [`MeshError`] in the order its variants are listed; numbers in it are those of
    /// the arguments, counted from 0.
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<TriMesh, MeshError> {
        let mesh = TriMesh::closed(vertices, triangles)?;
        check::apart(&mesh.vertices, &mesh.triangles)?;
        Ok(mesh)
    }

    /// The same, without looking for places where the surface meets itself.
    fn closed(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<TriMesh, MeshError> {
        check::closed_manifold(&vertices, &triangles)?;
        let (vertices, triangles) = weld::drop_unused(vertices, triangles);
        let mesh = TriMesh {
            vertices,
            triangles,
            turned: 0,
            smooth: false,
            sealed: Vec::new(),
        };
        mesh.oriented()
    }

    /// A body from an open sheet, thickened by `thickness` (m), half to either side.
    ///
    /// Each vertex moves along its angle-weighted normal, far enough for the two sides to be
    /// `thickness` apart; the rim is closed by quadrilaterals split in two. A flat sheet of area A
    /// gives the volume A × `thickness` exactly.
    ///
    /// ```
    /// use langevin_rigid_bake::TriMesh;
    ///
    /// let corners = vec![[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.3, 0.0, 0.2], [0.0, 0.0, 0.2]];
    /// let plate = TriMesh::from_sheet(corners, vec![[0, 2, 1], [0, 3, 2]], 0.001)?;
    /// assert_eq!(plate.triangles().len(), 12);
    /// assert!((plate.volume() - 0.3 * 0.2 * 0.001).abs() < 1e-18);
    /// # Ok::<(), langevin_rigid_bake::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Those of [`TriMesh::new`] other than open edges, and a thickness that is not positive, a
    /// mesh that is already closed, a surface with one side only, a sheet folded onto itself.
    pub fn from_sheet(
        vertices: Vec<[f64; 3]>,
        triangles: Vec<[u32; 3]>,
        thickness: f64,
    ) -> Result<TriMesh, MeshError> {
        let (vertices, triangles) = sheet::thicken(vertices, triangles, thickness)?;
        TriMesh::new(vertices, triangles)
    }

    /// Marks the facets as an approximation of a smooth surface (see [`TriMesh::is_smooth`]).
    pub(crate) fn with_smooth(mut self, smooth: bool) -> TriMesh {
        self.smooth = smooth;
        self
    }

    /// Vertex positions (m).
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Whether triangles came with normals into the solid and were turned.
    pub fn was_turned(&self) -> bool {
        self.turned > 0
    }

    /// Whether every edge is a facet boundary of a smooth surface rather than an edge of the body.
    ///
    /// Set for generated ellipsoids only; a mesh from a file is taken at its word.
    pub fn is_smooth(&self) -> bool {
        self.smooth
    }

    /// The three corner positions of a triangle (m).
    ///
    /// # Panics
    ///
    /// Where `triangle` is not below the number of triangles, as indexing a slice does.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    /// Twice the area times the outward unit normal of a triangle (m²).
    fn area_vector(&self, triangle: usize) -> [f64; 3] {
        let [a, b, c] = self.corners(triangle);
        cross(sub(b, a), sub(c, a))
    }

    /// Outward unit normal of a triangle (panics as [`TriMesh::corners`] does).
    pub fn normal(&self, triangle: usize) -> [f64; 3] {
        vector::unit(self.area_vector(triangle))
    }

    /// Area of a triangle (m², panics as [`TriMesh::corners`] does).
    pub fn area(&self, triangle: usize) -> f64 {
        0.5 * norm(self.area_vector(triangle))
    }

    /// Centroid of a triangle (m, panics as [`TriMesh::corners`] does).
    pub fn centroid(&self, triangle: usize) -> [f64; 3] {
        let [a, b, c] = self.corners(triangle);
        scale(1.0 / 3.0, add(a, add(b, c)))
    }

    /// Every edge once, sorted by its vertex numbers.
    pub fn edges(&self) -> Vec<Edge> {
        edges::of_closed(&self.triangles)
    }

    /// Lowest and highest corner of the axis-aligned bounding box (m).
    pub fn bounding_box(&self) -> [[f64; 3]; 2] {
        vector::bounding_box(&self.vertices)
    }

    /// Area of the whole surface (m²).
    pub fn surface_area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| self.area(t)).sum()
    }

    /// The surface that the fluid reaches: without what is inside another component.
    ///
    /// ```
    /// use langevin_rigid_bake::TriMesh;
    /// use langevin_rigid_bake::shapes::Shape;
    ///
    /// let cube = Shape::Box { size: [0.1; 3] }.mesh(12)?;
    /// let half = cube.vertices().iter().map(|v| v.map(|x| 0.5 * x));
    /// let n = cube.vertices().len() as u32;
    /// let within = cube.triangles().iter().map(|t| t.map(|v| v + n));
    /// let shell = TriMesh::new(
    ///     cube.vertices().iter().copied().chain(half).collect(),
    ///     cube.triangles().iter().copied().chain(within).collect(),
    /// )?;
    /// assert_eq!(*shell.wetted(), cube);
    /// assert!((shell.volume() - 0.1f64.powi(3)).abs() < 1e-18);
    /// assert!((shell.solid_volume() - 0.1f64.powi(3) * 7.0 / 8.0).abs() < 1e-18);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn wetted(&self) -> Cow<'_, TriMesh> {
        if self.sealed.is_empty() {
            return Cow::Borrowed(self);
        }
        let is_wetted = |t: &usize| self.sealed.binary_search(&(*t as u32)).is_err();
        let kept = (0..self.triangles.len()).filter(is_wetted);
        let kept = kept.map(|t| self.triangles[t]).collect();
        let (vertices, triangles) = weld::drop_unused(self.vertices.clone(), kept);
        Cow::Owned(TriMesh {
            vertices,
            triangles,
            turned: 0,
            sealed: Vec::new(),
            ..*self
        })
    }

    /// Volume of the fluid displaced (m³), that of sealed cavities included.
    pub fn volume(&self) -> f64 {
        self.wetted().solid_volume()
    }

    /// Volume of the solid (m³), without cavities.
    ///
    /// Divergence theorem with tetrahedra to the middle of the bounding box, so that a mesh far
    /// from the origin loses no digits.
    pub fn solid_volume(&self) -> f64 {
        let [low, high] = self.bounding_box();
        let middle = scale(0.5, add(low, high));
        let six_volumes = (0..self.triangles.len()).map(|t| {
            let [a, b, c] = self.corners(t).map(|v| sub(v, middle));
            dot(a, cross(b, c))
        });
        six_volumes.sum::<f64>() / 6.0
    }

    /// The mesh after x → rotation · (scale · x) + translation.
    ///
    /// `rotation` is row-major and orthogonal; a reflection (determinant −1) is allowed and the
    /// triangles are turned accordingly. `scale` is positive, `translation` in metres.
    ///
    /// # Errors
    ///
    /// [`MeshError::BadTransform`] where the rotation is not orthogonal to 1e-9, the scale not
    /// positive, or a number not finite.
    pub fn transformed(
        &self,
        rotation: [[f64; 3]; 3],
        translation: [f64; 3],
        scale: f64,
    ) -> Result<TriMesh, MeshError> {
        check::transform(&rotation, translation, scale)?;
        let place = |v: &[f64; 3]| add(mat_vec(&rotation, vector::scale(scale, *v)), translation);
        let moved = self.with_vertices(self.vertices.iter().map(place).collect())?;
        Ok(if det(&rotation) < 0.0 {
            moved.reversed()
        } else {
            moved
        })
    }

    /// The mesh scaled about the origin until it displaces `volume` (m³).
    ///
    /// # Errors
    ///
    /// [`MeshError::BadTransform`] where `volume` is not positive and finite.
    pub fn scaled_to_volume(&self, volume: f64) -> Result<TriMesh, MeshError> {
        let factor = libm::cbrt(volume / self.volume());
        self.transformed(vector::IDENTITY, [0.0; 3], factor)
    }

    /// Same connectivity with other positions.
    fn with_vertices(&self, vertices: Vec<[f64; 3]>) -> Result<TriMesh, MeshError> {
        check::finite(&vertices)?;
        Ok(TriMesh {
            vertices,
            ..self.clone()
        })
    }

    fn reversed(mut self) -> TriMesh {
        for t in &mut self.triangles {
            t.swap(1, 2);
        }
        self
    }
}

#[cfg(test)]
mod tests;
