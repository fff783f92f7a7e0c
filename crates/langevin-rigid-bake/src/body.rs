//! From a mesh to a baked body: mass properties, added mass, characteristic sizes.

use langevin_rigid::{Body, BodyError, Slice, Surface, shift_added_mass};

use crate::added_mass::{AddedMass, AddedMassError, Options, added_mass};
use crate::extents::{characteristic_thickness, half_extents};
use crate::mass_properties::{Ballast, MassError, MassProperties, Region};
use crate::mesh::TriMesh;
use crate::progress::Progress;
use crate::separation::{separation, slices};

/// What a body is made of, beside its surface. Absent values follow from the mesh.
///
/// ```
/// use langevin_rigid_bake::body::{BodySpec, mass_properties};
/// use langevin_rigid_bake::mass_properties::{Ballast, Region};
/// use langevin_rigid_bake::shapes::Shape;
/// // A pencil of wood, 18 cm, with a ferrule of brass and a rubber of 0.5 g at its end.
/// let pencil = Shape::Cylinder { radius: 0.0035, height: 0.18 }.mesh(400)?;
/// let spec = BodySpec {
///     density: Some(600.0),
///     regions: vec![Region { from: [0.08, -0.01, -0.01], to: [0.09, 0.01, 0.01], density: 2000.0 }],
///     ballast: vec![Ballast { mass: 5e-4, position: [0.095, 0.0, 0.0], radius: 0.003 }],
///     ..BodySpec::default()
/// };
/// let mass = mass_properties(&pencil, &spec)?;
/// assert!((mass.mass - 5.195e-3).abs() < 1e-6);
/// assert!((mass.centre_of_mass[0] - 0.01796).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodySpec {
    /// Density of the body outside its regions (kg/m^3), zero for one without mass; with a `mass`, the mass decides.
    pub density: Option<f64>,
    /// Mass of the body with its regions and without its ballast (kg).
    pub mass: Option<f64>,
    /// Where the density is another; of regions that overlap the last counts.
    pub regions: Vec<Region>,
    /// What is added to the body, and to its mass.
    pub ballast: Vec<Ballast>,
    /// Centre of mass in the frame of the mesh (m); that of the solid if none. Not beside regions or ballast,
    /// which make their own.
    pub centre_of_mass: Option<[f64; 3]>,
    /// Inertia about the centre of mass, axes of the mesh (kg m^2); that of the solid if none. Not beside
    /// regions or ballast.
    pub inertia: Option<[[f64; 3]; 3]>,
    /// Thickness b of Eq. (1) (m); [`characteristic_thickness`] if none.
    pub thickness: Option<f64>,
    /// Length d of Eq. (1) (m); the largest extent along a principal axis if none.
    pub length: Option<f64>,
}

/// Why a body could not be baked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
    /// The centre of mass or the inertia is given, and so is what makes it.
    #[error(
        "the body has `{key}` beside regions or ballast, which make it: leave out `{key}`, or all regions and ballast"
    )]
    MassTwice {
        /// `centre_of_mass` or `inertia`.
        key: &'static str,
    },
    /// What came out is no body that the run time takes.
    #[error(
        "the bake failed: {0}. The mesh passes every check, so its size or proportions must be extreme; `langevin-rigid check` shows them"
    )]
    Unsound(#[from] BodyError),
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
    let mesh = &*mesh.wetted();
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
        separation: separation(mesh, &added),
        slices: slices(mesh, &added)
            .into_iter()
            .map(|slice| Slice {
                centre: from_centre(slice.centre),
                ..slice
            })
            .collect(),
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
    body.check()?;
    Ok((body, added))
}

/// Whether `body` can be what [`bake_body`] made of this mesh and these choices: whatever of it is cheap is
/// computed again and must have the same bits.
///
/// ```
/// use langevin_rigid_bake::body::{BodySpec, bake_body, could_be};
/// use langevin_rigid_bake::shapes::Shape;
/// let mesh = Shape::Box { size: [0.1, 0.2, 0.3] }.mesh(100)?;
/// let spec = BodySpec { density: Some(500.0), ..BodySpec::default() };
/// let (mut body, _) = bake_body(&mesh, &spec, &())?;
/// assert!(could_be(&body, &mesh, &spec));
/// body.mass *= 3.0;
/// assert!(!could_be(&body, &mesh, &spec));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn could_be(body: &Body, mesh: &TriMesh, spec: &BodySpec) -> bool {
    let Ok(mass) = mass_properties(mesh, spec) else {
        return false;
    };
    let wetted = &*mesh.wetted();
    let half_extents = half_extents(wetted);
    let centre = mass.centre_of_mass;
    let from_centre = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| p[i] - centre[i]) };
    let vertices = wetted.vertices().iter().map(|p| from_centre(*p));
    body.check().is_ok()
        && body.mass == mass.mass
        && body.inertia == mass.inertia
        && body.volume == mass.volume
        && body.centre_of_buoyancy == from_centre(mass.centroid)
        && body.half_extents == half_extents
        && spec.thickness.is_none_or(|b| body.thickness == b)
        && body.length == spec.length.unwrap_or(2.0 * half_extents[0])
        && body.surface.triangles == wetted.triangles()
        && body.surface.vertices.len() >= vertices.len()
        && vertices.zip(&body.surface.vertices).all(|(p, q)| p == *q)
}

/// Mass, centre of mass and inertia of the body that [`bake_body`] makes.
///
/// # Errors
/// [`BodyBakeError::Mass`], [`BodyBakeError::NoMass`] and [`BodyBakeError::MassTwice`].
pub fn mass_properties(mesh: &TriMesh, spec: &BodySpec) -> Result<MassProperties, BodyBakeError> {
    if !(spec.regions.is_empty() && spec.ballast.is_empty()) {
        let given = [
            ("centre_of_mass", spec.centre_of_mass.is_some()),
            ("inertia", spec.inertia.is_some()),
        ];
        if let Some((key, _)) = given.into_iter().find(|(_, given)| *given) {
            return Err(BodyBakeError::MassTwice { key });
        }
    }
    let regions = &spec.regions;
    let mut mass = match (spec.density, spec.mass) {
        (_, Some(mass)) => MassProperties::of_regions_and_mass(mesh, mass, regions)?,
        (Some(density), None) => MassProperties::of_regions(mesh, density, regions)?,
        (None, None) => return Err(BodyBakeError::NoMass),
    };
    mass = mass.with_ballast(&spec.ballast)?;
    if let Some(centre) = spec.centre_of_mass {
        mass = mass.with_centre_of_mass(centre)?;
    }
    if let Some(inertia) = spec.inertia {
        mass = mass.with_inertia(inertia)?;
    }
    Ok(mass)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Shape;

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
