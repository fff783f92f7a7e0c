//! What acts on a body, by cause.

use langevin_rigid::Loads;

use crate::input::lr_wrench;

/// What acts on a body, by cause: forces and torques about the centre of mass, world frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_loads {
    /// Gravity on the mass of the body.
    pub weight: lr_wrench,
    /// Buoyancy at the centre of the displaced volume.
    pub buoyancy: lr_wrench,
    /// Kirchhoff's term of the added mass: the couple that turns a body broadside to its way.
    pub added_mass: lr_wrench,
    /// Pressure drag and skin friction.
    pub drag: lr_wrench,
    /// Normal force of a body at incidence.
    pub normal_force: lr_wrench,
    /// Lift of the circulation that comes with spin.
    pub rotational_lift: lr_wrench,
    /// Resistance of the pressure to spin.
    pub damping: lr_wrench,
    /// What separation takes from the couple of the added mass.
    pub lost_couple: lr_wrench,
    /// Viscous resistance (Stokes).
    pub friction: lr_wrench,
    /// Mean load of the turbulence, in the models that have it.
    pub turbulence: lr_wrench,
    /// Push of a fluid that accelerates.
    pub fluid_acceleration: lr_wrench,
    /// The wrench of the input.
    pub outside: lr_wrench,
    /// All together.
    pub sum: lr_wrench,
}

impl From<Loads> for lr_loads {
    fn from(loads: Loads) -> Self {
        Self {
            weight: loads.weight.into(),
            buoyancy: loads.buoyancy.into(),
            added_mass: loads.added_mass.into(),
            drag: loads.drag.into(),
            normal_force: loads.normal_force.into(),
            rotational_lift: loads.rotational_lift.into(),
            damping: loads.damping.into(),
            lost_couple: loads.lost_couple.into(),
            friction: loads.friction.into(),
            turbulence: loads.turbulence.into(),
            fluid_acceleration: loads.fluid_acceleration.into(),
            outside: loads.outside.into(),
            sum: loads.sum().into(),
        }
    }
}
