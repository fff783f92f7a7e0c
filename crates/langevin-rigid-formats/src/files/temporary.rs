//! Temporary files, none of which is left behind.

use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tempfile::TempPath;

const PREFIX: &str = ".langevin-rigid-";

/// A temporary file this young may be between its making and its locking.
const YOUNG: Duration = Duration::from_secs(60);
/// One this old is left over, even where the system has no locks to tell.
const OLD: Duration = Duration::from_secs(24 * 60 * 60);

/// What of this process is on the disk and is no result.
static OURS: Mutex<Ours> = Mutex::new(Ours {
    files: BTreeSet::new(),
    folders: Vec::new(),
    swept: BTreeSet::new(),
});

pub(super) struct Ours {
    files: BTreeSet<PathBuf>,
    /// Folders that were made for results, outer ones first.
    pub(super) folders: Vec<PathBuf>,
    /// Folders that were searched for what ended processes left.
    swept: BTreeSet<PathBuf>,
}

pub(super) fn ours() -> MutexGuard<'static, Ours> {
    OURS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of this process and the folders it made that are empty, and holds up
/// whoever would make more: for a process that is about to end while others of its threads write.
pub fn abandon() {
    let ours = ours();
    for file in &ours.files {
        let _ = std::fs::remove_file(file);
    }
    remove_empty(&ours.folders);
    std::mem::forget(ours);
}

/// Removes those of the folders that are empty, inner ones first.
pub(super) fn remove_empty(folders: &[PathBuf]) {
    for folder in folders.iter().rev() {
        let _ = std::fs::remove_dir(folder);
    }
}

/// A file that is removed unless it takes the place of another.
pub(super) struct Temporary(Option<TempPath>);

impl Temporary {
    /// A new file in `folder`, with the permissions of any new file.
    ///
    /// It stays locked until it is closed, which tells later processes that it is in use.
    pub(super) fn new(folder: &Path) -> io::Result<(Self, File)> {
        let mut ours = ours();
        if ours.swept.insert(folder.to_owned()) {
            sweep(folder);
        }
        let (file, path) = builder().tempfile_in(folder)?.into_parts();
        let _ = file.try_lock();
        ours.files.insert(path.to_path_buf());
        Ok((Self(Some(path)), file))
    }

    /// Puts it in the place of `path`.
    pub(super) fn persist(mut self, path: &Path) -> io::Result<()> {
        let mut ours = ours();
        let Some(temporary) = self.0.take() else {
            return Ok(());
        };
        ours.files.remove(&*temporary);
        temporary.persist(path).map_err(|e| e.error)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut ours = ours();
            ours.files.remove(&*path);
            let _ = path.close();
        }
    }
}

#[cfg(unix)]
fn builder() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = tempfile::Builder::new();
    // The mask of the process takes its share of them.
    builder
        .prefix(PREFIX)
        .permissions(std::fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    builder
}

/// Removes temporary files whose process has ended.
fn sweep(folder: &Path) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let ours = entries.filter(|e| e.file_name().to_string_lossy().starts_with(PREFIX));
    for entry in ours {
        if is_left_over(&entry.path()).unwrap_or(false) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

fn is_left_over(path: &Path) -> io::Result<bool> {
    let found = std::fs::symlink_metadata(path)?;
    let age = found.modified()?.elapsed().unwrap_or_default();
    if !found.is_file() || age < YOUNG {
        return Ok(false);
    }
    let file = File::options().write(true).open(path)?;
    Ok(match file.try_lock() {
        Ok(()) => true,
        Err(std::fs::TryLockError::WouldBlock) => false,
        Err(std::fs::TryLockError::Error(_)) => age > OLD,
    })
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

    use super::*;

    fn leave(folder: &Path, name: &str, age: Duration) -> File {
        let file = File::create(folder.join(name)).unwrap();
        file.set_modified(SystemTime::now() - age).unwrap();
        file
    }

    #[test]
    fn only_what_ended_processes_left_is_swept() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let in_use = leave(folder, ".langevin-rigid-used", 2 * OLD);
        in_use.try_lock().unwrap();
        drop(leave(folder, ".langevin-rigid-young", YOUNG / 2));
        drop(leave(folder, ".langevin-rigid-left", 2 * YOUNG));
        drop(leave(folder, "another.csv", 2 * OLD));
        std::fs::create_dir(folder.join(".langevin-rigid-folder")).unwrap();
        let (temporary, _) = Temporary::new(folder).unwrap();
        drop(temporary);
        let mut names: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        let expected = [
            ".langevin-rigid-folder",
            ".langevin-rigid-used",
            ".langevin-rigid-young",
            "another.csv",
        ];
        assert_eq!(names, expected);
    }
}
