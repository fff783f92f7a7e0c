//! The surface as flat panels with the gradients of the three potentials of translation.

use langevin_rigid::linalg::Vec3;

use crate::added_mass::Surface;
use crate::mesh::vector::{add, cross, dot, norm, scale, sub};

/// A triangle of the surface.
pub(super) struct Panel {
    /// Outward unit normal.
    pub(super) normal: Vec3,
    /// Area (m^2).
    pub(super) area: f64,
    /// Middles of the three edges (m): exact nodes for second moments.
    pub(super) middles: [Vec3; 3],
    /// Surface gradients of the potentials of unit velocity along x, y, z.
    gradients: [Vec3; 3],
    /// Potentials of the six unit motions at `middles` (m, m^2).
    pub(super) potentials: [[f64; 6]; 3],
}

/// All triangles that have an area.
pub(super) struct Panels(pub(super) Vec<Panel>);

impl Panels {
    pub(super) fn of(surface: &Surface) -> Panels {
        let panel = |t: &[u32; 3]| Panel::of(surface, t.map(|v| v as usize));
        Panels(surface.triangles.iter().filter_map(panel).collect())
    }
}

impl Panel {
    fn of(surface: &Surface, vertices: [usize; 3]) -> Option<Panel> {
        let [a, b, c] = vertices.map(|v| surface.vertices[v]);
        let twice = cross(sub(b, a), sub(c, a));
        let size = norm(twice);
        if size == 0.0 {
            return None;
        }
        let normal = scale(1.0 / size, twice);
        let hats = [sub(c, b), sub(a, c), sub(b, a)].map(|e| scale(1.0 / size, cross(normal, e)));
        let gradient = |k: usize| {
            let terms = [0, 1, 2].map(|i| scale(surface.potentials[vertices[i]][k], hats[i]));
            add(add(terms[0], terms[1]), terms[2])
        };
        Some(Panel {
            normal,
            area: 0.5 * size,
            middles: [[a, b], [b, c], [c, a]].map(|[p, q]| scale(0.5, add(p, q))),
            gradients: [gradient(0), gradient(1), gradient(2)],
            potentials: [[0, 1], [1, 2], [2, 0]].map(|pair| {
                let [p, q] = pair.map(|i: usize| surface.potentials[vertices[i]]);
                std::array::from_fn(|k| 0.5 * (p[k] + q[k]))
            }),
        })
    }

    /// Squared speed of the fluid along the surface, relative to a body that moves along the unit
    /// vector `direction`, with the potential taken `share` times.
    pub(super) fn squared_slip(&self, direction: Vec3, share: f64) -> f64 {
        let [x, y, z] = self.gradients;
        let gradient = add(
            add(scale(direction[0], x), scale(direction[1], y)),
            scale(direction[2], z),
        );
        let tangential = sub(direction, scale(dot(direction, self.normal), self.normal));
        let slip = sub(scale(share, gradient), tangential);
        dot(slip, slip)
    }
}
