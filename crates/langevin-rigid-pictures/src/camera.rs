//! Orthographic cameras.

use crate::vector::{Mat3, Vec3, cross, mat_vec, normalize};

/// One of the four directions a panel can look along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// x to the right, y up, seen from +z.
    Front,
    /// z to the right, y up, seen from -x.
    Side,
    /// x to the right, z down, seen from +y.
    Top,
    /// From above, between +x and +z.
    Iso,
}

/// A world axis that lies along a side of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PictureAxis {
    pub name: &'static str,
    /// World coordinate per picture coordinate, +1 or -1.
    pub sign: f64,
}

/// An orthographic camera: rows are the world directions of picture right, picture up, and
/// toward the viewer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    pub direction: Direction,
    pub rows: Mat3,
}

impl Camera {
    pub(super) fn new(direction: Direction) -> Self {
        let rows = match direction {
            Direction::Front => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Direction::Side => [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
            Direction::Top => [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
            Direction::Iso => looking_from([0.55, 0.45, 0.8]),
        };
        Self { direction, rows }
    }

    /// (right, up, toward the viewer) of a world point, metres.
    pub(super) fn project(&self, world: Vec3) -> Vec3 {
        mat_vec(&self.rows, world)
    }

    /// The world axes along picture right and picture up, where there are such.
    pub(super) fn axes(&self) -> Option<[PictureAxis; 2]> {
        let axis = |name, sign| PictureAxis { name, sign };
        match self.direction {
            Direction::Front => Some([axis("x", 1.0), axis("y", 1.0)]),
            Direction::Side => Some([axis("z", 1.0), axis("y", 1.0)]),
            Direction::Top => Some([axis("x", 1.0), axis("z", -1.0)]),
            Direction::Iso => None,
        }
    }

    pub(super) fn name(&self) -> &'static str {
        match self.direction {
            Direction::Front => "Front",
            Direction::Side => "Side",
            Direction::Top => "Top",
            Direction::Iso => "From above at an angle",
        }
    }
}

fn looking_from(viewer: Vec3) -> Mat3 {
    let toward = normalize(viewer);
    let right = normalize(cross([0.0, 1.0, 0.0], toward));
    [right, cross(toward, right), toward]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::dot;

    #[test]
    fn every_camera_is_a_rotation() {
        // A mirrored camera would show a left-handed helix as a right-handed one.
        for direction in [
            Direction::Front,
            Direction::Side,
            Direction::Top,
            Direction::Iso,
        ] {
            let [r, u, t] = Camera::new(direction).rows;
            for (a, b) in [(r, u), (u, t), (t, r)] {
                assert!(dot(a, b).abs() < 1e-15);
            }
            assert!((dot(cross(r, u), t) - 1.0).abs() < 1e-15, "{direction:?}");
        }
    }
}
