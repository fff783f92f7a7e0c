//! Edge topology.

/// An edge of a closed mesh and the two triangles it joins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// Vertex numbers, the lower first.
    pub vertices: [u32; 2],
    /// Triangle numbers: the one that runs from the lower vertex to the higher, then the other.
    pub triangles: [u32; 2],
}

/// One side of one triangle, keyed by its unordered vertex pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// Vertex numbers, the lower first.
    pub(super) vertices: [u32; 2],
    /// Whether the triangle runs from the higher vertex to the lower.
    pub(super) backward: bool,
    pub(super) triangle: u32,
}

impl Side {
    /// From and to, as the triangle runs.
    pub(super) fn run(&self) -> [u32; 2] {
        let [low, high] = self.vertices;
        if self.backward {
            [high, low]
        } else {
            [low, high]
        }
    }
}

/// The sides of all triangles, sorted so that those of one edge are neighbours.
pub(super) fn sorted_sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides: Vec<Side> = (0u32..)
        .zip(triangles)
        .flat_map(|(triangle, &[a, b, c])| {
            [[a, b], [b, c], [c, a]].map(|[from, to]| Side {
                vertices: [from.min(to), from.max(to)],
                backward: from > to,
                triangle,
            })
        })
        .collect();
    sides.sort_unstable();
    sides
}

/// The sides grouped by edge.
pub(super) fn by_edge(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.vertices == b.vertices)
}

/// The sides of one edge, its lower vertex first.
pub(super) fn of_edge(sides: &[Side], edge: [u32; 2]) -> &[Side] {
    let from = sides.partition_point(|s| s.vertices < edge);
    let count = sides[from..].partition_point(|s| s.vertices == edge);
    &sides[from..from + count]
}

/// Two triangles agree where they run along their edge in opposite directions.
pub(super) fn disagree(edge: &[Side]) -> bool {
    edge.len() == 2 && edge[0].backward == edge[1].backward
}

/// The edges of a mesh already known to be a closed oriented manifold.
pub(super) fn of_closed(triangles: &[[u32; 3]]) -> Vec<Edge> {
    let edge = |pair: &[Side]| Edge {
        vertices: pair[0].vertices,
        triangles: [pair[0].triangle, pair[1].triangle],
    };
    sorted_sides(triangles).chunks_exact(2).map(edge).collect()
}

/// Number of edges that belong to one triangle only: zero for a closed surface.
///
/// Readers use it to see whether a file's own vertex numbering already closes the surface.
pub fn open_edge_count(triangles: &[[u32; 3]]) -> usize {
    by_edge(&sorted_sides(triangles))
        .filter(|edge| edge.len() == 1)
        .count()
}
