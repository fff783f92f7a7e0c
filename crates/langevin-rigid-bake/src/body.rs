//! From a mesh to a baked body: mass properties, added mass, characteristic sizes.

use langevin_rigid::linalg::eigen_symmetric;
use langevin_rigid::{Body, Surface, shift_added_mass};

use crate::added_mass::{AddedMass, AddedMassError, Options, added_mass};
use crate::mass_properties::{MassError, MassProperties};
use crate::mesh::TriMesh;
use crate::progress::Progress;

/// What a body is made of, beside its surface. Absent values follow from the mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodySpec {
    /// Density of the homogeneous body (kg/m^3); with a `mass`, the mass decides.
    pub density: Option<f64>,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Centre of mass in the frame of the mesh (m); the centroid of the volume if none.
    pub centre_of_mass: Option<[f64; 3]>,
    /// Inertia about the centre of mass, axes of the mesh (kg m^2); that of a homogeneous body if
    /// none.
    pub inertia: Option<[[f64; 3]; 3]>,
    /// Thickness b of Eq. (1) (m); see [`characteristic_thickness`] if none.
    pub thickness: Option<f64>,
    /// Length d of Eq. (1) (m); the largest extent along a principal axis if none.
    pub length: Option<f64>,
}

/// Why a body could not be baked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BodyBakeError {
    /// The mass properties are impossible.
    #[error(transparent)]
    Mass(#[from] MassError),
    /// The added mass could not be computed.
    #[error(transparent)]
    AddedMass(#[from] AddedMassError),
    /// Neither a density nor a mass was given.
    #[error("the body has neither a density nor a mass; give one of them")]
    NoMass,
}

/// Computes everything about a body that does not change from step to step.
///
/// Returns the body with its axes along the mesh's and its origin at the centre of mass, and the
/// added mass with its error estimate and warnings.
///
/// # Errors
/// See [`BodyBakeError`].
pub fn bake_body(
    mesh: &TriMesh,
    spec: &BodySpec,
    progress: &dyn Progress,
) -> Result<(Body, AddedMass), BodyBakeError> {
    let mass = mass_properties(mesh, spec)?;
    let added = added_mass(mesh, &Options::default(), progress)?;
    let centre = mass.centre_of_mass;
    let from_centre = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| p[i] - centre[i]) };
    let to_centre = std::array::from_fn(|i| centre[i] - added.reference[i]);
    let half_extents = half_extents(mesh);
    let body = Body {
        mass: mass.mass,
        inertia: mass.inertia,
        volume: mass.volume,
        centre_of_buoyancy: from_centre(mass.centroid),
        added_mass: shift_added_mass(&added.tensor, to_centre),
        half_extents,
        thickness: spec
            .thickness
            .unwrap_or_else(|| characteristic_thickness(mesh, half_extents)),
        length: spec.length.unwrap_or(2.0 * half_extents[0]),
        surface: Surface {
            vertices: added
                .surface
                .vertices
                .iter()
                .map(|p| from_centre(*p))
                .collect(),
            triangles: mesh.triangles().to_vec(),
            panels: added.surface.triangles.clone(),
            potentials: added.surface.potentials.clone(),
        },
    };
    Ok((body, added))
}

fn mass_properties(mesh: &TriMesh, spec: &BodySpec) -> Result<MassProperties, BodyBakeError> {
    let mut mass = match (spec.density, spec.mass) {
        (_, Some(mass)) => MassProperties::of(mesh, 1.0)?.with_mass(mass)?,
        (Some(density), None) => MassProperties::of(mesh, density)?,
        (None, None) => return Err(BodyBakeError::NoMass),
    };
    if let Some(centre) = spec.centre_of_mass {
        mass = mass.with_centre_of_mass(centre)?;
    }
    if let Some(inertia) = spec.inertia {
        mass = mass.with_inertia(inertia)?;
    }
    Ok(mass)
}

/// Thickness b of Eq. (1) for any mesh (m): six volumes over the surface, which is the diameter of a
/// sphere and the side of a cube, but not more than the smallest extent.
pub fn characteristic_thickness(mesh: &TriMesh, half_extents: [f64; 3]) -> f64 {
    (6.0 * mesh.volume() / mesh.surface_area()).min(2.0 * half_extents[2])
}

