//! What is printed. Text from files and names may hold anything: no control character of it reaches the
//! terminal.

use std::fmt::{Display, Write as _};
use std::io::{self, ErrorKind, StdoutLock, Write};

/// What the person at the terminal should know.
pub(crate) fn note(text: impl Display) {
    aside(&format!("note: {text}"));
}

/// What the person at the terminal should not overlook.
pub(crate) fn warning(text: impl Display) {
    aside(&format!("warning: {text}"));
}

/// Why there is no result.
pub(crate) fn error(text: impl Display) {
    aside(&format!("error: {text}"));
}

/// A line on standard error. Where nobody listens there is nobody to tell: failure is no error.
pub(crate) fn aside(line: &str) {
    let _ = io::stderr().write_all((plain(line) + "\n").as_bytes());
}

/// Standard output.
pub(crate) fn out() -> Out {
    Out(io::stdout().lock())
}

pub(crate) struct Out(StdoutLock<'static>);

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let text = plain(&String::from_utf8_lossy(bytes));
        self.0.write_all(text.as_bytes()).map_err(ours)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(ours)
    }
}

fn ours(error: io::Error) -> io::Error {
    match error.kind() {
        ErrorKind::BrokenPipe => error,
        kind => io::Error::new(kind, format!("cannot write to standard output: {error}")),
    }
}

/// The text with its control characters escaped, but for ends of lines and tabs.
fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        if is_harmful(c) {
            // Writing to a string cannot fail.
            let _ = write!(plain, "{}", c.escape_unicode());
        } else {
            plain.push(c);
        }
    }
    plain
}

/// Control characters, and those that turn the direction of what follows.
fn is_harmful(c: char) -> bool {
    let turns =
        matches!(c, '\u{200e}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || c.is_control() && !matches!(c, '\n' | '\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_shown_and_do_not_act() {
        assert_eq!(plain("a\u{1b}[31mb\u{7}"), "a\\u{1b}[31mb\\u{7}");
        assert_eq!(plain("\u{9b}2J \u{202e}x\r"), "\\u{9b}2J \\u{202e}x\\u{d}");
        assert_eq!(plain("Blätter\n\tµ"), "Blätter\n\tµ");
    }
}
