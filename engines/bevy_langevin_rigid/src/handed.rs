//! The engine's side of a body that it hosts: what it was last given of it.

use bevy_ecs::component::Component;
use bevy_math::{DQuat, DVec3, Quat, Vec3};
use bevy_transform::components::Transform;
use langevin_rigid::{ContactMass, FreeFlight};

use crate::stepped::{Stepped, single};

/// How a physics engine has a body: pose of the entity's frame, velocity of the centre of mass (m/s) and angular velocity
/// (rad/s), world frame, in the precision of engines.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Where the origin of the entity's frame is (m).
    pub translation: Vec3,
    /// How the entity's frame is turned.
    pub rotation: Quat,
    /// Velocity of the centre of mass (m/s).
    pub velocity: Vec3,
    /// Angular velocity (rad/s).
    pub angular_velocity: Vec3,
}

/// What a physics engine was last given of a body that is [`Hosted`](crate::Hosted): for the engine's side, which takes the
/// body through each fixed step with [`read`](Self::read), [`fly`](Self::fly) and [`land`](Self::land).
///
/// ```
/// use bevy_ecs::prelude::*;
/// use bevy_langevin_rigid::{Handed, Motion, Sleepers, Stepped};
/// use bevy_math::Vec3;
/// use bevy_time::{Fixed, Time};
/// use bevy_transform::components::Transform;
///
/// /// How some engine has a body.
/// #[derive(Component)]
/// struct InEngine {
///     motion: Motion,
///     asleep: bool,
/// }
///
/// fn wake(mut sleepers: Sleepers, mut bodies: Query<&mut InEngine>) {
///     for entity in sleepers.stirred() {
///         if let Ok(mut engine) = bodies.get_mut(entity) {
///             engine.asleep = false;
///         }
///     }
/// }
/// fn read(mut bodies: Query<(&mut Stepped, &mut Handed, &Transform, &InEngine)>) {
///     for (mut body, mut handed, transform, engine) in &mut bodies {
///         handed.read(&mut body, transform, engine.motion);
///     }
/// }
/// fn hand_over(mut bodies: Query<(&Stepped, &mut Handed, &mut InEngine)>, time: Res<Time<Fixed>>) {
///     for (body, mut handed, mut engine) in &mut bodies {
///         // The mass is for the contacts that the engine solves.
///         let (motion, _mass) = handed.fly(body, engine.motion, Vec3::Y, time.delta_secs_f64());
///         engine.motion = motion;
///     }
/// }
/// fn take_back(mut bodies: Query<(&mut Stepped, &mut Handed, &Transform, &mut InEngine)>) {
///     for (mut body, mut handed, transform, mut engine) in &mut bodies {
///         let now = engine.motion;
///         if let Some(landed) = handed.land(&mut body, transform, now) {
///             engine.motion = landed;
///         }
///     }
/// }
/// # bevy_ecs::system::assert_is_system(wake);
/// # bevy_ecs::system::assert_is_system(read);
/// # bevy_ecs::system::assert_is_system(hand_over);
/// # bevy_ecs::system::assert_is_system(take_back);
/// ```
///
/// A `Transform` that they take is the entity's, for its scale.
#[derive(Component, Debug, Clone, Copy, PartialEq, Default)]
pub struct Handed {
    motion: Motion,
    /// The step that the engine is to take.
    flown: Option<Flown>,
}

/// A step as it was given to the engine.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Flown {
    flight: FreeFlight,
    /// None of a body that falls plainly.
    contact: Option<ContactMass>,
}

impl Motion {
    /// Of a body in its [`Stepped::state`].
    pub fn of(body: &Stepped, transform: &Transform) -> Self {
        let state = body.state();
        let orientation = DQuat::from_array(state.orientation);
        let origin = DVec3::from(state.position) - orientation * body.arm(transform);
        Self {
            translation: origin.as_vec3(),
            rotation: orientation.as_quat(),
            velocity: single(state.world_velocity()),
            angular_velocity: single(state.world_angular_velocity()),
        }
    }

