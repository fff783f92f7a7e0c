//! Progress on a terminal, and Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use langevin_rigid_bake::progress::Progress;

/// What takes less is over before anybody wonders.
const PATIENCE: Duration = Duration::from_secs(1);
const TICKS: u64 = 1000;

/// One progress bar at a time on standard error, if that is a terminal.
pub(crate) struct Bars {
    interrupted: Arc<AtomicBool>,
    current: Mutex<Current>,
}

struct Current {
    stage: String,
    since: Instant,
    bar: Option<ProgressBar>,
}

impl Bars {
    pub(crate) fn new() -> Self {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        // Without a handler Ctrl-C ends the process at once, which loses work but harms no file.
        let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
        let current = Current {
            stage: String::new(),
            since: Instant::now(),
            bar: None,
        };
        Self {
            interrupted,
            current: Mutex::new(current),
        }
    }

    /// Whether Ctrl-C was pressed.
    pub(crate) fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
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
