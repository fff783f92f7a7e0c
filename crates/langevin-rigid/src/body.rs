//! The baked body: everything about a shape that the run time needs.

use crate::linalg::{Mat3, Mat6, Vec3, cholesky, cross, eigen_symmetric};

/// A rigid body as the precomputation leaves it.
///
/// All vectors are in the body frame: its origin is the centre of mass, its axes are those of the
/// mesh that the body was made from.
///
/// Bodies of simple form need no mesh: [`Body::sphere`], [`Body::ellipsoid`], [`Body::disc`],
/// [`Body::plate`], [`Body::cylinder`] and [`Body::cuboid`] are in closed form. A first program lets a
/// disc go in water and prints where it is, ten times a second:
///
/// ```
/// use langevin_rigid::linalg::quat_from_rotation_vector;
/// use langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper};
///
/// let disc = Body::disc(0.01, 0.001, 2700.0)?;
/// let stepper = Stepper::new(&disc, &Fluid::WATER, None, &Settings::default())?;
/// let mut state = State::default();
/// state.orientation = quat_from_rotation_vector([0.2, 0.0, 0.0]);
/// for step in 1..=1000 {
///     stepper.step(&mut state, 0.001, &Input::default())?;
///     if step % 100 == 0 {
///         println!("{:.1} s: {:.3?} m", state.time, state.position);
///     }
/// }
/// # assert!(state.position[1] < -0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Mass m (kg); zero for a body whose inertia is that of the fluid around it alone.
    pub mass: f64,
    /// Inertia J0 about the centre of mass (kg m^2); zero only for a body without mass.
    pub inertia: Mat3,
    /// Volume V (m^3).
    pub volume: f64,
    /// Centre of buoyancy r: the volume centroid, from the centre of mass (m).
    pub centre_of_buoyancy: Vec3,
    /// Added mass per unit fluid density about the centre of mass: m^3, m^4 and m^5 in the blocks,
    /// linear part first.
    pub added_mass: Mat6,
    /// Half the extents along the principal axes of the volume, descending (m).
    pub half_extents: Vec3,
    /// Characteristic thickness b of Eq. (1) (m).
    pub thickness: f64,
    /// Characteristic length d of Eq. (1) (m).
    pub length: f64,
    /// What separated flow depends on.
    pub separation: Separation,
    /// Slices along a long body, each with its own loads; none if the body moves as one.
    pub slices: Vec<Slice>,
    /// The body's surface.
    pub surface: Surface,
}

/// Tensors of the closure for separated flow, about the centroid of the volume, body axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Separation {
    /// Drag areas P: a motion at v is resisted by 1/2 rho (v.P v) along P v (m^2).
    pub drag_area: Mat3,
    /// Squared half-extents along the principal axes (m^2).
    pub extents: Mat3,
    /// Stokes resistance to translation per dynamic viscosity (m).
    pub stokes_translation: Mat3,
    /// Stokes resistance to rotation per dynamic viscosity (m^3).
    pub stokes_rotation: Mat3,
}

/// A slice of a long body, in body axes: what the closure for separated flow needs of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slice {
    /// Where its loads act, from the centre of mass (m).
    pub centre: Vec3,
    /// Its share of the translational added mass per unit fluid density (m^3).
    pub translation: Mat3,
    /// Its share of the rotational added mass per unit fluid density, about `centre` (m^5).
    pub rotation: Mat3,
    /// Drag areas P (m^2).
    pub drag_area: Mat3,
    /// Squared half-extents: its own across the body, the body's along it (m^2).
    pub extents: Mat3,
}

/// The surface of a body with its potentials of unit motion.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Surface {
    /// Vertex positions from the centre of mass (m); those of the given mesh first.
    pub vertices: Vec<Vec3>,
    /// Triangles of the given mesh.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles of the mesh that the potentials were solved on: `triangles` or a subdivision.
    pub panels: Vec<[u32; 3]>,
    /// Exterior potentials of the six unit motions at each vertex, up to one constant each:
    /// translation along x, y, z (m) and rotation about them through the volume centroid (m^2).
    pub potentials: Vec<[f64; 6]>,
}

/// Slices that a body has at most.
pub const MOST_SLICES: usize = 8;

