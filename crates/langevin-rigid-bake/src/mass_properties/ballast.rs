//! Points of mass added to a body.

use super::{MassError, MassProperties, check_positive};
use crate::mesh::vector::{add, dot, scale, sub};

/// Mass added at a point of a body, or just outside it: a nut, a paper clip, a motor.
///
/// It displaces no fluid and changes no surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ballast {
    /// Its mass (kg).
    pub mass: f64,
    /// Its centre (m), in the frame of the mesh.
    pub position: [f64; 3],
    /// Radius of the solid sphere whose inertia it has about its own centre (m); 0 for a point.
    pub radius: f64,
}

impl MassProperties {
    /// The same body with ballast added to what it has.
    ///
    /// ```
    /// use langevin_rigid_bake::mass_properties::{Ballast, MassProperties};
    /// use langevin_rigid_bake::shapes::Shape;
    ///
    /// let rod = Shape::Box { size: [1.0, 0.01, 0.01] }.mesh(12)?;
    /// let rod = MassProperties::of(&rod, 1000.0)?; // 0.1 kg
    /// let tip = Ballast { mass: 0.1, position: [0.5, 0.0, 0.0], radius: 0.0 };
    /// let rod = rod.with_ballast(&[tip])?;
    /// assert!((rod.mass - 0.2).abs() < 1e-12);
    /// assert!((rod.centre_of_mass[0] - 0.25).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MassError::NotPositive`], [`MassError::BallastRadius`] and [`MassError::NotFinite`] where a ballast has
    /// no such mass, radius or position; [`MassError::Scale`] where what comes out is too large or too small.
    pub fn with_ballast(self, ballast: &[Ballast]) -> Result<MassProperties, MassError> {
        if ballast.is_empty() {
            return Ok(self);
        }
        let (mut mass, mut first) = (self.mass, [0.0; 3]);
        for item in ballast {
            item.check()?;
            mass += item.mass;
            let arm = sub(item.position, self.centre_of_mass);
            first = add(first, scale(item.mass, arm));
        }
        let centre = add(self.centre_of_mass, scale(1.0 / mass, first));
        let mut inertia = self.inertia;
        add_to(
            &mut inertia,
            self.mass,
            sub(self.centre_of_mass, centre),
            0.0,
        );
        for item in ballast {
            let arm = sub(item.position, centre);
            add_to(&mut inertia, item.mass, arm, item.radius);
        }
        MassProperties {
            mass,
            centre_of_mass: centre,
            inertia,
            ..self
        }
        .within_range()
    }
}

impl Ballast {
    fn check(&self) -> Result<(), MassError> {
        check_positive("mass of a ballast", self.mass, "kg")?;
        if !self.position.iter().all(|x| x.is_finite()) {
            return Err(MassError::NotFinite {
                quantity: "position of a ballast",
            });
        }
        if !(self.radius >= 0.0 && self.radius.is_finite()) {
            return Err(MassError::BallastRadius {
                radius: self.radius,
            });
        }
        Ok(())
    }
}

/// Adds the inertia of a solid sphere at the end of an arm.
fn add_to(inertia: &mut [[f64; 3]; 3], mass: f64, arm: [f64; 3], radius: f64) {
    let diagonal = dot(arm, arm) + 0.4 * radius * radius;
    for i in 0..3 {
        for j in 0..3 {
            let own = if i == j { diagonal } else { 0.0 };
            inertia[i][j] += mass * (own - arm[i] * arm[j]);
        }
    }
}
