//! Panels in a tree of clusters, and which clusters see each other from afar.

use std::ops::Range;

use super::near::NEAR2;
use super::panels::{Panel, Vec3};
use crate::mesh::vector::{add, bounding_box, dot, scale, sub};

/// Panels of a leaf, at most.
const LEAF: usize = 64;
/// Two clusters are far from each other where their radii sum to at most this share of the distance.
const OPENING: f64 = 0.6;

/// A cluster of panels.
pub(super) struct Cluster {
    /// Its panels, as places in [`Clusters::order`].
    pub(super) range: Range<usize>,
    pub(super) centre: Vec3,
    /// Its panels lie within.
    radius: f64,
    /// Longest edge of its panels.
    longest: f64,
    pub(super) parent: Option<usize>,
    children: Option<[usize; 2]>,
}

/// The tree; a cluster comes before its children.
pub(super) struct Clusters {
    pub(super) clusters: Vec<Cluster>,
    /// Panels, cluster by cluster.
    pub(super) order: Vec<u32>,
    /// For each cluster, those whose panels act on its own through expansions, but not on its
    /// parent's.
    pub(super) far: Vec<Vec<u32>>,
    /// Pairs of leaves, the earlier first, whose panels act on each other one by one.
    pub(super) near: Vec<[u32; 2]>,
}

impl Clusters {
    pub(super) fn new(panels: &[Panel]) -> Clusters {
        let mut tree = Clusters {
            clusters: Vec::new(),
            order: (0..panels.len() as u32).collect(),
            far: Vec::new(),
            near: Vec::new(),
        };
        tree.grow(0..panels.len(), None, panels);
        tree.far = vec![Vec::new(); tree.clusters.len()];
        tree.pair(0, 0);
        tree
    }

    /// Whether cluster `c` has no children.
    pub(super) fn is_leaf(&self, c: usize) -> bool {
        self.clusters[c].children.is_none()
    }

    /// The panels of cluster `c`.
    pub(super) fn panels(&self, c: usize) -> &[u32] {
        &self.order[self.clusters[c].range.clone()]
    }

    /// Adds the cluster of a range and all below it, split at the middle of its longest side.
    fn grow(&mut self, range: Range<usize>, parent: Option<usize>, panels: &[Panel]) -> usize {
        let centroids: Vec<Vec3> = self.order[range.clone()]
            .iter()
            .map(|&p| panels[p as usize].centroid)
            .collect();
        let [low, high] = bounding_box(&centroids);
        let centre = scale(0.5, add(low, high));
        let index = self.clusters.len();
        let members = &mut self.order[range.clone()];
        let reach2 = |p: &Panel| {
            let corners = p.points.iter().map(|&x| sub(x, centre));
            corners.map(|x| dot(x, x)).fold(0.0, f64::max)
        };
        let (mut radius2, mut longest2) = (0.0f64, 0.0f64);
        for &p in members.iter() {
            radius2 = radius2.max(reach2(&panels[p as usize]));
            longest2 = longest2.max(panels[p as usize].longest2);
        }
        self.clusters.push(Cluster {
            range: range.clone(),
            centre,
            radius: radius2.sqrt(),
            longest: longest2.sqrt(),
            parent,
            children: None,
        });
        if range.len() > LEAF {
            let side = |k: usize| high[k] - low[k];
            let axis = (1..3).fold(0, |best, k| if side(k) > side(best) { k } else { best });
            let along = |&p: &u32| panels[p as usize].centroid[axis];
            let half = range.len() / 2;
            members
                .select_nth_unstable_by(half, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
            let middle = range.start + half;
            // In order within a half, whatever the selection left.
            let halves = [range.start..middle, middle..range.end];
            for half in &halves {
                self.order[half.clone()].sort_unstable();
            }
            self.clusters[index].children =
                Some(halves.map(|half| self.grow(half, Some(index), panels)));
        }
        index
    }

    /// Sorts the pairs of panels of clusters `a` and `b` into far and near ones.
    fn pair(&mut self, a: usize, b: usize) {
        if a == b {
            match self.clusters[a].children {
                None => self.near.push([a as u32; 2]),
                Some([c, d]) => {
                    self.pair(c, c);
                    self.pair(c, d);
                    self.pair(d, d);
                }
            }
            return;
        }
        let (one, other) = (&self.clusters[a], &self.clusters[b]);
        if one.sees_from_afar(other) {
            self.far[a].push(b as u32);
            self.far[b].push(a as u32);
            return;
        }
        let larger_first = one.radius >= other.radius;
        match (one.children, other.children) {
            (Some(children), other) if larger_first || other.is_none() => {
                children.into_iter().for_each(|c| self.pair(c, b));
            }
            (_, Some(children)) => {
                children.into_iter().for_each(|c| self.pair(a, c));
            }
            _ => self.near.push([a.min(b) as u32, a.max(b) as u32]),
        }
    }
}

impl Cluster {
    /// Whether expansions are good enough between the two, and no pair of their panels is near.
    fn sees_from_afar(&self, other: &Cluster) -> bool {
        let d = sub(self.centre, other.centre);
        let distance = dot(d, d).sqrt();
        let reach = self.radius + other.radius;
        let near = NEAR2.sqrt() * self.longest.max(other.longest);
        reach <= OPENING * distance && distance - reach > near
    }
}
