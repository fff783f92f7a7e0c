//! The surface of a body as it is drawn, and the pressure on it.

use std::collections::BTreeMap;

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, cross, dot, norm, scale, sub};
use langevin_rigid::{Body, State, Surface};

use crate::session::Session;

/// Cosine of the angle between two faces beyond which the edge between them is drawn sharp: 40 degrees.
const SHARP: f64 = 0.766;

/// The faces of a body with vertices for drawing: one for each smooth part of the surface that meets there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Skin {
    /// Positions from the centre of mass (m), body frame.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, outwards.
    pub normals: Vec<[f32; 3]>,
    /// Corners of each face.
    pub triangles: Vec<[u32; 3]>,
    /// The faces around each vertex with their shares.
    around: Vec<Vec<(u32, f32)>>,
}

impl Skin {
    /// The skin of a body, of its panels.
    pub fn new(body: &Body) -> Self {
        Self::of(&body.surface, &body.surface.panels)
    }

    /// The skin of the triangles that the body was given as: fewer, for bodies of which there are many. There is no pressure
    /// on it.
    pub fn coarse(body: &Body) -> Self {
        Self::of(&body.surface, &body.surface.triangles)
    }

    fn of(surface: &Surface, faces: &[[u32; 3]]) -> Self {
        let areas: Vec<Vec3> = faces
            .iter()
            .map(|panel| {
                let [a, b, c] = panel.map(|vertex| surface.vertices[vertex as usize]);
                scale(0.5, cross(sub(b, a), sub(c, a)))
            })
            .collect();
        let mut corners: BTreeMap<u32, Vec<(usize, usize)>> = BTreeMap::new();
        for (panel, vertices) in faces.iter().enumerate() {
            for (corner, vertex) in vertices.iter().enumerate() {
                corners.entry(*vertex).or_default().push((panel, corner));
            }
        }
        let mut skin = Self {
            triangles: vec![[0; 3]; faces.len()],
            ..Self::default()
        };
        for (vertex, corners) in corners {
            for part in smooth_parts(&corners, &areas) {
                let number = skin.positions.len() as u32;
                for &(panel, corner) in &part {
                    skin.triangles[panel][corner] = number;
                }
                let position = surface.vertices[vertex as usize];
                skin.push(position, &part, &areas);
            }
        }
        skin
    }

    fn push(&mut self, position: Vec3, part: &[(usize, usize)], areas: &[Vec3]) {
        let sum = part
            .iter()
            .fold([0.0; 3], |sum, (panel, _)| add(sum, areas[*panel]));
        let whole: f64 = part.iter().map(|(panel, _)| norm(areas[*panel])).sum();
        let share = |panel: usize| match whole > 0.0 {
            true => norm(areas[panel]) / whole,
            false => 1.0 / part.len() as f64,
        };
        let around = part
            .iter()
            .map(|&(panel, _)| (panel as u32, share(panel) as f32));
        self.positions.push(position.map(|x| x as f32));
        self.normals.push(unit(sum).map(|x| x as f32));
        self.around.push(around.collect());
    }

    /// A number for each vertex from one for each panel.
    pub fn spread(&self, of_panels: &[f64]) -> Vec<f32> {
        let mean = |around: &Vec<(u32, f32)>| {
            let parts = around.iter();
            parts
                .map(|&(panel, share)| {
                    share * of_panels.get(panel as usize).map_or(0.0, |x| *x as f32)
                })
                .sum()
        };
        self.around.iter().map(mean).collect()
    }
}

/// The corners at one vertex, apart where faces meet at a sharp edge.
fn smooth_parts(corners: &[(usize, usize)], areas: &[Vec3]) -> Vec<Vec<(usize, usize)>> {
    let mut parts: Vec<(Vec3, Vec<(usize, usize)>)> = Vec::new();
    for &(panel, corner) in corners {
        let normal = unit(areas[panel]);
        let alike = parts
            .iter_mut()
            .find(|(sum, _)| dot(unit(*sum), normal) >= SHARP);
        match alike {
            Some((sum, part)) => {
                *sum = add(*sum, areas[panel]);
                part.push((panel, corner));
            }
            None => parts.push((areas[panel], vec![(panel, corner)])),
        }
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

fn unit(v: Vec3) -> Vec3 {
    match norm(v) {
        length if length > 0.0 => scale(1.0 / length, v),
        _ => [0.0, 1.0, 0.0],
    }
}

impl Session {
    /// [Dynamic pressure](Body::surface_pressures) (Pa) at the vertices of the `skin` of the scene's own body.
    pub fn pressures(&self, skin: &Skin, state: &State) -> Vec<f32> {
        let prepared = self.prepared();
        let [velocity, angular_velocity] = prepared
            .stepper()
            .relative_velocities(state, &self.input(state));
        let density = prepared.scene().fluid.density;
        let of_panels = prepared
            .body()
            .surface_pressures(density, velocity, angular_velocity);
        skin.spread(&of_panels)
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid_bake::body::{BodySpec, bake_body};
    use langevin_rigid_bake::shapes::Shape;

    use super::*;

    fn baked(shape: Shape) -> Body {
        let spec = BodySpec {
            density: Some(900.0),
            ..BodySpec::default()
        };
        bake_body(&shape.mesh(320).unwrap(), &spec, &()).unwrap().0
    }

    #[test]
    fn a_ball_is_smooth_and_a_box_has_edges() {
        let ball = baked(Shape::Ellipsoid {
            semi_axes: [0.01; 3],
        });
        let skin = Skin::new(&ball);
        assert_eq!(skin.positions.len(), ball.surface.vertices.len());
        for (position, normal) in skin.positions.iter().zip(&skin.normals) {
            let along: f32 = position.iter().zip(normal).map(|(x, n)| x * n).sum();
            assert!(along > 0.0099, "{position:?} {normal:?}");
        }

        let card = baked(Shape::Box {
            size: [0.02, 0.01, 0.04],
        });
        let skin = Skin::new(&card);
        for normal in &skin.normals {
            let largest = normal.iter().fold(0.0f32, |most, n| most.max(n.abs()));
            assert!(largest > 0.9999, "{normal:?}");
        }
        // Each corner of the box belongs to three of its faces.
        let at_corner = skin.positions.iter().filter(|p| {
            p.iter()
                .zip([0.01f32, 0.005, 0.02])
                .all(|(x, half)| (x.abs() - half).abs() < 1e-6)
        });
        assert_eq!(at_corner.count(), 24);
    }

    #[test]
    fn a_number_that_is_the_same_on_all_panels_is_the_same_at_all_vertices() {
        let card = baked(Shape::Box {
            size: [0.02, 0.01, 0.04],
        });
        let skin = Skin::new(&card);
        let spread = skin.spread(&vec![3.0; card.surface.panels.len()]);
        assert!(spread.iter().all(|x| (x - 3.0).abs() < 1e-5));
    }
}
