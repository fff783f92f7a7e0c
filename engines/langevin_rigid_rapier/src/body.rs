//! One body: the step in the fluid alone, and what contacts make of it.

use std::sync::Arc;

use langevin_rigid::linalg::rotate;
use langevin_rigid::{ContactMass, FreeFlight, Input, Loads, State, StepError, Stepper};
use rapier3d::prelude::{MassProperties, Pose, RigidBody, Vector};

use crate::convert::{array, matrix, pose, quaternion, vector};

/// A body in a fluid, and what Rapier was last given of it.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub(crate) stepper: Arc<Stepper>,
    pub(crate) state: State,
    /// Centre of mass in the frame of the rigid body (m).
    centre_of_mass: [f64; 3],
    /// The step that Rapier is to take, and the mass for it; none while the body sleeps.
    flight: Option<(FreeFlight, ContactMass)>,
    given: Given,
}

/// Pose and velocities in the precision of Rapier; whatever differs, contacts or the program have changed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Given {
    pose: Pose,
    velocity: Vector,
    spin: Vector,
}

impl Given {
    fn of(body: &RigidBody) -> Self {
        Self {
            pose: *body.position(),
            velocity: body.linvel(),
            spin: body.angvel(),
        }
    }
}

impl Body {
    pub(crate) fn new(stepper: Arc<Stepper>, centre_of_mass: [f64; 3], body: &RigidBody) -> Self {
        let given = Given::of(body);
        let mut made = Self {
            stepper,
            state: State::default(),
            centre_of_mass,
            flight: None,
            given,
        };
        made.adopt(given);
        made
    }

    /// Takes pose and velocities as they are; Rapier's velocity is that of the centre of mass.
    fn adopt(&mut self, given: Given) {
        self.state.orientation = quaternion(given.pose.rotation);
        self.state.position = self.centre(&given.pose);
        self.state
            .set_world_velocities(array(given.velocity), array(given.spin));
        self.given = given;
    }

    fn centre(&self, pose: &Pose) -> [f64; 3] {
        let offset = rotate(quaternion(pose.rotation), self.centre_of_mass);
        let origin = array(pose.translation);
        [0, 1, 2].map(|i| origin[i] + offset[i])
    }

    /// What the program has changed since the last step.
    pub(crate) fn read(&mut self, body: &RigidBody) {
        let now = Given::of(body);
        if now != self.given {
            self.adopt(now);
        }
    }

    /// Whether the fluid moves the body where it lies.
    pub(crate) fn is_stirred(&self, input: &Input) -> bool {
        let loads = self.stepper.loads(&self.state, input);
        self.stepper.push_to_weight(&loads) > Loads::STIRRING
    }

    /// The step in the fluid alone, as velocities for Rapier.
    pub(crate) fn fly(
        &mut self,
        body: &mut RigidBody,
        dt: f64,
        input: &Input,
        normal: [f64; 3],
    ) -> Result<(), StepError> {
        let flight = self.stepper.fly(&self.state, dt, input)?;
        let mass = self.stepper.contact_mass(self.state.orientation, normal);
        body.set_additional_mass_properties(
            MassProperties::with_inertia_matrix(
                vector(self.centre_of_mass),
                mass.mass as f32,
                matrix(&mass.inertia),
            ),
            false,
        );
        body.set_linvel(vector(flight.velocity()), false);
        body.set_angvel(vector(flight.angular_velocity()), false);
        self.flight = Some((flight, mass));
        self.given = Given::of(body);
        Ok(())
    }

    /// Stays as it is over the coming step.
    pub(crate) fn rest(&mut self) {
        self.flight = None;
    }

    /// What Rapier made of the step.
    pub(crate) fn land(&mut self, body: &mut RigidBody) {
        let now = Given::of(body);
        let Some((flight, mass)) = self.flight.take() else {
            self.read(body);
            return;
        };
        if now.velocity == self.given.velocity && now.spin == self.given.spin {
            self.state = *flight.end();
            let (centre, arm) = (self.state.position, self.centre_of_mass);
            body.set_position(pose(centre, self.state.orientation, arm), false);
        } else {
            self.state = flight.met(
                Some(&mass),
                self.centre(&now.pose),
                quaternion(now.pose.rotation),
                array(now.velocity),
                array(now.spin),
            );
        }
        body.set_linvel(vector(self.state.world_velocity()), false);
        body.set_angvel(vector(self.state.world_angular_velocity()), false);
        self.given = Given::of(body);
    }
}