    /// Whether all numbers are finite, and the rotation has a length.
    pub fn is_sound(&self) -> bool {
        self.translation.is_finite()
            && self.rotation.is_finite()
            && self.rotation.length_squared() > 0.5
            && self.velocity.is_finite()
            && self.angular_velocity.is_finite()
    }

    fn moves_as(&self, other: &Self) -> bool {
        self.velocity == other.velocity && self.angular_velocity == other.angular_velocity
    }

    /// Position and orientation of a centre of mass `arm` (m) from the origin of the entity's frame.
    fn centre(&self, arm: DVec3) -> ([f64; 3], [f64; 4]) {
        let orientation = self.rotation.as_dquat().normalize();
        let centre = self.translation.as_dvec3() + orientation * arm;
        (centre.to_array(), orientation.to_array())
    }
}

impl Handed {
    /// Before [`Read`](crate::LangevinRigidSystems::Read): takes what the game has changed since the last step, where `now`
    /// is how the engine has the body. It must be [sound](Motion::is_sound).
    pub fn read(&mut self, body: &mut Stepped, transform: &Transform, now: Motion) {
        if now == self.motion {
            return;
        }
        let mut state = *body.state();
        (state.position, state.orientation) = now.centre(body.arm(transform));
        state.set_world_velocities(
            now.velocity.as_dvec3().to_array(),
            now.angular_velocity.as_dvec3().to_array(),
        );
        body.set_state(state);
        self.keep(now);
    }

    /// After [`Write`](crate::LangevinRigidSystems::Write): the step of `dt` (s) as velocities for the engine, in place of
    /// those of `now`, and the mass for contacts along `normal`: none of a body that [falls
    /// plainly](Stepped::falls_plainly), whose mass is the engine's own.
    pub fn fly(
        &mut self,
        body: &Stepped,
        now: Motion,
        normal: Vec3,
        dt: f64,
    ) -> (Motion, Option<ContactMass>) {
        let flight = body.flight(dt);
        self.motion = Motion {
            velocity: single(flight.velocity()),
            angular_velocity: single(flight.angular_velocity()),
            ..now
        };
        let orientation = body.state().orientation;
        let normal = normal.as_dvec3().to_array();
        let stepper = body.stepper();
        let contact = stepper.map(|stepper| stepper.contact_mass(orientation, normal));
        self.flown = Some(Flown { flight, contact });
        (self.motion, contact)
    }

    /// After the step of the engine, which has the body as `now`: takes what became of it, and says how the engine is to
    /// have it in the end; none where the body took no step.
    pub fn land(
        &mut self,
        body: &mut Stepped,
        transform: &Transform,
        now: Motion,
    ) -> Option<Motion> {
        let flown = self.flown?;
        let mut landed = now;
        if now.moves_as(&self.motion) {
            landed = Motion::of(body, transform);
        } else {
            flown.meet(body, transform, &now);
            let Motion {
                velocity,
                angular_velocity,
                ..
            } = Motion::of(body, transform);
            landed.velocity = velocity;
            landed.angular_velocity = angular_velocity;
        }
        self.keep(landed);
        Some(landed)
    }

    /// The engine has the body so from now on: what differs later, contacts or the game have changed.
    pub fn keep(&mut self, motion: Motion) {
        self.motion = motion;
        self.flown = None;
    }
}

impl Flown {
    /// Contacts have changed the body's step.
    fn meet(&self, body: &mut Stepped, transform: &Transform, now: &Motion) {
        let (centre, orientation) = now.centre(body.arm(transform));
        let velocity = now.velocity.as_dvec3().to_array();
        let spin = now.angular_velocity.as_dvec3().to_array();
        let contact = self.contact.as_ref();
        body.set_state(
            self.flight
                .met(contact, centre, orientation, velocity, spin),
        );
    }
}
