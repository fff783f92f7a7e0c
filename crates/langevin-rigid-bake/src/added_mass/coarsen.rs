//! Merging of needles that crowd: the triangles around the apex of a cone or the hub of a fan.
//!
//! Very many long, thin triangles side by side are all near each other, and pairs of them grow with
//! their square. Their short edges carry nothing that the flow sees, so they are collapsed until the
//! needles no longer crowd, are even enough, or the surface would move (M. Garland and P. Heckbert, 1997).

use rayon::prelude::*;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::AddedMassError;
use super::edges::{SHARP, ordered};
use super::near::NEAR2;
use super::panels::Vec3;
use super::quadric::Quadric;
use super::report::Cancel;
use crate::mesh::vector::{add, cross, dot, norm, scale, sub};

/// Panels near a needle from which it is crowded; even meshes have some 60, thin bodies 100.
const CROWD: usize = 256;
/// Longest edge over shortest from which a triangle is a needle.
const NEEDLE: f64 = 8.0;
/// Root mean square distance, over sqrt(area), that the surface may move: the volume of a cone or
/// cylinder changes by 1e-4.
const DEVIATION: f64 = 5e-5;
/// Cosine of the angle that a triangle may turn by.
const STEADY: f64 = 0.98;
/// Triangles at a vertex from which it is a hub, which stays.
const HUB: usize = 64;
/// Rounds, each of which may halve the needles.
const ROUNDS: usize = 40;

/// A vertex that was merged with another, and the point of the remaining surface nearest to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Merged {
    pub(super) vertex: u32,
    /// Corners of a triangle, some of which may have been merged later.
    pub(super) corners: [u32; 3],
    pub(super) weights: Vec3,
}

/// Coarsens the crowded needles of a closed mesh of the given surface area; the vertices merged are used
/// no more, in order.
pub(super) fn coarsen(
    vertices: &[Vec3],
    triangles: &mut Vec<[u32; 3]>,
    area: f64,
    cancel: &Cancel,
) -> Result<Vec<Merged>, AddedMassError> {
    let mut merged = Vec::new();
    let mut quadrics = Vec::new();
    for _ in 0..ROUNDS {
        cancel.check()?;
        let short = crowded_edges(vertices, triangles);
        if short.is_empty() {
            break;
        }
        if quadrics.is_empty() {
            quadrics = Quadric::of_vertices(vertices, triangles);
        }
        let mut round = Round::new(vertices, triangles, &mut quadrics, DEVIATION * area.sqrt());
        let before = merged.len();
        for ends in short {
            merged.extend(round.merge(ends));
        }
        *triangles = round.triangles.into_iter().flatten().collect();
        if merged.len() == before {
            break;
        }
    }
    Ok(merged)
}

/// The shortest edge of every crowded needle, shortest first.
fn crowded_edges(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let needles: Vec<Needle> = triangles
        .iter()
        .filter_map(|t| Needle::new(*t, vertices))
        .collect();
    // Crowds of needles are of needles: nothing else has that many triangles near it.
    if needles.len() < CROWD {
        return Vec::new();
    }
    let centroids = triangles
        .iter()
        .map(|t| centroid(t.map(|v| vertices[v as usize])));
    let tree = RTree::bulk_load(centroids.map(|c| GeomWithData::new(c, ())).collect());
    let mut edges: Vec<(f32, [u32; 2])> = needles
        .par_iter()
        .filter(|needle| {
            let near = tree.locate_within_distance(needle.centroid, NEAR2 * needle.longest2);
            near.take(CROWD).count() == CROWD
        })
        .map(|needle| (needle.shortest2 as f32, needle.short))
        .collect();
    edges.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    edges.dedup();
    edges.into_iter().map(|(_, ends)| ends).collect()
}

/// A long, thin triangle.
struct Needle {
    centroid: Vec3,
    longest2: f64,
    shortest2: f64,
    short: [u32; 2],
}

