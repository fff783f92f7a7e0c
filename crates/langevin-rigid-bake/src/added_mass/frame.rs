//! Centred and scaled coordinates, so that neither the place nor the size of a body matters.

use super::panels::Vec3;
use crate::mesh::vector::{add, bounding_box, cross, dot, norm, scale, sub};

/// Where the body is and how large.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// Volume centroid (m).
    pub(super) origin: Vec3,
    /// Length that one unit stands for (m): a power of two, so that scaling is exact.
    pub(super) unit: f64,
    /// Surface area, volume and mean moment of inertia of the displaced volume, in units.
    pub(super) area: f64,
    pub(super) volume: f64,
    pub(super) inertia: f64,
}

impl Frame {
    /// The frame of a body, and its vertices in it.
    pub(super) fn new(vertices: &[Vec3], triangles: &[[u32; 3]]) -> (Frame, Vec<Vec3>) {
        let [low, high] = bounding_box(vertices);
        let middle = scale(0.5, add(low, high));
        let unit = power_of_two(norm(sub(high, low)));
        let place = |origin: Vec3| {
            let to_frame = |v: &Vec3| scale(1.0 / unit, sub(sub(*v, middle), origin));
            vertices.iter().map(to_frame).collect::<Vec<Vec3>>()
        };
        let centroid = Moments::new(&place([0.0; 3]), triangles).centroid();
        let shift = scale(unit, centroid);
        let placed = place(shift);
        let moments = Moments::new(&placed, triangles);
        let frame = Frame {
            origin: add(middle, shift),
            unit,
            area: moments.area,
            volume: moments.volume,
            inertia: 2.0 / 3.0 * moments.square,
        };
        (frame, placed)
    }

    /// Whether sizes of this body to the fifth power are numbers, as the tensor has them.
    pub(super) fn is_in_range(&self) -> bool {
        let power = |n: i32| self.unit.powi(n) * self.inertia.min(self.volume);
        power(5).is_normal() && power(3).is_normal()
    }

    /// A point of the frame in the caller's coordinates (m).
    pub(super) fn outside(&self, v: Vec3) -> Vec3 {
        add(self.origin, scale(self.unit, v))
    }
}

fn power_of_two(x: f64) -> f64 {
    libm::ldexp(1.0, libm::frexp(x).1)
}

/// Integrals over the surface and the volume of a closed mesh.
#[derive(Default)]
struct Moments {
    area: f64,
    volume: f64,
    first: Vec3,
    square: f64,
}

impl Moments {
    fn new(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Moments {
        let mut sums = Moments::default();
        for t in triangles {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            let sum = add(a, add(b, c));
            let volume = dot(a, cross(b, c)) / 6.0;
            sums.area += 0.5 * norm(cross(sub(b, a), sub(c, a)));
            sums.volume += volume;
            sums.first = add(sums.first, scale(0.25 * volume, sum));
            sums.square += volume / 20.0 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
        }
        sums
    }

    fn centroid(&self) -> Vec3 {
        scale(1.0 / self.volume, self.first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_of_a_tetrahedron() {
        let vertices = [
            [7.0, 2.0, 1.0],
            [8.0, 2.0, 1.0],
            [7.0, 3.0, 1.0],
            [7.0, 2.0, 2.0],
        ];
        let (frame, placed) = Frame::new(&vertices, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        assert!(norm(sub(frame.origin, [7.25, 2.25, 1.25])) < 1e-15);
        assert_eq!(frame.unit, 2.0);
        assert!((frame.volume * 8.0 - 1.0 / 6.0).abs() < 1e-16);
        for (v, p) in vertices.iter().zip(&placed) {
            assert!(norm(sub(frame.outside(*p), *v)) < 1e-15);
        }
        // Integral of r^2 about the centroid: 3 (1/60 - 1/96) of the unit tetrahedron.
        let square = 3.0 * (1.0 / 60.0 - 1.0 / 96.0);
        assert!((frame.inertia * 32.0 - 2.0 / 3.0 * square).abs() < 1e-15);
    }
}
