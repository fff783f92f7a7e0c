//! How a body is drawn between its last two states.

use bevy_ecs::component::Component;
use bevy_math::{DQuat, DVec3, Quat, Vec3};
use bevy_transform::components::Transform;
use langevin_rigid::State;

/// A centre of mass and an orientation, in the precision of a `Transform`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pose {
    pub(crate) position: Vec3,
    pub(crate) orientation: Quat,
}

impl Pose {
    pub(crate) fn of(state: &State) -> Self {
        Self {
            position: DVec3::from(state.position).as_vec3(),
            orientation: DQuat::from_array(state.orientation).as_quat(),
        }
    }
}

/// What a frame needs of each body, apart from the states, which are much larger.
#[derive(Component, Debug, Clone, Copy, Default)]
pub(crate) struct Drawn {
    /// The last two states.
    before: Pose,
    after: Pose,
    /// In the frame of the mesh, before it is scaled (m).
    centre_of_mass: Vec3,
    /// What the entity was last given; where that differs, the game has set it.
    translation: Vec3,
    rotation: Quat,
}

impl Drawn {
    pub(crate) fn new(centre_of_mass: Vec3) -> Self {
        Self {
            centre_of_mass,
            ..Self::default()
        }
    }

    /// The body is drawn on its way between these from now on.
    pub(crate) fn between(&mut self, before: Pose, after: Pose) {
        self.before = before;
        self.after = after;
    }

    /// Takes `transform` for what the entity was given.
    pub(crate) fn keep(&mut self, transform: &Transform) {
        self.translation = transform.translation;
        self.rotation = transform.rotation;
    }

    /// Whether the game has moved the entity since it was drawn.
    pub(crate) fn is_moved(&self, transform: &Transform) -> bool {
        transform.translation != self.translation || self.is_turned(transform)
    }

    /// Whether the game has turned the entity since it was drawn.
    pub(crate) fn is_turned(&self, transform: &Transform) -> bool {
        transform.rotation != self.rotation
    }

    /// So far on its way.
    pub(crate) fn pose(&self, part: f32) -> Pose {
        Pose {
            position: self.before.position.lerp(self.after.position, part),
            orientation: self.before.orientation.slerp(self.after.orientation, part),
        }
    }

    /// Draws the body so far on its way.
    pub(crate) fn draw(&mut self, part: f32, transform: &mut Transform) {
        let Pose {
            position,
            orientation,
        } = self.pose(part);
        let arm = transform.scale * self.centre_of_mass;
        transform.translation = position - orientation * arm;
        transform.rotation = orientation;
        self.keep(transform);
    }

    /// Puts the entity back to where it was drawn.
    pub(crate) fn restore(&self, transform: &mut Transform) {
        transform.translation = self.translation;
        transform.rotation = self.rotation;
    }
}
