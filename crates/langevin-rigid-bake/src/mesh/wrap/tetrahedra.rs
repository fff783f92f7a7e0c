//! Marching tetrahedra, six to a cell: a closed manifold around the nodes that the fluid does not reach.

use std::collections::BTreeMap;

use super::grid::Grid;
use crate::mesh::vector::{add, cross, dot, scale, sub};

/// The orders in which the axes lead from the lowest node of a cell to the highest.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

/// Vertices and triangles, their normals to the fluid.
pub(super) fn surface(grid: &Grid, offset: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut surface = Surface {
        grid,
        offset,
        vertices: Vec::new(),
        triangles: Vec::new(),
        cuts: BTreeMap::new(),
    };
    let [nx, ny, nz] = grid.counts.map(|n| n - 1);
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                surface.cell([i, j, k]);
            }
        }
        // An edge is not met again two layers up.
        let done = grid.number([0, 0, k]);
        surface.cuts = surface.cuts.split_off(&[done, 0]);
    }
    (surface.vertices, surface.triangles)
}

struct Surface<'a> {
    grid: &'a Grid<'a>,
    offset: f64,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The vertex on the edge between two nodes, the lower first.
    cuts: BTreeMap<[usize; 2], u32>,
}

impl Surface<'_> {
    fn cell(&mut self, low: [usize; 3]) {
        let corner = |c: usize| [low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2)];
        let wet = |c: usize| self.grid.level(self.grid.number(corner(c)), self.offset) > 0.0;
        let first = wet(0);
        if (1..8).all(|c| wet(c) == first) {
            return;
        }
        for order in ORDERS {
            let mut at = low;
            let mut nodes = [low; 4];
            for (node, axis) in nodes[1..].iter_mut().zip(order) {
                at[axis] += 1;
                *node = at;
            }
            self.tetrahedron(nodes);
        }
    }

    fn tetrahedron(&mut self, nodes: [[usize; 3]; 4]) {
        let level = |n: &[usize; 3]| self.grid.level(self.grid.number(*n), self.offset);
        let (wet, dry): (Vec<_>, Vec<_>) = nodes.into_iter().partition(|n| level(n) > 0.0);
        let polygon = match (&wet[..], &dry[..]) {
            (&[a], &[p, q, r]) => vec![[a, p], [a, q], [a, r]],
            (&[a, b, c], &[p]) => vec![[a, p], [b, p], [c, p]],
            (&[a, b], &[p, q]) => vec![[a, p], [a, q], [b, q], [b, p]],
            _ => return,
        };
        let cuts: Vec<u32> = polygon.iter().map(|&edge| self.cut(edge)).collect();
        let outward = sub(self.grid.place(wet[0]), self.grid.place(dry[0]));
        for k in 1..cuts.len() - 1 {
            let t = [cuts[0], cuts[k], cuts[k + 1]];
            let [a, b, c] = t.map(|v| self.vertices[v as usize]);
            let along = dot(cross(sub(b, a), sub(c, a)), outward) > 0.0;
            self.triangles
                .push(if along { t } else { [t[0], t[2], t[1]] });
        }
    }

    fn cut(&mut self, [wet, dry]: [[usize; 3]; 2]) -> u32 {
        let numbers = [wet, dry].map(|n| self.grid.number(n));
        let key = [numbers[0].min(numbers[1]), numbers[0].max(numbers[1])];
        if let Some(&vertex) = self.cuts.get(&key) {
            return vertex;
        }
        let [above, below] = numbers.map(|n| self.grid.level(n, self.offset));
        // Away from the nodes, where triangles would have no area.
        let share = (above / (above - below)).clamp(0.05, 0.95);
        let [from, to] = [wet, dry].map(|n| self.grid.place(n));
        let vertex = self.vertices.len() as u32;
        self.vertices.push(add(from, scale(share, sub(to, from))));
        self.cuts.insert(key, vertex);
        vertex
    }
}
