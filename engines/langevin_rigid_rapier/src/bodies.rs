//! The immersed bodies of a world.

use std::sync::Arc;

use indexmap::IndexMap;
use langevin_rigid::{Input, State, StepError, Stepper};
use rapier3d::prelude::{
    ColliderSet, NarrowPhase, RigidBody, RigidBodyHandle, RigidBodySet, Vector,
};

use crate::body::Body;
use crate::convert::array;

/// The bodies of a Rapier world that move through a fluid.
///
/// See the [crate] for an example and for what a step does.
#[derive(Debug, Clone, Default)]
pub struct ImmersedBodies {
    /// In the order in which they came.
    bodies: IndexMap<RigidBodyHandle, Body>,
}

/// What a rigid body is immersed with.
#[derive(Debug, Clone)]
pub struct Immersion {
    /// The body in its fluid; bodies of one shape in one fluid share it.
    pub stepper: Arc<Stepper>,
    /// Centre of mass in the frame of the rigid body (m): zero where its colliders are placed about the centre of mass.
    pub centre_of_mass: [f64; 3],
    /// How far ahead contacts are looked for (m): about what the body moves in a step, so that nothing thin is passed.
    pub contact_distance: f32,
}

/// Why a rigid body cannot be immersed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InsertError {
    /// The handle is of no rigid body.
    #[error("there is no rigid body {0:?} in this set")]
    Missing(RigidBodyHandle),
    /// The rigid body is fixed or kinematic.
    #[error("the rigid body {0:?} is not dynamic; make it with `RigidBodyBuilder::dynamic`")]
    NotDynamic(RigidBodyHandle),
    /// The rigid body is immersed already.
    #[error("the rigid body {0:?} is immersed already; remove it first")]
    Twice(RigidBodyHandle),
    /// A number of the immersion is not finite, or the distance is negative.
    #[error(
        "the centre of mass of {0:?} must be finite, its contact distance zero or a positive number"
    )]
    Number(RigidBodyHandle),
}

/// A body that could not step. It keeps the state that it had, and Rapier moves it on with its velocities.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the body {body:?}: {error}")]
pub struct StepTrouble {
    /// Which one.
    pub body: RigidBodyHandle,
    /// Why.
    pub error: StepError,
}

impl ImmersedBodies {
    /// No bodies.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Immerses a rigid body where it is, with the velocities that it has.
    ///
    /// Its colliders weigh nothing from now on, Rapier's gravity, damping and gyroscopic forces leave it alone: its mass is
    /// that of the stepper's body. The axes of the stepper's body are those of the rigid body.
    ///
    /// # Errors
    /// [`InsertError`], and nothing has changed.
    pub fn insert(
        &mut self,
        handle: RigidBodyHandle,
        immersion: Immersion,
        bodies: &mut RigidBodySet,
        colliders: &mut ColliderSet,
    ) -> Result<(), InsertError> {
        let Immersion {
            stepper,
            centre_of_mass,
            contact_distance,
        } = immersion;
        let body = bodies.get_mut(handle).ok_or(InsertError::Missing(handle))?;
        if !body.is_dynamic() {
            return Err(InsertError::NotDynamic(handle));
        }
        if self.bodies.contains_key(&handle) {
            return Err(InsertError::Twice(handle));
        }
        let distance = (0.0..f32::INFINITY).contains(&contact_distance);
        if !distance || !centre_of_mass.iter().all(|x| x.is_finite()) {
            return Err(InsertError::Number(handle));
        }
        for collider in body.colliders() {
            if let Some(collider) = colliders.get_mut(*collider) {
                collider.set_density(0.0);
            }
        }
        body.set_gravity_scale(0.0, false);
        body.set_linear_damping(0.0);
        body.set_angular_damping(0.0);
        body.enable_gyroscopic_forces(false);
        body.set_soft_ccd_prediction(contact_distance);
        // A body that tumbles may turn further in a step than Rapier would let it.
        body.set_allow_fast_rotation(true);
        let immersed = Body::new(stepper, centre_of_mass, body);
        self.bodies.insert(handle, immersed);
        Ok(())
    }

    /// Lets Rapier alone move this body; whether it was immersed.
    pub fn remove(&mut self, handle: RigidBodyHandle) -> bool {
        self.bodies.shift_remove(&handle).is_some()
    }

    /// The state of a body in double precision, at its centre of mass.
    pub fn state(&self, handle: RigidBodyHandle) -> Option<&State> {
        self.bodies.get(&handle).map(|body| &body.state)
    }

    /// The step of `dt` (s) in the fluid alone, before `PhysicsPipeline::step` of the same length; `input` is what a body
    /// meets, from its state. Bodies that were removed from `bodies` are forgotten.
    ///
    /// # Errors
    /// The bodies that cannot step. All others do.
    pub fn before_step(
        &mut self,
        dt: f64,
        bodies: &mut RigidBodySet,
        narrow_phase: &NarrowPhase,
        mut input: impl FnMut(RigidBodyHandle, &State) -> Input,
    ) -> Result<(), Vec<StepTrouble>> {
        let mut troubles = Vec::new();
        self.bodies.retain(|handle, _| bodies.contains(*handle));
        for (handle, immersed) in &mut self.bodies {
            let Some(body) = bodies.get_mut(*handle) else {
                continue;
            };
            immersed.read(body);
            let input = input(*handle, &immersed.state);
            if body.is_sleeping() {
                if !immersed.is_stirred(&input) {
                    immersed.rest();
                    continue;
                }
                body.wake_up(true);
            }
            let normal = normal(body, narrow_phase);
            if let Err(error) = immersed.fly(body, dt, &input, normal) {
                immersed.rest();
                troubles.push(StepTrouble {
                    body: *handle,
                    error,
                });
            }
        }
        if troubles.is_empty() {
            Ok(())
        } else {
            Err(troubles)
        }
    }

    /// Takes what `PhysicsPipeline::step` made of the step.
    pub fn after_step(&mut self, bodies: &mut RigidBodySet) {
        for (handle, immersed) in &mut self.bodies {
            if let Some(body) = bodies.get_mut(*handle) {
                immersed.land(body);
            }
        }
    }
}

/// The mean normal of what a body touches, or up.
fn normal(body: &RigidBody, narrow_phase: &NarrowPhase) -> [f64; 3] {
    let mut sum = Vector::ZERO;
    for collider in body.colliders() {
        for pair in narrow_phase.contact_pairs_with(*collider) {
            for manifold in pair.manifolds() {
                if manifold.data.solver_contacts.is_empty() {
                    continue;
                }
                let sign = if pair.collider1 == *collider {
                    -1.0
                } else {
                    1.0
                };
                sum += sign * manifold.data.normal;
            }
        }
    }
    sum.try_normalize().map_or([0.0, 1.0, 0.0], array)
}
