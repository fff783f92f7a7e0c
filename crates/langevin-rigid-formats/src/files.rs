//! Writing files whole or not at all.

mod claim;
mod temporary;

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

pub use claim::Claim;
use temporary::Temporary;
pub use temporary::abandon;

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write `{}`: {error}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the system said.
    pub error: std::io::Error,
}

impl WriteError {
    fn of(path: &Path) -> impl Fn(io::Error) -> Self {
        move |error| Self {
            path: path.to_owned(),
            error,
        }
    }
}

/// Writes `bytes` to `path`, making its folder where there is none.
///
/// The bytes go to a temporary file in the same folder that takes the place of `path` when it is complete and
/// on the disk, so that nobody ever sees half a file. A file that is replaced hands on its permissions, a new
/// one has those of any new file. Where `path` is a link its target is written. Devices and pipes are written
/// to as they are.
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
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
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
enum Target {
    /// A device or a pipe, which is written to as it is.
    Stream,
    /// A file, at the end of all links; what is known of it if it exists.
    File(PathBuf, Option<Metadata>),
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
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

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
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

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

        use super::*;

        #[test]
        fn permissions_stay_and_links_lead_on() {
            let folder = tempfile::tempdir().unwrap();
            let [file, link, new, dangling] =
                ["file", "link", "new", "dangling"].map(|n| folder.path().join(n));
            write(&file, b"old").unwrap();
            std::fs::set_permissions(&file, PermissionsExt::from_mode(0o640)).unwrap();
            symlink("file", &link).unwrap();
            symlink("new", &dangling).unwrap();
            write(&link, b"changed").unwrap();
            write(&dangling, b"made").unwrap();
            assert_eq!(std::fs::read(&file).unwrap(), b"changed");
            assert_eq!(std::fs::read(&new).unwrap(), b"made");
            let mode = std::fs::metadata(&file).unwrap().permissions().mode();
            assert_eq!(mode & 0o7777, 0o640);
            for link in [link, dangling] {
                assert!(std::fs::symlink_metadata(link).unwrap().is_symlink());
            }
        }

        #[test]
        fn devices_are_written_to_and_never_replaced() {
            let null = Path::new("/dev/null");
            write(null, b"gone").unwrap();
            let kind = std::fs::symlink_metadata(null).unwrap().file_type();
            assert!(kind.is_char_device());
            if Path::new("/dev/full").exists() {
                let message = write(Path::new("/dev/full"), b"x").unwrap_err().to_string();
                assert!(message.starts_with("cannot write `/dev/full`"), "{message}");
            }
        }

        #[test]
        fn sockets_and_protected_files_are_refused() {
            let folder = tempfile::tempdir().unwrap();
            let [socket, protected] = ["socket", "protected"].map(|n| folder.path().join(n));
            let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
            let message = write(&socket, b"x").unwrap_err().to_string();
            assert!(message.contains("it is a socket"), "{message}");
            write(&protected, b"kept").unwrap();
            std::fs::set_permissions(&protected, PermissionsExt::from_mode(0o444)).unwrap();
            let message = write(&protected, b"x").unwrap_err().to_string();
            assert!(message.contains("write-protected"), "{message}");
            assert_eq!(std::fs::read(&protected).unwrap(), b"kept");
        }
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
