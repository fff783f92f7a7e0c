//! Level of detail: bodies far from the viewer take longer and cheaper steps.

use bevy_ecs::entity::Entity;
use bevy_ecs::reflect::ReflectResource;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Res, SystemParam};
use bevy_math::DVec3;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_transform::helper::TransformHelper;
use langevin_rigid::Integrator;

use crate::ambient::ImmersionSettings;

/// How far from whom bodies move in less detail; a resource. Without a viewer, which is the default, none does.
///
/// A body beyond the first distance takes every second fixed step, one beyond the second every fourth, of twice and four
/// times the length: the same time passes for it. These steps are in single precision and resolve no faster motion than
/// they must ([`Settings::longest_part`](langevin_rigid::Settings::longest_part)). They lead: the body is drawn on its way
/// to where the step ends, so that it is as smooth and as late as one that is near. Whatever the game does with a body,
/// moving it, pushing it or setting its velocity, is done at the next fixed step however far it is, and a body that an
/// [`ExternalWrench`](crate::ExternalWrench) acts on takes every step.
///
/// Bits depend on the distances then: where the viewer is at each fixed step must be the same for the same bits.
#[derive(Resource, Debug, Clone, Copy, PartialEq, Reflect)]
#[reflect(Resource, Default, Clone, PartialEq)]
pub struct LevelOfDetail {
    /// The camera, say. If it is gone or nowhere, all bodies are near.
    pub viewer: Option<Entity>,
    /// Beyond these, a body takes every second and every fourth step (m).
    pub distances: [f32; 2],
}

impl Default for LevelOfDetail {
    fn default() -> Self {
        Self {
            viewer: None,
            distances: [20.0, 50.0],
        }
    }
}

/// Whence bodies are seen.
#[derive(SystemParam)]
pub(crate) struct View<'w, 's> {
    detail: Res<'w, LevelOfDetail>,
    settings: Res<'w, ImmersionSettings>,
    transforms: TransformHelper<'w, 's>,
}

/// How many fixed steps a body takes as one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spans {
    viewer: DVec3,
    /// Squares (m^2).
    distances: [f64; 2],
}

impl View<'_, '_> {
    /// None where all bodies are near.
    pub(crate) fn spans(&self) -> Option<Spans> {
        // The other integrator wants short steps.
        if self.settings.motion.integrator != Integrator::Strang {
            return None;
        }
        let viewer = self
            .transforms
            .compute_global_transform(self.detail.viewer?);
        let viewer = viewer.ok()?.translation().as_dvec3();
        viewer.is_finite().then_some(Spans {
            viewer,
            distances: self.detail.distances.map(square),
        })
    }
}

/// Of a distance; never passed if it is not a number.
fn square(distance: f32) -> f64 {
    match distance.is_nan() {
        true => f64::INFINITY,
        false => f64::from(distance.max(0.0)).powi(2),
    }
}

impl Spans {
    /// For a body at `position` (m) with this number, before fixed step `step`: shorter at first, so that bodies take
    /// turns.
    pub(crate) fn of(&self, position: [f64; 3], number: u32, step: u32) -> u32 {
        let away = DVec3::from(position).distance_squared(self.viewer);
        let longest = match self.distances.map(|distance| away > distance) {
            [_, true] => 4,
            [true, false] => 2,
            [false, false] => return 1,
        };
        longest - step.wrapping_sub(number) % longest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_grow_with_the_distance_and_bodies_take_turns() {
        let spans = Spans {
            viewer: DVec3::X,
            distances: [100.0, 10_000.0],
        };
        let of = |x: f64, number, step| spans.of([x, 0.0, 0.0], number, step);
        for step in 0..8 {
            assert_eq!(of(10.9, 3, step), 1);
            for (x, longest) in [(11.1, 2), (-98.9, 2), (-99.1, 4)] {
                let span = of(x, 3, step);
                assert!((1..=longest).contains(&span));
                // Each span ends where the next is a whole one.
                assert_eq!(of(x, 3, step + span), longest);
            }
        }
        let firsts: Vec<u32> = (0..4).map(|number| of(1e3, number, 0)).collect();
        assert_eq!(firsts.iter().sum::<u32>(), 1 + 2 + 3 + 4);
    }

    #[test]
    fn distances_that_are_no_numbers_are_never_passed() {
        assert_eq!(square(f32::NAN), f64::INFINITY);
        assert_eq!(square(-1.0), 0.0);
    }
}
