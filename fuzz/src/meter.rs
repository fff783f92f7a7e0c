//! How much time and memory an input may take.

use peak_alloc::PeakAlloc;
use rustix::time::{ClockId, clock_gettime};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// How much longer a replay may take: it is to show the same fault again, on a machine of any speed.
const PATIENCE: f64 = if cfg!(fuzzing) { 1.0 } else { 10.0 };
/// Memory of an input (bytes) over its length, and beside that.
const PER_BYTE: usize = 100;
const BESIDE: usize = 64 << 20;

/// Does `work` on an input of so many bytes, in so much processor time (s) of all threads: other programs on the machine are
/// none of its business.
///
/// # Panics
/// Where that takes longer or more memory than it may.
pub(crate) fn within_limits(bytes: usize, limit: f64, work: impl FnOnce()) {
    let allowed = PATIENCE * limit;
    HEAP.reset_peak_usage();
    let (before, start) = (HEAP.current_usage(), seconds());
    work();
    let (taken, memory) = (seconds() - start, HEAP.peak_usage().saturating_sub(before));
    assert!(
        taken <= allowed,
        "{taken:.2} s of processor time for {bytes} bytes; {allowed} s are allowed"
    );
    let allowed = BESIDE + PER_BYTE * bytes;
    assert!(
        memory <= allowed,
        "{memory} bytes of memory for {bytes} bytes; {allowed} are allowed"
    );
}

/// Processor time of this process so far (s).
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}
