//! Volume of a convex hull (C. Barber, D. Dobkin, H. Huhdanpaa, 1996).

use std::collections::BTreeMap;

use super::vector::{bounding_box, cross, dot, norm, scale, sub};

/// Share of the diagonal of the bounding box within which a point is on a face.
const ON_FACE: f64 = 1e-10;

/// Volume of the convex hull of some points (m³); zero where they lie in a plane.
pub(super) fn volume(points: &[[f64; 3]]) -> f64 {
    let Some(start) = tetrahedron(points) else {
        return 0.0;
    };
    let mut hull = Hull::new(points, start);
    while let Some(face) = hull.open.pop() {
        hull.grow(face);
    }
    let six_volumes = hull.faces.iter().flatten().map(|face| {
        let [a, b, c] = face.corners.map(|p| sub(points[p], points[start[0]]));
        dot(a, cross(b, c))
    });
    six_volumes.sum::<f64>() / 6.0
}

/// Four points far from a common plane, the first three against the clock as seen from beyond the fourth.
fn tetrahedron(points: &[[f64; 3]]) -> Option<[usize; 4]> {
    let most = |measure: &dyn Fn([f64; 3]) -> f64| {
        let far = |&a: &usize, &b: &usize| measure(points[a]).total_cmp(&measure(points[b]));
        (0..points.len()).max_by(far)
    };
    let a = most(&|p| -p[0])?;
    let from_a = |p| sub(p, points[a]);
    let b = most(&|p| norm(from_a(p)))?;
    let c = most(&|p| norm(cross(from_a(points[b]), from_a(p))))?;
    let normal = cross(from_a(points[b]), from_a(points[c]));
    let d = most(&|p| dot(normal, from_a(p)).abs())?;
    let height = dot(normal, from_a(points[d]));
    if height == 0.0 {
        return None;
    }
    Some(if height > 0.0 {
        [a, c, b, d]
    } else {
        [a, b, c, d]
    })
}

struct Face {
    corners: [usize; 3],
    normal: [f64; 3],
    /// The points beyond it that are its own to reach.
    beyond: Vec<usize>,
}

struct Hull<'a> {
    points: &'a [[f64; 3]],
    on_face: f64,
    /// Those that were found inside are gone.
    faces: Vec<Option<Face>>,
    /// The face with an edge, as the face runs.
    sides: BTreeMap<[usize; 2], usize>,
    /// Faces that may have points beyond them.
    open: Vec<usize>,
}

impl Hull<'_> {
    fn new(points: &[[f64; 3]], [a, b, c, d]: [usize; 4]) -> Hull<'_> {
        let [low, high] = bounding_box(points);
        let mut hull = Hull {
            points,
            on_face: ON_FACE * norm(sub(high, low)),
            faces: Vec::new(),
            sides: BTreeMap::new(),
            open: Vec::new(),
        };
        let first = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
        hull.add(&first, (0..points.len()).collect());
        hull
    }

    fn height(&self, face: &Face, point: usize) -> f64 {
        let from = self.points[face.corners[0]];
        dot(face.normal, sub(self.points[point], from))
    }

    /// Adds faces and shares out points among them; those that are beyond none are inside.
    fn add(&mut self, corners: &[[usize; 3]], points: Vec<usize>) {
        let first = self.faces.len();
        for &[a, b, c] in corners {
            let place = |p: usize| sub(self.points[p], self.points[a]);
            let normal = cross(place(b), place(c));
            let length = norm(normal).max(f64::MIN_POSITIVE);
            let number = self.faces.len();
            for side in [[a, b], [b, c], [c, a]] {
                self.sides.insert(side, number);
            }
            self.faces.push(Some(Face {
                corners: [a, b, c],
                normal: scale(1.0 / length, normal),
                beyond: Vec::new(),
            }));
            self.open.push(number);
        }
        for point in points {
            let is_below = |face: &Face| self.height(face, point) > self.on_face;
            let mut new = first..self.faces.len();
            let over = new.find(|&f| self.faces[f].as_ref().is_some_and(is_below));
            if let Some(face) = over.and_then(|f| self.faces[f].as_mut()) {
                face.beyond.push(point);
            }
        }
    }

    /// Takes in the point farthest beyond a face, if there is one.
    fn grow(&mut self, start: usize) {
        let Some(face) = &self.faces[start] else {
            return;
        };
        let far = |&a: &usize, &b: &usize| self.height(face, a).total_cmp(&self.height(face, b));
        let Some(apex) = face.beyond.iter().copied().max_by(far) else {
            return;
        };
        let mut seen = vec![start];
        let mut horizon = Vec::new();
        let mut beyond = Vec::new();
        let mut at = 0;
        while let Some(&number) = seen.get(at) {
            at += 1;
            let Some(Face {
                corners: [a, b, c], ..
            }) = self.faces[number]
            else {
                continue;
            };
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let next = self.sides.get(&[to, from]).copied();
                let next = next.filter(|n| !seen.contains(n));
                let Some((next, face)) = next.and_then(|n| Some((n, self.faces[n].as_ref()?)))
                else {
                    continue;
                };
                if self.height(face, apex) > self.on_face {
                    seen.push(next);
                } else {
                    horizon.push([from, to, apex]);
                }
            }
        }
        for number in seen {
            if let Some(face) = self.faces[number].take() {
                beyond.extend(face.beyond);
            }
        }
        beyond.retain(|&point| point != apex);
        self.add(&horizon, beyond);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Shape;

    #[test]
    fn hulls_of_convex_bodies_are_their_volume_and_those_of_planes_nothing() {
        for (shape, triangles) in [
            (
                Shape::Box {
                    size: [1.0, 2.0, 3.0],
                },
                600,
            ),
            (
                Shape::Ellipsoid {
                    semi_axes: [1.0, 2.0, 0.1],
                },
                5120,
            ),
            (
                Shape::Disc {
                    radius: 1.0,
                    thickness: 0.2,
                },
                500,
            ),
        ] {
            let mesh = shape.mesh(triangles).unwrap();
            let found = volume(mesh.vertices());
            assert!(
                (found / mesh.volume() - 1.0).abs() < 1e-9,
                "{shape:?} {found}"
            );
        }
        assert_eq!(volume(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), 0.0);
        assert_eq!(volume(&[]), 0.0);
    }

    #[test]
    fn what_is_inside_does_not_count() {
        let ring = Shape::Washer {
            diameter: 1.0,
            inner_diameter: 0.5,
            thickness: 0.1,
        };
        let ring = ring.mesh(600).unwrap();
        let share = ring.volume() / volume(ring.vertices());
        assert!((share - 0.75).abs() < 0.01, "{share}");
    }
}
