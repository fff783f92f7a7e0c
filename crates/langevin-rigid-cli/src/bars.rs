//! Progress on a terminal, and being asked to stop.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use langevin_rigid_bake::progress::Progress;

use crate::signals::Signals;

/// What takes less is over before anybody wonders.
const PATIENCE: Duration = Duration::from_secs(1);
const TICKS: u64 = 1000;

/// One progress bar at a time on standard error, if that is a terminal.
pub(crate) struct Bars {
    signals: Arc<Signals>,
    current: Arc<Mutex<Current>>,
}

struct Current {
    stage: String,
    since: Instant,
    bar: Option<ProgressBar>,
}

impl Bars {
    pub(crate) fn new() -> Self {
        let current = Arc::new(Mutex::new(Current {
            stage: String::new(),
            since: Instant::now(),
            bar: None,
        }));
        let shown = Arc::clone(&current);
        // The thread that draws may be stuck: the bar then stays.
        let clear = move || {
            if let Ok(mut shown) = shown.try_lock() {
                shown.start("");
            }
        };
        Self {
            signals: Signals::listen(clear),
            current,
        }
    }

    /// Whether a signal asked to stop.
    pub(crate) fn interrupted(&self) -> bool {
        self.signals.came()
    }

    /// The exit code if so.
    pub(crate) fn exit_code(&self) -> u8 {
        self.signals.exit_code()
    }

    /// Does work that stops when it is asked and whose first part is worth keeping. A signal that comes at
    /// another time ends the process.
    pub(crate) fn stoppable<T>(&self, work: impl FnOnce() -> T) -> T {
        self.signals.stoppable(true);
        let done = work();
        self.signals.stoppable(false);
        done
    }

    /// Waits until it is asked to stop.
    pub(crate) fn wait_for_signal(&self) {
        self.stoppable(|| self.signals.wait());
    }

    /// Takes the bar off the screen.
    pub(crate) fn clear(&self) {
        self.lock().start("");
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Current> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Progress for Bars {
    fn report(&self, stage: &str, fraction: f64) {
        let mut current = self.lock();
        if current.stage != stage {
            current.start(stage);
        }
        current.show(fraction);
    }

    fn cancelled(&self) -> bool {
        self.interrupted()
    }
}

impl Current {
    fn start(&mut self, stage: &str) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        stage.clone_into(&mut self.stage);
        self.since = Instant::now();
    }

    fn show(&mut self, fraction: f64) {
        if self.bar.is_none() && self.since.elapsed() > PATIENCE {
            self.bar = Some(bar(&self.stage));
        }
        if let Some(bar) = &self.bar {
            bar.set_position((fraction.clamp(0.0, 1.0) * TICKS as f64) as u64);
        }
    }
}

fn bar(stage: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:>20} [{bar:40}] {percent:>3} % {eta} left");
    let bar = ProgressBar::new(TICKS).with_message(stage.to_owned());
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
