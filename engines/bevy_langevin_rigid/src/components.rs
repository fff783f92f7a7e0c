//! Components that a game writes and reads.

use bevy_asset::Handle;
use bevy_ecs::component::Component;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::reflect::ReflectComponent;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::DeferredWorld;
use bevy_math::Vec3;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_transform::components::Transform;

use crate::baked_body::BakedBody;

/// A light body in the fluid of [`ImmersionSettings`](crate::ImmersionSettings); moves the `Transform` of its entity.
///
/// It is read when the body joins: at the next fixed step, or when its mesh is baked. Inserted anew or changed, it makes
/// the body join again from where it is.
#[derive(Component, Debug, Clone, PartialEq, Reflect)]
#[reflect(Component, Clone, PartialEq)]
#[require(Transform, LinearVelocity, AngularVelocity, ExternalWrench)]
#[component(on_insert = number)]
pub struct Immersed {
    /// Where its mass and its resistance to the fluid come from.
    pub source: BodySource,
    /// Number of its stream of noise; bodies with the same number go through the same turbulence. If none, bodies are
    /// numbered in the order in which they are inserted.
    pub number: Option<u32>,
}

/// Where a body comes from.
#[derive(Debug, Clone, PartialEq, Reflect)]
#[reflect(Clone, PartialEq)]
pub enum BodySource {
    /// A body that was baked before, or that the library makes.
    Baked(Handle<BakedBody>),
    /// The entity's `Mesh3d`, baked when it is loaded. Entities with the same mesh, density and thickness share one bake.
    Mesh {
        /// Density of the solid (kg/m^3).
        density: f32,
        /// Thickness that an open sheet is given (m), half to either side; none for a closed mesh.
        thickness: Option<f32>,
    },
}

impl Immersed {
    /// A body that was baked before, or that the library makes.
    pub fn baked(body: Handle<BakedBody>) -> Self {
        Self::of(BodySource::Baked(body))
    }

    /// The solid within the entity's closed `Mesh3d`, of this density (kg/m^3).
    pub fn solid(density: f32) -> Self {
        Self::of(BodySource::Mesh {
            density,
            thickness: None,
        })
    }

    /// The open sheet of the entity's `Mesh3d`, of this density (kg/m^3) and thickness (m).
    pub fn sheet(density: f32, thickness: f32) -> Self {
        Self::of(BodySource::Mesh {
            density,
            thickness: Some(thickness),
        })
    }

    /// With this stream of noise.
    #[must_use]
    pub fn numbered(self, number: u32) -> Self {
        Self {
            number: Some(number),
            ..self
        }
    }

    fn of(source: BodySource) -> Self {
        Self {
            source,
            number: None,
        }
    }
}

/// The number of the next body that comes without one.
#[derive(Resource, Debug, Default)]
pub(crate) struct NextNumber(u32);

/// Gives a body a number that has none.
fn number(mut world: DeferredWorld, context: HookContext) {
    let has_one = world
        .get::<Immersed>(context.entity)
        .is_none_or(|immersed| immersed.number.is_some());
    if has_one {
        return;
    }
    let Some(mut next) = world.get_resource_mut::<NextNumber>() else {
        return;
    };
    let number = next.0;
    next.0 = number.wrapping_add(1);
    if let Some(mut immersed) = world.get_mut::<Immersed>(context.entity) {
        immersed.number = Some(number);
    }
}

/// Velocity of a body's centre of mass, world frame (m/s).
///
/// The release velocity before the body joins; afterwards written every fixed step, and taken from whoever changes it.
#[derive(Component, Debug, Clone, Copy, PartialEq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct LinearVelocity(pub Vec3);

/// Angular velocity of a body, world frame (rad/s).
///
/// As [`LinearVelocity`].
#[derive(Component, Debug, Clone, Copy, PartialEq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct AngularVelocity(pub Vec3);

/// What acts on a body from outside: contacts, strings, thrusters. Read every fixed step and kept until it is changed.
///
/// A body that falls plainly, since its mesh could not be baked, has no mass and does not feel it.
#[derive(Component, Debug, Clone, Copy, PartialEq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct ExternalWrench {
    /// Force, world frame (N).
    pub force: Vec3,
    /// Torque about the centre of mass, world frame (N m).
    pub torque: Vec3,
}

/// Marks a body that a physics engine moves, which has its contacts: the plugin steps it and leaves its `Transform` to the
/// engine.
///
/// The engine's side gives it the mean velocities of each step and takes back what became of it
/// ([`Handed`](crate::Handed)).
#[derive(Component, Debug, Clone, Copy, PartialEq, Eq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct Hosted {
    /// Whether it lies still, and is not stepped.
    pub asleep: bool,
}

/// Marks a body that cannot go on, since a number that the game or the settings gave it is not finite, or it became
/// impossibly fast. The log has said why; it stays where it last was.
///
/// Remove the marker, with the cause mended, to let it go on.
#[derive(Component, Debug, Clone, Copy, PartialEq, Eq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct Quarantined;
