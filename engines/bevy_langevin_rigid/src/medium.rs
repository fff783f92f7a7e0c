//! What a body moves in: the fluid around all, or that and the fluid of a region.

use std::sync::Arc;

use bevy_math::DVec3;
use langevin_rigid::linalg::{Mat6, rotate_back};
use langevin_rigid::{Input, State, StepError};
use langevin_rigid_world::water::{Immersion, WaterSurface};

use crate::regions::{Region, Surroundings};
use crate::steppers::Mobility;

/// What a body was in over its last step.
#[derive(Debug, Clone, Default)]
pub(crate) enum Medium {
    /// It was put where it is, and has the velocity that it was given.
    #[default]
    Unknown,
    /// The fluid around all.
    Open,
    /// Also a fluid region, under this surface or close above it.
    Region(Arc<Immersion>, Arc<WaterSurface>),
}

impl Medium {
    /// What a body will be in over the coming step of `dt` (s).
    pub(crate) fn around(
        state: &State,
        mobility: &Mobility,
        dt: f64,
        gravity: [f64; 3],
        surroundings: &Surroundings,
    ) -> Self {
        let Some(region) = surroundings.region(state.position) else {
            return Self::Open;
        };
        if clear(state, region, mobility.radius, dt, gravity) {
            return Self::Open;
        }
        match mobility.crossing(region) {
            Some(crossing) => Self::Region(crossing.clone(), region.surface.clone()),
            None => Self::Open,
        }
    }

    /// Steps a body in it, which was in `before`.
    pub(crate) fn step(
        &self,
        state: &mut State,
        before: &Self,
        mobility: &Mobility,
        dt: f64,
        input: &Input,
    ) -> Result<(), StepError> {
        let Self::Region(immersion, surface) = self else {
            return mobility.open.step(state, dt, input);
        };
        match before {
            Self::Unknown => {}
            Self::Open => meet(state, mobility.open.total_mass(), immersion, surface),
            Self::Region(there, was) if Arc::ptr_eq(there, immersion) && was == surface => {}
            Self::Region(there, was) => {
                let mass = there.total_mass(there.share(state, was));
                meet(state, &mass, immersion, surface);
            }
        }
        immersion.step(state, dt, input, surface)
    }
}

/// Whether a body cannot reach the surface of `region` in a step of `dt` (s) from above: it would need twice its speed and
/// twice gravity.
fn clear(state: &State, region: &Region, radius: f64, dt: f64, gravity: [f64; 3]) -> bool {
    let speed = DVec3::from(state.velocity).length();
    let pull = DVec3::from(gravity).length();
    let height = state.position[1] - region.surface.level();
    height > radius + 2.0 * (speed + pull * dt) * dt
}

/// A body with the mass `before` finds itself under another surface without having come through it: where more fluid moves
/// with it than before, its momentum relative to the fluid stays, as where it comes through (`Immersion`); where less does,
/// its velocity.
fn meet(state: &mut State, before: &Mat6, immersion: &Immersion, surface: &WaterSurface) {
    let share = immersion.share(state, surface);
    let linear = |mass: &Mat6| mass[0][0] + mass[1][1] + mass[2][2];
    if linear(&immersion.total_mass(share)) <= linear(before) {
        return;
    }
    let fluid = surface.flow(state.position, state.time).velocity;
    let fluid = DVec3::from(rotate_back(state.orientation, fluid));
    let velocity = DVec3::from(state.velocity) - fluid;
    let [a, b, c] = velocity.to_array();
    let [d, e, f] = state.angular_velocity;
    let momentum = times(before, [a, b, c, d, e, f]);
    let [a, b, c, d, e, f] = times(&immersion.inverse_total_mass(share), momentum);
    state.velocity = (DVec3::new(a, b, c) + fluid).to_array();
    state.angular_velocity = [d, e, f];
}

fn times(m: &Mat6, a: [f64; 6]) -> [f64; 6] {
    std::array::from_fn(|i| (0..6).map(|j| m[i][j] * a[j]).sum())
}
