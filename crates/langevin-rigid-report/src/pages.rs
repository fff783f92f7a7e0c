//! Tables of Markdown pages, written by those who measure them.
//!
//! A table stands between two lines of a page:
//!
//! ```text
//! <!-- table: PART/NAME -->
//! <!-- end -->
//! ```
//!
//! What is between them is replaced when the part is computed ([`update`]); all else of the page is its author's.

use std::path::{Path, PathBuf};

use langevin_rigid_formats::files::{self, WriteError};

use crate::table::Table;

/// The tables of a part that was computed, under its name.
pub type Computed<'a> = (&'a str, &'a [Table]);

/// Why the tables of a page cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkError {
    /// The part was computed and has no such table.
    #[error("there is no table `{mark}`; the tables of `{part}` are {known}")]
    Unknown {
        /// Part and table, as the page has them.
        mark: String,
        /// The part.
        part: String,
        /// Its tables.
        known: String,
    },
    /// The end of the table is missing.
    #[error("the table `{mark}` has no line `<!-- end -->` after it")]
    Open {
        /// Part and table, as the page has them.
        mark: String,
    },
}

/// Why pages are not updated; none is written then, unless writing itself fails.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UpdateError {
    /// A folder or a page could not be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Read {
        /// The folder or the page.
        path: PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// The marks of a page are wrong.
    #[error("`{}`: {error}", page.display())]
    Mark {
        /// The page.
        page: PathBuf,
        /// What is wrong.
        error: MarkError,
    },
    /// A page could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// The tables that a page has places for, as `PART/NAME`, in their order.
pub fn marks(page: &str) -> impl Iterator<Item = &str> {
    page.lines().filter_map(mark)
}

/// The page with the tables of these parts in their places; those of other parts stay as they are.
///
/// ```
/// use langevin_rigid_report::{Table, pages};
///
/// let table = Table::new("main", &["n"], &[vec!["2".to_owned()]]);
/// let page = "Words.\n\n<!-- table: bench/main -->\nold\n<!-- end -->\n";
/// assert_eq!(
///     pages::replaced(page, &[("bench", &[table])])?,
///     "Words.\n\n<!-- table: bench/main -->\n| n |\n|---|\n| 2 |\n<!-- end -->\n"
/// );
/// # Ok::<(), pages::MarkError>(())
/// ```
///
/// # Errors
/// [`MarkError`]: a table that its part does not have, or whose end is missing.
pub fn replaced(page: &str, parts: &[Computed]) -> Result<String, MarkError> {
    let mut text = String::with_capacity(page.len());
    let mut lines = page.split_inclusive('\n');
    while let Some(line) = lines.next() {
        text += line;
        let Some(mark) = mark(line) else { continue };
        let (old, end) = until_end(&mut lines).ok_or_else(|| MarkError::Open {
            mark: mark.to_owned(),
        })?;
        text += table(mark, parts)?.unwrap_or(&old);
        text += end;
    }
    Ok(text)
}

/// Writes the tables of these parts into every page (`*.md`) of a folder; gives the pages that changed.
///
/// # Errors
/// [`UpdateError`] names the page.
pub fn update(folder: &Path, parts: &[Computed]) -> Result<Vec<PathBuf>, UpdateError> {
    let mut changed = Vec::new();
    for path in list(folder)? {
        let old = std::fs::read_to_string(&path).map_err(unread(&path))?;
        let new = replaced(&old, parts).map_err(|error| UpdateError::Mark {
            page: path.clone(),
            error,
        })?;
        if new != old {
            changed.push((path, new));
        }
    }
    for (path, text) in &changed {
        files::write(path, text.as_bytes())?;
    }
    Ok(changed.into_iter().map(|(path, _)| path).collect())
}

/// The pages of a folder, by name.
///
/// # Errors
/// [`UpdateError::Read`]
pub fn list(folder: &Path) -> Result<Vec<PathBuf>, UpdateError> {
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unread(folder))? {
        let path = entry.map_err(unread(folder))?.path();
        if path.extension().is_some_and(|e| e == "md") && path.is_file() {
            pages.push(path);
        }
    }
    pages.sort();
    Ok(pages)
}

fn unread(path: &Path) -> impl Fn(std::io::Error) -> UpdateError {
    move |error| UpdateError::Read {
        path: path.to_owned(),
        error,
    }
}

