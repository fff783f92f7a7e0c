//! A closed surface around whatever triangles there are.
//!
//! A grid of nodes knows its distance from the triangles. The fluid comes in from outside through nodes farther
//! than an offset from them; around what it does not reach, marching tetrahedra make a closed surface at the
//! offset, which then moves onto the triangles.

mod grid;
mod leak;
mod tetrahedra;
mod triangle;

use rayon::prelude::*;

use super::check::has_no_area;
use super::intersect::meeting_moved;
use super::vector::{add, norm, scale, sub};
use super::{MeshError, TriMesh};
use grid::Grid;
pub use leak::Leak;

/// Offset in distances of nodes: above half the longest edge of a tetrahedron, sqrt(3) / 2, so that no
/// triangle slips through between nodes.
const OFFSET: f64 = 0.9;
/// What is left of the offset where the surface has moved onto the triangles.
const LEFT: f64 = 0.02;
/// The same for a sheet with fluid on both sides, which would have no thickness otherwise.
const LEFT_OF_SHEET: f64 = 0.5;
/// Most nodes, each of 12 bytes.
const MOST_NODES: f64 = 3e7;

/// Distance from the triangles, in offsets, of a surface that closes a gap.
const MADE: f64 = 0.6;

/// A closed surface around some triangles.
pub(super) struct Wrap {
    pub(super) body: TriMesh,
    /// Area of what closes gaps (m²).
    pub(super) made: f64,
    /// Where a coarser one would enclose more.
    pub(super) leak: Option<Leak>,
}

/// Why there is no wrap.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WrapError {
    /// There is nothing to wrap.
    #[error("there is nothing to wrap: no triangle can be used")]
    Nothing,
    /// Too fine.
    #[error(
        "a wrap of {size:.3e} m has {nodes:.1e} nodes, above the limit of {MOST_NODES:.0e}; take {advised:.1e} m or more"
    )]
    TooFine {
        /// The size asked for (m).
        size: f64,
        /// Nodes that it takes.
        nodes: f64,
        /// A size that is possible (m).
        advised: f64,
    },
    /// The size is none.
    #[error("the size of a wrap must be a positive length, not {0} m")]
    BadSize(f64),
    /// The fluid does not go around.
    #[error("the wrap is no body ({0}); take another size")]
    NoBody(MeshError),
}

/// A closed surface around some triangles that closes gaps up to about `size` (m). Corners in which no ball of
/// that size fits are filled up; open sheets become about half as thick as `size`.
///
/// # Errors
/// [`WrapError`]: no triangles, a size that is none, or one that is too fine for the memory.
pub(super) fn wrap(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    size: f64,
) -> Result<Wrap, WrapError> {
    if triangles.is_empty() {
        return Err(WrapError::Nothing);
    }
    if !(size > 0.0 && size.is_finite()) {
        return Err(WrapError::BadSize(size));
    }
    let corners: Vec<_> = triangles
        .iter()
        .map(|t| t.map(|v| vertices[v as usize]))
        .collect();
    let (made, body) = surround(&corners, size)?;
    let leak = Leak::find(&corners, size, body.volume());
    Ok(Wrap { body, made, leak })
}

/// The surface at one size, and the area of what closes gaps (m²).
fn surround(corners: &[grid::Corners], size: f64) -> Result<(f64, TriMesh), WrapError> {
    let offset = 0.5 * size;
    let pitch = offset / OFFSET;
    let (nodes, lattice) = Grid::lattice(corners, pitch).ok_or(WrapError::Nothing)?;
    if nodes > MOST_NODES {
        return Err(WrapError::TooFine {
            size,
            nodes,
            advised: advised(corners, size * libm::cbrt(nodes / MOST_NODES)),
        });
    }
    let grid = Grid::new(corners, pitch, offset, lattice);
    let (at_offset, triangles) = tetrahedra::surface(&grid, offset);
    let settled = settled(&grid, &at_offset, &triangles, offset);
    let body = TriMesh::new(settled, triangles).map_err(WrapError::NoBody)?;
    let is_made = |t: &usize| grid.distance_of(body.centroid(*t)) > MADE * offset;
    let made = (0..body.triangles().len()).filter(is_made);
    Ok((
        made.map(|t| body.area(t)).fold(0.0, |sum, area| sum + area),
        body,
    ))
}

/// A size of two digits, `size` (m) or little more, that the memory has room for.
fn advised(corners: &[grid::Corners], mut size: f64) -> f64 {
    loop {
        let digit = libm::pow(10.0, libm::floor(libm::log10(size)) - 1.0);
        let rounded = digit * (size / digit).ceil();
        match Grid::lattice(corners, 0.5 * rounded / OFFSET) {
            Some((nodes, _)) if nodes > MOST_NODES => size = rounded * 1.02,
            _ => return rounded,
        }
    }
}

/// The surface moved onto the triangles, but for places where it would meet itself there.
fn settled(
    grid: &Grid,
    at_offset: &[[f64; 3]],
    triangles: &[[u32; 3]],
    offset: f64,
) -> Vec<[f64; 3]> {
    let moves: Vec<[f64; 3]> = at_offset
        .par_iter()
        .map(|&v| inward(grid, v, offset))
        .collect();
    let mut share = vec![1.0; at_offset.len()];
    let mut has_moved = vec![true; at_offset.len()];
    loop {
        let place = |v: usize| add(at_offset[v], scale(share[v], moves[v]));
        let places: Vec<[f64; 3]> = (0..share.len()).map(place).collect();
        let moved = |t: usize| triangles[t].iter().any(|&v| has_moved[v as usize]);
        let meets = meeting_moved(&places, triangles, moved);
        let is_flat = |t: usize| has_no_area(triangles[t].map(|v| places[v as usize]));
        let back = (0..triangles.len()).filter(|&t| meets[t] || is_flat(t));
        let back: Vec<u32> = back.flat_map(|t| triangles[t]).collect();
        has_moved.fill(false);
        for v in back {
            let (v, kept) = (v as usize, share[v as usize]);
            has_moved[v] |= kept > 0.0;
            share[v] = if kept > 0.3 { 0.5 * kept } else { 0.0 };
        }
        if !has_moved.contains(&true) {
            return places;
        }
    }
}

/// How far a point of the offset surface moves.
fn inward(grid: &Grid, v: [f64; 3], offset: f64) -> [f64; 3] {
    let Some(nearest) = grid.nearest(v) else {
        return [0.0; 3];
    };
    let to = sub(nearest, v);
    let distance = norm(to);
    if distance > 2.0 * offset || distance == 0.0 {
        return [0.0; 3];
    }
    let beyond = add(nearest, scale(1.2 * offset / distance, to));
    let left = if grid.is_reached(beyond) {
        LEFT_OF_SHEET
    } else {
        LEFT
    };
    scale(1.0 - (left * offset / distance).min(1.0), to)
}

#[cfg(test)]
mod tests;
