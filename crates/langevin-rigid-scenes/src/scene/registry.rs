//! The built-in scenes and how a scene is found.

use std::convert::Infallible;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use langevin_rigid::{UnknownName, choose};
use langevin_rigid_formats::files;

use super::{Geometry, ObstacleGeometry, Scene, SceneError, SceneField};

/// A scene that is part of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuiltIn {
    /// Its name.
    pub name: &'static str,
    /// Its TOML.
    pub text: &'static str,
}

macro_rules! built_in {
    ($($name:literal),* $(,)?) => {
        &[$(BuiltIn {
            name: $name,
            text: include_str!(concat!("../../scenes/", $name, ".toml")),
        }),*]
    };
}

/// All built-in scenes, in the order they are listed.
pub const BUILT_IN: &[BuiltIn] = built_in![
    "leaf",
    "maple-seed",
    "feather",
    "paper-75",
    "paper-30",
    "airplane",
    "ellipsoid-water",
    "coin",
    "bubble",
    "business-card",
    "autumn",
    "fan",
    "leaves",
    "pond",
    "coin-toss",
    "ball-up",
    "direct-leaf",
    "sheet-a6",
    "table2-ellipsoid-320-1ms",
    "table2-ellipsoid-320-5ms",
    "table2-ellipsoid-320-10ms",
    "table2-ellipsoid-1280-5ms",
    "table2-paper-5ms",
    "table2-airplane-5ms",
];

impl BuiltIn {
    /// Its text as that of any scene.
    pub fn source(&self) -> Source {
        Source {
            name: self.name.to_owned(),
            file: format!("{}.toml (built in)", self.name),
            text: self.text.to_owned(),
            folder: None,
        }
    }

    /// The scene, read and checked.
    ///
    /// # Errors
    /// None, as a test makes sure of for each.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        self.source().scene()
    }
}

/// The longest scene file (bytes): far more than any needs.
const LONGEST: u64 = 1 << 20;

/// Why a scene could not be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FindError {
    /// Neither a built-in scene nor a file.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error("cannot read the scene `{file}`: {error}")]
    Read {
        /// The file.
        file: String,
        /// What the system said.
        error: std::io::Error,
    },
    /// The file is longer than scenes are.
    #[error("`{file}` is longer than a scene file may be (1 MiB): is it another file?")]
    TooLong {
        /// The file.
        file: String,
    },
    /// The file is no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The text of a scene, and what it takes to read it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Name of the scene.
    pub name: String,
    /// Where messages say that it stands.
    pub file: String,
    /// Its TOML.
    pub text: String,
    /// The folder that the paths in it start from; the current one if none.
    pub folder: Option<PathBuf>,
}

impl Source {
    /// That of the built-in scene of a name, or else of the scene file at that path.
    ///
    /// # Errors
    /// See [`FindError`].
    pub fn find(name: &str) -> Result<Self, FindError> {
        let path = Path::new(name);
        let built_in = BUILT_IN.iter().map(|scene| (scene.name, scene));
        match choose("built-in scene or file", name, built_in) {
            Ok(scene) => return Ok(scene.source()),
            Err(unknown) if !path.exists() => return Err(unknown.into()),
            Err(_) => {}
        }
        let text = read(path).map_err(|error| FindError::Read {
            file: name.to_owned(),
            error,
        })?;
        if text.len() as u64 > LONGEST {
            return Err(FindError::TooLong {
                file: name.to_owned(),
            });
        }
        let stem = path
            .file_stem()
            .map_or_else(|| name.into(), |s| s.to_string_lossy());
        Ok(Self {
            name: stem.into_owned(),
            file: name.to_owned(),
            text,
            folder: path.parent().map(Path::to_owned),
        })
    }

    /// The scene, read and checked. The paths in it become relative to the current folder.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let mut scene = Scene::parse(&self.name, &self.file, &self.text)?;
        if let Some(folder) = &self.folder {
            let Ok(()) = scene.relocate(|path| Ok::<_, Infallible>(folder.join(path)));
        }
        Ok(scene)
    }
}

/// Opens the built-in scene of that name, or else the scene file at that path.
///
/// The paths in a file (meshes, looks, winds, other scenes) become relative to the current folder.
///
/// # Errors
/// See [`FindError`].
pub fn find(name: &str) -> Result<Scene, FindError> {
    Ok(Source::find(name)?.scene()?)
}

impl Scene {
    /// Gives the files that it names other paths: meshes, looks, winds, drawn paths, other scenes.
    ///
    /// # Errors
    /// Those of `place`, which makes a path out of one.
    pub fn relocate<E>(&mut self, place: impl Fn(&Path) -> Result<PathBuf, E>) -> Result<(), E> {
        let meshes = match &mut self.body.geometry {
            Geometry::Mesh { path, .. } => Some(path),
            Geometry::Shape { .. } => None,
        };
        let looks = self.body.visual.as_mut();
        let obstacles = self.obstacles.iter_mut();
        let obstacles = obstacles.filter_map(|obstacle| match &mut obstacle.geometry {
            ObstacleGeometry::Mesh { path, .. } => Some(path),
            _ => None,
        });
        let winds = self
            .wind
            .iter_mut()
            .filter_map(|part| match &mut part.field {
                SceneField::Table { path } => Some(path),
                _ => None,
            });
        let drawn = self.direct.as_mut().and_then(|direct| direct.path.as_mut());
        let paths = meshes
            .into_iter()
            .chain(looks)
            .chain(obstacles)
            .chain(winds);
        for path in paths.chain(drawn.map(|path| &mut path.file)) {
            *path = place(path)?;
        }
        for kind in self.crowd.iter_mut().flat_map(|crowd| &mut crowd.kinds) {
            if !BUILT_IN.iter().any(|scene| scene.name == kind.scene) {
                kind.scene = place(Path::new(&kind.scene))?.display().to_string();
            }
        }
        Ok(())
    }
}

/// The text of a file, no more than it takes to see that it is too long.
fn read(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    files::open(path)?
        .take(LONGEST + 1)
        .read_to_string(&mut text)?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_scene_reads_and_says_what_it_shows() {
        for built_in in BUILT_IN {
            let scene = built_in.scene().unwrap_or_else(|e| panic!("{e}"));
            assert!(!scene.description.is_empty(), "{}", scene.name);
        }
    }

    #[test]
    fn resolved_scenes_read_back_as_themselves() {
        for built_in in BUILT_IN {
            let scene = built_in.scene().unwrap();
            let text = scene.to_toml().unwrap();
            let again = Scene::parse(&scene.name, "resolved", &text).unwrap();
            assert_eq!(again, scene, "{text}");
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let message = find("paper-76").unwrap_err().to_string();
        assert!(
            message.contains("paper-76") && message.contains("did you mean `paper-75`?"),
            "{message}"
        );
    }
}
