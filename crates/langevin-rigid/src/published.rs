//! Equations (11) and (12) to the letter, to study the paper.
//!
//! They are not used as they stand anywhere else: the cross term is v x (M omega) where Kirchhoff's is
//! omega x (M v), the relaxation and the noise are divided by a mass that they do not contain, the
//! angular noise lacks a length and the angular velocity a relaxation. The numbers therefore depend
//! on the system of units, and the scheme diverges at ordinary steps.

use crate::body::Body;
use crate::fluid::Fluid;
use crate::kirchhoff::Motion;
use crate::linalg::{
    Mat3, Vec3, Vec6, cross, invert_spd, join, mat_vec, norm, rotate_back, scale, split, sub,
};
use crate::runge_kutta;
use crate::turbulence::{Coefficients, LangevinCoefficients, PreparedSource};

/// The system of units in which the printed equations are evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UnitSystem {
    /// Centimetres, grams, seconds: the paper's.
    #[default]
    Cgs,
    /// Metres, kilograms, seconds.
    Si,
}

impl UnitSystem {
    /// The size of its units of length (m) and mass (kg).
    fn sizes(self) -> (f64, f64) {
        match self {
            Self::Cgs => (1e-2, 1e-3),
            Self::Si => (1.0, 1.0),
        }
    }
}

/// The printed equations of one body, in their own units.
#[derive(Debug, Clone)]
pub(crate) struct Published {
    /// Units of length (m) and force (N).
    length: f64,
    force: f64,
    mass: Mat3,
    inverse_mass: Mat3,
    inertia: Mat3,
    inverse_inertia: Mat3,
    added_mass: Mat3,
    /// (m - rho_f V) g, world frame.
    weight: Vec3,
    /// rho_f V g, world frame: the factor of Eq. (6) with its printed sign.
    displaced_weight: Vec3,
    centre_of_buoyancy: Vec3,
    source: PreparedSource,
}

/// See [`Published::loads`].
pub(crate) struct PrintedLoads {
    pub(crate) buoyancy: Vec6,
    pub(crate) added_mass: Vec6,
    pub(crate) turbulence: Vec6,
}

impl Published {
    /// `None` if a tensor is not positive definite.
    pub(crate) fn new(
        body: &Body,
        fluid: &Fluid,
        gravity: Vec3,
        units: UnitSystem,
        source: PreparedSource,
    ) -> Option<Self> {
        let (length, mass_unit) = units.sizes();
        let total = body.total_mass(fluid.density);
        let block = |k: usize, unit: f64| -> Mat3 {
            std::array::from_fn(|i| std::array::from_fn(|j| total[k + i][k + j] / unit))
        };
        let mass = block(0, mass_unit);
        let inertia = block(3, mass_unit * length * length);
        let added_mass = std::array::from_fn(|i| {
            std::array::from_fn(|j| fluid.density * body.added_mass[i][j] / mass_unit)
        });
        let displaced = fluid.density * body.volume;
        let force_unit = mass_unit * length;
        Some(Self {
            length,
            force: force_unit,
            inverse_mass: invert_spd(&mass)?,
            inverse_inertia: invert_spd(&inertia)?,
            mass,
            inertia,
            added_mass,
            weight: scale((body.mass - displaced) / force_unit, gravity),
            displaced_weight: scale(displaced / force_unit, gravity),
            centre_of_buoyancy: scale(1.0 / length, body.centre_of_buoyancy),
            source,
        })
    }

    /// One step: Runge-Kutta for the deterministic part, then the noise of Euler and Maruyama.
    ///
    /// `outside` is the generalized force (body frame, SI) of what the printed equations do not know.
    pub(crate) fn step(
        &self,
        motion: &mut Motion,
        time: f64,
        h: f64,
        normals: &[f64; 6],
        outside: impl Fn(&Motion) -> Vec6,
    ) {
        let start = motion.xi;
        runge_kutta::step(motion, time, h, |m, t| {
            let printed = self.acceleration(m, t);
            let (force, torque) = split(&outside(m));
            let further = self.to_si(
                mat_vec(&self.inverse_mass, scale(1.0 / self.force, force)),
                mat_vec(
                    &self.inverse_inertia,
                    scale(1.0 / (self.force * self.length), torque),
                ),
            );
            std::array::from_fn(|i| printed[i] + further[i])
        });
        let beta = self.coefficients(&start, time).beta * h.sqrt();
        let (first, second) = split(&normals.map(|z| beta * z));
        let kick = self.to_si(
            mat_vec(&self.inverse_mass, first),
            mat_vec(&self.inverse_inertia, second),
        );
        for i in 0..6 {
            motion.xi[i] += kick[i];
        }
    }

    /// What the printed equations make of the change of the impulse beside weight, body frame (SI).
    pub(crate) fn loads(&self, motion: &Motion, time: f64) -> PrintedLoads {
        let (v_si, omega) = split(&motion.xi);
        let v = scale(1.0 / self.length, v_si);
        let alpha = self.coefficients(&motion.xi, time).alpha;
        let displaced = rotate_back(motion.orientation, self.displaced_weight);
        let load = |force, torque| {
            join(
                scale(self.force, force),
                scale(self.force * self.length, torque),
            )
        };
        let turned = sub(
            cross(omega, mat_vec(&self.mass, v)),
            cross(v, mat_vec(&self.mass, omega)),
        );
        PrintedLoads {
            buoyancy: load([0.0; 3], cross(self.centre_of_buoyancy, displaced)),
            added_mass: load(turned, scale(-1.0, cross(v, mat_vec(&self.added_mass, v)))),
            turbulence: load(scale(-alpha, v), [0.0; 3]),
        }
    }

    /// Coefficients in the printed units: alpha has the same number in all of them.
    fn coefficients(&self, xi: &Vec6, time: f64) -> LangevinCoefficients {
        let speed = norm(split(xi).0);
        let Coefficients { alpha, diffusion } = self.source.coefficients(speed, time);
        LangevinCoefficients {
            alpha,
            beta: diffusion.sqrt() / self.length,
        }
    }

    fn to_si(&self, velocity: Vec3, angular: Vec3) -> Vec6 {
        join(scale(self.length, velocity), angular)
    }

    /// The deterministic right-hand sides of Eqs. (11) and (12) over dt, in SI.
    fn acceleration(&self, motion: &Motion, time: f64) -> Vec6 {
        let (v_si, omega) = split(&motion.xi);
        let v = scale(1.0 / self.length, v_si);
        let alpha = self.coefficients(&motion.xi, time).alpha;
        let weight = rotate_back(motion.orientation, self.weight);
        let displaced = rotate_back(motion.orientation, self.displaced_weight);

        let force = sub(
            sub(weight, cross(v, mat_vec(&self.mass, omega))),
            scale(alpha, v),
        );
        let torque = sub(
            sub(
                cross(self.centre_of_buoyancy, displaced),
                cross(omega, mat_vec(&self.inertia, omega)),
            ),
            cross(v, mat_vec(&self.added_mass, v)),
        );
        self.to_si(
            mat_vec(&self.inverse_mass, force),
            mat_vec(&self.inverse_inertia, torque),
        )
    }
}
