//! The state of a body between fixed steps.

use std::sync::Arc;

use bevy_ecs::component::Component;
use bevy_math::{DQuat, DVec3, Vec3};
use bevy_transform::components::Transform;
use langevin_rigid::{FreeFlight, Input, State, Stepper};

use crate::components::{AngularVelocity, LinearVelocity};
use crate::drawn::{Drawn, Pose};
use crate::medium::Medium;
use crate::moving::{check_velocities, not_finite, orientation};
use crate::pace::Pace;
use crate::plain_fall::fall;
use crate::steppers::{Mobility, Shape};

/// A body that has joined: its state in double precision, after the last fixed step.
#[derive(Component, Debug)]
pub struct Stepped {
    pub(crate) mover: Mover,
    /// Of what it is made; none for a body that could not be made.
    pub(crate) shape: Option<Box<Shape>>,
    pub(crate) medium: Medium,
    current: State,
    /// The state before the last step, of a body that an engine hosts.
    before: Option<Box<State>>,
    began: Began,
    /// In the frame of the mesh, before it is scaled (m).
    centre_of_mass: DVec3,
    /// What the entity was last given; where that differs, the game has set it.
    pub(crate) written: (LinearVelocity, AngularVelocity),
}

/// What is known of the state before the last step: a step seldom ends early, and states are large.
#[derive(Debug, Default)]
struct Began {
    time: f64,
    /// World frame (m/s, rad/s).
    velocity: Vec3,
    spin: Vec3,
}

/// What moves a body.
#[derive(Debug, Clone)]
pub(crate) enum Mover {
    Immersed(Arc<Mobility>),
    /// Gravity alone, since the body could not be made.
    Plain,
}

impl Stepped {
    /// A body that joins where its entity is; an error says what of it is impossible.
    pub(crate) fn join(
        (mover, shape): (Mover, Option<Shape>),
        centre_of_mass: [f64; 3],
        transform: &Transform,
        velocity: LinearVelocity,
        angular_velocity: AngularVelocity,
    ) -> Result<(Self, Pace, Drawn), String> {
        let mut joined = Self {
            mover,
            shape: shape.map(Box::new),
            medium: Medium::default(),
            current: State::default(),
            before: None,
            began: Began::default(),
            centre_of_mass: centre_of_mass.into(),
            written: (velocity, angular_velocity),
        };
        joined.place(transform, Some(orientation(transform)))?;
        check_velocities(velocity, angular_velocity)?;
        joined.current.set_world_velocities(
            velocity.0.as_dvec3().to_array(),
            angular_velocity.0.as_dvec3().to_array(),
        );
        let mut drawn = Drawn::new(joined.centre_of_mass.as_vec3());
        let pose = Pose::of(&joined.current);
        drawn.between(pose, pose);
        drawn.keep(transform);
        Ok((joined, Pace::default(), drawn))
    }

    /// The state after the last step; its position is that of the centre of mass, its clock starts when the body joins.
    ///
    /// A body that is far away ([`LevelOfDetail`](crate::LevelOfDetail)) takes several fixed steps as one, and is drawn on
    /// its way to this state until they have passed.
    pub fn state(&self) -> &State {
        &self.current
    }

    /// The body in the fluid that most of it is in; none for one that [falls plainly](Stepped::falls_plainly).
    pub fn stepper(&self) -> Option<&Stepper> {
        match (&self.mover, &self.medium) {
            (Mover::Plain, _) => None,
            (_, Medium::Region(immersion, surface))
                if immersion.share(&self.current, surface) > 0.5 =>
            {
                Some(immersion.in_water())
            }
            (Mover::Immersed(mobility), _) => Some(&mobility.open),
        }
    }

    /// Centre of mass in the frame of the mesh, before it is scaled (m).
    pub fn centre_of_mass(&self) -> DVec3 {
        self.centre_of_mass
    }

    /// Centre of mass from the origin of the entity's frame, in that frame as `transform` scales it (m).
    pub fn arm(&self, transform: &Transform) -> DVec3 {
        transform.scale.as_dvec3() * self.centre_of_mass
    }

    /// The last fixed step, of `dt` (s), as velocities for a physics engine.
    pub(crate) fn flight(&self, dt: f64) -> FreeFlight {
        let before = self.before.as_deref().unwrap_or(&self.current);
        FreeFlight::between(before, &self.current, dt)
    }

