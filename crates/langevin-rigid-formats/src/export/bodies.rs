//! The table of kinds and sizes that stands beside a trajectory whose bodies differ in them.

use std::io::{self, Write};

use super::Recording;
use crate::trajectory::TableError;

const HEADER: &str = "body,kind,scale";

/// Kind and size of a body, a row of `bodies.csv`.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyRow {
    /// Number of the body.
    pub body: u32,
    /// Name of its kind.
    pub kind: String,
    /// Its lengths over those of its kind.
    pub scale: f64,
}

/// The file that it is written to.
pub(super) const FILE_NAME: &str = "bodies.csv";

/// A row for each body, in the order of the trajectory table.
pub(super) fn write(recording: &Recording<'_>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{HEADER}")?;
    for body in recording.bodies {
        let kind = quoted(recording.kind_of(body).name);
        writeln!(out, "{},{kind},{}", body.trajectory.body, body.scale)?;
    }
    Ok(())
}

/// Reads `bodies.csv`, which [`write()`](super::write()) puts beside a table of bodies that differ in kind or size.
///
/// ```
/// use langevin_rigid_formats::export::read_bodies;
/// let rows = read_bodies("body,kind,scale\n0,leaf,1\n1,\"twig, dry\",1.3\n")?;
/// assert_eq!((rows[1].kind.as_str(), rows[1].scale), ("twig, dry", 1.3));
/// # Ok::<(), langevin_rigid_formats::trajectory::TableError>(())
/// ```
///
/// # Errors
/// [`TableError`] with the line.
pub fn read_bodies(table: &str) -> Result<Vec<BodyRow>, TableError> {
    let (header, rest) = table.split_once('\n').unwrap_or((table, ""));
    if header.trim_end() != HEADER {
        return Err(TableError::Columns { columns: HEADER });
    }
    let mut rows = Vec::new();
    let mut lines = rest.split_inclusive('\n').zip(2..);
    while let Some((first, line)) = lines.next() {
        let mut text = first.to_owned();
        // A line end in quotes is part of a name.
        while text.matches('"').count() % 2 == 1
            && let Some((more, _)) = lines.next()
        {
            text.push_str(more);
        }
        let whole = text.strip_suffix('\n').ok_or(TableError::Cut { line })?;
        let row = row(whole.trim_end_matches('\r'));
        rows.push(row.map_err(|reason| TableError::Line { line, reason })?);
    }
    match rows.is_empty() {
        true => Err(TableError::Empty),
        false => Ok(rows),
    }
}

fn row(text: &str) -> Result<BodyRow, String> {
    let number = |text: &str| format!("`{text}` is no number");
    let fields = text.split_once(',').and_then(|(body, rest)| {
        let (kind, scale) = rest.rsplit_once(',')?;
        Some((body, kind, scale))
    });
    let (body, kind, scale) = fields.ok_or("there are no three fields")?;
    Ok(BodyRow {
        body: body.parse().map_err(|_| number(body))?,
        kind: unquoted(kind).ok_or_else(|| format!("the quotes of `{kind}` do not match"))?,
        scale: scale.parse().map_err(|_| number(scale))?,
    })
}

/// The field that [`quoted`] gives this.
fn unquoted(field: &str) -> Option<String> {
    let Some(inside) = field.strip_prefix('"') else {
        return (!field.contains(['"', ','])).then(|| field.to_owned());
    };
    let inside = inside.strip_suffix('"')?;
    let name = inside.replace("\"\"", "\"");
    (quoted(&name) == field).then_some(name)
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
        for name in ["maple seed", "a,b", "8\" plate", "\"", "two\nlines", ""] {
            let table = format!("body,kind,scale\n7,{},0.1\n", quoted(name));
            let rows = read_bodies(&table).unwrap();
            assert_eq!((rows[0].kind.as_str(), rows[0].scale), (name, 0.1));
        }
    }

    #[test]
    fn what_is_no_table_is_told() {
        let fault = |rows: &str| {
            let table = format!("body,kind,scale\n{rows}");
            read_bodies(&table).unwrap_err().to_string()
        };
        assert!(fault("").contains("no rows"));
        assert!(fault("0,leaf,1").contains("line 2: the table is cut short"));
        assert!(fault("0,leaf,1\n1,leaf\n").contains("line 3: there are no three fields"));
        assert!(fault("x,leaf,1\n").contains("`x` is no number"));
        assert!(fault("0,leaf,big\n").contains("`big` is no number"));
        for kind in ["a,b", "a\"\"b", "\"a\"b\"\"", "\"a\"\"\"\"b,c\"\"\"d"] {
            assert!(fault(&format!("0,{kind},1\n")).contains("quotes"), "{kind}");
        }
        assert!(
            read_bodies("body,t\n")
                .unwrap_err()
                .to_string()
                .contains("(body,kind,scale)")
        );
    }
}
