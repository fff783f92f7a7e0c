//! Characteristic sizes of a body.

use langevin_rigid::linalg::{Mat3, Vec3};

use crate::axes::PrincipalAxes;
use crate::mass_properties::MassProperties;
use crate::mesh::TriMesh;
use crate::mesh::vector::dot;

/// Thickness b of Eq. (1) for any mesh (m): six volumes over the surface, which is the diameter of a
/// sphere and the side of a cube, but not more than the smallest extent.
pub fn characteristic_thickness(mesh: &TriMesh, half_extents: [f64; 3]) -> f64 {
    let mesh = mesh.wetted();
    (6.0 * mesh.volume() / mesh.surface_area()).min(2.0 * half_extents[2])
}

/// Half the extents of a mesh along the principal axes of its volume, descending (m).
///
/// Where two or three principal moments agree the axes are arbitrary, and the extent is the mean over
/// the directions of that plane or of space: a disc has its radius, whichever way it lies.
///
/// ```
/// use langevin_rigid_bake::extents::half_extents;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let brick = Shape::Box { size: [0.05, 0.2, 0.1] }.mesh(12)?;
/// let [a, b, c] = half_extents(&brick);
/// assert!((a - 0.1).abs() < 1e-12 && (b - 0.05).abs() < 1e-12 && (c - 0.025).abs() < 1e-12);
/// # Ok::<(), langevin_rigid_bake::shapes::ShapeError>(())
/// ```
pub fn half_extents(mesh: &TriMesh) -> [f64; 3] {
    let (_, mut extents) = principal_extents(mesh);
    extents.sort_by(|a, b| b.total_cmp(a));
    extents
}

/// The principal axes of a mesh's volume and half the extents along them (m).
pub(crate) fn principal_extents(mesh: &TriMesh) -> (PrincipalAxes, [f64; 3]) {
    let mesh = &*mesh.wetted();
    let axes = PrincipalAxes::of(&second_moments(mesh));
    let extents = axes.along(|direction| half_width(mesh, direction));
    (axes, extents)
}

/// Integrals of x_i x_j over the volume about its centroid (m^5): unlike moments of inertia they
/// tell the two thin directions of a rod apart.
fn second_moments(mesh: &TriMesh) -> Mat3 {
    let inertia = MassProperties::of(mesh, 1.0)
        .map(|m| m.inertia)
        .unwrap_or_default();
    let half_trace = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| if i == j { half_trace } else { 0.0 } - inertia[i][j])
    })
}

fn half_width(mesh: &TriMesh, direction: Vec3) -> f64 {
    let heights = mesh.vertices().iter().map(|p| dot(*p, direction));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
        (l.min(x), h.max(x))
    });
    0.5 * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Shape;

    fn assert_extents(shape: Shape, wanted: [f64; 3], tolerance: f64) {
        let found = half_extents(&shape.mesh(1280).unwrap());
        for (f, w) in found.iter().zip(wanted) {
            assert!((f / w - 1.0).abs() < tolerance, "{found:?} for {wanted:?}");
        }
    }

    #[test]
    fn extents_are_the_semi_axes_of_round_bodies() {
        assert_extents(
            Shape::Ellipsoid {
                semi_axes: [1.0, 4.0, 2.0],
            },
            [4.0, 2.0, 1.0],
            0.01,
        );
        assert_extents(
            Shape::Ellipsoid {
                semi_axes: [2.0; 3],
            },
            [2.0; 3],
            0.01,
        );
        let sheet = Shape::EllipticalPlate {
            semi_axes: [0.04, 0.01],
            thickness: 1e-4,
        };
        assert_extents(sheet, [0.04, 0.01, 5e-5], 0.01);
        assert_extents(
            Shape::Disc {
                radius: 0.1,
                thickness: 0.01,
            },
            [0.1, 0.1, 0.005],
            0.01,
        );
        assert_extents(
            Shape::Box {
                size: [3.0, 1.0, 2.0],
            },
            [1.5, 1.0, 0.5],
            1e-9,
        );
    }

    #[test]
    fn thickness_is_that_of_eq_1() {
        let thickness = |shape: Shape| {
            let mesh = shape.mesh(1280).unwrap();
            characteristic_thickness(&mesh, half_extents(&mesh))
        };
        assert!((thickness(Shape::Box { size: [1.0; 3] }) - 1.0).abs() < 1e-9);
        assert!(
            (thickness(Shape::Box {
                size: [1.0, 0.01, 2.0]
            }) - 0.01)
                .abs()
                < 1e-9
        );
        assert!(
            (thickness(Shape::Ellipsoid {
                semi_axes: [1.0; 3]
            }) - 2.0)
                .abs()
                < 0.02
        );
    }

    #[test]
    fn the_thin_directions_of_a_rod_are_told_apart() {
        let rod = Shape::Box {
            size: [100.0, 1.0, 2.0],
        };
        assert_extents(rod, [50.0, 1.0, 0.5], 1e-9);
    }
}