/// Principal moments closer than this, relatively, have no axes of their own.
const DEGENERATE: f64 = 1e-3;

/// Half the extents of a mesh along the principal axes of its volume, descending (m).
///
/// Where two or three principal moments agree the axes are arbitrary, and the extent is the mean over
/// the directions of that plane or of space: a disc has its radius, whichever way it lies.
pub fn half_extents(mesh: &TriMesh) -> [f64; 3] {
    let moments = MassProperties::of(mesh, 1.0)
        .map(|m| m.inertia)
        .unwrap_or_default();
    let (inertia, axes) = eigen_symmetric(&moments);
    let axis = |k: usize| -> [f64; 3] { std::array::from_fn(|i| axes[i][k]) };
    let same = |i: usize, j: usize| (inertia[i] - inertia[j]).abs() < DEGENERATE * inertia[2];
    let along = |k: usize| half_width(mesh, axis(k));
    let mut extents = match (same(0, 1), same(1, 2)) {
        (true, true) => [mean_half_width(mesh); 3],
        (true, false) => {
            let plane = mean_half_width_in_plane(mesh, axis(0), axis(1));
            [plane, plane, along(2)]
        }
        (false, true) => {
            let plane = mean_half_width_in_plane(mesh, axis(1), axis(2));
            [along(0), plane, plane]
        }
        (false, false) => [along(0), along(1), along(2)],
    };
    extents.sort_by(|a, b| b.total_cmp(a));
    extents
}

fn half_width(mesh: &TriMesh, direction: [f64; 3]) -> f64 {
    let heights = mesh
        .vertices()
        .iter()
        .map(|p| (0..3).map(|i| p[i] * direction[i]).sum::<f64>());
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
        (l.min(x), h.max(x))
    });
    0.5 * (high - low)
}

fn mean_half_width_in_plane(mesh: &TriMesh, a: [f64; 3], b: [f64; 3]) -> f64 {
    const DIRECTIONS: u32 = 64;
    let width = |n: u32| {
        let (s, c) = libm::sincos(std::f64::consts::PI * f64::from(n) / f64::from(DIRECTIONS));
        half_width(mesh, std::array::from_fn(|i| c * a[i] + s * b[i]))
    };
    (0..DIRECTIONS).map(width).sum::<f64>() / f64::from(DIRECTIONS)
}

/// Mean over directions spread evenly on the sphere (a Fibonacci lattice).
fn mean_half_width(mesh: &TriMesh) -> f64 {
    const DIRECTIONS: u32 = 256;
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let width = |n: u32| {
        let y = 1.0 - (f64::from(n) + 0.5) / f64::from(DIRECTIONS);
        let r = (1.0 - y * y).sqrt();
        let (s, c) = libm::sincos(GOLDEN_ANGLE * f64::from(n));
        half_width(mesh, [r * c, y, r * s])
    };
    (0..DIRECTIONS).map(width).sum::<f64>() / f64::from(DIRECTIONS)
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
    fn a_shifted_centre_of_mass_moves_the_frame_with_it() {
        let mesh = Shape::Ellipsoid {
            semi_axes: [0.02, 0.03, 0.05],
        }
        .mesh(320)
        .unwrap();
        let spec = BodySpec {
            density: Some(500.0),
            ..BodySpec::default()
        };
        let (plain, _) = bake_body(&mesh, &spec, &()).unwrap();
        let low = BodySpec {
            centre_of_mass: Some([0.0, -0.01, 0.0]),
            ..spec
        };
        let (body, _) = bake_body(&mesh, &low, &()).unwrap();
        assert!((body.centre_of_buoyancy[1] - 0.01).abs() < 1e-6);
        assert!((body.surface.vertices[0][1] - mesh.vertices()[0][1] - 0.01).abs() < 1e-12);
        // Turning about a point below the middle moves the fluid's x-mass by 1 cm per radian.
        let coupling = 0.01 * plain.added_mass[0][0];
        assert!((body.added_mass[0][5].abs() / coupling - 1.0).abs() < 1e-3);
        let wanted = plain.added_mass[5][5] + 0.01 * coupling;
        assert!((body.added_mass[5][5] / wanted - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_body_needs_a_mass() {
        let mesh = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
        assert_eq!(
            bake_body(&mesh, &BodySpec::default(), &()).unwrap_err(),
            BodyBakeError::NoMass
        );
    }
}
