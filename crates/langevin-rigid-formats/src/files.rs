//! Writing files whole or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write `{}`: {error}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the system said.
    pub error: std::io::Error,
}

/// Writes `bytes` to `path`, making its folder where there is none.
///
/// The bytes go to a temporary file in the same folder that takes the place of `path` when it is
/// complete, so that nobody ever sees half a file.
///
/// # Errors
/// [`WriteError`]; whatever was at `path` is then still there.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_with(path, |out| out.write_all(bytes))
}

/// [`write()`] for what is better written as it comes than kept in memory.
///
/// # Errors
/// [`WriteError`], from the system or from `content`; whatever was at `path` is then still there.
pub fn write_with(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    replace(path, content).map_err(|error| WriteError {
        path: path.to_owned(),
        error,
    })
}

fn replace(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> std::io::Result<()> {
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder)?;
    let temporary = tempfile::Builder::new()
        .prefix(".langevin-rigid-")
        .tempfile_in(folder)?;
    set_readable(temporary.as_file())?;
    let (file, place) = temporary.into_parts();
    let mut out = BufWriter::new(file);
    content(&mut out)?;
    out.flush()?;
    place.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// Temporary files are private; results are as readable as any new file.
#[cfg(unix)]
fn set_readable(file: &File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn set_readable(_: &File) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_whole_and_folders_made() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b.txt");
        write(&path, b"first").unwrap();
        write(&path, b"second").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
        assert_eq!(
            std::fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1
        );
    }

    #[test]
    fn a_failed_write_names_the_file_and_keeps_what_was_there() {
        let folder = tempfile::tempdir().unwrap();
        let message = write(folder.path(), b"x").unwrap_err().to_string();
        assert!(
            message.contains(&folder.path().display().to_string()),
            "{message}"
        );
        assert!(folder.path().is_dir());
    }

    #[test]
    fn content_that_fails_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("half.txt");
        let half = write_with(&path, |out| {
            out.write_all(b"half")?;
            Err(std::io::Error::other("the rest is missing"))
        });
        assert!(
            half.unwrap_err()
                .to_string()
                .contains("the rest is missing")
        );
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
