//! Why a mesh is not a body.

use std::fmt;

/// Where an edge is: its vertices and one triangle at it, by number from 0, and its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeSite {
    /// Vertex numbers, the lower first.
    pub vertices: [u32; 2],
    /// A triangle that has the edge.
    pub triangle: u32,
    /// Middle of the edge (m).
    pub position: [f64; 3],
}

impl fmt::Display for EdgeSite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EdgeSite {
            vertices: [a, b],
            triangle,
            position: [x, y, z],
        } = self;
        write!(
            f,
            "between vertices {a} and {b} of triangle {triangle}, at ({x:.6}, {y:.6}, {z:.6}) m"
        )
    }
}

/// Why a mesh is not a body, where, and what helps.
///
/// Vertex and triangle numbers count from 0 in the order they were given. Where a fault occurs
/// more than once, `count` says how often and the place is that of the first.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There are no triangles.
    #[error("the mesh has no triangles: export the body's surface as polygons")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error(
        "{count} vertices with a coordinate that is not finite, the first vertex {vertex}: export the mesh again or delete them"
    )]
    NonFiniteVertex {
        /// The first such vertex.
        vertex: usize,
        /// How many there are.
        count: usize,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error(
        "triangle {triangle} refers to vertex {index} but there are only {vertices} vertices (counted from 0): the file is damaged or counts from 1, export it again"
    )]
    IndexOutOfRange {
        /// The first such triangle.
        triangle: usize,
        /// The vertex number in it.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Triangles with a repeated vertex or no area.
    #[error(
        "{count} triangles without area, the first triangle {triangle} (vertices {vertices:?}): merge vertices by distance and dissolve degenerate faces, or let `langevin-rigid repair` do it"
    )]
    DegenerateTriangle {
        /// The first such triangle.
        triangle: usize,
        /// Its vertices.
        vertices: [u32; 3],
        /// How many there are.
        count: usize,
    },
    /// The same three vertices make two triangles.
    #[error(
        "{count} duplicate triangles, the first triangle {second}, which repeats triangle {first}: delete duplicate and interior faces, or let `langevin-rigid repair` do it"
    )]
    DuplicateTriangle {
        /// The triangle that comes first.
        first: usize,
        /// The one that repeats it.
        second: usize,
        /// How many repeat another.
        count: usize,
    },
    /// More than two triangles meet at an edge.
    #[error(
        "{count} non-manifold edges, the first {site} where {triangles} triangles meet: delete interior faces, separate parts that share the edge"
    )]
    NonManifoldEdge {
        /// The first such edge.
        site: EdgeSite,
        /// How many triangles meet there.
        triangles: usize,
        /// How many there are.
        count: usize,
    },
    /// Edges that belong to one triangle only.
    #[error(
        "{count} open edges, the first {site}: the surface is not closed. If it is a sheet (paper, leaf, card), give it a thickness (`--thickness LENGTH` on the command line, `thickness = LENGTH` in a scene); if it is a solid, merge vertices by distance and fill the holes, or let `langevin-rigid repair` do it"
    )]
    OpenEdges {
        /// The first such edge.
        site: EdgeSite,
        /// How many there are.
        count: usize,
    },
    /// Two neighbouring triangles wind in opposite senses, though all could agree.
    #[error(
        "{count} edges where neighbouring triangles wind in opposite senses, the first {site}: recompute the normals consistently, or let `langevin-rigid repair` do it"
    )]
    InconsistentOrientation {
        /// The first such edge.
        site: EdgeSite,
        /// How many there are.
        count: usize,
    },
    /// The surface has one side only, as a Möbius strip or a Klein bottle.
    #[error(
        "the surface has only one side (like a Möbius strip), seen at the edge {site}: cut it there, a body needs an inside and an outside"
    )]
    NotOrientable {
        /// An edge at which the sides get mixed up.
        site: EdgeSite,
    },
    /// Parts of the surface touch at a single vertex.
    #[error("{count} vertices where parts of the surface touch in a single point, the first vertex {vertex} at ({:.6}, {:.6}, {:.6}) m: separate the parts or join them by more than a point", position[0], position[1], position[2])]
    NonManifoldVertex {
        /// The first such vertex.
        vertex: u32,
        /// Its position (m).
        position: [f64; 3],
        /// How many there are.
        count: usize,
    },
    /// The surface is closed but encloses nothing.
    #[error("the closed surface encloses no volume ({volume:.3e} m³ within a box of {:.3e} by {:.3e} by {:.3e} m): it is flattened; give a sheet as one layer with a thickness (`--thickness LENGTH` on the command line, `thickness = LENGTH` in a scene)", size[0], size[1], size[2])]
    ZeroVolume {
        /// The volume found (m³).
        volume: f64,
        /// Edges of the bounding box (m).
        size: [f64; 3],
    },
    /// Parts are so far apart for their size that their volume is lost to rounding.
    #[error("the parts are too far apart for their size: they enclose {volume:.3e} m³, but rounding makes it {found:.3e} m³ within a box of {:.3e} by {:.3e} by {:.3e} m: move them together, or keep the largest with `langevin-rigid repair --largest`", size[0], size[1], size[2])]
    PartsFarApart {
        /// The volume that the parts enclose (m³), each measured by itself.
        volume: f64,
        /// What an integral over all of the surface gives (m³).
        found: f64,
        /// Edges of the bounding box of all (m).
        size: [f64; 3],
    },
    /// The surface passes through itself, or lies on itself.
    #[error(
        "the surface passes through itself: {count} triangles meet others, the first triangle {} with {} at ({:.6}, {:.6}, {:.6}) m: let `langevin-rigid check` say what mends it, or untangle it in the program that made it",
        triangles[0], triangles[1], position[0], position[1], position[2]
    )]
    SelfIntersection {
        /// The first triangle that meets another, and that one.
        triangles: [usize; 2],
        /// A point they have in common (m).
        position: [f64; 3],
        /// How many triangles meet others.
        count: usize,
    },
    /// Closed parts overlap or touch.
    #[error(
        "parts overlap or touch: {count} triangles meet others, the first triangle {} with {} of another part at ({:.6}, {:.6}, {:.6}) m: make one surface of them with `langevin-rigid repair --wrap {wrap}`, or by a boolean union in the program that made them",
        triangles[0], triangles[1], position[0], position[1], position[2]
    )]
    PartsMeet {
        /// A size of a wrap that fits the body (m): a fiftieth of the diagonal of its box.
        wrap: f64,
        /// The first triangle that meets another, and that one.
        triangles: [usize; 2],
        /// A point they have in common (m).
        position: [f64; 3],
        /// How many triangles meet others.
        count: usize,
    },
    /// The thickness of a sheet is not a positive length.
    #[error(
        "the thickness of a sheet must be a positive length, not {thickness} m (`--thickness LENGTH` on the command line, `thickness = LENGTH` in a scene)"
    )]
    BadThickness {
        /// The thickness given (m).
        thickness: f64,
    },
    /// A thickness was asked for a mesh that is already closed.
    #[error("the mesh is closed already and cannot be thickened: leave the thickness out")]
    ClosedSheet,
    /// A sheet is folded back onto itself, so that no direction is normal to it.
    #[error("the sheet is folded onto itself at vertex {vertex} at ({:.6}, {:.6}, {:.6}) m, where its two sides cannot be told apart: open the fold a little or model the thickness", position[0], position[1], position[2])]
    FoldedSheet {
        /// The vertex on the fold.
        vertex: u32,
        /// Its position (m).
        position: [f64; 3],
    },
    /// A rotation, translation or scale is not one.
    #[error("cannot transform the mesh: {reason}")]
    BadTransform {
        /// What is wrong with it.
        reason: &'static str,
    },
}
