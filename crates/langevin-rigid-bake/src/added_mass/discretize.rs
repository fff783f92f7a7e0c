//! From the mesh given to the mesh solved on: fewer needles where they crowd, bisection where it is coarse, a
//! layer at its edges.

use super::coarsen::{Merged, coarsen};
use super::edges::{Edges, folds};
use super::flip::flip_flat_edges;
use super::frame::Frame;
use super::layer::{self, Inserted};
use super::operator::Six;
use super::panels::Vec3;
use super::refine::bisect;
use super::report::Cancel;
use super::{AddedMassError, Options};
use crate::mesh::TriMesh;
use crate::mesh::vector::{bounding_box, dot, norm, sub};
use crate::progress::Progress;

/// Longest edge wanted, in lengths sqrt(area / target triangles).
const LONGEST: f64 = 2.2;
/// A mesh is not bisected into more triangles than this.
const MOST_BISECTED: usize = 20_000;
/// Nor into more than these many times the target and its own number: rods 1 : 4000 take the former.
const MOST_TARGETS: usize = 4;
const MOST_GIVEN: usize = 8;
/// A triangle this many times longer than sqrt(area / triangles) is bisected in fine meshes too.
const OVERLONG: f64 = 5.1;

/// The mesh solved on, in the units of its frame.
pub(super) struct Discretized {
    pub(super) frame: Frame,
    pub(super) vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Number of each vertex before the layer, were none merged: those given come first, in their order.
    kept: Vec<u32>,
    /// The others, in the order in which they were merged.
    merged: Vec<Merged>,
    /// What the edge layer added behind the other vertices.
    pub(super) inserted: Vec<Inserted>,
    /// Whether every edge is one of the mesh only.
    smooth: bool,
    /// Longest edge wanted, where bisection stopped before it (in units).
    pub(super) stopped: Option<f64>,
}

impl Discretized {
    pub(super) fn new(
        mesh: &TriMesh,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Discretized, AddedMassError> {
        let (frame, vertices) = Frame::new(mesh.vertices(), mesh.triangles());
        if !frame.is_in_range() {
            return Err(AddedMassError::Size { size: frame.unit });
        }
        let mut body = Discretized {
            frame,
            vertices,
            triangles: mesh.triangles().to_vec(),
            kept: (0..mesh.vertices().len() as u32).collect(),
            merged: Vec::new(),
            inserted: Vec::new(),
            smooth: mesh.is_smooth(),
            stopped: None,
        };
        if !body.smooth {
            body.divide(options, &Cancel::new(progress, "mesh", 1))?;
        }
        Ok(body)
    }

    fn divide(&mut self, options: &Options, cancel: &Cancel) -> Result<(), AddedMassError> {
        let (given, area) = (self.triangles.len(), self.frame.area);
        let (vertices, triangles) = (&mut self.vertices, &mut self.triangles);
        self.merged = coarsen(vertices, triangles, area, cancel)?;
        let longest = longest_wanted(area, triangles.len(), options.target_triangles);
        // The layer comes on top.
        let limit = (options.max_triangles / 2)
            .min(MOST_BISECTED)
            .min(MOST_GIVEN * given + MOST_TARGETS * options.target_triangles);
        let refined = bisect(vertices, triangles, longest, limit, cancel)?;
        self.stopped = (!refined.complete).then_some(longest);
        let merged = coarsen(vertices, triangles, area, cancel)?;
        if !merged.is_empty() {
            flip_flat_edges(vertices, triangles, cancel)?;
        }
        self.merged.extend(merged);
        self.drop_merged();
        self.inserted = layer::insert(&mut self.vertices, &mut self.triangles);
        Ok(())
    }

    /// Numbers the vertices without those merged, in their order.
    fn drop_merged(&mut self) {
        let mut place = vec![Some(0u32); self.vertices.len()];
        for merged in &self.merged {
            place[merged.vertex as usize] = None;
        }
        let kept: Vec<u32> = (0u32..)
            .zip(&place)
            .filter_map(|(v, p)| p.map(|_| v))
            .collect();
        for (new, &old) in kept.iter().enumerate() {
            place[old as usize] = Some(new as u32);
        }
        self.vertices = kept.iter().map(|&v| self.vertices[v as usize]).collect();
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|v| place[v as usize].unwrap_or_default());
        }
        self.kept = kept;
    }

    /// Vertices before the layer was added.
    pub(super) fn unlayered(&self) -> usize {
        self.vertices.len() - self.inserted.len()
    }

    /// Number of each vertex where the `given` ones come first, merged or not.
    pub(super) fn numbers(&self, given: usize) -> Vec<u32> {
        let kept = self.kept.partition_point(|&v| (v as usize) < given);
        let added = (given as u32..).take(self.vertices.len() - kept);
        self.kept[..kept].iter().copied().chain(added).collect()
    }

    /// Values at the `given` vertices from those at the vertices solved on.
    pub(super) fn at_given(&self, given: usize, solved: &[Six]) -> Vec<Six> {
        let mut values = vec![[0.0; 6]; self.kept.len() + self.merged.len()];
        for (&v, value) in self.kept.iter().zip(solved) {
            values[v as usize] = *value;
        }
        // What a vertex was merged into was merged later, if at all.
        for merged in self.merged.iter().rev() {
            let corners = merged.corners.map(|v| values[v as usize]);
            values[merged.vertex as usize] =
                std::array::from_fn(|c| (0..3).map(|k| merged.weights[k] * corners[k][c]).sum());
        }
        values.truncate(given);
        values
    }

    /// sum of length × size² × |n - n'|² over the edges that are not the body's, where the facets of
    /// a curved surface meet: the energy that linear potentials miss there goes with it.
    pub(super) fn faceting(&self) -> f64 {
        let edges = Edges::new(&self.triangles);
        let longest2 = |t: usize| {
            let sides = edges.sides[t].map(|e| self.length2(edges.ends[e as usize]));
            sides.into_iter().fold(0.0, f64::max)
        };
        folds(&edges, &self.vertices, &self.triangles)
            .iter()
            .filter(|fold| self.smooth || !fold.is_sharp())
            .map(|fold| {
                let [s, t] = fold.triangles;
                let kink = 2.0 * libm::sin(0.5 * fold.turn);
                fold.length * 0.5 * (longest2(s) + longest2(t)) * (kink * kink)
            })
            .sum()
    }

    /// Whether triangles are longer than the body is around: its area over its length.
    pub(super) fn is_needle(&self) -> bool {
        let [low, high] = bounding_box(&self.vertices);
        self.longest() * norm(sub(high, low)) > self.frame.area
    }

    /// Longest edge (in units).
    pub(super) fn longest(&self) -> f64 {
        let sides = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        sides
            .map(|side| self.length2(side))
            .fold(0.0, f64::max)
            .sqrt()
    }

    fn length2(&self, ends: [u32; 2]) -> f64 {
        let [a, b] = ends.map(|v| self.vertices[v as usize]);
        dot(sub(b, a), sub(b, a))
    }
}

fn longest_wanted(area: f64, triangles: usize, target: usize) -> f64 {
    let coarse = LONGEST * (area / target as f64).sqrt();
    if triangles < target {
        coarse
    } else {
        coarse.max(OVERLONG * (area / triangles as f64).sqrt())
    }
}
