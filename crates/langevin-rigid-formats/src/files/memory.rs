//! Files in memory, where a page in a browser has no others.

use std::collections::BTreeMap;
use std::io::{self, Cursor, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::WriteError;

static FILES: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());

fn files() -> MutexGuard<'static, BTreeMap<PathBuf, Vec<u8>>> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What content of files is written to.
pub type Out = Cursor<Vec<u8>>;

/// The bytes of a file.
///
/// # Errors
/// There is no file of this name.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let missing = || io::Error::new(ErrorKind::NotFound, "there is no such file in this page");
    files().get(path).cloned().ok_or_else(missing)
}

/// A file to read from.
///
/// # Errors
/// There is no file of this name.
pub fn open(path: &Path) -> io::Result<impl io::Read> {
    read(path).map(Cursor::new)
}

/// Puts a file in place, whole or not at all.
///
/// # Errors
/// [`WriteError`], from `content`.
pub fn write_with(
    path: &Path,
    content: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<(), WriteError> {
    let mut out = Cursor::new(Vec::new());
    content(&mut out).map_err(WriteError::of(path))?;
    files().insert(path.to_owned(), out.into_inner());
    Ok(())
}

/// Takes a file away, with its bytes if it was there.
pub fn take(path: &Path) -> Option<Vec<u8>> {
    files().remove(path)
}
