//! glTF 1.0, told by its name from damaged glTF 2.0.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::super::{ParseError, Place};

#[derive(Deserialize)]
struct Outline {
    asset: Option<Asset>,
}

#[derive(Deserialize)]
struct Asset {
    version: Option<String>,
}

/// glTF 1.0 has its objects by name, glTF 2.0 by number.
#[derive(Deserialize)]
struct Named {
    meshes: BTreeMap<String, IgnoredAny>,
}

/// Why a document is refused that does not read as glTF 2.0.
pub(super) fn fault(json: &[u8], error: &serde_json::Error) -> ParseError {
    let malformed = |reason: String| ParseError::at(Place::Line(error.line()), reason);
    let Ok(outline) = serde_json::from_slice::<Outline>(json) else {
        return malformed(error.to_string());
    };
    let version = outline.asset.as_ref().and_then(|a| a.version.as_deref());
    let named = serde_json::from_slice::<Named>(json).is_ok_and(|n| !n.meshes.is_empty());
    if named || version.is_some_and(|v| v.starts_with("1.")) {
        return first_version();
    }
    match outline.asset {
        Some(_) => malformed(error.to_string()),
        None => malformed("this JSON has no `asset`, which glTF 2.0 must have".to_owned()),
    }
}

pub(super) fn first_version() -> ParseError {
    ParseError::Unsupported {
        feature: "version 1.0 of glTF".to_owned(),
        remedy: "export it as glTF 2.0, or convert it, for example with `gltf-pipeline -i old.gltf -o new.glb`",
    }
}
