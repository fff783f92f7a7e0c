//! What a body looks like: meshes, materials and textures of a glTF file, which ride on it in animations.
//!
//! A body is baked from a closed surface, and a film wants another one: with leaf veins, colours and a texture.
//! [`Visual::read`] takes what the default scene of a `.glb` or `.gltf` file shows: its nodes, meshes, materials,
//! textures, UVs and vertex colours, with extensions of materials, textures and mesh compression as they are.
//! Animations, cameras and lights are left out, and skins are refused. An [export](crate::export) as GLB has it in
//! place of the surface.

mod gather;
mod image;
pub(crate) mod references;

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::files;
use crate::mesh::gltf;
use crate::mesh::{MeshFormat, ParseError};
pub(crate) use gather::{align, append};
use references::Lists;

/// What a body looks like.
///
/// A point of the file is drawn at `scale * point - centre_of_mass` in the frame of a body of scale one: where the
/// mesh lies that the body was baked from, if both are drawn in the same place.
///
/// ```
/// use langevin_rigid_formats::visual::Visual;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("leaf.gltf");
/// # std::fs::write(&path, r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
/// #     "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
/// #     "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
/// #     "bufferViews":[{"buffer":0,"byteLength":36}],
/// #     "buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#)?;
/// let mut leaf = Visual::read(&path)?;
/// leaf.centre_of_mass = [0.0, 0.0012, 0.03];
/// assert!(leaf.notices().is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    /// Metres to a unit of the file: one by the format, another where the mesh was read in another unit.
    pub scale: f64,
    /// The body's centre of mass in the frame of the mesh that it was baked from (m).
    pub centre_of_mass: [f64; 3],
    pub(crate) part: Part,
    notices: Vec<String>,
}

/// What is shown, as a document of its own with one buffer.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Part {
    /// The nodes of the scene that show something, children and meshes by their numbers here.
    pub(crate) nodes: Vec<Value>,
    /// Numbers of the nodes at the top.
    pub(crate) roots: Vec<usize>,
    /// What the nodes use.
    pub(crate) lists: Lists,
    /// Bytes of the buffer views.
    pub(crate) bytes: Vec<u8>,
    /// Bytes that the views compressed by meshoptimizer have once they are not.
    pub(crate) decompressed: usize,
    /// Extensions in use.
    pub(crate) used: BTreeSet<String>,
    /// Those of them without which it is not shown as it should be.
    pub(crate) required: BTreeSet<String>,
}

/// Why a visual cannot be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VisualError {
    /// The file cannot be read.
    #[error(
        "the visual `{}` cannot be read ({error}): check the path, which is relative to the current folder \
         unless it begins with /",
        path.display()
    )]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
    /// The file is of another format.
    #[error(
        "the visual `{}` is no glTF file: export it as .glb, which has materials and textures",
        path.display()
    )]
    NotGltf {
        /// Its path.
        path: PathBuf,
    },
    /// Something is wrong inside the file.
    #[error("in the visual `{}`: {error}", path.display())]
    Parse {
        /// Its path.
        path: PathBuf,
        /// What is wrong.
        error: ParseError,
    },
}

impl Visual {
    /// Reads a `.glb` or `.gltf` file; buffers and images of the latter may be in its folder and below.
    ///
    /// # Errors
    /// [`VisualError`], also for whatever is damaged: numbers of objects that are not there, nodes that are no tree,
    /// data cut short, images that are missing or of no known format.
    pub fn read(path: &Path) -> Result<Self, VisualError> {
        let bytes = files::read(path).map_err(|error| VisualError::Unreadable {
            path: path.into(),
            error,
        })?;
        if !matches!(
            MeshFormat::of_content(&bytes),
            Some(MeshFormat::Glb | MeshFormat::Gltf)
        ) {
            return Err(VisualError::NotGltf { path: path.into() });
        }
        // The parent of a bare file name is the empty path, which joins as it should.
        Self::parse(&bytes, path.parent()).map_err(|error| VisualError::Parse {
            path: path.into(),
            error,
        })
    }

    /// The visual in the bytes of a file, whose buffers and images are in `folder` or in the file itself.
    ///
    /// # Errors
    /// A [`ParseError`] with what is wrong.
    pub fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<Self, ParseError> {
        let (json, chunk) = match bytes.starts_with(b"glTF") {
            true => gltf::chunks(bytes)?,
            false => (bytes, None),
        };
        let roots = gltf::check(json, chunk, folder)?;
        let document: Value =
            serde_json::from_slice(json).map_err(|error| ParseError::damaged(error.to_string()))?;
        Ok(Self {
            scale: 1.0,
            centre_of_mass: [0.0; 3],
            part: gather::gather(&document, &roots, chunk, folder)?,
            notices: notices(&document),
        })
    }

    /// What was left out, a sentence each.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }
}

fn notices(document: &Value) -> Vec<String> {
    let has = |list: &Value| list.as_array().is_some_and(|list| !list.is_empty());
    let lights = &document["extensions"]["KHR_lights_punctual"]["lights"];
    [
        ("animations", &document["animations"]),
        ("cameras", &document["cameras"]),
        ("lights", lights),
    ]
    .into_iter()
    .filter(|(_, list)| has(list))
    .map(|(what, _)| format!("the {what} of the visual are left out"))
    .collect()
}

#[cfg(test)]
mod tests;
