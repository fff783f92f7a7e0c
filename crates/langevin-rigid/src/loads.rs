//! The loads on a body by cause.

use crate::ambient::Ambient;
use crate::equations::FluidLoads;
use crate::input::{Forcing, Input, Wrench};
use crate::kirchhoff::Motion;
use crate::langevin::Langevin;
use crate::linalg::{
    Quat, Vec3, Vec6, add, cross, join, matrix_of, mul, norm, rotate, rotate_back, scale, split,
    sub,
};
use crate::separated::Eddies;
use crate::state::State;
use crate::stepper::{Paper, Stepper, relative_to_turning};

/// What acts on a body in a state, by cause; forces and torques about the centre of mass in the world frame.
///
/// Their sum is the rate at which the impulse of the body and the fluid that it moves changes
/// ([`Stepper::linear_impulse`], [`Stepper::angular_impulse`] about the centre of mass), in the frame that moves with
/// the fluid as it is now. Kicks of noise have no mean and are not among them; the turbulence that a body sees is, in the
/// loads of separated flow.
///
/// ```
/// use langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper};
/// let disc = Body::disc(0.05, 0.001, 500.0)?;
/// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;
/// let falling = State { velocity: [0.0, -1.0, 0.0], ..State::default() };
/// let loads = stepper.loads(&falling, &Input::default());
/// for (cause, wrench) in loads.causes() {
///     println!("{cause}: {:.2e} N, {:.2e} N m", wrench.force[1], wrench.torque[2]);
/// }
/// assert!(loads.drag.force[1] > 0.0 && loads.weight.force[1] < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Loads {
    /// Gravity on the mass of the body.
    pub weight: Wrench,
    /// Buoyancy at the centre of the displaced volume.
    pub buoyancy: Wrench,
    /// Kirchhoff's term of the added mass: the couple p x v that turns a body broadside to its way (Munk 1924).
    pub added_mass: Wrench,
    /// Pressure drag and skin friction.
    pub drag: Wrench,
    /// Normal force of a body at incidence.
    pub normal_force: Wrench,
    /// Lift of the circulation that comes with spin.
    pub rotational_lift: Wrench,
    /// Resistance of the pressure to spin.
    pub damping: Wrench,
    /// What separation takes from the couple of the added mass.
    pub lost_couple: Wrench,
    /// Viscous resistance (Stokes).
    pub friction: Wrench,
    /// Mean load of the turbulence: the relaxation of the Langevin equation, in the models that have it.
    pub turbulence: Wrench,
    /// Push of a fluid that accelerates, (rho V + A) Du/Dt.
    pub fluid_acceleration: Wrench,
    /// The wrench of the input.
    pub outside: Wrench,
}

impl Loads {
    /// Each with the name of its field.
    pub fn causes(&self) -> [(&'static str, Wrench); 12] {
        [
            ("weight", self.weight),
            ("buoyancy", self.buoyancy),
            ("added_mass", self.added_mass),
            ("drag", self.drag),
            ("normal_force", self.normal_force),
            ("rotational_lift", self.rotational_lift),
            ("damping", self.damping),
            ("lost_couple", self.lost_couple),
            ("friction", self.friction),
            ("turbulence", self.turbulence),
            ("fluid_acceleration", self.fluid_acceleration),
            ("outside", self.outside),
        ]
    }

    /// All together.
    pub fn sum(&self) -> Wrench {
        let causes = self.causes();
        causes
            .iter()
            .fold(Wrench::default(), |sum, (_, wrench)| Wrench {
                force: add(sum.force, wrench.force),
                torque: add(sum.torque, wrench.torque),
            })
    }
}

impl Loads {
    /// Share of its weight by which a body at rest must be pushed to move ([`Stepper::push_to_weight`]): what engines wake
    /// sleeping bodies by. Friction holds less than a coefficient of 0.5 would say, since wind also lifts.
    pub const STIRRING: f64 = 0.3;

