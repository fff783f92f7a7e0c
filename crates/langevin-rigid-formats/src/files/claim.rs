//! A place for results, tried before the work that makes them.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::WriteError;
use super::disk::{Target, folder_of};
use super::temporary::{Temporary, ours, remove_empty};

/// A place that can be written to.
///
/// Folders that were made for it and have stayed empty are removed when it is dropped.
#[derive(Debug)]
pub struct Claim {
    /// Holds the lock of the folder, where the system has such locks.
    _lock: Option<File>,
    made: Vec<PathBuf>,
}

impl Claim {
    /// Makes the folder, tries to write there, and keeps other processes that claim it out.
    ///
    /// The lock is advisory, and on Unix only: elsewhere folders cannot be locked.
    ///
    /// # Errors
    /// [`WriteError`], also if another process has the folder.
    pub fn folder(folder: &Path) -> Result<Self, WriteError> {
        let claim = || {
            let mut claim = Self::try_folder(folder)?;
            claim._lock = lock(folder)?;
            Ok(claim)
        };
        claim().map_err(WriteError::of(folder))
    }

    /// Tries whether a file can be written, without a trace.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn file(path: &Path) -> Result<Self, WriteError> {
        let claim = || match Target::of(path)? {
            Target::Stream => Ok(Self::nothing()),
            Target::File(file, _) => Self::try_folder(folder_of(&file)),
        };
        claim().map_err(WriteError::of(path))
    }

    fn nothing() -> Self {
        Self {
            _lock: None,
            made: Vec::new(),
        }
    }

    fn try_folder(folder: &Path) -> io::Result<Self> {
        let mut claim = Self::nothing();
        let missing: Vec<&Path> = folder
            .ancestors()
            .take_while(|f| !f.as_os_str().is_empty() && !f.exists())
            .collect();
        for folder in missing.into_iter().rev() {
            claim.make(folder)?;
        }
        drop(Temporary::new(folder)?);
        Ok(claim)
    }

    fn make(&mut self, folder: &Path) -> io::Result<()> {
        match std::fs::create_dir(folder) {
            Ok(()) => {
                ours().folders.push(folder.to_owned());
                self.made.push(folder.to_owned());
                Ok(())
            }
            // Somebody else was faster.
            Err(_) if folder.is_dir() => Ok(()),
            Err(error) => Err(error),
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        remove_empty(&self.made);
    }
}

fn lock(folder: &Path) -> io::Result<Option<File>> {
    let Ok(handle) = File::open(folder) else {
        return Ok(None);
    };
    match handle.try_lock() {
        Ok(()) => Ok(Some(handle)),
        Err(TryLockError::WouldBlock) => Err(io::Error::other(
            "another run is writing to this folder; wait for it, or give another folder",
        )),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::write;

    #[test]
    fn a_claim_leaves_no_trace_but_what_was_written() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("a/b/c");
        let claim = Claim::folder(&folder).unwrap();
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
        drop(claim);
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
        let claim = Claim::file(&folder.join("x")).unwrap();
        write(&folder.join("x"), b"x").unwrap();
        drop(claim);
        assert!(folder.join("x").is_file());
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_has_one_claim_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let first = Claim::folder(folder.path()).unwrap();
        let message = Claim::folder(folder.path()).unwrap_err().to_string();
        assert!(message.contains("another run"), "{message}");
        assert!(
            message.contains(&*folder.path().to_string_lossy()),
            "{message}"
        );
        drop(first);
        Claim::folder(folder.path()).unwrap();
    }

    #[test]
    fn what_cannot_be_written_is_told_at_once() {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("file");
        write(&file, b"x").unwrap();
        Claim::folder(&file).unwrap_err();
        Claim::file(&file.join("below")).unwrap_err();
        let folder = Claim::file(place.path()).unwrap_err().to_string();
        assert!(folder.contains("it is a folder; name a file"), "{folder}");
    }
}
