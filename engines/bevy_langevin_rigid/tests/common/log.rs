//! What the plugin has said in the log.

use std::sync::{Mutex, MutexGuard, Once, PoisonError};

use bevy_log::tracing::field::{Field, Visit};
use bevy_log::tracing::{Event, Level, Subscriber};
use bevy_log::tracing_subscriber::Layer;
use bevy_log::tracing_subscriber::layer::{Context, SubscriberExt};
use bevy_log::tracing_subscriber::registry::Registry;

static ERRORS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// The errors and warnings since this test began to listen.
pub fn errors() -> MutexGuard<'static, Vec<String>> {
    ERRORS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps the errors and warnings of the plugin in [`ERRORS`].
struct Keep;

impl<S: Subscriber> Layer<S> for Keep {
    fn on_event(&self, event: &Event<'_>, _: Context<'_, S>) {
        let metadata = event.metadata();
        if *metadata.level() <= Level::WARN && metadata.target().starts_with("bevy_langevin_rigid")
        {
            event.record(&mut Message);
        }
    }
}

struct Message;

impl Visit for Message {
    fn record_debug(&mut self, field: &Field, value: &dyn std::fmt::Debug) {
        if field.name() == "message" {
            errors().push(format!("{value:?}"));
        }
    }
}

/// Tests that read the log take turns; each begins with an empty one.
pub fn listening() -> MutexGuard<'static, ()> {
    static INSTALLED: Once = Once::new();
    static TURN: Mutex<()> = Mutex::new(());
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    INSTALLED.call_once(|| {
        let subscriber = Registry::default().with(Keep);
        bevy_log::tracing::subscriber::set_global_default(subscriber).unwrap();
    });
    errors().clear();
    turn
}
