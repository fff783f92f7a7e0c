//! A hull with other contents: cargo shifted, ballast taken in, fuel burnt.

use crate::body::{Body, BodyError, shift_added_mass};
use crate::linalg::{Mat3, Vec3, sub};

impl Body {
    /// The same hull with another mass (kg), centre of mass (m) and inertia (kg m^2).
    ///
    /// `centre_of_mass` is given in the frame of this body, so from its present centre of mass; the axes
    /// stay. `inertia` is about the new centre of mass. All that refers to the centre of mass moves with
    /// it: the centre of buoyancy, the added mass, the slices, the surface. A body that is under way takes
    /// [`State::recentred`](crate::State::recentred) by the same `centre_of_mass`.
    ///
    /// ```
    /// use langevin_rigid::{Body, State};
    ///
    /// // A ball of one litre, and the same with a keel of lead.
    /// let ball = Body::sphere(0.062, 500.0)?;
    /// let keel = [0.0, -0.02, 0.0];
    /// let weighted = ball.with_mass_properties(0.9, keel, ball.inertia)?;
    /// assert_eq!(weighted.centre_of_buoyancy, [0.0, 0.02, 0.0]);
    ///
    /// let spinning = State { angular_velocity: [1.0, 0.0, 0.0], ..State::default() };
    /// assert_eq!(spinning.recentred(keel).velocity, [0.0, 0.0, -0.02]);
    /// # Ok::<(), langevin_rigid::BodyError>(())
    /// ```
    ///
    /// # Errors
    /// See [`Body::check`]; a centre of mass that is not finite is named.
    pub fn with_mass_properties(
        &self,
        mass: f64,
        centre_of_mass: Vec3,
        inertia: Mat3,
    ) -> Result<Body, BodyError> {
        if !centre_of_mass.iter().all(|x| x.is_finite()) {
            return Err(BodyError::CentreOfMass);
        }
        let mut body = self.clone();
        body.mass = mass;
        body.inertia = inertia;
        body.added_mass = shift_added_mass(&self.added_mass, centre_of_mass);
        let parts = body.slices.iter_mut().map(|part| &mut part.centre);
        for point in std::iter::once(&mut body.centre_of_buoyancy)
            .chain(parts)
            .chain(&mut body.surface.vertices)
        {
            *point = sub(*point, centre_of_mass);
        }
        body.check()?;
        Ok(body)
    }
}
