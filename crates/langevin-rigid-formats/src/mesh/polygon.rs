//! Polygons of any number of corners, cut into triangles.
//!
//! A polygon that its first corner sees all of, as every convex one, becomes a fan. Any other gets the
//! constrained Delaunay triangulation of its outline, seen along the axis nearest to its normal: no
//! coordinate is rounded, and corners on a straight side stay corners, so neighbours keep their edges.

use std::collections::BTreeMap;

use spade::handles::{FaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Sine of the angle at the first corner below which a triangle of a fan counts as having no area.
const SLENDER: f64 = 1e-9;
/// Most corners of a polygon that is no fan: it bounds the time, which may grow as its square.
const MOST_CORNERS: usize = 1 << 20;
/// What counts as zero: the triangulation takes no numbers smaller than 2^-142.
const TINY: f64 = 1e-42;

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The polygons of a file, by vertex numbers.
#[derive(Debug, Default)]
pub(super) struct Polygons {
    corners: Vec<u32>,
    /// Where in `corners` each polygon ends.
    ends: Vec<usize>,
    /// Where in `corners` a hole begins, of the polygon that it is in.
    holes: Vec<usize>,
}

impl Polygons {
    pub(super) fn push(&mut self, corners: impl IntoIterator<Item = u32>) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len());
    }

    /// A hole in the polygon pushed last, running either way.
    #[cfg(any(test, feature = "collada"))]
    pub(super) fn push_hole(&mut self, corners: impl IntoIterator<Item = u32>) {
        self.holes.push(self.corners.len());
        self.corners.extend(corners);
        if let Some(end) = self.ends.last_mut() {
            *end = self.corners.len();
        }
    }

    /// The corners of all polygons.
    pub(super) fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The triangles, wound as their polygons, and what there is to say about some of them. All corners
    /// are numbers of `vertices`.
    pub(super) fn triangles(&self, vertices: &[[f64; 3]]) -> (Vec<[u32; 3]>, Option<String>) {
        let mut triangles =
            Vec::with_capacity(self.corners.len().saturating_sub(2 * self.ends.len()));
        let mut bad = Vec::new();
        let mut start = 0;
        let mut holes = self.holes.iter().copied().peekable();
        for (number, &end) in self.ends.iter().enumerate() {
            let corners = &self.corners[start..end];
            let mut rings = vec![0];
            while let Some(hole) = holes.next_if(|&hole| hole < end) {
                rings.push(hole - start);
            }
            rings.push(corners.len());
            match (corners.len() > 3).then(|| cut(corners, &rings, vertices)) {
                Some(Some(cut)) => triangles.extend(cut),
                Some(None) => {
                    bad.push(number);
                    triangles.extend(fan(&corners[..rings[1]]));
                }
                None => triangles.extend(fan(corners)),
            }
            start = end;
        }
        let notice = bad.first().map(|first| {
            format!(
                "{} of {} faces, the first number {}, cross themselves, have no area or have more than \
                 {MOST_CORNERS} corners: they became fans of triangles from their first corner; if that is \
                 not their shape, triangulate them before exporting",
                bad.len(),
                self.ends.len(),
                first + 1
            )
        });
        (triangles, notice)
    }
}

/// Triangles of a polygon as a fan from its first corner.
pub(super) fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let rim = corners.get(1..).unwrap_or_default();
    rim.windows(2).map(|pair| [corners[0], pair[0], pair[1]])
}

/// Triangles of a strip, wound as its first.
pub(super) fn strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let wound = |(i, w): (usize, &[u32])| match i % 2 {
        0 => [w[0], w[1], w[2]],
        _ => [w[0], w[2], w[1]],
    };
    corners.windows(3).enumerate().map(wound)
}

