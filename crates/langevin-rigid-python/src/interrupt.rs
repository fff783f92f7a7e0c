//! Long work without the interpreter's lock, which Ctrl-C ends.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use langevin_rigid_bake::progress::Progress;
use pyo3::prelude::*;

use crate::threads;

/// How often signals are looked for.
const OFTEN: Duration = Duration::from_millis(50);

/// Tells work that it is no longer wanted.
#[derive(Default)]
pub(crate) struct Wanted {
    stopped: AtomicBool,
}

impl Progress for Wanted {
    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// Does long work in a thread of its own, while this one, without the lock, looks for signals: only the main thread of an
/// interpreter may. What the work then gives is dropped, and the signal's exception raised.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Wanted) -> T + Send,
) -> PyResult<T> {
    let pool = threads::pool()?;
    let wanted = Wanted::default();
    std::thread::scope(|scope| {
        let (sender, mut done) = channel::<()>();
        let wanted = &wanted;
        let worker = scope.spawn(move || {
            let _until_the_end = sender;
            pool.install(|| work(wanted))
        });
        let mut signal = Ok(());
        while signal.is_ok() {
            let done = &mut done;
            match py.detach(move || done.recv_timeout(OFTEN)) {
                Err(RecvTimeoutError::Timeout) => signal = py.check_signals(),
                Ok(()) | Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        if signal.is_err() {
            wanted.stopped.store(true, Ordering::Relaxed);
        }
        let outcome = py.detach(move || worker.join());
        signal?;
        // A panic of the work goes on in this thread.
        outcome.map_or_else(|panic| std::panic::resume_unwind(panic), Ok)
    })
}

/// Repeats short work without the lock, until it says that it is done by giving something; looks for signals now and then.
pub(crate) fn repeated<T: Send>(
    py: Python<'_>,
    mut work: impl FnMut() -> Option<T> + Send,
) -> PyResult<T> {
    loop {
        let work = &mut work;
        let outcome = py.detach(move || {
            let started = Instant::now();
            loop {
                if let Some(outcome) = work() {
                    return Some(outcome);
                }
                if started.elapsed() > OFTEN {
                    return None;
                }
            }
        });
        if let Some(outcome) = outcome {
            return Ok(outcome);
        }
        py.check_signals()?;
    }
}
