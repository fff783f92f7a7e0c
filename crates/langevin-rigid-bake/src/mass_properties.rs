//! Volume, mass, centre of mass and inertia of a body.
//!
//! The integrals over the polyhedron are exact; they are taken about the mesh's own middle, so
//! that a mesh far from the origin loses no digits. A uniform body follows from its density
//! ([`MassProperties::of`]), one of several materials from the density of each [`Region`]
//! ([`MassProperties::of_regions`]); a weighted one by adding [`Ballast`] ([`MassProperties::with_ballast`]), a
//! measured one by replacing the density, mass, centre of mass or inertia.

mod ballast;
mod boxes;
mod clip;
mod inertia;
mod region;

use crate::mesh::TriMesh;
use crate::mesh::vector::{add, cross, dot, scale, sub};

pub use ballast::Ballast;
pub use inertia::{check_inertia, principal_moments};
pub use region::Region;

/// Volume, mass and inertia of a rigid body, in the frame of its mesh.
///
/// ```
/// use langevin_rigid_bake::mass_properties::MassProperties;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let brick = Shape::Box { size: [0.2, 0.05, 0.1] }.mesh(12)?;
/// let brick = MassProperties::of(&brick, 1800.0)?;
/// assert!((brick.mass - 1.8).abs() < 1e-14);
/// assert!((brick.inertia[0][0] - 1.8 / 12.0 * (0.05 * 0.05 + 0.1 * 0.1)).abs() < 1e-16);
///
/// let weighted_below = brick.with_centre_of_mass([0.0, -0.01, 0.0])?;
/// assert_eq!(weighted_below.centroid, brick.centroid);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Volume of the fluid displaced (m³), that of sealed cavities included.
    pub volume: f64,
    /// Centroid of that volume (m), where buoyancy acts.
    pub centroid: [f64; 3],
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m); the centroid for a uniform body without cavities.
    pub centre_of_mass: [f64; 3],
    /// Inertia tensor about the centre of mass, along the mesh's axes (kg m²).
    pub inertia: [[f64; 3]; 3],
}

impl MassProperties {
    /// The properties of a body whose solid is of uniform `density` (kg/m³); sealed cavities are empty.
    ///
    /// # Errors
    ///
    /// [`MassError::Negative`] where the density is negative or not finite; [`MassError::Scale`]
    /// where the mesh is so large or so small that its integrals are not.
    pub fn of(mesh: &TriMesh, density: f64) -> Result<MassProperties, MassError> {
        check_nonnegative("density", density, "kg/m³")?;
        let middle = middle_of(mesh);
        let solid = Moments::about(mesh, middle);
        let displaced = Moments::about(&mesh.wetted(), middle);
        let from_middle = solid.centroid();
        MassProperties {
            volume: displaced.volume,
            centroid: add(middle, displaced.centroid()),
            mass: density * solid.volume,
            centre_of_mass: add(middle, from_middle),
            inertia: inertia_of(&solid, from_middle, density),
        }
        .within_range()
    }

    /// The same, if all of it can be held in numbers of full precision.
    fn within_range(self) -> Result<MassProperties, MassError> {
        let places = self.centroid.iter().chain(&self.centre_of_mass);
        let place = places.fold(0.0, |sum, x| sum + x.abs());
        let [least, _, most] = principal_moments(self.inertia);
        let some = if self.mass == 0.0 {
            0.0
        } else {
            f64::MIN_POSITIVE
        };
        for (quantity, value, least_value) in [
            ("volume", self.volume, f64::MIN_POSITIVE),
            ("mass", self.mass, 0.0),
            ("centroid", place, 0.0),
            ("largest moment of inertia", most, some),
            ("smallest moment of inertia", least, some),
        ] {
            if !(value >= least_value && value.is_finite()) {
                return Err(MassError::Scale { quantity, value });
            }
        }
        Ok(self)
    }

    /// Mean density (kg/m³): mass over the volume displaced.
    pub fn density(&self) -> f64 {
        self.mass / self.volume
    }

