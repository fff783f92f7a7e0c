//! Writing files whole or not at all.
//!
//! A page in a browser has no files: there, those that are read are those that were written before, in its memory.

#[cfg(not(target_arch = "wasm32"))]
mod claim;
#[cfg(not(target_arch = "wasm32"))]
mod disk;
#[cfg(target_arch = "wasm32")]
mod memory;
#[cfg(not(target_arch = "wasm32"))]
mod temporary;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
pub use claim::Claim;
#[cfg(not(target_arch = "wasm32"))]
pub use disk::{Out, open, read, write_with};
#[cfg(target_arch = "wasm32")]
pub use memory::{Out, open, read, take, write_with};
#[cfg(not(target_arch = "wasm32"))]
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
