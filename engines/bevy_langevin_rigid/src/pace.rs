//! How many fixed steps a body takes as one.

use bevy_ecs::component::Component;

/// The step that a body took last, in fixed steps.
#[derive(Component, Debug, Clone, Copy)]
pub(crate) struct Pace {
    /// How long it is.
    span: u32,
    /// How many of these have passed.
    passed: u32,
    /// Whether an engine lets the body sleep.
    pub(crate) rests: bool,
}

impl Default for Pace {
    fn default() -> Self {
        Self::of(1)
    }
}

impl Pace {
    /// The body has taken a step of so many fixed steps, of which this is the first.
    pub(crate) fn of(span: u32) -> Self {
        Self {
            span,
            passed: 1,
            rests: false,
        }
    }

    /// Whether the step is over.
    pub(crate) fn is_due(self) -> bool {
        self.passed >= self.span
    }

    /// One more fixed step has passed.
    pub(crate) fn pass(&mut self) {
        self.passed += 1;
    }

    /// How much of the step has passed.
    pub(crate) fn passed(self) -> f64 {
        f64::from(self.passed) / f64::from(self.span)
    }

    /// The same in a frame that is so far from the last fixed step to the next.
    pub(crate) fn drawn(self, fraction: f32) -> f32 {
        ((self.passed as f32 - 1.0) + fraction) / self.span as f32
    }
}
