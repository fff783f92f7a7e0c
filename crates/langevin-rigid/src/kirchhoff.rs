//! Kirchhoff's equations: a body in ideal fluid under its weight and buoyancy.
//!
//! With T the total tensor and (p, l) = T (v, omega) the momenta in the body frame,
//!
//! ```text
//! p' = p x omega + F,    l' = l x omega + p x v + Gamma
//! ```
//!
//! which is Eq. (4) in full 6x6 form, its first line read as omega x (M v). In the world frame the
//! same equations say that the linear impulse R p and the angular impulse R l + x x R p change by the
//! loads alone. [`Kirchhoff::step`] integrates those impulses, so they stay exact to rounding where
//! nothing acts.

use crate::body::Body;
use crate::fluid::Fluid;
use crate::linalg::{
    Mat6, Quat, Vec3, Vec6, add, add_scaled, cross, dot, dot6, invert_spd, join, mul,
    quat_from_rotation_vector, quat_mul, quat_normalize, rotate, rotate_back, scale, split, sub,
};

/// Pose, and velocity relative to the fluid in the body frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) position: Vec3,
    pub(crate) orientation: Quat,
    /// (v - R^T u, omega), body frame.
    pub(crate) xi: Vec6,
}

/// The total tensor and the static loads of a body in a fluid.
#[derive(Debug, Clone)]
pub(crate) struct Kirchhoff {
    /// T = diag(m, J0) + A.
    pub(crate) total: Mat6,
    pub(crate) inverse: Mat6,
    /// Gravity less buoyancy, world frame (N), Eq. (5).
    weight: Vec3,
    /// Buoyancy, world frame (N), acting at `centre_of_buoyancy`.
    buoyancy: Vec3,
    centre_of_buoyancy: Vec3,
}

/// What changes over one step, world frame: rotation vector and displacement since its start, the
/// linear impulse, and the angular impulse about the place where the centre of mass was then.
#[derive(Clone, Copy)]
struct Increment {
    theta: Vec3,
    displacement: Vec3,
    linear: Vec3,
    angular: Vec3,
}

impl Increment {
    fn plus(self, h: f64, rate: &Self) -> Self {
        Self {
            theta: add_scaled(self.theta, h, rate.theta),
            displacement: add_scaled(self.displacement, h, rate.displacement),
            linear: add_scaled(self.linear, h, rate.linear),
            angular: add_scaled(self.angular, h, rate.angular),
        }
    }
}

impl Kirchhoff {
    /// `None` if the total tensor is not positive definite.
    pub(crate) fn new(body: &Body, fluid: &Fluid, gravity: Vec3) -> Option<Self> {
        let total = body.total_mass(fluid.density);
        let displaced = fluid.density * body.volume;
        Some(Self {
            total,
            inverse: invert_spd(&total)?,
            weight: scale(body.mass - displaced, gravity),
            buoyancy: scale(-displaced, gravity),
            centre_of_buoyancy: body.centre_of_buoyancy,
        })
    }

    /// Kinetic energy of body and fluid, 1/2 xi . T xi (J), in the frame of the undisturbed fluid.
    pub(crate) fn energy(&self, xi: &Vec6) -> f64 {
        0.5 * dot6(xi, &mul(&self.total, xi))
    }

    /// Generalized force in the body frame: gravity, buoyancy and its torque, Eqs. (5) and (6).
    ///
    /// The torque is r x R^T (-rho_f V g): a body whose centre of buoyancy lies above its centre of
    /// mass is stable. Eq. (6) is printed with the opposite sign.
    pub(crate) fn static_load(&self, orientation: Quat) -> Vec6 {
        let buoyancy = rotate_back(orientation, self.buoyancy);
        join(
            rotate_back(orientation, self.weight),
            cross(self.centre_of_buoyancy, buoyancy),
        )
    }

    /// The rate of the momenta (p, l) in the body frame from Kirchhoff's terms alone.
    pub(crate) fn momentum_rate(&self, xi: &Vec6) -> Vec6 {
        let (v, omega) = split(xi);
        let (p, l) = split(&mul(&self.total, xi));
        join(cross(p, omega), add(cross(l, omega), cross(p, v)))
    }

    /// One step by the fourth-order Runge-Kutta-Munthe-Kaas scheme on the rotation group.
    ///
    /// `load` is a further generalized force about the centre of mass, body frame, from the velocity
    /// relative to the fluid.
    pub(crate) fn step(&self, motion: &mut Motion, h: f64, load: impl Fn(&Vec6) -> Vec6) {
        let start = motion.orientation;
        let (p, l) = split(&mul(&self.total, &motion.xi));
        let at_start = Increment {
            theta: [0.0; 3],
            displacement: [0.0; 3],
            linear: rotate(start, p),
            angular: rotate(start, l),
        };
        let rate = |y: &Increment| self.rate(start, y, &load);

        let k1 = rate(&at_start);
        let k2 = rate(&at_start.plus(0.5 * h, &k1));
        let k3 = rate(&at_start.plus(0.5 * h, &k2));
        let k4 = rate(&at_start.plus(h, &k3));
        let end = at_start
            .plus(h / 6.0, &k1)
            .plus(h / 3.0, &k2)
            .plus(h / 3.0, &k3)
            .plus(h / 6.0, &k4);

        let (orientation, xi) = self.motion_of(start, &end);
        motion.orientation = quat_normalize(orientation);
        motion.position = add(motion.position, end.displacement);
        motion.xi = xi;
    }

    /// Orientation and velocity after the increment.
    fn motion_of(&self, start: Quat, y: &Increment) -> (Quat, Vec6) {
        let orientation = quat_mul(start, quat_from_rotation_vector(y.theta));
        let p = rotate_back(orientation, y.linear);
        let l = rotate_back(orientation, sub(y.angular, cross(y.displacement, y.linear)));
        (orientation, mul(&self.inverse, &join(p, l)))
    }

    fn rate(&self, start: Quat, y: &Increment, load: &impl Fn(&Vec6) -> Vec6) -> Increment {
        let (orientation, xi) = self.motion_of(start, y);
        let (v, omega) = split(&xi);
        let (force, torque) = split(&load(&xi));
        let force = add(self.weight, rotate(orientation, force));
        let torque = add(
            rotate(orientation, torque),
            cross(rotate(orientation, self.centre_of_buoyancy), self.buoyancy),
        );
        Increment {
            theta: rotation_vector_rate(y.theta, omega),
            displacement: rotate(orientation, v),
            linear: force,
            angular: add(cross(y.displacement, force), torque),
        }
    }
}

/// theta' for R = R0 exp(theta) and R' = R omega: the inverse of the exponential's differential.
fn rotation_vector_rate(theta: Vec3, omega: Vec3) -> Vec3 {
    let twist = cross(theta, omega);
    let c = 1.0 / 12.0 + dot(theta, theta) / 720.0;
    add_scaled(add_scaled(omega, 0.5, twist), c, cross(theta, twist))
}