/// What makes a body impossible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A quantity that must be positive and finite is not.
    #[error("the body's {name} is {value}; it must be a positive number")]
    NotPositive {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that may be zero is negative, infinite or not a number.
    #[error("the body's {name} is {value}; it must be zero or a positive number")]
    Negative {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity has an entry that is infinite or not a number.
    #[error("{} {name} with an entry that is not finite; bake the body again", owner(.slice))]
    NotFinite {
        /// Name of the quantity.
        name: &'static str,
        /// Number of the slice that it belongs to, from zero; the body's own if none.
        slice: Option<usize>,
    },
    /// A tensor of resistances, extents or added mass has a negative eigenvalue or is not symmetric.
    #[error("{} {name} that is no symmetric positive tensor; bake the body again", owner(.slice))]
    NotPositiveTensor {
        /// Name of the quantity.
        name: &'static str,
        /// Number of the slice that it belongs to, from zero; the body's own if none.
        slice: Option<usize>,
    },
    /// The surface is not made of the vertices that it has.
    #[error(
        "the body's surface is damaged: its triangles refer to vertices that it does not have, or potentials are missing; bake the body again"
    )]
    Surface,
    /// The body has more slices than [`MOST_SLICES`].
    #[error("the body has {0} slices and can have {MOST_SLICES} at most; bake the body again")]
    TooManySlices(usize),
    /// The inertia has no inverse or is not symmetric.
    #[error(
        "the body's inertia is not a symmetric positive definite matrix, nor zero with a mass of zero; check its units (kg m^2) and its rows"
    )]
    Inertia,
    /// The centre of mass asked for has a coordinate that is infinite or not a number.
    #[error("the centre of mass has a coordinate that is not finite")]
    CentreOfMass,
    /// The added mass is not symmetric.
    #[error("the body's added mass is not symmetric; bake the body again")]
    AddedMass,
}

impl Body {
    /// Checks what every model relies on.
    ///
    /// # Errors
    /// See [`BodyError`]; the first fault in the order of the fields.
    pub fn check(&self) -> Result<(), BodyError> {
        nonnegative("mass", self.mass)?;
        for (name, value) in [
            ("volume", self.volume),
            ("thickness", self.thickness),
            ("length", self.length),
            ("largest half-extent", self.half_extents[0]),
            ("second half-extent", self.half_extents[1]),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(BodyError::NotPositive { name, value });
            }
        }
        finite("centre of buoyancy", None, &self.centre_of_buoyancy)?;
        finite("inertia", None, self.inertia.as_flattened())?;
        finite("added mass", None, self.added_mass.as_flattened())?;
        let none = self.mass == 0.0 && self.inertia == [[0.0; 3]; 3];
        if !none && (!symmetric(&self.inertia) || cholesky(&self.inertia).is_none()) {
            return Err(BodyError::Inertia);
        }
        if !symmetric(&self.added_mass) {
            return Err(BodyError::AddedMass);
        }
        self.separation.check()?;
        if self.slices.len() > MOST_SLICES {
            return Err(BodyError::TooManySlices(self.slices.len()));
        }
        for (number, slice) in self.slices.iter().enumerate() {
            slice.check(number)?;
        }
        self.surface.check()
    }

    /// Length l of Eq. (18): the second-largest half-extent (m).
    pub fn turbulence_length(&self) -> f64 {
        self.half_extents[1]
    }

    /// Length L that turns the diffusion coefficient into an angular one: the mean of the two
    /// largest half-extents (m).
    pub fn rotation_length(&self) -> f64 {
        0.5 * (self.half_extents[0] + self.half_extents[1])
    }

    /// Mean density (kg/m^3).
    pub fn density(&self) -> f64 {
        self.mass / self.volume
    }

    /// The same body so many times as large, of the same density: tensors grow with the third to fifth power of its size.
    ///
    /// ```
    /// use langevin_rigid::Body;
    /// let (small, large) = (Body::sphere(0.01, 600.0)?, Body::sphere(0.02, 600.0)?);
    /// let grown = small.scaled(2.0);
    /// assert!((grown.mass / large.mass - 1.0).abs() < 1e-12);
    /// assert!((grown.added_mass[0][0] / large.added_mass[0][0] - 1.0).abs() < 1e-12);
    /// # Ok::<(), langevin_rigid::BodyError>(())
    /// ```
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let power = |n: i32| (0..n).fold(1.0, |power, _| power * factor);
        let vector = |a: Vec3| a.map(|x| factor * x);
        let matrix = |m: &Mat3, n: i32| m.map(|row| row.map(|x| power(n) * x));
        // Translations couple with the third power, each rotation adds one.
        let block = |i: usize, j: usize| power(3 + i32::from(i > 2) + i32::from(j > 2));
        let slice = |slice: &Slice| Slice {
            centre: vector(slice.centre),
            translation: matrix(&slice.translation, 3),
            rotation: matrix(&slice.rotation, 5),
            drag_area: matrix(&slice.drag_area, 2),
            extents: matrix(&slice.extents, 2),
        };
        let Separation {
            drag_area,
            extents,
            stokes_translation,
            stokes_rotation,
        } = &self.separation;
        Self {
            mass: power(3) * self.mass,
            inertia: matrix(&self.inertia, 5),
            volume: power(3) * self.volume,
            centre_of_buoyancy: vector(self.centre_of_buoyancy),
            added_mass: std::array::from_fn(|i| {
                std::array::from_fn(|j| block(i, j) * self.added_mass[i][j])
            }),
            half_extents: vector(self.half_extents),
            thickness: factor * self.thickness,
            length: factor * self.length,
            separation: Separation {
                drag_area: matrix(drag_area, 2),
                extents: matrix(extents, 2),
                stokes_translation: matrix(stokes_translation, 1),
                stokes_rotation: matrix(stokes_rotation, 3),
            },
            slices: self.slices.iter().map(slice).collect(),
            surface: Surface {
                vertices: self.surface.vertices.iter().copied().map(vector).collect(),
                triangles: self.surface.triangles.clone(),
                panels: self.surface.panels.clone(),
                potentials: self
                    .surface
                    .potentials
                    .iter()
                    .map(|p| std::array::from_fn(|i| power(1 + i32::from(i > 2)) * p[i]))
                    .collect(),
            },
        }
    }

    /// The total tensor T = diag(m, J0) + rho_f A (kg, kg m, kg m^2), linear part first.
    pub fn total_mass(&self, fluid_density: f64) -> Mat6 {
        let mut total = self.added_mass.map(|row| row.map(|a| fluid_density * a));
        for i in 0..3 {
            total[i][i] += self.mass;
            for j in 0..3 {
                total[3 + i][3 + j] += self.inertia[i][j];
            }
        }
        total
    }
}

