//! Bodies join when all that they are made of is ready.

use bevy_asset::{AssetServer, Assets};
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Changed, With, Without};
use bevy_ecs::system::{Commands, Query, Res, ResMut, SystemParam};
use bevy_log::error;
use bevy_math::Vec3;
use bevy_mesh::{Mesh, Mesh3d};
use bevy_transform::components::Transform;

use crate::ambient::ImmersionSettings;
use crate::baked_body::BakedBody;
use crate::baking::{Bakes, Outcome, Solid};
use crate::components::{AngularVelocity, BodySource, Immersed, LinearVelocity, Quarantined};
use crate::moving::not_finite;
use crate::quarantine::mark;
use crate::stepped::{Mover, Stepped};
use crate::steppers::{Shape, Steppers};

/// Scales along the axes that differ by less than this part are one.
const ROUNDING: f32 = 1e-4;

/// Takes out bodies whose `Immersed` was changed or removed.
pub(crate) fn leave(
    changed: Query<Entity, (With<Stepped>, Changed<Immersed>)>,
    bare: Query<Entity, (With<Stepped>, Without<Immersed>)>,
    mut commands: Commands,
) {
    for entity in changed.iter().chain(&bare) {
        commands.entity(entity).try_remove::<Stepped>();
    }
}

/// Lets bodies join whose shape is ready.
pub(crate) fn join(
    waiting: Query<
        (
            Entity,
            &Immersed,
            &Transform,
            &LinearVelocity,
            &AngularVelocity,
            Option<&Mesh3d>,
        ),
        (Without<Stepped>, Without<ChildOf>, Without<Quarantined>),
    >,
    mut workshop: Workshop,
    mut commands: Commands,
) {
    for (entity, immersed, transform, velocity, angular_velocity, mesh) in &waiting {
        if !transform.is_finite() {
            mark(entity, &not_finite(transform), &mut commands);
            continue;
        }
        let shape = workshop.shape(entity, &immersed.source, mesh, transform.scale);
        let (made, centre_of_mass) = match workshop.mover(shape) {
            Outcome::Waiting => continue,
            Outcome::Ready((mover, shape, centre)) => ((mover, Some(shape)), centre),
            Outcome::Failed => ((Mover::Plain, None), [0.0; 3]),
        };
        match Stepped::join(
            made,
            centre_of_mass,
            transform,
            *velocity,
            *angular_velocity,
        ) {
            Ok(joined) => {
                commands.entity(entity).try_insert(joined);
            }
            Err(fault) => mark(entity, &fault, &mut commands),
        }
    }
}

/// All that bodies are made with.
#[derive(SystemParam)]
pub(crate) struct Workshop<'w> {
    bakes: ResMut<'w, Bakes>,
    steppers: ResMut<'w, Steppers>,
    bodies: Res<'w, Assets<BakedBody>>,
    meshes: Option<Res<'w, Assets<Mesh>>>,
    server: Res<'w, AssetServer>,
    settings: Res<'w, ImmersionSettings>,
}

impl Workshop<'_> {
    fn shape(
        &mut self,
        entity: Entity,
        source: &BodySource,
        mesh: Option<&Mesh3d>,
        scale: Vec3,
    ) -> Outcome<Shape> {
        let Some(scale) = uniform(scale) else {
            error!(
                "the body {entity} has the scale {scale}; a body is scaled alike along all axes, by a positive number: scale \
                 its mesh instead. It falls plainly, as in no fluid"
            );
            return Outcome::Failed;
        };
        let body = match (source, mesh) {
            (BodySource::Baked(body), _) => body.clone(),
            (BodySource::Mesh { .. }, None) => {
                error!(
                    "the body {entity} is to be baked from its mesh and has no `Mesh3d`; insert one together with `Immersed`. \
                     It falls plainly, as in no fluid"
                );
                return Outcome::Failed;
            }
            (&BodySource::Mesh { density, thickness }, Some(mesh)) => {
                let solid = Solid::new(mesh.id(), density, thickness);
                let meshes = self.meshes.as_deref();
                match self.bakes.body(solid, meshes, &self.server) {
                    Outcome::Ready(body) => body,
                    Outcome::Waiting => return Outcome::Waiting,
                    Outcome::Failed => return Outcome::Failed,
                }
            }
        };
        Outcome::Ready(Shape { body, scale })
    }

    /// What moves a body of this shape, and where its centre of mass is.
    fn mover(&mut self, shape: Outcome<Shape>) -> Outcome<(Mover, Shape, [f64; 3])> {
        let shape = match shape {
            Outcome::Ready(shape) => shape,
            Outcome::Waiting => return Outcome::Waiting,
            Outcome::Failed => return Outcome::Failed,
        };
        let steppers = &mut self.steppers;
        let mover = match steppers.mobility(&shape, &self.bodies, &self.server, &self.settings) {
            Outcome::Ready(mobility) => Mover::Immersed(mobility),
            // Other settings may make it possible.
            Outcome::Failed => Mover::Plain,
            Outcome::Waiting => return Outcome::Waiting,
        };
        let body = self.bodies.get(&shape.body);
        let centre = body.map_or([0.0; 3], |body| body.centre_of_mass);
        Outcome::Ready((mover, shape, centre))
    }
}

/// The scale that is the same along all axes.
fn uniform(scale: Vec3) -> Option<f32> {
    let same = (scale - scale.x).abs().max_element() <= ROUNDING * scale.x;
    (same && scale.x > 0.0 && scale.is_finite()).then_some(scale.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_same_positive_scale_along_all_axes_is_one() {
        assert_eq!(uniform(Vec3::splat(2.0)), Some(2.0));
        assert_eq!(uniform(Vec3::new(2.0, 2.00001, 2.0)), Some(2.0));
        for bad in [
            Vec3::ZERO,
            Vec3::splat(-1.0),
            Vec3::new(1.0, 1.0, 2.0),
            Vec3::splat(f32::NAN),
            Vec3::splat(f32::INFINITY),
            Vec3::new(1.0, f32::NAN, 1.0),
        ] {
            assert_eq!(uniform(bad), None, "{bad}");
        }
    }
}