    /// The same body with its mass (kg) and, in proportion, its inertia replaced.
    ///
    /// # Errors
    ///
    /// [`MassError::Negative`] where the mass is negative or not finite, [`MassError::NotPositive`] where the body
    /// had none, [`MassError::Scale`] where the inertia is too large or too small.
    pub fn with_mass(self, mass: f64) -> Result<MassProperties, MassError> {
        check_nonnegative("mass", mass, "kg")?;
        check_positive("mass before", self.mass, "kg")?;
        let ratio = mass / self.mass;
        let inertia = self.inertia.map(|row| scale(ratio, row));
        MassProperties {
            mass,
            inertia,
            ..self
        }
        .within_range()
    }

    /// The same body with its mass and inertia scaled to a mean `density` (kg/m³).
    ///
    /// # Errors
    ///
    /// Those of [`MassProperties::with_mass`].
    pub fn with_density(self, density: f64) -> Result<MassProperties, MassError> {
        self.with_mass(density * self.volume)
    }

    /// The same body with its centre of mass (m) moved; the inertia about the centre of mass is
    /// kept, so give the measured one too where it is known.
    ///
    /// # Errors
    ///
    /// [`MassError::NotFinite`] where a coordinate is infinite or not a number.
    pub fn with_centre_of_mass(self, centre: [f64; 3]) -> Result<MassProperties, MassError> {
        if !centre.iter().all(|x| x.is_finite()) {
            return Err(MassError::NotFinite {
                quantity: "centre of mass",
            });
        }
        Ok(MassProperties {
            centre_of_mass: centre,
            ..self
        })
    }

    /// The same body with its inertia about the centre of mass (kg m², along the mesh's axes)
    /// replaced.
    ///
    /// # Errors
    ///
    /// A [`MassError`] where the tensor is not finite, not symmetric to 1e-9 of its largest entry,
    /// not positive definite, or has a principal moment above the sum of the other two, which no
    /// distribution of mass has.
    pub fn with_inertia(self, inertia: [[f64; 3]; 3]) -> Result<MassProperties, MassError> {
        let inertia = check_inertia(inertia)?;
        Ok(MassProperties { inertia, ..self })
    }
}

/// Why masses or inertias are impossible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MassError {
    /// A mass that is not positive and finite.
    #[error("the {quantity} must be positive and finite, not {value} {unit}")]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A density or mass that is negative or not finite.
    #[error("the {quantity} must be zero or positive, and finite, not {value} {unit}")]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// An integral over the body that is too large or too small for numbers of full precision.
    #[error(
        "the {quantity} of the body comes out as {value:e}: its size, proportions or density are extreme; \
         check the unit of the mesh"
    )]
    Scale {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value (SI units).
        value: f64,
    },
    /// A component that is infinite or not a number.
    #[error("the {quantity} has a component that is not finite")]
    NotFinite {
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// The inertia tensor is not symmetric.
    #[error(
        "the inertia is not symmetric: entry ({row}, {column}) is {upper} but ({column}, {row}) is {lower} kg m²; give a symmetric matrix, products of inertia with their minus sign (Ixy = -sum m x y)"
    )]
    NotSymmetric {
        /// Row of the first entry, from 0.
        row: usize,
        /// Column of the first entry, from 0.
        column: usize,
        /// The first entry.
        upper: f64,
        /// Its mirror image.
        lower: f64,
    },
    /// The inertia tensor is not positive definite.
    #[error(
        "the inertia is not positive definite: its principal moments are {moments:?} kg m²; all must be positive"
    )]
    NotPositiveDefinite {
        /// Principal moments, ascending (kg m²).
        moments: [f64; 3],
    },
    /// The radius of a ballast is negative or not finite.
    #[error(
        "the radius of a ballast must be finite and not negative, not {radius} m; 0 is a point"
    )]
    BallastRadius {
        /// Its value (m).
        radius: f64,
    },
    /// The corners of a region make no box.
    #[error(
        "region {} is no box: each coordinate of `from` {from:?} must be below that of `to` {to:?} (m), all finite",
        .region + 1
    )]
    RegionCorners {
        /// Number of the region, from 0.
        region: usize,
        /// Its lowest corner (m).
        from: [f64; 3],
        /// Its highest corner (m).
        to: [f64; 3],
    },
    /// A region in which nothing of the body takes its density.
    #[error(
        "nothing of the body is in region {}, from {from:?} to {to:?} m, outside the regions after it; \
         the body reaches from {low:?} to {high:?} m in the frame of its mesh: move the region or leave it out",
        .region + 1
    )]
    EmptyRegion {
        /// Number of the region, from 0.
        region: usize,
        /// Its lowest corner (m).
        from: [f64; 3],
        /// Its highest corner (m).
        to: [f64; 3],
        /// Lowest corner of the box about the body (m).
        low: [f64; 3],
        /// Highest corner of the box about the body (m).
        high: [f64; 3],
    },
    /// A mass is given beside regions that leave nothing to weigh the rest.
    #[error(
        "the regions hold all of the body, so its mass is theirs: give a density in place of the mass"
    )]
    RegionsHoldAll,
    /// The regions weigh as much as the whole is said to.
    #[error(
        "the regions alone weigh {regions:e} kg, and the whole body, without ballast, is given {mass:e} kg: \
         lower their densities or raise the mass"
    )]
    RegionsOutweigh {
        /// Mass of what the regions hold (kg).
        regions: f64,
        /// Mass given for the whole (kg).
        mass: f64,
    },
    /// One principal moment exceeds the sum of the others.
    #[error(
        "no body has the principal moments of inertia {moments:?} kg m²: the largest exceeds the sum of the other two; check the units and the signs of the products of inertia"
    )]
    TriangleInequality {
        /// Principal moments, ascending (kg m²).
        moments: [f64; 3],
    },
}

