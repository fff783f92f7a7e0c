//! The state of a body between fixed steps, and what is known of its entity.

use std::sync::Arc;

use bevy_ecs::component::Component;
use bevy_math::{DQuat, DVec3, Quat, Vec3};
use bevy_transform::components::Transform;
use langevin_rigid::{FreeFlight, Input, State, Stepper};

use crate::components::{AngularVelocity, LinearVelocity};
use crate::medium::Medium;
use crate::plain_fall::fall;
use crate::steppers::{Mobility, Shape};

/// A body that has joined: its state in double precision, after the last fixed step.
#[derive(Component, Debug)]
pub struct Stepped {
    pub(crate) mover: Mover,
    /// Of what it is made; none for a body that could not be made.
    pub(crate) shape: Option<Shape>,
    /// Why it cannot go on.
    pub(crate) fault: Option<String>,
    pub(crate) medium: Medium,
    current: State,
    previous: State,
    /// How many fixed steps lie between the two, and how many of these have passed.
    span: u32,
    passed: u32,
    /// In the frame of the mesh, before it is scaled (m).
    centre_of_mass: DVec3,
    written: Written,
}

/// What moves a body.
#[derive(Debug, Clone)]
pub(crate) enum Mover {
    Immersed(Arc<Mobility>),
    /// Gravity alone, since the body could not be made.
    Plain,
}

/// What the entity was last given; whatever differs, the game has set.
#[derive(Debug, Clone, Copy)]
struct Written {
    translation: Vec3,
    rotation: Quat,
    velocity: LinearVelocity,
    angular_velocity: AngularVelocity,
}