/// The vertices among `corners`, increasing; the triangles over them become triangles over their places.
pub(super) fn renumber_used(corners: Vec<u32>, triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let mut used = corners;
    used.sort_unstable();
    used.dedup();
    // Most surfaces use every vertex there is.
    if used.last().is_some_and(|&last| last as usize >= used.len()) {
        for corner in triangles.as_flattened_mut() {
            *corner = used.partition_point(|v| v < corner) as u32;
        }
    }
    used
}

/// Triangles that cover a polygon once but for its holes; nothing where there are none. The outer ring is
/// between the first and the second of `rings`, each hole between two of the others.
fn cut(corners: &[u32], rings: &[usize], vertices: &[[f64; 3]]) -> Option<Vec<[u32; 3]>> {
    let mut places: Vec<[f64; 3]> = corners.iter().map(|&v| vertices[v as usize]).collect();
    let mut outline = flattened(&places, rings[1])?;
    if rings.len() == 2 && is_fan(&outline) {
        return Some(fan(corners).collect());
    }
    if corners.len() > MOST_CORNERS {
        return None;
    }
    let mut corners = corners.to_vec();
    for hole in rings[1..].windows(2).map(|ends| ends[0]..ends[1]) {
        if doubled_area(&outline[hole.clone()]) > 0.0 {
            outline[hole.clone()].reverse();
            places[hole.clone()].reverse();
            corners[hole].reverse();
        }
    }
    let cut = Outline::new(&places, &outline, rings)?.triangulated()?;
    Some(cut.iter().map(|t| t.map(|i| corners[i])).collect())
}

/// Twice the area of a polygon, positive where it runs counter-clockwise.
fn doubled_area(outline: &[[f64; 2]]) -> f64 {
    let arm = |p: &[f64; 2]| [p[0] - outline[0][0], p[1] - outline[0][1]];
    let pairs = outline
        .windows(2)
        .map(|pair| (arm(&pair[0]), arm(&pair[1])));
    pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

/// The polygon seen against the axis nearest to the normal (Newell's) of its first `outer` corners, so that
/// these run counter-clockwise; nothing without corners.
fn flattened(places: &[[f64; 3]], outer: usize) -> Option<Vec<[f64; 2]>> {
    let from = *places.first()?;
    let arm = |p: [f64; 3]| [p[0] - from[0], p[1] - from[1], p[2] - from[2]];
    let mut normal = [0.0; 3];
    for pair in places[..outer].windows(2) {
        let (a, b) = (arm(pair[0]), arm(pair[1]));
        for (k, x) in normal.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            *x += a[i] * b[j] - a[j] * b[i];
        }
    }
    let [x, y, z] = normal.map(f64::abs);
    let along = if x > y && x > z {
        0
    } else {
        1 + usize::from(z >= y)
    };
    let (i, j) = ((along + 1) % 3, (along + 2) % 3);
    let (i, j) = if normal[along] < 0.0 { (j, i) } else { (i, j) };
    let snap = |x: f64| if x.abs() < TINY { 0.0 } else { x };
    Some(places.iter().map(|p| [snap(p[i]), snap(p[j])]).collect())
}

/// Whether the first corner sees every side from the left, going around it less than once.
fn is_fan(outline: &[[f64; 2]]) -> bool {
    let arm = |p: &[f64; 2]| [p[0] - outline[0][0], p[1] - outline[0][1]];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let length = |a: [f64; 2]| libm::hypot(a[0], a[1]);
    let first = arm(&outline[1]);
    let mut turned_back = false;
    outline[1..].windows(2).all(|pair| {
        let (a, b) = (arm(&pair[0]), arm(&pair[1]));
        let left = cross(first, b) > 0.0;
        let again = turned_back && left;
        turned_back |= !left;
        !again && cross(a, b) > SLENDER * length(a) * length(b)
    })
}

/// A polygon in the plane whose corners at one place are one point.
struct Outline {
    points: Vec<Point2<f64>>,
    /// The first corner at each point.
    corner: Vec<usize>,
    /// The pairs of points with a side between them, the lower first, and how often the outline runs from
    /// the lower to the higher more than back.
    runs: BTreeMap<[usize; 2], i64>,
}

