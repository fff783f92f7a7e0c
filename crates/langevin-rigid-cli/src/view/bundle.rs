//! A scene with all the files that it names, under names without folders.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use langevin_rigid_formats::mesh::MeshFormat;
use langevin_rigid_scenes::scene::{self, BUILT_IN, CrowdKind, Scene};
use serde_json::Value;

#[derive(Default)]
pub(super) struct Bundle {
    /// Names and contents.
    pub(super) files: Vec<(String, Vec<u8>)>,
    taken: HashSet<String>,
    /// The names of files that were at these paths.
    names: HashMap<PathBuf, String>,
    /// Where the scenes of these names really are.
    scenes: HashMap<String, PathBuf>,
}

impl Bundle {
    /// Adds what a scene names, and gives its TOML with the names here.
    pub(super) fn add(&mut self, mut scene: Scene) -> Result<String> {
        for kind in scene.crowd.iter().flat_map(|crowd| &crowd.kinds) {
            if !BUILT_IN.iter().any(|built_in| built_in.name == kind.scene) {
                self.add_kind(kind)?;
            }
        }
        let bundle = RefCell::new(self);
        scene.relocate(|path| bundle.borrow_mut().place(path))?;
        Ok(scene.to_toml()?)
    }

    /// A scene of the crowd keeps its name: winds and the table of bodies have it.
    fn add_kind(&mut self, kind: &CrowdKind) -> Result<()> {
        let path = Path::new(&kind.scene);
        let scene = scene::find(&kind.scene)?;
        let name = format!("{}.toml", kind.name());
        let real = path.canonicalize()?;
        self.names.insert(path.to_owned(), name.clone());
        // Scenes may name each other.
        if self.scenes.get(&name) == Some(&real) {
            return Ok(());
        }
        self.claim(&name)?;
        self.scenes.insert(name.clone(), real);
        let toml = self.add(scene)?;
        self.files.push((name, toml.into_bytes()));
        Ok(())
    }

    /// The name of the file at a path.
    fn place(&mut self, path: &Path) -> Result<PathBuf> {
        if let Some(name) = self.names.get(path) {
            return Ok(name.into());
        }
        let bytes = std::fs::read(path)
            .with_context(|| format!("cannot read `{}`, which the scene names", path.display()))?;
        if let Some(other) = other_file(&bytes) {
            bail!(
                "`{}` has a part of it in another file, `{other}`: save it as .glb with everything in it",
                path.display()
            );
        }
        let name = format!("{}-{}", self.files.len(), plain_name(path));
        self.claim(&name)?;
        self.names.insert(path.to_owned(), name.clone());
        self.files.push((name.clone(), bytes));
        Ok(name.into())
    }

    fn claim(&mut self, name: &str) -> Result<()> {
        if !self.taken.insert(name.to_owned()) {
            bail!("the scene has two files that would both be `{name}` in the page: rename one");
        }
        Ok(())
    }
}

/// A file's name with the characters that mean nothing in addresses.
fn plain_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    name.chars()
        .map(|c| if plain(c) { c } else { '-' })
        .collect()
}

/// The first file that a glTF file has its buffers or images in, beside itself.
fn other_file(bytes: &[u8]) -> Option<String> {
    let json = match MeshFormat::of_content(bytes)? {
        MeshFormat::Gltf => bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
        MeshFormat::Glb => {
            let length = u32::from_le_bytes(bytes.get(12..16)?.try_into().ok()?);
            bytes.get(20..)?.get(..length as usize)?
        }
        _ => return None,
    };
    let document: Value = serde_json::from_slice(json).ok()?;
    let lists = ["buffers", "images"].map(|list| document[list].as_array());
    let members = lists.into_iter().flatten().flatten();
    let mut addresses = members.filter_map(|member| member["uri"].as_str());
    addresses
        .find(|address| !address.starts_with("data:"))
        .map(str::to_owned)
}