    /// Puts a body that is [`Hosted`](crate::Hosted) where its engine has moved it.
    pub fn set_state(&mut self, state: State) {
        self.current = state;
    }

    /// Whether the body falls plainly, as in no fluid, since it could not be made.
    pub fn falls_plainly(&self) -> bool {
        matches!(self.mover, Mover::Plain)
    }

    /// Puts the body where its entity is, turned to `orientation` or as it is.
    pub(crate) fn place(
        &mut self,
        transform: &Transform,
        orientation: Option<DQuat>,
    ) -> Result<(), String> {
        let velocity = self.current.world_velocity();
        let spin = self.current.world_angular_velocity();
        let orientation =
            orientation.unwrap_or_else(|| DQuat::from_array(self.current.orientation));
        let position = transform.translation.as_dvec3() + orientation * self.arm(transform);
        if !(position.is_finite() && orientation.is_finite()) {
            return Err(not_finite(transform));
        }
        self.current.position = position.to_array();
        self.current.orientation = orientation.to_array();
        self.current.set_world_velocities(velocity, spin);
        self.before = None;
        self.medium = Medium::Unknown;
        Ok(())
    }

    /// Takes those of the velocities that the entity was not given.
    pub(crate) fn accelerate(
        &mut self,
        velocity: LinearVelocity,
        angular_velocity: AngularVelocity,
    ) {
        let mut linear = self.current.world_velocity();
        let mut angular = self.current.world_angular_velocity();
        if velocity != self.written.0 {
            linear = velocity.0.as_dvec3().to_array();
        }
        if angular_velocity != self.written.1 {
            angular = angular_velocity.0.as_dvec3().to_array();
        }
        self.current.set_world_velocities(linear, angular);
        self.written = (velocity, angular_velocity);
    }

    /// Ends the step that it took where it is drawn, when this part of it has passed.
    pub(crate) fn stop(&mut self, passed: f64, drawn: Pose) {
        let Began {
            time,
            velocity,
            spin,
        } = self.began;
        let mixed = |from: Vec3, to: [f64; 3]| from.as_dvec3().lerp(to.into(), passed).to_array();
        let velocity = mixed(velocity, self.current.world_velocity());
        let spin = mixed(spin, self.current.world_angular_velocity());
        self.current.time = time + passed * (self.current.time - time);
        self.current.position = drawn.position.as_dvec3().to_array();
        self.current.orientation = drawn.orientation.as_dquat().normalize().to_array();
        self.current.set_world_velocities(velocity, spin);
    }

    /// The state after a step of `dt` (s) through `medium`; an error says why there is none.
    pub(crate) fn next(
        &self,
        dt: f64,
        input: &Input,
        gravity: [f64; 3],
        medium: &Medium,
    ) -> Result<State, String> {
        let mut next = self.current;
        match &self.mover {
            Mover::Immersed(mobility) => medium
                .step(&mut next, &self.medium, mobility, dt, input)
                .map_err(|error| error.to_string())?,
            Mover::Plain => {
                fall(&mut next, gravity, dt);
                if !next.is_finite() {
                    return Err("its fall has become a number that is not finite".into());
                }
            }
        }
        Ok(next)
    }

    /// Takes a step to `next` through `medium`; from where to where. What an engine hosts also keeps the state before it.
    pub(crate) fn take_step(&mut self, next: State, medium: Medium, hosted: bool) -> (Pose, Pose) {
        if hosted {
            **self.before.get_or_insert_default() = self.current;
        }
        self.began = Began {
            time: self.current.time,
            velocity: single(self.current.world_velocity()),
            spin: single(self.current.world_angular_velocity()),
        };
        let from = Pose::of(&self.current);
        self.current = next;
        self.medium = medium;
        (from, Pose::of(&self.current))
    }

    /// Velocities after the step, which the entity is given.
    pub(crate) fn velocities(&mut self) -> (LinearVelocity, AngularVelocity) {
        self.written = (
            LinearVelocity(single(self.current.world_velocity())),
            AngularVelocity(single(self.current.world_angular_velocity())),
        );
        self.written
    }

    /// Where the centre of mass is drawn.
    #[cfg(feature = "gizmos")]
    pub(crate) fn drawn_centre(&self, transform: &Transform) -> Vec3 {
        transform.translation + (transform.rotation.as_dquat() * self.arm(transform)).as_vec3()
    }
}

/// In the precision of games.
pub(crate) fn single(a: [f64; 3]) -> Vec3 {
    DVec3::from(a).as_vec3()
}
