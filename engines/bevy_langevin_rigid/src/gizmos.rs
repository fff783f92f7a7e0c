//! Draws what acts on bodies, with the feature `gizmos`.

use bevy_app::{App, Plugin, PostUpdate};
use bevy_color::Color;
use bevy_ecs::component::Component;
use bevy_ecs::query::With;
use bevy_ecs::reflect::ReflectComponent;
use bevy_ecs::system::Query;
use bevy_gizmos::AppGizmoBuilder;
use bevy_gizmos::config::GizmoConfigGroup;
use bevy_gizmos::gizmos::Gizmos;
use bevy_math::{DVec3, Vec3};
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_transform::components::Transform;
use langevin_rigid::Loads;

use crate::components::ExternalWrench;
use crate::loads::BodyLoads;
use crate::stepped::Stepped;

/// Draws the forces on bodies that have [`ShowForces`], an arrow for each cause, from the centre of mass.
///
/// Needs `GizmoPlugin`, which `DefaultPlugins` adds, before it. The causes are those of [`Loads::causes`], in its order,
/// their hues 30 degrees apart: weight red, buoyancy orange, and so on.
#[derive(Debug, Clone, Copy, Default)]
pub struct ForceGizmosPlugin;

/// Marks a body whose forces are drawn.
#[derive(Component, Debug, Clone, Copy, PartialEq, Eq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct ShowForces;

/// The gizmos of forces: their group in the `GizmoConfigStore`.
#[derive(Debug, Clone, Copy, PartialEq, Reflect, GizmoConfigGroup)]
#[reflect(Default)]
pub struct ForceGizmos {
    /// Length of an arrow for a force as large as the weight of the body (m).
    pub length: f32,
}

impl Default for ForceGizmos {
    fn default() -> Self {
        Self { length: 0.2 }
    }
}

impl Plugin for ForceGizmosPlugin {
    fn build(&self, app: &mut App) {
        app.register_type::<ShowForces>()
            .init_gizmo_group::<ForceGizmos>()
            .add_systems(PostUpdate, draw);
    }
}

/// Shorter arrows than this share of the weight's are left out.
const SHORT: f64 = 0.01;

fn draw(
    bodies: Query<(&Stepped, &Transform, &ExternalWrench), With<ShowForces>>,
    loads: BodyLoads,
    mut gizmos: Gizmos<ForceGizmos>,
) {
    let length = gizmos.config_ext.length;
    for (body, transform, wrench) in &bodies {
        let Some(loads) = loads.of(body, wrench) else {
            continue;
        };
        let centre = body.drawn_centre(transform);
        for (number, arrow) in arrows(&loads, length) {
            let colour = Color::hsl(30.0 * number as f32, 0.9, 0.5);
            gizmos.arrow(centre, centre + arrow, colour);
        }
    }
}

/// The arrows of a body with the numbers of their causes (m).
fn arrows(loads: &Loads, length: f32) -> impl Iterator<Item = (usize, Vec3)> {
    let weight = DVec3::from(loads.weight.force).length();
    let causes = loads.causes().into_iter().enumerate();
    causes.filter_map(move |(number, (_, wrench))| {
        let force = DVec3::from(wrench.force) / weight;
        let drawn = force.is_finite() && force.length() > SHORT;
        drawn.then(|| (number, length * force.as_vec3()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_as_long_as_forces_are_large() {
        let mut loads = Loads::default();
        assert_eq!(arrows(&loads, 0.5).count(), 0);
        loads.weight.force = [0.0, -2.0, 0.0];
        loads.drag.force = [0.0, 1.0, 0.0];
        loads.friction.force = [1e-3, 0.0, 0.0];
        loads.outside.force = [f64::NAN; 3];
        let drawn: Vec<(usize, Vec3)> = arrows(&loads, 0.5).collect();
        assert_eq!(drawn, [(0, -0.5 * Vec3::Y), (3, 0.25 * Vec3::Y)]);
    }
}
