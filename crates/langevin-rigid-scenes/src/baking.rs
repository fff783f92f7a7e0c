//! From a scene to its bake, made once and kept.

use std::path::{Path, PathBuf};

use langevin_rigid::{
    Bake, Body, Fluid, Settings, SetupError, Stepper, TurbulenceHistory, falling_speed,
};
use langevin_rigid_bake::added_mass::Warning;
use langevin_rigid_bake::body::{BodyBakeError, BodySpec, bake_body, could_be};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::ShapeError;
use langevin_rigid_bake::turbulence::{FlowOptions, TurbulenceError, turbulence_history};
use langevin_rigid_bake::{MeshError, TriMesh};
use sha2::{Digest, Sha256};

use crate::scene::{Geometry, Scene};
use langevin_rigid_formats::files;
use langevin_rigid_formats::mesh::{ReadError, read_mesh};

/// Why a scene could not be baked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneBakeError {
    /// The mesh file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The mesh is no body.
    #[error("{source_name}: {error}")]
    Mesh {
        /// The file.
        source_name: String,
        /// What is wrong with it.
        error: MeshError,
    },
    /// The shape is impossible.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The body is impossible, or its added mass could not be computed.
    #[error(transparent)]
    Body(#[from] BodyBakeError),
    /// The turbulence could not be computed.
    #[error(transparent)]
    Turbulence(#[from] TurbulenceError),
    /// Body and fluid have the same density and the body is at rest: the stream has no speed.
    #[error(
        "the body neither falls nor moves (its density is the fluid's), so its turbulence has no inflow speed; give `inflow_speed` under [turbulence]"
    )]
    NoSpeed,
}

/// The closed mesh of a scene's body, and what the reader of its file had to say (see
/// [`RawMesh::notices`](langevin_rigid_formats::mesh::RawMesh)).
///
/// # Errors
/// See [`SceneBakeError`].
pub fn mesh(scene: &Scene) -> Result<(TriMesh, Vec<String>), SceneBakeError> {
    match &scene.body.geometry {
        Geometry::Shape { shape, triangles } => Ok((shape.mesh(*triangles)?, Vec::new())),
        Geometry::Mesh {
            path,
            unit,
            thickness,
        } => {
            let mut raw = read_mesh(path, *unit)?;
            let notices = std::mem::take(&mut raw.notices);
            match thickness {
                Some(t) => raw.sheet(*t),
                None => raw.body(),
            }
            .map(|mesh| (mesh, notices))
            .map_err(|error| SceneBakeError::Mesh {
                source_name: path.display().to_string(),
                error,
            })
        }
    }
}

/// Whether the scene's turbulence source samples a precomputed history.
pub fn needs_history(scene: &Scene) -> bool {
    scene.settings.turbulence.needs_history()
}

/// A bake, and whether it had been made before.
#[derive(Debug, Clone)]
pub struct Baked {
    /// The bake.
    pub bake: Bake,
    /// What the reader of the mesh file had to say.
    pub notices: Vec<String>,
    /// Whether it came from the cache.
    pub cached: bool,
    /// Why it was not kept in the cache, if so; the bake is good all the same.
    pub cache_trouble: Option<String>,
}

/// Bakes a scene, or takes its bake from the folder `cache` if nothing that it depends on has
/// changed: mesh, choices and the code that bakes.
///
/// What is kept is not believed: its mass, shape and axes are computed again, and one that is damaged or does
/// not fit is baked anew with a notice.
///
/// # Errors
/// See [`SceneBakeError`]; trouble with the cache is none, it is reported in the result.
pub fn bake_scene(
    scene: &Scene,
    cache: Option<&Path>,
    progress: &dyn Progress,
) -> Result<Baked, SceneBakeError> {
    let (mesh, mut notices) = mesh(scene)?;
    let fingerprint = fingerprint(scene, &mesh);
    let place = cache.map(|folder| cache_file(folder, &fingerprint));
    let kept = place.as_deref().map(|p| from_cache(p, fingerprint));
    match kept {
        Some(Ok(Some(bake))) if could_be(&bake.body, &mesh, &scene.body.spec) => {
            return Ok(Baked {
                bake,
                notices,
                cached: true,
                cache_trouble: None,
            });
        }
        None | Some(Ok(None)) => {}
        Some(Err(reason)) => notices.push(distrusted(place.as_deref(), &reason)),
        Some(Ok(Some(_))) => notices.push(distrusted(
            place.as_deref(),
            "its numbers are not those of this body",
        )),
    }
    let mut bake = bake_mesh(&mesh, &scene.body.spec, progress)?;
    bake.fingerprint = fingerprint;
    if needs_history(scene) {
        bake.history = Some(history(scene, &bake.body, progress)?);
    }
    let cache_trouble = place.and_then(|p| files::write(&p, &bake.to_bytes()).err());
    let cache_trouble = cache_trouble.map(|e| format!("{e}; the bake was not kept"));
    Ok(Baked {
        bake,
        notices,
        cached: false,
        cache_trouble,
    })
}

