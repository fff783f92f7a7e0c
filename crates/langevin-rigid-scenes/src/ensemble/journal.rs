//! Falls that are kept as they end, so that an ensemble which is stopped or killed can go on.
//!
//! A journal begins with what it is of, and goes on with records: their length, a checksum and some falls. A record that was
//! cut off by the end of the process is told by its checksum, and overwritten.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use sha2::{Digest, Sha256};

use super::fall::Fall;
use crate::prepared::Prepared;
use crate::scene::WriteSceneError;

/// Its first bytes; the number is that of the layout.
const MAGIC: &[u8; 8] = b"LRFALLS1";
/// Bytes of a checksum that are kept.
const CHECKSUM: usize = 8;
/// Bytes before the falls of a record.
const HEAD: usize = 4 + CHECKSUM;

/// Falls on the disk, to which those that end are added.
///
/// ```
/// use langevin_rigid_scenes::ensemble::{self, Journal};
/// use langevin_rigid_scenes::{prepared::Prepared, scene::Scene};
/// let scene = Scene::parse("ball", "ball.toml", r#"
///     fluid.preset = "water"
///     run = { time_step = 0.002, duration = 0.1, model = "kirchhoff" }
///     scatter.velocity = 0.1
///     body = { shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }
/// "#)?;
/// let ball = Prepared::new(scene, None, &())?;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("falls.journal");
/// // A process does some of the runs, another the others.
/// ensemble::run_with(&ball, 0..3, &Journal::create(&path, &ball)?, &())?;
/// let falls = ensemble::run_with(&ball, 0..8, &Journal::open(&path, &ball)?, &())?;
/// assert_eq!(falls, ensemble::run(&ball, 0..8, &()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    kept: Vec<Fall>,
    file: Mutex<File>,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JournalError {
    /// There is one already, where a new one was to begin.
    #[error(
        "`{}` has {falls} falls of an ensemble that was stopped: go on with `--resume`, or remove the file to begin anew",
        path.display()
    )]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Falls in it.
        falls: usize,
    },
    /// It is of another ensemble.
    #[error(
        "`{}` has the falls of another scene, seed or version: choose another folder, or remove the file to begin anew",
        path.display()
    )]
    Other {
        /// The file.
        path: PathBuf,
    },
    /// It is no journal.
    #[error("`{}` is no journal of falls: choose another folder, or remove the file", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be read or written.
    #[error("cannot use `{}`: {error}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// The scene cannot be named.
    #[error(transparent)]
    Scene(#[from] WriteSceneError),
}

impl Journal {
    /// A new one, of the runs of `prepared`.
    ///
    /// # Errors
    /// [`JournalError`]; where there is a file already, it stays.
    pub fn create(path: &Path, prepared: &Prepared) -> Result<Self, JournalError> {
        let identity = identity(prepared)?;
        let failed = |error| JournalError::Io {
            path: path.to_owned(),
            error,
        };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        let mut file = match OpenOptions::new().write(true).create_new(true).open(path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                return Err(already_there(path));
            }
            file => file.map_err(failed)?,
        };
        let head = [MAGIC.as_slice(), &identity].concat();
        file.write_all(&head).map_err(failed)?;
        Ok(Self {
            path: path.to_owned(),
            kept: Vec::new(),
            file: Mutex::new(file),
        })
    }

    /// The one that is there, or a new one.
    ///
    /// # Errors
    /// [`JournalError`], also for one of another ensemble.
    pub fn open(path: &Path, prepared: &Prepared) -> Result<Self, JournalError> {
        let failed = |error| JournalError::Io {
            path: path.to_owned(),
            error,
        };
        let mut file = match OpenOptions::new().read(true).write(true).open(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Self::create(path, prepared);
            }
            file => file.map_err(failed)?,
        };
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed)?;
        let (identity_of_file, records) = split(path, &bytes)?;
        if identity_of_file != identity(prepared)? {
            return Err(JournalError::Other {
                path: path.to_owned(),
            });
        }
        let (kept, whole) = read(records);
        let end = (bytes.len() - records.len() + whole) as u64;
        file.set_len(end)
            .and_then(|()| file.seek(SeekFrom::Start(end)))
            .map_err(failed)?;
        Ok(Self {
            path: path.to_owned(),
            kept,
            file: Mutex::new(file),
        })
    }

    /// The falls that it had when it was opened.
    pub fn kept(&self) -> &[Fall] {
        &self.kept
    }

    /// Adds falls, all or none.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub(super) fn add(&self, falls: &[Fall]) -> Result<(), JournalError> {
        let failed = |error| JournalError::Io {
            path: self.path.clone(),
            error,
        };
        let bytes = postcard::to_stdvec(falls).map_err(|e| failed(io::Error::other(e)))?;
        let length = u32::try_from(bytes.len()).map_err(|e| failed(io::Error::other(e)))?;
        let record = [&length.to_le_bytes(), checksum(&bytes).as_slice(), &bytes].concat();
        let mut file = match self.file.lock() {
            Ok(file) => file,
            Err(poisoned) => poisoned.into_inner(),
        };
        file.write_all(&record).map_err(failed)
    }

    /// Ends it: the falls have found their place elsewhere.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn remove(self) -> Result<(), JournalError> {
        let Self { path, file, .. } = self;
        drop(file);
        std::fs::remove_file(&path).map_err(|error| JournalError::Io { path, error })
    }
}