impl Needle {
    fn new(corners: [u32; 3], vertices: &[Vec3]) -> Option<Needle> {
        let points = corners.map(|v| vertices[v as usize]);
        let lengths2 = [0, 1, 2].map(|k| {
            let side = sub(points[(k + 1) % 3], points[k]);
            dot(side, side)
        });
        let longest2 = lengths2.iter().fold(0.0, |l: f64, &x| l.max(x));
        let k = (1..3).fold(0, |best, k| {
            if lengths2[k] < lengths2[best] {
                k
            } else {
                best
            }
        });
        (lengths2[k] * (NEEDLE * NEEDLE) < longest2).then(|| Needle {
            centroid: centroid(points),
            longest2,
            shortest2: lengths2[k],
            short: ordered(corners[k], corners[(k + 1) % 3]),
        })
    }
}

fn centroid([a, b, c]: [Vec3; 3]) -> Vec3 {
    scale(1.0 / 3.0, add(a, add(b, c)))
}

/// One round of collapses, no two of which share an end.
struct Round<'a> {
    vertices: &'a [Vec3],
    triangles: Vec<Option<[u32; 3]>>,
    /// Triangles that are or were at each vertex.
    stars: Vec<Vec<u32>>,
    /// How many triangles are at each vertex.
    valence: Vec<usize>,
    quadrics: &'a mut [Quadric],
    deviation: f64,
    touched: Vec<bool>,
}