/// The table that a line says is to follow.
fn mark(line: &str) -> Option<&str> {
    let inner = line.trim().strip_prefix("<!-- table:")?;
    Some(inner.strip_suffix("-->")?.trim())
}

/// The lines up to the end of a table, and the line that ends it.
fn until_end<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Option<(String, &'a str)> {
    let mut old = String::new();
    for line in lines {
        match line.trim() {
            "<!-- end -->" => return Some((old, line)),
            _ if mark(line).is_some() => return None,
            _ => old += line,
        }
    }
    None
}

/// The table of a mark, or none if its part was not computed.
fn table<'a>(mark: &str, parts: &[Computed<'a>]) -> Result<Option<&'a str>, MarkError> {
    let (part, name) = mark.split_once('/').unwrap_or((mark, ""));
    let Some((_, tables)) = parts.iter().find(|(computed, _)| *computed == part) else {
        return Ok(None);
    };
    match tables.iter().find(|table| table.name == name) {
        Some(table) => Ok(Some(&table.markdown)),
        None => Err(MarkError::Unknown {
            mark: mark.to_owned(),
            part: part.to_owned(),
            known: tables
                .iter()
                .map(|t| t.name.as_str())
                .collect::<Vec<_>>()
                .join(", "),
        }),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    const PAGE: &str = "# A\n\n<!-- table: a/one -->\n| old |\n<!-- end -->\nbetween\n\
        <!-- table: a/two -->\n<!-- end -->\n<!-- table: b/one -->\nkept\n<!-- end -->\nno newline";

    fn tables(names: &[&str]) -> Vec<Table> {
        let cell = |name: &&str| Table::new(name, &["t"], &[vec![(*name).to_owned()]]);
        names.iter().map(cell).collect()
    }

    #[test]
    fn tables_of_computed_parts_are_replaced_and_nothing_else() {
        let computed = tables(&["one", "two", "three"]);
        let new = replaced(PAGE, &[("a", &computed)]).unwrap();
        let wanted = PAGE
            .replace("| old |\n", "| t |\n|---|\n| one |\n")
            .replace("a/two -->\n", "a/two -->\n| t |\n|---|\n| two |\n");
        assert_eq!(new, wanted);
        assert_eq!(replaced(&new, &[("a", &computed)]).unwrap(), new);
        assert_eq!(replaced(PAGE, &[]).unwrap(), PAGE);
        assert_eq!(marks(PAGE).collect::<Vec<_>>(), ["a/one", "a/two", "b/one"]);
    }

    #[test]
    fn what_a_part_does_not_have_is_named() {
        let error = replaced(PAGE, &[("a", &tables(&["one", "other"]))]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no table `a/two`; the tables of `a` are one, other"
        );
    }

    #[test]
    fn a_table_without_end_takes_nothing_with_it() {
        for page in [
            "<!-- table: a/one -->\ntext\n",
            "<!-- table: a/one -->\n<!-- table: a/two -->\n<!-- end -->\n",
        ] {
            let error = replaced(page, &[]).unwrap_err();
            assert!(error.to_string().contains("`a/one` has no line"), "{error}");
        }
    }

    #[test]
    fn every_page_of_a_folder_is_updated_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let write =
            |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
        write("a.md", PAGE);
        write("b.md", "nothing\n");
        write("c.txt", PAGE);
        let (one, both) = (tables(&["one"]), tables(&["one", "two"]));
        write("d.md", "<!-- table: a/one -->\n<!-- end -->\n");
        let error = update(folder.path(), &[("a", &one)]).unwrap_err();
        assert!(error.to_string().contains("a.md") && error.to_string().contains("a/two"));
        assert!(!read("d.md").contains("| one |"));
        let changed = update(folder.path(), &[("a", &both)]).unwrap();
        assert_eq!(
            changed,
            ["a.md", "d.md"].map(|name| folder.path().join(name))
        );
        assert!(read("a.md").contains("| two |") && read("d.md").contains("| one |"));
        assert_eq!(read("c.txt"), PAGE);
        assert!(update(folder.path(), &[("a", &both)]).unwrap().is_empty());
        let missing = update(&folder.path().join("none"), &[]).unwrap_err();
        assert!(missing.to_string().starts_with("cannot read"));
    }
}
