//! What the log says of a Rapier that does not step as the bodies do.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;
#[allow(unreachable_pub, reason = "of the tests of the plugin")]
#[path = "../../bevy_langevin_rigid/tests/common/log.rs"]
mod log;

use bevy_rapier3d::prelude::{RapierPhysicsPlugin, TimestepMode};
use contact_tests::bevy::{DT, steps};

use common::{FIXED, app, app_with};
use log::{errors, listening};

#[test]
fn rapier_that_steps_as_the_bodies_do_is_not_spoken_of() {
    let _turn = listening();
    steps(&mut app(), 3);
    assert!(errors().is_empty(), "{:?}", errors());
}

#[test]
fn rapier_that_does_not_step_in_fixed_update_is_told() {
    let _turn = listening();
    steps(&mut app_with(RapierPhysicsPlugin::default(), FIXED), 3);
    let errors = errors();
    assert_eq!(errors.len(), 1, "{errors:?}");
    let told = "does not step in `FixedUpdate`";
    assert!(errors[0].contains(told), "{errors:?}");
}

#[test]
fn a_step_of_another_length_is_told_once() {
    let longer = TimestepMode::Fixed {
        dt: 1.1 * DT as f32,
        substeps: 1,
    };
    let with_a_clock_of_its_own = TimestepMode::Interpolated {
        dt: DT as f32,
        time_scale: 1.0,
        substeps: 1,
    };
    for mode in [longer, with_a_clock_of_its_own] {
        let _turn = listening();
        let rapier = RapierPhysicsPlugin::default().in_fixed_schedule();
        steps(&mut app_with(rapier, mode), 3);
        let errors = errors();
        assert_eq!(errors.len(), 1, "{errors:?}");
        let told = format!("bodies that are `Immersed` by {DT} s");
        assert!(errors[0].contains(&told), "{errors:?}");
    }
}