    /// These with a `share` of `other` in the place of as much of them: the loads on a body in two fluids, of whose volume
    /// this share is in the other.
    #[must_use]
    pub fn mixed(&self, other: &Self, share: f64) -> Self {
        let vector = |a: Vec3, b: Vec3| add(scale(1.0 - share, a), scale(share, b));
        let mix = |of: fn(&Self) -> Wrench| Wrench {
            force: vector(of(self).force, of(other).force),
            torque: vector(of(self).torque, of(other).torque),
        };
        Self {
            weight: mix(|loads| loads.weight),
            buoyancy: mix(|loads| loads.buoyancy),
            added_mass: mix(|loads| loads.added_mass),
            drag: mix(|loads| loads.drag),
            normal_force: mix(|loads| loads.normal_force),
            rotational_lift: mix(|loads| loads.rotational_lift),
            damping: mix(|loads| loads.damping),
            lost_couple: mix(|loads| loads.lost_couple),
            friction: mix(|loads| loads.friction),
            turbulence: mix(|loads| loads.turbulence),
            fluid_acceleration: mix(|loads| loads.fluid_acceleration),
            outside: mix(|loads| loads.outside),
        }
    }
}

impl Stepper {
    /// The loads on the body in `state` under `input`, by cause.
    pub fn loads(&self, state: &State, input: &Input) -> Loads {
        let forcing = Forcing::of(input);
        let motion = self
            .equations
            .relative_to_fluid(&state.motion(), forcing.as_ref());
        let mut loads = Loads {
            outside: input.wrench,
            fluid_acceleration: self.pushed(state.orientation, input.flow.acceleration),
            ..Loads::default()
        };
        let kirchhoff = &self.equations.kirchhoff;
        let arm = rotate(state.orientation, kirchhoff.centre_of_buoyancy);
        loads.weight.force = sub(kirchhoff.weight, kirchhoff.buoyancy);
        loads.buoyancy = Wrench {
            force: kirchhoff.buoyancy,
            torque: cross(arm, kirchhoff.buoyancy),
        };
        let (v, _) = split(&motion.xi);
        let (p, _) = split(&mul(&kirchhoff.total, &motion.xi));
        loads.added_mass.torque = rotate(state.orientation, cross(p, v));
        self.add_of_model(&motion, state.time, forcing.as_ref(), &mut loads);
        loads
    }

    /// How hard `loads` push a body that lies still, over what holds it: the force of all but weight and buoyancy over the
    /// weight in the fluid or, if that is more, the torque from outside over that weight at the radius of gyration.
    ///
    /// Not a number where nothing acts on a body without weight.
    ///
    /// ```
    /// use langevin_rigid::{Body, Flow, Fluid, Input, Loads, Settings, State, Stepper};
    /// let leaf = Body::plate(0.08, 0.05, 0.2e-3, 450.0)?;
    /// let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &Settings::default())?;
    /// let push = |wind| {
    ///     let input = Input { flow: Flow::uniform([wind, 0.0, 0.0]), ..Input::default() };
    ///     stepper.push_to_weight(&stepper.loads(&State::default(), &input))
    /// };
    /// assert!(push(0.1) < 0.05 && push(5.0) > Loads::STIRRING);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn push_to_weight(&self, loads: &Loads) -> f64 {
        let weight = add(loads.weight.force, loads.buoyancy.force);
        let push = norm(sub(loads.sum().force, weight));
        let total = self.total_mass();
        let inertia = (3..6).map(|k| total[k][k]).fold(0.0, f64::max);
        let mass = (0..3).map(|k| total[k][k]).fold(f64::INFINITY, f64::min);
        let turning = norm(loads.outside.torque) / (inertia / mass).sqrt();
        push.max(turning) / norm(weight)
    }

    /// Velocity of the centre of mass (m/s) and angular velocity (rad/s) relative to the undisturbed fluid, body frame.
    pub fn relative_velocities(&self, state: &State, input: &Input) -> [Vec3; 2] {
        let forcing = Forcing::of(input);
        let motion = self
            .equations
            .relative_to_fluid(&state.motion(), forcing.as_ref());
        let turned = rotate_back(state.orientation, input.flow.rotation_rate());
        let (velocity, angular_velocity) = split(&motion.xi);
        [velocity, sub(angular_velocity, turned)]
    }