fn distrusted(place: Option<&Path>, reason: &str) -> String {
    let place = place.unwrap_or(Path::new("")).display();
    format!("the kept bake `{place}` was not used ({reason}); the body was baked anew")
}

/// The bake of a mesh, of no scene: without a turbulence history, and with the fingerprint zero.
///
/// ```
/// use langevin_rigid_bake::body::BodySpec;
/// use langevin_rigid_bake::shapes::Shape;
/// use langevin_rigid_scenes::baking::bake_mesh;
/// let cube = Shape::Box { size: [0.1; 3] }.mesh(300)?;
/// let spec = BodySpec { mass: Some(0.6), ..BodySpec::default() };
/// let bake = bake_mesh(&cube, &spec, &())?;
/// assert!(bake.body.mass == 0.6 && bake.warnings.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BodyBakeError`].
pub fn bake_mesh(
    mesh: &TriMesh,
    spec: &BodySpec,
    progress: &dyn Progress,
) -> Result<Bake, BodyBakeError> {
    let (body, added_mass) = bake_body(mesh, spec, progress)?;
    // The small added mass along a thin sheet hardly matters to how it moves, whatever its accuracy.
    let matters = |w: &&Warning| !matches!(w, Warning::ThinnerThanTriangles { .. });
    let mut warnings: Vec<String> = added_mass
        .warnings
        .iter()
        .filter(matters)
        .map(ToString::to_string)
        .collect();
    if mesh.was_turned() {
        warnings.push("the mesh was inside out; its triangles were turned".into());
    }
    Ok(Bake {
        body,
        history: None,
        error_estimate: added_mass.error_estimate,
        warnings,
        fingerprint: [0; 32],
    })
}

/// The turbulence history of a scene's body.
///
/// # Errors
/// [`SceneBakeError::NoSpeed`] and [`SceneBakeError::Turbulence`].
pub fn history(
    scene: &Scene,
    body: &Body,
    progress: &dyn Progress,
) -> Result<TurbulenceHistory, SceneBakeError> {
    let speed = scene
        .grid
        .inflow_speed
        .unwrap_or_else(|| characteristic_speed(scene, body));
    if speed == 0.0 {
        return Err(SceneBakeError::NoSpeed);
    }
    let length = scene
        .settings
        .turbulence_length
        .unwrap_or_else(|| body.turbulence_length());
    let mut options = FlowOptions::new(scene.grid.cells, scene.grid.cell.unwrap_or(length), speed);
    options.sampling = scene.grid.sampling;
    options.time_step = scene.grid.time_step.unwrap_or(options.time_step);
    options.duration = scene.grid.duration.unwrap_or(options.duration);
    Ok(turbulence_history(&options, progress)?)
}

/// The larger of the falling speed U0, Eq. (1), and the release speed relative to the fluid (m/s).
pub fn characteristic_speed(scene: &Scene, body: &Body) -> f64 {
    falling_speed(body, &scene.fluid, scene.settings.gravity).max(scene.release_speed())
}

/// The settings of a scene with the speed of its release.
pub fn settings(scene: &Scene) -> Settings {
    Settings {
        release_speed: scene.release_speed(),
        ..scene.settings
    }
}

/// The stepper of a baked scene.
///
/// # Errors
/// See [`SetupError`].
pub fn stepper(scene: &Scene, bake: &Bake) -> Result<Stepper, SetupError> {
    let history = bake.history.as_ref();
    Stepper::new(&bake.body, &scene.fluid, history, &settings(scene))
}

/// The variable of the environment that names the folder where bakes are kept.
pub const CACHE_VARIABLE: &str = "LANGEVIN_RIGID_CACHE";