impl Outline {
    /// Nothing where corners at different places are seen at one.
    fn new(places: &[[f64; 3]], outline: &[[f64; 2]], rings: &[usize]) -> Option<Outline> {
        let mut points = Vec::new();
        let mut corner: Vec<usize> = Vec::new();
        let mut known = BTreeMap::new();
        let mut point = Vec::with_capacity(outline.len());
        for (i, &[x, y]) in outline.iter().enumerate() {
            // Adding +0 turns −0 into 0.
            let key = [x + 0.0, y + 0.0].map(f64::to_bits);
            let p: usize = *known.entry(key).or_insert_with(|| {
                points.push(Point2::new(x, y));
                corner.push(i);
                points.len() - 1
            });
            if places[corner[p]] != places[i] {
                return None;
            }
            point.push(p);
        }
        let mut runs = BTreeMap::new();
        for ring in rings.windows(2).map(|ends| &point[ends[0]..ends[1]]) {
            for (i, &a) in ring.iter().enumerate() {
                let b = ring[(i + 1) % ring.len()];
                if a != b {
                    *runs.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
            }
        }
        Some(Outline {
            points,
            corner,
            runs,
        })
    }

    /// Triangles of what the outline runs around once, by corners; nothing where it crosses itself, runs
    /// around a place twice or clockwise, or has a corner on a side that is not its own.
    fn triangulated(&self) -> Option<Vec<[usize; 3]>> {
        let sides = self.runs.keys().copied().collect();
        let mut crosses = false;
        let mesh =
            Delaunay::try_bulk_load_cdt(self.points.clone(), sides, |_| crosses = true).ok()?;
        let is_side = |e: [usize; 2]| self.runs.contains_key(&[e[0].min(e[1]), e[0].max(e[1])]);
        let there = mesh.undirected_edges();
        let there = there.filter(|e| is_side(e.vertices().map(|v| v.index())));
        if crosses || there.count() < self.runs.len() {
            return None;
        }
        let winding = self.winding_numbers(&mesh);
        let mut triangles = Vec::new();
        for face in mesh.inner_faces() {
            match winding[face.index()] {
                0 => {}
                1 => triangles.push(face.vertices().map(|v| self.corner[v.index()])),
                _ => return None,
            }
        }
        (!triangles.is_empty()).then_some(triangles)
    }

    /// How often the outline runs around each face counter-clockwise.
    fn winding_numbers(&self, mesh: &Delaunay) -> Vec<i64> {
        let mut winding = vec![0; mesh.num_all_faces()];
        let mut known = vec![false; mesh.num_all_faces()];
        let mut next: Vec<(FaceHandle<'_, InnerTag, _, _, _, _>, i64)> = Vec::new();
        for edge in mesh.convex_hull() {
            let inside = if edge.is_outer_edge() {
                edge.rev()
            } else {
                edge
            };
            if let Some(face) = inside.face().as_inner() {
                next.push((face, self.run(inside.from().index(), inside.to().index())));
            }
        }
        while let Some((face, around)) = next.pop() {
            if std::mem::replace(&mut known[face.index()], true) {
                continue;
            }
            winding[face.index()] = around;
            for edge in face.adjacent_edges() {
                if let Some(beyond) = edge.rev().face().as_inner() {
                    let run = self.run(edge.from().index(), edge.to().index());
                    next.push((beyond, around - run));
                }
            }
        }
        winding
    }

    /// How often the outline runs from one point to another more than back.
    fn run(&self, from: usize, to: usize) -> i64 {
        let forward = self.runs.get(&[from.min(to), from.max(to)]).copied();
        let forward = forward.unwrap_or(0);
        if from < to { forward } else { -forward }
    }
}

#[cfg(test)]
mod tests;
