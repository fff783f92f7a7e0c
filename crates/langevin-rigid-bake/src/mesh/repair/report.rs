//! What was done, and what is left.

use std::fmt;

use super::Balance;
use crate::mesh::boundary::{Hole, loops, open_sides};
use crate::mesh::edges::sorted_sides;
use crate::mesh::{Leak, MeshError, ProxyError, TriMesh, WrapError};

/// What became of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Repaired {
    /// What was done, in this order.
    pub steps: Vec<Step>,
    /// What was lost and made on the way to the body.
    pub balance: Option<Balance>,
    /// The body, or why there is none yet.
    pub body: Result<TriMesh, Unrepaired>,
}

/// Something that was done to a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Step {
    /// Dropped triangles with a corner that does not exist or whose coordinates are no numbers to use.
    Unusable {
        /// How many.
        triangles: usize,
    },
    /// Dropped vertices that no triangle uses.
    Unused {
        /// How many.
        vertices: usize,
    },
    /// Welded vertices of open edges to others close by.
    Welded {
        /// How many are no longer there.
        vertices: usize,
        /// The farthest that one was from the other (m).
        distance: f64,
    },
    /// Resolved triangles without area.
    Degenerate {
        /// Triangles dropped, which joined nothing.
        dropped: usize,
        /// Short sides collapsed to a vertex.
        collapsed: usize,
        /// Long sides flipped, so that the vertex on such a side is one of the triangle beyond.
        flipped: usize,
    },
    /// Dropped triangles that were there more than once.
    Duplicates {
        /// How many, `interior` among them.
        dropped: usize,
        /// Those of walls in the inside, of which none is kept.
        interior: usize,
    },
    /// Turned the fewer triangles of a component to wind like the more.
    Turned {
        /// How many.
        triangles: usize,
    },
    /// Turned whole components that were inside out.
    InsideOut {
        /// Their triangles.
        triangles: usize,
    },
    /// Gave vertices of their own to parts that touched along edges or in points.
    Split {
        /// Edges at which more than two triangles met.
        edges: usize,
        /// Vertices added.
        vertices: usize,
    },
    /// Dropped all components but the largest.
    Components {
        /// How many.
        dropped: usize,
        /// Their triangles.
        triangles: usize,
        /// The area of these (m²).
        area: f64,
    },
    /// Filled holes.
    Filled {
        /// How many.
        holes: usize,
        /// Edges around them, all together.
        edges: usize,
        /// Triangles added.
        triangles: usize,
        /// The area of these (m²).
        area: f64,
    },
    /// Thickened an open sheet.
    Thickened {
        /// Edges of its rim.
        edges: usize,
        /// The thickness (m).
        thickness: f64,
    },
    /// Wrapped the triangles in a closed surface.
    Wrapped {
        /// Size of the gaps that it closes (m).
        size: f64,
        /// Its triangles.
        triangles: usize,
        /// Area of what closes gaps (m²).
        made: f64,
        /// Volume enclosed (m³).
        volume: f64,
        /// Where closed parts met and no wrap was asked for: the sum of their volumes (m³), in which what they
        /// share counts for each.
        parts: Option<f64>,
        /// Where a coarser wrap would enclose more.
        leak: Option<Leak>,
    },
    /// Simplified the body, keeping its volume.
    Simplified {
        /// Triangles before.
        from: usize,
        /// Triangles after.
        to: usize,
    },
}

