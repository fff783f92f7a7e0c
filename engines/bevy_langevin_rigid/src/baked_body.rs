//! Baked bodies as assets.

use bevy_asset::io::Reader;
use bevy_asset::{Asset, AssetLoader, LoadContext};
use bevy_reflect::TypePath;
use langevin_rigid::{Bake, BakeError, Body};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::Warning;
use langevin_rigid_bake::body::{BodyBakeError, BodySpec, bake_body, mass_properties};
use serde::{Deserialize, Serialize};

/// A body with all that depends on its shape alone; what `langevin-rigid bake` writes.
///
/// The library makes plates, discs, ellipsoids, cylinders and boxes itself:
///
/// ```
/// use bevy_langevin_rigid::BakedBody;
/// use bevy_langevin_rigid::langevin_rigid::Body;
/// // A leaf of 8 cm by 5 cm, 0.2 mm thick, 450 kg/m^3.
/// let leaf = BakedBody::from(Body::plate(0.08, 0.05, 0.2e-3, 450.0)?);
/// # Ok::<(), bevy_langevin_rigid::langevin_rigid::BodyError>(())
/// ```
#[derive(Asset, TypePath, Debug, Clone, PartialEq)]
pub struct BakedBody {
    /// The body, its origin at its centre of mass.
    pub bake: Bake,
    /// Where the centre of mass is in the frame of the mesh that is drawn (m).
    pub centre_of_mass: [f64; 3],
}

impl BakedBody {
    /// Bakes the solid within a mesh, with what the bake warns of: for what [`Immersed::solid`](crate::Immersed::solid) cannot
    /// say, such as where the centre of mass is. Takes seconds for a fine mesh.
    ///
    /// ```
    /// use bevy_langevin_rigid::BakedBody;
    /// use bevy_langevin_rigid::langevin_rigid_bake::{body::BodySpec, shapes::Shape};
    /// // A ball of 10 g that is heavier below.
    /// let ball = Shape::Ellipsoid { semi_axes: [0.05; 3] }.mesh(500)?;
    /// let spec = BodySpec { mass: Some(0.01), centre_of_mass: Some([0.0, -0.02, 0.0]), ..BodySpec::default() };
    /// let (body, _warnings) = BakedBody::bake(&ball, &spec)?;
    /// assert_eq!(body.centre_of_mass, [0.0, -0.02, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`BodyBakeError`]: no mass, numbers that are none, a mesh that is no solid.
    pub fn bake(mesh: &TriMesh, spec: &BodySpec) -> Result<(Self, Vec<Warning>), BodyBakeError> {
        let centre_of_mass = mass_properties(mesh, spec)?.centre_of_mass;
        let (body, added_mass) = bake_body(mesh, spec, &())?;
        let warnings = added_mass.warnings.iter().map(ToString::to_string);
        let body = Self {
            bake: Bake {
                error_estimate: added_mass.error_estimate,
                warnings: warnings.collect(),
                ..Self::from(body).bake
            },
            centre_of_mass,
        };
        Ok((body, added_mass.warnings))
    }
}

impl From<Bake> for BakedBody {
    /// Drawn with its centre of mass at the origin of the mesh.
    fn from(bake: Bake) -> Self {
        Self {
            bake,
            centre_of_mass: [0.0; 3],
        }
    }
}

impl From<Body> for BakedBody {
    /// Drawn with its centre of mass at the origin of the mesh.
    fn from(body: Body) -> Self {
        Self::from(Bake {
            body,
            history: None,
            error_estimate: 0.0,
            warnings: Vec::new(),
            fingerprint: [0; 32],
        })
    }
}

/// Loads a [`BakedBody`] from a file of the command `langevin-rigid bake`, `NAME.lrbake`.
#[derive(Debug, Default, TypePath)]
pub struct BakedBodyLoader;

/// How a [`BakedBody`] is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BakedBodyLoaderSettings {
    /// [`BakedBody::centre_of_mass`], which the file does not know (m).
    pub centre_of_mass: [f64; 3],
}

/// Why a bake could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file could not be read.
    #[error(transparent)]
    Read(#[from] std::io::Error),
    /// The file is no bake.
    #[error(transparent)]
    Bake(#[from] BakeError),
}

impl AssetLoader for BakedBodyLoader {
    type Asset = BakedBody;
    type Settings = BakedBodyLoaderSettings;
    type Error = LoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        settings: &BakedBodyLoaderSettings,
        _: &mut LoadContext<'_>,
    ) -> Result<BakedBody, LoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        Ok(BakedBody {
            bake: Bake::from_bytes(&bytes)?,
            centre_of_mass: settings.centre_of_mass,
        })
    }

    fn extensions(&self) -> &[&str] {
        &["lrbake"]
    }
}
