//! How the undisturbed fluid moves around a body, beyond the uniform motion of the frame that goes with it.

use crate::input::rotation_rate;
use crate::kirchhoff::seen_from;
use crate::linalg::{
    Mat3, Vec3, Vec6, add, cross, dot, join, mat_vec, split, sub, transposed_mat_vec,
};
use crate::real::Real;

/// Gradient and fluctuation of the fluid's velocity; the frame is the holder's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ambient<R = f64> {
    /// Gradient of the fluid's velocity (1/s).
    pub(crate) gradient: Option<Mat3<R>>,
    /// Velocity and rotation rate of the turbulence at the centre of mass (m/s, rad/s).
    pub(crate) fluctuation: Option<Vec6<R>>,
}

/// Fluid that does nothing but go with the frame.
pub(crate) const STILL: Ambient = Ambient {
    gradient: None,
    fluctuation: None,
};

impl<R: Real> Ambient<R> {
    /// The same in the frame whose axes are the columns of `matrix`.
    #[inline(always)]
    pub(crate) fn seen_from(&self, matrix: &Mat3<R>) -> Self {
        Self {
            gradient: self.gradient.map(
                #[inline(always)]
                |gradient| seen_from(matrix, &gradient),
            ),
            fluctuation: self.fluctuation.map(
                #[inline(always)]
                |fluctuation| {
                    let (velocity, rotation) = split(&fluctuation);
                    join(
                        transposed_mat_vec(matrix, velocity),
                        transposed_mat_vec(matrix, rotation),
                    )
                },
            ),
        }
    }
}

/// The motion of a body relative to the fluid around it, body frame.
pub(crate) struct Relative<'a, R> {
    /// Velocity of the centre of mass (m/s).
    v: Vec3<R>,
    /// Angular velocity relative to the turbulence (rad/s), which carries the points of the body.
    spin: Vec3<R>,
    /// Angular velocity relative to all of the fluid (rad/s).
    pub(crate) omega: Vec3<R>,
    /// Rotation rate of the fluid that its gradient has (rad/s), zero without one.
    turning: Vec3<R>,
    ambient: &'a Ambient<R>,
}

impl<'a, R: Real> Relative<'a, R> {
    #[inline(always)]
    pub(crate) fn new(xi: &Vec6<R>, ambient: &'a Ambient<R>) -> Self {
        let (mut v, mut spin) = split(xi);
        if let Some(fluctuation) = &ambient.fluctuation {
            let (velocity, rotation) = split(fluctuation);
            v = sub(v, velocity);
            spin = sub(spin, rotation);
        }
        let (mut omega, mut turning) = (spin, [v[0].of(0.0); 3]);
        if let Some(gradient) = &ambient.gradient {
            turning = rotation_rate(gradient);
            omega = sub(spin, turning);
        }
        Self {
            v,
            spin,
            omega,
            turning,
            ambient,
        }
    }

    /// Velocity of the point `centre` of the body relative to the fluid there.
    #[inline(always)]
    pub(crate) fn at(&self, centre: Vec3<R>) -> Vec3<R> {
        let velocity = add(self.v, cross(self.spin, centre));
        match &self.ambient.gradient {
            Some(gradient) => sub(velocity, mat_vec(gradient, centre)),
            None => velocity,
        }
    }

    /// Velocity of the centre of mass relative to the fluid there.
    #[inline(always)]
    pub(crate) fn at_centre_of_mass(&self) -> Vec3<R> {
        self.v
    }

    /// Power (W) that a force at `centre` and a couple have on the motion of the body beyond that on its motion
    /// relative to the fluid, by the fluid's gradient.
    #[inline(always)]
    pub(crate) fn fed(&self, centre: Vec3<R>, force: Vec3<R>, couple: Vec3<R>) -> R {
        match &self.ambient.gradient {
            Some(gradient) => dot(force, mat_vec(gradient, centre)) + dot(couple, self.turning),
            None => self.v[0].of(0.0),
        }
    }

    /// Power (W) of a force and a torque about the centre of mass on the motion relative to the turbulence.
    #[inline(always)]
    pub(crate) fn power(&self, force: Vec3<R>, torque: Vec3<R>) -> R {
        dot(force, self.v) + dot(torque, self.spin)
    }
}
