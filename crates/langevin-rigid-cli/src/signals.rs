//! Ctrl-C and its kin.
//!
//! While there is work whose first part is worth keeping, the first signal asks it to stop. Everything else,
//! and everything at the second signal, ends at once, whatever the other threads do: no file is ever half
//! written, and temporary ones are removed.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use langevin_rigid_formats::files;

use crate::say;

/// What shells add the number of the signal to.
const ENDED_BY: i32 = 128;

/// Which signal came, and what it may do.
#[derive(Default)]
pub(crate) struct Signals {
    /// The first signal.
    came: OnceLock<i32>,
    /// Whether there is work that stops when it is asked.
    stoppable: AtomicBool,
}

impl Signals {
    /// Listens in a thread of its own. `before_end` clears the screen.
    pub(crate) fn listen(before_end: impl Fn() + Send + 'static) -> Arc<Self> {
        let signals = Arc::new(Self::default());
        let heard = Arc::clone(&signals);
        on_signal(move |signal| heard.hear(signal, &before_end));
        signals
    }

    fn hear(&self, signal: i32, before_end: &dyn Fn()) {
        let first = self.came.set(signal).is_ok();
        if first && self.stoppable.load(Ordering::SeqCst) {
            return;
        }
        files::abandon();
        before_end();
        say::aside("interrupted; files that are there are whole");
        std::process::exit(ENDED_BY + signal);
    }

    /// Whether a signal came.
    pub(crate) fn came(&self) -> bool {
        self.came.get().is_some()
    }

    /// Waits for one.
    pub(crate) fn wait(&self) {
        self.came.wait();
    }

    /// The exit code of a program that a signal ended.
    pub(crate) fn exit_code(&self) -> u8 {
        let signal = self.came.get().unwrap_or(&0);
        u8::try_from(ENDED_BY + signal).unwrap_or(u8::MAX)
    }

    /// Whether work stops when it is asked, from now on.
    pub(crate) fn stoppable(&self, stoppable: bool) {
        self.stoppable.store(stoppable, Ordering::SeqCst);
    }
}

#[cfg(unix)]
fn on_signal(hear: impl Fn(i32) + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let wanted = [SIGHUP, SIGINT, SIGTERM]
        .into_iter()
        .filter(|s| !is_ignored(*s));
    // Without a handler the process ends at once, which loses work but harms no file.
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(wanted) {
        std::thread::spawn(move || signals.forever().for_each(hear));
    }
}

/// Whether whoever started us wants a signal ignored, as `nohup` does; told by Linux only.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

#[cfg(not(unix))]
fn on_signal(hear: impl Fn(i32) + Send + 'static) {
    const SIGINT: i32 = 2;
    let _ = ctrlc::set_handler(move || hear(SIGINT));
}
