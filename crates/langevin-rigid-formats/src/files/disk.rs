//! Files on the disk.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use super::WriteError;
use super::temporary::Temporary;

/// What content of files is written to.
pub type Out = BufWriter<File>;

/// The bytes of a file.
///
/// # Errors
/// What the system says.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    std::fs::read(path)
}

/// A file to read from.
///
/// # Errors
/// What the system says.
pub fn open(path: &Path) -> io::Result<impl Read> {
    File::open(path)
}

/// [`write()`](super::write()) for what is better written as it comes than kept in memory.
///
/// # Errors
/// [`WriteError`], from the system or from `content`; whatever was at `path` is then still there.
pub fn write_with(
    path: &Path,
    content: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<(), WriteError> {
    let written = || match Target::of(path)? {
        Target::Stream => fill(OpenOptions::new().append(true).open(path)?, content).map(|_| ()),
        Target::File(file, old) => replace(&file, old.as_ref(), content),
    };
    written().map_err(WriteError::of(path))
}

fn replace(
    path: &Path,
    old: Option<&Metadata>,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let folder = folder_of(path);
    std::fs::create_dir_all(folder)?;
    let (temporary, file) = Temporary::new(folder)?;
    if let Some(old) = old {
        inherit(&file, old)?;
    }
    let file = fill(file, content)?;
    file.sync_all()?;
    temporary.persist(path)?;
    sync_folder(folder);
    Ok(())
}

/// Writes all of the content, and gives the file back.
fn fill(
    file: File,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<File> {
    let mut out = BufWriter::new(file);
    let written = content(&mut out).and_then(|()| out.flush());
    // What is still buffered after a failure is not tried again.
    let (file, _) = out.into_parts();
    written.map(|()| file)
}

/// What a path leads to.
pub(super) enum Target {
    /// A device or a pipe, which is written to as it is.
    Stream,
    /// A file, at the end of all links; what is known of it if it exists.
    File(PathBuf, Option<Metadata>),
}

impl Target {
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        let found = match std::fs::metadata(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                // A link may lead to a file that is still to be made.
                return match std::fs::read_link(path) {
                    Ok(target) => Self::of(&folder_of(path).join(target)),
                    Err(_) => Ok(Self::File(path.to_owned(), None)),
                };
            }
            found => found?,
        };
        if found.is_dir() {
            return Err(io::Error::new(
                ErrorKind::IsADirectory,
                "it is a folder; name a file",
            ));
        }
        if is_socket(&found) {
            return Err(io::Error::other("it is a socket; name a file"));
        }
        if !found.is_file() || is_descriptor(path) {
            return Ok(Self::Stream);
        }
        if found.permissions().readonly() {
            return Err(io::Error::new(
                ErrorKind::PermissionDenied,
                "it is write-protected; name another file, or allow writing to it",
            ));
        }
        Ok(Self::File(path.canonicalize()?, Some(found)))
    }
}

/// Whether a path names an open file of the process, such as `/dev/stdout`: another file in its place
/// would not be the one that is open.
fn is_descriptor(path: &Path) -> bool {
    const PLACES: [&str; 4] = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"];
    cfg!(unix) && PLACES.iter().any(|place| path.starts_with(place))
}

#[cfg(unix)]
fn is_socket(found: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    found.file_type().is_socket()
}

#[cfg(not(unix))]
fn is_socket(_: &Metadata) -> bool {
    false
}

/// Gives a new file the permissions of the one whose place it takes, and its owner where that is allowed.
#[cfg(unix)]
fn inherit(file: &File, old: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let _ = fchown(file, Some(old.uid()), Some(old.gid()));
    file.set_permissions(old.permissions())
}

#[cfg(not(unix))]
fn inherit(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

/// Makes the new name last through a loss of power, where the system can.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
}