impl Stepped {
    /// A body that joins where its entity is; an error says what of it is impossible.
    pub(crate) fn join(
        (mover, shape): (Mover, Option<Shape>),
        centre_of_mass: [f64; 3],
        transform: &Transform,
        velocity: LinearVelocity,
        angular_velocity: AngularVelocity,
    ) -> Result<Self, String> {
        let mut joined = Self {
            mover,
            shape,
            fault: None,
            medium: Medium::default(),
            current: State::default(),
            previous: State::default(),
            span: 1,
            passed: 1,
            centre_of_mass: centre_of_mass.into(),
            written: Written {
                translation: transform.translation,
                rotation: transform.rotation,
                velocity,
                angular_velocity,
            },
        };
        joined.place(transform, true)?;
        check_velocities(velocity, angular_velocity)?;
        joined.current.set_world_velocities(
            velocity.0.as_dvec3().to_array(),
            angular_velocity.0.as_dvec3().to_array(),
        );
        joined.previous = joined.current;
        Ok(joined)
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

    /// The last fixed step, of `dt` (s), as velocities for a physics engine.
    pub fn flight(&self, dt: f64) -> FreeFlight {
        FreeFlight::between(&self.previous, &self.current, dt)
    }

    /// Puts a body that is [`Hosted`](crate::Hosted) where its engine has moved it.
    pub fn set_state(&mut self, state: State) {
        self.current = state;
    }

    /// Whether the body falls plainly, as in no fluid, since it could not be made.
    pub fn falls_plainly(&self) -> bool {
        matches!(self.mover, Mover::Plain)
    }

    /// Takes the body where the game has put its entity.
    pub(crate) fn follow(&mut self, transform: &Transform) {
        if !transform.is_finite() {
            self.fault = Some(not_finite(transform));
            return;
        }
        let turned = transform.rotation != self.written.rotation;
        if !turned && transform.translation == self.written.translation {
            return;
        }
        self.stop();
        match self.place(transform, turned) {
            Ok(()) => {
                self.written.translation = transform.translation;
                self.written.rotation = transform.rotation;
            }
            Err(fault) => self.fault = Some(fault),
        }
    }

    fn place(&mut self, transform: &Transform, turned: bool) -> Result<(), String> {
        let velocity = self.current.world_velocity();
        let spin = self.current.world_angular_velocity();
        let mut orientation = DQuat::from_array(self.current.orientation);
        if turned {
            orientation = transform.rotation.as_dquat().normalize();
        }
        let arm = transform.scale.as_dvec3() * self.centre_of_mass;
        let position = transform.translation.as_dvec3() + orientation * arm;
        if !(position.is_finite() && orientation.is_finite()) {
            return Err(not_finite(transform));
        }
        self.current.position = position.to_array();
        self.current.orientation = orientation.to_array();
        self.current.set_world_velocities(velocity, spin);
        self.previous = self.current;
        self.medium = Medium::Unknown;
        Ok(())
    }

    /// Takes the velocities that the game has set.
    pub(crate) fn accelerate(
        &mut self,
        velocity: LinearVelocity,
        angular_velocity: AngularVelocity,
    ) {
        if velocity == self.written.velocity && angular_velocity == self.written.angular_velocity {
            return;
        }
        if let Err(fault) = check_velocities(velocity, angular_velocity) {
            self.fault = Some(fault);
            return;
        }
        self.stop();
        let mut linear = self.current.world_velocity();
        let mut angular = self.current.world_angular_velocity();
        if velocity != self.written.velocity {
            linear = velocity.0.as_dvec3().to_array();
        }
        if angular_velocity != self.written.angular_velocity {
            angular = angular_velocity.0.as_dvec3().to_array();
        }
        self.current.set_world_velocities(linear, angular);
        self.written.velocity = velocity;
        self.written.angular_velocity = angular_velocity;
    }

    /// Whether the step that it took is over.
    pub(crate) fn is_due(&self) -> bool {
        self.passed >= self.span
    }

    /// One more fixed step of the step that it took has passed.
    pub(crate) fn pass(&mut self) {
        self.passed += 1;
    }

    /// Ends the step that it took where it is by now.
    pub(crate) fn stop(&mut self) {
        if self.is_due() {
            return;
        }
        let passed = f64::from(self.passed) / f64::from(self.span);
        let mut now = self.current;
        let (place, turn) = self.between(passed);
        now.position = place.to_array();
        now.orientation = turn.to_array();
        let mixed = |of: fn(&State) -> [f64; 3]| {
            let (from, to) = (
                DVec3::from(of(&self.previous)),
                DVec3::from(of(&self.current)),
            );
            from.lerp(to, passed).to_array()
        };
        now.set_world_velocities(
            mixed(State::world_velocity),
            mixed(State::world_angular_velocity),
        );
        now.time = self.previous.time + passed * (self.current.time - self.previous.time);
        self.current = now;
        self.previous = now;
        self.span = 1;
        self.passed = 1;
    }

    /// A step of `dt` (s), which is so many fixed steps.
    pub(crate) fn step(
        &mut self,
        dt: f64,
        span: u32,
        input: &Input,
        gravity: [f64; 3],
        medium: Medium,
    ) {
        let mut next = self.current;
        match &self.mover {
            Mover::Immersed(mobility) => {
                if let Err(error) = medium.step(&mut next, &self.medium, mobility, dt, input) {
                    self.fault = Some(error.to_string());
                    return;
                }
            }
            Mover::Plain => {
                fall(&mut next, gravity, dt);
                if !next.is_finite() {
                    self.fault = Some("its fall has become a number that is not finite".into());
                    return;
                }
            }
        }
        self.take_step(next, span, medium);
    }

    /// Takes a step to `next`, which is so many fixed steps, through `medium`.
    pub(crate) fn take_step(&mut self, next: State, span: u32, medium: Medium) {
        self.previous = self.current;
        self.current = next;
        self.medium = medium;
        self.span = span;
        self.passed = 1;
    }

    /// Position and orientation so far between the last two states.
    fn between(&self, part: f64) -> (DVec3, DQuat) {
        let position = |state: &State| DVec3::from(state.position);
        let orientation = |state: &State| DQuat::from_array(state.orientation);
        (
            position(&self.previous).lerp(position(&self.current), part),
            orientation(&self.previous).slerp(orientation(&self.current), part),
        )
    }

    /// Velocities after the step, which the entity is given.
    pub(crate) fn velocities(&mut self) -> (LinearVelocity, AngularVelocity) {
        let single = |a: [f64; 3]| DVec3::from(a).as_vec3();
        self.written.velocity = LinearVelocity(single(self.current.world_velocity()));
        self.written.angular_velocity =
            AngularVelocity(single(self.current.world_angular_velocity()));
        (self.written.velocity, self.written.angular_velocity)
    }

    /// Draws the body so far between the last two fixed steps.
    pub(crate) fn draw(&mut self, fraction: f64, transform: &mut Transform) {
        let passed = f64::from(self.passed) - 1.0 + fraction;
        let (place, turn) = self.between(passed / f64::from(self.span));
        let arm = transform.scale.as_dvec3() * self.centre_of_mass;
        transform.translation = (place - turn * arm).as_vec3();
        transform.rotation = turn.as_quat();
        self.written.translation = transform.translation;
        self.written.rotation = transform.rotation;
    }

    /// Where the centre of mass is drawn.
    #[cfg(feature = "gizmos")]
    pub(crate) fn drawn_centre(&self, transform: &Transform) -> Vec3 {
        let arm = transform.scale.as_dvec3() * self.centre_of_mass;
        transform.translation + (transform.rotation.as_dquat() * arm).as_vec3()
    }

    /// Puts the entity back to where it last was.
    pub(crate) fn restore(
        &self,
        transform: &mut Transform,
        velocity: &mut LinearVelocity,
        angular_velocity: &mut AngularVelocity,
    ) {
        transform.translation = self.written.translation;
        transform.rotation = self.written.rotation;
        *velocity = self.written.velocity;
        *angular_velocity = self.written.angular_velocity;
    }
}

pub(crate) fn not_finite(transform: &Transform) -> String {
    format!(
        "its `Transform` has a number that is not finite or a rotation of no length ({transform:?})"
    )
}

/// No light body is given more than this (m/s, rad/s); what is more is a mistake, and would end in numbers that are not finite.
const FASTEST: f32 = 1e4;
const FASTEST_SPIN: f32 = 1e6;

fn check_velocities(
    velocity: LinearVelocity,
    angular_velocity: AngularVelocity,
) -> Result<(), String> {
    let (speed, spin) = (velocity.0.length(), angular_velocity.0.length());
    if speed <= FASTEST && spin <= FASTEST_SPIN {
        return Ok(());
    }
    Err(format!(
        "its `LinearVelocity` ({}) or `AngularVelocity` ({}) has a number that is not finite, or is more than {FASTEST} m/s or \
         {FASTEST_SPIN} rad/s",
        velocity.0, angular_velocity.0
    ))
}
