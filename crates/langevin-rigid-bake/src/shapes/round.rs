//! Discs, plates, cylinders, coins and washers: prisms over a circle, an ellipse or an annulus.
//!
//! The two ends carry concentric rings of near-equal triangles, the walls rows of quadrilaterals
//! split in two. Rings have a multiple of four vertices and each quadrant mirrors its neighbour,
//! so the mesh has the symmetry of the body.

use std::f64::consts::{FRAC_PI_2, PI};

use super::ShapeError;
use super::builder::Builder;
use crate::mesh::TriMesh;

/// Arc between neighbours on a ring over the distance of rings: six vertices more per ring, as in
/// the hexagonal lattice.
const ARC: f64 = PI / 3.0;

/// A prism along `axis` over the ellipse with the given semi-axes, without the similar ellipse
/// `hole` times as large (0 for none).
pub(super) struct Prism {
    /// Semi-axes of the ellipse along the two axes that follow `axis` cyclically (m).
    pub(super) semi_axes: [f64; 2],
    pub(super) hole: f64,
    pub(super) height: f64,
    pub(super) axis: usize,
}

impl Prism {
    /// Fewest triangles: every ring an octagon.
    pub(super) fn fewest(&self) -> usize {
        if self.hole > 0.0 { 64 } else { 32 }
    }

    pub(super) fn mesh(&self, triangles: usize) -> Result<TriMesh, ShapeError> {
        let layout = self.layout(triangles);
        let mut surface = Builder::new(|place| self.position(&layout, place));
        for inner in 0..layout.rings() {
            for quadrant in 0..4 {
                let [near, far] = [inner, inner + 1].map(|r| layout.arc(r, quadrant));
                let mirrored = quadrant % 2 == 1;
                surface.strip(&at_level(&near, 0), &at_level(&far, 0), !mirrored);
                let top = layout.rows;
                surface.strip(&at_level(&near, top), &at_level(&far, top), mirrored);
            }
        }
        add_wall(&mut surface, &layout, layout.rings(), false);
        if self.hole > 0.0 {
            add_wall(&mut surface, &layout, 0, true);
        }
        surface.finish()
    }

    /// Coordinates of a place: ring, level, number on the ring.
    ///
    /// Each ring is widened until its polygon has the area of its ellipse.
    fn position(&self, layout: &Layout, [ring, level, i]: [usize; 3]) -> [f64; 3] {
        // Exactly antisymmetric about the middle.
        let along = ((2 * level) as f64 - layout.rows as f64) / (2 * layout.rows) as f64;
        let [u, v] = if layout.quarters[ring] == 0 {
            [0.0, 0.0]
        } else {
            let n = (4 * layout.quarters[ring]) as f64;
            let widened = (2.0 * PI / (n * libm::sin(2.0 * PI / n))).sqrt();
            let radius = widened * self.radius(ring, layout.rings());
            unit_circle(i, layout.quarters[ring]).map(|x| radius * x)
        };
        let mut position = [0.0; 3];
        position[self.axis] = self.height * along;
        position[(self.axis + 1) % 3] = self.semi_axes[0] * u;
        position[(self.axis + 2) % 3] = self.semi_axes[1] * v;
        position
    }

    /// Radius of a ring over that of the outermost.
    fn radius(&self, ring: usize, rings: usize) -> f64 {
        self.hole + (1.0 - self.hole) * ring as f64 / rings as f64
    }

    /// Rings, rows and vertices per quadrant that come nearest to the wished number of triangles
    /// with triangles near equilateral.
    fn layout(&self, triangles: usize) -> Layout {
        let wish = triangles as f64;
        let rings = self.rings(wish);
        let scale = wish / self.ideal(rings);
        let quarter = |ring| (scale * self.ideal_quarter(ring, rings)).round().max(2.0);
        let outer = quarter(rings);
        let inner = if self.hole > 0.0 {
            self.inner_quarter(outer, quarter(0))
        } else {
            0.0
        };
        let mut rows = self.ideal_rows(rings);
        if rings == 1 && rows > 1.0 {
            // A body longer than the wished triangles can cover: stretch them along it.
            rows = (wish / (8.0 * (outer + inner)) - 1.0).round().max(1.0);
        }
        let within = (wish - 8.0 * (1.0 + rows) * (outer + inner)) / 16.0;
        let mut quarters = vec![inner as usize];
        quarters.extend(self.share_out(within.round(), rings));
        quarters.push(outer as usize);
        Layout {
            quarters,
            rows: rows as usize,
        }
    }