impl Separation {
    fn check(&self) -> Result<(), BodyError> {
        for (name, tensor) in [
            ("drag areas", &self.drag_area),
            ("extents", &self.extents),
            ("Stokes resistance to translation", &self.stokes_translation),
            ("Stokes resistance to rotation", &self.stokes_rotation),
        ] {
            positive(name, None, tensor)?;
        }
        Ok(())
    }
}

impl Slice {
    fn check(&self, number: usize) -> Result<(), BodyError> {
        finite("centre", Some(number), &self.centre)?;
        for (name, tensor) in [
            ("translational added mass", &self.translation),
            ("rotational added mass", &self.rotation),
            ("drag areas", &self.drag_area),
            ("extents", &self.extents),
        ] {
            positive(name, Some(number), tensor)?;
        }
        Ok(())
    }
}

impl Surface {
    fn check(&self) -> Result<(), BodyError> {
        finite("surface vertices", None, self.vertices.as_flattened())?;
        finite("surface potentials", None, self.potentials.as_flattened())?;
        let count = self.vertices.len();
        let triangles = self.triangles.iter().chain(&self.panels);
        let whole = triangles.flatten().all(|&v| (v as usize) < count)
            && (self.potentials.len() == count || self.potentials.is_empty());
        whole.then_some(()).ok_or(BodyError::Surface)
    }
}

/// How an error begins that is about the body or about one of its slices.
fn owner(slice: &Option<usize>) -> String {
    match slice {
        None => "the body has".into(),
        Some(number) => format!("slice {number} of the body (from 0) has"),
    }
}

/// Checks that a quantity is finite and zero or more.
pub(crate) fn nonnegative(name: &'static str, value: f64) -> Result<(), BodyError> {
    match value >= 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(BodyError::Negative { name, value }),
    }
}

fn finite(name: &'static str, slice: Option<usize>, numbers: &[f64]) -> Result<(), BodyError> {
    match numbers.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(BodyError::NotFinite { name, slice }),
    }
}

/// Checks that a tensor is finite, symmetric and without negative eigenvalues, to rounding.
fn positive(name: &'static str, slice: Option<usize>, tensor: &Mat3) -> Result<(), BodyError> {
    finite(name, slice, tensor.as_flattened())?;
    let ([least, _, largest], _) = eigen_symmetric(tensor);
    if symmetric(tensor) && least >= -1e-9 * largest.abs() {
        return Ok(());
    }
    Err(BodyError::NotPositiveTensor { name, slice })
}

/// Whether a finite matrix is symmetric to rounding.
fn symmetric<const N: usize>(m: &[[f64; N]; N]) -> bool {
    let largest = m.iter().flatten().fold(0.0f64, |a, x| a.max(x.abs()));
    (0..N).all(|i| (0..i).all(|j| (m[i][j] - m[j][i]).abs() <= 1e-9 * largest))
}

/// Added mass about another point, by the 6x6 adjoint.
///
/// `offset` leads from the old reference point to the new one (m). With phi the potentials of unit
/// motion, a rotation about the new point is one about the old and a translation by
/// `offset x axis`.
///
/// ```
/// let sphere = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j && i < 3)));
/// let shifted = langevin_rigid::shift_added_mass(&sphere, [2.0, 0.0, 0.0]);
/// assert_eq!(shifted[5][5], 4.0); // unit mass at two metres
/// ```
pub fn shift_added_mass(tensor: &Mat6, offset: Vec3) -> Mat6 {
    let mut motion = [[0.0; 6]; 6];
    for i in 0..3 {
        let axis: Vec3 = std::array::from_fn(|k| f64::from(k == i));
        let carried = cross(offset, axis);
        motion[i][i] = 1.0;
        motion[3 + i][3 + i] = 1.0;
        for k in 0..3 {
            motion[k][3 + i] = carried[k];
        }
    }
    let column =
        |t: &Mat6, i: usize, j: usize| -> f64 { (0..6).map(|k| t[i][k] * motion[k][j]).sum() };
    let right: Mat6 = std::array::from_fn(|i| std::array::from_fn(|j| column(tensor, i, j)));
    let full: Mat6 = std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..6).map(|k| motion[k][i] * right[k][j]).sum())
    });
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (full[i][j] + full[j][i])))
}
