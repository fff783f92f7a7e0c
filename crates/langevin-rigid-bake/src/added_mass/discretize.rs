//! From the mesh given to the mesh solved on: bisection where it is coarse, a layer at its edges.

use super::Options;
use super::edges::{Edges, folds};
use super::frame::Frame;
use super::layer::{self, Inserted};
use super::panels::Vec3;
use super::refine::bisect;
use crate::mesh::TriMesh;
use crate::mesh::vector::{dot, sub};

/// Longest edge wanted, in lengths sqrt(area / target triangles).
const LONGEST: f64 = 2.2;
/// A mesh is not bisected into more triangles than this.
const MOST_BISECTED: usize = 20_000;
/// A triangle this many times longer than sqrt(area / triangles) is bisected in fine meshes too.
const OVERLONG: f64 = 5.1;

/// The mesh solved on, in the units of its frame.
pub(super) struct Discretized {
    pub(super) frame: Frame,
    pub(super) vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// What the edge layer added behind the other vertices.
    pub(super) inserted: Vec<Inserted>,
    /// Whether every edge is one of the mesh only.
    smooth: bool,
    /// Longest edge wanted, where bisection stopped before it (in units).
    pub(super) stopped: Option<f64>,
}

impl Discretized {
    pub(super) fn new(mesh: &TriMesh, options: &Options) -> Discretized {
        let (frame, mut vertices) = Frame::new(mesh.vertices(), mesh.triangles());
        let mut triangles = mesh.triangles().to_vec();
        let mut stopped = None;
        let mut inserted = Vec::new();
        if !mesh.is_smooth() {
            let longest = longest_wanted(frame.area, triangles.len(), options.target_triangles);
            // The layer comes on top.
            let limit = (options.max_triangles / 2).min(MOST_BISECTED);
            let refined = bisect(&mut vertices, &mut triangles, longest, limit);
            stopped = (!refined.complete).then_some(longest);
            inserted = layer::insert(&mut vertices, &mut triangles);
        }
        Discretized {
            frame,
            vertices,
            triangles,
            inserted,
            smooth: mesh.is_smooth(),
            stopped,
        }
    }

    /// Vertices before the layer was added.
    pub(super) fn unlayered(&self) -> usize {
        self.vertices.len() - self.inserted.len()
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