fn check_positive(quantity: &'static str, value: f64, unit: &'static str) -> Result<(), MassError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(MassError::NotPositive {
        quantity,
        value,
        unit,
    })
}

fn check_nonnegative(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), MassError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(MassError::Negative {
        quantity,
        value,
        unit,
    })
}

/// Centroid of the volume that a mesh displaces (m).
pub(crate) fn centroid(mesh: &TriMesh) -> [f64; 3] {
    let middle = middle_of(mesh);
    add(middle, Moments::about(&mesh.wetted(), middle).centroid())
}

fn middle_of(mesh: &TriMesh) -> [f64; 3] {
    let [low, high] = mesh.bounding_box();
    scale(0.5, add(low, high))
}

/// Integrals of 1, x and x xᵀ over a polyhedron.
#[derive(Default)]
struct Moments {
    volume: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Moments {
    /// Sums over the tetrahedra from `origin` to each triangle.
    fn about(mesh: &TriMesh, origin: [f64; 3]) -> Moments {
        let mut m = Moments::default();
        for t in 0..mesh.triangles().len() {
            let [a, b, c] = mesh.corners(t).map(|v| sub(v, origin));
            m.add_tetrahedron(dot(a, cross(b, c)) / 6.0, &[a, b, c]);
        }
        m
    }

    /// Adds a tetrahedron of that signed volume V by its corners v, of which one at the origin may be left out: its
    /// integral of x xᵀ is V/20 (Σ v vᵀ + s sᵀ) with s = Σ v.
    fn add_tetrahedron(&mut self, volume: f64, corners: &[[f64; 3]]) {
        let s = corners.iter().rev().fold([0.0; 3], |s, v| add(*v, s));
        self.volume += volume;
        self.first = add(self.first, scale(0.25 * volume, s));
        for i in 0..3 {
            for j in 0..3 {
                let squares: f64 = corners.iter().map(|v| v[i] * v[j]).sum();
                self.second[i][j] += 0.05 * volume * (squares + s[i] * s[j]);
            }
        }
    }

    /// Adds the moments of another part times a factor.
    fn add(&mut self, factor: f64, part: &Moments) {
        self.volume += factor * part.volume;
        self.first = add(self.first, scale(factor, part.first));
        for i in 0..3 {
            for j in 0..3 {
                self.second[i][j] += factor * part.second[i][j];
            }
        }
    }

    /// The centroid from the origin of the moments.
    fn centroid(&self) -> [f64; 3] {
        scale(1.0 / self.volume, self.first)
    }
}

/// Inertia about the centroid (`c` from the origin of the moments): tr S 1 − S with the second
/// moments S shifted there.
fn inertia_of(m: &Moments, c: [f64; 3], density: f64) -> [[f64; 3]; 3] {
    let second = |i: usize, j: usize| m.second[i][j] - m.volume * c[i] * c[j];
    let trace = second(0, 0) + second(1, 1) + second(2, 2);
    let entry = |i: usize, j: usize| {
        let diagonal = if i == j { trace } else { 0.0 };
        density * (diagonal - second(i, j))
    };
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

#[cfg(test)]
mod tests;
