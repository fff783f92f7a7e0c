//! What memory and time work will take, estimated before it begins.

use std::fmt::{self, Display, Formatter};

/// Steps that even a fast machine takes days for.
pub const MOST_STEPS: u64 = 1_000_000_000_000;

/// What work takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Need {
    /// Memory that it holds at once (bytes).
    pub bytes: u64,
    /// Steps of a body, over all bodies.
    pub steps: u64,
}

impl Need {
    /// From products of what was asked for; what no whole number holds counts as the largest.
    ///
    /// ```
    /// use langevin_rigid_formats::budget::Need;
    /// assert_eq!(Need::new(800.0, 1e30).steps, u64::MAX);
    /// ```
    pub fn new(bytes: f64, steps: f64) -> Self {
        let whole = |x: f64| if x.is_nan() { u64::MAX } else { x as u64 };
        Self {
            bytes: whole(bytes),
            steps: whole(steps),
        }
    }
}

impl Display for Need {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.3e} steps and {}",
            self.steps as f64,
            Bytes(self.bytes)
        )
    }
}

/// A number of bytes, for people.
struct Bytes(u64);

impl Display for Bytes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        const UNITS: [&str; 7] = ["bytes", "kB", "MB", "GB", "TB", "PB", "EB"];
        let thousands = (self.0.max(1).ilog10() / 3) as usize;
        let decimals = usize::from(thousands > 0);
        let number = self.0 as f64 / 1e3f64.powi(thousands as i32);
        write!(f, "{number:.decimals$} {}", UNITS[thousands])
    }
}

/// Work that cannot be done here.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TooMuch {
    /// More steps than anybody waits for.
    #[error(
        "{what} would take {:.3e} steps, and {MOST_STEPS:.0e} take days: ask for less",
        *steps as f64
    )]
    Steps {
        /// What was asked for.
        what: String,
        /// How many it takes.
        steps: u64,
    },
    /// More memory than there is.
    #[error(
        "{what} would take {} of memory, and this machine has {} to spare: ask for less",
        Bytes(*bytes),
        Bytes(*spare)
    )]
    Memory {
        /// What was asked for.
        what: String,
        /// How much it takes (bytes).
        bytes: u64,
        /// How much work may take (bytes).
        spare: u64,
    },
}

/// Refuses work that cannot be done: more than [`MOST_STEPS`], or more memory than [`spare`].
///
/// `what` names what was asked for, as its author wrote it: an option, a line of a file.
///
/// ```
/// use langevin_rigid_formats::budget::{Need, check};
/// assert!(check(Need::new(1e4, 1e6), "`--bodies 100`").is_ok());
/// let refused = check(Need::new(1e18, 1e6), "`--bodies 4000000000`").unwrap_err();
/// assert!(refused.to_string().starts_with("`--bodies 4000000000` would take 1.0 EB of memory"));
/// ```
///
/// # Errors
/// [`TooMuch`].
pub fn check(need: Need, what: &str) -> Result<(), TooMuch> {
    within(need, what, spare())
}

fn within(need: Need, what: &str, spare: u64) -> Result<(), TooMuch> {
    let what = what.to_owned();
    let Need { bytes, steps } = need;
    if steps > MOST_STEPS {
        return Err(TooMuch::Steps { what, steps });
    }
    if bytes > spare {
        return Err(TooMuch::Memory { what, bytes, spare });
    }
    Ok(())
}

/// Memory that work may take: three quarters of what is free on this machine, or in the container that it
/// runs in (bytes); no limit where the system does not tell.
pub fn spare() -> u64 {
    let Ok(mut system) = sysinfo::System::new() else {
        return u64::MAX;
    };
    system.refresh_memory();
    let contained = system.cgroup_limits().map_or(u64::MAX, |c| c.free_memory);
    match system.available_memory().min(contained) {
        0 => u64::MAX,
        free => free / 4 * 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_much_is_refused_with_its_number() {
        let need = |bytes, steps| Need { bytes, steps };
        assert_eq!(within(need(1000, MOST_STEPS), "this", 1000), Ok(()));
        let steps = within(need(0, 2 * MOST_STEPS), "`--runs 7`", 1000).unwrap_err();
        let steps = steps.to_string();
        assert!(
            steps.contains("`--runs 7` would take 2.000e12 steps"),
            "{steps}"
        );
        let memory = within(need(2_500_000, 1), "`--runs 7`", 1000).unwrap_err();
        let memory = memory.to_string();
        assert!(
            memory.contains("`--runs 7` would take 2.5 MB of memory"),
            "{memory}"
        );
        assert!(memory.contains("has 1.0 kB to spare"), "{memory}");
    }

    #[test]
    fn this_machine_has_some_memory_and_not_all_of_it() {
        assert!((1 << 20..u64::MAX).contains(&spare()));
    }

    #[test]
    fn numbers_beyond_all_bounds_are_the_largest() {
        assert_eq!(
            Need::new(f64::NAN, f64::INFINITY),
            Need {
                bytes: u64::MAX,
                steps: u64::MAX
            }
        );
        assert_eq!(Bytes(u64::MAX).to_string(), "18.4 EB");
        assert_eq!(Bytes(0).to_string(), "0 bytes");
        assert_eq!(Bytes(999).to_string(), "999 bytes");
    }
}
