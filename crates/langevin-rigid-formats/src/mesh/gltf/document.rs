//! The part of a glTF document that holds geometry.

use serde::Deserialize;

use super::super::{ParseError, Place};

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

#[derive(Debug, Deserialize)]
pub(super) struct Node {
    pub(super) mesh: Option<usize>,
    #[serde(default)]
    pub(super) children: Vec<usize>,
    /// Column-major.
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    /// Unit quaternion x, y, z, w.
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    #[serde(default = "triangle_list")]
    pub(super) mode: u32,
}

fn triangle_list() -> u32 {
    4
}

#[derive(Debug, Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}

impl Document {
    /// Checks the version, and that no extension is needed to find the geometry.
    pub(super) fn check(&self) -> Result<(), ParseError> {
        if !self.asset.version.starts_with("2.") {
            let feature = format!("version {} of glTF", self.asset.version);
            return Err(ParseError::Unsupported {
                feature,
                remedy: "export glTF 2.0",
            });
        }
        // Materials and lights may be required and still leave the geometry as it is.
        let harmless = |name: &&String| {
            [
                "KHR_materials_",
                "KHR_texture_",
                "KHR_lights_",
                "EXT_texture_",
            ]
            .iter()
            .any(|p| name.starts_with(p))
        };
        match self.extensions_required.iter().find(|name| !harmless(name)) {
            None => Ok(()),
            Some(name) => Err(ParseError::Unsupported {
                feature: format!("the extension {name}"),
                remedy: "export it without compression or extensions",
            }),
        }
    }

    /// The nodes at the top of the default scene; without scenes, those no other node holds.
    pub(super) fn roots(&self) -> Result<Vec<usize>, ParseError> {
        if let Some(scene) = self.scenes.get(self.scene.unwrap_or(0)) {
            return Ok(scene.nodes.clone());
        }
        if let Some(scene) = self.scene {
            return Err(ParseError::at(
                Place::File,
                format!("there is no scene {scene}"),
            ));
        }
        let mut is_child = vec![false; self.nodes.len()];
        for child in self.nodes.iter().flat_map(|node| &node.children) {
            if let Some(flag) = is_child.get_mut(*child) {
                *flag = true;
            }
        }
        Ok((0..self.nodes.len()).filter(|&n| !is_child[n]).collect())
    }
}
