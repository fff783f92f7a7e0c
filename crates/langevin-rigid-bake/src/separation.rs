//! Tensors of the closure for separated flow, baked from the shape and its surface potentials.
//!
//! [`separation`] is the entry point: drag areas from a surface-pressure model ([`pressure_drag`]), extents, the slices
//! of a long body ([`slices`]), and the Stokes resistance of the ellipsoid with the body's half-extents
//! ([`stokes_translation`], [`stokes_rotation`]). Friction in a boundary layer depends on the Reynolds number and is in
//! none of them.

mod panels;
mod pressure;
mod slices;

use langevin_rigid::Separation;
use langevin_rigid::linalg::{Mat3, Vec3};

use crate::added_mass::AddedMass;
use crate::axes::PrincipalAxes;
use crate::extents::principal_extents;
use crate::mesh::TriMesh;
use panels::Panels;

pub use langevin_rigid::{stokes_rotation, stokes_translation};
pub use pressure::PressureDrag;
pub use slices::slices;

/// The tensors of a body, in the axes of its mesh, referring to the centroid of its volume.
///
/// The drag areas are diagonal along the principal axes of the translational added mass, with the
/// [drag area](PressureDrag::area) of each axis; where two or three of its eigenvalues agree, with
/// the mean over the directions of that plane or of space. The other three tensors are diagonal
/// along the principal axes of the volume.
///
/// ```
/// use langevin_rigid_bake::added_mass::{Options, added_mass};
/// use langevin_rigid_bake::separation::separation;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let ball = Shape::Ellipsoid { semi_axes: [0.1; 3] }.mesh(320)?;
/// let tensors = separation(&ball, &added_mass(&ball, &Options::default(), &())?);
/// let stokes = 6.0 * std::f64::consts::PI * 0.1;
/// assert!((tensors.stokes_translation[0][0] / stokes - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn separation(mesh: &TriMesh, added: &AddedMass) -> Separation {
    let (axes, half) = principal_extents(mesh);
    Separation {
        drag_area: drag_area(added),
        extents: axes.tensor(half.map(|h| h * h)),
        stokes_translation: axes.tensor(stokes_translation(half)),
        stokes_rotation: axes.tensor(stokes_rotation(half)),
    }
}

/// Steady pressure drag of a body that moves along `direction` (any length but zero; axes of the
/// mesh), from its potentials.
///
/// ```
/// use langevin_rigid_bake::added_mass::{Options, added_mass};
/// use langevin_rigid_bake::separation::pressure_drag;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let plate = Shape::Box { size: [1.0, 0.05, 1.0] }.mesh(1000)?;
/// let drag = pressure_drag(&added_mass(&plate, &Options::default(), &())?, [0.0, 1.0, 0.0]);
/// assert!((drag.silhouette - 1.0).abs() < 1e-9);
/// assert!(drag.coefficient > 1.0 && drag.coefficient < 1.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pressure_drag(added: &AddedMass, direction: [f64; 3]) -> PressureDrag {
    Panels::of(&added.surface).drag(crate::mesh::vector::unit(direction))
}

fn drag_area(added: &AddedMass) -> Mat3 {
    let translation: Mat3 = std::array::from_fn(|i| std::array::from_fn(|j| added.tensor[i][j]));
    let panels = Panels::of(&added.surface);
    let axes = PrincipalAxes::of(&translation);
    let areas = axes.along(|direction: Vec3| panels.drag(direction).area());
    axes.tensor(areas)
}
