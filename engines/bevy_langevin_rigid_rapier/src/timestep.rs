//! Whether Rapier takes the steps that the bodies take.

use bevy_app::{App, FixedUpdate};
use bevy_ecs::schedule::{NodeId, Schedules, SystemSet};
use bevy_ecs::system::{Local, Res};
use bevy_log::error;
use bevy_rapier3d::plugin::{PhysicsSet, TimestepMode};
use bevy_time::{Fixed, Time};

/// Steps that differ by less than this part are one.
const ROUNDING: f64 = 1e-4;

/// Whether Rapier steps in `FixedUpdate`, once all plugins are built.
pub(crate) fn is_fixed(app: &App) -> bool {
    let schedules = app.world().get_resource::<Schedules>();
    let Some(graph) = schedules
        .and_then(|schedules| schedules.get(FixedUpdate))
        .map(|schedule| schedule.graph())
    else {
        return false;
    };
    let steps = graph
        .system_sets
        .get_key(PhysicsSet::StepSimulation.intern());
    // Others' order names the set too: only its systems make it step.
    steps.is_some_and(|set| {
        let mut members = graph.hierarchy().neighbors(NodeId::Set(set));
        members.next().is_some()
    })
}

/// Says once that Rapier's step has another length than the fixed one.
pub(crate) fn check(
    mode: Option<Res<TimestepMode>>,
    time: Res<Time<Fixed>>,
    mut said: Local<bool>,
) {
    let Some(mode) = mode.filter(|_| !*said) else {
        return;
    };
    let fixed = time.delta_secs_f64();
    let rapiers = length(*mode, time.delta_secs());
    let same = rapiers.is_some_and(|dt| (f64::from(dt) - fixed).abs() <= ROUNDING * fixed);
    if !same {
        error!(
            "Rapier steps by {:?}, bodies that are `Immersed` by {fixed} s: contacts will be wrong. Insert the resource \
             `TimestepMode::Fixed {{ dt: {fixed}, substeps: 1 }}`, or set the step of `Time<Fixed>` (this is said once)",
            *mode
        );
        *said = true;
    }
}

/// Length of Rapier's step (s) in a fixed step; none where it has a clock of its own.
fn length(mode: TimestepMode, fixed: f32) -> Option<f32> {
    match mode {
        TimestepMode::Fixed { dt, .. } => Some(dt),
        TimestepMode::Variable {
            max_dt, time_scale, ..
        } => Some((fixed * time_scale).min(max_dt)),
        TimestepMode::Interpolated { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_clock_of_its_own_has_no_length() {
        let fixed = TimestepMode::Fixed {
            dt: 0.02,
            substeps: 4,
        };
        assert_eq!(length(fixed, 0.01), Some(0.02));
        assert_eq!(length(TimestepMode::default(), 0.01), Some(0.01));
        assert_eq!(length(TimestepMode::default(), 0.1), Some(1.0 / 60.0));
        let own = TimestepMode::Interpolated {
            dt: 0.01,
            time_scale: 1.0,
            substeps: 1,
        };
        assert_eq!(length(own, 0.01), None);
    }
}
