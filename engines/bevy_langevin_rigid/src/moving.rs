//! A body with all that its steps and its drawing keep of it.

use bevy_ecs::entity::Entity;
use bevy_ecs::query::QueryData;
use bevy_math::DQuat;
use bevy_transform::components::Transform;

use crate::components::{AngularVelocity, LinearVelocity};
use crate::drawn::{Drawn, Pose};
use crate::pace::Pace;
use crate::stepped::Stepped;

/// A body, of which only what is used is fetched from memory.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Moving {
    pub(crate) entity: Entity,
    pub(crate) stepped: &'static mut Stepped,
    pub(crate) pace: &'static mut Pace,
    pub(crate) drawn: &'static mut Drawn,
}

impl MovingItem<'_, '_> {
    /// Takes the body where the game has put its entity; an error says what of that is impossible.
    pub(crate) fn follow(&mut self, transform: &Transform) -> Result<(), String> {
        if !transform.is_finite() {
            return Err(not_finite(transform));
        }
        if !self.drawn.is_moved(transform) {
            return Ok(());
        }
        self.stop();
        let turned = self.drawn.is_turned(transform);
        let orientation = turned.then(|| orientation(transform));
        self.stepped.place(transform, orientation)?;
        self.draw_at_rest();
        self.drawn.keep(transform);
        Ok(())
    }

    /// Takes the velocities that the game has set; an error says what of them is impossible.
    pub(crate) fn accelerate(
        &mut self,
        velocity: LinearVelocity,
        angular_velocity: AngularVelocity,
    ) -> Result<(), String> {
        if (velocity, angular_velocity) == self.stepped.written {
            return Ok(());
        }
        check_velocities(velocity, angular_velocity)?;
        self.stop();
        self.stepped.accelerate(velocity, angular_velocity);
        Ok(())
    }

    /// Ends the step that it took where it is by now.
    pub(crate) fn stop(&mut self) {
        if self.pace.is_due() {
            return;
        }
        let passed = self.pace.passed();
        self.stepped.stop(passed, self.drawn.pose(passed as f32));
        *self.pace = Pace::default();
        self.draw_at_rest();
    }

    fn draw_at_rest(&mut self) {
        let pose = Pose::of(self.stepped.state());
        self.drawn.between(pose, pose);
    }
}

/// Says which numbers of a `Transform` are none.
pub(crate) fn not_finite(transform: &Transform) -> String {
    format!(
        "its `Transform` has a number that is not finite or a rotation of no length ({transform:?})"
    )
}

/// No light body is given more than this (m/s, rad/s); what is more is a mistake, and would end in numbers that are not finite.
const FASTEST: f32 = 1e4;
const FASTEST_SPIN: f32 = 1e6;

pub(crate) fn check_velocities(
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

/// The rotation of a `Transform`, for a state.
pub(crate) fn orientation(transform: &Transform) -> DQuat {
    transform.rotation.as_dquat().normalize()
}
