//! What the tests share.

use std::process::Command;

/// The system's compiler, if it has one.
pub(crate) fn compiler(variable: &str, usual: &str) -> Option<Command> {
    let name = std::env::var(variable).unwrap_or_else(|_| usual.into());
    let there = Command::new(&name).arg("--version").output();
    if there.is_ok_and(|output| output.status.success()) {
        return Some(Command::new(name));
    }
    eprintln!(
        "SKIPPED: there is no compiler `{name}` here; name another in the variable {variable}"
    );
    None
}
