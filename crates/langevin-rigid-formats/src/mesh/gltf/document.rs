//! The part of a glTF document that holds geometry.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::super::{ParseError, Place};
use super::version;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub(super) asset: Asset,
    pub(super) scene: Option<usize>,
    #[serde(default)]
    pub(super) scenes: Vec<Scene>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) skins: Vec<Skin>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub(super) buffers: Vec<Buffer>,
    #[serde(default)]
    pub(super) extensions_required: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Asset {
    pub(super) version: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

/// What most nodes lack is boxed: a node can be two letters of the file.
#[derive(Debug, Deserialize)]
pub(super) struct Node {
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    /// Of the morph targets, in place of the mesh's.
    pub(super) weights: Option<Box<[f64]>>,
    #[serde(default)]
    pub(super) children: Box<[usize]>,
    /// Column-major.
    pub(super) matrix: Option<Box<[f64; 16]>>,
    pub(super) translation: Option<Box<[f64; 3]>>,
    /// Unit quaternion x, y, z, w.
    pub(super) rotation: Option<Box<[f64; 4]>>,
    pub(super) scale: Option<Box<[f64; 3]>>,
    pub(super) extensions: Option<Box<NodeExtensions>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<Instancing>,
}

/// Accessors of the instances' TRANSLATION, ROTATION and SCALE.
#[derive(Debug, Deserialize)]
pub(super) struct Instancing {
    pub(super) attributes: BTreeMap<String, usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
    /// Of the morph targets, where the node has none.
    #[serde(default)]
    pub(super) weights: Box<[f64]>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    pub(super) inverse_bind_matrices: Option<usize>,
    pub(super) joints: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: BTreeMap<String, usize>,
    pub(super) indices: Option<usize>,
    #[serde(default = "triangle_list")]
    pub(super) mode: u32,
    #[serde(default)]
    pub(super) targets: Vec<MorphTarget>,
    pub(super) extensions: Option<Box<PrimitiveExtensions>>,
}

fn triangle_list() -> u32 {
    4
}

#[derive(Debug, Deserialize)]
pub(super) struct MorphTarget {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    draco: Option<Draco>,
}

impl Primitive {
    pub(super) fn draco(&self) -> Option<&Draco> {
        self.extensions.as_ref()?.draco.as_ref()
    }
}

/// A compressed primitive: the number of each attribute in the compressed data.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Draco {
    pub(super) buffer_view: usize,
    pub(super) attributes: BTreeMap<String, u32>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<Box<Sparse>>,
}

/// Items of an accessor that differ from those in its buffer view.
#[derive(Debug, Deserialize)]
pub(super) struct Sparse {
    pub(super) count: usize,
    pub(super) indices: SparseIndices,
    pub(super) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
    pub(super) extensions: Option<Box<ViewExtensions>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct ViewExtensions {
    #[serde(rename = "KHR_meshopt_compression")]
    khr_meshopt: Option<Meshopt>,
    #[serde(rename = "EXT_meshopt_compression")]
    ext_meshopt: Option<Meshopt>,
}

impl BufferView {
    pub(super) fn meshopt(&self) -> Option<&Meshopt> {
        let extensions = self.extensions.as_ref()?;
        let ratified = extensions.khr_meshopt.as_ref();
        ratified.or(extensions.ext_meshopt.as_ref())
    }
}

/// Where the compressed bytes of a buffer view are, and what they hold.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Meshopt {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: usize,
    pub(super) count: usize,
    #[cfg(feature = "meshopt")]
    pub(super) mode: String,
    #[cfg(feature = "meshopt")]
    pub(super) filter: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}

/// Extensions that are read.
const READ: [&str; 5] = [
    "KHR_mesh_quantization",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "EXT_mesh_gpu_instancing",
];

/// Extensions that may be required and still leave the geometry as it is.
const HARMLESS: [&str; 6] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_animation_",
    "EXT_texture_",
    "EXT_lights_",
];

impl Document {
    /// Checks the version, and that no other extension is needed to find the geometry.
    pub(super) fn check(&self) -> Result<(), ParseError> {
        if self.asset.version.starts_with("1.") {
            return Err(version::first_version());
        }
        if !self.asset.version.starts_with("2.") {
            return Err(ParseError::Unsupported {
                feature: format!("version {} of glTF", self.asset.version),
                remedy: "export glTF 2.0",
            });
        }
        let known = |name: &str| {
            READ.contains(&name) || HARMLESS.iter().any(|start| name.starts_with(start))
        };
        match self.extensions_required.iter().find(|name| !known(name)) {
            None => Ok(()),
            Some(name) => Err(ParseError::Unsupported {
                feature: format!("the extension {name}"),
                remedy: "export it without this extension",
            }),
        }
    }

    /// The nodes at the top of the default scene; without scenes, those no other node holds.
    pub(super) fn roots(&self) -> Result<Vec<usize>, ParseError> {
        if let Some(scene) = self.scenes.get(self.scene.unwrap_or(0)) {
            return Ok(scene.nodes.clone());
        }
        match self.scene {
            Some(scene) => Err(ParseError::at(
                Place::File,
                format!("there is no scene {scene}"),
            )),
            None => Ok(self.tops()),
        }
    }

    /// The nodes that no other node holds.
    pub(super) fn tops(&self) -> Vec<usize> {
        let mut is_child = vec![false; self.nodes.len()];
        for &child in self.nodes.iter().flat_map(|node| &node.children) {
            if let Some(flag) = is_child.get_mut(child) {
                *flag = true;
            }
        }
        (0..self.nodes.len()).filter(|&n| !is_child[n]).collect()
    }
}