fn already_there(path: &Path) -> JournalError {
    let path = path.to_owned();
    match std::fs::read(&path) {
        Err(error) => JournalError::Io { path, error },
        Ok(bytes) => match split(&path, &bytes) {
            Err(error) => error,
            Ok((_, records)) => JournalError::Unfinished {
                falls: read(records).0.len(),
                path,
            },
        },
    }
}

/// What a journal is of, and its records.
fn split<'a>(path: &Path, bytes: &'a [u8]) -> Result<([u8; 32], &'a [u8]), JournalError> {
    let parts = bytes
        .strip_prefix(MAGIC)
        .and_then(|rest| rest.split_first_chunk());
    parts
        .map(|(identity, records)| (*identity, records))
        .ok_or_else(|| JournalError::Damaged {
            path: path.to_owned(),
        })
}

/// The falls of the records that are whole, and how many bytes these take.
fn read(records: &[u8]) -> (Vec<Fall>, usize) {
    let mut falls = Vec::new();
    let mut rest = records;
    while let Some((some, after)) = record(rest) {
        falls.extend(some);
        rest = after;
    }
    (falls, records.len() - rest.len())
}

fn record(bytes: &[u8]) -> Option<(Vec<Fall>, &[u8])> {
    let (head, rest) = bytes.split_at_checked(HEAD)?;
    let (length, sum) = head.split_first_chunk()?;
    let (content, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
    if checksum(content) != sum {
        return None;
    }
    Some((postcard::from_bytes(content).ok()?, rest))
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let digest: [u8; 32] = Sha256::digest(bytes).into();
    std::array::from_fn(|i| digest[i])
}

/// Of all that decides about the falls: scene, body and code.
fn identity(prepared: &Prepared) -> Result<[u8; 32], JournalError> {
    let mut hash = Sha256::new();
    for text in [
        langevin_rigid::VERSION,
        env!("CARGO_PKG_VERSION"),
        langevin_rigid_bake::SOURCES,
        &prepared.scene().to_toml()?,
    ] {
        hash.update(text);
        hash.update([0]);
    }
    hash.update(prepared.baked().bake.fingerprint);
    Ok(hash.finalize().into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::{run, run_with};
    use crate::scene::Scene;

    fn ball(seed: u32) -> Prepared {
        let text = format!(
            "fluid.preset = \"water\"\nscatter = {{ velocity = 0.1, size = {{ uniform = [0.5, 2.0] }} }}\n\
             run = {{ time_step = 0.002, duration = 0.1, model = \"kirchhoff\", seed = {seed} }}\n\
             body = {{ shape = \"ellipsoid\", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }}"
        );
        Prepared::new(Scene::parse("ball", "ball.toml", &text).unwrap(), None, &()).unwrap()
    }

    #[test]
    fn a_journal_that_is_cut_anywhere_goes_on_to_the_same_bits() {
        let (ball, folder) = (ball(1), tempfile::tempdir().unwrap());
        let path = folder.path().join("deep/falls.journal");
        let all = run(&ball, 0..9, &());
        let journal = Journal::create(&path, &ball).unwrap();
        assert_eq!(run_with(&ball, 0..5, &journal, &()).unwrap(), all[..5]);
        let bytes = std::fs::read(&path).unwrap();
        let head = MAGIC.len() + 32;
        for length in (head..=bytes.len()).step_by(97).chain([bytes.len()]) {
            std::fs::write(&path, &bytes[..length]).unwrap();
            let journal = Journal::open(&path, &ball).unwrap();
            assert!(journal.kept().len() <= 5);
            assert_eq!(journal.kept().len() == 5, length == bytes.len());
            assert_eq!(run_with(&ball, 0..9, &journal, &()).unwrap(), all);
            let again = Journal::open(&path, &ball).unwrap();
            assert_eq!(again.kept().len(), 9);
            // Fewer runs than there are falls.
            assert_eq!(run_with(&ball, 2..4, &again, &()).unwrap(), all[2..4]);
        }
    }

    #[test]
    fn what_is_there_is_neither_overwritten_nor_mistaken() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("falls.journal");
        let (one, two) = (ball(1), ball(2));
        let journal = Journal::create(&path, &one).unwrap();
        run_with(&one, 0..3, &journal, &()).unwrap();
        let refused = Journal::create(&path, &one).unwrap_err();
        assert!(refused.to_string().contains("has 3 falls"), "{refused}");
        let other = Journal::open(&path, &two).unwrap_err();
        assert!(matches!(other, JournalError::Other { .. }), "{other}");
        journal.remove().unwrap();
        assert!(!path.exists());
        std::fs::write(&path, "run,t\n").unwrap();
        let damaged = [Journal::create(&path, &one), Journal::open(&path, &one)];
        for error in damaged.map(Result::unwrap_err) {
            assert!(matches!(error, JournalError::Damaged { .. }), "{error}");
        }
    }
}
