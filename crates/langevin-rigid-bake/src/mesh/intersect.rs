//! Where a surface runs through itself, or lies on itself.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::vector::{add, bounding_box, cross, dot, norm, scale, sub};

/// Share of the diagonal of the bounding box within which surfaces count as touching: the rounding of single
/// precision.
const TOUCH: f64 = 1e-7;

/// Pairs of triangles that are compared, and others that a triangle is compared with at least. Only where thousands
/// crowd in one place, as at the tip of a finely cut cone, are there more.
const PAIRS: usize = 40_000_000;
const LEAST: usize = 256;

/// Two triangles that meet other than along common edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub(super) triangles: [usize; 2],
    /// A point that both have (m).
    pub(super) position: [f64; 3],
}

type Corners = [[f64; 3]; 3];
type Boxed = GeomWithData<Rectangle<[f64; 3]>, usize>;

/// For each triangle that meets others, the first of them.
///
/// Triangles meet where an edge of one passes through the other, or where they lie on each other. Surfaces
/// that only share edges or points do not meet, whether or not they share the vertices. Of a crowd beyond
/// [`PAIRS`] a part is looked at.
pub(super) fn meetings(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<Meeting> {
    let search = Search::new(vertices, triangles, |_| true);
    let first = |t: usize| {
        let (other, position) = search.meeting(t).min_by_key(|&(other, _)| other)?;
        Some(Meeting {
            triangles: [t, other],
            position,
        })
    };
    search.triangles().filter_map(first).collect()
}

/// Whether each triangle meets one that has `moved`, or has moved and meets another.
pub(super) fn meeting_moved(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    moved: impl Fn(usize) -> bool,
) -> Vec<bool> {
    let search = Search::new(vertices, triangles, moved);
    let meets: Vec<AtomicBool> = triangles.iter().map(|_| AtomicBool::new(false)).collect();
    search.triangles().for_each(|t| {
        for (other, _) in search.meeting(t) {
            meets[t].store(true, Ordering::Relaxed);
            meets[other].store(true, Ordering::Relaxed);
        }
    });
    meets.into_iter().map(AtomicBool::into_inner).collect()
}

/// Triangles, and a tree of those that they are compared with.
struct Search {
    facets: Vec<Facet>,
    tree: RTree<Boxed>,
    touch: f64,
}

impl Search {
    fn new(
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
        in_tree: impl Fn(usize) -> bool,
    ) -> Search {
        let places = triangles.iter().map(|t| t.map(|v| vertices[v as usize]));
        let facets: Vec<Facet> = places.map(Facet::new).collect();
        let corners = facets.iter().flat_map(|facet| facet.corners);
        let [low, high] = bounding_box(&corners.collect::<Vec<_>>());
        let touch = TOUCH * norm(sub(high, low));
        let boxed = |t: usize| {
            let [low, high] = bounding_box(&facets[t].corners);
            let [low, high] = [low.map(|x| x - touch), high.map(|x| x + touch)];
            Boxed::new(Rectangle::from_corners(low, high), t)
        };
        let members = (0..facets.len()).filter(|&t| in_tree(t)).map(boxed);
        Search {
            tree: RTree::bulk_load(members.collect()),
            facets,
            touch,
        }
    }

    fn triangles(&self) -> impl ParallelIterator<Item = usize> {
        (0..self.facets.len()).into_par_iter().with_min_len(256)
    }

    /// What a triangle meets, and where.
    fn meeting(&self, t: usize) -> impl Iterator<Item = (usize, [f64; 3])> {
        let most = (PAIRS / self.facets.len()).max(LEAST);
        let facet = &self.facets[t];
        let [low, high] = bounding_box(&facet.corners);
        let near = self
            .tree
            .locate_in_envelope_intersecting(AABB::from_corners(low, high));
        near.take(most)
            .map(|other| other.data)
            .filter(move |&other| other != t)
            .filter_map(move |other| {
                let position = meeting(facet, &self.facets[other], self.touch)?;
                Some((other, position))
            })
    }
}

/// A triangle with its plane and, in it, the inward normals of its sides.
struct Facet {
    corners: Corners,
    normal: [f64; 3],
    /// That of the side from corner k to the next.
    inward: Corners,
}

impl Facet {
    fn new(corners: Corners) -> Facet {
        let [a, b, c] = corners;
        let normal = unit_or_zero(cross(sub(b, a), sub(c, a)));
        let inward = [[a, b], [b, c], [c, a]].map(|[p, q]| unit_or_zero(cross(normal, sub(q, p))));
        Facet {
            corners,
            normal,
            inward,
        }
    }

    fn heights(&self, other: &Facet) -> [f64; 3] {
        other
            .corners
            .map(|p| dot(self.normal, sub(p, self.corners[0])))
    }

    /// Distance of a point of the plane from the nearest side, positive inside (m).
    fn depth(&self, p: [f64; 3]) -> f64 {
        let from_side = |k: usize| dot(self.inward[k], sub(p, self.corners[k]));
        from_side(0).min(from_side(1)).min(from_side(2))
    }

    /// Where an edge of the other goes through this one. An end on the plane counts as above it, so that touching
    /// from outside is not passing through; then it must be well inside, since surfaces may share edges.
    fn pierced(&self, other: &Facet, heights: [f64; 3], touch: f64) -> Option<[f64; 3]> {
        let above = heights.map(|h| h > -touch);
        let crossing = |k: usize| {
            let next = (k + 1) % 3;
            if above[k] == above[next] {
                return None;
            }
            let [from, to] = [k, next].map(|k| match above[k] {
                true => heights[k].max(0.0),
                false => heights[k],
            });
            let [p, q] = [k, next].map(|k| other.corners[k]);
            let x = add(p, scale(from / (from - to), sub(q, p)));
            let least = if from.max(to) > touch { -touch } else { touch };
            (self.depth(x) > least).then_some(x)
        };
        (0..3).find_map(crossing)
    }

    /// Whether the other lies in the plane of this one and on it.
    fn covers(&self, other: &Facet, heights: [f64; 3], touch: f64) -> bool {
        let in_plane = heights.iter().all(|h| h.abs() <= touch);
        in_plane && self.overlaps_in_plane(other, touch) && other.overlaps_in_plane(self, touch)
    }

    /// Whether no side of this one has all of the other, but for `touch`, beyond it.
    fn overlaps_in_plane(&self, other: &Facet, touch: f64) -> bool {
        let separates = |k: usize| {
            let beyond = |p: [f64; 3]| dot(self.inward[k], sub(p, self.corners[k])) <= touch;
            other.corners.into_iter().all(beyond)
        };
        !(0..3).any(separates)
    }
}

fn unit_or_zero(a: [f64; 3]) -> [f64; 3] {
    let length = norm(a);
    if length > 0.0 {
        scale(1.0 / length, a)
    } else {
        [0.0; 3]
    }
}

/// Whether something of those heights over a plane is clear of it.
fn on_one_side(heights: [f64; 3], touch: f64) -> bool {
    heights.iter().all(|&h| h > touch) || heights.iter().all(|&h| h < -touch)
}

fn meeting(a: &Facet, b: &Facet, touch: f64) -> Option<[f64; 3]> {
    let above_a = a.heights(b);
    if on_one_side(above_a, touch) {
        return None;
    }
    let above_b = b.heights(a);
    if on_one_side(above_b, touch) {
        return None;
    }
    let through = a.pierced(b, above_a, touch);
    let through = through.or_else(|| b.pierced(a, above_b, touch));
    through.or_else(|| {
        let on = a.covers(b, above_a, touch) || b.covers(a, above_b, touch);
        on.then(|| {
            let [smaller, _] = if extent(a) < extent(b) {
                [a, b]
            } else {
                [b, a]
            };
            let [p, q, r] = smaller.corners;
            scale(1.0 / 3.0, add(p, add(q, r)))
        })
    })
}

fn extent(facet: &Facet) -> f64 {
    let [a, b, c] = facet.corners;
    norm(cross(sub(b, a), sub(c, a)))
}

#[cfg(test)]
mod tests;
