//! What of a plane is within a box, as a slab.

use crate::layout::Bounds;
use crate::vector::{Vec3, add, cross, dot, normalize, scale, sub};
use crate::{Plane, Scenery};

/// Thickness of the slab, as a part of the box.
const THICKNESS: f64 = 0.01;

/// The slab under the part of the plane that is in the box; nothing where that is no area.
pub(super) fn slab(plane: &Plane, bounds: &Bounds) -> Option<Scenery> {
    let normal = normalize(plane.normal);
    let top = section(plane.point, normal, bounds);
    let corners = top.len() as u32;
    if corners < 3 {
        return None;
    }
    let down = scale(-THICKNESS * bounds.longest(), normal);
    let bottom = top.iter().map(|corner| add(*corner, down));
    let vertices = top.iter().copied().chain(bottom).collect();
    let mut triangles = Vec::new();
    for k in 1..corners - 1 {
        triangles.push([0, k, k + 1]);
        triangles.push([corners, corners + k + 1, corners + k]);
    }
    for k in 0..corners {
        let next = (k + 1) % corners;
        triangles.push([k, corners + k, corners + next]);
        triangles.push([k, corners + next, next]);
    }
    Some(Scenery {
        vertices,
        triangles,
    })
}

/// The polygon in which a plane cuts a box, counterclockwise seen from where the normal points.
fn section(point: Vec3, normal: Vec3, bounds: &Bounds) -> Vec<Vec3> {
    let middle = scale(0.5, add(bounds.low, bounds.high));
    let foot = sub(middle, scale(dot(sub(middle, point), normal), normal));
    let aside = if normal[0].abs() < 0.6 {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 1.0, 0.0]
    };
    let first = scale(2.0 * bounds.longest(), normalize(cross(aside, normal)));
    let second = cross(normal, first);
    let corner = |[a, b]: [f64; 2]| add(foot, add(scale(a, first), scale(b, second)));
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut polygon: Vec<Vec3> = square.map(corner).to_vec();
    for axis in 0..3 {
        polygon = clipped(&polygon, |p| p[axis] - bounds.low[axis]);
        polygon = clipped(&polygon, |p| bounds.high[axis] - p[axis]);
    }
    polygon
}

/// The part of a polygon where a linear function is positive (Sutherland and Hodgman 1974).
fn clipped(polygon: &[Vec3], inside: impl Fn(Vec3) -> f64) -> Vec<Vec3> {
    let mut kept = Vec::new();
    for (k, &to) in polygon.iter().enumerate() {
        let from = polygon[(k + polygon.len() - 1) % polygon.len()];
        let (before, after) = (inside(from), inside(to));
        if (before > 0.0) != (after > 0.0) {
            let part = before / (before - after);
            kept.push(add(from, scale(part, sub(to, from))));
        }
        if after > 0.0 {
            kept.push(to);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_cut_by_the_box() {
        let bounds = Bounds {
            low: [0.0; 3],
            high: [1.0; 3],
        };
        let plane = |height: f64| Plane {
            point: [0.5, height, 0.5],
            normal: [-0.6, 0.8, 0.0],
        };
        let slab = slab(&plane(0.5), &bounds).unwrap();
        assert_eq!((slab.vertices.len(), slab.triangles.len()), (8, 12));
        for [x, y, z] in &slab.vertices[..4] {
            assert!((y - 0.5 - 0.75 * (x - 0.5)).abs() < 1e-12, "{x} {y} {z}");
            assert!(
                [x, y, z]
                    .iter()
                    .all(|c| (-1e-12..=1.0 + 1e-12).contains(*c))
            );
        }
        let top = slab.triangles[0].map(|v| slab.vertices[v as usize]);
        let up = cross(sub(top[1], top[0]), sub(top[2], top[0]));
        assert!(dot(up, plane(0.0).normal) > 0.0);
        assert!(super::slab(&plane(9.0), &bounds).is_none());
    }
}