impl<'a> Round<'a> {
    fn new(
        vertices: &'a [Vec3],
        triangles: &[[u32; 3]],
        quadrics: &'a mut [Quadric],
        deviation: f64,
    ) -> Round<'a> {
        let mut stars = vec![Vec::new(); vertices.len()];
        for (t, corners) in triangles.iter().enumerate() {
            for &v in corners {
                stars[v as usize].push(t as u32);
            }
        }
        Round {
            vertices,
            triangles: triangles.iter().copied().map(Some).collect(),
            valence: stars.iter().map(Vec::len).collect(),
            stars,
            quadrics,
            deviation,
            touched: vec![false; vertices.len()],
        }
    }

    /// Merges one end of an edge with the other where that leaves the surface as it is.
    fn merge(&mut self, [a, b]: [u32; 2]) -> Option<Merged> {
        if self.touched[a as usize] || self.touched[b as usize] {
            return None;
        }
        [[b, a], [a, b]]
            .into_iter()
            .find_map(|[from, into]| self.collapse(from, into))
    }

    fn collapse(&mut self, from: u32, into: u32) -> Option<Merged> {
        if self.stars[from as usize].len() > HUB {
            return None;
        }
        let star = self.star(from);
        let (gone, kept): (Vec<Side>, Vec<Side>) = star.iter().partition(|s| s.has(into));
        let opposite: Vec<u32> = gone.iter().map(|s| s.other_than(into)).collect();
        let allowed = opposite.len() == 2
            && opposite.iter().all(|&o| self.valence[o as usize] > 3)
            && self.keeps_topology(&star, into, &opposite)
            && self.keeps_features(&star, from, into)
            && self.keeps_surface(&kept, from, into);
        if !allowed {
            return None;
        }
        for side in &gone {
            self.triangles[side.triangle as usize] = None;
        }
        for side in &kept {
            self.triangles[side.triangle as usize] = Some([into, side.ends[0], side.ends[1]]);
            self.stars[into as usize].push(side.triangle);
        }
        for o in opposite {
            self.valence[o as usize] -= 1;
        }
        let valence = &mut self.valence[into as usize];
        *valence = *valence + kept.len() - 2;
        let (quadric, from_, into_) = (self.quadrics[from as usize], from as usize, into as usize);
        self.quadrics[into_].add(&quadric);
        (self.touched[from_], self.touched[into_]) = (true, true);
        self.nearest(&kept, from, into)
    }

    /// The triangles at `v` as the sides across from it.
    fn star(&self, v: u32) -> Vec<Side> {
        let side = |&triangle: &u32| {
            let corners = self.triangles[triangle as usize]?;
            let k = corners.iter().position(|&c| c == v)?;
            Some(Side {
                triangle,
                ends: [corners[(k + 1) % 3], corners[(k + 2) % 3]],
            })
        };
        self.stars[v as usize].iter().filter_map(side).collect()
    }

    /// Whether the two ends have no neighbours in common but the corners across from their edge.
    fn keeps_topology(&self, star: &[Side], into: u32, opposite: &[u32]) -> bool {
        star.iter()
            .map(|s| s.ends[0])
            .filter(|w| *w != into && !opposite.contains(w))
            .all(|w| !self.adjacent(w, into))
    }

    fn adjacent(&self, a: u32, b: u32) -> bool {
        let [few, many] = if self.stars[a as usize].len() < self.stars[b as usize].len() {
            [a, b]
        } else {
            [b, a]
        };
        let has_both = |&t: &u32| {
            self.triangles[t as usize].is_some_and(|c| c.contains(&few) && c.contains(&many))
        };
        self.stars[few as usize].iter().any(has_both)
    }

    /// Whether `from` is on no edge of the body, or moves along the one it is on.
    fn keeps_features(&self, star: &[Side], from: u32, into: u32) -> bool {
        let normal = |s: &Side| {
            let [a, b, c] = [from, s.ends[0], s.ends[1]].map(|v| self.vertices[v as usize]);
            cross(sub(b, a), sub(c, a))
        };
        let sharp: Vec<u32> = star
            .iter()
            .filter_map(|s| {
                let next = star.iter().find(|n| n.ends[0] == s.ends[1])?;
                let (m, n) = (normal(s), normal(next));
                (libm::atan2(norm(cross(m, n)), dot(m, n)) > SHARP).then_some(s.ends[1])
            })
            .collect();
        sharp.is_empty() || (sharp.len() == 2 && sharp.contains(&into))
    }

    /// Whether no triangle turns and the surface stays near all that was merged here.
    fn keeps_surface(&self, kept: &[Side], from: u32, into: u32) -> bool {
        let [old, new] = [from, into].map(|v| self.vertices[v as usize]);
        let steady = |s: &Side| {
            let [a, b] = s.ends.map(|v| self.vertices[v as usize]);
            let (m, n) = (
                cross(sub(a, old), sub(b, old)),
                cross(sub(a, new), sub(b, new)),
            );
            dot(m, n) > STEADY * norm(m) * norm(n)
        };
        let mut quadric = self.quadrics[from as usize];
        quadric.add(&self.quadrics[into as usize]);
        quadric.mean_square(new) < self.deviation * self.deviation && kept.iter().all(steady)
    }

    /// The point of the triangles now at `into` that is nearest to `from`, in their planes.
    fn nearest(&self, kept: &[Side], from: u32, into: u32) -> Option<Merged> {
        let [x, c] = [from, into].map(|v| self.vertices[v as usize]);
        let candidates = kept.iter().map(|s| {
            let [a, b] = s.ends.map(|v| self.vertices[v as usize]);
            let (u, v, w) = (sub(a, c), sub(b, c), sub(x, c));
            let normal = cross(u, v);
            let share = |p: Vec3, q: Vec3| dot(cross(p, q), normal) / dot(normal, normal);
            let (s_a, s_b) = (share(w, v), share(u, w));
            let weights = [1.0 - s_a - s_b, s_a, s_b];
            let outside = weights.iter().fold(0.0, |most: f64, w| most.max(-w));
            (outside, [into, s.ends[0], s.ends[1]], weights)
        });
        let (_, corners, weights) = candidates.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let inside = weights.map(|w| w.max(0.0));
        let total: f64 = inside.iter().sum();
        Some(Merged {
            vertex: from,
            corners,
            weights: inside.map(|w| w / total),
        })
    }
}

/// The side of a triangle across from a vertex.
#[derive(Clone, Copy)]
struct Side {
    triangle: u32,
    ends: [u32; 2],
}

impl Side {
    fn has(&self, v: u32) -> bool {
        self.ends.contains(&v)
    }

    fn other_than(&self, v: u32) -> u32 {
        self.ends[usize::from(self.ends[0] == v)]
    }
}