    /// Vertices per quadrant at the hole: as many as at the outside where the ring is so narrow
    /// that polygons of different number would cross.
    fn inner_quarter(&self, outer: f64, wished: f64) -> f64 {
        let wished = wished.min(outer);
        let sagitta = 1.0 - libm::cos(FRAC_PI_2 / wished);
        if 1.0 - self.hole < 2.0 * sagitta {
            outer
        } else {
            wished
        }
    }

    /// Shares `total` vertices per quadrant out among the rings between the first and the last,
    /// in proportion to their radii.
    fn share_out(&self, total: f64, rings: usize) -> Vec<usize> {
        let weights: Vec<f64> = (1..rings).map(|r| self.radius(r, rings)).collect();
        let sum: f64 = weights.iter().sum();
        let (mut reached, mut given) = (0.0, 0.0);
        let mut share = |weight: f64| {
            reached += weight;
            let quarter = ((total * reached / sum).round() - given).max(1.0);
            given += quarter;
            quarter as usize
        };
        weights.into_iter().map(&mut share).collect()
    }

    /// The number of rings whose ideal number of triangles is nearest to the wish.
    fn rings(&self, wish: f64) -> usize {
        let mut rings = 1;
        while (self.ideal(rings + 1) - wish).abs() < (self.ideal(rings) - wish).abs() {
            rings += 1;
        }
        rings
    }

    /// Number of triangles with `rings` rings and arcs as long as [`ARC`] says.
    fn ideal(&self, rings: usize) -> f64 {
        let quarter = |ring| self.ideal_quarter(ring, rings);
        let within: f64 = (1..rings).map(quarter).sum();
        16.0 * within + 8.0 * (1.0 + self.ideal_rows(rings)) * (quarter(0) + quarter(rings))
    }

    fn ideal_quarter(&self, ring: usize, rings: usize) -> f64 {
        let distance = (1.0 - self.hole) / rings as f64;
        FRAC_PI_2 * self.radius(ring, rings) / (ARC * distance)
    }

    fn ideal_rows(&self, rings: usize) -> f64 {
        let mean_semi_axis = (self.semi_axes[0] * self.semi_axes[1]).sqrt();
        let arc = ARC * mean_semi_axis * (1.0 - self.hole) / rings as f64;
        (self.height / arc).round().max(1.0)
    }
}

/// Numbers of vertices of a prism's surface.
struct Layout {
    /// Vertices per quadrant of each ring from the inside out; 0 for a centre.
    quarters: Vec<usize>,
    /// Rows of quadrilaterals along the walls.
    rows: usize,
}

impl Layout {
    fn rings(&self) -> usize {
        self.quarters.len() - 1
    }

    /// The vertices of a ring along a quadrant, away from the first axis in either direction.
    fn arc(&self, ring: usize, quadrant: usize) -> Vec<[usize; 2]> {
        let n = self.quarters[ring];
        let mirrored = quadrant % 2 == 1;
        let number = |i: usize| {
            if mirrored {
                (quadrant + 1) * n - i
            } else {
                quadrant * n + i
            }
        };
        (0..=n)
            .map(|i| [ring, number(i) % (4 * n).max(1)])
            .collect()
    }
}

fn at_level(arc: &[[usize; 2]], level: usize) -> Vec<[usize; 3]> {
    arc.iter().map(|&[ring, i]| [ring, level, i]).collect()
}

fn add_wall<P: Fn([usize; 3]) -> [f64; 3]>(
    surface: &mut Builder<P>,
    layout: &Layout,
    ring: usize,
    inward: bool,
) {
    for quadrant in 0..4 {
        let arc = layout.arc(ring, quadrant);
        let mirrored = quadrant % 2 == 1;
        for row in 0..layout.rows {
            for pair in arc.windows(2) {
                let [a, b] = [0, 1].map(|k| [ring, row, pair[k][1]]);
                let [c, d] = [1, 0].map(|k| [ring, row + 1, pair[k][1]]);
                surface.quad([a, b, c, d], 2 * row >= layout.rows, mirrored != inward);
            }
        }
    }
}

/// The i-th of 4n points on the unit circle, with exact symmetry between quadrants.
fn unit_circle(i: usize, n: usize) -> [f64; 2] {
    let (quadrant, step) = (i / n, i % n);
    let cos = |step: usize| {
        // The angle from the nearer axis, so that equal steps give equal bits.
        if 2 * step <= n {
            libm::cos(FRAC_PI_2 * step as f64 / n as f64)
        } else {
            libm::sin(FRAC_PI_2 * (n - step) as f64 / n as f64)
        }
    };
    let [c, s] = [cos(step), cos(n - step)];
    match quadrant {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}
