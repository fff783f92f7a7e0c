//! How a long computation reports its progress, and how it is asked to stop.

/// Receives the progress of long work and may cancel it.
///
/// Called from worker threads. `()` neither reports nor cancels.
pub trait Progress: Sync {
    /// `fraction` in [0, 1] of the named stage is done.
    fn report(&self, stage: &str, fraction: f64) {
        let _ = (stage, fraction);
    }

    /// Whether the work should stop at the next opportunity.
    fn cancelled(&self) -> bool {
        false
    }
}

impl Progress for () {}

/// Passes on only whether to go on: for a part of some work whose whole is reported.
pub struct Silent<'a>(pub &'a dyn Progress);

impl Progress for Silent<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
