//! The table of kinds and sizes that stands beside a trajectory whose bodies differ in them.

use std::io::{self, Write};

use super::Recording;

/// The file that it is written to.
pub(super) const FILE_NAME: &str = "bodies.csv";

/// A row for each body, in the order of the trajectory table.
pub(super) fn write(recording: &Recording<'_>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "body,kind,scale")?;
    for body in recording.bodies {
        let kind = quoted(recording.kind_of(body).name);
        writeln!(out, "{},{kind},{}", body.trajectory.body, body.scale)?;
    }
    Ok(())
}

/// A field as RFC 4180 has it.
fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_part_a_row_is_quoted() {
        assert_eq!(quoted("maple seed"), "maple seed");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("8\" plate"), "\"8\"\" plate\"");
    }
}
