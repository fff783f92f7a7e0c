//! Why a mesh file cannot be read.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Where in a file, as far as it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Line number, from 1.
    Line(usize),
    /// Byte offset, from 0.
    Byte(usize),
    /// Not known, or everywhere.
    File,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(n) => write!(f, "line {n}: "),
            Place::Byte(n) => write!(f, "byte {n}: "),
            Place::File => Ok(()),
        }
    }
}

/// What is wrong inside a mesh file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseError {
    /// The bytes do not follow the format.
    #[error("{place}{reason}; if the file is damaged, export it again")]
    Malformed {
        /// Where.
        place: Place,
        /// What is wrong.
        reason: String,
    },
    /// The file is sound but has no triangles or polygons.
    #[error(
        "there are no triangles in it: export the surface as polygons, not as points, lines or curves"
    )]
    NoTriangles,
    /// Neither the file nor whoever reads it says what its numbers measure.
    #[error(
        "the file does not state its unit of length: give `--unit` to a command, `unit` in a scene, or export glTF, which is in metres, or Collada, which states its unit"
    )]
    NoUnit,
    /// The file uses a part of the format that is not read.
    #[error("it uses {feature}, which is not supported: {remedy}")]
    Unsupported {
        /// The part.
        feature: String,
        /// What to do instead.
        remedy: &'static str,
    },
    /// A buffer outside a glTF file cannot be had.
    #[error(
        "its buffer `{uri}` cannot be read ({reason}): keep the file's buffers beside it, or export a single .glb file"
    )]
    Buffer {
        /// The buffer's address in the file, shortened.
        uri: String,
        /// Why not.
        reason: String,
    },
    /// An image of a glTF file cannot be had.
    #[error(
        "its image `{uri}` cannot be read ({reason}): keep the file's images beside it, or export a single .glb file"
    )]
    Image {
        /// The image's address in the file, shortened.
        uri: String,
        /// Why not.
        reason: String,
    },
}

impl ParseError {
    pub(crate) fn damaged(reason: impl Into<String>) -> ParseError {
        ParseError::at(Place::File, reason)
    }

    pub(super) fn at(place: Place, reason: impl Into<String>) -> ParseError {
        ParseError::Malformed {
            place,
            reason: reason.into(),
        }
    }
}

/// Why a mesh file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no such file.
    #[error("there is no mesh file `{}`: check the path, which is relative to the current folder unless it begins with /", path.display())]
    NotFound {
        /// Its path.
        path: PathBuf,
    },
    /// The file exists but cannot be read.
    #[error("the mesh file `{}` cannot be read: {source}", path.display())]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The path is that of a folder.
    #[error("`{}` is a folder: name the mesh file in it", path.display())]
    Folder {
        /// Its path.
        path: PathBuf,
    },
    /// The file is of a format that is not read.
    #[error("`{}` is {what}, which is not read: {remedy}", path.display())]
    Foreign {
        /// Its path.
        path: PathBuf,
        /// What it is.
        what: &'static str,
        /// How to come by a mesh that is read.
        remedy: &'static str,
    },
    /// Neither the content nor the extension is that of a known format.
    #[error("`{}` is of no known mesh format: known are .obj, .stl, .ply, .gltf, .glb and .dae", path.display())]
    UnknownFormat {
        /// Its path.
        path: PathBuf,
    },
    /// Something is wrong inside the file.
    #[error("in the mesh file `{}`: {error}", path.display())]
    Parse {
        /// Its path.
        path: PathBuf,
        /// What is wrong, and where.
        error: ParseError,
    },
}

impl ReadError {
    pub(super) fn of_file(path: &Path, source: io::Error) -> ReadError {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::NotFound => ReadError::NotFound { path },
            _ => ReadError::Unreadable { path, source },
        }
    }
}