impl Step {
    /// One word for what it is, the same in every version.
    pub fn name(&self) -> &'static str {
        match self {
            Step::Unusable { .. } => "unusable",
            Step::Unused { .. } => "unused",
            Step::Welded { .. } => "weld",
            Step::Degenerate { .. } => "degenerate",
            Step::Duplicates { .. } => "duplicates",
            Step::Turned { .. } => "turn",
            Step::InsideOut { .. } => "inside-out",
            Step::Split { .. } => "split",
            Step::Components { .. } => "components",
            Step::Filled { .. } => "fill",
            Step::Thickened { .. } => "thicken",
            Step::Wrapped { .. } => "wrap",
            Step::Simplified { .. } => "simplify",
        }
    }

    /// How many vertices, edges, triangles, holes or components it concerned.
    pub fn count(&self) -> usize {
        match *self {
            Step::Unusable { triangles }
            | Step::Turned { triangles }
            | Step::InsideOut { triangles } => triangles,
            Step::Unused { vertices } | Step::Welded { vertices, .. } => vertices,
            Step::Degenerate {
                dropped,
                collapsed,
                flipped,
            } => dropped + collapsed + flipped,
            Step::Duplicates { dropped, .. } | Step::Components { dropped, .. } => dropped,
            Step::Split { edges, vertices } => edges + vertices,
            Step::Filled { holes, .. } => holes,
            Step::Thickened { edges, .. } => edges,
            Step::Wrapped { triangles, .. } => triangles,
            Step::Simplified { from, to } => from - to,
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Step::Unusable { triangles } => write!(
                f,
                "dropped {triangles} triangles with a coordinate or a vertex that cannot be used"
            ),
            Step::Unused { vertices } => write!(f, "dropped {vertices} vertices of no triangle"),
            Step::Welded { vertices, distance } => {
                write!(f, "welded {vertices} vertices within {distance:.1e} m")
            }
            Step::Degenerate {
                dropped,
                collapsed,
                flipped,
            } => write!(
                f,
                "triangles without area: dropped {dropped}, collapsed {collapsed} short sides, flipped {flipped} long ones"
            ),
            Step::Duplicates { dropped, interior } => write!(
                f,
                "dropped {dropped} duplicate triangles, {interior} of them in interior walls"
            ),
            Step::Turned { triangles } => {
                write!(
                    f,
                    "turned {triangles} triangles to wind as their neighbours do"
                )
            }
            Step::InsideOut { triangles } => {
                write!(f, "turned all {triangles} triangles of what was inside out")
            }
            Step::Split { edges, vertices } => write!(
                f,
                "took apart what touched along {edges} edges or in points, by {vertices} more vertices"
            ),
            Step::Components {
                dropped,
                triangles,
                area,
            } => write!(
                f,
                "dropped {dropped} smaller components of {triangles} triangles and {area:.3e} m^2 together"
            ),
            Step::Filled {
                holes,
                edges,
                triangles,
                area,
            } => write!(
                f,
                "filled {holes} holes of {edges} edges together with {triangles} triangles of {area:.3e} m^2"
            ),
            Step::Thickened { edges, thickness } => write!(
                f,
                "thickened the open sheet, whose rim has {edges} edges, to {thickness} m"
            ),
            Step::Wrapped {
                size,
                triangles,
                made,
                volume,
                parts,
                ..
            } => {
                let what = if parts.is_some() {
                    "parts that overlap or touch"
                } else {
                    "all"
                };
                write!(
                    f,
                    "wrapped {what} in a surface of {triangles} triangles that closes gaps up to {size:.3e} m, with {made:.3e} m^2 across gaps"
                )?;
                match parts {
                    Some(parts) => write!(f, "; {parts:.6e} m^3 of parts became {volume:.6e} m^3"),
                    None => write!(f, "; it encloses {volume:.6e} m^3"),
                }
            }
            Step::Simplified { from, to } => {
                write!(
                    f,
                    "simplified from {from} to {to} triangles of the same volume"
                )
            }
        }
    }
}

/// Why there is no body yet.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unrepaired {
    /// It was to stop.
    #[error("the repair was interrupted")]
    Cancelled,
    /// Holes that are too large to be filled unasked, or the rim of a sheet.
    #[error(
        "{count} holes are left, the largest of {} edges and {:.4} m around ({:.6}, {:.6}, {:.6}) m: a sheet (paper, leaf, shell) needs `--thickness LENGTH`; a hole in a solid is filled with `--fill {}` or more unless it is as wide as the surface around it; close others in the program that made the mesh",
        largest.edges, largest.perimeter, largest.centre[0], largest.centre[1], largest.centre[2], largest.edges
    )]
    Open {
        /// How many.
        count: usize,
        /// The one with the longest perimeter.
        largest: Hole,
    },
    /// Nothing that could be mended unasked.
    #[error("it is no body still: {0}")]
    NoBody(MeshError),
    /// It cannot be wrapped.
    #[error(transparent)]
    Wrap(#[from] WrapError),
    /// It cannot be simplified that far.
    #[error(transparent)]
    Proxy(#[from] ProxyError),
}

/// What stands between these triangles and a body.
pub(super) fn left(vertices: &[[f64; 3]], triangles: &[[u32; 3]], error: MeshError) -> Unrepaired {
    match error {
        MeshError::OpenEdges { .. } => {
            let open = open_sides(&sorted_sides(triangles));
            let holes = loops(vertices.len(), &open);
            let holes: Vec<Hole> = holes.iter().map(|rim| Hole::new(vertices, rim)).collect();
            let count = holes.len();
            let longest = |a: &Hole, b: &Hole| a.perimeter.total_cmp(&b.perimeter);
            match holes.into_iter().max_by(longest) {
                Some(largest) => Unrepaired::Open { count, largest },
                None => Unrepaired::NoBody(error),
            }
        }
        error => Unrepaired::NoBody(error),
    }
}