    /// Attachment of the flow under [`Model::Separated`](crate::Model::Separated): the fraction of Munk's couple that
    /// separation leaves, the mean along the body. None in models without it.
    ///
    /// ```
    /// use langevin_rigid::{Body, Fluid, Input, Model, Settings, State, Stepper};
    /// let disc = Body::disc(0.05, 0.001, 500.0)?;
    /// let settings = Settings { model: Model::Separated, ..Settings::default() };
    /// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &settings)?;
    /// let attachment = |velocity| {
    ///     let state = State { velocity, ..State::default() };
    ///     stepper.attachment(&state, &Input::default())
    /// };
    /// assert!(attachment([1.0, -0.1, 0.0]) > attachment([0.0, -1.0, 0.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn attachment(&self, state: &State, input: &Input) -> Option<f64> {
        let (None, FluidLoads::Separated(separated)) = (self.paper(), &self.equations.loads) else {
            return None;
        };
        let forcing = Forcing::of(input);
        let motion = self
            .equations
            .relative_to_fluid(&state.motion(), forcing.as_ref());
        let ambient = ambient(&separated.eddies, &motion, state.time, forcing.as_ref());
        Some(separated.closure.attachment(&motion.xi, &ambient))
    }

    /// (rho V + A) a, with its torque.
    fn pushed(&self, orientation: Quat, acceleration: Vec3) -> Wrench {
        let kirchhoff = &self.equations.kirchhoff;
        let a = rotate_back(orientation, acceleration);
        let (force, torque) = split(&mul(&kirchhoff.total, &join(a, [0.0; 3])));
        let mass = kirchhoff.net_mass + kirchhoff.displaced;
        let displaced = scale(kirchhoff.displaced, a);
        Wrench {
            force: rotate(orientation, add(sub(force, scale(mass, a)), displaced)),
            torque: rotate(
                orientation,
                add(torque, cross(kirchhoff.centre_of_buoyancy, displaced)),
            ),
        }
    }

    /// Adds what the model has beside Kirchhoff's terms and `input` to `loads`.
    fn add_of_model(
        &self,
        motion: &Motion,
        time: f64,
        forcing: Option<&Forcing>,
        loads: &mut Loads,
    ) {
        let world = |load: &Vec6| {
            let (force, torque) = split(load);
            Wrench {
                force: rotate(motion.orientation, force),
                torque: rotate(motion.orientation, torque),
            }
        };
        let relaxing = |langevin: &Langevin| {
            let relative = relative_to_turning(&motion.xi, motion.orientation, forcing);
            world(&langevin.relaxation(&relative, time))
        };
        match (self.paper(), &self.equations.loads) {
            (Some(Paper::RungeKutta4(None)), _) | (None, FluidLoads::None) => {}
            (Some(Paper::RungeKutta4(Some(langevin))), _) => loads.turbulence = relaxing(langevin),
            (Some(Paper::Published(published)), _) => {
                let printed = published.loads(motion, time);
                loads.buoyancy.torque = world(&printed.buoyancy).torque;
                loads.added_mass = world(&printed.added_mass);
                loads.turbulence = world(&printed.turbulence);
            }
            (None, FluidLoads::Langevin(langevin)) => loads.turbulence = relaxing(langevin),
            (None, FluidLoads::Separated(separated)) => {
                let ambient = ambient(&separated.eddies, motion, time, forcing);
                let causes = separated.closure.causes(&motion.xi, &ambient);
                loads.drag = world(&causes.drag);
                loads.normal_force = world(&causes.normal_force);
                loads.rotational_lift = world(&causes.rotational_lift);
                loads.damping = world(&causes.damping);
                loads.lost_couple = world(&causes.lost_couple);
                loads.friction = world(&causes.friction);
            }
        }
    }
}

/// What the closure sees of the fluid around the body, body frame.
fn ambient(eddies: &Eddies, motion: &Motion, time: f64, forcing: Option<&Forcing>) -> Ambient {
    let ambient = Ambient {
        gradient: forcing.and_then(|forcing| forcing.gradient),
        fluctuation: eddies.now(motion, time),
    };
    ambient.seen_from(&matrix_of(motion.orientation))
}