/// Where this computer keeps bakes: the folder that [`CACHE_VARIABLE`] names, or else that of the platform.
pub fn cache_folder() -> Option<PathBuf> {
    let named = std::env::var_os(CACHE_VARIABLE)
        .filter(|name| !name.is_empty())
        .map(PathBuf::from);
    named.or_else(|| Some(dirs::cache_dir()?.join("langevin-rigid")))
}

fn cache_file(folder: &Path, fingerprint: &[u8; 32]) -> PathBuf {
    let name: String = fingerprint[..16]
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect();
    folder.join(format!("{name}.lrbake"))
}

/// A cached bake that is whole and of the right fingerprint; none if there is no such file.
fn from_cache(place: &Path, fingerprint: [u8; 32]) -> Result<Option<Bake>, String> {
    let bytes = match files::read(place) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        bytes => bytes.map_err(|e| e.to_string())?,
    };
    let bake = Bake::from_bytes(&bytes).map_err(|e| e.to_string())?;
    match bake.fingerprint == fingerprint {
        true => Ok(Some(bake)),
        false => Err("it is of something else".into()),
    }
}

/// Hash of everything that a bake depends on: code and input.
fn fingerprint(scene: &Scene, mesh: &TriMesh) -> [u8; 32] {
    let mut hash = Sha256::new();
    for code in [
        "langevin-rigid",
        langevin_rigid::VERSION,
        env!("CARGO_PKG_VERSION"),
        langevin_rigid_bake::SOURCES,
    ] {
        hash.update(code);
        hash.update([0]);
    }
    for x in mesh.vertices().as_flattened() {
        hash.update(x.to_le_bytes());
    }
    for v in mesh.triangles().as_flattened() {
        hash.update(v.to_le_bytes());
    }
    // The debug form names every field and prints numbers so that they read back.
    hash.update(format!(
        "{:?} {} {}",
        scene.body.spec,
        mesh.is_smooth(),
        mesh.was_turned()
    ));
    if needs_history(scene) {
        let Fluid {
            density, velocity, ..
        } = scene.fluid;
        let Settings {
            gravity,
            turbulence_length,
            ..
        } = scene.settings;
        let released = scene.release.world_velocity();
        hash.update(format!(
            "{:?} {density} {velocity:?} {gravity:?} {turbulence_length:?} {released:?}",
            scene.grid
        ));
    }
    hash.finalize().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Scene {
        let text = r#"
            fluid.preset = "water"
            run = { time_step = 0.002, duration = 0.1 }
            body = { shape = "box", size = [0.1, 0.1, 0.1], triangles = 300, density = 700.0 }
        "#;
        Scene::parse("cube", "cube.toml", text).unwrap()
    }

    #[test]
    fn the_bake_of_a_mesh_is_that_of_a_scene_with_it() {
        let scene = cube();
        let (mesh, _) = mesh(&scene).unwrap();
        let alone = bake_mesh(&mesh, &scene.body.spec, &()).unwrap();
        let baked = bake_scene(&scene, None, &()).unwrap().bake;
        assert_ne!(baked.fingerprint, [0; 32]);
        let fingerprint = baked.fingerprint;
        assert_eq!(
            baked.to_bytes(),
            Bake {
                fingerprint,
                ..alone
            }
            .to_bytes()
        );
    }

    #[test]
    fn a_mesh_that_was_turned_is_told() {
        let scene = cube();
        let (mesh, _) = mesh(&scene).unwrap();
        let inside_out = mesh.triangles().iter().map(|[a, b, c]| [*a, *c, *b]);
        let turned = TriMesh::new(mesh.vertices().to_vec(), inside_out.collect()).unwrap();
        let bake = bake_mesh(&turned, &scene.body.spec, &()).unwrap();
        assert_eq!(
            bake.warnings,
            ["the mesh was inside out; its triangles were turned"]
        );
    }

    #[test]
    fn a_bake_that_could_not_be_kept_is_good_and_told() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let within_a_file = file.path().join("bakes");
        let baked = bake_scene(&cube(), Some(&within_a_file), &()).unwrap();
        assert!(!baked.cached && baked.bake.body.mass > 0.0);
        let trouble = baked.cache_trouble.unwrap();
        assert!(trouble.ends_with("the bake was not kept"), "{trouble}");
    }
}
