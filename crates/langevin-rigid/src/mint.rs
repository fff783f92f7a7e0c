//! Poses, velocities and what acts on a body, to and from the types of `mint`, which engines' algebra converts to its own.

use mint::{Point3, Quaternion, RowMatrix3, Vector3};

use crate::batch::Precision;
use crate::input::{Flow, Wrench};
use crate::linalg::{Mat3, Vec3};
use crate::state::State;

impl State {
    /// Position of the centre of mass (m) and orientation, body to world.
    ///
    /// With the feature `mint`.
    ///
    /// ```
    /// use glam::{Quat, Vec3};
    /// use langevin_rigid::State;
    ///
    /// let state = State { position: [1.0, 2.0, 3.0], ..State::default() };
    /// let (position, orientation) = state.mint_pose::<f32>();
    /// assert_eq!(Vec3::from(position), Vec3::new(1.0, 2.0, 3.0));
    /// assert_eq!(Quat::from(orientation), Quat::IDENTITY);
    /// ```
    pub fn mint_pose<P: Precision>(&self) -> (Point3<P>, Quaternion<P>) {
        let position = self.position.map(P::of);
        let orientation = self.orientation.map(P::of);
        (position.into(), orientation.into())
    }

    /// Sets the position of the centre of mass (m) and the orientation, body to world, which must be of unit length.
    ///
    /// The velocities stay what they are in the body frame, so they turn with the body; to keep them in the world,
    /// set them afterwards. With the feature `mint`.
    ///
    /// ```
    /// use glam::{DQuat, DVec3};
    /// use langevin_rigid::State;
    ///
    /// let mut state = State::default();
    /// state.set_mint_pose(DVec3::new(0.0, 2.0, 0.0), DQuat::from_rotation_y(0.5));
    /// assert_eq!(state.position, [0.0, 2.0, 0.0]);
    /// assert_eq!(state.orientation, [0.0, 0.25_f64.sin(), 0.0, 0.25_f64.cos()]);
    /// ```
    pub fn set_mint_pose<P: Precision>(
        &mut self,
        position: impl Into<Point3<P>>,
        orientation: impl Into<Quaternion<P>>,
    ) {
        self.position = <[P; 3]>::from(position.into()).map(P::to_f64);
        self.orientation = <[P; 4]>::from(orientation.into()).map(P::to_f64);
    }

    /// Velocity of the centre of mass (m/s) and angular velocity (rad/s), world frame.
    ///
    /// With the feature `mint`.
    pub fn mint_world_velocities<P: Precision>(&self) -> (Vector3<P>, Vector3<P>) {
        let velocity = self.world_velocity().map(P::of);
        let angular_velocity = self.world_angular_velocity().map(P::of);
        (velocity.into(), angular_velocity.into())
    }

    /// Sets the velocity of the centre of mass (m/s) and the angular velocity (rad/s), world frame.
    ///
    /// With the feature `mint`.
    ///
    /// ```
    /// use glam::Vec3;
    /// use langevin_rigid::State;
    ///
    /// let mut state = State::default();
    /// state.set_mint_world_velocities(Vec3::X, Vec3::NEG_Y);
    /// let (velocity, angular_velocity) = state.mint_world_velocities::<f32>();
    /// assert_eq!((velocity, angular_velocity), (Vec3::X.into(), Vec3::NEG_Y.into()));
    /// ```
    pub fn set_mint_world_velocities<P: Precision>(
        &mut self,
        velocity: impl Into<Vector3<P>>,
        angular_velocity: impl Into<Vector3<P>>,
    ) {
        self.set_world_velocities(vector(velocity), vector(angular_velocity));
    }
}

impl Wrench {
    /// A force (N) and a torque about the centre of mass (N m), world frame.
    ///
    /// With the feature `mint`.
    ///
    /// ```
    /// use glam::Vec3;
    /// use langevin_rigid::Wrench;
    ///
    /// // A string that pulls up at a point of the body, 2 cm from its centre of mass.
    /// let (pull, arm) = (Vec3::Y, 0.02 * Vec3::X);
    /// let wrench = Wrench::from_mint(pull, arm.cross(pull));
    /// assert!(wrench.force == [0.0, 1.0, 0.0] && wrench.torque[2] > 0.0);
    /// ```
    pub fn from_mint<P: Precision>(
        force: impl Into<Vector3<P>>,
        torque: impl Into<Vector3<P>>,
    ) -> Self {
        Self {
            force: vector(force),
            torque: vector(torque),
        }
    }
}

impl Flow {
    /// The fluid's velocity (m/s), its gradient (1/s) and its material acceleration (m/s^2) at the centre of mass, world
    /// frame.
    ///
    /// Engines keep their matrices by columns: column j of `gradient` is the change of the velocity along axis j,
    /// du/dx_j. With the feature `mint`.
    ///
    /// ```
    /// use glam::{Mat3, Vec3};
    /// use langevin_rigid::Flow;
    ///
    /// // A wind along x that grows with height.
    /// let gradient = Mat3::from_cols(Vec3::ZERO, 0.5 * Vec3::X, Vec3::ZERO);
    /// let wind = Flow::from_mint(2.0 * Vec3::X, gradient, Vec3::ZERO);
    /// assert_eq!(wind.velocity, [2.0, 0.0, 0.0]);
    /// assert_eq!(wind.gradient[0][1], 0.5);
    /// ```
    pub fn from_mint<P: Precision>(
        velocity: impl Into<Vector3<P>>,
        gradient: impl Into<RowMatrix3<P>>,
        acceleration: impl Into<Vector3<P>>,
    ) -> Self {
        let rows: [[P; 3]; 3] = gradient.into().into();
        let gradient: Mat3 = rows.map(|row| row.map(P::to_f64));
        Self {
            velocity: vector(velocity),
            gradient,
            acceleration: vector(acceleration),
        }
    }
}

fn vector<P: Precision>(a: impl Into<Vector3<P>>) -> Vec3 {
    <[P; 3]>::from(a.into()).map(P::to_f64)
}
