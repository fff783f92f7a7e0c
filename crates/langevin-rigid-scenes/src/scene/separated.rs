//! The constants of the closure for separated flow in a scene.

use langevin_rigid::SeparatedFlow;

use super::place::{Document, SceneError};
use super::quantity::{FRACTION, GAIN, POSITIVE};
use super::raw::{RawSeparated, given};

/// Writes both ways from one list: the constants are the fields of the same name, each of a kind.
macro_rules! constants {
    ($($name:ident: $kind:ident),* $(,)?) => {
        pub(super) fn resolve(doc: &Document, raw: &RawSeparated) -> Result<SeparatedFlow, SceneError> {
            let defaults = SeparatedFlow::default();
            Ok(SeparatedFlow {
                $($name: doc
                    .given(&raw.$name, stringify!($name), $kind)?
                    .unwrap_or(defaults.$name),)*
                attached: raw.attached.unwrap_or(defaults.attached),
            })
        }

        /// The section of a resolved scene.
        pub(super) fn write(constants: &SeparatedFlow) -> RawSeparated {
            RawSeparated {
                $($name: given(constants.$name),)*
                attached: Some(constants.attached),
            }
        }
    };
}

constants! {
    attachment: FRACTION,
    broadside_attachment: FRACTION,
    normal_force_arm: POSITIVE,
    dynamic_stall: GAIN,
    rotational_lift: GAIN,
    damping: GAIN,
    rotational_damping: GAIN,
    relief_speed: POSITIVE,
    turbulence_intensity: GAIN,
    turbulence_memory: POSITIVE,
}
